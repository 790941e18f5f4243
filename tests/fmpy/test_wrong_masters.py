"""A ball that falls from rest: a master that moves it otherwise than its FMU assumes is told so in words, and no other is told anything."""

import pytest
from unit import WARNING, unit

GRAVITY, MASS = 9.81, 4e-3
ORDER = 'write master = "parallel" under [coupling] in the scene'
OTHER = 'leave out master = "parallel" under [coupling] in the scene'


def told(name, step, force, after, mass=MASS):
    """What the FMU says to a master that lets the ball fall by 1 mm, for two impacts, and applies its `force`, `after` the step or of the step before."""
    ball = unit(name).ready(initial_gap=1e-3)
    speed, time = 0.0, 0.0
    given = {"external_acceleration": GRAVITY, "effective_mass": MASS} if name.endswith("wired") else {}
    while time < 0.04:
        ball.set(indentation_rate=speed, **given)
        before = ball.get(force)
        ball.step(step)
        speed += step * (GRAVITY - (ball.get(force) if after else before) / mass)
        time += step
    assert all((status, category) == (WARNING, "logStatusWarning") for status, category, _ in ball.log), ball.log
    return [message.removeprefix("fmi2DoStep: ") for _, _, message in ball.log]


@pytest.mark.parametrize("wired", ["", "_wired"])
@pytest.mark.parametrize("step", [1e-5, 1e-4, 1e-3])
@pytest.mark.parametrize(
    ("name", "after", "mass", "words"),
    [
        ("serial", True, MASS, None),
        ("serial", False, MASS, f"the master applies mean_force one step late; {ORDER}"),
        ("parallel", False, MASS, None),
        ("parallel", True, MASS, f"the master applies mean_force over the same step already; {OTHER}"),
        ("serial", True, 2 * MASS, "the rate follows 0.5 times mean_force: the master moves a mass of 0.008 kg, the FMU one of 0.004 kg"),
        ("serial", True, 1e9, "the rate does not follow mean_force at all"),
    ],
)
def test_the_master_of_an_fmu_that_knows_the_mass_is_told_what_is_wrong(name, after, mass, words, step, wired):
    messages = told(name + wired, step, "mean_force", after, mass)
    assert len(messages) == (words is not None) and (words or "") in "".join(messages), messages


@pytest.mark.parametrize(
    ("step", "force", "after", "words"),
    [
        (1e-6, "force", True, None),
        (1e-6, "predicted_force", False, None),
        (1e-6, "force", False, "the master applies the force one step late: connect predicted_force, or step the contact first"),
        (1e-4, "force", True, "steps of 0.0001 s are unstable with a mass of 0.004 kg: make them shorter"),
    ],
)
def test_the_master_of_an_fmu_that_knows_no_mass_is_told_what_is_wrong(step, force, after, words):
    messages = told("watched", step, force, after)
    assert len(messages) == (words is not None) and (words or "") in "".join(messages), messages
