"""Contacts with friction: the tangential rate of a step, for one contact and for several."""

import numpy as np
import pytest
from brinell import ContactError
from units import contact


def test_a_step_takes_a_tangential_rate_which_holds_until_the_next_one():
    with contact("oblique") as made:
        force = made.step(1e-6, 1.0, tangential_rate=0.5)
        assert 0.0 < made["tangential_force"] <= 0.092 * force
        assert made["sliding"] == 3
        before = made["tangential_force"]
        made.step(1e-6, 1.0)
        assert made["tangential_rate"] == 0.5 and made["tangential_force"] > before
        made.step(1e-6, 1.0, tangential_rate=-0.5)
        assert made["tangential_force"] < before
        assert made.derivative("tangential_force") < 0.0


def test_each_contact_has_its_tangential_rate():
    with contact("rough_contacts") as made:
        made.step(1e-6, [1.0, 1.0, 0.0], tangential_rate=[0.5, -0.5, 0.5])
        pull = made["tangential_force"]
        assert np.sign(pull).tolist() == [1.0, -1.0, 0.0]
        assert pull[1] == pytest.approx(-0.05 * made["smooth.force"], rel=1e-12)
        with pytest.raises(TypeError, match="3 numbers are needed"):
            made.step(1e-6, [1.0, 1.0, 0.0], tangential_rate=0.5)


def test_a_state_contains_the_friction():
    with contact("oblique") as made, contact("oblique") as other:
        made.step(1e-6, 1.0, tangential_rate=0.01)
        other.restore(made.save())
        for one in (made, other):
            one.step(1e-6, -0.2)
        assert made["tangential_force"] == other["tangential_force"] != 0.0
        assert made["friction_work"] == other["friction_work"]


def test_a_contact_without_friction_says_so():
    with contact("steel_ball") as made:
        with pytest.raises(ContactError, match=r"steel_ball\.fmu has no friction; \[friction\] in its scene adds it"):
            made.step(1e-6, 1.0, tangential_rate=0.5)
        assert made.time == 0.0 and made["indentation"] == 0.0


def test_a_rate_that_is_no_number_is_refused():
    with contact("oblique") as made:
        with pytest.raises((TypeError, ValueError, ContactError), match="tangential_rate"):
            made.step(1e-6, 1.0, tangential_rate=float("nan"))
        with pytest.raises((TypeError, ValueError), match="tangential_rate"):
            made.step(1e-6, 1.0, tangential_rate="fast")
