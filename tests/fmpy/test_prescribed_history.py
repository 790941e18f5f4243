"""Indentation driven through a list of values gives the tabulated forces, however the path is divided into steps.

The table for the Big-Alabo law is normalised by indentation and force at first yield. It was computed independently of
this project with 30 digits and printed with ten. The units are those of the case for which it was computed.
"""

import math
import random

import pytest
from unit import unit

# x to be reached, then f for each unloading law
TABLE = [
    # x, contact_radius, thornton, original_radius
    ("0.5", "0.3535533906", "0.3535533906", "0.3535533906"),
    ("1", "1", "1", "1"),
    ("0.6", "0.4647580015", "0.4647580015", "0.4647580015"),
    ("2", "2", "2", "2"),
    ("10", "28", "28", "28"),
    ("8", "17.29323578", "19.07097989", "19.40369871"),
    ("9", "22.43290254", "23.39314625", "23.57093855"),
    ("20", "80.23413431", "80.23413431", "80.23413431"),
    ("15", "38.76583468", "49.15181104", "50.16849956"),
    ("19", "71.16482068", "73.62029385", "73.8522712"),
    ("20", "80.23413431", "80.23413431", "80.23413431"),
    ("50", "242.0465257", "242.0465257", "242.0465257"),
    ("40", "108.1470504", "144.1527492", "154.8695291"),
    ("100", "506.4341921", "506.4341921", "506.4341921"),
    ("95", "404.418614", "433.3170183", "447.844452"),
    ("90", "310.3557487", "364.1026546", "391.7065435"),
    ("300", "1524.61601", "1524.61601", "1524.61601"),
    ("250", "133.7004242", "432.8556195", "748.8909231"),
]
CLOSURES = ["contact_radius", "thornton", "original_radius"]

# Ten digits were printed without trailing zeros, so the last digit is the tenth, not the last one shown.
DIGITS = 10


def tolerance(printed):
    """Half a unit of the tenth digit, and 1e-9 for the rounding of the indentation in a thousand steps."""
    value = float(printed)
    half_a_unit = 0.5 * 10.0 ** (math.floor(math.log10(value)) - (DIGITS - 1))
    return max(half_a_unit, 1e-9 * value)


def yield_point(instance):
    """Indentation and force at first yield, from the parameters of the unit: mean pressure 1.1 S, rigid sphere."""
    radius = instance.get("impactor.radius")
    effective_modulus = instance.get("target.youngs_modulus") / (1.0 - instance.get("target.poissons_ratio") ** 2)
    pressure = 1.1 * instance.get("target.yield_strength")
    indentation = radius * (3.0 * math.pi * pressure / (4.0 * effective_modulus)) ** 2
    return indentation, math.pi * pressure * radius * indentation


def drive(instance, to, steps):
    """Moves the indentation of `instance` to `to` [m] in steps of the given lengths [s], at constant speed."""
    rate = (to - instance.get("indentation")) / math.fsum(steps)
    for step in steps:
        instance.step(step, rate)


def equal_steps(count):
    return lambda _index: [1e-3] * count


def unequal_steps(index):
    """From a nanosecond to a second, in a different order between any two points."""
    source = random.Random(index)
    return [10.0 ** source.uniform(-9.0, 0.0) for _ in range(97)]


WAYS = {"1 step": equal_steps(1), "7 steps": equal_steps(7), "1000 steps": equal_steps(1000), "unequal": unequal_steps}


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("closure", CLOSURES)
def test_the_force_is_that_of_the_table(closure, way):
    column = 1 + CLOSURES.index(closure)
    instance = unit(closure).ready()
    d_y, f_y = yield_point(instance)
    # printed with 12 digits next to the table
    assert (d_y, f_y) == pytest.approx((5.89886558464e-8, 0.305775240956), rel=1e-11)
    largest = 0.0
    for index, row in enumerate(TABLE):
        x = float(row[0])
        largest = max(largest, x)
        drive(instance, x * d_y, WAYS[way](index))
        # the distance is exact: the law is tested, not the sum of the steps
        assert instance.get("indentation") == pytest.approx(x * d_y, rel=1e-12)
        expected = pytest.approx(float(row[column]), rel=0, abs=tolerance(row[column]))
        assert instance.get("force") / f_y == expected, index
        # within rounding: the last step may end an ulp short
        assert instance.get("max_indentation") / d_y == pytest.approx(largest, rel=1e-12)


@pytest.mark.parametrize("closure", CLOSURES)
def test_the_regime_follows_the_law(closure):
    instance = unit(closure).ready()
    d_y, _ = yield_point(instance)
    # boundaries of the law: x = 1, 13.93, 82.5
    for x, regime in [(0.9, 1), (0.2, 1), (5.0, 2), (4.0, 5), (13.0, 2), (20.0, 3), (80.0, 3), (90.0, 4), (85.0, 5)]:
        drive(instance, x * d_y, [1e-3] * 3)
        assert instance.get("regime") == regime, x
    drive(instance, -d_y, [1e-3])
    assert instance.get("regime") == 0 and instance.get("force") == 0.0
