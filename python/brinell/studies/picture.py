"""A picture of a study: maps over two parameters, curves over one, dots over each of several."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from matplotlib.figure import Figure

from .impacts import Table

SHOWN = (("restitution", "restitution", 1.0), ("dent", "dent [µm]", 1e6))
UNITS = {"speed": "m/s", "mass": "kg", "radius": "m", "strength": "Pa", "modulus": "Pa"}


def draw(path: Path, table: Table, names: Sequence[str]) -> None:
    """Draw the results over the varied parameters `names`; the extension of `path` selects the
    format."""
    width = len(names) if len(names) > 2 else 1
    figure = Figure(figsize=(4.2 * max(width, 2) if width > 1 else 9.0, 3.8 * (1 + (width > 1))))
    figure.set_layout_engine("constrained")
    for index, (result, label, factor) in enumerate(SHOWN):
        values = factor * table[result]
        if len(names) == 2:
            axes = figure.add_subplot(1, 2, index + 1)
            _map(figure, axes, table, names, values, label)
        elif len(names) == 1:
            axes = figure.add_subplot(1, 2, index + 1)
            order = np.argsort(table[names[0]])
            axes.plot(table[names[0]][order], values[order])
            _axes(axes, table, names[0], label)
        else:
            for column, name in enumerate(names):
                axes = figure.add_subplot(2, width, index * width + column + 1)
                axes.plot(table[name], values, ".", markersize=2)
                _axes(axes, table, name, label)
    with matplotlib.rc_context({"svg.hashsalt": "brinell"}):
        metadata = {"Date": None} if path.suffix == ".svg" else {}
        figure.savefig(path, metadata=metadata)


def _map(
    figure: Figure, axes: Any, table: Table, names: Sequence[str], values: Any, label: str
) -> None:
    x, y = (table[name] for name in names)
    columns, rows = np.unique(x), np.unique(y)
    if len(columns) * len(rows) == len(values):
        order = np.lexsort((x, y))
        grid = values[order].reshape(len(rows), len(columns))
        drawn = axes.pcolormesh(columns, rows, grid, shading="nearest", rasterized=True)
    else:
        drawn = axes.scatter(x, y, c=values, s=6)
    figure.colorbar(drawn, ax=axes, label=label)
    _axes(axes, table, names[0], "")
    _axes(axes.yaxis.axes, table, names[1], "", vertical=True)


def _axes(axes: Any, table: Table, name: str, label: str, *, vertical: bool = False) -> None:
    """Label an axis, and make it logarithmic if the values are spread logarithmically."""
    values = np.unique(table[name])
    unit = UNITS.get(name.replace(".", "_").rsplit("_", 1)[-1])
    text = f"{name} [{unit}]" if unit else name
    middle = values[len(values) // 2]
    # in a logarithmic range, the middle value is nearer to the geometric than to the other mean
    spread = values[0] > 0.0 and middle < 0.75 * 0.5 * (values[0] + values[-1])
    if vertical:
        axes.set(ylabel=text, yscale="log" if spread else "linear")
        return
    axes.set(xlabel=text, xscale="log" if spread else "linear")
    if label:
        axes.set(ylabel=label)
        axes.grid(alpha=0.3)
