"""FMUs with friction: their description, and oblique impacts of a free ball that the importer moves and turns."""

from math import cos, hypot, pi, radians, sin
from pathlib import Path

import pytest
from unit import unit

FRICTION, PLANE = unit("oblique"), unit("two_directions")
RADIUS, SPEED = 2.5e-3, 3.9  # m, m/s
MASS = 4.0 / 3.0 * pi * RADIUS**3 * 4000.0  # kg
INERTIA = 0.4 * MASS * RADIUS**2  # kg.m^2
TABLES = Path(__file__).parents[2] / "data/truth/friction/tables.csv"


def rows(case, limit):
    """The impacts of this case in the table, with springs in a list of this length."""
    lines = [line.split(",") for line in TABLES.read_text().splitlines() if line.startswith("impact,")]
    chosen = [line for line in lines if line[1] == case and int(line[4]) == limit]
    return [[float(field) if field else None for field in line[2:]] for line in chosen]


def impact(instance, degrees, step, sign=1.0):
    """Tangential restitution and spin [rad/s]."""
    angle = radians(degrees)
    normal, tangential, spin = SPEED * cos(angle), sign * SPEED * sin(angle), 0.0
    before = tangential
    while True:
        instance.set(indentation_rate=normal, tangential_rate=tangential + spin * RADIUS)
        instance.step(step)
        force, pull = instance.get("force"), instance.get("tangential_force")
        normal -= step * force / MASS
        tangential -= step * pull / MASS
        spin -= step * pull * RADIUS / INERTIA
        if force == 0.0:
            return tangential / before if before else None, spin


@pytest.mark.parametrize("row", rows("kharaz", 0), ids=lambda row: f"{row[0]:.1f}")
def test_a_free_ball_rebounds_as_in_the_table(row):
    """The table has a list of springs without an end, the FMU one of sixteen segments."""
    degrees, step, _, _, restitution, spin = row[:6]
    found = impact(FRICTION.ready(), degrees, step)
    assert found[1] == pytest.approx(spin, rel=3e-5, abs=1e-9)
    if restitution is not None:
        assert found[0] == pytest.approx(restitution, abs=2e-5)
        mirrored = impact(FRICTION.ready(), degrees, step, -1.0)
        assert (found[0].hex(), found[1].hex()) == (mirrored[0].hex(), (-mirrored[1]).hex())


def collide(velocity, spin, mass=4.11e-3, step=1e-7):
    """Velocities of the centre [m/s] and those of the contact point by spin [m/s] after an impact at 1 m/s. The vectors
    lie in the plane of the contact."""
    instance, copy = PLANE.ready(), PLANE.ready()
    (x, y), (u, v), normal = velocity, spin, 1.0
    while True:
        instance.set(**{"indentation_rate": normal, "tangential_rate[1]": x + u, "tangential_rate[2]": y + v})
        instance.step(step)
        force, pulls = instance.get("force"), [instance.get(f"tangential_force[{axis}]") for axis in (1, 2)]
        assert hypot(*pulls) <= 0.3 * force * (1.0 + 1e-9)
        # a restored state goes on with the same bits
        copy.restore(instance.state())
        assert copy.outputs() == instance.outputs()
        copy.time, instance, copy = instance.time, copy, instance
        normal -= step * force / mass
        x, y = (speed - step * pull / mass for speed, pull in zip((x, y), pulls, strict=True))
        u, v = (speed - 2.5 * step * pull / mass for speed, pull in zip((u, v), pulls, strict=True))
        if force == 0.0:
            return x, y, u, v


@pytest.mark.parametrize("angle", [0.3, 0.5 * pi, 2.0, pi, 4.0])
def test_a_rotated_impact_is_the_rotated_one_and_keeps_its_angular_momentum(angle):
    def rotated(x, y):
        return cos(angle) * x - sin(angle) * y, sin(angle) * x + cos(angle) * y

    velocity, spin = (0.4, 0.0), (-0.3, 0.8)
    x, y, u, v = collide(velocity, spin)
    assert abs(y) > 1e-3, "the spin across the motion turns the ball aside"
    # about the contact point
    assert (x - u / 2.5, y - v / 2.5) == pytest.approx((0.4 + 0.3 / 2.5, 0.0 - 0.8 / 2.5), abs=1e-12)
    assert collide(rotated(*velocity), rotated(*spin)) == pytest.approx((*rotated(x, y), *rotated(u, v)), abs=1e-4)


@pytest.mark.parametrize("made, axes", [(FRICTION, [""]), (PLANE, ["[1]", "[2]"])])
def test_the_description_says_what_depends_on_what(made, axes):
    dependencies = {it.variable.name: [known.name for known in it.dependencies] for it in made.description.outputs}
    rates = [f"tangential_rate{axis}" for axis in axes]
    predictions = [f"predicted_tangential_force{axis}" for axis in axes]
    for name, inputs in dependencies.items():
        assert inputs == (["indentation_rate", *rates] if name in predictions else []), name
    assert {f"tangential_force{axis}" for axis in axes} | {*predictions} <= dependencies.keys()
    for rate in rates:
        variable = made.variables[rate]
        assert (variable.causality, variable.unit, float(variable.start)) == ("input", "m/s", 0.0)
    coefficient = made.variables["friction.coefficient"]
    assert (coefficient.causality, coefficient.variability) == ("parameter", "fixed")
    assert (float(coefficient.min), float(coefficient.max)) == (0.0, 10.0)


def test_a_scene_without_friction_has_none_of_its_variables():
    names = " ".join(unit("steel_ball").variables)
    assert "tangential" not in names and "friction" not in names and "sliding" not in names
    library = next((Path(unit("steel_ball").folder) / "binaries").glob("*/*"))
    assert b"tangential" not in library.read_bytes()


def test_simulate_fmu_runs_it():
    import fmpy
    import numpy as np

    stop, step = 4e-6, 1e-7
    dtype = [("time", float), ("indentation_rate", float), ("tangential_rate", float)]
    signals = np.array([(0.0, 2.0, 0.1), (stop, 2.0, 0.1)], dtype=dtype)
    outputs = ["force", "tangential_force", "sliding"]
    result = fmpy.simulate_fmu(
        FRICTION.path, stop_time=stop, step_size=step, output_interval=step, input=signals, output=outputs
    )
    assert result["tangential_force"][-1] > 0.0
    assert all(result["tangential_force"] <= 0.092 * result["force"] * (1.0 + 1e-12))
    # a constant ratio of the rates below the coefficient: no part slips
    assert list(result["sliding"][2:]) == [1] * (len(result) - 2)
    assert [item.name for item in FRICTION.variables["sliding"].declaredType.items] == ["apart", "stick", "partial_slip", "sliding"]
