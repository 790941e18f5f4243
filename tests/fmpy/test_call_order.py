"""Calls out of order, wrong references and wrong types are rejected; harmless calls of real importers are tolerated."""

from ctypes import byref, c_char_p, c_double, c_int, c_size_t, c_uint, c_void_p

import pytest
from unit import DISCARD, ERROR, OK, unit


def instance():
    return unit("steel_ball").instance()


def initializing():
    made = instance()
    made.setup()
    made.call("EnterInitializationMode")
    return made


def ready():
    return unit("steel_ball").ready()


def terminated():
    made = ready()
    made.step(1e-6, 1.0)
    made.call("Terminate")
    return made


def failed():
    made = ready()
    made.step(1e-6, 1.0)
    assert made.try_step(made.time, -1.0) == ERROR
    made.log.clear()
    return made


def set_real(made, name="indentation_rate", value=0.5):
    return made.try_set(name, value)


def get_real(made):
    return made.try_get("force")[0]


def get_integer(made):
    return made.try_("GetInteger", (c_uint * 1)(unit("steel_ball").reference["regime"]), 1, (c_int * 1)())


def get_state(made):
    pointer = c_void_p()
    status = made.try_("GetFMUstate", byref(pointer))
    return status or made.try_("FreeFMUstate", byref(pointer))


CALLS = {
    "SetupExperiment": lambda made: made.try_setup(),
    "EnterInitializationMode": lambda made: made.try_("EnterInitializationMode"),
    "ExitInitializationMode": lambda made: made.try_("ExitInitializationMode"),
    "Terminate": lambda made: made.try_("Terminate"),
    "Reset": lambda made: made.try_("Reset"),
    "SetDebugLogging": lambda made: made.try_("SetDebugLogging", False, 0, None),
    "GetFMUstate": get_state,
    "GetReal": get_real,
    "GetInteger": get_integer,
    "SetReal": set_real,
    "DoStep": lambda made: made.try_step(made.time, 1e-6),
    "GetRealStatus": lambda made: made.try_("GetRealStatus", 2, byref(c_double())),
    "CancelStep": lambda made: made.try_("CancelStep"),
}

# FMI 2.0.5, section 4.2.4, for an FMU whose steps are complete when the call returns
ALWAYS = {"Reset", "SetDebugLogging", "GetFMUstate"}
READING = {"GetReal", "GetInteger"}
ALLOWED = {
    # reading before Initialization Mode: not in the table, but harmless
    "instantiated": (instance, ALWAYS | {"SetupExperiment"}, READING | {"SetReal", "Terminate", "GetRealStatus"}),
    "initializing": (initializing, ALWAYS | READING | {"ExitInitializationMode", "SetReal"}, {"Terminate"}),
    "ready": (ready, ALWAYS | READING | {"SetReal", "DoStep", "Terminate", "GetRealStatus"}, set()),
    # a second Terminate: importers' destructors call it
    "terminated": (terminated, ALWAYS | READING | {"GetRealStatus", "Terminate"}, set()),
    "after an error": (failed, ALWAYS | READING | {"GetRealStatus"}, set()),
}


@pytest.mark.parametrize("call", CALLS)
@pytest.mark.parametrize("phase", ALLOWED)
def test_a_call_is_answered_as_the_table_of_the_standard_says(phase, call):
    make, allowed, tolerated = ALLOWED[phase]
    made = make()
    status = CALLS[call](made)
    if call in allowed:
        assert status == OK and made.log == []
    elif call in tolerated:
        assert status in (OK, ERROR)
    else:
        assert status == ERROR
        assert [entry[1] for entry in made.log] == [ERROR] and "fmi2" + call in made.log[0][3]


@pytest.mark.parametrize("call", CALLS)
def test_after_an_error_only_reset_or_a_saved_state_lead_back(call):
    made = failed()
    CALLS[call](made)
    if call != "Reset":
        assert made.try_step(made.time, 1e-6) == ERROR
        made.call("Reset")
    made.initialize()
    made.step(1e-6, 1.0)
    assert made.get("force") > 0.0


def test_reading_after_an_error_gives_the_values_before_it():
    good, bad = ready(), ready()
    for made in (good, bad):
        made.step(1e-6, 1.0)
    assert bad.try_step(bad.time, -1.0) == ERROR
    assert bad.outputs() == good.outputs()


def test_initialization_without_an_experiment_is_refused():
    made = instance()
    assert made.try_("EnterInitializationMode") == ERROR
    assert "fmi2SetupExperiment" in made.log[0][3]


def test_the_last_experiment_before_initialization_counts():
    made = instance()
    made.setup(0.0, 1.0)
    made.setup(5.0, 6.0)
    made.call("EnterInitializationMode")
    made.call("ExitInitializationMode")
    made.call("DoStep", 5.0, 1.0, True)


@pytest.mark.parametrize("start, stop", [
    (float("nan"), None), (float("inf"), None), (0.0, float("nan")), (0.0, float("-inf")), (1.0, 0.5), (0.0, -1e-9),
])
def test_impossible_times_are_refused(start, stop):
    made = instance()
    assert made.try_setup(start, stop) == ERROR
    assert "startTime" in made.log[0][3]


def test_an_experiment_may_end_where_it_starts():
    assert instance().try_setup(1.0, 1.0) == OK


def test_termination_is_tolerated_twice_and_without_initialization():
    made = terminated()
    force = made.get("force")
    made.call("Terminate")
    assert made.get("force") == force
    made = instance()
    made.call("Terminate")
    made = terminated()
    made.call("Reset")
    made.initialize()
    made.step(1e-6, 1.0)


