"""Three balls on top of each other fall on a plate in MuJoCo and come to rest, in steps of a millisecond.

    pip install mujoco ./python
    python examples/mujoco_stack.py [PICTURE.svg]

The balls touch each other from the start. The impacts overlap: the plate throws the lowest ball
against the others, which still fall. One FMU moves all three together within a step.
"""

import brinell.mujoco
import judge
import mujoco
import numpy as np

MASS, RADIUS, GRAVITY = 32.8e-3, 10e-3, 9.81  # kg, m, m/s^2
HEIGHT, STEP, FINE, END = 5e-3, 1e-3, 1e-4, 0.4  # m, s
MODEL = """<mujoco><option timestep="{step}" gravity="0 0 {down}"/>
  <default><geom contype="{soft}" conaffinity="{soft}" condim="1"/></default>
  <worldbody><geom name="plate" type="plane" size="1 1 .1"/>{balls}</worldbody></mujoco>"""
BALL = (
    '<body pos="0 0 {}"><joint type="slide" axis="0 0 1"/>'
    '<geom name="ball{}" size="{}" mass="{}"/></body>'
)


def start(step, soft=0):
    """The engine with the stack above the plate; `soft` enables its own contact."""
    places = [HEIGHT + RADIUS * (1 + 2 * index) for index in range(3)]
    balls = "".join(BALL.format(z, index, RADIUS, MASS) for index, z in enumerate(places))
    model = mujoco.MjModel.from_xml_string(
        MODEL.format(step=step, down=-GRAVITY, soft=soft, balls=balls)
    )
    return model, mujoco.MjData(model)


def fall(path, step):
    """Times, heights above the places in a stack that stands, and speeds; the forces at the end."""
    model, data = start(step)
    pairs, rows = [("ball0", "plate"), ("ball1", "ball0"), ("ball2", "ball1")], []
    with brinell.mujoco.attach(model, data, pairs, path) as stack:
        balance = judge.Total(model, data, stack.contact)
        while data.time < END - step / 2.0:
            rows.append((data.time, *(data.qpos + HEIGHT), *data.qvel))
            stack.step()
            balance.step()
    if step == STEP:
        balance.told("energy of the fall", 3.0 * MASS * GRAVITY * HEIGHT, 1e-12)
    return np.array(rows).T, stack.forces


def soft():
    """Times and heights with the engine's own contact and default settings."""
    model, data = start(STEP, soft=1)
    return judge.alone_in_mujoco(model, data, END, lambda: data.qpos + HEIGHT)


if __name__ == "__main__":
    path = judge.unit("stack")
    rows, forces = fall(path, STEP)
    small, _ = fall(path, FINE)
    same = small[:, :: round(STEP / FINE)]
    judge.agree("heights against steps of 0.1 ms [m]", rows[1:4], same[1:4], 1e-9)
    judge.agree("speeds against steps of 0.1 ms [m/s]", rows[4:], same[4:], 1e-5)
    weights = MASS * GRAVITY * np.array([3, 2, 1])
    judge.agree("forces at rest against the weights above [N]", forces, weights, 1e-13)
    judge.agree("speeds at rest [m/s]", rows[4:, -1], 0.0, 1e-14)
    own = soft()
    judge.picture(
        "MuJoCo: three balls on top of each other fall on a plate, 1 ms steps",
        [
            (rows[0], 1e3 * rows[1], "lowest ball", "-"),
            (rows[0], 1e3 * rows[2], "ball in the middle", "-"),
            (rows[0], 1e3 * rows[3], "highest ball", "-"),
            (same[0, ::4], 1e3 * same[3, ::4], "highest ball, in steps of 0.1 ms", "."),
            (own[0], 1e3 * own[3], "highest ball, MuJoCo's own contact", "--"),
        ],
        y="height above its place [mm]",
    )
