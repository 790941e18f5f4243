"""A billiard ball with backspin slides over the bed, stops, and rolls back: a draw shot.

    pip install matplotlib ./python
    python examples/billiard.py [PICTURE.svg]

The ball presses on the bed with its weight. Backspin and speed are lost to sliding friction until the
ball rolls; then the contact sticks, and nothing is lost any more.
"""

import brinell
import judge
import numpy as np

MASS, RADIUS, GRAVITY, FRICTION = 0.17, 28.6e-3, 9.81, 0.2  # kg, m, m/s^2, 1
SPEED, SPIN, STEP, END = 0.8, -120.0, 2e-5, 1.5  # m/s, rad/s (negative: backspin), s, s
INERTIA = 0.4 * MASS * RADIUS**2


def roll(path):
    """Times, speeds of the centre, speeds of the surface by spin, and slip states."""
    down, speed, spin, rows = 0.0, SPEED, SPIN, []
    with brinell.Contact(path, initial_gap=-judge.sunk(path, MASS * GRAVITY)) as bed:
        balance = Balance(bed)
        for step in range(round(END / STEP)):
            # of the lowest point: it moves with the centre and against the spin
            force = bed.step(STEP, down, tangential_rate=speed - RADIUS * spin)
            pull = bed["tangential_force"]
            down += STEP * (GRAVITY - force / MASS)
            speed -= STEP * pull / MASS
            spin += STEP * pull * RADIUS / INERTIA
            rows.append((step * STEP, speed, RADIUS * spin, bed["sliding"]))
        # the force that begins to slide does so in the middle of a step: an error of first order
        balance.motion = down, speed, spin
        balance.told(allowed=1e-4)
    return np.array(rows).T


class Balance(judge.Friction):
    """The kinetic energy of the ball."""

    motion = 0.0, SPEED, SPIN

    def kinetic(self):
        down, speed, spin = self.motion
        return 0.5 * (MASS * (down**2 + speed**2) + INERTIA * spin**2)


if __name__ == "__main__":
    time, speed, surface, state = roll(judge.unit("billiard"))
    # rigid bodies: uniform deceleration until the ball rolls
    rolling = (5.0 * SPEED + 2.0 * RADIUS * SPIN) / 7.0
    begin = 2.0 * (SPEED - RADIUS * SPIN) / (7.0 * FRICTION * GRAVITY)
    rigid = np.where(time < begin, SPEED - FRICTION * GRAVITY * time, rolling)
    judge.agree("speed against rigid bodies [m/s]", speed, rigid, 5e-3)
    judge.agree("mean speed of the rolling ball [m/s]", speed[time > begin + 0.1].mean(), rolling, 1e-4)
    judge.agree("end of sliding [s]", time[state == 3].max(), begin, 1e-3)
    print(f"the ball comes at {SPEED} m/s and leaves at {speed[-1]:.3f} m/s")
    judge.picture(
        "Billiard ball with backspin",
        [
            (time, speed, "centre", "-"),
            (time, surface, "surface, by its spin", "--"),
            (time[::3000], rigid[::3000], "centre, rigid bodies", "."),
        ],
        y="speed [m/s]",
    )
