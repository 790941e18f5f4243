"""Importers with both orders of execution and steps of any length: the ball rebounds according to the energy balance."""

import ctypes
import math
import random
import re
from ctypes import c_double, c_int

import pytest
import test_coupling
from unit import ERROR, WARNING, unit

MASS = 4e-3
PATTERNS = ["equal", "alternating", "any"]
KINDS = ["serial", "parallel", "serial_wired", "parallel_wired"]


def steps(size, pattern):
    """Steps of about this size [s]: equal, 1:3, or from a third to three times the size."""
    chance = random.Random(7)
    while True:
        if pattern == "any":
            yield size * 3 ** chance.uniform(-1.0, 1.0)
        elif pattern == "equal":
            yield size
        else:
            yield 0.5 * size
            yield 1.5 * size


class Master:
    """A ball that moves against the contact: contact first (serial), or both at once (parallel)."""

    def __init__(self, name, order, speed, gap=0.0, gravity=0.0):
        self.order, self.speed, self.gravity, self.mass = order, speed, gravity, MASS
        self.contact = unit(name).instance()
        self.contact.initialize(initial_gap=gap)
        self.wired = "external_acceleration" in self.contact.unit.reference

    def step(self, step):
        before = self.contact.get("mean_force")
        self.contact.set(indentation_rate=self.speed)
        if self.wired:
            self.contact.set(external_acceleration=self.gravity, effective_mass=self.mass)
        elif self.gravity != 0.0:
            self.contact.set_derivatives(self.gravity)
        self.contact.step(step)
        force = before if self.order == "parallel" else self.contact.get("mean_force")
        self.speed += step * (self.gravity - force / self.mass)

    def told(self):
        return [message for *_, message in self.contact.log]

    def has_parted(self):
        speed = self.contact.get("closing_speed")
        return self.contact.get("force") == 0.0 and speed < 0.0 and abs(self.speed - speed) < 1e-12


@pytest.mark.parametrize("name", KINDS)
@pytest.mark.parametrize("pattern", PATTERNS)
@pytest.mark.parametrize("size", [1e-6, 1e-5, 1e-4, 2e-3])
def test_the_restitution_is_the_predicted_one(name, pattern, size):
    master = Master(name, name.split("_")[0], 1.0, gap=0.3 * size)
    for step in steps(size, pattern):
        master.step(step)
        if master.has_parted():
            break
        assert master.contact.time < 1.0
    assert abs(-master.speed / test_coupling.impact().restitution - 1.0) < 1e-11
    assert master.told() == []


@pytest.mark.parametrize("name", KINDS)
@pytest.mark.parametrize("pattern", PATTERNS)
@pytest.mark.parametrize(("size", "gravity"), [(1e-6, 50.0), (1e-4, 9.81), (1e-3, 9.81), (5e-3, 9.81)])
def test_a_ball_bounces_ten_times_to_the_same_height(name, pattern, size, gravity, monkeypatch):
    monkeypatch.setattr(test_coupling, "GRAVITY", gravity)
    fall = 0.25
    master = Master(name, name.split("_")[0], fall, gravity=gravity)
    # at the dent, in which all later impacts are elastic
    expected = 0.5 * test_coupling.rebound_under_gravity(fall, MASS)
    impulse, bounces = 0.0, 0
    for step in steps(size if size < 5e-3 else 4e-3, pattern):
        master.step(step)
        contact = master.contact
        if contact.get("force") == 0.0:
            if contact.get("impulse") > impulse:
                impulse, bounces = contact.get("impulse"), bounces + 1
            height = contact.get("residual_indentation") - contact.get("indentation")
            energy = 0.5 * contact.get("closing_speed") ** 2 + gravity * height
            assert abs(energy / expected - 1.0) < 1e-9, bounces
        if bounces == 10:
            break
        assert contact.time < 5.0
    assert master.told() == []


