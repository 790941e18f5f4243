"""Columns of a measurement: their names, units, and the range that numbers without a unit may have."""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

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
AMBIGUOUS = {
    ("N", "kg"): "a force in kg is one in kgf: write kgf, or N",
    ("N", "g"): "a force in g is one in gf: write gf, or mN",
    ("N", "t"): "a force in t: write kN",
    ("N", "lb"): "a force in lb is one in lbf: write lbf, or N",
}


@dataclass(frozen=True)
class Quantity:
    """A quantity that a column may hold."""

    unit: str
    """SI unit; degrees for angles."""
    names: tuple[str, ...]
    """Headings, in lower case; the first is the one that messages use."""
    largest: float = math.inf
    """Numbers without a unit are in the SI unit, unless one of them is larger than this."""


QUANTITIES: Mapping[str, Quantity] = {
    "speed": Quantity("m/s", (
        "speed", "velocity", "v", "impact speed", "impact velocity", "closing speed",
        "incident speed", "incident velocity", "geschwindigkeit"), 3000.0),
    "drop_height": Quantity("m", ("drop height", "height", "fall height", "fallhöhe"), 100.0),
    "mass": Quantity("kg", ("mass", "effective mass", "masse"), 1e5),
    "restitution": Quantity("", (
        "restitution", "e", "cor", "coefficient of restitution", "restitution coefficient"), 1.0),
    "rebound_speed": Quantity("m/s", (
        "rebound speed", "rebound velocity", "speed after", "velocity after"), 3000.0),
    "rebound_height": Quantity("m", ("rebound height", "bounce height", "rückprallhöhe"), 100.0),
    "dent_depth": Quantity("m", (
        "dent depth", "dent", "residual depth", "residual indentation", "crater depth"), 0.05),
    "dent_diameter": Quantity("m", (
        "dent diameter", "crater diameter", "indentation diameter", "imprint diameter"), 0.2),
    "contact_time": Quantity("s", (
        "contact time", "contact duration", "impact duration", "kontaktzeit"), 0.1),
    "largest_force": Quantity("N", (
        "largest force", "max force", "maximum force", "peak force", "fmax")),
    "angle": Quantity("deg", ("angle", "impact angle", "angle of incidence", "incidence angle"),
                      90.0),
    "tangential_restitution": Quantity("", ("tangential restitution", "e_t", "et")),
    "rebound_angle": Quantity("deg", ("rebound angle",), 90.0),
    "depth": Quantity("m", (
        "depth", "indentation", "displacement", "penetration", "penetration depth",
        "indentation depth", "extension", "stroke", "weg", "eindringtiefe"), 0.01),
    "force": Quantity("N", ("force", "load", "kraft", "prüfkraft", "standardkraft")),
    "hardness": Quantity("", ("hardness", "härte", "hv", "hbw", "hb", "hrc", "hrb", "hld")),
}  # fmt: skip
_NAMES = {name: key for key, one in QUANTITIES.items() for name in one.names}
HARDNESS = re.compile(r"(HV|HBW|HB|HRC|HRB|HLD)[\d./ ]*", re.IGNORECASE)
"""A scale of hardness, with its load."""


@dataclass(frozen=True)
class Column:
    """A column that was recognised."""

    index: int
    heading: str
    quantity: str
    unit: str | None
    """As it is written; None if the heading has none."""
    size: float
    """The unit in SI units."""

    def said(self) -> str:
        """What the column is, in words."""
        name = QUANTITIES[self.quantity].names[0]
        if self.quantity == "hardness":
            return f"`{self.heading}` is {name}" + (f" in {self.unit}" if self.unit else "")
        si = QUANTITIES[self.quantity].unit
        unit = self.unit if self.unit is not None else f"{si} (no unit is given)" if si else ""
        return f"`{self.heading}` is {name}" + (f" in {unit}" if unit else "")


