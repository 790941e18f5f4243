"""FMUs with several contacts: sequences in, arrays out."""

import warnings

import numpy as np
import pytest
from brinell import ContactError, ProgramError, UnknownName
from units import bits, contact

H = 1e-5


def test_names_of_contacts():
    assert contact("two").contacts == ("left", "right")
    assert contact("row").contacts == ("bead[1]", "bead[2]", "bead[3]")
    assert contact("coupled").contacts == ("",)


@pytest.mark.parametrize("kind", [list, tuple, np.array])
def test_each_contact_is_as_it_would_be_alone(kind):
    rates, gaps = kind([1.0, 0.5]), [0.0, 2e-6]
    with contact("two", initial_gap=gaps) as both:
        forces = [both.step(H, rates, [9.81, 0.0]) for _ in range(4)]
        assert all(isinstance(force, np.ndarray) and force.shape == (2,) for force in forces)
        for index in range(2):
            with contact("mass_known", initial_gap=gaps[index]) as alone:
                own = [alone.step(H, float(rates[index]), [9.81, 0.0][index]) for _ in range(4)]
            assert own == pytest.approx([force[index] for force in forces], rel=1e-9)


def test_bodies_at_rest_raise_no_false_alarm():
    mass, gravity, h = 0.033, 9.81, 1e-3
    speeds = np.zeros(2)
    with contact("stack") as stack, warnings.catch_warnings():
        warnings.simplefilter("error")
        for _ in range(1000):
            forces = stack.step(h, -np.diff(speeds, prepend=0.0), [gravity, 0.0])
            speeds = speeds - h * np.diff(forces, append=0.0) / mass
            # an engine adds the parts of a Runge-Kutta step, and rounds each
            speeds = speeds - h * gravity / 6 - h * gravity / 3 - h * gravity / 3 - h * gravity / 6
    assert np.abs(speeds).max() < 1e-15
    assert forces == pytest.approx([2 * mass * gravity, mass * gravity], rel=1e-12)


def test_values_of_one_and_of_all():
    with contact("row") as made:
        made.step(1e-6, [0.0, 1.0, 2.0])
        assert bits(made["indentation"]) == bits([0.0, 1e-6, 2e-6])
        assert made["bead[3].indentation"] == 2e-6
        assert made["regime"].dtype.kind == "i" and made["regime"][2] > 0
        assert made.derivative("force").shape == (3,)
        with pytest.raises(KeyError, match=r"bead\[1\].force"):
            made["depth"]


def test_gaps_for_all_for_each_and_by_name():
    for gap, expected in [
        (1e-3, [1e-3, 1e-3]),
        ([1e-3, 2e-3], [1e-3, 2e-3]),
        (np.array([1e-3, 2e-3]), [1e-3, 2e-3]),
        ({"right": 3e-3}, [0.0, 3e-3]),
        (None, [0.0, 1e-5]),
    ]:
        with contact("two", initial_gap=gap) as made:
            assert list(-made["indentation"]) == expected
    with contact("row", initial_gap=1e-3) as made:
        assert list(made["indentation"]) == [-1e-3] * 3
    with pytest.raises(ContactError, match="3 contacts"):
        contact("row", initial_gap=[1e-3, 2e-3, 3e-3])
    with pytest.raises(ContactError, match="2 contacts"):
        contact("two", initial_gap=[1e-3])
    with pytest.raises(UnknownName, match="middle.initial_gap"):
        contact("two", initial_gap={"middle": 1.0})


def test_parameters_of_one_contact():
    with contact("two", left_initial_gap=1e-4) as made:
        assert made["left.initial_gap"] == 1e-4


@pytest.mark.parametrize("rates", [1.0, [1.0], [1.0] * 3, [[1.0, 2.0]], "ab", b"ab", None, [1.0, "2"], {1.0, 2.0}])
def test_wrong_numbers_of_rates_are_refused(rates):
    with contact("two") as made:
        with pytest.raises(TypeError, match="rate"):
            made.step(H, rates)
        with pytest.raises(TypeError, match="acceleration"):
            made.step(H, [1.0, 1.0], 1.0 if rates is None else rates)
        assert made.time == 0.0


def test_each_contact_follows_its_own_gap():
    with contact("two", initial_gap=1e-3) as made:
        # the left one stays apart; the right one touches within the step
        forces = made.step(1e-3, [0.5, 2.0], [0.0, 0.0], gap=[2e-3, 1e-3])
        assert forces[0] == 0.0 and forces[1] > 0.0
        assert made["left.indentation"] == pytest.approx(-1.5e-3, rel=1e-14)
        with pytest.raises(TypeError, match="gap"):
            made.step(1e-3, [0.0, 0.0], gap=1.0)


# parameters that each contact has for itself

COUNT = 20
STRENGTHS = np.geomspace(2e8, 9e8, COUNT)
MASSES = np.geomspace(1e-4, 1e-1, COUNT)
SPEEDS = np.geomspace(0.1, 10.0, COUNT)[::-1].copy()


def alone(index):
    given = {"target.yield_strength": STRENGTHS[index], "effective_mass": MASSES[index]}
    with contact("mass_known", parameters=given) as one:
        force = one.step(1.0, SPEEDS[index])
        return force, one["residual_indentation"]


