"""Pictures of results: maps over two quantities, curves over one, dots over each of several."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..errors import nearest
from ..pictures import logarithmic, save

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure

Table = Mapping[str, Any]
"""Columns by name."""

RESULTS = ("restitution", "dent")


def draw(
    path: str | Path, table: pandas.DataFrame | Table, names: Sequence[str], results: Sequence[str] = RESULTS
) -> None:
    """Draw `results` over the varied quantities `names`, all of them columns of the table of
    `study` or `sweep`; the extension of `path` selects the format.

    One name gives curves, two give a map, more give dots over each. Over one name, a table with
    several laws gives a curve of each. Labels have the units of `attrs["units"]`.
    """
    from matplotlib.figure import Figure

    path, tables = Path(path), _by_law(table)
    _check(tables, names, results)
    units = getattr(table, "attrs", {}).get("units", {})
    ((_, first), *others) = tables.items()
    # several names: a row of each result, and a column of each name
    rows, columns = (len(results), len(names)) if len(names) > 2 else (1, len(results))
    figure = Figure(figsize=(max(4.2 * columns, 4.5), 3.8 * rows))
    figure.set_layout_engine("constrained")
    for index, result in enumerate(results):
        if len(names) == 2:
            place = figure.add_subplot(rows, columns, index + 1)
            _map(figure, place, first, names, result, units)
            continue
        for column, name in enumerate(names):
            axes = figure.add_subplot(rows, columns, index * len(names) + column + 1)
            for law, one in tables.items():
                order = np.argsort(one[name])
                style = "." if len(names) > 1 else "-"
                values = _values(one, result)[order]
                axes.plot(one[name][order], values, style, markersize=2, label=law)
                if len(names) == 1 and f"{result}_low" in one:
                    low, high = (_values(one, f"{result}_{end}") for end in ("low", "high"))
                    axes.fill_between(one[name][order], low[order], high[order], alpha=0.3)
            _axes(axes, first, name, units, _label(result, units))
            if others and index == 0:
                axes.legend(fontsize="small")
    save(figure, path)


def _by_law(table: pandas.DataFrame | Table) -> dict[str, dict[str, NDArray[Any]]]:
    """The columns of each law; of the only one if the table does not tell laws apart."""
    columns = {name: np.asarray(table[name]) for name in map(str, table)}
    if "law" not in columns:
        return {"": columns}
    laws = columns.pop("law")
    every = {law: laws == law for law in dict.fromkeys(laws.tolist())}
    return {law: {name: column[rows] for name, column in columns.items()} for law, rows in every.items()}


def _check(tables: Mapping[str, Table], names: Sequence[str], results: Sequence[str]) -> None:
    for table in tables.values():
        for name in (*names, *results):
            if name not in table:
                near = nearest(name, table)
                raise ValueError(f"{name!r} is no column{near}; allowed are {', '.join(table)}")
            if not np.issubdtype(table[name].dtype, np.number) and table[name].dtype != bool:
                raise ValueError(f"the column {name!r} has texts; a picture shows numbers")
    if not names or not results:
        raise ValueError("a picture needs at least one name and one result")
    if len(names) > 1 and len(tables) > 1:
        raise ValueError(f"over {len(names)} quantities, a picture shows one law: {list(tables)}")


def _label(name: str, units: Mapping[str, str]) -> str:
    """The name with its unit."""
    unit = "µm" if name == "dent" else units.get(name)
    return f"{name} [{unit}]" if unit else name


def _values(table: Table, name: str) -> NDArray[Any]:
    return np.asarray((1e6 if name.startswith("dent") else 1.0) * table[name])


def _map(figure: Figure, axes: Any, table: Table, names: Sequence[str], result: str, units: Mapping[str, str]) -> None:
    x, y = (table[name] for name in names)
    values = _values(table, result)
    columns, rows = np.unique(x), np.unique(y)
    if len(columns) * len(rows) == len(values):
        order = np.lexsort((x, y))
        grid = values[order].reshape(len(rows), len(columns))
        drawn = axes.pcolormesh(columns, rows, grid, shading="nearest", rasterized=True)
    else:
        drawn = axes.scatter(x, y, c=values, s=6)
    figure.colorbar(drawn, ax=axes, label=_label(result, units))
    _axes(axes, table, names[0], units, "")
    _axes(axes, table, names[1], units, "", vertical=True)


def _axes(axes: Any, table: Table, name: str, units: Mapping[str, str], label: str, *, vertical: bool = False) -> None:
    """Label an axis, and make it logarithmic if the values are spread logarithmically."""
    values = np.unique(table[name])
    middle = values[len(values) // 2]
    # in a logarithmic range, the middle value is nearer to the geometric than to the other mean
    spread = values[0] > 0.0 and middle < 0.75 * 0.5 * (values[0] + values[-1])
    if spread:
        logarithmic(axes, "y" if vertical else "x")
    if vertical:
        axes.set(ylabel=_label(name, units))
        return
    axes.set(xlabel=_label(name, units))
    if label:
        axes.set(ylabel=label)
        axes.grid(alpha=0.3)
