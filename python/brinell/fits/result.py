"""The result of a fit."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .measured import KINDS, Kind

Columns = dict[str, NDArray[np.float64]]

SI = {"speed": "m/s", "restitution": "", "depth": "m", "force": "N"}
PREFIXES = {-15: "f", -12: "p", -9: "n", -6: "u", -3: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}


@dataclass(frozen=True)
class Estimate:
    """A fitted parameter, in its SI unit."""

    name: str
    """Its name in the scene."""
    unit: str
    scene: float
    """The scene's value."""
    value: float
    interval: tuple[float, float] | None
    """95 % confidence interval, if the measurement gives one."""
    doubt: str | None
    """The reason why the measurement does not determine the parameter."""

    def __str__(self) -> str:
        words = f"{self.name}: {quantity(self.value, self.unit)}"
        if self.interval:
            low, high = (quantity(it, self.unit) for it in self.interval)
            words += f", with 95 % confidence {low} to {high}"
        if self.doubt:
            words += f" ({self.doubt})"
        return f"{words}; in the scene {quantity(self.scene, self.unit)}."


@dataclass(frozen=True)
class Fit:
    """The parameters that explain a measurement; `print` tells all but the points."""

    kind: Kind
    """What was measured: "restitution" over speed, or "force" over depth."""
    estimates: tuple[Estimate, ...]
    count: int
    """Number of points that were fitted."""
    left_out: int
    """Number of points besides, which belong to no first loading."""
    rms: float
    """Root mean square of the differences that remain, in the unit of the measurement."""
    rms_of_scene: float
    """The same with the scene's values."""
    notes: tuple[str, ...]
    """Remarks on the quality of the fit."""
    points: Columns = field(repr=False)
    """The points in SI units: "speed" and "restitution", or "depth" and "force", and the values by
    the "scene" and with the "fitted" parameters."""
    curves: Columns = field(repr=False)
    """The same over the range of the measurement; NaN beyond the range of the law."""

    @property
    def values(self) -> dict[str, float]:
        """The fitted values in SI units, by their names in the scene."""
        return {estimate.name: estimate.value for estimate in self.estimates}

    def __str__(self) -> str:
        unit = SI[KINDS[self.kind][1]]
        rms = (
            f"{self.count} measured points. Root-mean-square difference of the scene's law: "
            f"{quantity(self.rms_of_scene, unit)}; with the fitted value: "
            f"{quantity(self.rms, unit)}."
        )
        return "\n".join([rms, *map(str, self.estimates), *self.notes])

    def plot(self, axes: Any = None) -> Any:
        """Draw the measurement, the scene's law and the fitted one with matplotlib, in `axes` or a
        new figure; return the axes."""
        if axes is None:
            from matplotlib import pyplot

            axes = pyplot.figure(layout="constrained").add_subplot()
        at, value = KINDS[self.kind]
        scale, prefix = (1e6, "u") if at == "depth" else (1.0, "")
        for name, style in (("scene", "--"), ("fitted", "-")):
            axes.plot(scale * self.curves[at], self.curves[name], style, label=f"law, {name}")
        axes.plot(scale * self.points[at], self.points[value], "o", markersize=4, label="measured")
        unit = f" [{SI[value]}]" if SI[value] else ""
        axes.set(xlabel=f"{at} [{prefix}{SI[at]}]", ylabel=value + unit)
        steps = np.diff(self.curves[at])
        if not math.isclose(steps[0], steps[-1], rel_tol=1e-6):
            axes.set(xscale="log")
        axes.grid(alpha=0.3)
        axes.legend()
        return axes


def quantity(value: float, unit: str) -> str:
    """A number with four significant digits, and its unit with a prefix: `294.3 MPa`."""
    rounded = float(f"{value:.3e}")
    power = 0
    if unit in ("m", "m/s", "N", "Pa") and rounded != 0.0 and math.isfinite(rounded):
        power = 3 * (math.floor(math.log10(abs(rounded))) // 3)
        power = max(-15, min(power, 12 if unit in ("N", "Pa") else 0))
    number = float(f"{value / 10.0**power:.3e}")
    plain = number == 0.0 or 1e-3 <= abs(number) < 1e6
    return f"{number:{'.12g' if plain else 'g'}} {PREFIXES[power]}{unit}".rstrip()
