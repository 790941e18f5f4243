"""The FMU of a study: the scene's first contact, moved by the FMU, with all parameters settable."""

from __future__ import annotations

import json
import re
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ..errors import ContactError, ProgramError, ProgramWarning
from ..program import export, predict, tables

OUTPUTS = ["indentation", "max_indentation", "residual_indentation", "dissipated_energy"]


def unit(scene: Path, folder: Path, mass: float | None) -> tuple[Path, dict[str, float]]:
    """Export the FMU for the impacts of a scene file into `folder`; return its path, and the impact
    of the scene.

    `mass` [kg] is needed if the scene has none, nor a density of its ball.
    """
    data = tables(scene)
    impact = dict(data.get("impact", {}))
    known = mass or impact.get("mass") or data.get("coupling", {}).get("effective_mass")
    # the exporter makes the mass of a density or of two bodies, and the speed of a height
    solid = has_bodies(data) or not {"density", "material"}.isdisjoint(data.get("impactor", {}))
    if (impact and not {"mass", "speed"} <= set(impact)) or (known is None and solid):
        with warnings.catch_warnings():
            # it will doubt the same again
            warnings.simplefilter("ignore", ProgramWarning)
            predicted = predict(scene, mass=known)
        known = predicted.mass
        # without an impact, it assumes a speed
        impact |= {"speed": predicted.speed} if impact else {}
    if known is None:
        raise ValueError(
            f"{scene} has no [impact] with a mass, and no density of [impactor]: pass mass= (--mass), or vary it"
        )
    path = folder / "scene.toml"
    path.write_text(toml(of_impacts(data, float(known))), encoding="utf-8")
    usual = {name: impact[name] for name in ("speed",) if name in impact}
    with naming(scene, path):
        return export(path, folder / "unit.fmu"), usual | {"mass": float(known)}


@contextmanager
def naming(scene: str | Path, path: str | Path) -> Iterator[None]:
    """Errors name the file `scene` instead of `path`, which was made of it: what is wrong there is wrong
    in the scene, or doesn't go with what is asked for."""
    try:
        yield
    except (ProgramError, ContactError) as error:
        words = " ".join(str(error).split())
        if str(path) not in words or Path(path).name == Path(scene).name:
            raise
        # lines are those of a text that nobody sees
        words = re.sub(rf"{re.escape(str(path))}(:\d+)*", lambda _: str(scene), words)
        raise type(error)(words) from error


def has_bodies(data: Mapping[str, Any]) -> bool:
    """Whether the masses are those of tables `[[body]]`."""
    return bool(data.get("body"))


def of_impacts(data: Mapping[str, Any], mass: float) -> dict[str, Any]:
    """The scene with one contact, a known mass, and all parameters settable."""
    # friction doesn't change the motion along the normal, which the mass of the contact determines
    other = ("body", "contact", "fmu", "friction")
    made = {key: value for key, value in data.items() if key not in other}
    first = data.get("contact", [{}])[0]
    for body in ("impactor", "target"):
        made[body] = {**data.get(body, {}), **first.get(body, {})}
    # the dent of an impact is read after the bodies have separated
    made["target"].pop("surface", None)
    made["fmu"] = {"outputs": OUTPUTS}
    made["coupling"] = {"effective_mass": mass}
    if "impact" in made:
        made["impact"] = {**made["impact"], "mass": mass}
    return made


def toml(data: Mapping[str, Any]) -> str:
    """TOML with every table on one line."""
    return "".join(f"{key} = {_value(value)}\n" for key, value in data.items())


def _value(value: Any) -> str:
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{json.dumps(k)} = {_value(v)}" for k, v in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(_value, value)) + "]"
    if isinstance(value, bool | str):
        return json.dumps(value)
    return repr(value)
