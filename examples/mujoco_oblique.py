"""A ball hits a glass plate at many angles in MuJoCo, and leaves it with the right spin.

    pip install mujoco ./python
    python examples/mujoco_oblique.py [PICTURE.svg]

The engine's own contact of the pair is switched off, with its friction. The FMU gives the normal and
the tangential force. It does not move the ball, so the engine takes short steps during the impact.
"""

import csv

import brinell
import judge
import mujoco
import numpy as np

RADIUS, STEP, SPEED = 2.5e-3, 2e-8, 3.9  # m, s, m/s
MODEL = """<mujoco><option timestep="2e-8" gravity="0 0 0"/><worldbody>
  <geom type="plane" size="1 1 .1" contype="{soft}" friction="0.092 0 0"/>
  <body pos="0 0 2.5e-3"><freejoint/>
    <geom type="sphere" size="2.5e-3" density="4000" contype="0" friction="0.092 0 0"/></body>
</worldbody></mujoco>"""


def impact(path, degrees):
    """Tangential restitution and spin [rad/s] with the FMU as the plate."""
    model = mujoco.MjModel.from_xml_string(MODEL.format(soft=0))
    data = mujoco.MjData(model)
    angle, start = np.radians(degrees), SPEED * np.sin(np.radians(degrees))
    data.qvel[[0, 2]] = start, -SPEED * np.cos(angle)
    with brinell.Contact(path, force="end") as plate:
        balance = Balance(plate, model, data)
        while data.qvel[2] < 0.0 or plate["force"] > 0.0:
            # the ball turns about y; its lowest point moves with the centre and the spin
            slip = data.qvel[0] - RADIUS * data.qvel[4]
            force = plate.step(STEP, -data.qvel[2], tangential_rate=slip)
            pull = plate["tangential_force"]
            data.xfrc_applied[1] = -pull, 0.0, force, 0.0, RADIUS * pull, 0.0
            mujoco.mj_step(model, data)
        balance.told()
    return data.qvel[0] / start, data.qvel[4]


def soft():
    """Spin [rad/s] with the engine's own contact and friction at its default settings, in steps of
    0.1 ms."""
    spins = []
    for degrees in ANGLES:
        model = mujoco.MjModel.from_xml_string(MODEL.format(soft=1))
        model.opt.timestep = 1e-4
        data = mujoco.MjData(model)
        angle = np.radians(degrees)
        data.qvel[[0, 2]] = SPEED * np.sin(angle), -SPEED * np.cos(angle)
        while data.time < 0.02:
            mujoco.mj_step(model, data)
        spins.append(data.qvel[4])
    return np.array(spins)


class Balance(judge.Friction):
    """The kinetic energy of the ball in the engine."""

    def __init__(self, plate, model, data):
        self.model, self.data = model, data
        super().__init__(plate)

    def kinetic(self):
        mass, inertia = self.model.body_mass[1], self.model.body_inertia[1]
        velocity, spin = self.data.qvel[:3], self.data.qvel[3:]
        return 0.5 * (mass * velocity @ velocity + inertia @ (spin * spin))


if __name__ == "__main__":
    ANGLES = np.array([2.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 40.0, 50.0, 60.0, 75.0])
    path = judge.unit("oblique")
    rebounds = np.array([impact(path, degrees) for degrees in ANGLES]).T
    # a ball that slides throughout is known
    coulomb = 1.0 - 2.0 * 0.092 / np.tan(np.radians(ANGLES[-3:]))
    judge.agree("restitution of a ball that slides throughout", rebounds[0][-3:], coulomb, 1e-6)
    table = judge.FOLDER.parent / "data/experiment/oblique_elastic.csv"
    with table.open(encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["quantity"] == "omega"]
    angle, spin = np.array([[float(row["angle_deg"]), float(row["value"])] for row in rows]).T
    error = spin - np.interp(angle, ANGLES, rebounds[1])
    inside = angle <= ANGLES[-1]
    judge.agree("rms of the spin against the measurement [rad/s]", np.sqrt(np.mean(error[inside] ** 2)), 0.0, 30.0)
    own = soft()
    print("spin at 20 degrees:", f"{rebounds[1][4]:.0f} rad/s; by the engine's own contact {own[4]:.0f} rad/s")
    judge.picture(
        "MuJoCo: spin of a ball after an oblique impact at 3.9 m/s",
        [
            (ANGLES, rebounds[1], "engine with the unit", "-"),
            (angle, spin, "measured by Kharaz, Gorham and Salman", "."),
            (ANGLES, own, "the engine's own contact", "--"),
        ],
        x="angle of incidence from the normal [degrees]",
        y="spin [rad/s]",
    )
