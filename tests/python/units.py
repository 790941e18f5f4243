"""The FMUs and scenes of these tests."""

import json
import os
from pathlib import Path

from brinell import Contact

UNITS = json.loads(os.environ["BRINELL_TEST_UNITS"])
SCENES = Path(os.environ["BRINELL_TEST_SCENES"])


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
