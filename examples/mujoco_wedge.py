"""A wedge is knocked between two steep walls in MuJoCo and stays, in steps of a millisecond.

    pip install mujoco ./python
    python examples/mujoco_wedge.py [PICTURE.svg]

The walls are 8 degrees from the vertical, less than the angle of friction. So the wedge can't slip
back: friction holds it down between walls that press with many times its weight. One FMU moves the
four feet together within a step, with friction in both directions.
"""

import brinell.mujoco
import judge
import mujoco
import numpy as np

MASS, WEIGHT, BLOW = 0.3, 0.3 * 9.81, 0.5  # kg, N, m/s
STEP, FINE, END, COMPARED = 1e-3, 5e-5, 0.1, 0.02  # s
MODEL = """<mujoco><option timestep="{step}" gravity="0 0 -9.81"/>
  <default><geom contype="{soft}" conaffinity="{soft}" friction=".3"/></default>
  <worldbody><geom name="left" type="plane" size="1 1 .1" pos="-.0202 0 0" euler="0 82 0"/>
    <geom name="right" type="plane" size="1 1 .1" pos=".0202 0 0" euler="0 -82 0"/>
    <body name="wedge" euler=".2 .3 0"><freejoint/>
      <inertial pos="0 0 .02" mass="{mass}" diaginertia="1.2e-4 2.6e-4 3.5e-4"/>{feet}</body>
  </worldbody></mujoco>"""
FOOT = '<geom name="{}{}" size="5e-3" pos="{} {} 0"/>'
FEET = [(wall, side) for wall in ("left", "right") for side in (-0.02, 0.02)]


def start(step, soft=0):
    """The engine with the wedge above its place; `soft` enables its own contact."""
    feet = "".join(
        FOOT.format(wall, index, 0.015 if wall == "right" else -0.015, side)
        for index, (wall, side) in enumerate(FEET)
    )
    model = mujoco.MjModel.from_xml_string(MODEL.format(step=step, soft=soft, feet=feet, mass=MASS))
    data = mujoco.MjData(model)
    data.qvel[2] = -BLOW
    mujoco.mj_forward(model, data)
    return model, data


def knock(path, step, end):
    """Times, heights and all speeds; the forces of the walls at the end, and their sum."""
    model, data = start(step)
    pairs, rows = [(f"{wall}{index}", wall) for index, (wall, _) in enumerate(FEET)], []
    normals = [data.geom(wall).xmat.reshape(3, 3)[:, 2] for wall, _ in FEET]
    with brinell.mujoco.attach(model, data, pairs, path) as feet:
        balance = judge.Total(model, data, feet.contact)
        while data.time < end - step / 2.0:
            rows.append((data.time, data.qpos[2], *data.qvel))
            feet.step()
            balance.step()
    if step == STEP:
        balance.told("kinetic energy of the blow", 0.5 * MASS * BLOW**2)
    return np.array(rows).T, feet.forces, feet.forces @ normals + feet.tangential_forces.sum(axis=0)


def soft():
    """Times and heights with the engine's own contact and friction at its default settings."""
    model, data = start(STEP, soft=1)
    return judge.alone_in_mujoco(model, data, END, lambda: data.qpos[2])


if __name__ == "__main__":
    path = judge.unit("rough_feet")
    rows, forces, held = knock(path, STEP, END)
    small, _, _ = knock(path, FINE, COMPARED)
    until, every = round(COMPARED / STEP), round(STEP / FINE)
    same = small[:, ::every]
    judge.agree("height against steps of 50 us, 20 ms [m]", rows[1, :until], same[1], 1e-6)
    judge.agree("forces at rest against the weight [N]", held, [0.0, 0.0, WEIGHT], 1e-8)
    judge.agree("speeds at rest [m/s, rad/s]", rows[2:, -1], 0.0, 1e-8)
    judge.agree("way in the last 50 ms [m]", rows[1, -50:], rows[1, -1], 1e-14)
    print(f"the walls press with {forces.sum() / WEIGHT:.0f} times the weight")
    own = soft()
    judge.picture(
        "MuJoCo: a wedge is knocked between two walls, 1 ms steps",
        [
            (rows[0], 1e3 * rows[1], "engine with the unit", "-"),
            (same[0], 1e3 * same[1], "the same in steps of 50 us", "."),
            (own[0], 1e3 * own[1], "the engine's own contact", "--"),
        ],
        y="height [mm]",
    )
