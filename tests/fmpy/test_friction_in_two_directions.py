"""An FMU with friction in two directions: its description, and impacts of a ball with any spin."""

from math import cos, hypot, pi, sin

import pytest
from unit import unit

PLANE = unit("two_directions")
RADIUS, MASS, STEP, FRICTION = 5e-3, 4.11e-3, 1e-7, 0.3  # m, kg, s


def impact(instance, velocity, spin, at_each=lambda instance: None):
    """Velocities of the centre [m/s] and those of the contact point by spin [m/s] after an impact at 1 m/s. The vectors
    lie in the plane of the contact."""
    (x, y), (u, v), normal = velocity, spin, 1.0
    while True:
        instance.set(**{"indentation_rate": normal, "tangential_rate[1]": x + u, "tangential_rate[2]": y + v})
        instance.step(STEP)
        force, pulls = instance.get("force"), [instance.get(f"tangential_force[{axis}]") for axis in (1, 2)]
        at_each(instance)
        assert hypot(*pulls) <= FRICTION * force * (1.0 + 1e-9)
        normal -= STEP * force / MASS
        x, y = (speed - STEP * pull / MASS for speed, pull in zip((x, y), pulls, strict=True))
        u, v = (speed - 2.5 * STEP * pull / MASS for speed, pull in zip((u, v), pulls, strict=True))
        if force == 0.0:
            return x, y, u, v


@pytest.mark.parametrize("angle", [0.3, 0.5 * pi, 2.0, pi, 4.0])
def test_a_rotated_impact_is_the_rotated_one(angle):
    def rotated(x, y):
        return cos(angle) * x - sin(angle) * y, sin(angle) * x + cos(angle) * y

    velocity, spin = (0.4, 0.0), (-0.3, 0.8)
    x, y, u, v = impact(PLANE.ready(), velocity, spin)
    assert abs(y) > 1e-3, "the spin across the motion turns the ball aside"
    found = impact(PLANE.ready(), rotated(*velocity), rotated(*spin))
    assert found == pytest.approx((*rotated(x, y), *rotated(u, v)), abs=1e-4)


def test_a_free_ball_keeps_its_angular_momentum_about_the_contact_point():
    before = (0.4, 0.1, -0.3, 0.8)
    x, y, u, v = impact(PLANE.ready(), before[:2], before[2:])
    assert (x - u / 2.5, y - v / 2.5) == pytest.approx((0.4 + 0.3 / 2.5, 0.1 - 0.8 / 2.5), abs=1e-12)


def test_a_restored_impact_ends_with_the_same_bits():
    copy = PLANE.ready()

    def through_bytes(instance):
        copy.restore(instance.state())
        for name in PLANE.outputs:
            assert copy.get(name) == instance.get(name), name
        instance.restore(copy.state())

    path = (0.2, -0.1), (0.3, 0.4)
    assert impact(PLANE.ready(), *path, at_each=through_bytes) == impact(PLANE.ready(), *path)


def test_the_description_says_what_depends_on_what():
    def inputs(name):
        variable = PLANE.variables[name]
        output = next(it for it in PLANE.description.outputs if it.variable is variable)
        return [it.name for it in output.dependencies]

    for axis in (1, 2):
        assert inputs(f"tangential_force[{axis}]") == []
        expected = ["indentation_rate", "tangential_rate[1]", "tangential_rate[2]"]
        assert inputs(f"predicted_tangential_force[{axis}]") == expected
        assert PLANE.variables[f"tangential_rate[{axis}]"].causality == "input"
    assert PLANE.description.variableNamingConvention == "structured"
    assert "tangential_rate" not in PLANE.variables
