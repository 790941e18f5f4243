"""Saved states: continuing after a restore gives the same bits, in this process and in another one."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from unit import bits, paths, unit

every_unit = pytest.mark.parametrize("name", sorted(paths()))
# rates [m/s] of steps of 1 us: in, out, apart, and in again, through all branches of the law
RATES = [1.3, 2.0, 0.7, -0.4, 0.3, -5.0, -1.0, 4.0, 5.0, -0.1]


def run(instance, rates):
    """The bits of every output after each step, and the state."""
    trace = []
    for rate in rates:
        instance.step(1e-6, rate)
        trace.append({key: bits(value) for key, value in instance.outputs().items()} | {"state": instance.state().hex()})
    return trace


@every_unit
def test_the_run_after_restoring_is_the_run_before_it_to_the_last_byte(name):
    instance, other = unit(name).ready(), unit(name).instance()
    for at in range(len(RATES)):
        saved, time = instance.state(), instance.time
        first = run(instance, RATES[at:])
        for again in (instance, other):
            again.restore(saved)
            again.time = time
            assert again.state() == saved
            assert run(again, RATES[at:]) == first
        instance.restore(saved)
        instance.time = time
        run(instance, [RATES[at]])
    new = unit(name).instance().state()
    assert instance.state() != new and len(new) < 4096, "a state is a handful of numbers"
    instance.call("Reset")
    assert instance.state() == new, "a reset instance is a new one"


@every_unit
@pytest.mark.parametrize("phase", ["initialization", "step"])
def test_parameters_and_the_phase_are_those_of_the_saved_state(name, phase):
    for key in unit(name).parameters:
        start = float(unit(name).variables[key].start)
        value = 1.01 * start if start != 0.0 else -1e-6
        changed, plain = unit(name).instance(name="changed"), unit(name).ready()
        changed.setup(2.0, 3.0)
        changed.call("EnterInitializationMode")
        changed.set(**{key: value})
        if phase == "step":
            changed.call("ExitInitializationMode")
            run(changed, RATES[:2])
        plain.restore(changed.state())
        plain.time = changed.time
        assert bits(plain.get(key)) == bits(value)
        for instance in (plain, changed):
            if phase == "initialization":
                instance.call("ExitInitializationMode")
        assert run(plain, RATES[2:]) == run(changed, RATES[2:])
        assert plain.try_step(plain.time, 2.0) != 0, "beyond the stop time"
        assert plain.log[-1][0] == "instance", "the name does not belong to the state"


CONTINUE = """
import json, sys
from unit import Unit
from test_state_is_restored import RATES, run
for path, state, time in json.load(sys.stdin):
    instance = Unit(path).instance()
    instance.restore(bytes.fromhex(state))
    instance.time = float.fromhex(time)
    print(json.dumps(run(instance, RATES[4:])))
"""


def test_another_process_continues_with_the_same_bits():
    saved, expected = [], []
    for name in sorted(paths()):
        instance = unit(name).ready()
        run(instance, RATES[:4])
        # to an instance that was never initialized: the phase is a part of the state
        saved.append([unit(name).path, instance.state().hex(), instance.time.hex()])
        expected.append(run(instance, RATES[4:]))
    other = subprocess.run(
        [sys.executable, "-c", CONTINUE], cwd=Path(__file__).parent, input=json.dumps(saved), capture_output=True, text=True
    )
    assert other.returncode == 0, other.stderr
    assert [json.loads(line) for line in other.stdout.splitlines()] == expected
