"""A ball is thrown into a groove in MuJoCo and rolls along it at last, in steps of a millisecond.

    pip install mujoco ./python
    python examples/mujoco_groove.py [PICTURE.svg]

The groove is a right angle. The ball jumps from side to side, slips along both, and ends on both.
One FMU moves the two contacts together within a step, with friction in both directions.
"""

import brinell.mujoco
import judge
import mujoco
import numpy as np

MASS, RADIUS, WEIGHT, THROW = 4.1e-3, 5e-3, 4.1e-3 * 9.81, 0.5  # kg, m, N, m/s
STEP, FINE, END, COMPARED = 1e-3, 5e-5, 0.4, 0.05  # s
MODEL = """<mujoco><option timestep="{step}" gravity="0 0 -9.81"/>
  <default><geom contype="{soft}" conaffinity="{soft}" friction=".3"/></default>
  <worldbody><geom name="left" type="plane" size="1 1 .1" euler="-45 0 0"/>
    <geom name="right" type="plane" size="1 1 .1" euler="45 0 0"/>
    <body name="ball" pos="0 0 .01"><freejoint/>
      <geom name="ball" size="{radius}" mass="{mass}"/></body></worldbody></mujoco>"""


def start(step, soft=0):
    """The engine with the ball in the air; `soft` enables its own contact."""
    values = {"step": step, "soft": soft, "radius": RADIUS, "mass": MASS}
    model = mujoco.MjModel.from_xml_string(MODEL.format(**values))
    data = mujoco.MjData(model)
    data.qvel[:3] = [THROW, 0.2, 0.0]  # along and across
    mujoco.mj_forward(model, data)
    return model, data


def throw(path, step, end):
    """Times, places, speed along the groove and spins about the axes of the world; the forces of the
    two sides at the end."""
    model, data = start(step)
    rows = []
    with brinell.mujoco.attach(model, data, [("ball", "left"), ("ball", "right")], path) as ball:
        balance = judge.Total(model, data, ball.contact)
        while data.time < end - step / 2.0:
            spin = data.body("ball").xmat.reshape(3, 3) @ data.qvel[3:]
            rows.append((data.time, *data.qpos[:3], data.qvel[0], *spin))
            ball.step()
            balance.step()
    if step == STEP:
        balance.told("kinetic energy of the throw", 0.5 * MASS * (THROW**2 + 0.2**2), 5e-7)
    normals = [data.geom(side).xmat.reshape(3, 3)[:, 2] for side in ("left", "right")]
    return np.array(rows).T, ball.forces[:, None] * normals + ball.tangential_forces


def soft():
    """Times and speeds along with the engine's own contact and friction at its default settings."""
    model, data = start(STEP, soft=1)
    return judge.alone_in_mujoco(model, data, END, lambda: data.qvel[0])


if __name__ == "__main__":
    path = judge.unit("rough_feet", count=2)
    rows, forces = throw(path, STEP, END)
    small, _ = throw(path, FINE, COMPARED)
    until, every = round(COMPARED / STEP), round(STEP / FINE)
    same = small[:, ::every]
    judge.agree("place against steps of 50 us, 50 ms [m]", rows[1:4, :until], same[1:4], 1e-6)
    judge.agree("both sides against the weight [N]", forces.sum(axis=0), [0, 0, WEIGHT], 1e-13)
    judge.agree("vertical force of each against half of it [N]", forces[:, 2], WEIGHT / 2.0, 1e-6)
    rolling = 0.5 * rows[3] * rows[6]  # the contacts are this far below the axis: half its height
    judge.agree("speed against rolling, 0.1 s [m/s]", rows[4, -100:], rolling[-100:], 3e-9)
    judge.agree("speed against that of rigid bodies [m/s]", rows[4, -1], THROW / 1.8, 5e-4)
    judge.agree("speed over 0.1 s [m/s]", rows[4, -100:], rows[4, -1], 1e-13)
    own = soft()
    judge.picture(
        "MuJoCo: a ball is thrown into a groove, 1 ms steps",
        [
            (rows[0], rows[4], "speed along the groove", "-"),
            (rows[0], rolling, "that of rolling at this spin", "-"),
            (same[0], same[4], "speed in steps of 50 us", "."),
            (own[0], own[1], "speed by the engine's own contact", "--"),
        ],
        y="speed [m/s]",
    )
