"""A box is thrown onto a slope in MuJoCo, slides, turns and comes to rest, in steps of a millisecond.

    pip install mujoco ./python
    python examples/mujoco_slope.py [PICTURE.svg]

The slope is flatter than the angle of friction, so that the box stays where it stops. One FMU moves
the four feet together within a step, with friction in both directions.
"""

import brinell.mujoco
import judge
import mujoco
import numpy as np

STEP, FINE, END, COMPARED = 1e-3, 1e-4, 0.5, 0.05  # s
SLOPE, COEFFICIENT = 0.1, 0.3
MODEL = """<mujoco><option timestep="{step}" gravity="{along} 0 {down}"/>
  <default><geom contype="{soft}" conaffinity="{soft}" friction="{mu}"/></default>
  <worldbody><geom name="floor" type="plane" size="1 1 .1"/>
    <body name="box" pos="0 0 .0305" euler="2 3 0"><freejoint/>
      <inertial pos=".004 .002 0" mass="0.3" diaginertia="1.2e-4 2.6e-4 3.5e-4"/>{feet}</body>
  </worldbody></mujoco>"""
FOOT = '<geom name="foot{}" size="5e-3" pos="{} {} -.02"/>'
CORNERS = [(-0.04, -0.025), (-0.04, 0.025), (0.04, -0.025), (0.04, 0.025)]  # m


def start(step, soft=0):
    """The engine with the box in the air; `soft` enables its own contact."""
    feet = "".join(FOOT.format(index, x, y) for index, (x, y) in enumerate(CORNERS))
    pull = {"along": 9.81 * np.sin(SLOPE), "down": -9.81 * np.cos(SLOPE), "mu": COEFFICIENT}
    model = mujoco.MjModel.from_xml_string(MODEL.format(step=step, soft=soft, feet=feet, **pull))
    data = mujoco.MjData(model)
    data.qvel[:] = [-0.5, 0.2, 0.0, 0.0, 0.0, 2.0]  # up the slope
    mujoco.mj_forward(model, data)
    return model, data


def slide(path, step, end):
    """Times, places of the centre of mass along and across the slope, their speeds and the turn
    rate about the normal."""
    model, data = start(step)
    pairs = [(f"foot{index}", "floor") for index in range(4)]
    rows = []
    with brinell.mujoco.attach(model, data, pairs, path) as feet:
        balance = judge.Total(model, data, feet.contact)
        while data.time < end - step / 2.0:
            rows.append((data.time, *data.body("box").xipos[:2], *data.qvel[:2], data.qvel[5]))
            feet.step()
            balance.step()
    if step == STEP:
        kinetic = 0.5 * (0.3 * 0.29 + 3.5e-4 * 4.0)
        balance.told("kinetic energy of the throw", kinetic)
    return np.array(rows).T, feet.forces, feet.tangential_forces


def soft():
    """Times and places with the engine's own contact and friction at its default settings."""
    model, data = start(STEP, soft=1)
    return judge.alone_in_mujoco(model, data, END, lambda: data.body("box").xipos[0])


if __name__ == "__main__":
    path = judge.unit("rough_feet")
    rows, forces, tangential = slide(path, STEP, END)
    small, _, _ = slide(path, FINE, COMPARED)
    until, every = round(COMPARED / STEP), round(STEP / FINE)
    same = small[:, ::every]
    judge.agree("place against steps of 0.1 ms, 50 ms [m]", rows[1:3, :until], same[1:3], 1e-6)
    weight = 0.3 * 9.81 * np.array([np.sin(SLOPE), 0.0, np.cos(SLOPE)])
    held = tangential.sum(axis=0) + [0.0, 0.0, forces.sum()]
    judge.agree("forces at rest against the weight [N]", held + weight * [1, 1, -1], 0.0, 1e-13)
    judge.agree("speeds at rest [m/s, rad/s]", rows[3:, -1], 0.0, 1e-14)
    own = soft()
    judge.picture(
        "MuJoCo: a box is thrown up a slope with friction, 1 ms steps",
        [
            (rows[0], 1e3 * rows[1], "along the slope", "-"),
            (rows[0], 1e3 * rows[2], "across", "-"),
            (same[0, ::3], 1e3 * same[1, ::3], "along, in steps of 0.1 ms", "."),
            (own[0], 1e3 * own[1], "along, the engine's own contact", "--"),
        ],
        y="place of the centre [mm]",
    )
