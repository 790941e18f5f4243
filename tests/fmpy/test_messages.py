"""What an importer is told: each rejected call completely and in a declared category, and once that the simulation leaves the
validity of its law."""

import re
from ctypes import c_char_p

import pytest
from unit import ERROR, WARNING, unit

# rigid sphere of 5 mm: a = 0.3 R at the depth that the FMU reports
RADIUS = 5e-3
STEEL_WAVES = (206e9 / 7850.0) ** 0.5
PLAIN = ["plain", "tangents", "damped_and_deep", "momentum"]
DECLARED = {category.name for category in unit("steel_ball").description.logCategories}


@pytest.mark.parametrize("logging", [False, True])
def test_errors_are_logged_with_name_category_and_whole_text(logging):
    instance = unit("steel_ball").instance(name="%s ball 7 球", logging=logging)
    instance.initialize()
    saved = instance.state()
    mistakes = [
        lambda: instance.try_step(instance.time, -1.0),
        lambda: instance.try_set("indentation_rate", float("nan")),
        lambda: instance.try_set("force", 1.0),
        lambda: instance.try_set("target.yield_strength", 1.0),
        lambda: instance.try_get(12345)[0],
        lambda: instance.try_("EnterInitializationMode"),
        lambda: instance.try_deserialize(b"nonsense")[0],
    ]
    for number, mistake in enumerate(mistakes, start=1):
        assert mistake() == ERROR
        assert len(instance.log) == number, "each error is logged, and logged once"
        name, status, category, message = instance.log[-1]
        assert (name, status) == ("%s ball 7 球", ERROR) and category in DECLARED
        # no part of a printf format may remain after the importer has processed it
        assert re.match(r"fmi2\w+: [^%#\n]{12,}$", message) and message == message.strip()
        instance.restore(saved)


def ready(name, logging=True):
    instance = unit(name).instance(logging=logging)
    instance.initialize()
    return instance


def warnings(instance):
    assert all(status == WARNING and category == "logStatusWarning" for _, status, category, _ in instance.log), instance.log
    return [message for _, _, _, message in instance.log]


def numbers(message):
    return [float(number) for number in re.findall(r"[0-9.]+(?:e-?[0-9]+)?(?= m)", message)]


def press(instance, distance, steps, name="indentation_rate"):
    """Indentation by `distance` at 1 m/s, in `steps` steps."""
    instance.set(**{name: 1.0 if distance > 0 else -1.0})
    for _ in range(steps):
        instance.step(abs(distance) / steps)


@pytest.mark.parametrize("logging", [False, True])
@pytest.mark.parametrize("name", PLAIN)
def test_a_contact_that_becomes_too_wide_is_told_once_at_the_step_that_goes_beyond(name, logging):
    instance = ready(name)
    instance.step(1e-3, 1.0)
    depth = numbers(warnings(instance)[0])[-1]
    instance = ready(name, logging)
    press(instance, depth, 1)
    # the message has nine digits
    assert abs(instance.get("contact_radius") / (0.3 * RADIUS) - 1.0) < 1e-8
    for steps in (1, 2, 50):
        instance.call("Reset")
        instance.initialize()
        instance.log.clear()
        press(instance, 0.999 * depth, steps)
        assert warnings(instance) == []
        press(instance, 0.002 * depth, 1)
        (message,) = warnings(instance)
        assert message.startswith("fmi2DoStep: at an indentation of ") and "0.3 effective radii" in message
        reached, allowed = numbers(message)
        assert abs(reached / instance.get("indentation") - 1) < 1e-8 and abs(allowed / depth - 1) < 1e-8
        for distance in (depth, -2 * depth, 3 * depth):
            press(instance, distance, steps)
        assert len(warnings(instance)) == 1


def test_a_contact_that_is_beyond_already_is_told_at_its_next_step_and_again_when_the_category_is_switched_on():
    instance = unit("plain").instance(logging=True)
    instance.initialize(initial_gap=-0.2 * RADIUS)
    assert instance.log == []
    for count in (1, 2, 3):
        for _ in range(2):
            instance.step(1e-9, 1.0)
        assert len(warnings(instance)) == count
        instance.call("SetDebugLogging", True, 1, (c_char_p * 1)(b"logStatusWarning"))


def test_the_message_names_the_contact_that_goes_beyond():
    for name in ("left", "row[3]"):
        instance = ready("own_densities")
        for _ in range(3):
            press(instance, 0.4e-3, 20, f"{name}.indentation_rate")
        (message,) = warnings(instance)
        assert message.startswith(f"fmi2DoStep: {name}: at an indentation of "), message


@pytest.mark.parametrize("name", ["known_dented", "known_fresh"])
def test_a_unit_that_knows_the_mass_tells_of_a_whole_impact_within_a_step(name):
    for speed, expected in ((1.0, 0), (40.0, 1)):
        instance = ready(name)
        instance.step(1e-3, speed)
        assert instance.get("indentation") < 0.0, "it has rebounded"
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


def test_a_closing_speed_above_a_hundredth_of_the_waves_is_told_once_when_it_is_set():
    instance = ready("steel_ball")
    for rate in (0.0099 * STEEL_WAVES, -1e3):
        instance.set(indentation_rate=rate)
    assert warnings(instance) == []
    for rate in (0.011 * STEEL_WAVES, 1e3, 0.0):
        instance.set(indentation_rate=rate)
        (message,) = warnings(instance)
    assert message.startswith("fmi2SetReal: indentation_rate = ") and "0.01 of the wave speed" in message
    assert abs(numbers(message)[-1] / (0.01 * STEEL_WAVES) - 1.0) < 1e-8
    # without a density, the speed of the waves is unknown
    instance = ready("plain")
    instance.set(indentation_rate=1e6)
    assert instance.log == []


def test_each_contact_has_the_density_of_its_own_target():
    # left has a density like lead, row like aluminium, right an unknown one
    instance = ready("own_densities")
    instance.set(**{"right.indentation_rate": 1e4, "left.indentation_rate": 10.0, "row[5].indentation_rate": 45.0})
    assert warnings(instance) == []
    instance.set(**{"row[5].indentation_rate": 55.0})
    instance.set(**{"left.indentation_rate": 55.0})
    (message,) = warnings(instance)
    assert message.startswith("fmi2SetReal: row[5]: indentation_rate = 55 m/s "), message


@pytest.mark.parametrize("steps", [1, 100])
def test_the_passivity_guard_is_told_once_where_it_acts(steps):
    instance = ready("guarded")

    def dent(depth):
        for rate in (1.0, -1.0):
            for _ in range(steps):
                instance.step(depth / steps, rate)

    # the guard acts at largest indentations of 1 to 11.2 yield indentations of 7.55e-8 m
    dent(5e-8)
    assert warnings(instance) == [], "nothing has yielded"
    dent(3e-7)
    assert abs(instance.get("dissipated_energy")) <= 1e-20, "what was put in is given back"
    dent(3e-7)
    (message,) = warnings(instance)
    assert "passivity guard acts at largest indentations from 1.0000 to 11.18" in message
    instance = ready("guarded")
    dent(3e-6)
    assert instance.log == []
