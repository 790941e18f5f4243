"""Uncertainty forward: how far an impact spreads, if what is known of it is uncertain.

The inputs are drawn by scrambled Sobol points (`scipy.stats.qmc`), independent of each other, and
each draw is an impact that the exporter predicts.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, cast

import numpy as np

from .errors import ContactError, UnknownName, nearest
from .impacts import RESULTS as OF_RUNS
from .impacts import Numbers, Table, runs
from .prediction import quantity
from .program import in_si, of_scene, options_of

Spread = float | str | Sequence[float | str] | Any
"""A standard deviation, as a number in SI units, "5 %" or "10 MPa"; two ends of a range, all of it
equally likely; or a distribution of `scipy.stats`."""

RESULTS: Mapping[str, str] = {
    "restitution": "", "dent": "m", "max_indentation": "m", "energy_lost": "J",
}  # fmt: skip
"""What has a band, with its SI unit."""
LEVEL = 0.95
"""The part of all draws that is within a band."""
DRAWS = 1024
"""Number of draws of a prediction."""


@dataclass(frozen=True)
class Bands:
    """Bands of the results of an impact: 95 % of all draws are within."""

    bands: Mapping[str, tuple[float, float]]
    """By result: "restitution", "dent" [m], "max_indentation" [m], "energy_lost" [J]."""
    median: Mapping[str, float]
    shares: Mapping[str, Mapping[str, float]] = field(repr=False)
    """For each result, the part of its variance that follows from each input alone: the square of
    their rank correlation."""
    draws: Mapping[str, Numbers] = field(repr=False)
    """All draws, inputs and results, in SI units."""

    def __str__(self) -> str:
        lines = []
        for name, (low, high) in self.bands.items():
            unit = RESULTS[name]
            words = f"{name}: {quantity(self.median[name], unit)}, 95 % within "
            words += f"{quantity(low, unit)} to {quantity(high, unit)}"
            most = max(self.shares[name], key=lambda it: self.shares[name][it])
            lines.append(f"{words}; {most} makes {self.shares[name][most]:.0%} of the variance")
        return "\n".join(lines)


def bands(
    path: str | Path,
    uncertainty: Mapping[str, Spread],
    *,
    mass: float | None = None,
    speed: float | None = None,
    draws: int = DRAWS,
    seed: int = 0,
) -> Bands:
    """The bands of an impact on the first contact of a scene file.

    `uncertainty` maps "speed", "mass" and parameters of the scene ("target.yield_strength") to their
    spreads. `draws` is a power of two.

    Raises `UnknownName` for an input that the scene has not, `ValueError` for a spread out of range,
    and `ContactError` if a draw is outside the range of the law.
    """
    given = {name: np.array([it]) for name, it in (("mass", mass), ("speed", speed)) if it is not None}
    columns = _spread(_with_centres(path, given, uncertainty), uncertainty, draws, seed)
    table, _ = runs(path, columns)
    for index, error in enumerate(table["error"]):
        if error:
            shown = ", ".join(f"{it} = {table[it][index]:.4g}" for it in uncertainty)
            raise ContactError(f"a draw is no impact ({shown}): {error}")
    results = {name: np.asarray(table[name]) for name in RESULTS}
    inputs = {name: np.asarray(table[name]) for name in uncertainty}
    return Bands(
        {name: _band(it) for name, it in results.items()},
        {name: float(np.median(it)) for name, it in results.items()},
        {name: {of: _share(one, it) for of, one in inputs.items()} for name, it in results.items()},
        inputs | results,
    )


def _with_centres(
    path: str | Path, columns: Mapping[str, Numbers], uncertainty: Mapping[str, Spread]
) -> dict[str, Numbers]:
    """The `columns` with those around which inputs spread: the values of the scene."""
    said = json.loads(of_scene("predict", path)[0])
    known = {name: said[name] for name in ("speed", "mass")} | said["parameters"]
    count = len(next(iter(columns.values()))) if columns else 1
    found = dict(columns)
    for name in uncertainty:
        if name not in known and name not in columns:
            raise UnknownName(f"{path} has no parameter {name!r}{nearest(name, known)}; it has {', '.join(known)}")
        found.setdefault(name, np.full(count, known.get(name)))
    return found


def _spread(
    columns: Mapping[str, Numbers], uncertainty: Mapping[str, Spread], draws: int, seed: int
) -> dict[str, Numbers]:
    """Each row of the `columns` as often as there are draws, with what is uncertain spread around its value."""
    from scipy.stats import qmc

    if not uncertainty:
        raise ValueError("uncertainty is empty; for example, {'target.yield_strength': '8 %'}")
    if draws < 2 or draws & (draws - 1):
        raise ValueError(f"draws = {draws}; a power of two is needed, such as 1024")
    sobol = qmc.Sobol(len(uncertainty), rng=seed)
    # open ends: a draw at 0 would be infinitely far
    places = np.clip(sobol.random(draws), 0.5**33, 1.0 - 0.5**33)
    found = {name: np.repeat(column, draws) for name, column in columns.items()}
    for place, (name, one) in zip(places.T, uncertainty.items(), strict=True):
        found[name] = np.concatenate([_values(name, one, float(centre), place) for centre in columns[name]])
    return found


def _values(name: str, one: Spread, centre: float, places: Numbers) -> Numbers:
    """The values of an input at these fractions of its distribution."""
    from scipy.special import ndtri

    if hasattr(one, "ppf"):
        return np.asarray(one.ppf(places), dtype=float)
    if isinstance(one, str | int | float) and not isinstance(one, bool):
        is_part = isinstance(one, str) and one.strip().endswith("%")
        deviation = abs(centre) * float(str(one).strip()[:-1]) / 100.0 if is_part else in_si(name, one)
        if not (deviation > 0.0 and np.isfinite(deviation)):
            raise ValueError(f"{name} = {one!r}: a standard deviation must be positive and finite")
        return np.asarray(centre + deviation * ndtri(places))
    try:
        low, high = (in_si(name, it) for it in cast("Sequence[Any]", one))
    except (TypeError, ValueError) as error:
        raise ValueError(
            f"{name} = {one!r}: a standard deviation ('5 %', '10 MPa'), two ends of a range, or a "
            "distribution of scipy.stats is needed"
        ) from error
    if not low < high:
        raise ValueError(f"{name} = {one!r}: the first end must be below the second")
    return low + places * (high - low)


def _band(values: Numbers) -> tuple[float, float]:
    low, high = np.quantile(values, [0.5 - 0.5 * LEVEL, 0.5 + 0.5 * LEVEL])
    return float(low), float(high)


def _share(one: Numbers, other: Numbers) -> float:
    from scipy.stats import rankdata

    ranks = rankdata(one), rankdata(other)
    if np.ptp(ranks[0]) == 0.0 or np.ptp(ranks[1]) == 0.0:
        return 0.0
    return float(np.corrcoef(*ranks)[0, 1] ** 2)


def banded(
    path: str | Path, columns: Mapping[str, Numbers], uncertainty: Mapping[str, Spread], draws: int, seed: int
) -> tuple[Table, dict[str, str]]:
    """The table of a study whose runs are drawn so often, and its units: one row for each run, with the
    medians and, beside each result, its band in `NAME_low` and `NAME_high`.

    A run of which a draw failed has the reason of the first in `error`, and no results.
    """
    centres = _with_centres(path, columns, uncertainty)
    table, units = runs(path, _spread(centres, uncertainty, draws, seed))
    shape = (-1, draws)
    found = {name: table[name].reshape(shape)[:, 0] for name in ("speed", "mass", *centres)} | centres
    bad = (table["error"].reshape(shape) != "").any(axis=1)
    for name in OF_RUNS:
        values = np.asarray(table[name], dtype=float).reshape(shape)
        for column, part in ((name, 0.5), (f"{name}_low", 0.5 - 0.5 * LEVEL), (f"{name}_high", 0.5 + 0.5 * LEVEL)):
            found[column] = np.where(bad, np.nan, np.quantile(values, part, axis=1))
            units[column] = units[name]
    for name in ("error", "warning"):
        texts = table[name].reshape(shape)
        found[name] = np.array([next((it for it in row if it), "") for row in texts], dtype=object)
    return found, {name: units[name] for name in found}
