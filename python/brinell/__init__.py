"""Elastoplastic contact for simulations in Python: FMUs of Brinell, with FMI hidden.

`Contact` is an FMU in use. `export`, `predict`, `sweep` and `curve` call the exporter, and so does
`translate`, which has numbers for the contact models of other tools; `study` runs thousands of
impacts, `fit` finds the parameters that explain a measurement, and `draw` draws the tables of
`study` and `sweep`. Tables are pandas DataFrames. `brinell.mujoco` and `brinell.drake`, to be
imported by themselves, compute contacts between bodies of MuJoCo and Drake.
"""

from .contact import Contact, State
from .errors import ContactError, ContactWarning, ProgramError, ProgramWarning, UnknownName
from .fits.fit import fit
from .fits.result import Estimate, Fit
from .prediction import ObliquePrediction, Prediction
from .program import export, predict, program
from .studies.picture import draw
from .studies.plan import Range
from .studies.study import study
from .sweeps import curve, sweep
from .translate import Translation, translate
from .uncertainty import Bands
from .version import version

__version__ = version()

__all__ = [
    "Bands",
    "Contact",
    "ContactError",
    "ContactWarning",
    "Estimate",
    "Fit",
    "ObliquePrediction",
    "Prediction",
    "ProgramError",
    "ProgramWarning",
    "Range",
    "State",
    "Translation",
    "UnknownName",
    "__version__",
    "curve",
    "draw",
    "export",
    "fit",
    "predict",
    "program",
    "study",
    "sweep",
    "translate",
]
