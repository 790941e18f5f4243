"""Importers set parameters at three points in time; the same values always give the same run."""

import math

import pytest
from unit import ERROR, OK, Refused, bits, paths, unit

every_parameter = pytest.mark.parametrize(
    "name, key", [(name, key) for name in sorted(paths()) for key in unit(name).parameters]
)
CHANGED = {
    "impactor.radius": 7e-3,
    "target.youngs_modulus": 190e9,
    "target.poissons_ratio": 0.27,
    "target.yield_strength": 250e6,
    "initial_gap": -2e-7,
}
# how many of the values are set before the experiment, how many after it, and how many in Initialization Mode
PLACES = {"before": (5, 0, 0), "after": (0, 5, 0), "in": (0, 0, 5), "one here, one there": (1, 1, 3)}


def run(instance):
    trace = [instance.outputs()]
    for rate in (1.0, 3.0, -0.5, -2.0, 5.0):
        instance.step(1e-6, rate)
        trace.append(instance.outputs())
    return [{key: bits(value) for key, value in outputs.items()} for outputs in trace]


def started(place, values):
    instance = unit("steel_ball").instance()
    before, after, _ = PLACES[place]
    items = list(values.items())
    instance.set(**dict(items[:before]))
    instance.setup()
    instance.set(**dict(items[before : before + after]))
    instance.call("EnterInitializationMode")
    instance.set(**dict(items[before + after :]))
    instance.call("ExitInitializationMode")
    return instance


@pytest.mark.parametrize("place", PLACES)
def test_the_run_does_not_depend_on_when_parameters_are_set_and_each_of_them_changes_it(place):
    if "steel_ball" not in paths():
        pytest.skip("another set of scenes")
    assert run(started(place, CHANGED)) == run(started("in", CHANGED))
    plain = run(unit("steel_ball").ready())
    assert all(run(started(place, {key: value})) != plain for key, value in CHANGED.items())


def initializing(name):
    instance = unit(name).instance()
    instance.setup()
    instance.call("EnterInitializationMode")
    return instance


@every_parameter
def test_a_contact_at_the_limits_gives_finite_values_until_it_is_as_wide_as_its_body(name, key):
    if "target.radius" in unit(name).variables:
        pytest.skip("whether a radius fits depends on the other one")
    variable = unit(name).variables[key]
    for value in (float(variable.min), float(variable.max)):
        instance = unit(name).ready(**{key: value})
        assert bits(instance.get(key)) == bits(value)
        for rate in (1e-3, -2e-3, 1.0):
            try:
                instance.step(1e-6, rate)
            except Refused as refused:
                assert "the size of the smaller body: no contact law holds" in str(refused)
                # without strength, a line is as wide as its cylinder at any depth
                strength = {"target.yield_strength"} if "roller" in name else set()
                assert key in {"impactor.radius", "initial_gap"} | strength
                break
            assert all(math.isfinite(output) for output in instance.outputs().values()), (value, instance.outputs())


@every_parameter
def test_the_next_number_beyond_a_limit_is_refused_with_name_and_limit(name, key):
    variable = unit(name).variables[key]
    for limit, beyond in ((float(variable.min), -math.inf), (float(variable.max), math.inf)):
        instance = initializing(name)
        assert instance.try_set(key, math.nextafter(limit, beyond)) == ERROR
        message = instance.log[0][3]
        words = [word.rstrip(",;:") for word in message.split()]
        assert key in message and limit in [float(word) for word in words if word[-1:].isdigit() and word[0] in "-0123456789"]


@pytest.mark.parametrize("name", [name for name in sorted(paths()) if "target.radius" in unit(name).parameters])
def test_a_socket_must_be_wider_than_the_impactor_and_both_may_come_in_any_order(name):
    radius = float(unit(name).variables["impactor.radius"].start)
    for socket, expected in ((-radius, ERROR), (math.nextafter(-radius, 0.0), ERROR), (-2.0 * radius, OK)):
        instance = initializing(name)
        # at the latest at the end of Initialization Mode
        assert (instance.try_set("target.radius", socket) or instance.try_("ExitInitializationMode")) == expected
    instance = initializing(name)
    # wider than the socket of the scene, until the socket is widened
    instance.set(impactor__radius=1.0)
    instance.set(target__radius=-2.0)
    instance.call("ExitInitializationMode")