@pytest.mark.parametrize("parameter", unit("steel_ball").parameters)
def test_a_fixed_parameter_is_refused_after_initialization(parameter):
    made = ready()
    value = made.get(parameter)
    assert set_real(made, parameter, value) == ERROR
    assert parameter in made.log[0][3]


@pytest.mark.parametrize("make", [instance, initializing, ready])
@pytest.mark.parametrize("output", [name for name in unit("steel_ball").outputs if name != "regime"])
def test_an_output_is_never_set(make, output):
    made = make()
    assert set_real(made, output, 1.0) == ERROR
    assert len(made.log) == 1


def test_an_integer_output_is_never_set():
    made = ready()
    reference = (c_uint * 1)(unit("steel_ball").reference["regime"])
    assert made.try_("SetInteger", reference, 1, (c_int * 1)(1)) == ERROR


UNKNOWN = [max(unit("steel_ball").reference.values()) + 1, 1000, 2**31, 2**32 - 1]
VALUES = {"Real": c_double, "Integer": c_int, "Boolean": c_int, "String": c_char_p}


@pytest.mark.parametrize("kind", VALUES)
@pytest.mark.parametrize("direction", ["Get", "Set"])
@pytest.mark.parametrize("reference", UNKNOWN)
def test_an_unknown_reference_is_refused(direction, kind, reference):
    made = ready()
    assert made.try_(direction + kind, (c_uint * 1)(reference), 1, (VALUES[kind] * 1)()) == ERROR
    assert str(reference) in made.log[0][3]


@pytest.mark.parametrize("kind", VALUES)
@pytest.mark.parametrize("direction", ["Get", "Set"])
def test_a_reference_of_another_type_is_refused(direction, kind):
    for name in ("force", "regime", "indentation_rate"):
        # an enumeration is read as an integer
        if unit("steel_ball").variables[name].type.replace("Enumeration", "Integer") == kind:
            continue
        made = ready()
        reference = unit("steel_ball").reference[name]
        assert made.try_(direction + kind, (c_uint * 1)(reference), 1, (VALUES[kind] * 1)()) == ERROR


@pytest.mark.parametrize("kind", VALUES)
@pytest.mark.parametrize("direction", ["Get", "Set"])
def test_no_references_at_all_are_fine(direction, kind):
    made = ready()
    assert made.try_(direction + kind, None, 0, None) == OK


@pytest.mark.parametrize("kind", VALUES)
@pytest.mark.parametrize("direction", ["Get", "Set"])
def test_null_arrays_are_refused(direction, kind):
    assert ready().try_(direction + kind, None, 1, (VALUES[kind] * 1)()) == ERROR
    reference = (c_uint * 1)(unit("steel_ball").reference["indentation_rate"])
    assert ready().try_(direction + kind, reference, 1, None) == ERROR


def test_a_null_instance_is_an_error():
    functions = unit("steel_ball").slave._functions
    assert functions["fmi2DoStep"](None, 0.0, 1e-6, True) == ERROR
    assert functions["fmi2Terminate"](None) == ERROR
    assert functions["fmi2GetReal"](None, (c_uint * 1)(1), 1, (c_double * 1)()) == ERROR
    functions["fmi2FreeInstance"](None)


# status kinds: 0 DoStepStatus, 1 PendingStatus, 2 LastSuccessfulTime, 3 Terminated
@pytest.mark.parametrize("make", [ready, terminated])
def test_status_functions_answer_what_there_is(make):
    time, ended, status, number, text = c_double(), c_int(7), c_int(7), c_int(), c_char_p()
    made = make()
    made.call("GetRealStatus", 2, byref(time))
    assert time.value == made.time
    made.call("GetBooleanStatus", 3, byref(ended))
    assert ended.value == 0
    assert made.try_("GetStatus", 0, byref(status)) in (OK, DISCARD)
    assert status.value in (OK, 7)
    assert made.try_("GetStringStatus", 1, byref(text)) == DISCARD
    assert made.try_("GetIntegerStatus", 2, byref(number)) == DISCARD
    # a discarded query changes nothing
    assert made.get("force") is not None


@pytest.mark.parametrize("function, value", [
    ("GetStatus", c_int), ("GetRealStatus", c_double), ("GetIntegerStatus", c_int), ("GetBooleanStatus", c_int),
    ("GetStringStatus", c_char_p),
])
@pytest.mark.parametrize("kind", [-1, 4, 77])
def test_an_unknown_kind_of_status_is_refused(function, value, kind):
    assert ready().try_(function, kind, byref(value())) in (DISCARD, ERROR)


@pytest.mark.parametrize("order", [0, -1, 4, 77])
def test_impossible_orders_of_derivatives_are_refused(order):
    # order 0 is the value itself; no FMU of this project goes beyond 3
    made = ready()
    reference = (c_uint * 1)(unit("steel_ball").reference["indentation_rate"])
    assert made.try_("SetRealInputDerivatives", reference, 1, (c_int * 1)(order), (c_double * 1)(1.0)) == ERROR
    made = ready()
    made.step(1e-6, 1.0)
    reference = (c_uint * 1)(unit("steel_ball").reference["force"])
    assert made.try_("GetRealOutputDerivatives", reference, 1, (c_int * 1)(order), (c_double * 1)()) == ERROR


def test_the_size_of_no_state_is_refused():
    size = c_size_t()
    assert ready().try_("SerializedFMUstateSize", None, byref(size)) == ERROR
