"""FMUs that move their bodies, in importers of the order of execution for which they are made, in steps of any length: the
rebound is the predicted one."""

import functools
import json
import os
import re
import subprocess
import tomllib
from pathlib import Path

import pytest
from unit import WARNING, paths, unit

every_unit = pytest.mark.parametrize("name", sorted(paths()))
masters = pytest.mark.parametrize("name", ["serial", "parallel", "serial_wired", "parallel_wired"])
lengths = pytest.mark.parametrize("size", [1e-6, 1e-3])


@functools.cache
def predicted(name, speed):
    """The prediction of the program for another speed of the scene inside the FMU."""
    scene = Path(unit(name).folder) / "resources" / "scene.toml"
    command = [os.environ["BRINELL_TEST_PROGRAM"], "predict", scene, "--speed", str(speed), "--json"]
    answer = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    return answer["laws"][0], answer.get("strength")


class Ball:
    """A ball that moves against the first contact of an FMU: contact first (serial), or both at once (parallel)."""

    def __init__(self, name, speed=0.0, gap=0.0, order=None):
        scene = tomllib.loads((Path(unit(name).folder) / "resources/scene.toml").read_text(encoding="utf-8"))
        self.order = order or scene["coupling"].get("master", "serial")
        self.mass, self.speed = scene["impact"]["mass"], speed
        variables = unit(name).variables
        self.prefix = next(key for key in variables if key.endswith("indentation_rate")).removesuffix("indentation_rate")
        self.inputs = [key for key, variable in variables.items() if variable.causality == "input"]
        self.contact = unit(name).ready(initial_gap=gap)

    def get(self, output):
        return self.contact.get(self.prefix + output)

    def step(self, step, share=1.0):
        """`share` is the part of the force that the importer applies."""
        before = self.get("mean_force")
        values = {"indentation_rate": self.speed, "external_acceleration": 0.0, "effective_mass": self.mass}
        self.contact.set(**{self.prefix + key: value for key, value in values.items() if self.prefix + key in self.inputs})
        self.contact.step(step)
        force = before if self.order == "parallel" else self.get("mean_force")
        self.speed -= share * step * force / self.mass

    def rebound(self, step):
        """The speed with which the bodies have parted."""
        for _ in range(20_000):
            self.step(step)
            end = self.get("closing_speed")
            if end < 0.0 and self.get("force") == 0.0 and abs(self.speed - end) <= 1e-12 * abs(end):
                return -end
        raise AssertionError("the bodies do not part")

    def told(self):
        return [message for *_, message in self.contact.log]


@every_unit
@pytest.mark.parametrize("speed", [0.01, 1.0, 100.0])
@pytest.mark.parametrize("parts", [0.02, 1, 10, 1000])
def test_the_restitution_is_the_predicted_one_and_the_energy_is_dissipated(name, speed, parts):
    law, _ = predicted(name, speed)
    step = 1.6 * (law["loading_time"] + law["unloading_time"]) / parts
    ball = Ball(name, speed, gap=0.3 * speed * step)
    end = ball.rebound(step)
    assert end / speed == pytest.approx(law["restitution"], rel=1e-9)
    lost = 0.5 * ball.mass * (speed**2 - end**2)
    # a surface that is slower than the impactor keeps some
    kept = ball.get("elastic_energy") if ball.prefix + "elastic_energy" in unit(name).outputs else 0.0
    assert ball.get("dissipated_energy") + kept == pytest.approx(lost, rel=1e-8, abs=1e-11 * ball.mass * speed**2)
    assert speed > 10.0 or ball.told() == []


@pytest.mark.parametrize("name", ["rate_parallel", "rate_fresh", "rate_two"])
def test_a_dent_is_met_elastically_and_a_fresh_surface_has_the_strength_of_each_impact(name):
    assert predicted(name, 3.0)[1]["factor"] > 1.0
    ball = Ball(name, 3.0)
    first = ball.rebound(1e-5)
    dent = ball.get("residual_indentation")
    for speed in (0.5 * first, 0.1):
        ball.step(1e-3)
        ball.speed = speed
        again = ball.rebound(1e-5) / speed
        if name == "rate_fresh":
            assert again == pytest.approx(predicted(name, speed)[0]["restitution"], rel=1e-9)
        else:
            assert again == pytest.approx(1.0, abs=1e-11) and ball.get("residual_indentation") == dent


@masters
@lengths
def test_a_master_of_the_other_order_is_told_once_with_the_line_to_change(name, size):
    kind = name.split("_")[0]
    ball = Ball(name, 1.0, order={"serial": "parallel", "parallel": "serial"}[kind])
    for _ in range(100):
        ball.step(size)
    (message,) = ball.told()
    assert re.match(r"fmi2DoStep: indentation_rate = \S+ m/s, expected \S+ m/s: the master applies mean_force ", message)
    line = 'write master = "parallel" under [coupling]' if kind == "serial" else 'leave out master = "parallel" under [coupling]'
    assert line in message and ball.contact.log[0][1:3] == (WARNING, "logStatusWarning")


@masters
@lengths
@pytest.mark.parametrize(("share", "expected"), [
    (0.5, "the rate follows 0.5 times mean_force: the master moves a mass of 0.008 kg, the FMU one of 0.004 kg; give the same to both"),
    (0.0, ": the rate does not follow mean_force at all; apply it to the bodies, or, for a prescribed motion, leave out [coupling] in the"),
])
def test_a_master_that_moves_another_mass_or_applies_no_force_is_told_so(name, size, share, expected):
    ball = Ball(name, 1.0, gap=0.5 * size)
    for _ in range(100):
        ball.step(size, share)
    (message,) = ball.told()
    assert expected in message