def parted(heading: str) -> tuple[str, str | None]:
    """Name and unit of a heading: `depth [um]`, `depth (um)`, `depth / um`, `depth, um`,
    `depth_um`, `speed_m_per_s`."""
    text = " ".join(heading.replace("\u00a0", " ").split())
    for opening, closing in ("[]", "()"):
        if opening in text:
            name, _, unit = text.partition(opening)
            if not unit.rstrip().endswith(closing):
                raise ValueError(f"`{shortened(text)}` has no closing bracket")
            return name.strip(" ,:"), unit.rstrip()[:-1].strip()
    if _key(text) in _NAMES or HARDNESS.fullmatch(text):
        return text, None
    for mark in (" / ", ",", " in ", "/", " ", "_"):
        # the longest name that is known
        places = [at.start() for at in re.finditer(re.escape(mark), text)]
        for place in reversed(places):
            name, unit = text[:place], text[place + len(mark) :].strip()
            if _key(name) in _NAMES and unit:
                return name.strip(), unit
    return text, None


def _key(name: str) -> str:
    text = " ".join(name.lower().replace("_", " ").split())
    return "e_t" if text == "e t" else text


def known(heading: str) -> bool:
    """Whether a heading names a quantity, with whatever unit."""
    try:
        name, _ = parted(heading)
    except ValueError:
        name = re.split(r"[\[(]", heading)[0]
    return bool(name) and (_key(name) in _NAMES or HARDNESS.fullmatch(name.strip()) is not None)


def column(index: int, heading: str, below: str | None = None) -> Column | None:
    """The column with this heading, and its unit from the line `below`, if that has units; None for
    a heading that names no quantity.

    Raises `ValueError` for a unit that the quantity has not.
    """
    name, unit = parted(heading)
    unit = unit if unit else (below or None)
    if scale := HARDNESS.fullmatch(name):
        return Column(index, heading.strip(), "hardness", scale[0].strip(), 1.0)
    quantity = _NAMES.get(_key(name))
    if quantity is None:
        return None
    if quantity == "hardness":
        if unit is not None and not HARDNESS.fullmatch(unit):
            raise ValueError(f"`{unit}` is no scale of hardness; expected HV10, HBW 10/3000, HRC")
        return Column(index, heading.strip(), quantity, unit, 1.0)
    si = QUANTITIES[quantity].unit
    size = 1.0 if unit is None else size_of(unit, si, name)
    return Column(index, heading.strip(), quantity, unit, size)


def size_of(unit: str, si: str, name: str) -> float:
    """The size of `unit` in the SI unit `si`, for the quantity `name`."""
    units = UNITS[si]
    plain = unit.replace("\u00b5", "u").replace("\u03bc", "u").replace("_per_", "/")
    plain = re.sub(r"\^|\*\*", "", plain.strip()).replace("²", "2").replace(" / ", "/")
    # `speed_m_s`
    plain = plain.replace("_", "/")
    if plain in units:
        return units[plain]
    if (si, plain) in AMBIGUOUS:
        raise ValueError(f"`{unit}` is ambiguous for {name}: {AMBIGUOUS[si, plain]}")
    alike = [it for it in units if it.lower() == plain.lower()]
    if len(alike) == 1:
        return units[alike[0]]
    if alike:
        raise ValueError(f"`{unit}` is ambiguous for {name}: it may be {' or '.join(alike)}")
    if not si:
        raise ValueError(f"{name} has no unit, not `{shortened(unit)}`")
    raise ValueError(f"`{shortened(unit)}` is no unit of {name}; expected {one_of(units)}")


def is_unit(text: str) -> bool:
    """Whether a cell is a unit and nothing else."""
    plain = text.strip().strip("[]()").replace("\u00b5", "u").replace("\u03bc", "u")
    return plain != "1" and any(plain in units for units in UNITS.values())


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


def nearest(heading: str) -> str:
    """A hint at the heading that is most like this one, and all that are known."""
    name = re.split(r"[\[(]", heading)[0].strip().lower()
    near = difflib.get_close_matches(name, _NAMES, 1)
    hint = f"did you mean `{near[0]}`? " if near else ""
    return f"{hint}expected {one_of(one.names[0] for one in QUANTITIES.values())}"


def shortened(text: str, most: int = 80) -> str:
    """A text that fits into a message."""
    return text if len(text) <= most else text[:most] + "..."


def counted(number: int, noun: str) -> str:
    """`1 line was`, `2 lines were`."""
    return f"{number} {noun} was" if number == 1 else f"{number} {noun}s were"


def one_of(names: Iterable[str]) -> str:
    """`a, b or c`."""
    *first, last = names
    return f"{', '.join(first)} or {last}" if first else last
