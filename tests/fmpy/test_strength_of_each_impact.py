"""An FMU that knows the mass finds the strength of the strain rate at the first touch of each impact."""

import functools
import json
import os
import subprocess
from pathlib import Path

import pytest
from unit import bits, paths, unit

SPEEDS = [0.01, 0.1, 1.0, 10.0, 100.0]
every_unit = pytest.mark.parametrize("name", sorted(paths()))


@functools.cache
def predicted(name, speed):
    """The prediction of the program for another speed of the scene inside the FMU."""
    scene = Path(unit(name).folder) / "resources" / "scene.toml"
    command = [os.environ["BRINELL_TEST_PROGRAM"], "predict", scene, "--speed", str(speed), "--json"]
    printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    answer = json.loads(printed)
    return answer["laws"][0], answer["strength"]


def contact_time(law):
    return law["loading_time"] + law["unloading_time"]


class Ball:
    """A ball of the mass that the FMU knows, moved by an importer of the order of execution for which it was made."""

    def __init__(self, name, gap=0.0):
        self.name, self.prefix = name, "hard__" if name == "two" else ""
        self.fmu = unit(name).ready(initial_gap=gap)
        self.mass = 4.11e-3
        self.speed = 0.0

    def get(self, output):
        return self.fmu.get(self.prefix + output)

    def step(self, step, acceleration=0.0):
        inputs = {"indentation_rate": self.speed}
        if self.name == "parallel":
            inputs |= {"effective_mass": self.mass, "external_acceleration": acceleration}
        self.fmu.set(**{self.prefix + key: value for key, value in inputs.items()})
        if self.name != "parallel" and acceleration:
            self.fmu.set_derivatives(acceleration, name=self.prefix + "indentation_rate")
        before = self.get("mean_force")
        self.fmu.step(step)
        force = before if self.name == "parallel" else self.get("mean_force")
        self.speed += step * (acceleration - force / self.mass)

    def bounce(self, speed, step):
        """The restitution of an impact at `speed`."""
        self.speed = speed
        for _ in range(20000):
            self.step(step)
            end = self.get("closing_speed")
            if end < 0.0 and self.get("force") == 0.0 and abs(self.speed - end) <= 1e-13 * abs(end):
                return -end / speed
        raise AssertionError("the bodies do not part")


@every_unit
@pytest.mark.parametrize("speed", SPEEDS)
@pytest.mark.parametrize("parts", [1, 10, 1000])
def test_the_restitution_is_the_predicted_one(name, speed, parts):
    law, strength = predicted(name, speed)
    assert strength["factor"] > 1.0
    step = 1.4 * contact_time(law) / parts
    found = Ball(name, gap=0.3 * speed * step).bounce(speed, step)
    assert found == pytest.approx(law["restitution"], rel=1e-10)


@every_unit
def test_a_dent_is_met_elastically_and_keeps_the_strength_that_made_it(name):
    # the depth at which it goes deeper tells the strength
    ball = Ball(name)
    first = ball.bounce(3.0, 1e-5)
    dent, deepest = ball.get("residual_indentation"), ball.get("max_indentation")
    fresh = name == "fresh"
    for speed in (0.5 * 3.0 * first, 0.1):
        ball.step(1e-3)
        again = ball.bounce(speed, 1e-5)
        if fresh:
            assert again == pytest.approx(predicted(name, speed)[0]["restitution"], rel=1e-9)
        else:
            assert again == pytest.approx(1.0, abs=1e-11)
            assert (ball.get("residual_indentation"), ball.get("max_indentation")) == (dent, deepest)


@every_unit
def test_a_state_saved_in_contact_continues_with_the_same_bits_and_a_reset_forgets_the_strength(name):
    law, _ = predicted(name, 5.0)
    step = contact_time(law) / 40

    def run(ball, count, speed):
        ball.speed = speed
        traces = []
        for _ in range(count):
            ball.step(step, acceleration=1e3)
            traces.append([bits(value) for value in ball.fmu.outputs().values()])
        return traces

    ball = Ball(name)
    first = run(ball, 20, 5.0)
    saved, time, speed = ball.fmu.state(), ball.fmu.time, ball.speed
    rest = run(ball, 200, speed)
    ball.fmu.restore(saved)
    ball.fmu.time = time
    assert run(ball, 200, speed) == rest
    # another instance takes the bytes of this one
    other = Ball(name)
    other.fmu.restore(saved)
    other.fmu.time = time
    assert run(other, 200, speed) == rest
    other.fmu.call("Reset")
    other.fmu.initialize(initial_gap=0.0)
    assert run(other, 20, 5.0) == first


@pytest.mark.parametrize("name", [name for name in sorted(paths()) if name == "two"])
def test_each_contact_has_its_own_strength(name):
    """The second contact stays at rest while the first one is hit."""
    ball = Ball(name)
    ball.bounce(3.0, 1e-5)
    assert ball.fmu.get("soft__max_indentation") <= 0.0
    ball.prefix = "soft__"
    alone = Ball(name)
    alone.prefix = "soft__"
    assert ball.bounce(0.7, 1e-5) == pytest.approx(alone.bounce(0.7, 1e-5), rel=1e-12)


@every_unit
def test_the_parameters_are_the_strength_under_a_slow_load(name):
    _, strength = predicted(name, 2.0)
    own = "hard." if name == "two" else ""
    variable = unit(name).variables[f"{own}target.yield_strength"]
    assert float(variable.start) == pytest.approx(strength["yield_strength"] / strength["factor"], rel=1e-14)
    assert "under a slow load" in variable.description
    page = (Path(unit(name).folder) / "documentation" / "index.html").read_text(encoding="utf-8")
    assert "At the first touch of each impact, the FMU finds the strength" in page
