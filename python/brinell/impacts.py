"""Impacts one by one: a table of what varies, and what the exporter predicts of each row."""

from __future__ import annotations

import io
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import ProgramError
from .program import of_scene

Numbers = NDArray[np.float64]
Table = dict[str, NDArray[Any]]
"""Columns by name: numbers, and texts in `error` and `warning`."""
RESULTS = {
    "restitution": "", "rebound_speed": "m/s", "max_indentation": "m", "dent": "m", "energy_lost": "J", "impulse": "N.s",
}  # fmt: skip
"""The results of a run of a study, with their units."""


def impacts(scene: str | Path, columns: Mapping[str, Numbers]) -> tuple[Table, dict[str, str]]:
    """What the exporter predicts for each row of `columns`, which have the names of quantities and SI
    units; what they don't say is the scene's. Returns the table, with `speed`, `mass` and NaN where
    there is no prediction, and the units of its columns.

    Raises `ProgramError` for a bad scene and for a quantity that no impact has."""
    text = io.StringIO()
    np.savetxt(text, np.column_stack([*columns.values()]), "%.17g", ",", header=",".join(columns), comments="")
    try:
        said = json.loads(of_scene("predict", scene, "--impacts=-", text=text.getvalue())[0])
    except ProgramError as error:
        # nobody wrote that table
        raise ProgramError(str(error).replace("standard input:1: ", "")) from None
    (law,) = said["laws"]
    units = {column["name"]: column["unit"] for column in said["columns"]}
    table = {name: np.array(law[name], dtype=float) for name in units}
    none = np.full(len(law["error"]), np.nan)
    table.setdefault("mass", table.get("effective_mass", np.full_like(none, said["mass"])))
    has_speed = not {"energy", "drop_height"} & {*columns}
    of_energy = np.sqrt(2.0 * table.get("kinetic_energy", none) / table["mass"])
    table.setdefault("speed", np.full_like(none, said["speed"]) if has_speed else of_energy)
    table |= {name: np.array(law[name], dtype=object) for name in ("error", "warning")}
    return table, units | {"mass": "kg", "speed": "m/s", "error": "", "warning": ""}


def runs(scene: str | Path, columns: Mapping[str, Numbers]) -> tuple[Table, dict[str, str]]:
    """The `columns` of a study with its `RESULTS`, `error` and `warning`, and the units of all."""
    found, units = impacts(scene, columns)
    none = np.full(len(found["error"]), np.nan)
    table = {name: found[name] for name in ("speed", "mass", *columns)}
    table |= {name: found.get(name, none) for name in RESULTS}
    table["max_indentation"] = found.get("largest_indentation", none)
    table["rebound_speed"] = table["restitution"] * table["speed"]
    table["impulse"] = table["mass"] * (table["speed"] + table["rebound_speed"])
    table |= {name: found[name] for name in ("error", "warning")}
    return table, {name: (units | RESULTS)[name] for name in table}
