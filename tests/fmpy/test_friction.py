"""An FMU with friction: its description, and oblique impacts of a free ball that the importer moves and turns."""

from math import cos, pi, radians, sin
from pathlib import Path

import pytest
from unit import unit

FRICTION = unit("oblique")
RADIUS, SPEED = 2.5e-3, 3.9  # m, m/s
MASS = 4.0 / 3.0 * pi * RADIUS**3 * 4000.0  # kg
INERTIA = 0.4 * MASS * RADIUS**2  # kg.m^2
TABLES = Path(__file__).parents[2] / "data/truth/friction/tables.csv"


def rows(case, limit):
    """The impacts of this case in the table, with springs in a list of this length."""
    lines = [line.split(",") for line in TABLES.read_text().splitlines() if line.startswith("impact,")]
    chosen = [line for line in lines if line[1] == case and int(line[4]) == limit]
    return [[float(field) if field else None for field in line[2:]] for line in chosen]


def impact(instance, degrees, step, sign=1.0, at_each=lambda instance: None):
    """Tangential restitution and spin [rad/s]."""
    angle = radians(degrees)
    normal, tangential, spin = SPEED * cos(angle), sign * SPEED * sin(angle), 0.0
    before = tangential
    while True:
        instance.set(indentation_rate=normal, tangential_rate=tangential + spin * RADIUS)
        instance.step(step)
        force, pull = instance.get("force"), instance.get("tangential_force")
        at_each(instance)
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


@pytest.mark.parametrize("degrees", [3.0, 20.0, 60.0])
def test_the_mirror_image_has_the_same_bits(degrees):
    one, other = (impact(FRICTION.ready(), degrees, 5e-8, sign) for sign in (1.0, -1.0))
    assert (one[0].hex(), one[1].hex()) == (other[0].hex(), (-other[1]).hex())


def test_a_restored_impact_ends_with_the_same_bits():
    copy = FRICTION.ready()

    def through_bytes(instance):
        copy.restore(instance.state())
        for name in FRICTION.outputs:
            assert copy.get(name) == instance.get(name), name
        instance.restore(copy.state())

    assert impact(FRICTION.ready(), 10.0, 1e-7, at_each=through_bytes) == impact(FRICTION.ready(), 10.0, 1e-7)


def test_the_description_says_what_depends_on_what():
    def inputs(name):
        variable = FRICTION.variables[name]
        output = next(it for it in FRICTION.description.outputs if it.variable is variable)
        return [it.name for it in output.dependencies]

    for name in ("tangential_force", "mean_tangential_force", "tangential_energy", "friction_work", "stick_radius", "sliding"):
        assert inputs(name) == [], name
    assert inputs("predicted_tangential_force") == ["indentation_rate", "tangential_rate"]
    rate, coefficient = FRICTION.variables["tangential_rate"], FRICTION.variables["friction.coefficient"]
    assert (rate.causality, rate.unit, float(rate.start)) == ("input", "m/s", 0.0)
    assert (coefficient.causality, coefficient.variability) == ("parameter", "fixed")
    assert (float(coefficient.start), float(coefficient.min), float(coefficient.max)) == (0.092, 0.0, 10.0)
    items = FRICTION.variables["sliding"].declaredType.items
    assert [item.name for item in items] == ["apart", "stick", "partial_slip", "sliding"]


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
