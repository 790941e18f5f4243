"""Inputs: values that are not finite are rejected, and no input leads to an output that is not finite."""

import ctypes
import math

import pytest
from unit import DISCARD, ERROR, OK, Refused, bits, paths, unit

every_unit = pytest.mark.parametrize("name", sorted(paths()))
every_unit_with_held_rate = pytest.mark.parametrize("name", [name for name in sorted(paths()) if not unit(name).knows_mass()])


@every_unit
@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_an_input_that_is_not_finite_is_refused(name, value):
    instance = unit(name).ready()
    instance.step(1e-6, 0.5)
    assert instance.try_set("indentation_rate", value) in (DISCARD, ERROR)
    assert "indentation_rate" in instance.log[0][3]
    # the old value remains
    assert instance.get("indentation_rate") == 0.5
    assert all(math.isfinite(output) for output in instance.outputs().values())


@every_unit
@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("size", [1e308, 1.7976931348623157e308, 1e200, 1e105, 1e99, 1e30, 1e12])
def test_a_huge_input_gives_finite_outputs_or_an_error(name, size, sign):
    for step in (1e-6, 1.0, 1e6):
        instance = unit(name).ready()
        instance.step(1e-6, 0.5)
        status = instance.try_set("indentation_rate", sign * size)
        before = {key: bits(value) for key, value in instance.outputs().items()}
        if status == OK:
            status = instance.try_step(instance.time, step)
        assert status in (OK, ERROR)
        outputs = instance.outputs()
        assert all(math.isfinite(output) for output in outputs.values()), outputs
        if status == ERROR:
            assert instance.log != []
            assert {key: bits(value) for key, value in outputs.items()} == before, "a refused step changes nothing"


@every_unit
def test_a_rate_beyond_all_reason_is_an_error(name):
    instance = unit(name).ready()
    assert instance.try_set("indentation_rate", 1e308) == ERROR
    assert "indentation_rate = 1e308 is out of range: allowed is -1e40 to 1e40 m/s" in instance.log[0][3]


@every_unit_with_held_rate
def test_a_huge_indentation_has_finite_outputs_and_no_step_goes_on_from_it(name):
    instance = unit(name).ready()
    instance.step(1.0, 1e20)
    names = [name for name in ("indentation", "dissipated_energy") if name in instance.outputs()]
    before = [instance.get(name) for name in names]
    assert all(math.isfinite(output) for output in instance.outputs().values())
    with pytest.raises(Refused, match="the size of the smaller body: no contact law holds"):
        instance.step(1.0, -2e20)
    assert [instance.get(name) for name in names] == before


@every_unit
@pytest.mark.parametrize("value", [5e-324, -5e-324, 1e-310, 0.0, -0.0])
def test_denormal_and_zero_inputs_are_harmless(name, value):
    instance = unit(name).ready()
    instance.step(1e-6, 0.5)
    force = instance.get("force")
    instance.step(1e-6, value)
    # a rate-dependent law pushes less at rest, and a mass known to the FMU continues to move
    follows = any(unknown.dependencies for unknown in unit(name).description.outputs) or unit(name).knows_mass()
    assert instance.get("force") == force or (follows and 0.0 < instance.get("force") < force)
    assert instance.log == []


@every_unit
def test_a_refused_array_sets_nothing(name):
    parameters = unit(name).parameters
    if not parameters:
        pytest.skip("the input alone can be set")
    instance = unit(name).instance()
    instance.setup()
    instance.call("EnterInitializationMode")
    references = [unit(name).reference[key] for key in ("indentation_rate", parameters[0])]
    values = (ctypes.c_double * 2)(0.125, math.nan)
    assert instance.try_("SetReal", (ctypes.c_uint * 2)(*references), 2, values) in (DISCARD, ERROR)
    assert instance.get("indentation_rate") == 0.0
