"""The exporter `brinell`, called as a program: FMUs and predictions of a scene."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypedDict, Unpack, overload

from .errors import ContactError, ProgramError, ProgramWarning, missing, tell
from .prediction import ObliquePrediction, Prediction
from .version import MODULE, installed
from .workbooks import environment

if TYPE_CHECKING:
    from .uncertainty import Spread

__all__ = ["ObliquePrediction", "Prediction", "export", "predict", "program"]


def program() -> Path:
    """The path of the exporter: the environment variable BRINELL, the program of this wheel, on PATH,
    or in `target/release` of the repository."""
    named = os.environ.get("BRINELL")
    if named:
        found = shutil.which(named)
        if found is None:
            raise ProgramError(f"BRINELL = {named}: there is no such program")
        return Path(found)
    built = MODULE.parents[1] / "target" / "release" / _NAME
    for path in (_of_the_wheel(), shutil.which("brinell"), built):
        if path is not None and Path(path).is_file():
            return Path(path)
    raise ProgramError(
        "the exporter brinell was not found: install the wheel of a release, build it in "
        "the repository (cargo build --release), put it on PATH (cargo install --locked --path .), or set "
        "the variable BRINELL to its path"
    )


_NAME = "brinell.exe" if os.name == "nt" else "brinell"
_SCRIPTS = ("bin", "Scripts")


def _of_the_wheel() -> Path | None:
    """The program that was installed together with this package, even if the environment is not
    activated; None if the package is used from the repository."""
    distribution = installed()
    if distribution is None:
        return None
    listed = [Path(str(file.locate())) for file in distribution.files or ()]
    # `pip install --target` lists the program where it was before the files were moved
    moved = [MODULE.parent / folder / _NAME for folder in _SCRIPTS]
    programs = [path for path in listed if path.name == _NAME and path.parent.name in _SCRIPTS]
    return next((path.resolve() for path in programs + moved if path.is_file()), None)


def run(*arguments: str | Path, text: str | None = None) -> tuple[str, tuple[str, ...]]:
    """The JSON output of the exporter, with a `text` as its input, and its warnings, which are
    warnings of Python, too."""
    command = [str(program()), *map(str, arguments), "--json"]
    try:
        with environment(arguments) as own:
            result = subprocess.run(command, capture_output=True, encoding="utf-8", check=False, input=text, env=own)
    except OSError as error:
        raise ProgramError(f"{command[0]} cannot be run: {error}") from error
    if result.returncode != 0:
        text = result.stderr.strip().removeprefix("brinell: ")
        # progress messages come before the error
        text = re.sub(r"^building .* \.\.\.\n(brinell: )?", "", text)
        raise ProgramError(text or f"{' '.join(command)} ended with status {result.returncode}")
    doubts = []
    for text in result.stderr.split("brinell: warning: ")[1:]:
        # the first line, and those of the text that were broken
        text = text.split("\nbuilding ")[0].split("\nbrinell: ")[0]
        doubts.append(" ".join(text.split()))
        tell(doubts[-1], ProgramWarning)
    return result.stdout, tuple(doubts)


def of_scene(
    command: str, scene: str | Path, *options: str | Path, text: str | None = None
) -> tuple[str, tuple[str, ...]]:
    """What a command of the exporter answers about a scene, with a `text` as its input, and its warnings."""
    if not Path(scene).exists():
        raise missing("scene", scene)
    return run(command, scene, *options, text=text)


def unpack(fmu: str | Path, folder: Path) -> dict[str, str]:
    """Unpack an FMU into a folder; return the `identifier` of its library, and the path of the
    `library` of this machine in the folder.

    Raises `ContactError` with the reason why the program doesn't load it."""
    # that there is no program isn't the fault of the FMU
    program()
    try:
        found: dict[str, str] = json.loads(run("unpack", fmu, folder)[0])
    except ProgramError as error:
        raise ContactError(str(error)) from error
    return found


def in_si(name: str, value: float | str) -> float:
    """The number of a quantity or a parameter in SI units. The exporter reads a text with a unit:
    "400 MPa"."""
    if not isinstance(value, str):
        return float(value)
    try:
        return float(value)
    except ValueError:
        return float(json.loads(run("numbers", f"{name}={value}")[0])[0])


def export(scene: str | Path, output: str | Path | None = None) -> Path:
    """Export the FMU of a scene file; return its path, by default `NAME.fmu` in the current folder.

    A scene for which the installed program has no prebuilt library needs Rust."""
    more: list[str | Path] = [] if output is None else ["--output", output]
    if output is not None and not (folder := Path(output).absolute().parent).is_dir():
        raise missing("folder", folder)
    return Path(json.loads(of_scene("export", scene, *more)[0])["fmu"])


Number = float | str | None
"""In SI units, or a text with a unit; what isn't given is the scene's."""


