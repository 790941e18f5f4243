"""Derivatives of inputs and outputs by time."""

import pytest
from unit import unit

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


def course(made, rate, slope, bend):
    made.set(indentation_rate=rate)
    made.set_derivatives(slope, bend)


@pytest.mark.parametrize("orders", [[1, 2], [2, 1], [1, 2, 2]])
def test_orders_and_values_belong_together_and_the_last_one_counts(orders):
    made, expected = unit("coupled").ready(), unit("coupled").ready()
    values = [-4e4 if order == 1 else -3e9 for order in orders]
    values[len(orders) - 2] = 7e4 if orders[-2:] == [2, 2] else values[-2]
    made.set(indentation_rate=1.0)
    made.set_derivatives(*values, orders=orders)
    course(expected, 1.0, -4e4, -3e9)
    for instance in (made, expected):
        instance.step(STEP)
    assert made.state() == expected.state()


@pytest.mark.parametrize("name", COURSES)
def test_output_derivatives_are_those_of_the_force_at_the_end_of_the_step(name):
    rates, polynomial = COURSES[name]
    made = unit("coupled").ready()
    for rate in rates:
        made.step(STEP, rate)
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
