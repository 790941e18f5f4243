"""A crate on a slope in an FMU that moves its feet together, with friction, in steps of a millisecond: exact, and at rest at last."""

import numpy as np
import pytest
from unit import unit

MASS, INERTIA, SLOPE = 0.3, np.array([2e-4, 3e-4, 4e-4]), 0.1
GRAVITY = 9.81 * np.array([np.sin(SLOPE), 0.0, -np.cos(SLOPE)])
FEET = {"left": [0.03, 0.02, -0.015], "right": [0.03, -0.02, -0.015], "back": [-0.03, 0.0, -0.015]}
# normal, and the two tangents
AXES = np.array([[0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])


class Crate:
    """The crate above the slope. It turns so little that the directions and the arms of its feet stay."""

    def __init__(self, gap):
        self.instance = unit("slope").ready()
        rows = [(axis, np.cross(arm, axis)) for arm in FEET.values() for axis in AXES]
        self.moves, self.turns = (np.array(part) for part in zip(*rows, strict=True))
        self.speed, self.spin, self.place = np.zeros((3, 3))
        # one step that only moves the floor away
        self.speed[2] = gap / 1e-3
        self.step(1e-3, np.zeros(3))
        self.speed[:], self.place = 0.0, np.array([0.0, 0.0, gap])

    def read(self, *names):
        return np.array([self.instance.get(f"{foot}.{name}") for foot in FEET for name in names])

    def rows(self, normal, tangential):
        return self.read(normal, f"{tangential}[1]", f"{tangential}[2]")

    def step(self, h, pull=GRAVITY):
        rates = self.moves @ self.speed + self.turns @ self.spin
        inputs = {}
        for foot, own, other in zip(FEET, rates.reshape(3, 3), (self.moves @ pull).reshape(3, 3), strict=True):
            names = ("indentation_rate", "tangential_rate[1]", "tangential_rate[2]")
            inputs |= {f"{foot}.{name}": value for name, value in zip(names, own, strict=True)}
            names = ("external_acceleration", "external_tangential_acceleration[1]", "external_tangential_acceleration[2]")
            inputs |= {f"{foot}.{name}": value for name, value in zip(names, other, strict=True)}
        self.instance.set(**inputs)
        self.instance.step(h)
        force = self.rows("mean_force", "mean_tangential_force")
        moment = self.rows("impulse_moment", "tangential_impulse_moment")
        self.place += h * self.speed + 0.5 * h * h * pull - moment @ self.moves / MASS
        self.speed += h * pull - h * force @ self.moves / MASS
        self.spin -= h * force @ self.turns / INERTIA

    def energy(self):
        """Of the crate and of its feet [J]."""
        names = ("elastic_energy", "dissipated_energy", "tangential_energy", "friction_work")
        kinetic = 0.5 * (MASS * self.speed @ self.speed + INERTIA @ self.spin**2)
        return kinetic - MASS * GRAVITY @ self.place + self.read(*names).sum()


@pytest.mark.parametrize("h", [2e-4, 1e-3])
def test_a_crate_that_is_thrown_on_a_slope_keeps_its_energy_and_comes_to_rest(h):
    crate = Crate(1e-3)
    crate.speed[:2], crate.spin[2] = [-0.1, 0.05], 0.5
    begin = crate.energy()
    for _ in range(int(0.5 / h)):
        crate.step(h)
        told = crate.rows("closing_speed", "tangential_speed")
        assert told == pytest.approx(crate.moves @ crate.speed + crate.turns @ crate.spin, abs=1e-12)
    assert crate.energy() == pytest.approx(begin, rel=1e-8)
    assert np.abs([*crate.speed, *crate.spin]).max() < 1e-10
    # the feet carry the weight
    assert crate.rows("mean_force", "mean_tangential_force") @ crate.moves == pytest.approx(MASS * GRAVITY, rel=1e-9, abs=1e-10)
    before = [crate.read("indentation"), crate.place.copy()]
    for _ in range(1000):
        crate.step(h)
    assert crate.read("indentation") == pytest.approx(before[0], abs=1e-15)
    assert crate.place == pytest.approx(before[1], abs=1e-12)
    # it wakes when something changes
    crate.speed[2] = 0.05
    crate.step(h)
    assert np.all(crate.read("force") == 0.0) and np.all(crate.read("indentation") < 0.0)
