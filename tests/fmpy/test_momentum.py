"""Impulse, mean and predicted force, and FMUs that know the mass."""

import math

import pytest
from courses import momentum_units, prepared, RATES, STEP
from unit import ERROR, bits, paths, unit

# momentum


@momentum_units
def test_the_mean_force_is_the_change_of_the_impulse_over_the_step(name):
    made, before = prepared(name), 0.0
    for rate in RATES:
        made.step(STEP, rate)
        impulse = made.get("impulse")
        assert made.get("mean_force") * STEP == pytest.approx(impulse - before, rel=1e-13, abs=1e-15 * impulse)
        before = impulse


@pytest.mark.parametrize("name", ["coupled", "all_outputs", "rate_dependent"])
def test_the_impulse_of_a_step_is_that_of_its_parts(name):
    whole, parts = prepared(name), prepared(name)
    for rate in RATES:
        whole.step(STEP, rate)
        for _ in range(50):
            parts.step(STEP / 50, rate)
        assert whole.get("impulse") == pytest.approx(parts.get("impulse"), rel=1e-11)


@pytest.mark.parametrize("name", ["coupled", "all_outputs"])
def test_a_held_rate_gives_the_work_over_the_way_as_mean_force(name):
    made = prepared("energies" if name == "coupled" else name)
    for rate in RATES:
        before = made.get("work")
        made.step(STEP, rate)
        done = made.get("work") - before
        assert made.get("mean_force") * rate * STEP == pytest.approx(done, rel=1e-9, abs=1e-12 * made.get("work"))


@pytest.mark.parametrize("step", [1e-9, 1e-12, 1e-15])
def test_the_mean_force_of_a_short_step_does_not_cancel(step):
    made = prepared("coupled", [3.0])
    before = made.get("force")
    made.step(step, 0.5)
    after = made.get("force")
    assert before <= made.get("mean_force") <= after or made.get("mean_force") == pytest.approx(after, rel=1e-14)
    assert made.get("mean_force") == pytest.approx(0.5 * (before + after), rel=1e-9)


@pytest.mark.parametrize("name", ["coupled", "all_outputs", "rate_dependent"])
def test_the_predicted_force_is_the_force_after_such_a_step(name):
    made = prepared(name)
    for rate in RATES:
        made.step(STEP, rate)
        expected = made.get("predicted_force")
        saved = made.state()
        made.step(STEP)
        assert bits(made.get("force")) == bits(expected)
        made.restore(saved)
        made.time -= STEP


def test_the_predicted_force_follows_a_rate_that_is_set():
    made = prepared("coupled", [3.0])
    made.set(indentation_rate=0.5)
    expected = made.get("predicted_force")
    made.step(STEP)
    assert bits(made.get("force")) == bits(expected)


@momentum_units
def test_before_the_first_step_there_is_no_impulse_and_the_mean_force_is_the_force(name):
    made = prepared(name, initial_gap=-2e-6)
    assert made.get("force") > 0.0
    assert made.get("impulse") == 0.0
    assert bits(made.get("mean_force")) == bits(made.get("force"))


def test_outputs_that_a_scene_does_not_ask_for_are_not_there():
    assert not {"impulse", "mean_force", "predicted_force", "effective_mass"} & unit("steel_ball").variables.keys()


# state


@pytest.mark.parametrize("name", ["coupled", "all_outputs", "mass_known"])
def test_derivatives_and_momentum_belong_to_the_state(name):
    made = prepared(name, RATES[:5])
    orders = (-4e4,) if name == "mass_known" else (-4e4, -3e9)
    made.set(indentation_rate=1.0)
    made.set_derivatives(*orders)
    saved, time, before = made.state(), made.time, made.outputs()
    derivatives = made.derivative(1), made.derivative(2)

    def go_on(instance):
        instance.time = time
        trace = [instance.outputs(), (instance.derivative(1), instance.derivative(2))]
        for rate in (None, None, 0.3, -2.0):
            instance.step(STEP, rate)
            trace += [instance.outputs(), (instance.derivative(1), instance.derivative(2))]
        return repr(trace)

    expected = go_on(made)
    assert repr([before, derivatives]) == repr(eval(expected)[:2])
    made.restore(saved)
    assert made.state() == saved
    assert go_on(made) == expected
    other = unit(name).instance()
    other.restore(saved)
    assert go_on(other) == expected
    made.restore(saved)
    made.call("Reset")
    assert made.state() == unit(name).instance().state(), "a reset instance has no derivatives"


