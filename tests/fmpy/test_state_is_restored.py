"""Saved states: continuing after a restore gives the same bits, in this process and in another one."""

import subprocess
import sys
from ctypes import byref, c_void_p
from pathlib import Path

import pytest
from unit import ERROR, OK, bits, paths, unit

every_unit = pytest.mark.parametrize("name", sorted(paths()))

# rates [m/s] of steps of 1 us: in, out, apart, and in again, through all branches of the law
RATES = [1.3, 2.0, 0.7, -0.4, 0.3, -5.0, -1.0, 4.0, 5.0, -0.1]


def run(instance, rates):
    """The bits of every output after each step."""
    trace = []
    for rate in rates:
        instance.step(1e-6, rate)
        trace.append({key: bits(value) for key, value in instance.outputs().items()})
    return trace


@every_unit
@pytest.mark.parametrize("at", range(len(RATES)))
def test_the_run_after_restoring_is_the_run_before_it(name, at):
    instance = unit(name).ready()
    run(instance, RATES[:at])
    saved, time = instance.state(), instance.time
    first = run(instance, RATES[at:])
    instance.restore(saved)
    instance.time = time
    assert run(instance, RATES[at:]) == first
    assert instance.log == []


@every_unit
@pytest.mark.parametrize("at", range(len(RATES)))
def test_the_run_after_restoring_has_the_same_bytes_after_each_step(name, at):
    def states(instance):
        return [run(instance, [rate]) and instance.state() for rate in RATES[at:]]

    instance = unit(name).ready()
    run(instance, RATES[:at])
    saved, time = instance.state(), instance.time
    first = states(instance)
    instance.restore(saved)
    instance.time = time
    assert states(instance) == first


@every_unit
def test_a_state_in_memory_can_be_set_many_times(name):
    instance = unit(name).ready()
    run(instance, RATES[:3])
    pointer = c_void_p()
    instance.call("GetFMUstate", byref(pointer))
    time, traces = instance.time, []
    for _ in range(3):
        instance.call("SetFMUstate", pointer)
        instance.time = time
        traces.append(run(instance, RATES[3:]))
    assert traces[0] == traces[1] == traces[2]
    # a second get to the same pointer overwrites it
    address = pointer.value
    instance.call("GetFMUstate", byref(pointer))
    assert pointer.value == address
    instance.call("FreeFMUstate", byref(pointer))
    assert pointer.value is None
    instance.call("FreeFMUstate", byref(pointer))
    instance.call("FreeFMUstate", None)


@every_unit
def test_saving_changes_nothing(name):
    watched, alone = unit(name).ready(), unit(name).ready()
    trace = []
    for rate in RATES:
        watched.state()
        trace += run(watched, [rate])
    assert trace == run(alone, RATES)


@every_unit
def test_a_restored_state_is_the_saved_one_to_the_last_byte(name):
    instance = unit(name).ready()
    run(instance, RATES[:5])
    saved = instance.state()
    run(instance, RATES[5:])
    assert instance.state() != saved
    instance.restore(saved)
    assert instance.state() == saved
    assert len(saved) < 4096, "a state is a handful of numbers"


CONTINUE = """
import sys
from unit import Unit, bits
from test_state_is_restored import run
instance = Unit(sys.argv[1]).instance()
instance.restore(bytes.fromhex(sys.argv[2]))
instance.time = float.fromhex(sys.argv[3])
print(run(instance, [float(rate) for rate in sys.argv[4:]]))
"""


@every_unit
def test_another_process_continues_with_the_same_bits(name):
    instance = unit(name).ready()
    run(instance, RATES[:4])
    saved, time = instance.state(), instance.time
    # to an instance that was never initialized: the phase is a part of the state
    arguments = [unit(name).path, saved.hex(), time.hex(), *map(repr, RATES[4:])]
    other = subprocess.run(
        [sys.executable, "-c", CONTINUE, *arguments], cwd=Path(__file__).parent, capture_output=True, text=True
    )
    assert other.returncode == 0, other.stderr
    assert other.stdout.strip() == str(run(instance, RATES[4:]))


@every_unit
def test_a_reset_instance_is_a_new_one_to_the_last_byte(name):
    new = unit(name).instance().state()
    used = unit(name).instance()
    parameters = unit(name).parameters
    if parameters:
        used.set(**{parameters[0]: 1.1 * float(unit(name).variables[parameters[0]].start)})
    used.initialize(5.0, 6.0)
    run(used, RATES)
    assert used.state() != new
    used.call("Reset")
    assert used.state() == new


@every_unit
@pytest.mark.parametrize("end", ["Terminate", "error", "Reset"])
def test_a_state_can_be_restored_after(name, end):
    instance = unit(name).ready()
    run(instance, RATES[:4])
    saved, time = instance.state(), instance.time
    expected = run(instance, RATES[4:])
    if end == "error":
        assert instance.try_step(instance.time, -1.0) == ERROR
        assert instance.try_step(instance.time, 1e-6) == ERROR
    else:
        instance.call(end)
    instance.restore(saved)
    instance.time = time
    assert run(instance, RATES[4:]) == expected


@every_unit
def test_phase_times_inputs_and_parameters_belong_to_the_state(name):
    instance = unit(name).instance()
    instance.setup(2.0, 3.0)
    instance.call("EnterInitializationMode")
    instance.set(indentation_rate=0.25)
    saved = instance.state()
    other = unit(name).instance()
    other.restore(saved)
    assert other.get("indentation_rate") == 0.25
    assert other.try_("EnterInitializationMode") == ERROR, "it is in Initialization Mode already"
    other.restore(saved)
    other.call("ExitInitializationMode")
    other.call("DoStep", 2.0, 0.5, True)
    assert other.try_step(2.5, 0.6) == ERROR, "beyond the stop time"


def test_parameters_of_a_restored_state_are_the_saved_ones():
    for name in paths():
        for key in unit(name).parameters:
            start = float(unit(name).variables[key].start)
            value = 1.01 * start if start != 0.0 else -1e-6
            changed, plain = unit(name).ready(**{key: value}), unit(name).ready()
            run(changed, RATES[:2])
            plain.restore(changed.state())
            plain.time = changed.time
            assert bits(plain.get(key)) == bits(value)
            assert run(plain, RATES[2:]) == run(changed, RATES[2:])


@every_unit
def test_the_name_and_the_log_do_not_belong_to_the_state(name):
    one, other = unit(name).instance(name="one"), unit(name).instance(name="other")
    one.initialize()
    other.restore(one.state())
    assert other.try_step(0.0, -1.0) == ERROR
    assert one.log == [] and [entry[0] for entry in other.log] == ["other"]


@every_unit
def test_an_initialized_state_is_worth_a_whole_initialization(name):
    saved = unit(name).ready(1.0, 2.0).state()
    instance = unit(name).instance()
    instance.restore(saved)
    assert instance.try_step(1.0, 0.5) == OK
