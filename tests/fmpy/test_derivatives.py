"""Input and output derivatives: the meaning of each call, and what is rejected."""

import ctypes
import math
from fractions import Fraction

import pytest
from courses import at_course_after, course, COURSES, every_course, prepared, STEP, way
from unit import ERROR, OK, bits, unit

# input derivatives


@every_course
def test_the_indentation_follows_the_polynomial(name):
    rates, polynomial = COURSES[name]
    made = prepared("coupled", rates)
    before = made.get("indentation")
    course(made, *polynomial)
    made.step(STEP)
    expected = float(Fraction(before) + way(*polynomial, STEP))
    assert made.get("indentation") == pytest.approx(expected, rel=1e-14, abs=1e-20)


@pytest.mark.parametrize(("order", "value"), [(1, -4e4), (2, -3e9)])
def test_one_derivative_alone_is_enough(order, value):
    made = prepared("coupled")
    made.set(indentation_rate=1.0)
    assert made.try_set_derivatives("indentation_rate", [order], [value]) == OK
    made.step(STEP)
    expected = STEP + value * STEP ** (order + 1) / (2 if order == 1 else 6)
    assert made.get("indentation") == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("arrangement", [([1, 2], 0), ([2, 1], 1)])
def test_orders_and_values_belong_together_in_any_sequence(arrangement):
    orders, _ = arrangement
    values = {1: -4e4, 2: -3e9}
    made, expected = prepared("coupled"), prepared("coupled")
    made.set(indentation_rate=1.0)
    assert made.try_set_derivatives("indentation_rate", orders, [values[order] for order in orders]) == OK
    course(expected, 1.0, values[1], values[2])
    made.step(STEP)
    expected.step(STEP)
    assert made.state() == expected.state()


def test_of_an_order_that_is_named_twice_the_last_value_counts():
    made, expected = prepared("coupled"), prepared("coupled")
    made.set(indentation_rate=1.0)
    assert made.try_set_derivatives("indentation_rate", [1, 1], [7e4, -4e4]) == OK
    expected.set(indentation_rate=1.0)
    expected.set_derivatives(-4e4)
    made.step(STEP)
    expected.step(STEP)
    assert made.state() == expected.state()


def test_an_empty_list_of_derivatives_sets_nothing():
    made = prepared("coupled")
    before = made.state()
    assert made.try_("SetRealInputDerivatives", None, 0, None, None) == OK
    assert made.state() == before


@every_course
def test_derivatives_hold_for_one_step_only(name):
    rates, polynomial = COURSES[name]
    made = prepared("coupled", rates)
    course(made, *polynomial)
    made.step(STEP)
    before = made.get("indentation")
    made.step(STEP)
    assert made.get("indentation") - before == pytest.approx(polynomial[0] * STEP, rel=1e-9)


def test_derivatives_of_zero_leave_a_plain_step():
    made, plain = prepared("coupled", [3.0]), prepared("coupled", [3.0])
    course(made, 0.7, 0.0, 0.0)
    made.step(STEP)
    plain.step(STEP, 0.7)
    assert {key: bits(value) for key, value in made.outputs().items()} == {
        key: bits(value) for key, value in plain.outputs().items()
    }


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
    pressed = prepared("coupled", initial_gap=-deepest)
    assert made.get("residual_indentation") == pytest.approx(pressed.get("residual_indentation"), rel=1e-14)


@every_course
def test_a_step_is_the_same_as_its_parts(name):
    rates, polynomial = COURSES[name]
    whole, parts = prepared("all_outputs", rates), prepared("all_outputs", rates)
    course(whole, *polynomial)
    whole.step(STEP)
    for part in range(64):
        course(parts, *at_course_after(*polynomial, STEP * part / 64))
        parts.step(STEP / 64)
    expected = parts.outputs()
    for key, value in whole.outputs().items():
        if key not in ("mean_force", "predicted_force", "stiffness"):
            assert value == pytest.approx(expected[key], rel=1e-10, abs=1e-16), key


def refusals(name):
    """Array of references, orders, values, and the words that the message must contain."""
    rate = "left.indentation_rate" if name == "two_plain" else "indentation_rate"
    force = rate.replace("indentation_rate", "force")
    cases = [(rate, order, 1.0, [f"order {order}"]) for order in (0, 3, -1, 17)]
    if name == "mass_known":
        cases.append((rate, 2, 1.0, ["order 2", "allowed is 1"]))
    cases += [(rate, 1, value, [str(value)]) for value in (math.nan, math.inf, -math.inf)]
    cases += [(force, 1, 1.0, ["indentation_rate"]), (unit(name).parameters[0], 1, 1.0, ["indentation_rate"])]
    return cases