# mass known


@pytest.mark.parametrize("value", [0.0, -0.0, -4e-3, math.nan, math.inf])
def test_a_mass_that_is_none_is_refused(value):
    made = unit("mass_known").instance()
    made.setup()
    made.call("EnterInitializationMode")
    assert made.try_set("effective_mass", value) == ERROR
    assert "effective_mass" in made.log[-1][3]


def test_two_contacts_that_know_their_mass_are_two_units():
    both = unit("two_known").ready()
    alone = {side: unit("mass_known").ready(impactor__radius=radius) for side, radius in (("left", 5e-3), ("right", 8e-3))}
    speeds = {"left": 1.0, "right": 0.4}
    for _ in range(12):
        for side, speed in speeds.items():
            both.set(**{f"{side}__indentation_rate": speed})
            alone[side].set(indentation_rate=speed)
        both.step(5e-6)
        for side, single in alone.items():
            single.step(5e-6)
            for key in ("force", "indentation", "mean_force", "impulse"):
                assert bits(both.get(f"{side}.{key}")) == bits(single.get(key)), (side, key)
            speeds[side] -= 5e-6 * single.get("mean_force") / 4e-3
    assert all(speed < 0.0 for speed in speeds.values()), "both have rebounded"


def test_of_two_contacts_each_has_its_own_derivatives():
    both, left, right = unit("two_plain").ready(), unit("coupled").ready(), unit("coupled").ready()
    for made, name in ((both, "left.indentation_rate"), (left, "indentation_rate")):
        made.try_set(name, 1.0)
        made.set_derivatives(-3e5, 1e10, name=name)
        made.step(STEP)
        made.step(STEP)
    right.step(STEP)
    for key in ("force", "indentation", "max_indentation", "mean_force", "impulse"):
        assert bits(both.get(f"left.{key}")) == bits(left.get(key)), key
        assert bits(both.get(f"right.{key}")) == bits(0.0), key


def test_every_unit_of_these_tests_is_there():
    assert {"coupled", "mass_known", "all_outputs", "rate_dependent", "two_known", "two_plain"} <= paths().keys()


def test_a_mass_in_flight_feels_no_force():
    ball = unit("mass_known").ready(initial_gap=0.02)
    speed = 0.0
    for _ in range(50):
        ball.set(indentation_rate=speed)
        ball.set_derivatives(9.81)
        ball.step(1e-3)
        speed += 1e-3 * 9.81
        assert (ball.get("mean_force"), ball.get("impulse")) == (0.0, 0.0)
    assert ball.get("indentation") == pytest.approx(0.5 * 9.81 * 0.05**2 - 0.02, rel=1e-12)


@pytest.mark.parametrize("total", [0.05, 0.2, 1.0, 10.0])
def test_one_long_step_of_a_known_mass_is_many_short_ones(total):
    ends = []
    for steps in (1, 7, 1000):
        ball, speed = unit("mass_known").ready(initial_gap=0.02), 0.0
        for _ in range(steps):
            ball.set(indentation_rate=speed)
            ball.set_derivatives(9.81)
            ball.step(total / steps)
            assert ball.get("mean_force") >= 0.0
            speed += total / steps * (9.81 - ball.get("mean_force") / 4e-3)
        ends.append((speed, ball.get("indentation"), ball.get("dissipated_energy"), ball.get("impulse")))
    # a bounce amplifies the rounding error of the previous one
    for end in ends[1:]:
        assert end == pytest.approx(ends[0], rel=1e-7)
