"""The exporter `brinell`, called as a program: FMUs, predictions and curves of a scene."""

from __future__ import annotations

import errno
import json
import os
import re
import shutil
import subprocess
import tomllib
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from importlib import metadata
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import NDArray

from .errors import ProgramError, ProgramWarning

if TYPE_CHECKING:
    from .uncertainty import Bands, Spread

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
    """Kinetic energy before the impact [J]."""
    energy_lost: float
    """Energy dissipated by the impact [J]."""
    largest_force: float
    """Largest force [N]."""
    largest_indentation: float
    """Largest indentation [m]."""
    largest_contact_radius: float
    """Contact radius at the largest indentation [m]."""
    loading_time: float
    """Time from first contact to the largest indentation [s]."""
    unloading_time: float
    """Time from the largest indentation to separation [s]."""
    dent: float
    """Depth of the dent [m]; rate-dependent laws leave none."""
    regime: int
    """The regime at the largest indentation, numbered like the output `regime`."""
    onsets: tuple[tuple[int, float], ...] = ()
    """Pairs: a regime, and the speed [m/s] at which it begins."""
    warnings: tuple[str, ...] = ()
    """Warnings about the validity of the law for this impact."""
    bands: Bands | None = None
    """The bands of the results, if an uncertainty was given."""


def program() -> Path:
    """The path of the exporter: the environment variable BRINELL, the program of this wheel, on PATH,
    or in `target/release` of the repository."""
    named = os.environ.get("BRINELL")
    if named:
        found = shutil.which(named)
        if found is None:
            raise ProgramError(f"BRINELL = {named}: there is no such program")
        return Path(found)
    module = Path(__file__).resolve().parent
    built = module.parents[1] / "target" / "release" / _NAME
    for path in (_of_the_wheel(module), shutil.which("brinell"), built):
        if path is not None and Path(path).is_file():
            return Path(path)
    raise ProgramError(
        "the exporter brinell was not found: install the wheel of a release, build it in "
        "the repository (cargo build --release), put it on PATH (cargo install --locked --path .), or set "
        "the variable BRINELL to its path"
    )


_NAME = "brinell.exe" if os.name == "nt" else "brinell"
_SCRIPTS = ("bin", "Scripts")


def _of_the_wheel(module: Path) -> Path | None:
    """The program that was installed together with the module in the folder `module`, even if
    the environment is not activated; None if the module is used from the repository."""
    try:
        distribution = metadata.distribution("brinell")
    except metadata.PackageNotFoundError:
        return None
    if Path(str(distribution.locate_file("brinell"))).resolve() != module:
        return None
    listed = [Path(str(file.locate())) for file in distribution.files or ()]
    # `pip install --target` lists the program where it was before the files were moved
    moved = [module.parent / folder / _NAME for folder in _SCRIPTS]
    programs = [path for path in listed if path.name == _NAME and path.parent.name in _SCRIPTS]
    return next((path.resolve() for path in programs + moved if path.is_file()), None)


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
    for text in result.stderr.split("brinell: warning: ")[1:]:
        # the first line, and those of the text that were broken; where the public function was called
        text = text.split("\nbuilding ")[0].split("\nbrinell: ")[0]
        warnings.warn(" ".join(text.split()), ProgramWarning, stacklevel=3)
    return result.stdout


def export(scene: str | Path, output: str | Path | None = None) -> Path:
    """Export the FMU of a scene file; return its path, by default `NAME.fmu` in the current folder.

    A scene for which the installed program has no prebuilt library needs Rust."""
    more: list[str | Path] = [] if output is None else ["--output", output]
    return Path(json.loads(_run("export", scene, *more))["fmu"])


@overload
def predict(
    scene: str | Path,
    *,
    laws: None = None,
    mass: float | str | None = None,
    speed: float | str | None = None,
    energy: float | str | None = None,
    drop_height: float | str | None = None,
    uncertainty: Mapping[str, Spread] | None = None,
) -> Prediction: ...


@overload
def predict(
    scene: str | Path,
    *,
    laws: Sequence[str],
    mass: float | str | None = None,
    speed: float | str | None = None,
    energy: float | str | None = None,
    drop_height: float | str | None = None,
) -> list[Prediction]: ...


def predict(
    scene: str | Path,
    *,
    laws: Sequence[str] | None = None,
    mass: float | str | None = None,
    speed: float | str | None = None,
    energy: float | str | None = None,
    drop_height: float | str | None = None,
    uncertainty: Mapping[str, Spread] | None = None,
) -> Prediction | list[Prediction]:
    """Predict an impact on the first contact of a scene file.

    `mass` [kg] and one of `speed` [m/s], `energy` [J] and `drop_height` [m] replace those of the
    scene; texts such as "4 g" have another unit. With `laws` (names "LOADING" or
    "LOADING/UNLOADING", or "all"), the result is a list with a prediction for each law.

    `uncertainty` maps "speed", "mass" and parameters of the scene to their spreads: a standard
    deviation ("5 %", "10 MPa", a number in SI units), two ends of a range, or a distribution of
    `scipy.stats`. The prediction then has `bands`: 95 % of 1024 draws are within.
    """
    if uncertainty and laws is not None:
        raise ValueError("uncertainty belongs to the scene's own law: leave laws out")
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
    if uncertainty:
        from .uncertainty import bands

        first = predictions[0]
        drawn = bands(scene, uncertainty, mass=first.mass, speed=first.speed)
        return replace(first, bands=drawn)
    return predictions if laws is not None else predictions[0]


