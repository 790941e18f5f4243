"""An arm with two links swings against a stop in MuJoCo, in steps of a millisecond.

    pip install mujoco ./python
    python examples/mujoco_arm.py [PICTURE.svg]

What the force at the fingertip moves depends on the pose: the effective mass comes from the
engine's mass matrix in every step.
"""

import brinell
import judge
import mujoco
import numpy as np

STEP, END, RADIUS = 1e-3, 2.0, 5e-3  # s, s, m
MODEL = """<mujoco><option timestep="1e-3" gravity="0 0 -9.81"/>
<default><geom contype="0" conaffinity="0"/></default><worldbody>
  <geom type="plane" pos="-.05 0 0" zaxis="1 0 0" size="1 1 .1" contype="{soft}"/>
  <body><joint axis="0 1 0"/>
    <geom type="capsule" fromto="0 0 0 0 0 -.3" size=".01" mass=".2"/>
    <body pos="0 0 -.3"><joint axis="0 1 0" damping="2e-3"/>
      <geom type="capsule" fromto="0 0 0 0 0 -.2" size=".008" mass=".1"/>
      <geom type="sphere" pos="0 0 -.2" size="5e-3" mass="4e-3" conaffinity="1"/>
      <site name="tip" pos="0 0 -.2"/>
</body></body></worldbody></mujoco>"""


def start(soft):
    """The engine with the arm raised."""
    model = mujoco.MjModel.from_xml_string(MODEL.format(soft=soft))
    data = mujoco.MjData(model)
    data.qpos[:] = [-0.9, -0.5]
    mujoco.mj_forward(model, data)
    return model, data


def gap(data):
    """Distance of the fingertip from the stop [m]."""
    return data.site("tip").xpos[0] - RADIUS + 0.05


def swing(path, mass_of_pose=True):
    """Times, distances from the stop; and of each blow speed, restitution and effective mass. With
    the mass of the first pose only as far as the first blow: from there on it's nonsense."""
    model, data = start(soft=0)
    finger, first = model.site("tip").bodyid[0], None
    jacobian, change, response = np.zeros((3, 2)), np.zeros((3, 2)), np.zeros((1, 2))
    rows, blows = [], []
    with brinell.Contact(path, initial_gap=gap(data)) as contact:
        balance = judge.Balance(contact)
        for _ in range(round(END / STEP)):
            mujoco.mj_forward(model, data)
            mujoco.mj_jacSite(model, data, jacobian, None, 0)
            mujoco.mj_jacDot(model, data, change, None, data.site("tip").xpos, finger)
            away = jacobian[:1]  # how the distance follows the joints
            mujoco.mj_solveM(model, data, response, away)
            mass = 1.0 / (away @ response.T).item()
            first = first or mass
            closing = -(away @ data.qvel).item()
            pull = -(away @ data.qacc + change[:1] @ data.qvel).item()
            used = mass if mass_of_pose else first
            force = contact.step(STEP, closing, pull, mass=used, gap=gap(data))
            data.qvel += STEP * force * response[0]
            after = -(away @ data.qvel).item()
            balance.step(STEP, mass, force, closing, after, pull)
            mujoco.mj_step(model, data)
            if force > 0.0:
                # the engine can't know when within the step the finger has turned
                mujoco.mj_kinematics(model, data)
                data.qpos += response[0] * mass * (-contact["indentation"] - gap(data))
                blows.append((closing, -(after + STEP * pull) / closing, mass))
                if not mass_of_pose:
                    break
            mujoco.mj_kinematics(model, data)
            rows.append((data.time, gap(data)))
    if mass_of_pose:
        balance.told()
    return np.array(rows).T, np.array(blows)


def soft():
    """Distances by the engine's own contact, as it is without a setting."""
    model, data = start(soft=1)
    rows = []
    while data.time < END:
        mujoco.mj_step(model, data)
        rows.append((data.time, gap(data)))
    return np.array(rows).T


if __name__ == "__main__":
    path = judge.unit("arm")
    (time, distance), blows = swing(path)
    for speed, restitution, mass in blows[:3]:
        print(f"{speed:.3f} m/s with {mass:.4f} kg: restitution {restitution:.4f}")
    speed, restitution, mass = blows[0]
    with brinell.Contact(path, effective_mass=mass) as alone:
        expected = STEP * alone.step(STEP, speed) / mass / speed - 1.0
    judge.agree("first restitution against the unit alone", restitution, expected, 5e-3)
    _, wrong = swing(path, mass_of_pose=False)
    print(f"the first with the mass of the first pose: restitution {wrong[0][1]:.4f}")
    own = soft()
    judge.picture(
        "MuJoCo: an arm with two links swings against a stop, 1 ms steps",
        [
            (time, 1e3 * distance, "engine with the unit", "-"),
            (own[0], 1e3 * own[1], "the engine's own contact", "--"),
        ],
        y="distance from the stop [mm]",
    )