@pytest.mark.parametrize("name", ["serial", "parallel", "serial_wired", "parallel_wired"])
@pytest.mark.parametrize("size", [1e-6, 1e-4, 2e-3])
def test_a_master_of_the_other_order_is_told_once_with_the_line_to_change(name, size):
    kind = name.split("_")[0]
    other = {"serial": "parallel", "parallel": "serial"}[kind]
    master = Master(name, other, 1.0)
    for _ in range(100):
        master.step(size)
    (message,) = master.told()
    assert re.match(r"fmi2DoStep: indentation_rate = \S+ m/s, expected \S+ m/s: the master applies mean_force ", message)
    line = 'write master = "parallel" under [coupling]' if kind == "serial" else 'leave out master = "parallel" under [coupling]'
    assert line in message
    assert master.contact.log[0][1:3] == (WARNING, "logStatusWarning")
    master.contact.call("Reset")
    master.contact.initialize()
    master.speed = 1.0
    for _ in range(100):
        master.step(size)
    assert len(master.told()) == 2, "and again after a reset"


@pytest.mark.parametrize("name", KINDS)
@pytest.mark.parametrize("size", [1e-6, 1e-3])
@pytest.mark.parametrize(("share", "expected"), [
    (0.5, "the rate follows 0.5 times mean_force: the master moves a mass of 0.008 kg, the FMU one of 0.004 kg; give the same to both"),
    (0.0, ": the rate does not follow mean_force at all; apply it to the bodies, or, for a prescribed motion, leave out [coupling] in the"),
])
def test_a_master_that_moves_another_mass_or_applies_no_force_is_told_so(name, size, share, expected):
    master = Master(name, name.split("_")[0], 1.0, gap=0.5 * size)
    for _ in range(100):
        before = master.speed
        master.step(size)
        master.speed = before + share * (master.speed - before)
    (message,) = master.told()
    assert expected in message


def test_the_mass_is_a_tunable_parameter_and_an_input_to_the_same_effect():
    tuned, wired = Master("serial", "serial", 1.0), Master("serial_wired", "serial", 1.0)
    for count in range(60):
        mass = MASS * (1.0 + 0.5 * math.sin(0.3 * count))
        kept = tuned.contact.outputs()
        tuned.contact.set(effective_mass=mass)
        assert tuned.contact.outputs() == kept
        assert tuned.contact.get("effective_mass") == mass
        tuned.mass = wired.mass = mass
        tuned.step(2e-6)
        wired.step(2e-6)
        assert tuned.speed == wired.speed and tuned.contact.outputs() == wired.contact.outputs()
    assert tuned.speed < 0.0


@pytest.mark.parametrize("name", ["serial", "parallel_wired"])
@pytest.mark.parametrize("mass", [0.0, -1.0, math.nan, math.inf, 1e31])
def test_a_mass_out_of_its_range_is_refused_by_name(name, mass):
    contact = unit(name).ready()
    contact.step(1e-6, rate=1.0)
    assert contact.try_set("effective_mass", mass) == ERROR
    assert "effective_mass = " in contact.log[-1][3] and "allowed is 1e-30 to 1e30 kg" in contact.log[-1][3]


def test_other_parameters_stay_fixed_after_initialization():
    contact = unit("serial").ready()
    assert contact.try_set("target.yield_strength", 2e8) == ERROR
    assert "can't be set after initialization" in contact.log[-1][3]


def test_derivatives_are_refused_where_the_acceleration_is_an_input():
    contact = unit("serial_wired").ready()
    assert not contact.unit.description.coSimulation.canInterpolateInputs
    assert contact.try_set_derivatives("indentation_rate", [1], [9.81]) == ERROR
    assert "external_acceleration" in contact.log[-1][3]


def test_an_acceleration_holds_until_another_one_is_set():
    contact = unit("serial_wired").ready(initial_gap=1.0)
    contact.set(external_acceleration=2.0)
    speed = 0.0
    for _ in range(3):
        contact.step(0.1, rate=speed)
        speed = contact.get("closing_speed")
    assert abs(speed - 0.6) < 1e-15
    assert abs(contact.get("indentation") - (0.5 * 2.0 * 0.3**2 - 1.0)) < 1e-15


