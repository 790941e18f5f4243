"""Newton's cradle of five balls that touch each other, in MuJoCo, in steps of a millisecond.

    pip install mujoco ./python
    python examples/mujoco_cradle.py [PICTURE.svg]

Without gaps, the impacts overlap: five balls push each other at once. One FMU moves all of them
together, with the inverse masses that the engine's mass matrix gives.
"""

import brinell.mujoco
import judge
import mujoco
import numpy as np

MASS, LENGTH, RADIUS, GRAVITY = 32.8e-3, 0.12, 10e-3, 9.81  # kg, m, m, m/s^2
LIFT, STEP, END = 0.045, 1e-3, 3.0  # m along the arc, s, s
BALL = (
    '<body name="ball{0}" pos="{1} 0 0"><joint axis="0 -1 0" pos="0 0 {2}"/>'
    '<geom name="ball{0}" size="{3}" mass="{4}" contype="{5}" condim="1"/></body>'
)


def start(soft=0):
    """The engine with the first ball lifted; `soft` enables its own contact."""
    row = "".join(
        BALL.format(index, 2 * RADIUS * index, LENGTH, RADIUS, MASS, soft) for index in range(5)
    )
    option = f'<option timestep="{STEP}" gravity="0 0 {-GRAVITY}"/>'
    default = f'<default><geom conaffinity="{soft}"/></default>'
    model = mujoco.MjModel.from_xml_string(
        f"<mujoco>{option}{default}<worldbody>{row}</worldbody></mujoco>"
    )
    data = mujoco.MjData(model)
    data.qpos[0] = -LIFT / LENGTH
    return model, data


def swing(path):
    """Times, positions along the arcs and speeds."""
    model, data = start()
    pairs, rows = [(f"ball{index}", f"ball{index + 1}") for index in range(4)], []
    with brinell.mujoco.attach(model, data, pairs, path) as row:
        balance = judge.Total(model, data, row.contact)
        while data.time < END:
            rows.append((data.time, *(LENGTH * data.qpos), *(LENGTH * data.qvel)))
            row.step()
            balance.step()
    lifted = MASS * GRAVITY * LENGTH * (1.0 - np.cos(LIFT / LENGTH))
    balance.told("energy of the first ball", lifted, 1e-3)
    return np.array(rows).T


def soft():
    """Times and positions with MuJoCo's own contact and default settings."""
    model, data = start(soft=1)
    return judge.alone_in_mujoco(model, data, END, lambda: LENGTH * data.qpos)


if __name__ == "__main__":
    path = judge.unit("touching")
    rows, own = swing(path), soft()
    first = np.flatnonzero(np.abs(rows[7]) > 1e-6)[0] - 1  # before the second ball moves
    fine = judge.row(path, rows[1:, first], 0.0, MASS, lambda x: -GRAVITY * np.sin(x / LENGTH), 1e-7)
    wave = rows[6:, first + 2]
    judge.agree("speeds after a wave against steps of 0.1 us [m/s]", wave, fine[1], 1e-3)
    print(f"speeds after a wave: {wave.round(4)} m/s")
    judge.picture(
        "MuJoCo: Newton's cradle of touching balls, 1 ms steps",
        [
            (rows[0], 1e3 * rows[1], "first ball", "-"),
            (rows[0], 1e3 * rows[3], "ball in the middle", "-"),
            (rows[0], 1e3 * rows[5], "last ball", "-"),
            (own[0], 1e3 * own[5], "last ball, MuJoCo's own contact", "--"),
        ],
        y="way along the arc [mm]",
    )
