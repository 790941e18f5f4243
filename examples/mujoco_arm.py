"""An arm with two links swings against a stop in MuJoCo, in steps of a millisecond.

    pip install mujoco ./python
    python examples/mujoco_arm.py [PICTURE.svg]

The effective mass at the fingertip depends on the pose. It is computed from the engine's mass
matrix in every step.
"""

import brinell
import judge
import mujoco
import numpy as np

STEP, END, RADIUS = 1e-3, 2.0, 5e-3  # s, s, m


def start(soft):
    """The engine with the arm raised; `soft` enables its own contact with the stop."""
    spec = mujoco.MjSpec.from_file(__file__.replace("mujoco_arm.py", "arm.xml"))
    spec.geom("stop").contype = soft
    model = spec.compile()
    data = mujoco.MjData(model)
    data.qpos[:] = [-0.9, -0.5]
    mujoco.mj_forward(model, data)
    return model, data


def gap(data):
    """Distance of the fingertip from the stop [m]."""
    return data.site("tip").xpos[0] - RADIUS + 0.05


def swing(path, fixed=None, end=END):
    """Times, distances from the stop, effective masses and joint angles; for each blow, time, speed,
    restitution and effective mass. `fixed` [kg] instead of the mass of the pose gives wrong results."""
    model, data = start(soft=0)
    jacobian, change, response = np.zeros((3, 2)), np.zeros((3, 2)), np.zeros((1, 2))
    rows, blows, finger = [], [], model.body("finger").id
    with brinell.Contact(path, initial_gap=gap(data)) as contact:
        balance = judge.Balance(contact)
        while data.time < end:
            mujoco.mj_forward(model, data)
            mujoco.mj_jacSite(model, data, jacobian, None, 0)
            mujoco.mj_jacDot(model, data, change, None, data.site("tip").xpos, finger)
            away = jacobian[:1]  # derivative of the distance by the joint angles
            mujoco.mj_solveM(model, data, response, away)
            mass = 1.0 / (away @ response.T).item()
            rows.append((data.time, gap(data), mass, *data.qpos))
            closing = -(away @ data.qvel).item()
            pull = -(away @ data.qacc + change[:1] @ data.qvel).item()
            force = contact.step(STEP, closing, pull, mass=fixed or mass, gap=gap(data))
            data.qvel += STEP * force * response[0]
            after = -(away @ data.qvel).item()
            balance.step(STEP, mass, force, closing, after, pull)
            mujoco.mj_step(model, data)
            if force > 0.0:
                # the engine cannot know when within the step the finger turned
                mujoco.mj_kinematics(model, data)
                data.qpos += response[0] * mass * (-contact["indentation"] - gap(data))
                blows.append((data.time, closing, -(after + STEP * pull) / closing, mass))
    if fixed is None:
        balance.told()
    return np.array(rows).T, np.array(blows)


def soft():
    """Distances with the engine's own contact and default settings."""
    model, data = start(soft=1)
    rows = []
    while data.time < END:
        mujoco.mj_step(model, data)
        rows.append((data.time, gap(data), 0.0, *data.qpos))
    return np.array(rows).T


def drawn(angles):
    """The points of the arm at all times, for the animation."""
    links = [(0.0, 0.0), (0.3, angles[0]), (0.2, angles[0] + angles[1])]
    points = [np.array([-length * np.sin(at), -length * np.cos(at)]) for length, at in links[1:]]
    elbow, tip = points[0].T, (points[0] + points[1]).T
    return np.stack([np.zeros_like(elbow), elbow, tip], axis=1)[:, None]


if __name__ == "__main__":
    path = judge.unit("arm")
    rows, blows = swing(path)
    for _, speed, restitution, mass in blows[:3]:
        print(f"{speed:.3f} m/s with {mass:.4f} kg: restitution {restitution:.4f}")
    time, speed, restitution, mass = blows[0]
    with brinell.Contact(path, effective_mass=mass) as alone:
        expected = STEP * alone.step(STEP, speed) / mass / speed - 1.0
    judge.agree("first restitution against the unit alone", restitution, expected, 5e-3)
    _, wrong = swing(path, fixed=rows[2, 0], end=time)
    print(f"the first with the mass of the first pose: restitution {wrong[0][2]:.4f}")
    own = soft()
    judge.picture(
        "MuJoCo: an arm with two links swings against a stop, 1 ms steps",
        [
            (rows[0], 1e3 * rows[1], "engine with the unit", "-"),
            (own[0], 1e3 * own[1], "the engine's own contact", "--"),
        ],
        y="distance from the stop [mm]",
    )
    stop = np.array([[-0.055, -0.4], [-0.055, -0.52]])
    judge.animation(
        [("contact by the unit", drawn(rows[3:])), ("MuJoCo's own contact", drawn(own[3:]))],
        seconds=END,
        slower=2.0,
        still=stop,
    )