@pytest.mark.parametrize("name", ["coupled", "mass_known", "two_plain"])
def test_wrong_derivatives_are_refused_with_their_value_and_set_nothing(name):
    for variable, order, value, words in refusals(name):
        rate = "left.indentation_rate" if name == "two_plain" else "indentation_rate"
        made = prepared(name)
        references = (ctypes.c_uint * 2)(unit(name).reference[rate], unit(name).reference[variable])
        status = made.try_(
            "SetRealInputDerivatives", references, 2, (ctypes.c_int * 2)(1, order), (ctypes.c_double * 2)(5.0, value)
        )
        assert status == ERROR, (variable, order, value)
        message = made.log[-1][3]
        assert all(word.lower() in message.lower() for word in words), message
        # fmpy passes messages to the logger created last
        other = prepared(name)
        assert other.try_step(0.0, -1.0) == ERROR
        assert made.state() == other.state(), "an instance that failed for another reason"


def test_derivatives_are_refused_where_inputs_are():
    made = prepared("coupled")
    made.call("Terminate")
    assert made.try_set_derivatives("indentation_rate", [1], [1.0]) == ERROR
    failed = prepared("coupled")
    assert failed.try_step(0.0, -1.0) == ERROR
    assert failed.try_set_derivatives("indentation_rate", [1], [1.0]) == ERROR
    assert "fmi2SetRealInputDerivatives" in failed.log[-1][3]


def test_derivatives_set_in_initialization_mode_hold_for_the_first_step():
    made, expected = unit("coupled").instance(), prepared("coupled")
    made.setup()
    made.call("EnterInitializationMode")
    course(made, 1.0, -4e4, -3e9)
    made.call("ExitInitializationMode")
    made.step(STEP)
    course(expected, 1.0, -4e4, -3e9)
    expected.step(STEP)
    assert made.outputs() == expected.outputs()
    assert made.log == []


def test_output_derivatives_are_refused_before_there_is_an_output():
    made = unit("coupled").instance()
    assert made.try_derivative("force", 1)[0] == ERROR
    made = unit("coupled").instance()
    made.setup()
    made.call("EnterInitializationMode")
    assert made.try_derivative("force", 1)[0] == ERROR


@pytest.mark.parametrize(("name", "order"), [("force", 0), ("force", 3), ("force", -1), ("indentation", 3),
                                             ("indentation_rate", 1), ("target.yield_strength", 1)])
def test_other_output_derivatives_are_refused(name, order):
    made = prepared("coupled", [1.0])
    status, _ = made.try_derivative(name, order)
    assert status == ERROR
    assert ("outputs" if order == 1 else f"order {order}") in made.log[-1][3]


def test_a_law_that_follows_the_rate_takes_no_input_derivatives_and_gives_one_of_the_force():
    made = prepared("rate_dependent", [1.0])
    assert made.unit.description.coSimulation.canInterpolateInputs is False
    assert made.unit.description.coSimulation.maxOutputDerivativeOrder == 1
    assert math.isfinite(made.derivative(1))
    assert made.try_derivative("force", 2)[0] == ERROR
    made = prepared("rate_dependent", [1.0])
    assert made.try_set_derivatives("indentation_rate", [1], [1.0]) == ERROR


def test_the_model_description_says_what_there_is():
    for name in ("coupled", "mass_known", "steel_ball"):
        capabilities = unit(name).description.coSimulation
        assert capabilities.canInterpolateInputs is True
        assert capabilities.maxOutputDerivativeOrder == 2


# output derivatives


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

    # the force over time, from the left: four neighbouring points, spaced so that neither error dominates
    wide = 2e-4 * STEP
    values = [force(STEP - index * wide) for index in range(5)]
    assert force(STEP) == values[0]
    first = (25 * values[0] - 48 * values[1] + 36 * values[2] - 16 * values[3] + 3 * values[4]) / (12 * wide)
    second = (35 * values[0] - 104 * values[1] + 114 * values[2] - 56 * values[3] + 11 * values[4]) / (12 * wide**2)
    scale = abs(values[0]) / STEP
    assert made.derivative(1) == pytest.approx(first, rel=1e-6, abs=1e-9 * scale)
    assert made.derivative(2) == pytest.approx(second, rel=1e-3, abs=1e-6 * scale / STEP)


def test_without_a_force_there_is_nothing_to_derive():
    made = prepared("coupled", [-1.0])
    assert (made.derivative(1), made.derivative(2)) == (0.0, 0.0)
