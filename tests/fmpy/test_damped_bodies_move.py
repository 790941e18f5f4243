"""FMUs with a rate-dependent law that know the mass: rebounds, a ball that comes to rest, and saved states."""

import functools
import json
import os
import subprocess
from pathlib import Path

import pytest
from unit import bits, paths, unit

MASS, GRAVITY = 4.11e-3, 9.81
every_unit = pytest.mark.parametrize("name", sorted(paths()))


@functools.cache
def predicted(name, speed):
    scene = Path(unit(name).folder) / "resources" / "scene.toml"
    command = [os.environ["BRINELL_TEST_PROGRAM"], "predict", scene, "--speed", str(speed), "--json"]
    printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    return json.loads(printed)["laws"][0]


class Ball:
    def __init__(self, name, gap=0.0, speed=0.0):
        self.fmu, self.speed = unit(name).ready(initial_gap=gap), speed
        self.wired = "external_acceleration" in unit(name).reference

    def step(self, step, acceleration=0.0):
        self.fmu.set(indentation_rate=self.speed)
        if self.wired:
            self.fmu.set(external_acceleration=acceleration)
        elif acceleration:
            self.fmu.set_derivatives(acceleration)
        before = self.fmu.get("mean_force")
        self.fmu.step(step)
        force = before if self.wired else self.fmu.get("mean_force")
        self.speed += step * (acceleration - force / MASS)


@every_unit
@pytest.mark.parametrize("speed", [0.01, 0.1, 1.0, 10.0, 100.0])
@pytest.mark.parametrize("parts", [1, 10, 1000])
def test_the_restitution_is_the_predicted_one(name, speed, parts):
    law = predicted(name, speed)
    step = 1.6 * (law["loading_time"] + law["unloading_time"]) / parts
    ball = Ball(name, gap=0.3 * speed * step, speed=speed)
    for _ in range(5000):
        ball.step(step)
        end = ball.fmu.get("closing_speed")
        if end < 0.0 and ball.fmu.get("indentation") < 0.0 and abs(ball.speed - end) <= 1e-12 * abs(end):
            break
    assert -end / speed == pytest.approx(law["restitution"], rel=1e-9)
    lost = 0.5 * MASS * (speed**2 - end**2)
    assert ball.fmu.get("dissipated_energy") == pytest.approx(lost, rel=1e-8)


@every_unit
def test_a_dropped_ball_comes_to_rest_and_no_energy_gets_lost(name):
    height, step, time = 0.5, 1e-3, 0.0
    energy, left, worst = MASS * GRAVITY * height, 1.0, 0.0
    ball = Ball(name, gap=height)
    while left > 1e-6:
        ball.step(step, GRAVITY)
        time += step
        speed, depth = ball.fmu.get("closing_speed"), ball.fmu.get("indentation")
        kinetic = 0.5 * MASS * speed**2
        balance = MASS * GRAVITY * (height + depth) - kinetic - ball.fmu.get("work")
        worst = max(worst, abs(balance) / energy)
        left = (kinetic + ball.fmu.get("elastic_energy") + MASS * GRAVITY * max(-depth, 0.0)) / energy
        assert time < 60.0, f"{left} of the energy is left"
    assert worst <= 1e-9


@every_unit
def test_the_force_is_that_at_the_closing_speed_and_not_at_the_input(name):
    ball = Ball(name, speed=2.0)
    law = predicted(name, 2.0)
    largest, step = 0.0, law["loading_time"] / 200
    for _ in range(300):
        before, speed = ball.fmu.get("force"), ball.fmu.get("closing_speed")
        ball.step(step)
        force, end = ball.fmu.get("force"), ball.fmu.get("closing_speed")
        largest = max(largest, force)
        if before > 0.3 * law["largest_force"]:
            assert 0.5 * (before + force) == pytest.approx(MASS * (speed - end) / step, rel=1e-4)
        ball.fmu.set(indentation_rate=-1.0)
        assert ball.fmu.get("force") == force
    assert largest > 100.0
    for unknown in unit(name).description.outputs:
        assert not unknown.dependencies, unknown.variable.name


@every_unit
def test_a_state_saved_in_contact_continues_with_the_same_bits(name):
    step = predicted(name, 2.0)["loading_time"] / 20

    def run(ball, count):
        traces = []
        for _ in range(count):
            ball.step(step, 1e3)
            traces.append([bits(value) for value in ball.fmu.outputs().values()])
        return traces

    ball = Ball(name, speed=2.0)
    run(ball, 10)
    saved, time, speed = ball.fmu.state(), ball.fmu.time, ball.speed
    rest = run(ball, 100)
    other = Ball(name, speed=speed)
    other.fmu.restore(saved)
    other.fmu.time = time
    assert run(other, 100) == rest


def test_the_mass_may_change_between_steps_only_if_the_damping_does_not_follow_from_it():
    for name in paths():
        text = (Path(unit(name).folder) / "modelDescription.xml").read_text(encoding="utf-8")
        line = next(line for line in text.splitlines() if 'name="effective_mass"' in line)
        assert ('variability="tunable"' in line) == (name == "hunt"), line
