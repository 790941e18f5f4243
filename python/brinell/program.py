"""The exporter `brinell`, called as a program: FMUs, predictions and curves of a scene."""

from __future__ import annotations

import csv
import io
import json
import os
import re
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, overload

import numpy as np
from numpy.typing import NDArray

from .errors import ProgramError

Columns = dict[str, NDArray[np.float64]]
"""Columns of a table by name, in SI units."""


@dataclass(frozen=True)
class Prediction:
    """The outcome of an impact, from the energy balance."""

    law: str
    mass: float
    """Effective mass [kg]."""
    speed: float
    """Closing speed [m/s]."""
    restitution: float
    kinetic_energy: float
    """[J]"""
    energy_lost: float
    """[J]"""
    largest_force: float
    """[N]"""
    largest_indentation: float
    """[m]"""
    largest_contact_radius: float
    """[m]"""
    loading_time: float
    """From touch to the largest indentation [s]."""
    unloading_time: float
    """From there to separation [s]."""
    dent: float
    """Depth that remains [m]; rate-dependent laws leave none."""
    regime: int
    """The regime at the largest indentation, numbered like the output `regime`."""
    onsets: tuple[tuple[int, float], ...] = ()
    """Pairs: a regime, and the speed [m/s] at which it begins."""
    warnings: tuple[str, ...] = ()
    """In which respects this impact leaves the validity of the law."""


def program() -> Path:
    """The path of the exporter: the environment variable BRINELL, on PATH, or in `target/release`
    of the repository."""
    named = os.environ.get("BRINELL")
    if named:
        found = shutil.which(named)
        if found is None:
            raise ProgramError(f"BRINELL = {named}: there is no such program")
        return Path(found)
    on_path = shutil.which("brinell")
    if on_path is not None:
        return Path(on_path)
    name = "brinell.exe" if os.name == "nt" else "brinell"
    built = Path(__file__).resolve().parents[2] / "target" / "release" / name
    if built.is_file():
        return built
    raise ProgramError(
        "the exporter brinell was not found: build it in the repository (cargo build --release), "
        "put it on PATH (cargo install --locked --path .), or set BRINELL to its path"
    )


def _run(*arguments: str | Path) -> str:
    """The JSON output of the exporter."""
    command = [str(program()), *map(str, arguments), "--json"]
    try:
        result = subprocess.run(command, capture_output=True, encoding="utf-8", check=False)
    except OSError as error:
        raise ProgramError(f"{command[0]} cannot be run: {error}") from error
    if result.returncode != 0:
        text = result.stderr.strip().removeprefix("brinell: ")
        # progress messages come before the error
        text = re.sub(r"^building .* \.\.\.\n(brinell: )?", "", text)
        raise ProgramError(text or f"{' '.join(command)} ended with status {result.returncode}")
    return result.stdout


def export(scene: str | Path, output: str | Path | None = None) -> Path:
    """Export the FMU of a scene file; return its path, by default `NAME.fmu` in the current folder.
    """
    more: list[str | Path] = [] if output is None else ["--output", output]
    return Path(json.loads(_run("export", scene, *more))["fmu"])


@overload
def predict(
    scene: str | Path,
    *,
    laws: None = None,
    mass: float | None = None,
    speed: float | None = None,
    energy: float | None = None,
    drop_height: float | None = None,
) -> Prediction: ...


@overload
def predict(
    scene: str | Path,
    *,
    laws: Sequence[str],
    mass: float | None = None,
    speed: float | None = None,
    energy: float | None = None,
    drop_height: float | None = None,
) -> list[Prediction]: ...


def predict(
    scene: str | Path,
    *,
    laws: Sequence[str] | None = None,
    mass: float | None = None,
    speed: float | None = None,
    energy: float | None = None,
    drop_height: float | None = None,
) -> Prediction | list[Prediction]:
    """Predict an impact on the first contact of a scene file.

    `mass` [kg] and one of `speed` [m/s], `energy` [J] and `drop_height` [m] replace those of the
    scene. With `laws` (names "LOADING" or "LOADING/UNLOADING", or "all"), the result is a list with
    a prediction for each law.
    """
    given = {"mass": mass, "speed": speed, "energy": energy, "drop-height": drop_height}
    options = _options(given, laws)
    data = json.loads(_run("predict", scene, *options))
    known = {field.name for field in fields(Prediction)}
    predictions = []
    for law in data["laws"]:
        values = {name: value for name, value in law.items() if name in known}
        values["onsets"] = tuple((it["regime"], it["speed"]) for it in law.get("onsets") or ())
        values["warnings"] = tuple(law.get("warnings") or ())
        predictions.append(Prediction(mass=data["mass"], speed=data["speed"], **values))
    return predictions if laws is not None else predictions[0]


@overload
def sweep(
    scene: str | Path, first: float, last: float, *, laws: None = None, mass: float | None = None
) -> Columns: ...


@overload
def sweep(
    scene: str | Path, first: float, last: float, *, laws: Sequence[str], mass: float | None = None
) -> dict[str, Columns]: ...


def sweep(
    scene: str | Path,
    first: float,
    last: float,
    *,
    laws: Sequence[str] | None = None,
    mass: float | None = None,
) -> Columns | dict[str, Columns]:
    """Predictions over closing speeds from `first` to `last` [m/s], as columns: `speed`,
    `restitution`, `dent` ...; with `laws`, a mapping from the name of each law to its columns."""
    options = _options({"mass": mass}, laws)
    text = _run("predict", scene, *options, "--sweep", "speed", f"{first!r}:{last!r}")
    tables = _tables(text)
    return tables if laws is not None else next(iter(tables.values()))


@overload
def curve(scene: str | Path, *, laws: None = None, to: float | None = None) -> Columns: ...


@overload
def curve(
    scene: str | Path, *, laws: Sequence[str], to: float | None = None
) -> dict[str, Columns]: ...


def curve(
    scene: str | Path, *, laws: Sequence[str] | None = None, to: float | None = None
) -> Columns | dict[str, Columns]:
    """One cycle of loading, unloading and reloading up to the indentation `to` [m], as columns:
    `indentation`, `force`, `contact_radius`, `stiffness`, `work` ...; with `laws` those of each law
    by its name."""
    tables = _tables(_run("curve", scene, *_options({"to": to}, laws)))
    return tables if laws is not None else next(iter(tables.values()))


def _options(values: Mapping[str, float | None], laws: Sequence[str] | None) -> list[str]:
    options = []
    for name, value in values.items():
        if value is not None:
            if isinstance(value, str | bytes | bool):
                raise TypeError(f"{name} = {value!r}: a number is needed")
            options += [f"--{name}={float(value)!r}"]
    if laws is not None:
        if isinstance(laws, str):
            raise TypeError(f"laws = {laws!r}: a list of names is needed")
        options += ["--laws", ",".join(laws)]
    return options


def _tables(text: str) -> dict[str, Columns]:
    """A table of the exporter, split by its first column `law`; names lose their units."""
    rows: dict[str, list[dict[str, str]]] = {}
    for row in csv.DictReader(io.StringIO(text)):
        rows.setdefault(row.pop("law"), []).append(row)
    return {
        law: {_bare(name): _column(table, name) for name in table[0]} for law, table in rows.items()
    }


def _column(table: list[dict[str, Any]], name: str) -> NDArray[np.float64]:
    # a field that a law does not have is empty
    return np.array([float(row[name] or "nan") for row in table])


def _bare(name: str) -> str:
    return re.sub(r"_(m_per_s|N_per_m|Pa|N|J|m|s)$", "", name)
