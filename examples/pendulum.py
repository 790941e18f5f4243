"""A hammer on a pendulum falls against an anvil and rebounds until it rests, in steps of a millisecond.

    pip install matplotlib ./python
    python examples/pendulum.py [PICTURE.svg]

The restitution of the first blow is what a Leeb tester reads: here a hardness is seen in a swing.
"""

from math import cos, pi, sin, sqrt

import brinell
import judge
import numpy as np

LENGTH, MASS, GRAVITY, STEP, END = 0.3, 0.05, 9.81, 1e-3, 4.0  # m to the head, kg of the head, m/s^2, s, s
START = -40.0 * pi / 180.0  # the anvil touches the head where it hangs straight down


def swing(path, strength, h=STEP, laps=1):
    """Time, angle and angular speed; the largest speed against the anvil and the first one away from it."""
    # a point mass: what the force at the head moves is the mass of the head
    angle, speed, rows, blow, rebound = START, 0.0, [], 0.0, None
    with brinell.Contact(path, initial_gap=-LENGTH * START, effective_mass=MASS, target_yield_strength=strength) as contact:
        balance = judge.Balance(contact)
        for step in range(round(END / h)):
            rows.append((step * h, angle, speed))
            closing, pull = LENGTH * speed, -GRAVITY * sin(angle)
            if angle < -max(2.0 * speed * h, 0.02):
                # in free flight the pendulum says where it is
                angle, speed = flight(angle, speed, h)
                contact.fly(h, -LENGTH * angle)
                balance = balance.moved()
                continue
            force = contact.step(h, closing, pull)
            after = closing - force * h / MASS
            balance.step(h, MASS, closing, after, pull)
            if force > 0.0:
                blow = max(blow, closing)
                rebound = rebound or -(after + pull * h)
                angle, speed = contact["indentation"] / LENGTH, (after + pull * h) / LENGTH
            else:
                angle, speed = flight(angle, speed, h)
    return np.array(rows).T, balance


def flight(angle, speed, h):
    """One step of the classical Runge-Kutta method."""
    def slope(angle, speed):
        return np.array([speed, -GRAVITY / LENGTH * sin(angle)])

    state = np.array([angle, speed])
    first = slope(*state)
    second = slope(*(state + 0.5 * h * first))
    third = slope(*(state + 0.5 * h * second))
    fourth = slope(*(state + h * third))
    return tuple(state + h / 6.0 * (first + 2.0 * second + 2.0 * third + fourth))
