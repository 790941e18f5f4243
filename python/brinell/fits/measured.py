"""A measurement: rebounds, or the record of an indentation."""

from __future__ import annotations

import csv
from bisect import bisect_left
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

Kind = Literal["restitution", "force"]
Table = Mapping[str, Sequence[float] | NDArray[np.float64]]
"""Columns of numbers by their headings; a pandas DataFrame is one, too."""

MOST = 10_000
"""Largest number of rows."""
UNLOADED = 0.9
"""Force below that of the first loading at the same depth, as a part of it, that tells an unloading
from scatter."""
SHOWN = 80
"""Largest number of characters of a cell in a message."""

UNITS: Mapping[str, Mapping[str, float]] = {
    "m/s": {"m/s": 1.0, "mm/s": 1e-3, "cm/s": 1e-2, "km/s": 1e3, "km/h": 1.0 / 3.6},
    "": {},
    "m": {
        "m": 1.0, "mm": 1e-3, "cm": 1e-2, "um": 1e-6, "\u00b5m": 1e-6, "\u03bcm": 1e-6, "nm": 1e-9,
        "km": 1e3, "in": 0.0254,
    },
    "N": {
        "N": 1.0, "kN": 1e3, "MN": 1e6, "mN": 1e-3, "uN": 1e-6, "kgf": 9.80665, "kp": 9.80665,
        "lbf": 4.4482216152605,
    },
}  # fmt: skip
"""The units of each kind, with their sizes in its SI unit."""
QUANTITIES = {
    "speed": ("speed", "m/s"),
    "restitution": ("restitution", ""),
    "depth": ("depth", "m"),
    "indentation": ("depth", "m"),
    "force": ("force", "N"),
}
"""The quantity and the SI unit of each name of a column."""
KINDS: Mapping[Kind, tuple[str, str]] = {
    "restitution": ("speed", "restitution"),
    "force": ("depth", "force"),
}
"""The argument and the value of each kind of measurement."""
EXPECTED = (
    "a first line such as `speed [m/s], restitution` or `depth [um], force [N]`, and numbers "
    "below it"
)


@dataclass(frozen=True)
class Measured:
    """Points in SI units, in ascending order of their arguments."""

    kind: Kind
    at: NDArray[np.float64]
    """Closing speeds [m/s], or depths [m]."""
    values: NDArray[np.float64]
    """Restitutions, or forces [N]."""
    left_out: int
    """Number of points besides that belong to no first loading."""

    @property
    def size(self) -> float:
        """The unit of the differences: a restitution of 1, or the largest force [N]."""
        return 1.0 if self.kind == "restitution" else float(self.values.max())

    @property
    def different(self) -> int:
        """The number of different points."""
        return len(set(zip(self.at.tolist(), self.values.tolist(), strict=True)))


def measured(source: str | Path | Table) -> Measured:
    """The measurement in a CSV file or a table.

    Raises `ValueError` with the place of the first mistake, and what is expected there.
    """
    if not isinstance(source, str | Path):
        return _of_table(source)
    path = Path(source)
    try:
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError:
        raise ValueError(f"{path}: the file is no text in UTF-8") from None
    return _of_lines(str(path), text.split("\n"))


