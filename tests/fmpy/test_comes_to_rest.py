"""A ball dropped from 0.5 m comes to rest with each loss below yield, and no energy gets lost on the way."""

from pathlib import Path

import pytest
from unit import unit

GRAVITY, HEIGHT, MASS = 9.81, 0.5, 4.1e-3
LOSSES = ["fitted", "waves", "plate"]


def follows_rate(name):
    text = (Path(unit(name).folder) / "modelDescription.xml").read_text(encoding="utf-8")
    outputs = text.split("<Outputs>")[1].split("</Outputs>")[0]
    reference = {v.name: i for i, v in enumerate(unit(name).description.modelVariables, 1)}
    force = next(line for line in outputs.split("<Unknown") if f'index="{reference["force"]}"' in line)
    dependencies = force.split('dependencies="')[1].split('"')[0].split()
    return str(reference["indentation_rate"]) in dependencies


@pytest.mark.parametrize("loss", LOSSES)
def test_the_description_says_whether_the_force_follows_the_input(loss):
    assert follows_rate(f"{loss}_held") == (loss != "plate")
    # bodies that the FMU moves have their own speed
    assert not follows_rate(f"{loss}_moved")


@pytest.mark.parametrize("loss", LOSSES)
def test_a_dropped_ball_comes_to_rest(loss):
    ball = unit(f"{loss}_moved").ready()
    step, time, speed, way = 1e-3, 0.0, 0.0, 0.0
    energy = MASS * GRAVITY * HEIGHT
    worst, left = 0.0, 1.0
    while left > 1e-6:
        assert time < 60.0, f"{left} of the energy is left"
        before = speed
        ball.set(indentation_rate=speed)
        ball.set_derivatives(GRAVITY)
        ball.step(step)
        time += step
        force = ball.get("mean_force")
        speed += step * (GRAVITY - force / MASS)
        assert abs(speed - ball.get("closing_speed")) < 1e-12 * (1.0 + abs(before))
        kinetic = 0.5 * MASS * speed**2
        depth = ball.get("indentation")
        if loss != "plate":
            # a plate has moved, and the ball with it
            way = depth + HEIGHT
            balance = MASS * GRAVITY * way - kinetic - ball.get("work")
            worst = max(worst, abs(balance) / energy)
        above = max(ball.get("residual_indentation") - depth, 0.0)
        left = (kinetic + ball.get("elastic_energy") + MASS * GRAVITY * above) / energy
    assert worst <= 1e-9
    lost = ball.get("dissipated_energy")
    assert abs(lost / energy - 1.0) < 1e-2


@pytest.mark.parametrize("loss", LOSSES)
@pytest.mark.parametrize("steps", [1, 7, 1000])
def test_a_held_rate_may_be_cut_into_steps(loss, steps):
    description = unit(f"{loss}_held")
    ends = []
    for count in (1, steps):
        contact = description.ready()
        for rate, duration in ((0.5, 4e-5), (-0.3, 3e-5), (0.2, 5e-5)):
            for _ in range(count):
                contact.step(duration / count, rate)
        ends.append([contact.get(name) for name in ("force", "work", "dissipated_energy", "indentation")])
    for one, many in zip(*ends):
        assert many == pytest.approx(one, rel=1e-8 if loss == "plate" else 1e-10)
