"""The FMUs and scenes of these tests, and how much of them a run takes."""

import json
import os
from pathlib import Path

from brinell import Contact

UNITS = json.loads(os.environ.get("BRINELL_TEST_UNITS", "{}"))
SCENES = Path(__file__).parents[2] / "scenes"
LONG = os.environ.get("BRINELL_LONG") == "1"


def some(cases, every):
    """In a long run all of them; in a usual one each `every`-th, so that the first is there."""
    return list(cases) if LONG else list(cases)[::every]


def contact(scene, **arguments):
    return Contact(UNITS[scene], **arguments)


def bits(values):
    """Numbers as bits, for comparison."""
    return [float(value).hex() for value in values]


def bounce(made, mass=4e-3, speed=1.0, h=1e-4, steps=3, gravity=0.0):
    """The speed [m/s] after an impact in large steps, positive away from the surface."""
    for _ in range(steps):
        speed += h * (gravity - made.step(h, speed, gravity) / mass)
    return -speed
