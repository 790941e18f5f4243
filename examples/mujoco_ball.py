"""A ball falls onto a plate in MuJoCo and bounces until it no longer yields, in steps of a millisecond.

    pip install mujoco ./python
    python examples/mujoco_ball.py [PICTURE.svg]

An impact takes 30 us. `attach` lets an FMU compute it exactly within the step; the engine gets its
impulse.
"""

import brinell.mujoco
import judge
import mujoco
import numpy as np

MASS, HEIGHT, STEP, END = 4e-3, 0.05, 1e-3, 0.6  # kg, m, s, s
GRAVITY = 9.81  # m/s^2
MODEL = """<mujoco><option timestep="1e-3" gravity="0 0 -9.81"/><worldbody>
  <geom name="plate" type="plane" size="1 1 .1" contype="{soft}"/>
  <body pos="0 0 5e-3"><joint type="slide" axis="0 0 1"/>
    <geom name="ball" size="5e-3" mass="4e-3" contype="0"/></body>
</worldbody></mujoco>"""


def fall(path):
    """Height and speed in the engine, with the FMU as the plate."""
    model = mujoco.MjModel.from_xml_string(MODEL.format(soft=0))
    data = mujoco.MjData(model)
    data.qpos[0] = HEIGHT
    rows = [(0.0, HEIGHT, 0.0)]
    with brinell.mujoco.attach(model, data, ("ball", "plate"), path) as plate:
        balance = judge.Total(model, data, plate.contact)
        for _ in range(round(END / STEP)):
            plate.step()
            balance.step()
            rows.append((data.time, data.qpos[0], data.qvel[0]))
    balance.told("energy of the fall", MASS * GRAVITY * HEIGHT, judge.BALANCE)
    return np.array(rows).T


def soft():
    """Height with the engine's own contact and default settings."""
    model = mujoco.MjModel.from_xml_string(MODEL.format(soft=1))
    data = mujoco.MjData(model)
    data.qpos[0] = HEIGHT
    rows = [(0.0, HEIGHT)]
    while data.time < END:
        mujoco.mj_step(model, data)
        rows.append((data.time, data.qpos[0]))
    return np.array(rows).T


if __name__ == "__main__":
    path = judge.unit("ball")
    reference = judge.alone(path, HEIGHT, GRAVITY, MASS, END, STEP)
    judge.ball("MuJoCo", fall(path), reference, soft(), 1e-9)
