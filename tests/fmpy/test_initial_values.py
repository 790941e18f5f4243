"""Values before the first step: they equal those of the model description, and depend on the parameters listed there."""

import math

import pytest
from unit import bits, paths, unit

every_unit = pytest.mark.parametrize("name", sorted(paths()))


def initializing(name, **parameters):
    instance = unit(name).instance()
    instance.setup()
    instance.call("EnterInitializationMode")
    instance.set(**parameters)
    return instance


@every_unit
def test_start_values_are_those_of_the_xml_and_no_output_is_a_negative_zero(name):
    instance = initializing(name)
    starts = {key: float(it.start) for key, it in unit(name).variables.items() if it.start is not None}
    assert starts, "at least the input has a start value"
    for key, start in starts.items():
        assert bits(instance.get(key)) == bits(start), key
    # a gap of 0 must not give an indentation of -0.0
    gap = {"initial_gap": -0.0} if "initial_gap" in unit(name).parameters else {}
    for instance in (instance, initializing(name, **gap), unit(name).ready()):
        for key, value in instance.outputs().items():
            assert math.isfinite(value) and bits(value) != bits(-0.0), key


def dependencies(name):
    """The parameters on which each output depends before the first step, according to the model description."""
    return {
        unknown.variable.name: {dependency.name for dependency in unknown.dependencies}
        for unknown in unit(name).description.initialUnknowns
    }


def bases(name):
    """Initial parameters: indented from below yield up to fully plastic, because most outputs are zero while apart. With the output
    `regime` they are closer together than the smallest change of a parameter moves first yield, so that each affects it."""
    if "initial_gap" not in unit(name).parameters:
        return [{}]
    step = 1 if "regime" in unit(name).outputs else 10
    return [{"initial_gap": 1e-3}] + [{"initial_gap": -1e-8 * 1.04**power} for power in range(0, 240, step)]


def variations(name, key, base):
    start = base.get(key, float(unit(name).variables[key].start))
    if start == 0.0:
        return [1e-6, -1e-6]
    return [start * 0.9, min(start * 1.4, float(unit(name).variables[key].max))]


def changes(name):
    """For each parameter, the outputs that change with it for one of the bases, in Initialization Mode and after it."""
    changed = {key: set() for key in unit(name).parameters}
    for base in bases(name):
        reference = initializing(name, **base)
        before = reference.outputs()
        reference.call("ExitInitializationMode")
        after = reference.outputs()
        assert {key: bits(value) for key, value in before.items()} == {key: bits(value) for key, value in after.items()}
        for key in changed:
            for value in variations(name, key, base):
                varied = initializing(name, **{**base, key: value}).outputs()
                changed[key] |= {output for output in varied if bits(varied[output]) != bits(before[output])}
    return changed


def follows_rate(name):
    """Whether the law depends on the rate: outputs follow it, or do so before the bodies have a speed of their own, or a
    restitution gives its damping."""
    if "restitution" in unit(name).parameters:
        return True
    before = [unknown for unknown in unit(name).description.initialUnknowns if unknown.variable.name != "closing_speed"]
    inputs = {dependency.name for unknown in before for dependency in unknown.dependencies}
    return "indentation_rate" in inputs or any(unknown.dependencies for unknown in unit(name).description.outputs)


@every_unit
def test_initial_values_depend_on_exactly_what_the_model_description_lists(name):
    listed, changed = dependencies(name), changes(name)
    assert listed.keys() == set(unit(name).outputs)
    for output in listed:
        really = {key for key in changed if output in changed[key]}
        if output == "closing_speed":
            # a speed before the first step is the given one: see two tests further down
            really.add("indentation_rate")
        # the effect of the parameters of a rate-dependent law differs from law to law: the FMU may list too many
        assert really == listed[output] or (follows_rate(name) and really < listed[output]), output


@every_unit
def test_initial_outputs_follow_the_input_as_the_model_description_lists(name):
    listed = {output for output, knowns in dependencies(name).items() if "indentation_rate" in knowns}
    followed = set()
    for base in bases(name):
        instance = initializing(name, **base)
        before = instance.outputs()
        for rate in (0.5, -0.5):
            instance.set(indentation_rate=rate)
            set_in_initialization = instance.outputs()
            followed |= {output for output in before if set_in_initialization[output] != before[output]}
        instance.call("ExitInitializationMode")
        assert instance.outputs() == set_in_initialization
    assert followed == listed


@every_unit
def test_a_contact_that_starts_indented_shows_the_force_of_its_first_step(name):
    if "initial_gap" not in unit(name).parameters:
        pytest.skip("it starts apart")
    moves = "closing_speed" in unit(name).outputs
    for rate in (0.5, 1e-3, -1e-3):
        instance = initializing(name, initial_gap=-1e-6)
        instance.set(indentation_rate=rate)
        first = instance.get("force")
        instance.call("ExitInitializationMode")
        assert instance.get("force") == first
        instance.step(1e-13, rate)
        if rate > 0.0 or not moves:
            assert instance.get("force") == pytest.approx(first, rel=1e-5)
        instance.call("Reset")
        instance.initialize(0.0, None, initial_gap=-1e-6)
        instance.set(indentation_rate=rate)
        if not moves:
            assert instance.get("force") == first
