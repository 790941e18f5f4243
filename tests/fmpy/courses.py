"""Paths through the law for the tests of derivatives and momentum: constant rates, and polynomials in time."""

from fractions import Fraction

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
RATES = [1.3, 2.0, 0.7, -0.4, 0.3, -1.5, 1.0, 4.0, 5.0, -0.1, -9.0, 8.0]
every_course = pytest.mark.parametrize("name", COURSES)
momentum_units = pytest.mark.parametrize("name", ["coupled", "all_outputs", "mass_known"])


def prepared(name, rates=(), **parameters):
    made = unit(name).ready(**parameters)
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


def at_course_after(rate, slope, bend, time):
    """The same polynomial, starting later."""
    return (rate + time * (slope + 0.5 * bend * time), slope + bend * time, bend)
