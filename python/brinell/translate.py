"""Numbers for the contact models of other tools, with their error."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .program import of_scene

Columns = dict[str, NDArray[np.float64]]
"""Columns of a table by name."""


@dataclass(frozen=True)
class Way:
    """One set of numbers for a tool; some tools have several."""

    name: str
    """Its name, such as "stiffness" or "restitution"."""
    title: str
    law: str
    """The force law of the tool in words."""
    block: str
    """What is pasted into the tool."""
    numbers: dict[str, float]
    """The numbers of the block by name, in the units of the block."""
    units: dict[str, str]
    """Their units."""
    step: float | None
    """The step of the tool [s] for which the numbers are; None if the tool chooses its steps, or if
    they don't matter."""
    softening: float
    """How many times longer than the scene's the contact lasts, because of the step."""
    largest_step: float | None
    """The largest step [s] at which no phase of the touch gains energy, if there is such a limit."""
    promised: Columns
    """What the tool does at each speed, the mean over the phases of the touch within a step:
    `speed` [m/s], `restitution`, `least_restitution`, `most_restitution`, `largest_force` [N],
    `contact_time` [s], `depth` [m]; NaN where the tool defines none."""
    notes: tuple[str, ...]
    """What these numbers can't do, and what else must be set."""


@dataclass(frozen=True)
class Translation:
    """The numbers of a scene for a tool."""

    tool: str
    title: str
    versions: str
    """The releases of the tool for which the numbers hold."""
    reference: str
    """Where the tool documents them."""
    law: str
    """The laws of the scene."""
    mass: float
    """Effective mass [kg]."""
    speed: float
    """The speed [m/s] at which the numbers are found."""
    wanted: Columns
    """What the scene's law says at each speed: `speed`, `restitution`, `largest_force`,
    `contact_time`, `depth`, in SI units."""
    ways: tuple[Way, ...]
    left_out: tuple[str, ...]
    """Ways of the tool that can't give this impact, with the reason."""
    notes: tuple[str, ...]
    """What is to know of the scene."""

    def __getitem__(self, name: str) -> Way:
        for way in self.ways:
            if way.name == name:
                return way
        names = ", ".join(way.name for way in self.ways)
        raise KeyError(f"{self.title} has no {name!r}; it has {names}")


def translate(
    scene: str | Path,
    tool: str,
    *,
    speed: str | float | None = None,
    step: float | str | None = None,
    units: str = "si",
) -> Translation:
    """Numbers of the first contact of a scene file for the contact model of `tool`: "mujoco",
    "drake", "adams" ... An unknown tool raises `ProgramError` with the list.

    `speed` is the range of closing speeds [m/s] for which the error is told, such as "0.1:3"
    (default: a tenth to three times the scene's); `step` that of the tool [s]. Texts may have
    units. `units` "mm-t-s" is for tools with a choice, such as Adams.
    """
    options = ["--for", str(tool), f"--units={units}"]
    for name, value in {"speed": speed, "step": step}.items():
        if isinstance(value, bool | bytes):
            raise TypeError(f"{name} = {value!r}: a number or a text is needed")
        if value is not None:
            options.append(f"--{name}={value if isinstance(value, str) else repr(float(value))}")
    data = json.loads(of_scene("translate", scene, *options)[0])
    speeds = data["speeds"]
    known = {"tool", "title", "versions", "reference", "law", "mass", "speed"}
    return Translation(
        wanted=_columns(speeds, data["wanted"]),
        ways=tuple(_way(way, speeds) for way in data["ways"]),
        left_out=tuple(data["left_out"]),
        notes=tuple(data["notes"]),
        **{name: value for name, value in data.items() if name in known},
    )


def _way(way: dict[str, Any], speeds: list[float]) -> Way:
    numbers = way["numbers"]
    same = {"name", "title", "law", "block", "step", "softening", "largest_step"}
    return Way(
        # a number that there is none of, such as the time constant of no damping, is null
        numbers={it["key"]: np.nan if it["value"] is None else it["value"] for it in numbers},
        units={it["key"]: it["unit"] for it in numbers},
        promised=_columns(speeds, way["promised"]),
        notes=tuple(way["notes"]),
        **{name: value for name, value in way.items() if name in same},
    )


def _columns(speeds: list[float], rows: list[dict[str, float | None]]) -> Columns:
    columns = {"speed": np.array(speeds, dtype=np.float64)}
    for name in rows[0]:
        columns[name] = np.array([row[name] for row in rows], dtype=np.float64)
    return columns
