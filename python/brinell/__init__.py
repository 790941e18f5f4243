"""Elastoplastic contact for simulations in Python: units of Brinell, without a word of FMI.

`Contact` is a unit in use. `export`, `predict`, `sweep` and `curve` call the exporter.
"""

from .contact import Contact, State
from .errors import ContactError, ContactWarning, ProgramError, UnknownName
from .program import Prediction, curve, export, predict, program, sweep

__all__ = [
    "Contact",
    "ContactError",
    "ContactWarning",
    "Prediction",
    "ProgramError",
    "State",
    "UnknownName",
    "curve",
    "export",
    "predict",
    "program",
    "sweep",
]
