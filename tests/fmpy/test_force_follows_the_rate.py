"""Rate-dependent laws: the force depends on the input at the same instant, as the model description declares."""

import math

import pytest
from unit import paths, unit

every_unit = pytest.mark.parametrize("name", sorted(paths()))
FOLLOWING = {"force", "mean_pressure", "stiffness"}


def pressed(name, rate=0.5):
    instance = unit(name).ready()
    instance.step(4e-6, rate)
    return instance


@every_unit
def test_a_new_rate_changes_what_is_declared_without_a_step_and_nothing_else(name):
    for unknown in unit(name).description.outputs:
        expected = {"indentation_rate"} if unknown.variable.name in FOLLOWING else set()
        assert {dependency.name for dependency in unknown.dependencies} == expected, unknown.variable.name
    instance = pressed(name)
    before = instance.outputs()
    instance.set(indentation_rate=0.1)
    after = instance.outputs()
    assert after["force"] < before["force"]
    assert {key for key in before if after[key] != before[key]} <= FOLLOWING
    instance.set(indentation_rate=0.5)
    assert instance.outputs() == before
    # the surface does not pull
    instance.set(indentation_rate=-1e6)
    assert (instance.get("force"), instance.get("stiffness")) == (0.0, 0.0)


@every_unit
def test_the_force_without_motion_is_the_elastic_one_and_gives_the_energy(name):
    instance = pressed(name, rate=1.0)
    instance.set(indentation_rate=0.0)
    energy, elastic, pieces = 0.0, instance.get("elastic_energy"), 2000
    step, last = instance.get("indentation") / pieces, instance.get("force")
    for _ in range(pieces):
        instance.step(1.0, -step)
        instance.set(indentation_rate=0.0)
        force = instance.get("force")
        energy += 0.5 * (last + force) * step
        last = force
    assert energy == pytest.approx(elastic, rel=1e-4)


@every_unit
def test_heat_is_work_less_elastic_energy_and_never_falls(name):
    instance = unit(name).ready()
    heat = 0.0
    for step in range(400):
        instance.step(1e-7, 0.6 * math.cos(0.05 * step))
        outputs = instance.outputs()
        assert outputs["dissipated_energy"] >= heat
        heat = outputs["dissipated_energy"]
        assert outputs["work"] == pytest.approx(outputs["elastic_energy"] + heat, rel=1e-14)
    assert heat > 0.0


@pytest.mark.parametrize("name", [name for name in sorted(paths()) if "restitution" in unit(name).parameters])
def test_the_restitution_asked_for_is_a_parameter(name):
    forces = []
    for restitution in (0.9, 0.5, 0.2):
        instance = unit(name).ready(restitution=restitution)
        instance.step(4e-6, 0.5)
        forces.append(instance.get("force"))
    assert forces == sorted(forces) and len(set(forces)) == 3, "less restitution, more damping"