class Impact(TypedDict, total=False):
    """An impact along the normal."""

    mass: Number
    speed: Number
    energy: Number
    drop_height: Number


class Oblique(Impact, total=False):
    """What an oblique impact has besides its angle."""

    spin: Number
    friction: float | None
    inertia: Number


@overload
def predict(
    scene: str | Path,
    *,
    laws: None = None,
    uncertainty: Mapping[str, Spread] | None = None,
    angle: None = None,
    **impact: Unpack[Impact],
) -> Prediction: ...
@overload
def predict(
    scene: str | Path, *, laws: Sequence[str], angle: None = None, **impact: Unpack[Impact]
) -> list[Prediction]: ...
@overload
def predict(
    scene: str | Path, *, laws: None = None, angle: float | str, **impact: Unpack[Oblique]
) -> ObliquePrediction: ...
@overload
def predict(
    scene: str | Path, *, laws: Sequence[str], angle: float | str, **impact: Unpack[Oblique]
) -> list[ObliquePrediction]: ...
def predict(
    scene: str | Path,
    *,
    laws: Sequence[str] | None = None,
    mass: Number = None,
    speed: Number = None,
    energy: Number = None,
    drop_height: Number = None,
    angle: Number = None,
    spin: Number = None,
    friction: float | None = None,
    inertia: Number = None,
    uncertainty: Mapping[str, Spread] | None = None,
) -> Prediction | list[Prediction] | ObliquePrediction | list[ObliquePrediction]:
    """Predict an impact on the first contact of a scene file.

    `mass` [kg] and one of `speed` [m/s], `energy` [J] and `drop_height` [m] replace those of the
    scene; texts such as "4 g" have another unit. With `laws` (names "LOADING" or
    "LOADING/UNLOADING", or "all"), the result is a list with a prediction for each law.

    With `angle` [degrees from the normal] the impact is oblique, the speed is that along the path, and
    the result is an `ObliquePrediction`. `spin` [rad/s] is that of the ball before; `friction` and
    `inertia` [kg.m^2] replace the scene's coefficient and that of a solid sphere.

    `uncertainty` maps "speed", "mass" and parameters of the scene to their spreads: a standard
    deviation ("5 %", "10 MPa", a number in SI units), two ends of a range, or a distribution of
    `scipy.stats`. The prediction then has `bands`: 95 % of 1024 draws are within.
    """
    if uncertainty and laws is not None:
        raise ValueError("uncertainty belongs to the scene's own law: leave laws out")
    given = {"mass": mass, "speed": speed, "energy": energy, "drop-height": drop_height}
    of_oblique = {"spin": spin, "friction": friction, "inertia": inertia}
    if angle is not None:
        if uncertainty:
            raise ValueError("uncertainty is for impacts along the normal: leave angle out")
        given |= {"angle": angle, **of_oblique}
        return _oblique(scene, options_of(given, laws), laws is None)
    if alone := [name for name, value in of_oblique.items() if value is not None]:
        raise ValueError(f"{alone[0]} belongs to an oblique impact: give its angle, too")
    options = options_of(given, laws)
    text, doubts = of_scene("predict", scene, *options)
    data = json.loads(text)
    known = {field.name for field in fields(Prediction)}
    predictions = []
    for law in data["laws"]:
        values = {name: value for name, value in law.items() if name in known}
        values |= {"regime": law["regime_name"], "regime_number": law["regime"]}
        values["onsets"] = tuple((it["regime_name"], it["speed"]) for it in law["onsets"])
        values["warnings"] = (*doubts, *law["warnings"])
        values["notes"] = tuple(data["notes"])
        predictions.append(Prediction(mass=data["mass"], speed=data["speed"], **values))
    if uncertainty:
        from .uncertainty import bands

        first = predictions[0]
        drawn = bands(scene, uncertainty, mass=first.mass, speed=first.speed)
        return replace(first, bands=drawn)
    return predictions if laws is not None else predictions[0]


def _oblique(scene: str | Path, options: Sequence[str], alone: bool) -> ObliquePrediction | list[ObliquePrediction]:
    """The oblique impact with these options, by the scene's law alone or by several."""
    text, doubts = of_scene("predict", scene, *options)
    data = json.loads(text)
    names = [field.name for field in fields(ObliquePrediction) if field.name != "warnings"]
    said = (*doubts, *data["warnings"])
    predictions = [
        ObliquePrediction(**{name: (data | law)[name] for name in names}, warnings=said) for law in data["laws"]
    ]
    return predictions[0] if alone else predictions


def tables(scene: str | Path) -> dict[str, Any]:
    """The tables of a scene file, with all numbers in SI units."""
    return tomllib.loads(of_scene("si", scene)[0])


def options_of(values: Mapping[str, float | str | None], laws: Sequence[str] | None) -> list[str]:
    """The options of the exporter for these values and laws."""
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
