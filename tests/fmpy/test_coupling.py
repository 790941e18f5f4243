"""The guide's claims about coupling: error and order of each method, as measured by examples/coupling.py."""

import functools
import math
import os
import subprocess
import sys
from pathlib import Path

import pytest
from unit import paths, unit

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "examples"))
import coupling  # noqa: E402

GRAVITY = 9.81


@functools.cache
def impact(tmp=Path(os.environ.get("TMPDIR", "/tmp"))):
    """The prediction of the program, for the scene inside the FMU."""
    scene = Path(unit("coupled").folder) / "resources" / "scene.toml"
    command = [os.environ["BRINELL_TEST_PROGRAM"], "predict", scene, "--json"]
    printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    file = Path(unit("coupled").folder) / "impact.json"
    file.write_text(printed, encoding="utf-8")
    return coupling.Impact.read(file)


@functools.cache
def coupled(name):
    return coupling.Unit(paths()[name])


def error(way, steps_per_contact, name="coupled"):
    return coupling.error(way, coupled(name), impact(), steps_per_contact)[0]


# the largest error at 32 steps per contact, and the order
@pytest.mark.parametrize(
    ("way", "largest", "order"),
    [
        (coupling.parallel, 0.21, 1),
        (coupling.predicted_early, 2e-2, 2),
        (coupling.predicted, 1.3e-3, 2),
        (coupling.serial, 1.3e-3, 2),
        (coupling.verlet, 1.3e-3, 2),
        (coupling.derivatives, 1.6e-4, 3),
        (coupling.derivatives_of_both, 1.1e-5, 4),
        (coupling.rollback, 5.5e-5, 3),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_each_way_has_its_error_and_its_order(way, largest, order):
    errors = {steps: error(way, steps) for steps in (16, 32, 64, 128, 256, 512)}
    # the force one step late is far off where the others are not
    assert (0.1 if way is coupling.parallel else 0.0) < errors[32] <= largest
    assert abs(coupling.order(errors) - order) < 0.2, errors


def test_input_derivatives_locate_the_contact_time():
    assert coupling.error_of_contact_time(coupled("coupled"), impact(), 32) <= 1e-5


def rebound_under_gravity(speed, mass):
    """Square of the closing speed at which the ball leaves the dent: along the loading curve until the energy is used up, and
    back with the elastic part. Heights are relative to the surface. Energies are those of an FMU without known mass."""
    probe = coupled_with_energies()

    def missing(depth):
        probe_at(probe, depth)
        return probe.get("work") - 0.5 * mass * speed**2 - mass * GRAVITY * depth

    low, high = 0.0, 1e-3
    while high - low > 1e-16 * high:
        middle = 0.5 * (low + high)
        if middle in (low, high):
            break
        low, high = (low, middle) if missing(middle) > 0.0 else (middle, high)
    probe_at(probe, low)
    way = low - probe.get("residual_indentation")
    return 2.0 / mass * (probe.get("elastic_energy") - mass * GRAVITY * way)


def coupled_with_energies():
    return unit("energies").instance()


def probe_at(probe, depth):
    probe.call("Reset")
    probe.initialize(initial_gap=0.0)
    probe.step(1.0, depth)


def test_a_dropped_ball_rebounds_as_predicted_with_steps_of_a_millisecond():
    mass, height, step = impact().mass, 0.05, 1e-3
    ball = unit("mass_known").ready(initial_gap=height)
    speed = 0.0
    while speed >= 0.0:
        ball.set(indentation_rate=speed)
        ball.set_derivatives(GRAVITY)
        ball.step(step)
        speed += step * (GRAVITY - ball.get("mean_force") / mass)
    risen = ball.get("residual_indentation") - ball.get("indentation")
    rebound = math.sqrt(speed**2 + 2.0 * GRAVITY * risen)
    met = math.sqrt(2.0 * GRAVITY * height)
    expected = math.sqrt(rebound_under_gravity(met, mass))
    assert ball.get("force") == 0.0 and risen > 0.0
    assert abs(rebound / expected - 1.0) <= 1e-6
    # gravity also acts during the contact; a prediction for the speed alone does not include it
    assert abs(rebound / met / impact().restitution - 1.0) < 1e-2
