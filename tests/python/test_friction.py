"""Contacts with friction: what the module does and says with the second rate."""

import math

import numpy as np
import pytest
from brinell import ContactError, UnknownName
from units import bits, contact


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


def test_a_tangential_acceleration_acts_over_its_step_only():
    with contact("oblique") as made, contact("oblique") as mean:
        made.step(1e-7, 2.0, tangential_rate=0.0, tangential_acceleration=2e5)
        once = made["tangential_force"]
        mean.step(1e-7, 2.0, tangential_rate=0.5 * 1e-7 * 2e5)
        assert once == pytest.approx(mean["tangential_force"], rel=1e-2) and once > 0.0
        made.step(1e-7, 2.0)
        assert made["tangential_force"] <= once * (1.0 + 1e-12)


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
