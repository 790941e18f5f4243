"""A measurement: impacts, the record of an indentation, or readings of hardness."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from .quantities import (
    GRAVITY,
    QUANTITIES,
    Column,
    column,
    nearest,
    one_of,
    shortened,
)
from .reading import EXPECTED, Decimal, Rows, number, rows_of

Kind = Literal["impacts", "record", "hardness"]
Numbers = NDArray[np.float64]
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
UNITS = {name: QUANTITIES[name].unit for name in (*RESULTS, "force", "depth", "speed", "angle")} | {
    "flow_stress": "Pa"
}
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
    source: str | Path | Table,
    *,
    decimal: Decimal | None = None,
    columns: Mapping[str, str] | None = None,
) -> Measured:
    """The measurement in a file (CSV, Excel, Parquet) or a table.

    `columns` gives columns of the source other headings, `{"E2 [mm]": "depth [mm]"}`. Raises
    `ValueError` with the place of the first mistake, and what is expected there.
    """
    rows = rows_of(source, decimal)
    found, notes = _columns(rows, columns or {})
    quantities = {one.quantity: one for one in found}
    if "hardness" in quantities and len(_known(quantities, RESULTS)) == 0:
        return _hardness(rows, quantities["hardness"], notes)
    if {"depth", "force"} <= set(quantities):
        used = ["depth", "force"]
        make = _record
    else:
        used = _used(rows, quantities)
        make = _impacts
    notes += [
        f"The column `{one.heading}` was not used." for one in found if one.quantity not in used
    ]
    values = {name: _numbers(rows, quantities[name]) for name in used}
    for name in used:
        _check(rows, quantities[name], values[name], make is _record)
    return make(rows, values, notes)


def _known(quantities: Mapping[str, Column], names: Sequence[str]) -> list[str]:
    more = {"restitution": ("rebound_speed", "rebound_height")}
    return [it for it in names if any(one in quantities for one in (it, *more.get(it, ())))]


def _columns(rows: Rows, renamed: Mapping[str, str]) -> tuple[list[Column], list[str]]:
    """The columns that are recognised, and notes on them and on the others."""
    for heading in renamed:
        if heading not in rows.heading:
            raise ValueError(
                f"{rows.name}: columns names `{heading}`, which is no heading; there are "
                f"{one_of(f'`{it}`' for it in rows.heading)}"
            )
    found, unknown = list[Column](), list[str]()
    for index, heading in enumerate(rows.heading):
        below = rows.units[index] if rows.units else None
        try:
            one = column(index, renamed.get(heading, heading), below)
        except ValueError as error:
            raise ValueError(f"{rows.place}, column {index + 1}: {error}") from None
        if one is None:
            unknown.append(heading)
            continue
        twice = next((it for it in found if it.quantity == one.quantity), None)
        if twice is not None:
            name = QUANTITIES[one.quantity].names[0]
            raise ValueError(
                f"{rows.place}: `{twice.heading}` and `{one.heading}` are both {name}; give one "
                "another name, or pass columns="
            )
        found.append(one)
    if not found:
        first = rows.heading[0] if rows.heading else ""
        raise ValueError(
            f"{rows.place}, column 1: no quantity is called `{shortened(first)}`; {nearest(first)}; "
            f"for example {EXPECTED}"
        )
    if not rows.rows:
        raise ValueError(f"{rows.name}: there are no numbers; expected {EXPECTED}")
    notes = [*rows.notes, "Columns: " + "; ".join(one.said() for one in found) + "."]
    for heading in unknown:
        notes.append(f"The column `{shortened(heading)}` is unknown and was not used.")
    return found, notes


def _used(rows: Rows, quantities: Mapping[str, Column]) -> list[str]:
    """The columns of impacts that are used."""
    speed = next((it for it in ("speed", "drop_height") if it in quantities), None)
    results = _known(quantities, RESULTS)
    if speed is None or not results:
        names = " and ".join(one.heading for one in quantities.values())
        hint = ""
        if {"depth", "force"} & {*quantities}:
            other = "force" if "depth" in quantities else "depth"
            hint = f"a record needs a {other}, too. "
        elif results:
            hint = "impacts need a speed or a drop height. "
        elif speed is not None:
            hint = "impacts need a result, such as restitution or dent depth. "
        raise ValueError(f"{rows.place}: {names}: {hint}Expected {EXPECTED}")
    used = [speed, *(it for it in ("mass", "angle") if it in quantities)]
    for name in results:
        choices = (name, "rebound_speed", "rebound_height") if name == "restitution" else (name,)
        used.append(next(it for it in choices if it in quantities))
    return used


def _numbers(rows: Rows, one: Column) -> Numbers:
    values = np.empty(len(rows.rows))
    for index, (place, cells) in enumerate(rows.rows):
        cell = cells[one.index]
        try:
            values[index] = one.size * number(cell, rows.decimal)
        except (TypeError, ValueError, OverflowError):
            raise ValueError(
                f"{place}, column {one.index + 1}: {one.heading} = `{shortened(str(cell))}` is no number"
            ) from None
    return values


def _check(rows: Rows, one: Column, values: Numbers, is_record: bool) -> None:
    """Refuse numbers out of range, with their place."""
    quantity = QUANTITIES[one.quantity]
    name = quantity.names[0]
    may_be_missing = one.quantity in ("rebound_speed", "rebound_height", *RESULTS)
    largest = float(np.max(np.abs(values[np.isfinite(values)]), initial=0.0))
    if one.unit is None and largest > quantity.largest:
        if not quantity.unit:
            at = int(np.flatnonzero(np.abs(values) == largest)[0])
            place = f"{rows.rows[at][0]}, column {one.index + 1}"
            raise ValueError(
                f"{place}: {name} = {_shown(rows, at, one)} must be above 0 and at most 1"
            )
        from .quantities import UNITS as ALL

        raise ValueError(
            f"{rows.place}, column {one.index + 1}: `{one.heading}` has no unit, and numbers up to "
            f"{largest:g}, too large for {quantity.unit}: write `{one.heading} [UNIT]` with "
            f"{one_of(ALL[quantity.unit])}"
        )
    for at, value in enumerate(values.tolist()):
        place = f"{rows.rows[at][0]}, column {one.index + 1}"
        if np.isnan(value) and may_be_missing and _is_empty(rows.rows[at][1][one.index]):
            continue
        if not np.isfinite(value):
            what = "is no number" if _is_empty(rows.rows[at][1][one.index]) else "must be finite"
            raise ValueError(f"{place}: {name} = {_shown(rows, at, one)} {what}")
        if is_record or one.quantity in ("angle", "tangential_restitution", "rebound_angle"):
            continue
        if one.quantity == "restitution" and not 0.0 < value <= 1.0:
            raise ValueError(
                f"{place}: {name} = {_shown(rows, at, one)} must be above 0 and at most 1"
            )
        if not value > 0.0:
            raise ValueError(
                f"{place}: {name} = {_shown(rows, at, one)} must be positive and finite"
            )


def _shown(rows: Rows, at: int, one: Column) -> str:
    cell = rows.rows[at][1][one.index]
    return "``" if _is_empty(cell) else shortened(str(cell))


def _is_empty(cell: Any) -> bool:
    is_nan = isinstance(cell, float) and np.isnan(cell)
    return cell is None or bool(is_nan) or (isinstance(cell, str) and not cell.strip())


def _impacts(rows: Rows, values: dict[str, Numbers], notes: list[str]) -> Measured:
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
                f"{rows.rows[at][0]}: the impactor rebounds faster than it came: restitution = "
                f"{value:.4g} must be above 0 and at most 1"
            )
    for at, point in enumerate(np.column_stack(list(results.values()))):
        if np.all(np.isnan(point)):
            raise ValueError(f"{rows.rows[at][0]}: no result is given: {one_of(results)}")
    arguments = {"speed": speed} | {
        name: values[name] for name in ("mass", "angle") if name in values
    }
    if (
        "tangential_restitution" in results or "rebound_angle" in results
    ) and "angle" not in values:
        raise ValueError(
            f"{rows.place}: oblique impacts need a column `angle [deg]`, from the normal"
        )
    order = np.lexsort((arguments.get("angle", speed), speed))
    return Measured(
        "impacts",
        {name: it[order] for name, it in arguments.items()},
        {name: it[order] for name, it in results.items()},
        np.zeros(len(speed), dtype=int),
        tuple(notes),
    )


def _hardness(rows: Rows, one: Column, notes: list[str]) -> Measured:
    readings = []
    for place, cells in rows.rows:
        cell, scale = cells[one.index], one.unit
        text = cell.strip() if isinstance(cell, str) else ""
        if scale is None and any(it.isalpha() for it in text):
            readings.append(text)
            continue
        where = f"{place}, column {one.index + 1}: {one.heading} = `{shortened(str(cell))}`"
        if scale is None:
            raise ValueError(
                f"{where} has no scale; expected a heading such as `HV10` or `HBW 10/3000`"
            )
        try:
            value = number(cell, rows.decimal)
        except (TypeError, ValueError):
            value = np.nan
        if not (value > 0.0 and np.isfinite(value)):
            raise ValueError(f"{where} must be positive and finite")
        readings.append(f"{value:g} {scale}")
    none = np.zeros(len(readings), dtype=int)
    return Measured("hardness", {}, {}, none, tuple(notes), tuple(readings))


def _record(rows: Rows, values: dict[str, Numbers], notes: list[str]) -> Measured:
    depth, force = values["depth"], values["force"]
    pressed = force > 0.0
    if not np.any(pressed):
        raise ValueError(f"{rows.name}: no force is positive; compression counts positive")
    if not np.all(pressed):
        notes.append(
            f"{np.count_nonzero(~pressed)} of {len(force)} points have no positive force and were left "
            "out."
        )
    depth, force = depth[pressed], force[pressed]
    part = parts(depth, force)
    order = np.arange(len(depth)) if part.any() else np.argsort(depth, kind="stable")
    if part.any():
        unloadings = f"{part.max()} unloading" + ("s" if part.max() > 1 else "")
        notes.append(
            f"The record has {unloadings}: {np.count_nonzero(part)} of {len(part)} points are used as "
            "such."
        )
    depth, force = depth[order], force[order]
    return Measured(
        "record", {"depth": depth, "force": force}, {"force": force}, part[order], tuple(notes)
    )


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
    loading = list[tuple[float, float]]()
    scatter = TURNED * float(force.max())
    for at, value in zip(depth.tolist(), force.tolist(), strict=True):
        deeper = bisect_left(loading, at, key=lambda point: point[0])
        if deeper == len(loading):
            loading.append((at, value))
        elif deeper > 0:
            (before, low), (after, high) = loading[deeper - 1], loading[deeper]
            expected = low + (at - before) / (after - before) * (high - low)
            if value < UNLOADED * expected - scatter:
                return True
    return False
