"""What follows the rate at the same instant is what the model description says: the force of a damping or a loss, but not that of bodies
with a speed of their own, nor of a plate that gives way."""

import pytest
from unit import paths, unit


def following(name):
    outputs = unit(name).description.outputs
    return {it.variable.name for it in outputs if "indentation_rate" in {known.name for known in it.dependencies}}


@pytest.mark.parametrize("name", sorted(paths()))
def test_a_new_rate_changes_what_is_declared_without_a_step_and_nothing_else(name):
    held = not name.endswith("_moved") and name != "plate_held"
    declared = following(name) - {"predicted_force"}
    assert declared == ({"force", "mean_pressure", "stiffness"} & set(unit(name).outputs) if held else set())
    instance = unit(name).ready()
    instance.step(4e-6, 0.5)
    before = instance.outputs()
    instance.set(indentation_rate=0.1)
    after = instance.outputs()
    assert (after["force"] < before["force"]) == held
    assert {key for key in before if after[key] != before[key]} <= following(name)
    instance.set(indentation_rate=0.5)
    assert instance.outputs() == before
    # the surface does not pull
    instance.set(indentation_rate=-1e6)
    assert instance.get("force") >= 0.0
    if "stiffness" in before:
        assert (instance.get("force"), instance.get("stiffness")) == (0.0, 0.0)
