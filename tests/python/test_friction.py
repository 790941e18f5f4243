"""Contacts with friction: oblique impacts, and what the module says about the second rate."""

import csv
import math
import os
from pathlib import Path

import numpy as np
import pytest
from brinell import ContactError, UnknownName
from units import bits, contact

RADIUS, MASS, SPEED = 2.5e-3, 4.0 / 3.0 * math.pi * 2.5e-3**3 * 4000.0, 3.9
TABLE = Path(os.environ["BRINELL_TEST_TRUTH"]) / "friction" / "tables.csv"


def impacts():
    """Impacts of Kharaz's ball, from another program."""
    lines = [line for line in TABLE.read_text().splitlines() if line.startswith(("table", "impact"))]
    start = next(number for number, line in enumerate(lines) if "angle_deg_or_psi1" in line)
    rows = csv.DictReader(lines[start:])
    return [row for row in rows if row["case"] == "kharaz" and row["limit"] == "0"]


def fly(made, degrees, h, sign=1.0):
    """Speeds [m/s] along the normal and in the tangential direction and spin [rad/s] after an impact: the leap-frog
    method, contact first."""
    normal, along = SPEED * math.cos(math.radians(degrees)), sign * SPEED * math.sin(math.radians(degrees))
    spin, touched = 0.0, False
    for _ in range(2000):
        force = made.step(h, normal, tangential_rate=along + spin * RADIUS)
        pull = made.tangential_force
        if touched and force == 0.0:
            return normal, along, spin
        touched = touched or force > 0.0
        normal -= h * force / MASS
        along -= h * pull / MASS
        spin -= h * pull * RADIUS / (0.4 * MASS * RADIUS**2)
    raise AssertionError("the impact doesn't end")


@pytest.mark.parametrize("row", impacts(), ids=lambda row: row["angle_deg_or_psi1"])
def test_an_oblique_impact_ends_as_in_the_table_on_either_side(row):
    degrees, h = float(row["angle_deg_or_psi1"]), float(row["h"])
    with contact("oblique", force="end") as made:
        normal, along, spin = fly(made, degrees, h)
        assert -normal == pytest.approx(float(row["e_n"]) * SPEED * math.cos(math.radians(degrees)), rel=1e-9)
        # the table has a list of springs without an end, the FMU one of sixteen segments
        assert spin == pytest.approx(float(row["omega"]), rel=3e-5, abs=1e-6)
        if degrees > 0.0:
            assert along / (SPEED * math.sin(math.radians(degrees))) == pytest.approx(float(row["e_t"]), abs=2e-5)
        made.reset()
        mirrored = fly(made, degrees, h, -1.0)
        # 0.0 + makes a negative zero positive
        assert bits([mirrored[0], 0.0 - mirrored[1], 0.0 - mirrored[2]]) == bits([normal, 0.0 + along, 0.0 + spin])


def test_the_impulse_of_mean_forces_is_that_of_the_contact():
    with contact("oblique") as made:
        made.step(1e-6, 1.0, tangential_rate=0.3)
        assert made.tangential_force == made["tangential_force"] != made["mean_tangential_force"]
        assert made["tangential_impulse"] == pytest.approx(1e-6 * made["mean_tangential_force"], rel=1e-15)


def test_a_tangential_rate_holds_until_it_is_set_again():
    with contact("oblique") as held, contact("oblique") as set_again:
        for _ in range(20):
            held.step(1e-7, 1.0, **({"tangential_rate": 0.1} if held.time == 0.0 else {}))
            set_again.step(1e-7, 1.0, tangential_rate=0.1)
            assert bits([held.tangential_force]) == bits([set_again.tangential_force]) != bits([0.0])


