"""The scene of a fit: one contact, as tables and as text."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ..errors import ProgramError

Tables = dict[str, Any]
BODIES = ("impactor", "target")


@contextmanager
def naming(scene: str | Path, path: str | Path) -> Iterator[None]:
    """Errors name the file `scene` instead of `path`, which was made of it: what is wrong there is wrong
    in the scene, or doesn't go with what is asked for."""
    try:
        yield
    except ProgramError as error:
        words = " ".join(str(error).split())
        if str(path) not in words or Path(path).name == Path(scene).name:
            raise
        # lines are those of a text that nobody sees
        words = re.sub(rf"{re.escape(str(path))}(:\d+)*", lambda _: str(scene), words)
        raise type(error)(words) from error


def of_first_contact(data: Mapping[str, Any]) -> Tables:
    """The scene with its first contact alone, whose motion along the normal no body or friction changes."""
    made = {key: it for key, it in data.items() if key not in ("body", "contact", "fmu", "friction", "coupling")}
    first = data.get("contact", [{}])[0]
    for body in BODIES:
        made[body] = {**data.get(body, {}), **first.get(body, {})}
    made["target"].pop("surface", None)
    return made


def slow(data: Mapping[str, Any]) -> Tables:
    """The scene of a slow first loading, of which an FMU gives the force: without an impact, rates and losses."""
    made = {key: it for key, it in of_first_contact(data).items() if key != "impact"}
    made["law"] = {key: it for key, it in made.get("law", {}).items() if key != "elastic_restitution"}
    for body in BODIES:
        made[body] = {key: it for key, it in made[body].items() if key not in ("rate", "plate_thickness")}
    return made | {"fmu": {"outputs": ["contact_radius", "stiffness"]}}


def with_loading(law: Mapping[str, Any], loading: str) -> Tables:
    """The table `law` of a scene with another law, and the same losses."""
    first, _, second = loading.partition("/")
    kept = {key: it for key, it in law.items() if key == "elastic_restitution"}
    return kept | {"loading": first} | ({"unloading": second} if second else {})


def without_readings(body: Mapping[str, Any]) -> Tables:
    """A body without hardness, tensile strength and tensile test."""
    readings = {"hardness", "tensile_strength", "tensile_test", "hardening_exponent"}
    return {key: it for key, it in body.items() if key not in readings}


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
