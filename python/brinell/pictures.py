"""What pictures of fits and of studies share: logarithmic axes with ticks that have room, and their files."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable
from pathlib import Path
from typing import Any

# The least distance of ticks, as part of their axis.
ROOM = {"x": 1 / 7, "y": 1 / 10}


def logarithmic(axes: Any, which: str) -> None:
    """Make the axis `which`, "x" or "y", of what is drawn logarithmic."""
    from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

    axes.set(**{f"{which}scale": "log"})
    axis = getattr(axes, f"{which}axis")
    low, high = getattr(axes, f"get_{which}lim")()
    axis.set_major_locator(FixedLocator(ticks(low, high, ROOM[which])))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))


def ticks(low: float, high: float, room: float) -> list[float]:
    """Ticks of a logarithmic axis, no two nearer than the part `room` of it: powers of ten if three
    of them fit, else as many round numbers as there is room for."""
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    least = (high / low) ** room

    def inside(found: Iterable[str]) -> list[float]:
        return [tick for tick in map(float, found) if low <= tick <= high]

    def fits(found: list[float]) -> bool:
        return all(after >= least * before for before, after in itertools.pairwise(found))

    powers = (
        inside(f"1e{power}" for power in decades if power % stride == 0)
        for stride in itertools.count(1)
    )
    tens = next(filter(fits, powers))
    if len(tens) >= 3:
        return tens
    tries = [tens] + [
        inside(f"{digit}e{power}" for power in decades for digit in digits)
        for digits in ("13", "125")
    ]
    for power, digit in itertools.product(reversed(decades), (5, 2, 1)):
        step = float(f"{digit}e{power - 1}")
        counts = range(math.ceil(low / step), min(99, math.floor(high / step)) + 1)
        tries.append(inside(f"{count * digit}e{power - 1}" for count in counts))
    return max(filter(fits, tries), key=len)


def save(figure: Any, path: str | Path) -> None:
    """Write a figure, with the same bytes each time."""
    import matplotlib

    with matplotlib.rc_context({"svg.hashsalt": "brinell"}):
        figure.savefig(path, metadata={"Date": None} if Path(path).suffix == ".svg" else {})
