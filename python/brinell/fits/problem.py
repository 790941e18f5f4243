"""The differences between a law and a measurement, and their least squares."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .law import OBLIQUE, Law
from .measured import Measured
from .near import Near, Numbers
from .parameters import parameter

STRENGTHS = np.geomspace(1e-6, 0.5, 31)
"""Yield strengths that the search may start at, relative to the effective modulus: the restitution
of some laws is not monotone."""
COMPLIANCES = (0.0, 0.15, 0.5)
"""Compliances that the search may start at, relative to depth over force of the whole record."""
MOST_FOR_START = 40
"""Number of points that a search for a start takes."""
AT_BOUND = 1e-9
"""Distance from a bound, in the variables of the search, that is rounding."""
EXACT, STEPPED = (float(np.cbrt(np.finfo(float).eps)), 1e-10), (1e-3, 1e-6)
"""Distance of the neighbours by which derivatives are taken, relative to a variable above 1, and relative change
at which the search ends: where impacts are predicted to rounding, and for oblique ones, which are moved in steps."""
ROUNDS = 12
"""Most rounds of weights for several kinds of results."""
BEYOND = "the law of the scene can't be evaluated for all points of the measurement"


@dataclass
class Problem:
    """Variables are logarithms of parameters that span orders of magnitude, otherwise parameters in
    units of their sizes; differences are in units of `sizes`."""

    law: Law
    points: Measured
    names: Sequence[str]
    fixed: Mapping[str, float] = field(default_factory=dict)
    bounds: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    priors: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    accuracy: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.step, self.tolerance = STEPPED if OBLIQUE & {*self.points.results} else EXACT
        self.given = {**self.law.given, **self.fixed}
        ones = [parameter(name, self.law.model) for name in self.names]
        self.logarithmic = np.array([one.is_logarithmic for one in ones])
        scale = {"hardening_modulus": self.law.modulus}
        if self.points.kind == "record":
            depth = float(np.max(np.abs(self.points.arguments["depth"])))
            force = float(np.max(self.points.arguments["force"]))
            scale |= {"zero_point": depth, "preload": force, "compliance": depth / force}
        self.scales = np.array([scale.get(name, 1.0) for name in self.names])
        ends = [self.bounds.get(it, (-np.inf, np.inf)) for it in self.names]
        low = [max(one.low, it[0]) for one, it in zip(ones, ends, strict=True)]
        high = [min(one.high, it[1]) for one, it in zip(ones, ends, strict=True)]
        # those of a scene are far away, unless the user gives them
        far = self.logarithmic & np.array([it not in self.bounds for it in self.names])
        self.low = np.where(far, -np.inf, self.variables(low))
        self.high = np.where(np.array(high) >= 1e18, np.inf, self.variables(high))
        self.ends = np.array(low), np.array(high)
        self.known = {name: np.isfinite(it) for name, it in self.points.results.items()}
        self.sizes = {name: self._size(name) for name in self.points.results}

    def _size(self, name: str) -> float:
        if name in self.accuracy:
            return self.accuracy[name]
        values = self.points.results[name][self.known[name]]
        return 1.0 if name.endswith("restitution") else float(np.max(np.abs(values), initial=0.0))

    # variables

    def variables(self, values: Sequence[float]) -> Numbers:
        with np.errstate(divide="ignore", invalid="ignore"):
            given = np.array(values, dtype=float)
            return np.asarray(np.where(self.logarithmic, np.log(given), given / self.scales))

    def values(self, variables: Numbers) -> Numbers:
        with np.errstate(over="ignore"):
            found = np.where(self.logarithmic, np.exp(variables), variables * self.scales)
        # a bound is what the user gave, to the last bit
        found = np.where(variables == self.low, self.ends[0], found)
        return np.asarray(np.where(variables == self.high, self.ends[1], found))

    def flow(self, variables: Numbers) -> dict[str, float]:
        values = [float(it) for it in self.values(variables)]
        return self.given | dict(zip(self.names, values, strict=True))

    # differences

    def of(self, flow: Mapping[str, float]) -> dict[str, Numbers]:
        """The law's values minus the measured ones, for each kind of result, in SI units."""
        values = self.law.values(self.points, [flow])
        return {name: values[name][0] - it for name, it in self.points.results.items()}

    def differences(self, flows: Sequence[Mapping[str, float]]) -> Numbers:
        """All differences in units of their sizes, and those from priors: a row for each of the `flows`."""
        values = self.law.values(self.points, flows)
        parts = [
            (values[name] - it)[:, self.known[name]] / self.sizes[name] for name, it in self.points.results.items()
        ]
        far = [[(flow[it] - mean) / sd for it, (mean, sd) in self.priors.items()] for flow in flows]
        return np.hstack([*parts, np.reshape(far, (len(flows), -1))])

    def linear(self, at: Numbers) -> tuple[Numbers, Numbers]:
        """The differences at these variables, and their derivatives: of the parabola through the values here and at
        two neighbours within the bounds, all from one table."""
        size = self.step * np.maximum(1.0, np.abs(at))
        one = np.where(at - size < self.low, 2.0 * size, -size)
        other = np.where(at + size > self.high, -2.0 * size, size)
        steps = np.vstack([0.0 * at, np.diag(one), np.diag(other)])
        left = self.differences([self.flow(at + step) for step in steps])
        here, before, after = left[0], left[1 : 1 + len(at)].T, left[1 + len(at) :].T
        slope = (before - here[:, None]) * other / one - (after - here[:, None]) * one / other
        return here, slope / (other - one)

    def groups(self) -> list[NDArray[np.int_]]:
        """The places of each kind of result in the differences."""
        ends = np.cumsum([0, *(np.count_nonzero(it) for it in self.known.values())])
        return [np.arange(a, b) for a, b in pairwise(ends.tolist())]

    # optimum

    def starts(self) -> list[Numbers]:
        """The best start for each of some compliances, by a part of the points: of the scene's values and of
        other strengths, with the zero point that belongs to them."""
        own = self.variables([self.given[it] for it in self.names])
        place = {name: index for index, name in enumerate(self.names)}
        loading = np.flatnonzero(self.points.part == 0)
        some = np.ones(self.points.count, dtype=bool)
        some[loading[:: -(-len(loading) // MOST_FOR_START)]] = False
        few = self.points if self.points.kind == "hardness" else self.points.without(some)
        only = replace(self, points=few)
        only.sizes = self.sizes

        found = []
        for part in COMPLIANCES if "compliance" in place else (0.0,):
            group = [own.copy()]
            for strength in STRENGTHS * self.law.modulus if "yield_strength" in place else ():
                group.append(own.copy())
                group[-1][place["yield_strength"]] = np.log(strength)
            for start in group:
                if part > 0.0:
                    start[place["compliance"]] = part
                if "zero_point" in place:
                    start[place["zero_point"]] = self._zero(start) / self.scales[place["zero_point"]]
            group = [np.clip(it, self.low, self.high) for it in group]
            squares = np.sum(only.differences([self.flow(it) for it in group]) ** 2, axis=1)
            found.append(group[int(np.argmin(np.where(np.isfinite(squares), squares, np.inf)))])
        return found

    def _zero(self, start: Numbers) -> float:
        """The zero point [m] with which a first loading has the recorded forces, in the median."""
        flow, loading = self.flow(start), self.points.part == 0
        force = self.points.arguments["force"][loading] + flow["preload"]
        deep = self.law.depths(force, flow) + flow["compliance"] * force
        return float(np.median(deep - self.points.arguments["depth"][loading]))

    def solve(self, start: Numbers | None = None) -> Any:
        """The optimum within the bounds, by scipy: roughly from each start, then exactly from the best."""
        try:
            rough = [self._least(1e-6, it) for it in (self.starts() if start is None else [start])]
            best = min(rough, key=lambda it: float(it.cost))
            found = self._least(self.tolerance, self._snapped(best.x))
        except (ValueError, np.linalg.LinAlgError) as error:
            # derivatives at the end of the law's range
            raise ValueError(BEYOND) from error
        found.x = self._snapped(found.x)
        return found

    def _least(self, tolerance: float, start: Numbers) -> Any:
        from scipy.optimize import least_squares

        # derivatives are those at the last variables
        linear = lru_cache(1)(lambda *variables: self.linear(np.array(variables)))
        return least_squares(
            lambda it: linear(*it)[0],
            start,
            jac=lambda it: linear(*it)[1],
            bounds=(self.low, self.high),
            method="dogbox",
            x_scale="jac",
            xtol=tolerance,
            ftol=tolerance,
            gtol=1e-14,
        )

    def _snapped(self, variables: Numbers) -> Numbers:
        """The variables, at a bound where rounding keeps them from it."""
        low = np.where(variables - self.low < AT_BOUND, self.low, variables)
        return np.asarray(np.where(self.high - low < AT_BOUND, self.high, low))

    def weighted(self) -> Any:
        """The optimum, with each kind of result weighted by the scatter that is left of it.

        One kind without a prior needs no weight. The rounds end as the sizes do not change.
        """
        found = self.solve()
        free = [name for name in self.sizes if name not in self.accuracy]
        if len(self.sizes) == 1 and not self.priors:
            return found
        for _ in range(ROUNDS if free else 0):
            total = sum(map(len, self.groups()))
            left = self.of(self.flow(found.x))
            before = dict(self.sizes)
            for name in free:
                one = left[name][self.known[name]]
                part = max(len(one) * (1.0 - len(self.names) / max(total, 1)), 0.5)
                size = float(np.sqrt(np.sum(one**2) / part))
                self.sizes[name] = max(size, 1e-9 * self._size(name))
            if all(abs(self.sizes[it] / before[it] - 1.0) < 1e-4 for it in free):
                break
            found = self.solve(found.x)
        return found

    def near(self, found: Any) -> Near:
        """The neighbourhood of an optimum."""
        left, jacobian = np.asarray(found.fun), np.asarray(found.jac)
        # at its bound, and held there: a parameter without effect may have started there
        side = np.where(found.x == self.low, -1, np.where(found.x == self.high, 1, 0))
        self.bound = np.where(side * (jacobian.T @ left) < 0.0, side, 0)
        free = self.bound == 0
        # points that repeat others to the last digit don't tell how much a measurement scatters
        enough = self.points.different + len(self.priors) > np.count_nonzero(free)
        freedom = len(left) - int(np.count_nonzero(free)) if enough else 0
        return Near(found.x, self.low, self.high, jacobian, left, free, freedom)
