"""A stack in an FMU that moves its bodies together, in steps of a millisecond: exact, and at rest at last."""

import numpy as np
import pytest
from unit import unit

MASS, GRAVITY = 0.033, 9.81
CONTACTS = ("floor", "pair")


class Stack:
    """Two balls above the ground, moved by the impulses of the FMU. Heights are those of their lowest points [m]."""

    def __init__(self, height):
        self.instance = unit("stack").ready()
        # downwards: the lower ball, the upper ball
        self.speed = np.zeros(2)
        self.place = np.zeros(2)
        self.drop(height)

    def read(self, name):
        return np.array([self.instance.get(f"{contact}.{name}") for contact in CONTACTS])

    def drop(self, height):
        """One step that only moves the floor away."""
        self.instance.set(**{"floor.indentation_rate": -height / 1e-3, "pair.indentation_rate": 0.0})
        self.instance.step(1e-3)
        self.place = np.array([-height, -height])

    def step(self, h):
        lower, upper = self.speed
        self.instance.set(**{
            "floor.indentation_rate": lower,
            "pair.indentation_rate": upper - lower,
            "floor.external_acceleration": GRAVITY,
            "pair.external_acceleration": 0.0,
        })
        self.instance.step(h)
        force, moment = self.read("mean_force"), self.read("impulse_moment")
        push = np.array([force[0] - force[1], force[1]]) * h / MASS
        shift = np.array([moment[0] - moment[1], moment[1]]) / MASS
        self.place += h * self.speed + 0.5 * h * h * GRAVITY - shift
        self.speed += h * GRAVITY - push

    def energy(self):
        """Of the balls, above the ground and at rest, and of the contacts [J]."""
        contacts = self.read("elastic_energy").sum() + self.read("dissipated_energy").sum()
        return 0.5 * MASS * (self.speed**2).sum() - MASS * GRAVITY * self.place.sum() + contacts


@pytest.mark.parametrize("h", [1e-4, 1e-3, 3e-3])
def test_a_dropped_stack_keeps_its_energy_and_comes_to_rest(h):
    stack = Stack(1e-3)
    begin = stack.energy()
    for _ in range(int(0.5 / h)):
        stack.step(h)
        # the energy of the fall, to the accuracy of some hundred impacts
        assert stack.energy() == pytest.approx(begin, rel=1e-8)
        depth = stack.read("indentation")
        distance = np.array([stack.place[0], stack.place[1] - stack.place[0]])
        assert distance == pytest.approx(depth, abs=1e-11)
    assert np.all(stack.speed == pytest.approx(0.0, abs=1e-12))
    assert stack.read("force") == pytest.approx([2 * MASS * GRAVITY, MASS * GRAVITY], rel=1e-5)
    # nothing drifts
    before = stack.read("indentation")
    for _ in range(1000):
        stack.step(h)
    assert stack.read("indentation") == pytest.approx(before, abs=1e-15)


def test_at_rest_it_wakes_when_something_changes():
    stack = Stack(1e-3)
    for _ in range(500):
        stack.step(1e-3)
    stack.speed[1] = -0.05
    stack.step(1e-3)
    assert stack.read("force")[1] == 0.0 and stack.read("indentation")[1] < 0.0
