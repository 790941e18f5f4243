"""Sweeps and curves of a scene as pandas DataFrames."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .program import of_scene, options_of
from .studies import plan

if TYPE_CHECKING:
    from pandas import DataFrame

LISTED = 1000
"""Most values of a list: they are arguments of the exporter, whose length is limited."""


def sweep(
    scene: str | Path,
    vary: Mapping[str, plan.Varied],
    *,
    laws: Sequence[str] | None = None,
    mass: float | str | None = None,
    speed: float | str | None = None,
    angle: float | str | None = None,
    spin: float | str | None = None,
    friction: float | None = None,
    inertia: float | str | None = None,
) -> DataFrame:
    """Predictions over ranges of quantities: a row for each combination and law.

    `vary` maps the names of quantities to their values: "speed", "mass", "energy", "drop_height",
    parameters of the scene ("target.yield_strength"), constants of its laws. Values are a text
    "FROM:TO" or "FROM:TO:COUNT" in SI units or with a unit ("10 mm/s:5 m/s"), which is spaced by
    equal ratios over a decade and more, or as "FROM:TO:COUNTlog" and "FROM:TO:COUNTlin" say; a
    `Range`; or a list of at most 1000 numbers. `mass` [kg] and `speed` [m/s] replace those of the scene.

    With "angle" [degrees from the normal] or "spin" [rad/s], varied or given, the impacts are
    oblique: `rebound_angle`, `tangential_restitution` ... `friction` and `inertia` [kg.m^2] replace
    the scene's coefficient and that of a solid sphere.

    The columns are `law`, those that vary, `restitution`, `dent`, ..., `regime` by its name, and
    `valid`, which is False where the impact is outside the validity of the law. All numbers are in
    the SI units of `attrs["units"]`. `laws` ("LOADING" or "LOADING/UNLOADING", or "all") replace the
    scene's.
    """
    given = {"mass": mass, "speed": speed}
    given |= {"angle": angle, "spin": spin, "friction": friction, "inertia": inertia}
    options = options_of(given, laws)
    if not vary:
        raise ValueError("nothing is varied; for example, vary={'speed': '0.1:10'}")
    options += [f"--sweep={name}={range_of(name, values)}" for name, values in vary.items()]
    pandas = pandas_of("brinell.sweep")
    return _frame(pandas, of_scene("predict", scene, *options)[0])


def curve(scene: str | Path, *, laws: Sequence[str] | None = None, to: float | str | None = None) -> DataFrame:
    """One cycle of loading, unloading and reloading up to the indentation `to` [m], row by row:
    `law`, `indentation`, `force`, `contact_radius`, `stiffness`, `work` ... in the SI units of
    `attrs["units"]`, for the scene's law or for each of `laws`."""
    options = options_of({"to": to}, laws)
    pandas = pandas_of("brinell.curve")
    return _frame(pandas, of_scene("curve", scene, *options)[0])


def pandas_of(function: str) -> Any:
    """The package pandas, which this function of the module needs."""
    try:
        import pandas
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(
            f"{function} returns a pandas DataFrame: pip install pandas", name=error.name
        ) from error
    return pandas


def range_of(name: str, values: plan.Varied) -> str:
    """The values as the exporter takes them."""
    if isinstance(values, str):
        return values
    listed = plan.axis(name, values)
    if len(listed) > LISTED:
        raise ValueError(
            f"{name}: {len(listed)} values; a list has at most {LISTED}, 'FROM:TO:COUNT' and brinell.study take more"
        )
    # a single number has a comma behind it, too
    return ",".join(map(repr, listed.tolist())) + ("," if len(listed) == 1 else "")


def _frame(pandas: Any, text: str) -> DataFrame:
    """The table of all laws in an answer of the exporter."""
    data = json.loads(text)
    units = {"law": ""} | {column["name"]: column["unit"] for column in data["columns"]}
    parts = [
        # a number that a law does not have is null
        pandas.DataFrame(law).astype({name: np.float64 for name in units if name != "law"})
        for law in data["laws"]
    ]
    table: DataFrame = pandas.concat(parts, ignore_index=True)[list(units)]
    if "regime" in table:
        table["regime"] = [data["regimes"][int(number)] for number in table["regime"]]
    if "valid" in table:
        table["valid"] = table["valid"] == 1.0
    table.attrs["units"] = units
    return table
