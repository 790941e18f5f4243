"""A ball dropped from 0.5 m comes to rest with each loss below yield and each damping, and no energy gets lost on the way."""

import pytest
from unit import unit

GRAVITY, HEIGHT, MASS = 9.81, 0.5, 4.1e-3


@pytest.mark.parametrize("name", ["fitted_moved", "waves_moved", "plate_moved", "hunt_moved", "kelvin_moved"])
def test_a_dropped_ball_comes_to_rest(name):
    ball = unit(name).ready(initial_gap=HEIGHT)
    wired = "external_acceleration" in unit(name).inputs
    step, time, speed = 4e-3, 0.0, 0.0
    energy = MASS * GRAVITY * HEIGHT
    worst, left = 0.0, 1.0
    while left > 1e-6:
        assert time < 60.0, f"{left} of the energy is left"
        ball.set(indentation_rate=speed)
        if wired:
            ball.set(external_acceleration=GRAVITY)
        else:
            ball.set_derivatives(GRAVITY)
        before = ball.get("mean_force")
        ball.step(step)
        time += step
        # an FMU whose acceleration is an input is for importers that apply the force one step later
        force = before if wired else ball.get("mean_force")
        speed += step * (GRAVITY - force / MASS)
        closing = ball.get("closing_speed")
        assert wired or abs(speed - closing) < 1e-12 * (1.0 + abs(closing))
        kinetic, depth = 0.5 * MASS * closing**2, ball.get("indentation")
        if name != "plate_moved":
            # a plate has moved, and the ball with it
            worst = max(worst, abs(MASS * GRAVITY * (depth + HEIGHT) - kinetic - ball.get("work")) / energy)
        dent = ball.get("residual_indentation") if "residual_indentation" in unit(name).outputs else 0.0
        above = max(dent - depth, 0.0)
        left = (kinetic + ball.get("elastic_energy") + MASS * GRAVITY * above) / energy
    assert worst <= 1e-9
    assert abs(ball.get("dissipated_energy") / energy - 1.0) < 1e-2
