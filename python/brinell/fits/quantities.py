"""Numbers with a unit, for the parameters of a fit."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping

GRAVITY = 9.80665
"""Standard acceleration of free fall [m/s^2]."""

_LENGTHS = {
    "m": 1.0, "dm": 0.1, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "micron": 1e-6, "microns": 1e-6,
    "nm": 1e-9, "km": 1e3, "in": 0.0254, "inch": 0.0254, "mil": 2.54e-5, "ft": 0.3048,
}  # fmt: skip
UNITS: Mapping[str, Mapping[str, float]] = {
    "m": _LENGTHS,
    "m/s": {
        "m/s": 1.0, "mm/s": 1e-3, "cm/s": 1e-2, "um/s": 1e-6, "km/s": 1e3, "km/h": 1.0 / 3.6,
        "ft/s": 0.3048, "in/s": 0.0254,
    },
    "kg": {"kg": 1.0, "g": 1e-3, "mg": 1e-6, "ug": 1e-9, "t": 1e3, "lb": 0.45359237},
    "N": {
        "N": 1.0, "kN": 1e3, "MN": 1e6, "mN": 1e-3, "uN": 1e-6, "daN": 10.0, "kgf": GRAVITY,
        "kp": GRAVITY, "gf": 1e-3 * GRAVITY, "lbf": 4.4482216152605,
    },
    "s": {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9, "min": 60.0},
    "deg": {"deg": 1.0, "degree": 1.0, "degrees": 1.0, "°": 1.0, "rad": 180.0 / math.pi},
    "Pa": {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "N/mm2": 1e6, "ksi": 6.894757293168e6,
           "psi": 6894.757293168},
    "m/N": {"m/N": 1.0, "mm/N": 1e-3, "um/N": 1e-6, "nm/N": 1e-9, "mm/kN": 1e-6, "um/kN": 1e-9},
    "1/s": {"1/s": 1.0},
    "": {"1": 1.0, "-": 1.0, "%": 0.01},
}  # fmt: skip
"""The units of each SI unit, with their sizes in it."""


def size_of(unit: str, si: str, name: str) -> float:
    """The size of `unit` in the SI unit `si`, for the quantity `name`."""
    units = UNITS[si]
    plain = unit.strip().replace("\u00b5", "u").replace("\u03bc", "u").replace("^", "")
    if plain in units:
        return units[plain]
    if not si:
        raise ValueError(f"{name} has no unit, not `{shortened(unit)}`")
    raise ValueError(f"`{shortened(unit)}` is no unit of {name}; expected {one_of(units)}")


def number_of(value: float | str, si: str, name: str) -> float:
    """A number in SI units, or a text such as `"240 MPa"`."""
    if isinstance(value, bool | bytes):
        raise TypeError(f"{name} = {value!r}: a number is needed")
    if not isinstance(value, str):
        return float(value)
    match = re.fullmatch(r"\s*([-+]?[\d.]+(?:[eE][-+]?\d+)?)\s*(\S.*?)?\s*", value)
    try:
        if match is None:
            raise ValueError
        found = float(match[1])
    except ValueError:
        raise ValueError(f"{name} = {value!r}: a number is needed, such as 1e9 or '5 um'") from None
    return found if match[2] is None else found * size_of(match[2], si, name)


def shortened(text: str, most: int = 80) -> str:
    """A text that fits into a message."""
    return text if len(text) <= most else text[:most] + "..."


def one_of(names: Iterable[str]) -> str:
    """`a, b or c`."""
    *first, last = names
    return f"{', '.join(first)} or {last}" if first else last
