"""A measurement: impacts, the record of an indentation, or readings of hardness."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ..errors import one_of, shortened
from ..prediction import GRAVITY
from .reading import Decimal, Rows, rows_of

Kind = Literal["impacts", "record", "hardness"]
Numbers = NDArray[np.float64]
Column = Mapping[str, Any]
"""A column of a table, as the exporter read it."""
Table = Mapping[str, Sequence[float] | NDArray[np.float64]]
"""Columns of numbers by their headings; a pandas DataFrame is one, too."""

UNLOADED = 0.9
"""Force below that of the first loading at the same depth, as a part of it, that tells an unloading
from scatter."""
TURNED = 0.01
"""Fall of the force, as a part of the largest force, that ends a loading."""
RESULTS = (
    "restitution", "dent_depth", "dent_diameter", "contact_time", "largest_force",
    "tangential_restitution", "rebound_angle",
)  # fmt: skip
"""What is measured of an impact."""
MAY_BE_MISSING = ("rebound_speed", "rebound_height", "bounce_interval", "bounce_time")
MAY_BE_ANY = ("angle", "tangential_restitution", "rebound_angle", "bounce_time")
ABOVE = "must be above 0 and at most 1"
UNITS = {
    "restitution": "", "dent_depth": "m", "dent_diameter": "m", "contact_time": "s",
    "largest_force": "N", "tangential_restitution": "", "rebound_angle": "deg", "force": "N",
    "depth": "m", "speed": "m/s", "angle": "deg", "flow_stress": "Pa",
}  # fmt: skip
"""SI units of results and arguments."""


@dataclass(frozen=True)
class Measured:
    """Points in SI units. A record is in its own order, or ascending if it has no unloading;
    impacts are ascending in speed, and in angle."""

    kind: Kind
    arguments: Mapping[str, Numbers]
    """`speed` [m/s], `mass` [kg] and `angle` [deg] of impacts, as far as they are given; `depth` [m]
    and `force` [N] of a record."""
    results: Mapping[str, Numbers]
    """What was measured at each point, by `RESULTS`, "force" or "flow_stress"; NaN where nothing
    was."""
    part: NDArray[np.int_]
    """0 in a first loading, otherwise the number of the unloading, with its reloading."""
    notes: tuple[str, ...] = ()
    readings: tuple[str, ...] = field(default=(), repr=False)
    """Readings of hardness."""

    @property
    def count(self) -> int:
        """Number of points."""
        return len(self.part)

    @property
    def argument(self) -> str:
        """The argument of a picture."""
        if self.kind == "record":
            return "depth"
        angles = self.arguments.get("angle")
        return "speed" if angles is None or len(np.unique(angles)) == 1 else "angle"

    @property
    def different(self) -> int:
        """The number of different points."""
        if self.kind == "hardness":
            return len(set(self.readings))
        columns = (*self.arguments.values(), *self.results.values())
        return len(np.unique(np.column_stack(columns), axis=0))

    def without(self, points: NDArray[np.bool_]) -> Measured:
        """The measurement without these points."""
        keep = ~points
        return replace(
            self,
            arguments={name: it[keep] for name, it in self.arguments.items()},
            results={name: it[keep] for name, it in self.results.items()},
            part=self.part[keep],
        )


def measured(
    source: str | Path | Table, *, decimal: Decimal | None = None, columns: Mapping[str, str] | None = None
) -> Measured:
    """The measurement in a file (CSV, Excel, Parquet) or a table.

    `columns` gives columns of the source other headings, `{"E2 [mm]": "depth [mm]"}`. Raises
    `ValueError` with the place of the first mistake, and what is expected there.
    """
    rows = rows_of(source, decimal, columns)
    if not rows.lines:
        raise ValueError(f"{rows.name}: there are no numbers; expected {rows.examples}")
    found = {one["quantity"]: one for one in rows.columns}
    notes = list(rows.notes)
    if "hardness" in found and len(_known(found, RESULTS)) == 0:
        return _hardness(rows, notes)
    if {"depth", "force"} <= set(found):
        used = ["depth", "force"]
        make = _record
    else:
        used = _used(rows, found)
        make = _impacts
    notes += [f"The column `{one['heading']}` was not used." for one in found.values() if one["quantity"] not in used]
    values = {name: _numbers(rows, found[name]) for name in used}
    for name in used:
        _check(rows, found[name], values[name], make is _record)
    return make(rows, values, notes)


def _known(found: Mapping[str, Any], names: Sequence[str]) -> list[str]:
    more = {"restitution": ("rebound_speed", "rebound_height")}
    return [it for it in names if any(one in found for one in (it, *more.get(it, ())))]


def _used(rows: Rows, found: Mapping[str, Column]) -> list[str]:
    """The columns of impacts that are used."""
    speed = next((it for it in ("speed", "drop_height") if it in found), None)
    results = _known(found, RESULTS)
    if speed is None and not results:
        for bounces in ("bounce_interval", "bounce_time"):
            if bounces in found:
                return [bounces, *(it for it in ("mass",) if it in found)]
    if speed is None or not results:
        names = " and ".join(one["heading"] for one in found.values())
        hint = ""
        if {"strain", "stress"} & {*found}:
            hint = "a tensile test belongs into the scene, as tensile_test. "
        elif {"depth", "force"} & {*found}:
            other = "force" if "depth" in found else "depth"
            hint = f"a record needs a {other}, too. "
        elif results:
            hint = "impacts need a speed or a drop height. "
        elif speed is not None:
            hint = "impacts need a result, such as restitution or dent depth. "
        unknown = f"Unknown: {', '.join(rows.unknown)}. " if rows.unknown else ""
        raise ValueError(f"{rows.place()}: {names}: {hint}{unknown}Expected {rows.examples}")
    used = [speed, *(it for it in ("mass", "angle") if it in found)]
    for name in results:
        choices = (name, "rebound_speed", "rebound_height") if name == "restitution" else (name,)
        used.append(next(it for it in choices if it in found))
    return used


def _numbers(rows: Rows, one: Column) -> Numbers:
    at = next((at for at, cell in enumerate(one["cells"]) if isinstance(cell, str)), None)
    if at is not None:
        said = f"{one['heading']} = `{shortened(one['cells'][at])}`"
        raise ValueError(f"{rows.place(at, one)}: {said} is no number")
    cells = [np.nan if cell is None else cell for cell in one["cells"]]
    return np.array(cells, dtype=float) * float(one["size"])


def _check(rows: Rows, one: Column, values: Numbers, is_record: bool) -> None:
    """Refuse numbers out of range, with their place."""
    quantity, name, cells = one["quantity"], one["name"], one["cells"]

    def refuse(at: int, what: str) -> None:
        shown = "``" if cells[at] is None else f"{cells[at]:g}"
        raise ValueError(f"{rows.place(at, one)}: {name} = {shown} {what}")

    may_be_missing = quantity in (*MAY_BE_MISSING, *RESULTS)
    largest = float(np.max(np.abs(values[np.isfinite(values)]), initial=0.0))
    most = 1.0 if quantity == "restitution" else np.inf
    if one["unit"] is None and one["largest"] is not None and largest > one["largest"]:
        if not one["si"]:
            refuse(int(np.flatnonzero(np.abs(values) == largest)[0]), ABOVE)
        raise ValueError(
            f"{rows.place(None, one)}: `{one['heading']}` has no unit, and numbers up to "
            f"{largest:g}, too large for {one['si']}: write `{one['heading']} [UNIT]` with "
            f"{one_of(one['usual'])}"
        )
    for at, value in enumerate(values.tolist()):
        if np.isnan(value):
            if not may_be_missing:
                refuse(at, "is no number")
        elif not is_record and quantity not in MAY_BE_ANY and not 0.0 < value <= most:
            refuse(at, ABOVE if quantity == "restitution" else "must be positive and finite")


def _impacts(rows: Rows, values: dict[str, Numbers], notes: list[str]) -> Measured:
    at_row = np.arange(len(rows.lines))
    if {"bounce_interval", "bounce_time"} & {*values}:
        at_row = _bounces(rows, values)
    height = values.pop("drop_height", None)
    speed = values.pop("speed") if height is None else np.sqrt(2.0 * GRAVITY * height)
    if (rebound := values.pop("rebound_speed", None)) is not None:
        values["restitution"] = rebound / speed
    if (rebound := values.pop("rebound_height", None)) is not None:
        values["restitution"] = np.sqrt(2.0 * GRAVITY * rebound) / speed
    results = {name: it for name, it in values.items() if name in RESULTS}
    for at, value in enumerate(results.get("restitution", np.empty(0)).tolist()):
        if value > 1.0:
            raise ValueError(
                f"{rows.place(int(at_row[at]))}: the impactor rebounds faster than it came: "
                f"restitution = {value:.4g} must be above 0 and at most 1"
            )
    for at, point in enumerate(np.column_stack(list(results.values()))):
        if np.all(np.isnan(point)):
            where = rows.place(int(at_row[at]))
            raise ValueError(f"{where}: no result is given: {one_of(results)}")
    arguments = {"speed": speed} | {name: values[name] for name in ("mass", "angle") if name in values}
    if ("tangential_restitution" in results or "rebound_angle" in results) and "angle" not in values:
        raise ValueError(f"{rows.place()}: oblique impacts need a column `angle [deg]`, from the normal")
    order = np.lexsort((arguments.get("angle", speed), speed))
    return Measured(
        "impacts",
        {name: it[order] for name, it in arguments.items()},
        {name: it[order] for name, it in results.items()},
        np.zeros(len(speed), dtype=int),
        tuple(notes),
    )


def _bounces(rows: Rows, values: dict[str, Numbers]) -> NDArray[np.int_]:
    """Put the impacts between the flights of a ball that bounces in place of their times; return the
    row of each.

    A flight of the time T begins and ends with g T/2, so an impact between two flights has the
    restitution T'/T. An empty cell ends a series.
    """
    intervals = values.pop("bounce_interval", None)
    if intervals is None:
        intervals = np.diff(values.pop("bounce_time"), append=np.nan)
        if np.any(wrong := intervals <= 0.0):
            at = int(np.flatnonzero(wrong)[0]) + 1
            raise ValueError(f"{rows.place(at)}: the bounces are not in the order of their times")
    before, after = intervals[:-1], intervals[1:]
    found = np.flatnonzero(np.isfinite(before) & np.isfinite(after))
    if len(found) == 0:
        raise ValueError(f"{rows.name}: an impact needs the flight before it and the one after it")
    if "mass" in values:
        values["mass"] = values["mass"][found]
    values["speed"] = 0.5 * GRAVITY * before[found]
    values["restitution"] = after[found] / before[found]
    return found + 1


def _hardness(rows: Rows, notes: list[str]) -> Measured:
    if wrong := rows.wrong_reading:
        at = rows.lines.index(wrong["line"]) if wrong["line"] in rows.lines else None
        where = rows.place(at, {"index": wrong["column"] - 1})
        raise ValueError(f"{where}: {wrong['why']}")
    readings = tuple(rows.readings or ())
    none = np.zeros(len(readings), dtype=int)
    return Measured("hardness", {}, {}, none, tuple(notes), readings)


def _record(rows: Rows, values: dict[str, Numbers], notes: list[str]) -> Measured:
    depth, force = values["depth"], values["force"]
    pressed = force > 0.0
    if not np.any(pressed):
        raise ValueError(f"{rows.name}: no force is positive; compression counts positive")
    if not np.all(pressed):
        notes.append(f"{np.count_nonzero(~pressed)} of {len(force)} points have no positive force and were left out.")
    depth, force = depth[pressed], force[pressed]
    part = parts(depth, force)
    order = np.arange(len(depth)) if part.any() else np.argsort(depth, kind="stable")
    if part.any():
        unloadings = f"{part.max()} unloading" + ("s" if part.max() > 1 else "")
        notes.append(f"The record has {unloadings}: {np.count_nonzero(part)} of {len(part)} points are used as such.")
    depth, force = depth[order], force[order]
    return Measured("record", {"depth": depth, "force": force}, {"force": force}, part[order], tuple(notes))


def parts(depth: Numbers, force: Numbers) -> NDArray[np.int_]:
    """The number of the unloading that each point of a record belongs to, with the reloading after
    it; 0 in the first loading.

    All points are first loading if none shows an unloading: tests of several specimens may follow
    each other, in any order.
    """
    part = np.zeros(len(depth), dtype=int)
    if not _has_unloading(depth, force):
        return part
    top, last, number, is_loading = force[0], 0, 0, True
    for index in range(1, len(depth)):
        if force[index] >= top:
            top, last, is_loading = force[index], index, True
        elif is_loading and force[index] < top - TURNED * float(force.max()):
            number, is_loading = number + 1, False
            part[last + 1 : index] = number
        if not is_loading:
            part[index] = number
    return part


def _has_unloading(depth: Numbers, force: Numbers) -> bool:
    """Whether a point has much less force than the first loading at the same depth."""
    is_loading = depth > np.concatenate(([-np.inf], np.maximum.accumulate(depth)[:-1]))
    loading = depth[is_loading], force[is_loading]
    expected = np.interp(depth, *loading)
    less = force < UNLOADED * expected - TURNED * float(force.max())
    return bool(np.any(less & ~is_loading & (depth > loading[0][0])))