@pytest.mark.parametrize(
    "given",
    [
        {"target_yield_strength": STRENGTHS, "effective_mass": MASSES},
        {"parameters": {"target.yield_strength": list(STRENGTHS), "effective_mass": MASSES}},
        {
            "parameters": {f"bead[{i + 1}].target.yield_strength": STRENGTHS[i] for i in range(20)},
            "effective_mass": tuple(MASSES),
        },
    ],
)
def test_one_step_of_many_contacts_is_one_step_of_each_alone(given):
    with contact("each", **given) as row:
        forces = row.step(1.0, SPEEDS)
        dents = row["residual_indentation"]
        assert bits(row["target.yield_strength"]) == bits(STRENGTHS)
    expected = [alone(index) for index in range(COUNT)]
    assert bits(forces) == bits([force for force, _ in expected])
    assert bits(dents) == bits([dent for _, dent in expected])


def test_one_number_is_one_for_all_and_a_reset_keeps_what_is_not_given():
    with contact("each", target_yield_strength=STRENGTHS) as row:
        row.reset(effective_mass=2e-3)
        assert bits(row["effective_mass"]) == bits([2e-3] * COUNT)
        assert bits(row["target.yield_strength"]) == bits(STRENGTHS)
        row.step(1e-6, SPEEDS, mass=MASSES)
        assert bits(row["effective_mass"]) == bits(MASSES)
        row.step(1e-6, SPEEDS, mass=1e-3)
        assert bits(row["effective_mass"]) == bits([1e-3] * COUNT)


def test_parameters_of_each_contact_that_are_refused():
    with pytest.raises(ContactError, match=r"it takes one number, or 20"):
        contact("each", target_yield_strength=[1e8, 2e8])
    with pytest.raises(ProgramError, match="soft: a number in pascals is expected"):
        contact("each", target_yield_strength="soft")
    with pytest.raises(UnknownName, match="hardness"):
        contact("each", hardness=[1.0] * COUNT)
    wrong = STRENGTHS.copy()
    wrong[6] = -1.0
    with pytest.raises(ContactError, match=r"bead\[7\]: target.yield_strength = -1"):
        contact("each", target_yield_strength=wrong)
    with pytest.raises(TypeError, match="a number is needed, not list"):
        contact("mass_known", target_yield_strength=[1e8])


# contacts that share bodies

W = np.array([[20.0, -10.0, 0.0], [-10.0, 15.0, 2.0], [0.0, 2.0, 8.0]])


def test_inverse_masses_move_all_contacts_together():
    rates = np.array([0.3, 0.0, 0.1])
    with contact("feet") as feet:
        force = feet.step(1e-3, rates, [9.81, 0.0, 0.0], inverse_masses=W)
        moment, depth = feet["impulse_moment"], feet["indentation"]
        assert force.shape == moment.shape == (3,) and np.all(force > 0.0)
        path = 1e-3 * rates + np.array([0.5e-6 * 9.81, 0.0, 0.0]) - W @ moment
        assert depth == pytest.approx(path, abs=1e-15)
        after = rates + 1e-3 * (np.array([9.81, 0.0, 0.0]) - W @ force)
        # the matrix holds until it is set again
        held = feet.save()
        expected = feet.step(1e-3, after, inverse_masses=W.tolist())
        feet.restore(held)
        assert bits(feet.step(1e-3, after)) == bits(expected)


def test_a_contact_that_shares_a_body_follows_its_own_gap():
    with contact("feet", initial_gap=1e-3) as feet:
        # the second starts to move when the first has hit: it cannot touch by itself
        gaps = [1e-3, 1e-3 + 1e-9, 2e-3]
        feet.step(1e-3, [0.0, 0.1, 0.2], [0.0, 1.0, 0.0], inverse_masses=W, gap=gaps)
        moved = np.array([0.0, 1e-4 + 0.5e-6, 2e-4])
        assert feet["indentation"] == pytest.approx(moved - gaps, abs=1e-16)


def test_inverse_masses_that_are_refused():
    rates = [0.1, 0.1, 0.1]
    skew, weak, nan = W.copy(), W.copy(), W.copy()
    skew[0, 1], weak[1, 1], nan[0, 0] = -9.0, 0.0, np.nan
    with contact("feet") as feet:
        for wrong in (1.0, W[:2], W[0], "ab", [[1.0]]):
            with pytest.raises(TypeError, match=r"(?s)inverse_masses = .*: 3 x 3 numbers are needed"):
                feet.step(H, rates, inverse_masses=wrong)
        with pytest.raises(TypeError, match="inverse_masses = 'a': a number is needed"):
            feet.step(H, rates, inverse_masses=[["a", 0, 0], [0, 1, 0], [0, 0, 1]])
        with pytest.raises(ContactError, match=r"entry \[1,2\] = -9.0 and \[2,1\] = -10.0 1/kg must be equal"):
            feet.step(H, rates, inverse_masses=skew)
        assert feet.time == 0.0
    for matrix, text in (
        (weak, r"inverse_mass\[2,2\] = 0 1/kg: it isn't known yet"),
        (nan, r"inverse_mass\[1,1\] = NaN is out of range"),
    ):
        with contact("feet") as feet, pytest.raises(ContactError, match=text):
            feet.step(H, rates, inverse_masses=matrix)
    with contact("two") as two, pytest.raises(ContactError, match='no such inputs; inverse_masses = "input"'):
        two.step(H, [0.1, 0.1], inverse_masses=np.eye(2))
