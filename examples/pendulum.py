"""A hammer on a pendulum falls against an anvil and rebounds until it no longer yields, in steps of a
millisecond.

    pip install matplotlib ./python
    python examples/pendulum.py [PICTURE.svg]

The effective mass at the head is the moment of inertia over the square of the arm. The harder the
anvil, the higher the rebound. Every blow hits an untouched spot.
"""

from math import cos, pi, sin

import brinell
import judge
import numpy as np

ARM, HEAD, ROD, GRAVITY = 0.3, 0.05, 0.03, 9.81  # m, kg, kg, m/s^2
START, STEP, END = (
    -30.0 * pi / 180.0,
    1e-3,
    4.0,
)  # the anvil is where the pendulum hangs straight down
MASS = HEAD + ROD / 3.0  # effective, at the head [kg]
STRENGTHS = (200e6, 300e6, 900e6)  # of the anvil [Pa]


def pull(angle):
    """Acceleration of the head by gravity [m/s^2]."""
    return -GRAVITY * (HEAD + ROD / 2.0) / MASS * sin(angle)


def swing(path, strength, h):
    """Times, angles, speeds of the head before and after the step's impulse."""
    angle, speed, rows = START, 0.0, []
    with brinell.Contact(
        path, effective_mass=MASS, target_yield_strength=strength, initial_gap=-ARM * START
    ) as contact:
        balance = judge.Balance(contact)
        for step in range(round(END / h)):
            force = contact.step(h, speed, pull(angle), gap=-ARM * angle)
            after = speed - h * force / MASS
            balance.step(h, MASS, force, speed, after, pull(angle))
            rows.append((step * h, angle, speed, after))
            angle, speed = swung(angle, after, h)
            if force > 0.0:
                angle = contact["indentation"] / ARM
    balance.told()
    return np.array(rows).T


def swung(angle, speed, h):
    """Angle and speed of the head after a free swing of `h` [s], with the classical Runge-Kutta
    method."""

    def slope(state):
        return np.array([state[1] / ARM, pull(state[0])])

    state = np.array([angle, speed])
    first = slope(state)
    second = slope(state + 0.5 * h * first)
    third = slope(state + 0.5 * h * second)
    fourth = slope(state + h * third)
    return tuple(state + h / 6.0 * (first + 2.0 * second + 2.0 * third + fourth))


if __name__ == "__main__":
    path, lines = judge.unit("ball"), []
    fall = 2.0 * GRAVITY * ARM * (HEAD + ROD / 2.0) / MASS * (1.0 - cos(START))
    for strength in STRENGTHS:
        time, angle, before, after = swing(path, strength, STEP)
        blow = np.flatnonzero(before != after)[0]
        restitution = -after[blow] / before[blow]
        print(f"{strength / 1e6:.0f} MPa: {before[blow]:.4f} m/s, restitution {restitution:.6f}")
        judge.agree("speed of the first blow against the fall [m/s]", before[blow], fall**0.5, 1e-4)
        with brinell.Contact(path, effective_mass=MASS, target_yield_strength=strength) as alone:
            # the same blow with the FMU alone, in one step
            speed = before[blow]
            expected = 1e-3 * alone.step(1e-3, speed) / MASS / speed - 1.0
        judge.agree("restitution against the unit alone", restitution, expected, 1e-4)
        lines.append(
            (
                time,
                180.0 / pi * angle,
                f"{strength / 1e6:.0f} MPa, restitution {restitution:.3f}",
                "-",
            )
        )
    judge.picture(
        "Hammer pendulum, 1 ms steps: yield strength of the anvil", lines, y="angle [degrees]"
    )
