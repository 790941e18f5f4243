"""A wheel without a rim walks down a slope on its spokes in MuJoCo, in steps of a millisecond.

    pip install mujoco ./python
    python examples/mujoco_walker.py [PICTURE.svg]

The spokes end in small spheres. At each footfall the next foot hits, bounces some times and takes
over. A rigid wheel that never bounces keeps the angular momentum about the foot that hits, so that
its spin after a footfall is a known part of that before.
"""

import brinell.mujoco
import judge
import mujoco
import numpy as np

SPOKES, LENGTH, FOOT, MASS, INERTIA = 8, 0.05, 5e-3, 0.3, 3.75e-4  # m, m, kg, kg m^2
SLOPE, SPIN, HALF, GRAVITY = 0.15, 5.0, np.pi / SPOKES, 9.81  # rad, rad/s, rad, m/s^2
STEP, FINE, END, COMPARED = 1e-3, 2.5e-4, 0.37, 0.1  # s
MODEL = """<mujoco><option timestep="{step}" gravity="{along} 0 {down}"/>
  <default><geom contype="{soft}" conaffinity="{soft}" friction=".6"/></default>
  <worldbody><geom name="floor" type="plane" size="9 1 .1"/>
    <body pos="0 0 {height}"><joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/>
      <joint axis="0 1 0"/>
      <inertial pos="0 0 0" mass="{mass}" diaginertia="3e-4 {inertia} 3e-4"/>{feet}</body>
  </worldbody></mujoco>"""
SPOKE = '<geom name="foot{}" size="{}" pos="{} 0 {}"/>'


def start(step, soft=0):
    """The engine with the wheel on one foot; `soft` enables its own contact."""
    angles = 2.0 * HALF * np.arange(SPOKES)
    feet = "".join(
        SPOKE.format(index, FOOT, LENGTH * np.sin(angle), -LENGTH * np.cos(angle))
        for index, angle in enumerate(angles)
    )
    pull = {"along": GRAVITY * np.sin(SLOPE), "down": -GRAVITY * np.cos(SLOPE)}
    values = {"height": LENGTH + FOOT, "mass": MASS, "inertia": INERTIA, "soft": soft} | pull
    model = mujoco.MjModel.from_xml_string(MODEL.format(step=step, feet=feet, **values))
    data = mujoco.MjData(model)
    data.qvel[:] = [SPIN * (LENGTH + FOOT), 0.0, SPIN]  # rolls on the foot
    mujoco.mj_forward(model, data)
    return model, data


def walk(path, step, end):
    """Times, ways along the slope, heights, angles, and the speeds of these three."""
    model, data = start(step)
    pairs, rows = [(f"foot{index}", "floor") for index in range(SPOKES)], []
    values = {"friction_coefficient": 0.6, "elastic_restitution": 0.6}
    with brinell.mujoco.attach(model, data, pairs, path, **values) as wheel:
        balance = judge.Total(model, data, wheel.contact)
        while data.time < end - step / 2.0:
            rows.append((data.time, *data.qpos, *data.qvel))
            wheel.step()
            balance.step()
    if step == STEP:
        balance.told("energy of the way down", MASS * GRAVITY * np.sin(SLOPE) * data.qpos[0])
    return np.array(rows).T


def soft():
    """Times, angles and spins with the engine's own contact and friction at its default settings."""
    model, data = start(STEP, soft=1)
    return judge.alone_in_mujoco(model, data, END, lambda: [data.qpos[2], data.qvel[2]])


if __name__ == "__main__":
    path = judge.unit("rough_feet", count=SPOKES, directions=1)
    rows = walk(path, STEP, END)
    small = walk(path, FINE, COMPARED)
    until, every = round(COMPARED / STEP), round(STEP / FINE)
    same = small[:, ::every]
    judge.agree("place against steps of 0.25 ms, 0.1 s [m]", rows[1:3, :until], same[1:3], 2e-6)
    judge.agree("angle against steps of 0.25 ms, 0.1 s [rad]", rows[3, :until], same[3], 2e-5)
    feet = 2.0 * HALF * np.arange(rows[3, -1] // (2.0 * HALF) + 1.0)
    spins = np.interp(feet, rows[3], rows[6])
    print(f"spins above each foot: {spins.round(4)} rad/s")
    rigid = judge.footfall(spins[:-1], HALF, SLOPE, LENGTH, FOOT, MASS, INERTIA)
    judge.agree("spins against those of a rigid wheel [rad/s]", spins[1:], rigid, 2e-2)
    own = soft()
    judge.picture(
        "MuJoCo: a wheel without a rim walks down a slope, 1 ms steps",
        [
            (rows[0], rows[6], "engine with the unit", "-"),
            (same[0, ::2], same[6, ::2], "the same in steps of 0.25 ms", "."),
            (np.interp(feet[1:], rows[3], rows[0]), rigid, "a rigid wheel, from foot to foot", "s"),
            (own[0], own[2], "the engine's own contact", "--"),
        ],
        y="spin [rad/s]",
    )
