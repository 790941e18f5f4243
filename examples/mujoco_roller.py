"""A roller falls flat onto a plate in MuJoCo and bounces, in steps of a millisecond.

    pip install mujoco ./python
    python examples/mujoco_roller.py [PICTURE.svg]

Its contact is a line, and an impact takes 30 us. `attach` lets an FMU compute it exactly within the
step; the engine gets its impulse.
"""

import brinell.mujoco
import judge
import mujoco
import numpy as np

MASS, HEIGHT, STEP, END = 0.05, 0.05, 1e-3, 0.6  # kg, m, s, s
GRAVITY = 9.81  # m/s^2
MODEL = """<mujoco><option timestep="1e-3" gravity="0 0 -9.81"/><worldbody>
  <geom name="plate" type="plane" size="1 1 .1" contype="{soft}"/>
  <body pos="0 0 .06"><freejoint/>
    <geom name="roller" type="cylinder" size=".01 .01" euler="90 0 0" mass=".05" contype="0"/></body>
</worldbody></mujoco>"""


def fall(path):
    """Height and speed in the engine, with the FMU as the plate."""
    model = mujoco.MjModel.from_xml_string(MODEL.format(soft=0))
    data = mujoco.MjData(model)
    rows = [(0.0, HEIGHT, 0.0)]
    with brinell.mujoco.attach(model, data, ("roller", "plate"), path) as plate:
        balance = judge.Total(model, data, plate.contact)
        for _ in range(round(END / STEP)):
            plate.step()
            balance.step()
            rows.append((data.time, data.qpos[2] - 0.01, data.qvel[2]))
    balance.told("energy of the fall", MASS * GRAVITY * HEIGHT, 1e-9)
    return np.array(rows).T


def soft():
    """Height with the engine's own contact and default settings."""
    model = mujoco.MjModel.from_xml_string(MODEL.format(soft=1))
    data = mujoco.MjData(model)
    return judge.alone_in_mujoco(model, data, END, lambda: data.qpos[2] - 0.01)


if __name__ == "__main__":
    path = judge.unit("roller")
    reference = judge.alone(path, HEIGHT, GRAVITY, MASS, END, STEP)
    judge.ball("MuJoCo", fall(path), reference, soft(), 1e-9, "roller")
