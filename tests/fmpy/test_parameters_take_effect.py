"""Importers set parameters at three points in time; the same values always give the same run."""

import pytest
from unit import bits, unit

CHANGED = {
    "impactor__radius": 7e-3,
    "target__youngs_modulus": 190e9,
    "target__poissons_ratio": 0.27,
    "target__yield_strength": 250e6,
    "initial_gap": -2e-7,
}


def run(instance):
    trace = [instance.outputs()]
    for rate in (1.0, 3.0, -0.5, -2.0, 5.0):
        instance.step(1e-6, rate)
        trace.append(instance.outputs())
    return [{key: bits(value) for key, value in outputs.items()} for outputs in trace]


def before_the_experiment(instance, values):
    instance.set(**values)
    instance.setup()
    instance.call("EnterInitializationMode")
    instance.call("ExitInitializationMode")


def after_the_experiment(instance, values):
    instance.setup()
    instance.set(**values)
    instance.call("EnterInitializationMode")
    instance.call("ExitInitializationMode")


def in_initialization_mode(instance, values):
    instance.initialize(**values)


def one_here_one_there(instance, values):
    items = list(values.items())
    instance.set(**dict(items[:1]))
    instance.setup()
    instance.set(**dict(items[1:2]))
    instance.call("EnterInitializationMode")
    instance.set(**dict(items[2:]))
    instance.call("ExitInitializationMode")


def twice(instance, values):
    instance.set(**{key: 1.1 * value for key, value in values.items()})
    in_initialization_mode(instance, values)


PLACES = [before_the_experiment, after_the_experiment, in_initialization_mode, one_here_one_there, twice]


@pytest.mark.parametrize("place", PLACES)
def test_the_run_does_not_depend_on_when_parameters_are_set(place):
    instance, reference = unit("steel_ball").instance(), unit("steel_ball").instance()
    place(instance, CHANGED)
    in_initialization_mode(reference, CHANGED)
    assert run(instance) == run(reference)


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("key", CHANGED)
def test_every_single_parameter_changes_the_run(place, key):
    instance = unit("steel_ball").instance()
    place(instance, {key: CHANGED[key]})
    assert run(instance) != run(unit("steel_ball").ready())


def test_values_in_initialization_mode_follow_the_parameters():
    instance = unit("steel_ball").instance()
    instance.setup()
    instance.call("EnterInitializationMode")
    forces = []
    for gap in (0.0, -1e-7, -1e-6):
        instance.set(initial_gap=gap)
        forces.append(instance.get("force"))
        assert instance.get("indentation") == -gap
    assert forces[0] == 0.0 < forces[1] < forces[2]
    instance.set(target__yield_strength=150e6)
    assert 0.0 < instance.get("force") < forces[2]


def test_reset_takes_parameters_back():
    instance = unit("steel_ball").ready(**CHANGED)
    run(instance)
    instance.call("Reset")
    instance.initialize()
    assert run(instance) == run(unit("steel_ball").ready())


def test_an_importer_may_reset_at_once_and_set_parameters_again():
    instance = unit("steel_ball").instance()
    instance.call("Reset")
    instance.initialize(**CHANGED)
    assert run(instance) == run(unit("steel_ball").ready(**CHANGED))
