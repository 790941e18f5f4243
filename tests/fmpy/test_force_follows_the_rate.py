"""Rate-dependent laws: the force depends on the input at the same instant, as the model description declares."""

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


@pytest.mark.parametrize("name", [name for name in sorted(paths()) if "restitution" in unit(name).parameters])
def test_the_restitution_asked_for_is_a_parameter(name):
    forces = []
    for restitution in (0.9, 0.5, 0.2):
        instance = unit(name).ready(restitution=restitution)
        instance.step(4e-6, 0.5)
        forces.append(instance.get("force"))
    assert forces == sorted(forces) and len(set(forces)) == 3, "less restitution, more damping"