@overload
def sweep(
    scene: str | Path,
    vary: Mapping[str, str],
    *,
    laws: None = None,
    mass: float | str | None = None,
    speed: float | str | None = None,
    angle: float | str | None = None,
    spin: float | str | None = None,
    friction: float | None = None,
    inertia: float | str | None = None,
) -> Columns: ...


@overload
def sweep(
    scene: str | Path,
    vary: Mapping[str, str],
    *,
    laws: Sequence[str],
    mass: float | str | None = None,
    speed: float | str | None = None,
    angle: float | str | None = None,
    spin: float | str | None = None,
    friction: float | None = None,
    inertia: float | str | None = None,
) -> dict[str, Columns]: ...


def sweep(
    scene: str | Path,
    vary: Mapping[str, str],
    *,
    laws: Sequence[str] | None = None,
    mass: float | str | None = None,
    speed: float | str | None = None,
    angle: float | str | None = None,
    spin: float | str | None = None,
    friction: float | None = None,
    inertia: float | str | None = None,
) -> Columns | dict[str, Columns]:
    """Predictions over ranges of quantities, as columns: those that vary, `restitution`, `dent` ...;
    `valid` is 0 where the impact is outside the validity of the law.

    `vary` maps the names of quantities to ranges "FROM:TO" or "FROM:TO:COUNT" in SI units or with a
    unit ("10 mm/s:5 m/s"): "speed", "mass", "energy", "drop_height", parameters of the scene,
    constants of its laws. Several give every combination. `mass` [kg] and `speed` [m/s] replace those of the scene.

    With "angle" [degrees from the normal] or "spin" [rad/s], varied or given, the impacts are
    oblique: `rebound_angle`, `tangential_restitution` ... `friction` and `inertia` [kg.m^2] replace
    the scene's coefficient and that of a solid sphere.

    With `laws`, the result is a mapping from "LOADING/UNLOADING" to columns.
    """
    given = {"mass": mass, "speed": speed}
    given |= {"angle": angle, "spin": spin, "friction": friction, "inertia": inertia}
    options = _options(given, laws)
    for name, values in vary.items():
        if not isinstance(values, str):
            raise TypeError(f"{name} = {values!r}: a range 'FROM:TO' or 'FROM:TO:COUNT' is needed")
        options.append(f"--sweep={name}={values}")
    if not vary:
        raise ValueError("nothing is varied; for example, vary={'speed': '0.1:10'}")
    tables = _tables(_run("predict", scene, *options))
    return tables if laws is not None else next(iter(tables.values()))


@overload
def curve(scene: str | Path, *, laws: None = None, to: float | str | None = None) -> Columns: ...


@overload
def curve(
    scene: str | Path, *, laws: Sequence[str], to: float | str | None = None
) -> dict[str, Columns]: ...


def curve(
    scene: str | Path, *, laws: Sequence[str] | None = None, to: float | str | None = None
) -> Columns | dict[str, Columns]:
    """One cycle of loading, unloading and reloading up to the indentation `to` [m], as columns:
    `indentation`, `force`, `contact_radius`, `stiffness`, `work` ...; with `laws` those of each law
    by its name."""
    tables = _tables(_run("curve", scene, *_options({"to": to}, laws)))
    return tables if laws is not None else next(iter(tables.values()))


def tables(scene: str | Path) -> dict[str, Any]:
    """The tables of a scene file, with all numbers in SI units."""
    if not Path(scene).exists():
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(scene))
    return tomllib.loads(_run("si", scene))


def _options(values: Mapping[str, float | str | None], laws: Sequence[str] | None) -> list[str]:
    options = []
    for name, value in values.items():
        if value is not None:
            if isinstance(value, bytes | bool):
                raise TypeError(f"{name} = {value!r}: a number is needed")
            # the program knows units
            options += [f"--{name}={value if isinstance(value, str) else repr(float(value))}"]
    if laws is not None:
        if isinstance(laws, str):
            raise TypeError(f"laws = {laws!r}: a list of names is needed")
        options += ["--laws", ",".join(laws)]
    return options


def _tables(text: str) -> dict[str, Columns]:
    """The columns of each law in the output of the exporter."""
    tables = {}
    for table in json.loads(text)["laws"]:
        law = table.pop("law")
        # a number that a law does not have is null
        tables[law] = {name: np.array(column, dtype=np.float64) for name, column in table.items()}
    return tables
