"""Newton's cradle of five balls, in steps of a millisecond.

    pip install mujoco pillow ./python
    python examples/cradle.py [PICTURE.svg [ANIMATION.gif]]

An impact takes 70 us, so a wave of four impacts crosses the row within one step. In each step, the
contacts run in the order in which they touch. A contact computes its whole impact in one call. Its
neighbours first run up to the time of that impact, with the speeds before it. This is exact if the
impacts of a ball do not overlap; a gap of 20 um is enough for this.
"""

import brinell
import judge
import mujoco
import numpy as np

MASS, LENGTH, GRAVITY = 32.8e-3, 0.12, 9.81  # kg, m, m/s^2
LIFT, GAP, STEP, END = 0.045, 50e-6, 1e-3, 3.0  # m, m between the balls at rest, s, s
PIECE = 1e-4  # s; longer than an impact, but shorter pieces for balls that touch each other at rest


def pull(place):
    """The accelerations by gravity [m/s^2] at positions along the arcs [m]."""
    return -GRAVITY * np.sin(place / LENGTH)


def swing(path, gap=GAP, piece=PIECE, end=END):
    """Times, positions along the arcs and speeds; the first ball is lifted."""
    # within a step the balls move along lines: `place` is the start of a line, even if it is valid only later
    place, speed, done, rows = np.zeros(5), np.zeros(5), np.zeros(4), []
    place[0] = -LIFT
    contacts = [brinell.Contact(path, initial_gap=gap - place[index]) for index in range(4)]
    balances = [judge.Balance(contact) for contact in contacts]

    def run(index, until):
        """Runs a contact up to `until` [s] within the step, and applies its impulse to both balls."""
        if not (0 <= index < 4 and until > done[index]):
            return
        h, closing = until - done[index], speed[index] - speed[index + 1]
        force, done[index] = contacts[index].step(h, closing), until
        change = h * force / MASS
        balances[index].step(h, MASS / 2.0, force, closing, closing - 2.0 * change)
        if force > 0.0:
            # the FMU knows the distance at the end; the centre of the two has moved on
            apart = until * (closing - 2.0 * change) - contacts[index]["indentation"] - gap
            way = (place[index + 1] - place[index] - apart) / 2.0
            for neighbour in (index - 1, index + 1):
                run(neighbour, way / change)  # where the old and the new line of a ball meet
            place[index : index + 2] += [way, -way]
            speed[index : index + 2] += [-change, change]

    for time in STEP * np.arange(round(end / STEP)):
        rows.append([time, *place, *speed])
        speed += STEP / 2.0 * pull(place)
        done[:] = 0.0
        while (late := np.flatnonzero(done < STEP)).size:
            distance = gap + np.diff(place) + done * np.diff(speed)
            touch = done + np.maximum(distance, 0.0) / np.maximum(-np.diff(speed), 1e-30)
            first = late[np.argmin(touch[late])]
            run(first, min(STEP, touch[first] + piece))
        place += STEP * speed
        speed += STEP / 2.0 * pull(place)
    balances[0].told(*balances[1:])
    return np.array(rows).T


def soft():
    """Times and positions with MuJoCo's own contact and default settings."""
    ball = (
        '<body pos="{} 0 0"><joint axis="0 -1 0" pos="0 0 {}"/>'
        '<geom size="10e-3" mass="{}" condim="1"/></body>'
    )
    row = "".join(ball.format(index * (20e-3 + GAP), LENGTH, MASS) for index in range(5))
    option = f'<option timestep="{STEP}" gravity="0 0 {-GRAVITY}"/>'
    model = mujoco.MjModel.from_xml_string(
        f"<mujoco>{option}<worldbody>{row}</worldbody></mujoco>"
    )
    data, rows = mujoco.MjData(model), []
    data.qpos[0] = -LIFT / LENGTH
    while data.time < END - STEP / 2.0:
        rows.append((data.time, *(LENGTH * data.qpos)))
        mujoco.mj_step(model, data)
    return np.array(rows).T


def drawn(place):
    """The lines from pivot to ball for all balls and times, for the animation."""
    pivot = np.arange(5) * (20e-3 + GAP) + np.zeros((place.shape[1], 1))
    x, z = pivot + LENGTH * np.sin(place.T / LENGTH), -LENGTH * np.cos(place.T / LENGTH)
    return np.stack([np.stack([pivot, x], -1), np.stack([np.zeros_like(z), z], -1)], -1)


if __name__ == "__main__":
    path = judge.unit("cradle")
    rows, own = swing(path), soft()
    first = np.flatnonzero(rows[7])[0] - 1  # before the second ball moves
    fine = judge.row(path, rows[1:, first], GAP, MASS, pull, 1e-7)
    wave = rows[1:, first + 2]
    judge.agree("speeds after a wave against steps of 0.1 us [m/s]", wave[5:], fine[1], 1e-5)
    judge.agree("places after a wave against steps of 0.1 us [m]", wave[:5], fine[0], 1e-7)
    print(f"speeds after a wave: {wave[5:].round(5)} m/s")
    judge.picture(
        "Newton's cradle, 1 ms steps",
        [
            (rows[0], 1e3 * rows[1], "first ball", "-"),
            (rows[0], 1e3 * rows[3], "ball in the middle", "-"),
            (rows[0], 1e3 * rows[5], "last ball", "-"),
            (own[0], 1e3 * own[5], "last ball, MuJoCo's own contact", "--"),
        ],
        y="way along the arc [mm]",
    )
    judge.animation(
        [("contacts by the unit", drawn(rows[1:6])), ("MuJoCo's own contact", drawn(own[1:]))],
        seconds=END,
        size=10,
    )
