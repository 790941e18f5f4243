"""What an importer reads where a simulation leaves the validity of its law, or where it isn't coupled as the scene says: whole sentences, with
the numbers and the contact. When they come: tests/conformance/checks/logging.rs, and tests/instances/."""

import re

import pytest
from unit import WARNING, unit

# rigid sphere of 5 mm: a = 0.3 R at the depth that the FMU reports
RADIUS = 5e-3
STEEL_WAVES = (206e9 / 7850.0) ** 0.5


def warnings(instance):
    assert all(status == WARNING and category == "logStatusWarning" for status, category, _ in instance.log), instance.log
    return [message for _, _, message in instance.log]


def numbers(message):
    return [float(number) for number in re.findall(r"[0-9.]+(?:e-?[0-9]+)?(?= m)", message)]


def press(instance, distance, steps, name="indentation_rate"):
    """Indentation by `distance` at 1 m/s, in `steps` steps."""
    instance.set(**{name: 1.0 if distance > 0 else -1.0})
    for _ in range(steps):
        instance.step(abs(distance) / steps)


@pytest.mark.parametrize("name", ["plain", "tangents", "damped_and_deep", "momentum"])
def test_a_contact_that_becomes_too_wide_is_told_with_the_depth_from_which_on_it_is(name):
    instance = unit(name).ready()
    instance.step(1e-3, 1.0)
    depth = numbers(warnings(instance)[0])[-1]
    instance = unit(name).ready()
    press(instance, depth, 1)
    # the message has nine digits
    assert abs(instance.get("contact_radius") / (0.3 * RADIUS) - 1.0) < 1e-8
    for steps in (1, 2, 50):
        instance.reset()
        instance.initialize()
        instance.log.clear()
        press(instance, 0.999 * depth, steps)
        assert warnings(instance) == []
        press(instance, 0.002 * depth, 1)
        (message,) = warnings(instance)
        assert message.startswith("fmi2DoStep: at an indentation of ") and "0.3 effective radii" in message
        reached, allowed = numbers(message)
        assert abs(reached / instance.get("indentation") - 1) < 1e-8 and abs(allowed / depth - 1) < 1e-8


def test_the_message_names_the_contact_that_goes_beyond():
    for name in ("left", "row[3]"):
        instance = unit("own_densities").ready()
        for _ in range(3):
            press(instance, 0.4e-3, 20, f"{name}.indentation_rate")
        (message,) = warnings(instance)
        assert message.startswith(f"fmi2DoStep: {name}: at an indentation of "), message


@pytest.mark.parametrize("name", ["known_dented", "known_fresh"])
def test_a_unit_that_knows_the_mass_tells_of_a_whole_impact_within_a_step(name):
    for speed, expected in ((1.0, 0), (40.0, 1)):
        instance = unit(name).ready()
        instance.step(1e-3, speed)
        assert instance.get("indentation") < 0.0, "it has rebounded"
        assert len(warnings(instance)) == expected


def test_a_closing_speed_above_a_hundredth_of_the_waves_is_told_once_when_it_is_set():
    instance = unit("steel_ball").ready()
    for rate in (0.0099 * STEEL_WAVES, -1e3):
        instance.set(indentation_rate=rate)
    assert warnings(instance) == []
    for rate in (0.011 * STEEL_WAVES, 1e3, 0.0):
        instance.set(indentation_rate=rate)
        (message,) = warnings(instance)
    assert message.startswith("fmi2SetReal: indentation_rate = ") and "0.01 of the wave speed" in message
    assert abs(numbers(message)[-1] / (0.01 * STEEL_WAVES) - 1.0) < 1e-8
    # without a density, the speed of the waves is unknown
    instance = unit("plain").ready()
    instance.set(indentation_rate=1e6)
    assert instance.log == []


def test_each_contact_has_the_density_of_its_own_target():
    # left has a density like lead, row like aluminium, right an unknown one
    instance = unit("own_densities").ready()
    instance.set(**{"right.indentation_rate": 1e4, "left.indentation_rate": 10.0, "row[5].indentation_rate": 45.0})
    assert warnings(instance) == []
    instance.set(**{"row[5].indentation_rate": 55.0})
    instance.set(**{"left.indentation_rate": 55.0})
    (message,) = warnings(instance)
    assert message.startswith("fmi2SetReal: row[5]: indentation_rate = 55 m/s "), message


def test_the_passivity_guard_is_told_with_the_depths_at_which_it_acts():
    instance = unit("guarded").ready()
    for _ in range(2):
        for rate in (1.0, -1.0):
            instance.step(3e-7, rate)
    (message,) = warnings(instance)
    assert "passivity guard acts at largest indentations from 1.0000 to 11.18" in message
    assert abs(instance.get("dissipated_energy")) <= 1e-20, "what was put in is given back"
