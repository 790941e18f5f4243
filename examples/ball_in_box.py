"""A ball flies through a box and loses its energy at four walls, one FMU with four contacts, in
steps of a millisecond.

    pip install matplotlib ./python
    python examples/ball_in_box.py [PICTURE.svg]

After an impact, the position comes from the wall that was hit; the other walls get it as their gap.
"""

import brinell
import judge
import numpy as np

MASS, GRAVITY, STEP, END = 4e-3, np.array([0.0, -9.81]), 1e-3, 1.5  # kg, m/s^2, s, s
SIZE = np.array([0.1, 0.06])  # m, the range of the ball's centre
INTO = np.array([[-1.0, 0.0], [1.0, 0.0], [0.0, -1.0], [0.0, 1.0]])  # left, right, floor, ceiling
START, SPEED = np.array([0.03, 0.03]), np.array([1.3, 0.7])  # m, m/s


def gaps(place):
    """The distances to the walls [m]."""
    return np.array([place[0], SIZE[0] - place[0], place[1], SIZE[1] - place[1]])


def fly(path, h):
    """Times, positions and speeds."""
    place, speed, rows = START.copy(), SPEED.copy(), []
    with brinell.Contact(path, initial_gap=gaps(place)) as contact:
        balances = [judge.Balance(contact, name) for name in contact.contacts]
        for step in range(round(END / h)):
            rows.append([step * h, *place, *speed])
            closing, pull = INTO @ speed, INTO @ GRAVITY
            forces = contact.step(h, closing, pull, gap=gaps(place))
            place += h * (speed + 0.5 * h * GRAVITY)
            speed -= h / MASS * (INTO.T @ forces)
            for index, balance in enumerate(balances):
                balance.step(
                    h, MASS, forces[index], closing[index], INTO[index] @ speed, pull[index]
                )
            for index in np.flatnonzero(forces):
                axis, far = divmod(index, 2)
                gap = -contact["indentation"][index]
                place[axis] = SIZE[axis] - gap if far else gap
            speed += h * GRAVITY
    balances[0].told(*balances[1:])
    return np.array(rows).T


if __name__ == "__main__":
    path = judge.unit("box")
    rows, fine = fly(path, STEP), fly(path, STEP / 10)
    # only the steps differ, and the walls do not depend on them
    judge.agree("speed, steps of 1 ms against 0.1 ms [m/s]", rows[3:], fine[3:, ::10], 1e-9)
    judge.agree("place, steps of 1 ms against 0.1 ms [m]", rows[1:3], fine[1:3, ::10], 1e-9)
    judge.picture(
        "A steel ball in a box: steel left, floor and ceiling, aluminium right",
        [
            (1e3 * fine[1], 1e3 * fine[2], "path", "-"),
            (*1e3 * rows[1:3, :30], "the first 30 steps of a millisecond", "."),
        ],
        x="x [mm]",
        y="y [mm]",
    )
