"""A box falls on its four feet in MuJoCo and comes to rest, in steps of a millisecond.

    pip install mujoco ./python
    python examples/mujoco_box.py [PICTURE.svg]

The box is tilted. A foot that hits throws the others down, which hit some milliseconds later. An
impact takes 0.1 ms. The FMU moves all feet together within a step, with the inverse masses that the
engine's mass matrix gives. The centre of mass is not above a diagonal of the feet: such a box would
rock on it.
"""

import brinell.mujoco
import judge
import mujoco
import numpy as np

STEP, FINE, END, COMPARED = 1e-3, 2e-5, 0.6, 0.1  # s
MODEL = """<mujoco><option timestep="{step}" gravity="0 0 -9.81"/>
  <default><geom contype="{soft}" conaffinity="{soft}" condim="1"/></default>
  <worldbody><geom name="floor" type="plane" size="1 1 .1"/>
    <body name="box" euler="6 8 0"><freejoint/>
      <inertial pos=".004 .002 0" mass="0.3" diaginertia="1.2e-4 2.6e-4 3.5e-4"/>{feet}</body>
  </worldbody></mujoco>"""
FOOT = '<geom name="foot{}" size="5e-3" pos="{} {} -.02"/>'
CORNERS = [(-0.04, -0.025), (-0.04, 0.025), (0.04, -0.025), (0.04, 0.025)]  # m
HEIGHT = 5e-3  # m of the lowest foot


def start(step, soft=0):
    """The engine with the box above the floor; `soft` enables its own contact."""
    feet = "".join(FOOT.format(index, x, y) for index, (x, y) in enumerate(CORNERS))
    model = mujoco.MjModel.from_xml_string(MODEL.format(step=step, soft=soft, feet=feet))
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    lowest = min(data.geom(f"foot{index}").xpos[2] for index in range(4)) - 5e-3
    data.qpos[2] += HEIGHT - lowest
    mujoco.mj_forward(model, data)
    return model, data


def fall(path, step, end):
    """Times, heights of the centre of mass, vertical speeds and spins about x and y; the forces at
    the end."""
    model, data = start(step)
    pairs = [(f"foot{index}", "floor") for index in range(4)]
    rows = []
    with brinell.mujoco.attach(model, data, pairs, path) as feet:
        balance = judge.Total(model, data, feet.contact)
        while data.time < end - step / 2.0:
            rows.append((data.time, data.body("box").xipos[2], *data.qvel[2:5]))
            forces = feet.step()
            balance.step()
    if step == STEP:
        balance.told("energy of the fall", 0.3 * 9.81 * (rows[0][1] - rows[-1][1]))
    return np.array(rows).T, forces


def soft():
    """Times and heights with the engine's own contact and default settings."""
    model, data = start(STEP, soft=1)
    return judge.alone_in_mujoco(model, data, END, lambda: data.body("box").xipos[2])


if __name__ == "__main__":
    path = judge.unit("feet")
    rows, forces = fall(path, STEP, END)
    small, _ = fall(path, FINE, COMPARED)
    until, every = round(COMPARED / STEP), round(STEP / FINE)
    same = small[:, ::every]
    judge.agree("height against steps of 20 us, 0.1 s [m]", rows[1, :until], same[1], 1e-6)
    judge.agree("spin against steps of 20 us, 0.1 s [rad/s]", rows[3:, :until], same[3:], 5e-2)
    judge.agree("forces at rest against the weight [N]", forces.sum(), 0.3 * 9.81, 1e-6)
    judge.agree("speed and spins at rest [m/s, rad/s]", rows[2:, -1], 0.0, 1e-5)
    model, data = start(STEP)
    data.qvel[3:5] = rows[3:, np.argmax(np.abs(rows[3]))]
    judge.flight(model, data, 0.1, 0.3 * 9.81 * (rows[1, 0] - rows[1, -1]))
    own = soft()
    judge.picture(
        "MuJoCo: a tilted box falls on its four feet, 1 ms steps",
        [
            (rows[0], 1e3 * rows[1], "engine with the unit", "-"),
            (same[0, ::3], 1e3 * same[1, ::3], "the same in steps of 20 us", "."),
            (own[0], 1e3 * own[1], "the engine's own contact", "--"),
        ],
        y="height of the centre [mm]",
    )
