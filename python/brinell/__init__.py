"""Elastoplastic contact for simulations in Python: FMUs of Brinell, with FMI hidden.

`Contact` is an FMU in use. `export`, `predict`, `sweep` and `curve` call the exporter; `study` runs
thousands of impacts, `fit` finds the parameters that explain a measurement, and `draw` draws the
tables of `study` and `sweep`. `brinell.mujoco` and `brinell.drake`, to be imported by themselves,
move contacts that share bodies in MuJoCo and Drake.
"""

from .contact import Contact, State
from .errors import ContactError, ContactWarning, ProgramError, ProgramWarning, UnknownName
from .fits.fit import fit
from .fits.result import Estimate, Fit
from .program import Prediction, curve, export, predict, program, sweep
from .studies.picture import draw
from .studies.plan import Range
from .studies.study import study
from .uncertainty import Bands

__all__ = [
    "Bands",
    "Contact",
    "ContactError",
    "ContactWarning",
    "Estimate",
    "Fit",
    "Prediction",
    "ProgramError",
    "ProgramWarning",
    "Range",
    "State",
    "UnknownName",
    "curve",
    "draw",
    "export",
    "fit",
    "predict",
    "program",
    "study",
    "sweep",
]
