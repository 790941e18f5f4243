"""An FMU warns once when a simulation leaves the validity of its law, and continues."""

import re

import fmpy
import pytest
from unit import OK, WARNING, bits, unit

# rigid sphere of 5 mm: a = 0.3 R at the depth that the FMU reports
RADIUS = 5e-3
STEEL_WAVES = (206e9 / 7850.0) ** 0.5

PLAIN = ["plain", "tangents", "damped_and_deep", "momentum"]


def ready(name, logging=True, gap=None):
    instance = unit(name).instance(logging=logging)
    instance.initialize(**({} if gap is None else {"initial_gap": gap}))
    return instance


def warnings(instance):
    assert all(status == WARNING and category == "logStatusWarning" for _, status, category, _ in instance.log), instance.log
    return [message for _, _, _, message in instance.log]


def numbers(message):
    return [float(number) for number in re.findall(r"[0-9.]+(?:e-?[0-9]+)?(?= m)", message)]


def depth_of(name):
    """The indentation up to which the FMU's law is valid, according to its own message."""
    instance = ready(name)
    instance.step(1e-3, 1.0)
    (message,) = warnings(instance)
    return numbers(message)[-1]


def press(instance, way, steps, name="indentation_rate"):
    """Indentation by `way` at 1 m/s, in `steps` steps."""
    instance.set(**{name.replace(".", "__"): 1.0 if way > 0 else -1.0})
    for _ in range(steps):
        instance.step(abs(way) / steps)


def switch(instance, on):
    names = (fmpy.fmi2.fmi2String * 1)(b"logStatusWarning")
    assert instance.try_("SetDebugLogging", on, 1, names) == OK


def switch_on(instance):
    switch(instance, True)


@pytest.mark.parametrize("name", PLAIN)
def test_the_depth_is_where_the_contact_radius_is_three_tenths_of_the_sphere(name):
    depth = depth_of(name)
    instance = ready(name)
    press(instance, depth, 1)
    # the message has nine digits
    assert abs(instance.get("contact_radius") / (0.3 * RADIUS) - 1.0) < 1e-8


@pytest.mark.parametrize("name", PLAIN)
def test_it_is_told_once_at_the_step_that_goes_beyond(name):
    depth = depth_of(name)
    instance = ready(name)
    press(instance, 0.999 * depth, 50)
    assert warnings(instance) == []
    press(instance, 0.002 * depth, 1)
    (message,) = warnings(instance)
    assert message.startswith("fmi2DoStep: at an indentation of ") and "0.3 effective radii" in message
    reached, allowed = numbers(message)
    assert abs(reached / instance.get("indentation") - 1) < 1e-8 and abs(allowed / depth - 1) < 1e-8
    press(instance, depth, 50)
    press(instance, -2 * depth, 50)
    press(instance, 3 * depth, 50)
    assert len(warnings(instance)) == 1


@pytest.mark.parametrize("name", PLAIN)
def test_it_is_told_in_whatever_steps_the_way_is_made(name):
    depth = depth_of(name)
    for steps in (1, 2, 3, 1000):
        instance = ready(name)
        press(instance, 1.5 * depth, steps)
        assert len(warnings(instance)) == 1, steps


@pytest.mark.parametrize("name", PLAIN)
def test_it_is_told_without_logging_unless_the_category_is_switched_off(name):
    instance = ready(name, logging=False)
    press(instance, 0.1 * RADIUS, 10)
    assert len(warnings(instance)) == 1
    instance = ready(name)
    switch(instance, False)
    press(instance, 0.1 * RADIUS, 10)
    assert instance.log == []


@pytest.mark.parametrize("name", PLAIN)
def test_it_is_told_again_after_a_reset(name):
    instance = ready(name, logging=False)
    for count in (1, 2, 3):
        press(instance, 0.1 * RADIUS, 10)
        assert len(warnings(instance)) == count
        instance.call("Reset")
        instance.initialize()


def test_it_is_told_by_the_first_step_of_a_contact_that_begins_beyond():
    instance = ready("plain", gap=-RADIUS)
    assert instance.log == []
    instance.step(1e-9, 1.0)
    assert len(warnings(instance)) == 1


def test_it_is_told_again_when_the_category_is_switched_on_again():
    instance = ready("plain")
    switch(instance, False)
    press(instance, 0.1 * RADIUS, 10)
    switch_on(instance)
    assert instance.log == [], "nothing is told before a step"
    press(instance, 1e-9, 3)
    assert len(warnings(instance)) == 1
    switch_on(instance)
    press(instance, 1e-9, 3)
    assert len(warnings(instance)) == 2


def test_the_message_names_the_contact_that_goes_beyond():
    for name in ("left", "row[3]"):
        instance = ready("own_densities")
        for _ in range(3):
            press(instance, 0.4e-3, 20, f"{name}.indentation_rate")
        (message,) = warnings(instance)
        assert message.startswith(f"fmi2DoStep: {name}: at an indentation of "), message


def test_contacts_that_are_beyond_already_are_told_when_the_category_is_switched_on():
    instance = ready("own_densities")
    switch(instance, False)
    press(instance, 1e-3, 5, "row[2].indentation_rate")
    switch_on(instance)
    instance.step(1e-9)
    (message,) = warnings(instance)
    assert ": row[2]: " in message


@pytest.mark.parametrize("name", ["known_dented", "known_fresh"])
def test_a_unit_that_knows_the_mass_tells_of_a_whole_impact_within_a_step(name):
    for speed, expected in ((1.0, 0), (40.0, 1)):
        instance = ready(name)
        instance.step(1e-3, speed)
        assert instance.get("indentation") < 0.0, "it has rebounded"
        assert len(warnings(instance)) == expected
        instance.step(1e-3, 0.0)
        assert len(warnings(instance)) == expected


