"""A ball rolls down a ramp that vibrates along its normal, and slips whenever it is pressed too little.

    pip install matplotlib ./python
    python examples/ramp.py [PICTURE.svg]

Rolling takes a friction of 2/7 of the weight along the ramp. The vibration takes so much of the
normal force in each period that friction is too weak for that, and the spin falls behind.
"""

from math import cos, pi, sin

import brinell
import judge
import numpy as np

MASS, RADIUS, GRAVITY, FRICTION = 0.17, 28.6e-3, 9.81, 0.2  # kg, m, m/s^2, 1
SLOPE, FREQUENCY, SHAKE, STEP, END = 0.5, 25.0, 6.0, 2e-5, 1.0  # rad, Hz, m/s^2, s, s
INERTIA, WEIGHT = 0.4 * MASS * RADIUS**2, (GRAVITY * sin(SLOPE), GRAVITY * cos(SLOPE))


def shaken(time):
    """Acceleration of the ramp towards the ball [m/s^2]; it grows over the first tenth of a second."""
    return SHAKE * min(1.0, time / 0.1) ** 2 * sin(2.0 * pi * FREQUENCY * time)


def roll(path):
    """Times, speeds of the centre, speeds of the surface by spin, normal and tangential forces."""
    closing, speed, spin, work, rows = 0.0, 0.0, 0.0, 0.0, []
    with brinell.Contact(path, initial_gap=-judge.sunk(path, MASS * WEIGHT[1])) as ramp:
        balance = Balance(ramp)
        for step in range(round(END / STEP)):
            force = ramp.step(STEP, closing, tangential_rate=speed - RADIUS * spin)
            pull, time = ramp["tangential_force"], (step + 1) * STEP
            before = closing, speed
            closing += STEP * (WEIGHT[1] + shaken(time) - force / MASS)
            speed += STEP * (WEIGHT[0] - pull / MASS)
            spin += STEP * pull * RADIUS / INERTIA
            work += 0.5 * STEP * MASS * (WEIGHT[0] * (speed + before[1]))
            work += 0.5 * STEP * MASS * ((WEIGHT[1] + shaken(time)) * (closing + before[0]))
            rows.append((time, speed, RADIUS * spin, force, pull))
        balance.motion = closing, speed, spin
        balance.told(work)
    return np.array(rows).T


class Balance(judge.Friction):
    """The kinetic energy of the ball, seen from the ramp."""

    motion = 0.0, 0.0, 0.0

    def kinetic(self):
        closing, speed, spin = self.motion
        return 0.5 * (MASS * (closing**2 + speed**2) + INERTIA * spin**2)


def rigid(h=1e-5):
    """Times and speeds of the centre and of the surface of a rigid ball with Coulomb's friction."""
    speed, surface, rows = 0.0, 0.0, []
    for step in range(round(END / h)):
        time = step * h
        limit = FRICTION * (WEIGHT[1] + shaken(time))
        # what would keep the ball rolling, or bring it to roll within the step
        needed = (WEIGHT[0] + (speed - surface) / h) / 3.5
        pull = min(max(needed, -limit), limit)
        speed, surface = speed + h * (WEIGHT[0] - pull), surface + h * 2.5 * pull
        rows.append((time, speed, surface))
    return np.array(rows).T


if __name__ == "__main__":
    time, speed, surface, force, pull = roll(judge.unit("billiard"))
    other = rigid()
    judge.agree("speed against rigid bodies [m/s]", speed, np.interp(time, other[0], other[1]), 2e-2)
    judge.agree("Coulomb's bound [N]", np.maximum(abs(pull) - FRICTION * force, 0.0), 0.0, 1e-12)
    print(f"speed at the end {speed[-1]:.3f} m/s, of the surface {surface[-1]:.3f} m/s; without vibration {5.0 / 7.0 * WEIGHT[0] * END:.3f} m/s")
    judge.picture(
        "Ball on a ramp that vibrates along its normal",
        [
            (time, speed - surface, "with the unit", "-"),
            (other[0], other[1] - other[2], "rigid bodies", "--"),
        ],
        y="slip speed [m/s]",
    )