def _of_lines(path: str, lines: Iterable[str]) -> Measured:
    columns, points = None, list[list[float]]()
    for number, line in enumerate(lines, start=1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        place = f"{path}:{number}"
        try:
            cells = [
                cell.strip()
                for cell in next(csv.reader([line], strict=True, skipinitialspace=True))
            ]
        except csv.Error:
            raise ValueError(f"{place}: a quotation mark is not closed") from None
        if columns is None:
            columns = _heading(place, cells)
        elif len(points) == MOST:
            raise ValueError(f"{place}: there are more than {MOST} rows")
        elif len(cells) != 2:
            raise ValueError(f"{place}: {len(cells)} numbers instead of two")
        else:
            points.append(
                [one.number(place, cell) for one, cell in zip(columns, cells, strict=True)]
            )
    if columns is None:
        raise ValueError(f"{path}: the file is empty; expected {EXPECTED}")
    if not points:
        raise ValueError(f"{path}: there are no numbers; expected {EXPECTED}")
    return _of_points(columns, points)


def _of_table(table: Table) -> Measured:
    names = [str(name) for name in table]
    columns = _heading("the measurement", names)
    values = [list(table[name]) for name in table]
    if len(values[0]) != len(values[1]):
        raise ValueError(
            f"{names[0]} has {len(values[0])} numbers, and {names[1]} {len(values[1])}"
        )
    if not 0 < len(values[0]) <= MOST:
        raise ValueError(f"the measurement has {len(values[0])} rows; allowed is 1 to {MOST}")
    points = [
        [one.number(f"row {row}", cell) for one, cell in zip(columns, cells, strict=True)]
        for row, cells in enumerate(zip(*values, strict=True))
    ]
    return _of_points(columns, points)


@dataclass(frozen=True)
class _Column:
    index: int
    name: str
    quantity: str
    size: float
    """Its unit in SI units."""

    def number(self, place: str, cell: Any) -> float:
        """The number in a cell, in SI units."""
        place = f"{place}, column {self.index + 1}"
        shown = _shortened(str(cell))
        try:
            if "_" in str(cell):
                raise ValueError
            value = self.size * float(cell)
        except (TypeError, ValueError):
            raise ValueError(f"{place}: {self.name} = `{shown}` is no number") from None
        if self.quantity == "restitution" and not 0.0 < value <= 1.0:
            raise ValueError(f"{place}: restitution = {shown} must be above 0 and at most 1")
        if not (value > 0.0 and np.isfinite(value)):
            raise ValueError(f"{place}: {self.name} = {shown} must be positive and finite")
        return value


def _shortened(text: str) -> str:
    return text if len(text) <= SHOWN else text[:SHOWN] + "..."


def _heading(place: str, cells: Sequence[str]) -> list[_Column]:
    """The two columns that the first line names."""
    if len(cells) != 2:
        problem = (
            "has no comma; columns are separated by commas, and decimals have a point"
            if len(cells) == 1
            else f"has {len(cells)} columns, separated by commas"
        )
        raise ValueError(f"{place}: `{_shortened(','.join(cells))}` {problem}; expected {EXPECTED}")
    columns = [
        _column(f"{place}, column {index + 1}", index, cell) for index, cell in enumerate(cells)
    ]
    if {one.quantity for one in columns} not in map(set, KINDS.values()):
        names = " and ".join(one.name for one in columns)
        raise ValueError(f"{place}: {names} don't belong together; expected {EXPECTED}")
    return columns


def _column(place: str, index: int, heading: str) -> _Column:
    """The column with this heading: `depth`, `depth [um]` or `depth_um`."""
    name, bracket, unit = heading.partition("[")
    if bracket:
        unit = unit.rstrip()
        if not unit.endswith("]"):
            raise ValueError(f"{place}: `{heading}` has no closing bracket")
        name, unit = name.strip(), unit[:-1].strip()
    else:
        name, _, unit = heading.partition("_")
    unit = unit.replace("_per_", "/")
    if name.lower() not in QUANTITIES:
        known = _one_of(QUANTITIES)
        raise ValueError(f"{place}: no quantity is called `{_shortened(name)}`; expected {known}")
    name = name.lower()
    quantity, base = QUANTITIES[name]
    if not unit:
        return _Column(index, name, quantity, 1.0)
    if not base:
        raise ValueError(f"{place}: {name} has no unit, not `{_shortened(unit)}`")
    if unit not in UNITS[base]:
        known = _one_of(UNITS[base])
        raise ValueError(f"{place}: `{_shortened(unit)}` is no unit of {name}; expected {known}")
    return _Column(index, name, quantity, UNITS[base][unit])


def _one_of(names: Iterable[str]) -> str:
    *first, last = names
    return f"{', '.join(first)} or {last}"


def _of_points(columns: Sequence[_Column], points: list[list[float]]) -> Measured:
    quantities = [one.quantity for one in columns]
    kind: Kind = "restitution" if "restitution" in quantities else "force"
    if quantities[0] != KINDS[kind][0]:
        points = [point[::-1] for point in points]
    kept = first_loading(points) if kind == "force" else points
    at, values = np.array(sorted(kept, key=lambda point: point[0])).T
    return Measured(kind, at, values, len(points) - len(kept))


def first_loading(points: list[list[float]]) -> list[list[float]]:
    """The points of a first loading among those of a record of depth and force, in the order of the
    file: each is deeper than all before it, under a larger force.

    All points, if none shows an unloading: tests of several specimens may follow each other.
    """
    loading = list[list[float]]()
    has_unloading = False
    for depth, force in points:
        deeper = bisect_left(loading, depth, key=lambda point: point[0])
        if deeper == len(loading):
            loading.append([depth, force])
        elif deeper > 0:
            (before, low), (after, high) = loading[deeper - 1], loading[deeper]
            part = (depth - before) / (after - before)
            has_unloading |= force < UNLOADED * (low + part * (high - low))
    if not has_unloading:
        return points
    # where an unloading begins, creep makes the contact deeper while its force falls
    kept, largest = list[list[float]](), 0.0
    for depth, force in loading:
        if force > largest:
            kept.append([depth, force])
            largest = force
    return kept