def ramp(h, steps, *, accelerated):
    """The tangential force [N] after `steps` of `h` [s] with a tangential rate that grows from 0."""
    with contact("oblique") as made:
        for step in range(steps):
            if accelerated:
                made.step(h, 2.0, tangential_rate=2e5 * step * h, tangential_acceleration=2e5)
            else:
                made.step(h, 2.0, tangential_rate=2e5 * (step + 0.5) * h)
        return made["tangential_force"]


def test_a_tangential_acceleration_acts_over_its_step_only():
    exact = ramp(1e-9, 1000, accelerated=False)
    assert ramp(1e-8, 100, accelerated=True) == pytest.approx(exact, rel=1e-3)
    # half of the increments are missing without it
    with contact("oblique") as made:
        made.step(1e-7, 2.0, tangential_rate=0.0, tangential_acceleration=2e5)
        once = made["tangential_force"]
        made.step(1e-7, 2.0)
        assert once > 0.0 and made["tangential_force"] <= once * (1.0 + 1e-12)


def test_several_contacts_have_their_own_coefficients_and_tangential_forces():
    with contact("rough_contacts", initial_gap=0.0) as made:
        made.step(1e-6, [1.0, 1.0, 1.0], tangential_rate=[5.0, -5.0, 5.0])
        rough, smooth, frictionless = made["tangential_force"]
        assert rough == pytest.approx(-8.0 * smooth, rel=1e-12) and rough > 0.0 == frictionless
        assert np.shape(made.tangential_force) == (3,)
        with pytest.raises(TypeError, match="tangential_rate = 1.0: 3 numbers are needed"):
            made.step(1e-6, [1.0, 1.0, 1.0], tangential_rate=1.0)


def test_a_contact_without_friction_says_so():
    with contact("steel_ball") as made:
        for name in ["tangential_rate", "tangential_acceleration"]:
            with pytest.raises(ContactError, match=rf"{name} = 1.0: .* has no friction; \[friction\]"):
                made.step(1e-6, 1.0, **{name: 1.0})
        with pytest.raises(UnknownName, match="tangential_force"):
            _ = made.tangential_force


def test_a_state_contains_the_friction():
    with contact("oblique") as made, contact("oblique") as other:
        made.step(1e-6, 1.0, tangential_rate=0.01)
        other.restore(made.save())
        for one in (made, other):
            one.step(1e-6, -0.2)
        assert made["tangential_force"] == other["tangential_force"] != 0.0
        assert made["friction_work"] == other["friction_work"]


def test_a_rate_that_is_no_number_is_refused():
    with contact("oblique") as made:
        with pytest.raises(ContactError, match="tangential_rate"):
            made.step(1e-6, 1.0, tangential_rate=float("nan"))
        with pytest.raises(TypeError, match="tangential_rate"):
            made.step(1e-6, 1.0, tangential_rate="fast")


def test_two_directions_take_and_give_pairs():
    with contact("two_directions") as made:
        for turn in range(30):
            rates = [0.2 * math.cos(0.3 * turn), 0.2 * math.sin(0.3 * turn)]
            force = made.step(1e-6, 0.3, tangential_rate=rates)
            pull = made.tangential_force
            assert pull.shape == (2,) and math.hypot(*pull) <= 0.3 * force * (1.0 + 1e-9)
            assert list(pull) == [made["tangential_force[1]"], made["tangential_force[2]"]]
        # with derivatives the mean force belongs to the step
        made.step(1e-6, 0.3, 0.0, tangential_rate=np.zeros(2), tangential_acceleration=[1e3, -1e3])
        assert list(made.tangential_force) == [made["mean_tangential_force[1]"], made["mean_tangential_force[2]"]]


@pytest.mark.parametrize("wrong", [0.1, [0.1], [0.1, 0.2, 0.3], "ab"])
def test_one_number_is_not_enough_for_two_directions(wrong):
    with contact("two_directions") as made:
        with pytest.raises(TypeError, match="two numbers are needed, one for each tangential direction"):
            made.step(1e-6, 0.3, tangential_rate=wrong)
        assert made["indentation"] == 0.0
