"""Calls out of order are rejected; harmless calls of real importers are tolerated."""

from ctypes import byref, c_double, c_int, c_uint, c_void_p

import pytest
from unit import ERROR, OK, unit


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
    "GetReal": lambda made: made.try_get("force")[0],
    "GetInteger": get_integer,
    "SetReal": lambda made: made.try_set("indentation_rate", 0.5),
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
