"""The runs of a study: impacts, each in one step of an FMU that knows the mass."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..contact import Contact
from ..errors import ContactError, ContactWarning

Table = dict[str, NDArray[Any]]
"""Columns by name: numbers, and strings in `error` and `warning`."""
RESULTS = {
    "restitution": "",
    "rebound_speed": "m/s",
    "max_indentation": "m",
    "dent": "m",
    "energy_lost": "J",
    "impulse": "N.s",
}
"""The results of a run, with their units."""
UNITS = {"speed": "m/s", "mass": "kg", **RESULTS, "error": "", "warning": ""}
"""The units of all columns but those of parameters."""
LONG = 1.0
"""The first step [s]: longer than almost any impact. If the impact is not over, further steps
follow, each ten times as long."""


def run(unit: Path, names: Sequence[str], rows: NDArray[np.float64]) -> Table:
    """Run a chunk: one instance for all its impacts, reset between them.

    `names` are those of the columns of `rows`: "speed" [m/s], "mass" [kg] and parameters of the
    FMU, in SI units.
    """
    table: Table = {name: rows[:, index].copy() for index, name in enumerate(names)}
    table |= {name: np.full(len(rows), np.nan) for name in RESULTS}
    table |= {name: np.full(len(rows), "", dtype=object) for name in ("error", "warning")}
    with warnings.catch_warnings(record=True) as told, Contact(unit) as contact:
        warnings.simplefilter("always", ContactWarning)
        for index, row in enumerate(rows):
            try:
                results = impact(contact, dict(zip(names, row.tolist(), strict=True)))
            except ContactError as error:
                table["error"][index] = str(error)
            else:
                for name, value in zip(RESULTS, results, strict=True):
                    table[name][index] = value
            table["warning"][index] = "; ".join(str(one.message) for one in told)
            told.clear()
    return table


def impact(contact: Contact, row: dict[str, float]) -> tuple[float, ...]:
    """Run one impact; return its `RESULTS`."""
    speed, mass = row.pop("speed"), row.pop("mass")
    if not speed > 0.0:
        raise ContactError(f"speed = {speed} m/s: an impact needs a closing speed above zero")
    contact.reset(parameters={**row, "effective_mass": mass}, initial_gap=0.0)
    impulse, now, step = 0.0, speed, LONG
    for _ in range(12):
        given = step * contact.step(step, now)
        impulse, now, step = impulse + given, now - given / mass, 10.0 * step
        if contact["force"] == 0.0:
            break
    else:
        raise ContactError(f"the impact is not over after {contact.time:g} s")
    names = ("max_indentation", "residual_indentation", "dissipated_energy")
    return -now / speed, -now, *(contact[name] for name in names), impulse
