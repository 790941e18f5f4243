"""Parameters: values within min and max are accepted, all others rejected with a helpful message."""

import math

import pytest
from unit import DISCARD, ERROR, OK, Refused, bits, paths, unit

every_parameter = pytest.mark.parametrize(
    "name, key", [(name, key) for name in sorted(paths()) for key in unit(name).parameters]
)

POSITIVE = {
    "impactor.radius", "impactor.youngs_modulus", "target.youngs_modulus", "target.yield_strength", "effective_mass",
}


def limits(name, key):
    variable = unit(name).variables[key]
    return float(variable.min), float(variable.max)


def initializing(name):
    instance = unit(name).instance()
    instance.setup()
    instance.call("EnterInitializationMode")
    return instance


def refusal(name, key, value):
    """The status and the message when `key` is set to `value`, at the latest at the end of Initialization Mode."""
    instance = initializing(name)
    status = instance.try_set(key, value)
    if status == OK:
        status = instance.try_("ExitInitializationMode")
        assert status != DISCARD
    messages = [message for _, _, _, message in instance.log]
    return status, "\n".join(messages)


@every_parameter
def test_values_at_the_limits_are_taken_and_read_back(name, key):
    for value in limits(name, key):
        early, late = unit(name).instance(), initializing(name)
        early.set(**{key: value})
        early.setup()
        early.call("EnterInitializationMode")
        late.set(**{key: value})
        assert bits(early.get(key)) == bits(value)
        assert bits(late.get(key)) == bits(value)


@every_parameter
def test_a_contact_at_the_limits_gives_finite_values_until_it_is_as_wide_as_its_body(name, key):
    if "target.radius" in unit(name).variables:
        pytest.skip("whether a radius fits depends on the other one")
    for value in limits(name, key):
        instance = unit(name).ready(**{key: value})
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
    smallest, largest = limits(name, key)
    for value, limit in ((math.nextafter(smallest, -math.inf), smallest), (math.nextafter(largest, math.inf), largest)):
        status, message = refusal(name, key, value)
        assert status in (DISCARD, ERROR)
        assert key in message
        assert limit in numbers(message), message


def numbers(message):
    """The numbers in a message; it is a sentence, so commas and colons may follow them."""
    found = []
    for word in message.split():
        try:
            found.append(float(word.rstrip(",;:")))
        except ValueError:
            pass
    return found


@every_parameter
@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_what_is_not_finite_is_refused(name, key, value):
    status, message = refusal(name, key, value)
    assert status in (DISCARD, ERROR) and key in message


@every_parameter
@pytest.mark.parametrize("value", [0.0, -0.0, -5e-3, -1e11])
def test_sizes_and_moduli_must_be_positive(name, key, value):
    if key not in POSITIVE:
        pytest.skip("this parameter has no sign to keep")
    status, message = refusal(name, key, value)
    assert status in (DISCARD, ERROR) and key in message


@every_parameter
@pytest.mark.parametrize("value", [0.75, -1.5])
def test_an_impossible_poissons_ratio_is_refused(name, key, value):
    if "poissons_ratio" not in key:
        pytest.skip("not a Poisson's ratio")
    status, message = refusal(name, key, value)
    assert status in (DISCARD, ERROR) and key in message


@every_parameter
@pytest.mark.parametrize("value", [0.0, -0.0])
def test_a_target_of_radius_zero_is_refused(name, key, value):
    if key != "target.radius":
        pytest.skip("not the radius of a target")
    status, message = refusal(name, key, value)
    assert status == ERROR and key in message


def test_a_socket_must_be_wider_than_the_impactor():
    for name in paths():
        if "target.radius" in unit(name).parameters:
            radius = float(unit(name).variables["impactor.radius"].start)
            assert refusal(name, "target.radius", -radius)[0] == ERROR
            assert refusal(name, "target.radius", math.nextafter(-radius, 0.0))[0] == ERROR
            assert refusal(name, "target.radius", -2.0 * radius)[0] == OK


def test_parameters_that_fit_only_together_may_come_in_any_order():
    for name in paths():
        if "target.radius" in unit(name).parameters:
            instance = initializing(name)
            # wider than the socket of the scene, until the socket is widened
            instance.set(impactor__radius=1.0)
            instance.set(target__radius=-2.0)
            instance.call("ExitInitializationMode")


@every_parameter
def test_a_refused_value_leaves_the_old_one(name, key):
    instance = initializing(name)
    before = instance.get(key)
    assert instance.try_set(key, math.nan) != OK
    # reading is allowed after an error
    assert bits(instance.get(key)) == bits(before)
