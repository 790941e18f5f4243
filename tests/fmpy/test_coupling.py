"""The guide's claims about coupling: error and order of each method, as measured by examples/coupling.py."""

import functools
import os
import subprocess
import sys
from pathlib import Path

import pytest
from unit import paths, unit

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "examples"))
import coupling  # noqa: E402


@functools.cache
def impact():
    """The prediction of the program, for the scene inside the FMU."""
    scene = Path(unit("coupled").folder) / "resources" / "scene.toml"
    command = [os.environ["BRINELL"], "predict", scene, "--json"]
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
