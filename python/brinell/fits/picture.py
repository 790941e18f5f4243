"""The picture of a fit: measurement and laws above, differences below."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..pictures import logarithmic, save
from .measured import UNITS

if TYPE_CHECKING:
    from .result import Fit

SCALES = {"depth": (1e6, "µm"), "dent_depth": (1e6, "µm"), "dent_diameter": (1e3, "mm"),
          "contact_time": (1e6, "µs"), "flow_stress": (1e-6, "MPa")}  # fmt: skip


def draw(fit: Fit, path: str | Path | None) -> Any:
    """The figure of a fit; it is also written to `path`."""
    from matplotlib.figure import Figure

    results = list(fit.rms)
    figure = Figure(figsize=(max(5.0, 4.2 * len(results)), 5.0), layout="constrained")
    axes = figure.subplots(2, len(results), sharex="col", height_ratios=(3, 1), squeeze=False)
    if fit.kind == "hardness":
        fit.points["reading"] = np.arange(1.0, fit.count + 1.0)
    argument = "reading" if fit.kind == "hardness" else fit.argument
    scale, unit = _scale(argument)
    at = scale * fit.points[argument]
    for (above, below), result in zip(axes.T, results, strict=True):
        size, own = _scale(result)
        for name, style in (("scene", "--"), ("fitted", "-")):
            if name == "fitted" or "zero_point" not in str(fit.values):
                above.plot(at, size * fit.points[f"{result}, {name}"], style, label=f"law, {name}")
        found, expected = (size * fit.points[f"{result}, {it}"] for it in ("measured", "fitted"))
        marker = 4 if len(at) < 100 else 1.5
        above.plot(at, found, "ok", markersize=marker, label="measured")
        below.plot(at, found - expected, "ok", markersize=marker)
        below.axhline(0.0, color="C1", linewidth=1.0)
        above.set(ylabel=_label(result, own))
        below.set(xlabel=_label(argument, unit), ylabel="difference")
        if argument == "speed" and at.max() >= 10.0 * at.min():
            logarithmic(above, "x")
        for one in (above, below):
            one.grid(alpha=0.3)
        above.legend(fontsize="small")
    if path is not None:
        save(figure, path)
    return figure


def _scale(name: str) -> tuple[float, str]:
    return SCALES.get(name, (1.0, UNITS.get(name, "")))


def _label(name: str, unit: str) -> str:
    words = name.replace("_", " ")
    return f"{words} [{unit}]" if unit else words