@pytest.mark.parametrize("name", KINDS)
@pytest.mark.parametrize("size", [2e-6, 1e-3])
def test_a_state_holds_what_is_on_its_way(name, size):
    master = Master(name, name.split("_")[0], 1.0, gravity=9.81)
    for _ in range(3):
        master.step(size)
    state, speed, time = master.contact.state(), master.speed, master.contact.time

    def run():
        for _ in range(20):
            master.step(size)
        return master.speed, master.contact.outputs()

    once = run()
    for fresh in (False, True):
        if fresh:
            master.contact = unit(name).ready()
        master.contact.restore(state)
        master.contact.time, master.speed = time, speed
        assert run() == once
    assert master.told() == []


@pytest.mark.parametrize("name", KINDS)
def test_the_closing_speed_follows_the_input_before_the_first_step_and_no_longer_after(name):
    contact = unit(name).instance()
    contact.setup()
    contact.call("EnterInitializationMode")
    contact.set(indentation_rate=0.7)
    assert contact.get("closing_speed") == 0.7
    known, output = (ctypes.c_uint * 1)(0), (ctypes.c_uint * 1)(contact.unit.reference["closing_speed"])
    derivative = (c_double * 1)()

    def by_rate():
        contact.call("GetDirectionalDerivative", output, 1, known, 1, (c_double * 1)(1.0), derivative)
        return derivative[0]

    assert by_rate() == 1.0
    contact.call("ExitInitializationMode")
    contact.set(indentation_rate=0.2)
    assert contact.get("closing_speed") == 0.7 and by_rate() == 0.0
    contact.step(1e-6)
    assert 0.0 < contact.get("closing_speed") < 0.2
    # its time derivative is the deceleration by the force
    slope = (c_double * 1)()
    contact.call("GetRealOutputDerivatives", output, 1, (c_int * 1)(1), slope)
    assert abs(slope[0] / (-contact.get("force") / MASS) - 1.0) < 1e-12


def test_a_bouncing_ball_ends_and_starts_again():
    master = Master("parallel", "parallel", 1.0)
    for _ in range(3):
        master.step(5e-6)
    on_its_way = master.contact.get("mean_force")
    assert on_its_way > 0.0
    master.contact.call("Terminate")
    assert master.contact.get("mean_force") == on_its_way
    master.contact.call("Reset")
    master.contact.initialize()
    assert master.contact.get("mean_force") == 0.0
    master.speed = 1.0
    while not master.has_parted():
        master.step(5e-6)
    assert abs(-master.speed / test_coupling.impact().restitution - 1.0) < 1e-11


def test_steps_that_are_unstable_with_the_mass_of_the_impact_are_told_once():
    contact = unit("coupled").instance()
    contact.initialize(initial_gap=1e-4)
    speed, size = 1.0, 2e-4
    for _ in range(4):
        contact.step(size, rate=speed)
        speed -= size * contact.get("force") / MASS
    assert abs(speed) > 100.0
    told = [message for *_, category, message in contact.log if "unstable" in message and category == "logStatusWarning"]
    assert told == ["fmi2DoStep: steps of 0.0002 s are unstable with a mass of 0.004 kg: make them shorter, or let the unit move it by [coupling]"]


def test_a_force_that_is_late_is_told_once():
    contact = unit("coupled").instance()
    contact.initialize(initial_gap=1e-6)
    speed, size = 1.0, 5e-7
    for _ in range(60):
        before = contact.get("force")
        contact.step(size, rate=speed)
        speed -= size * before / MASS
    expected = "fmi2DoStep: the master applies the force one step late: connect predicted_force, or step the contact first and connect force"
    assert [message for *_, message in contact.log] == [expected]


def test_a_prescribed_motion_of_the_same_length_is_not_told():
    contact = unit("coupled").instance()
    contact.initialize()
    for count in range(200):
        contact.step(2e-3, rate=1e-3 * math.cos(0.3 * count))
    assert contact.log == []
