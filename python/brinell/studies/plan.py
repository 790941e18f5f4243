"""The runs of a study: a grid, or samples."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import ProgramError
from ..program import in_si

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Range:
    """Values of one parameter, from `first` to `last`."""

    first: float
    last: float
    count: int = 20
    """Number of values in a grid; ignored for samples."""
    logarithmic: bool | None = None
    """Whether the values are spaced by equal ratios; if not given, over a decade and more. That is
    the rule of `brinell predict --sweep`, too."""

    def __post_init__(self) -> None:
        if not np.isfinite([self.first, self.last]).all():
            raise ValueError(f"{self.first}:{self.last}: the ends of a range must be finite")
        if self.count < 1:
            raise ValueError(f"{self.count} values: a range needs at least one")
        above_zero = self.first > 0.0 and self.last > 0.0
        if self.logarithmic and not above_zero:
            raise ValueError(f"{self.first}:{self.last}: a logarithmic range must be above zero")
        if self.logarithmic is None:
            small, large = sorted((self.first, self.last))
            object.__setattr__(self, "logarithmic", above_zero and large >= 10.0 * small)

    def at(self, parts: Array) -> Array:
        """The values at these fractions of the range, from 0 to 1."""
        if self.logarithmic:
            # the ends are those that were given, to the last bit
            inner = np.exp(np.log(self.first) + parts * np.log(self.last / self.first))
        else:
            inner = self.first + parts * (self.last - self.first)
        return np.where(parts == 0.0, self.first, np.where(parts == 1.0, self.last, inner))

    def values(self) -> Array:
        """The values of a grid."""
        return self.at(np.linspace(0.0, 1.0, self.count))


Varied = Range | Sequence[float | str] | Array | str


def read(text: str, name: str) -> Range | Array:
    """Parse `FROM:TO`, `FROM:TO:COUNT`, `FROM:TO:COUNTlog`, `FROM:TO:log`, the same with `lin`, or
    comma-separated values of the quantity `name`, in SI units or with a unit."""
    try:
        if ":" not in text:
            return np.array([in_si(name, part) for part in text.split(",")])
        first, last, *rest = text.split(":")
        match = re.fullmatch(r"(\d*)(log|lin)?", rest[0] if rest else "")
        if len(rest) > 1 or match is None:
            raise ValueError
        count = int(match[1]) if match[1] else Range.count
        ends = in_si(name, first), in_si(name, last)
    except (ValueError, ProgramError) as error:
        why = f" ({error})" if isinstance(error, ProgramError) else ""
        raise ValueError(
            f"{name} = {text!r} is not a range{why}: allowed are FROM:TO:COUNT, FROM:TO:COUNTlog, "
            "FROM:TO:COUNTlin and comma-separated values"
        ) from None
    return Range(*ends, count, {"log": True, "lin": False}.get(match[2] or ""))


def runs(vary: Mapping[str, Varied], sample: str = "grid", seed: int = 0) -> dict[str, Array]:
    """The values of each parameter in all runs.

    `sample` is "grid", "sobol:COUNT" or "lhs:COUNT" (Latin hypercube); these take ranges only.
    """
    if not vary:
        raise ValueError("nothing is varied; for example, vary={'speed': '0.1:10:50log'}")
    given = {name: read(value, name) if isinstance(value, str) else value for name, value in vary.items()}
    if sample == "grid":
        axes = [axis(name, value) for name, value in given.items()]
        grids = np.meshgrid(*axes, indexing="ij")
        return {name: grid.ravel() for name, grid in zip(given, grids, strict=True)}
    match = re.fullmatch(r"(sobol|lhs):([1-9]\d*)", sample)
    if match is None:
        raise ValueError(f"sample = {sample!r}; allowed are grid, sobol:COUNT and lhs:COUNT")
    for name, value in given.items():
        if not isinstance(value, Range):
            raise TypeError(f"{name}: samples need a range, not single values")
    places = _places(match[1], int(match[2]), len(given), seed)
    return {
        name: value.at(column)
        for (name, value), column in zip(given.items(), places.T, strict=True)
        if isinstance(value, Range)
    }


def axis(name: str, value: Range | Sequence[float | str] | Array) -> Array:
    """The values of the quantity `name` in a grid, in SI units."""
    if isinstance(value, Range):
        return value.values()
    if any(isinstance(one, str) for one in value):
        value = [in_si(name, one) for one in value]
    values = np.asarray(value, dtype=float)
    if values.ndim != 1 or not len(values) or not np.isfinite(values).all():
        raise ValueError(f"{name} = {value!r}: a list of finite numbers is needed")
    return values


def _places(kind: str, count: int, dimensions: int, seed: int) -> Array:
    """Points in the unit cube."""
    import warnings

    from scipy.stats import qmc

    if kind == "lhs":
        return np.asarray(qmc.LatinHypercube(dimensions, rng=seed).random(count))
    with warnings.catch_warnings():
        # a count that is not a power of two is less balanced, which is the caller's choice
        warnings.simplefilter("ignore", UserWarning)
        return np.asarray(qmc.Sobol(dimensions, rng=seed).random(count))
