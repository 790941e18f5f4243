"""A box on four feet, for the tests of engines."""

import numpy as np

MASS, INERTIA = 0.3, np.array([1.2e-4, 2.6e-4, 3.5e-4])
FEET = np.array([[x, y, -0.02] for x in (-0.04, 0.04) for y in (-0.025, 0.025)])
ENERGIES = ("elastic_energy", "dissipated_energy", "tangential_energy", "friction_work")


def held(contact):
    """The energy of the contacts and what they have lost [J]."""
    return sum(np.sum(contact[name]) for name in ENERGIES[: 4 if contact.directions else 2])