@pytest.mark.parametrize("name", ["plain", "fresh_and_deep"])
def test_a_step_with_derivatives_tells_of_its_deepest_point(name):
    # in and out again within the step: the depth is at most v^2/(2 a)
    for deepest, expected in ((1e-4, 0), (4e-4, 1)):
        instance = ready(name)
        instance.set(indentation_rate=1.0)
        instance.set_derivatives(-1.0 / (2 * deepest))
        instance.step(5 * deepest)
        assert instance.get("indentation") < 0.0
        assert len(warnings(instance)) == expected


@pytest.mark.parametrize("name", ["plain", "tangents", "momentum", "own_densities"])
def test_what_is_told_changes_nothing(name):
    """The same bits with and without the check, however the limit is crossed."""
    rate = "row[1].indentation_rate" if name == "own_densities" else "indentation_rate"
    force = rate.replace("indentation_rate", "force")
    ways = [1e-4, 1e-4, 1e-4, -1e-5, 3e-5, 2e-4, -1e-3, 1e-3]

    def forces(logging, looks=False):
        instance = ready(name)
        switch(instance, logging)
        result = []
        for way in ways:
            for part in range(16):
                if looks and part % 3 == 0:
                    switch_on(instance)
                press(instance, way / 16, 1, rate)
                result.append([bits(value) for value in instance.outputs().values()])
        return result

    assert forces(True) == forces(False) == forces(True, looks=True)
    # powers of two: the sums are exact, so that one step ends where many do
    ends = []
    for steps in (1, 4, 1024):
        instance = ready(name)
        press(instance, 2.0**-11, steps, rate)
        ends.append(bits(instance.get(force)))
        assert len(warnings(instance)) == 1
    assert len(set(ends)) == 1, ends


@pytest.mark.parametrize("name", ["plain", "momentum", "own_densities"])
def test_a_state_from_before_crosses_the_border_again_with_the_same_bits(name):
    rate = "row[1].indentation_rate" if name == "own_densities" else "indentation_rate"

    def go_on(instance):
        result = []
        for _ in range(50):
            press(instance, 1e-5, 1, rate)
            result.append([bits(value) for value in instance.outputs().values()])
        return result

    instance = ready(name)
    press(instance, 1e-4, 10, rate)
    saved, time = instance.state(), instance.time
    expected = go_on(instance)
    assert len(warnings(instance)) == 1
    instance.restore(saved)
    instance.time = time
    assert go_on(instance) == expected
    assert len(warnings(instance)) == 1, "one warning an instance"
    other = ready(name)
    other.restore(saved)
    other.time = time
    assert go_on(other) == expected
    assert len(warnings(other)) == 1


@pytest.mark.parametrize("rate", [0.011 * STEEL_WAVES, 1e3, 1e40])
def test_a_closing_speed_above_a_hundredth_of_the_waves_is_told_when_it_is_set(rate):
    instance = ready("steel_ball")
    instance.set(indentation_rate=0.0099 * STEEL_WAVES)
    instance.set(indentation_rate=-rate)
    assert warnings(instance) == []
    instance.set(indentation_rate=rate)
    (message,) = warnings(instance)
    assert message.startswith("fmi2SetReal: indentation_rate = ") and "0.01 of the wave speed" in message
    assert abs(numbers(message)[-1] / (0.01 * STEEL_WAVES) - 1.0) < 1e-8
    instance.set(indentation_rate=rate)
    instance.set(indentation_rate=0.0)
    instance.step(1e-9)
    assert len(warnings(instance)) == 1


def test_the_speed_follows_the_parameters_and_is_told_before_the_first_step():
    instance = unit("steel_ball").instance(logging=True)
    instance.setup()
    instance.call("EnterInitializationMode")
    instance.set(indentation_rate=10.0)
    instance.set(target__youngs_modulus=206e7)
    instance.call("ExitInitializationMode")
    instance.step(1e-9)
    (message,) = warnings(instance)
    assert abs(numbers(message)[-1] / (0.001 * STEEL_WAVES) - 1.0) < 1e-8


def test_the_speed_is_told_again_and_independently_of_the_width():
    instance = ready("steel_ball")
    instance.step(1e-5, 60.0)
    assert len(warnings(instance)) == 2
    switch_on(instance)
    instance.step(1e-9)
    assert len(warnings(instance)) == 4


def test_without_density_no_speed_is_told():
    instance = ready("plain")
    instance.set(indentation_rate=1e6)
    instance.step(1e-12)
    assert instance.log == []


def test_each_contact_has_the_density_of_its_own_target():
    # left has a density like lead, row like aluminium, right an unknown one
    instance = ready("own_densities")
    instance.set(**{"right__indentation_rate": 1e4, "left__indentation_rate": 10.0, "row[5]__indentation_rate": 45.0})
    assert warnings(instance) == []
    instance.set(**{"row[5]__indentation_rate": 55.0})
    instance.set(**{"left__indentation_rate": 55.0})
    (message,) = warnings(instance)
    assert message.startswith("fmi2SetReal: row[5]: indentation_rate = 55 m/s "), message


def test_every_unit_declares_the_category():
    for name in ("plain", "damped_and_deep", "own_densities", "steel_ball"):
        categories = fmpy.read_model_description(unit(name).path).logCategories
        assert [category.name for category in categories] == [
            "logStatusWarning", "logStatusDiscard", "logStatusError", "logAll"
        ]
