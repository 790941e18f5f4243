"""Messages: each rejected call is reported completely and in a declared category; otherwise nothing is logged."""

import ctypes
import re
from ctypes import byref, c_char_p, c_int

import pytest
from fmpy import fmi2
from unit import DISCARD, ERROR, OK, WARNING, unit

DECLARED = {category.name for category in unit("steel_ball").description.logCategories}


def wrong_calls(instance):
    """Makes one mistake of each kind, and returns their number."""
    saved = instance.state()
    mistakes = [
        lambda: instance.try_step(instance.time, -1.0),
        lambda: instance.try_step(instance.time + 1.0, 1e-6),
        lambda: instance.try_set("indentation_rate", float("nan")),
        lambda: instance.try_set("force", 1.0),
        lambda: instance.try_set("target.yield_strength", 1.0),
        lambda: instance.try_get(12345)[0],
        lambda: instance.try_("EnterInitializationMode"),
        lambda: instance.try_("CancelStep"),
        lambda: instance.try_("GetReal", None, 1, None),
        lambda: instance.try_deserialize(b"nonsense")[0],
    ]
    for number, mistake in enumerate(mistakes, start=1):
        assert mistake() == ERROR
        assert len(instance.log) == number, "each error is logged, and logged once"
        instance.restore(saved)
    return len(mistakes)


def debug_logging(instance, categories, on=True):
    names = (c_char_p * len(categories))(*(category.encode() for category in categories))
    return instance.try_("SetDebugLogging", on, len(categories), names)


@pytest.mark.parametrize("logging", [False, True])
def test_errors_are_logged_with_name_category_and_whole_text(logging):
    instance = unit("steel_ball").instance(name="ball 7", logging=logging)
    instance.initialize()
    assert len(instance.log) == 0
    wrong_calls(instance)
    for name, status, category, message in instance.log:
        assert (name, status) == ("ball 7", ERROR)
        assert category in DECLARED
        assert re.match(r"fmi2\w+: ", message), "a message begins with the function"
        assert len(message) > 20 and message == message.strip()
        # no part of a printf format may remain after the importer has processed it
        assert "%" not in message and "#" not in message and "\n" not in message


@pytest.mark.parametrize("logging", [False, True])
def test_a_run_without_mistakes_is_silent(logging):
    instance = unit("steel_ball").instance(logging=logging)
    instance.initialize(0.0, 1e-4)
    for index in range(100):
        instance.step(1e-6, 1.0 if index < 50 else -1.0)
        instance.outputs()
    instance.restore(instance.state())
    instance.call("Terminate")
    instance.call("Reset")
    assert instance.log == []


def test_information_that_is_not_available_is_logged_when_asked_for():
    for logging, count in ((False, (0, 1)), (True, (1,))):
        instance = unit("steel_ball").instance(logging=logging)
        instance.initialize()
        assert instance.try_("GetStringStatus", 1, byref(c_char_p())) == DISCARD
        assert len(instance.log) in count
        assert all(status == DISCARD and category in DECLARED for _, status, category, _ in instance.log)


@pytest.mark.parametrize("category", sorted(DECLARED))
def test_declared_categories_can_be_switched(category):
    instance = unit("steel_ball").ready()
    assert debug_logging(instance, [category]) == OK
    assert debug_logging(instance, [category], on=False) == OK
    assert debug_logging(instance, sorted(DECLARED)) == OK
    assert debug_logging(instance, []) == OK


def test_switching_a_category_has_an_effect():
    instance = unit("steel_ball").ready()
    assert debug_logging(instance, ["logStatusDiscard"]) == OK
    assert instance.try_("GetStringStatus", 1, byref(c_char_p())) == DISCARD
    assert len(instance.log) == 1
    assert debug_logging(instance, ["logStatusDiscard"], on=False) == OK
    assert instance.try_("GetStringStatus", 1, byref(c_char_p())) == DISCARD
    assert len(instance.log) == 1


@pytest.mark.parametrize("category", ["", "logEvents", "logall", "logStatusErrors", "%s%s%n", "x" * 100_000])
@pytest.mark.parametrize("on", [False, True])
def test_an_unknown_category_is_a_warning(category, on):
    instance = unit("steel_ball").ready()
    assert debug_logging(instance, [category], on) == OK
    ((_, status, category, message),) = instance.log
    assert (status, category) == (WARNING, "logStatusWarning") and "unknown log category" in message
    assert "%" not in message
    instance.step(1e-6, 1.0)


@pytest.mark.parametrize("arguments, reason", [
    ({"guid": "{00000000-0000-0000-0000-000000000000}"}, "fmuGUID"),
    ({"guid": ""}, "fmuGUID"),
    ({"kind": fmi2.fmi2ModelExchange}, "fmuType"),
    ({"kind": 7}, "fmuType"),
    ({"name": ""}, "instanceName"),
    ({"name": None}, "instanceName"),
])
@pytest.mark.parametrize("logging", [False, True])
def test_a_refused_instance_is_null_and_says_why(arguments, reason, logging):
    instance = unit("steel_ball").instance(logging=logging, **arguments)
    assert instance.component is None
    assert len(instance.log) == 1
    _, status, category, message = instance.log[0]
    assert status == ERROR and category in DECLARED and reason in message


@pytest.mark.parametrize("name", ["a", "%s%n", "ball.fmu/instance 1", "Kügelchen 球", "x" * 10_000])
def test_any_name_will_do_and_is_the_one_in_the_log(name):
    instance = unit("steel_ball").instance(name=name)
    instance.initialize()
    assert instance.try_step(0.0, -1.0) == ERROR
    assert instance.log[0][0] == name


@pytest.mark.parametrize("resources", [
    "", "file:///", "file:/tmp", "file:///no/such/folder", "http://example.org/", "%25 %zz", "x" * 100_000,
])
def test_any_resource_location_will_do(resources):
    instance = unit("steel_ball").instance(resources=resources)
    instance.initialize()
    instance.step(1e-6, 1.0)
    assert instance.log == []


def test_without_a_logger_errors_are_still_errors():
    instance = unit("steel_ball").instance(logger=False)
    instance.initialize()
    instance.step(1e-6, 1.0)
    assert instance.try_step(instance.time, -1.0) == ERROR
    assert unit("steel_ball").instance(logger=False, guid="wrong").component is None


def test_names_and_callbacks_are_copied():
    instance = unit("steel_ball").instance(name="copied")
    # the importer's struct may be reused once the instance is created
    keep = fmi2.fmi2CallbackFunctions.from_buffer_copy(instance.callbacks)
    ctypes.memset(byref(instance.callbacks), 0, ctypes.sizeof(instance.callbacks))
    instance.initialize()
    assert instance.try_("GetInteger", (ctypes.c_uint * 1)(99), 1, (c_int * 1)()) == ERROR
    assert instance.log[0][0] == "copied" and keep.logger
