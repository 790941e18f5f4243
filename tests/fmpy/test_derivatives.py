"""Derivatives of inputs and outputs by time, and what belongs to a step: impulse, mean force, predicted force."""

import math
from fractions import Fraction

import pytest
from unit import ERROR, OK, bits, unit

STEP = 1e-6
# each as (rates of steps before, course of the step): loading in each region, unloading, in and out again, apart
COURSES = {
    "elastic": ([], (0.001, 200.0, 1e8)),
    "first region": ([0.01], (0.02, 3e4, -4e9)),
    "plastic": ([3.0], (0.7, -2e5, 5e10)),
    "unloading": ([3.0, -0.1], (-0.3, -2e5, 5e10)),
    "reloading": ([3.0, -0.3], (0.2, -1e5, 3e10)),
    "through the end of the dent": ([3.0, 3.0], (-2.0, 1e5, 0.0)),
    "in and out again": ([0.5], (2.0, -4e6, 0.0)),
    "out and in again": ([2.0], (-2.0, 1.6e7, -3e13)),
    "apart": ([-1.0], (-0.1, 5e3, 1e8)),
}
RATES = [1.3, 2.0, 0.7, -0.4, 0.3, -1.5, 1.0, 4.0, 5.0, -0.1, -9.0, 8.0]
every_course = pytest.mark.parametrize("name", COURSES)


def prepared(name, rates=()):
    made = unit(name).ready()
    for rate in rates:
        made.step(STEP, rate)
    return made


def course(made, rate, slope, bend):
    made.set(indentation_rate=rate)
    made.set_derivatives(slope, bend)


def way(rate, slope, bend, time):
    """The displacement in exact arithmetic."""
    rate, slope, bend, time = map(Fraction, (rate, slope, bend, time))
    return time * (rate + time * (slope / 2 + bend * time / 6))


@every_course
def test_the_indentation_follows_the_polynomial_for_one_step(name):
    rates, polynomial = COURSES[name]
    made = prepared("coupled", rates)
    before = made.get("indentation")
    course(made, *polynomial)
    made.step(STEP)
    after = made.get("indentation")
    assert after == pytest.approx(float(Fraction(before) + way(*polynomial, STEP)), rel=1e-14, abs=1e-20)
    made.step(STEP)
    assert made.get("indentation") - after == pytest.approx(polynomial[0] * STEP, rel=1e-9)


@pytest.mark.parametrize(
    ("polynomial", "turn"),
    [
        ((1.0, -2.0e6, 0.0), Fraction(1, 2) * Fraction(1e-6)),
        # the rate (t - 3e-7)(t - 8e-7) bend/2: in up to the first root, out up to the second, and in again
        ((4.0, -3.6666666666666664e7, 3.3333333333333331e13), None),
        # and a rate that only slows down
        ((2.0, -1.9e6, 0.0), Fraction(1e-6)),
    ],
)
def test_a_step_that_goes_in_and_out_again_leaves_the_dent_of_its_extreme(polynomial, turn):
    made = prepared("coupled")
    course(made, *polynomial)
    made.step(STEP)
    rate, slope, bend = polynomial
    if turn is None:
        turn = -2.0 * rate / (slope - math.sqrt(slope * slope - 2.0 * bend * rate))
    deepest = float(max(way(*polynomial, turn), way(*polynomial, STEP)))
    assert made.get("max_indentation") == pytest.approx(deepest, rel=1e-15)
    pressed = unit("coupled").ready(initial_gap=-deepest)
    assert made.get("residual_indentation") == pytest.approx(pressed.get("residual_indentation"), rel=1e-14)


@pytest.mark.parametrize("orders", [[1, 2], [2, 1], [1, 2, 2]])
def test_orders_and_values_belong_together_and_the_last_one_counts(orders):
    made, expected = prepared("coupled"), prepared("coupled")
    values = [-4e4 if order == 1 else -3e9 for order in orders]
    values[len(orders) - 2] = 7e4 if orders[-2:] == [2, 2] else values[-2]
    made.set(indentation_rate=1.0)
    assert made.try_set_derivatives("indentation_rate", orders, values) == OK
    course(expected, 1.0, -4e4, -3e9)
    for instance in (made, expected):
        instance.step(STEP)
    assert made.state() == expected.state()


@pytest.mark.parametrize(("name", "variable", "order", "value", "words"), [
    *(("coupled", "indentation_rate", order, 1.0, f"order {order}") for order in (0, 3, -1, 17)),
    ("mass_known", "indentation_rate", 2, 1.0, "order 2"),
    *(("coupled", "indentation_rate", 1, value, word) for value, word in ((math.nan, "nan"), (-math.inf, "-inf"))),
    ("coupled", "force", 1, 1.0, "indentation_rate"),
    ("coupled", "target.yield_strength", 1, 1.0, "indentation_rate"),
])
def test_wrong_derivatives_are_refused_with_their_value(name, variable, order, value, words):
    made = prepared(name)
    assert made.try_set_derivatives(variable, [order], [value]) == ERROR
    assert words in made.log[-1][3].lower()


@every_course
def test_output_derivatives_are_those_of_the_force_at_the_end_of_the_step(name):
    rates, polynomial = COURSES[name]
    made = prepared("coupled", rates)
    saved, time = made.state(), made.time

    def force(end):
        made.restore(saved)
        made.time = time
        course(made, *polynomial)
        made.step(end)
        return made.get("force")

    # the force over time, from the left: neighbouring points, spaced so that neither error dominates
    wide = 2e-4 * STEP
    values = [force(STEP - index * wide) for index in range(5)]
    assert force(STEP) == values[0]
    first = (25 * values[0] - 48 * values[1] + 36 * values[2] - 16 * values[3] + 3 * values[4]) / (12 * wide)
    second = (35 * values[0] - 104 * values[1] + 114 * values[2] - 56 * values[3] + 11 * values[4]) / (12 * wide**2)
    scale = abs(values[0]) / STEP
    assert made.derivative(1) == pytest.approx(first, rel=1e-6, abs=1e-9 * scale)
    assert made.derivative(2) == pytest.approx(second, rel=1e-3, abs=1e-6 * scale / STEP)


@pytest.mark.parametrize("name", ["all_outputs", "rate_dependent"])
def test_impulse_mean_force_and_predicted_force_belong_to_the_step(name):
    # a force is predicted for a step like the last one
    whole, parts = prepared(name, RATES[:1]), prepared(name, RATES[:1])
    for rate in RATES[1:]:
        before = whole.outputs()
        whole.set(indentation_rate=rate)
        predicted = whole.get("predicted_force")
        whole.step(STEP)
        after = whole.outputs()
        assert bits(after["force"]) == bits(predicted)
        change = after["impulse"] - before["impulse"]
        assert after["mean_force"] * STEP == pytest.approx(change, rel=1e-13, abs=1e-15 * after["impulse"])
        if name == "all_outputs":
            done = after["work"] - before["work"]
            assert after["mean_force"] * rate * STEP == pytest.approx(done, rel=1e-9, abs=1e-12 * after["work"])
        for _ in range(50):
            parts.step(STEP / 50, rate)
        assert after["impulse"] == pytest.approx(parts.get("impulse"), rel=1e-11)
