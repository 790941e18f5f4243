"""What can be fitted: names, units, scales and bounds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

RATES = {"johnson-cook": ("c", ""), "cowper-symonds": ("d", "1/s")}
"""The constant of each rate model that can be fitted, with its unit."""
INSTRUMENT = ("zero_point", "preload", "compliance")
"""What belongs to the machine that records an indentation."""


@dataclass(frozen=True)
class Parameter:
    """A parameter that can be fitted."""

    unit: str
    low: float
    high: float
    kinds: tuple[str, ...]
    """The kinds of measurement that know it."""
    is_logarithmic: bool = False


PARAMETERS: Mapping[str, Parameter] = {
    "yield_strength": Parameter("Pa", 1e-9, 1e18, ("impacts", "record", "hardness"), True),
    "hardening_modulus": Parameter("Pa", 0.0, 1e18, ("impacts", "record")),
    "rate": Parameter("", 0.0, 1.0, ("impacts",)),
    "elastic_restitution": Parameter("", 0.001, 1.0, ("impacts",)),
    "friction": Parameter("", 0.0, 10.0, ("impacts",)),
    "zero_point": Parameter("m", -np.inf, np.inf, ("record",)),
    "preload": Parameter("N", -np.inf, np.inf, ("record",)),
    "compliance": Parameter("m/N", 0.0, np.inf, ("record",)),
}
"""What can be fitted."""
COWPER_SYMONDS = Parameter("1/s", 1e-30, np.inf, ("impacts",), True)
"""The rate constant of that model."""
DEFAULTS = {"elastic_restitution": 0.99}
"""Starts of parameters that a scene may lack."""


def parameter(name: str, model: str | None) -> Parameter:
    """A parameter of a body with this rate model."""
    if name == "rate" and model == "cowper-symonds":
        return COWPER_SYMONDS
    return PARAMETERS[name]
