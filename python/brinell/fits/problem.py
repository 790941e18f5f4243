"""The differences between a law and a measurement, and their least squares."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import intervals
from .intervals import Linear, Numbers
from .law import LARGEST_RADIUS_RATIO, Law
from .measured import UNITS, Measured
from .parameters import parameter
from .result import Estimate, Fit, quantity

NO_EFFECT = 1e-9
"""A parameter on which no point depends more than this is not determined."""
SAME = 0.999
"""A correlation of two parameters of which only a combination is determined."""
ALIKE = 0.95
"""A correlation of two parameters that can hardly be told apart."""
TREND = 1.0
"""Durbin and Watson's number below which differences follow a trend; independent ones have 2."""
FEWEST_FOR_TREND = 8
"""Fewest points for that number."""
ROUNDING = 1e-14
"""A sum of squares that is rounding."""
STRENGTHS = np.geomspace(1e-6, 0.5, 61)
"""Yield strengths that the search may start at, relative to the effective modulus: the restitution
of some laws is not monotone."""
COMPLIANCES = (0.0, 0.15, 0.5)
"""Compliances that the search may start at, relative to depth over force of the whole record."""
MOST_FOR_START = 40
"""Number of points that a search for a start takes."""
TOLERANCE = 1e-10
"""Relative change at which the search ends."""
FEWEST_FOR_BOOTSTRAP = 8
"""Fewest degrees of freedom of a bootstrap: of fewer differences, draws repeat each other."""
AT_BOUND = 1e-9
"""Distance from a bound, in the variables of the search, that is rounding."""
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
        self.given = {**self.law.given, **self.fixed}
        ones = [parameter(name, self.law.model) for name in self.names]
        self.logarithmic = np.array([one.is_logarithmic for one in ones])
        scale = {"hardening_modulus": self.law.modulus}
        if self.points.kind == "record":
            depth = float(np.max(np.abs(self.points.arguments["depth"])))
            force = float(np.max(self.points.arguments["force"]))
            scale |= {"zero_point": depth, "preload": force, "compliance": depth / force}
        self.scales = np.array([scale.get(name, 1.0) for name in self.names])
        low = [
            max(one.low, self.bounds.get(it, (-np.inf,))[0])
            for it, one in zip(self.names, ones, strict=True)
        ]
        high = [
            min(one.high, self.bounds.get(it, (0.0, np.inf))[1])
            for it, one in zip(self.names, ones, strict=True)
        ]
        # those of a scene are far away, unless the user gives them
        self.low = np.where(
            self.logarithmic & (np.array([it not in self.bounds for it in self.names])),
            -np.inf,
            self.variables(low),
        )
        self.high = np.where(np.array(high) >= 1e18, np.inf, self.variables(high))
        self.ends = np.array(low), np.array(high)
        self.known = {name: np.isfinite(it) for name, it in self.points.results.items()}
        self.sizes = {name: self._size(name) for name in self.points.results}

    def _size(self, name: str) -> float:
        if name in self.accuracy:
            return self.accuracy[name]
        values = self.points.results[name][self.known[name]]
        return 1.0 if name.endswith("restitution") else float(np.max(np.abs(values)))

    # variables

    def variables(self, values: Sequence[float]) -> Numbers:
        with np.errstate(divide="ignore", invalid="ignore"):
            given = np.array(values, dtype=float)
            found: Numbers = np.where(self.logarithmic, np.log(given), given / self.scales)
        return found

    def values(self, variables: Numbers) -> Numbers:
        with np.errstate(over="ignore"):
            found = np.where(self.logarithmic, np.exp(variables), variables * self.scales)
        # a bound is what the user gave, to the last bit
        found = np.where(variables == self.low, self.ends[0], found)
        values: Numbers = np.where(variables == self.high, self.ends[1], found)
        return values

    def flow(self, variables: Numbers) -> dict[str, float]:
        values = [float(it) for it in self.values(variables)]
        return self.given | dict(zip(self.names, values, strict=True))

    # differences

    def of(self, flow: Mapping[str, float], points: Measured | None = None) -> dict[str, Numbers]:
        """The law's values minus the measured ones, for each kind of result, in SI units."""
        points = points or self.points
        values = self.law.values(points, flow)
        return {name: values[name] - it for name, it in points.results.items()}

    def differences(self, flow: Mapping[str, float]) -> Numbers:
        """All differences in units of their sizes, and those from priors."""
        found = self.of(flow)
        parts = [found[name][self.known[name]] / self.sizes[name] for name in found]
        parts.append(np.array([(flow[it] - mean) / sd for it, (mean, sd) in self.priors.items()]))
        return np.concatenate(parts)

    def groups(self) -> list[NDArray[np.int_]]:
        """The places of each kind of result in the differences."""
        ends = np.cumsum([0, *(np.count_nonzero(it) for it in self.known.values())])
        return [np.arange(a, b) for a, b in pairwise(ends.tolist())]

    @property
    def freedom(self) -> int:
        """Number of differences less that of all parameters."""
        return sum(map(len, self.groups())) + len(self.priors) - len(self.names)

    # optimum

    def starts(self) -> list[list[Numbers]]:
        """Groups of starts: the scene's values and other strengths, for each of some compliances, with
        the zero point that belongs to them."""
        own = np.clip(self.variables([self.given[it] for it in self.names]), self.low, self.high)
        place = {name: index for index, name in enumerate(self.names)}
        groups = []
        for part in COMPLIANCES if "compliance" in place else (0.0,):
            group = [own.copy()]
            if "yield_strength" in place:
                for strength in STRENGTHS * self.law.modulus:
                    group.append(own.copy())
                    group[-1][place["yield_strength"]] = np.log(strength)
            for start in group:
                if part > 0.0:
                    start[place["compliance"]] = part
                if "zero_point" in place:
                    start[place["zero_point"]] = (
                        self._zero(start) / self.scales[place["zero_point"]]
                    )
            groups.append([np.clip(it, self.low, self.high) for it in group])
        return groups

    def _zero(self, start: Numbers) -> float:
        """The zero point [m] with which a first loading has the recorded forces, in the median."""
        flow, loading = self.flow(start), self.points.part == 0
        force = self.points.arguments["force"][loading] + flow["preload"]
        deep = self.law.depths(force, flow) + flow["compliance"] * force
        return float(np.median(deep - self.points.arguments["depth"][loading]))

    def start(self) -> list[Numbers]:
        """The best start of each group, by a part of the points."""
        loading = np.flatnonzero(self.points.part == 0)
        step = -(-len(loading) // MOST_FOR_START)
        some = np.ones(self.points.count, dtype=bool)
        some[loading[::step]] = False
        few = self.points if self.points.kind == "hardness" else self.points.without(some)

        def squares(start: Numbers) -> float:
            found = self.of(self.flow(start), few)
            sum_ = sum(float(np.nansum((it / self.sizes[name]) ** 2)) for name, it in found.items())
            bad = any(
                np.any(np.isnan(it) & np.isfinite(few.results[name])) for name, it in found.items()
            )
            return np.inf if bad else sum_

        return [min(group, key=squares) for group in self.starts()]

    def solve(self, start: Numbers | None = None) -> Any:
        """The optimum within the bounds, by scipy: first with derivatives of one side from each start,
        then of both from the best."""
        try:
            rough = [
                self._least("2-point", 1e-6, it)
                for it in (self.start() if start is None else [start])
            ]
            best = min(rough, key=lambda it: float(it.cost))
            found = self._least("3-point", TOLERANCE, self._snapped(best.x))
        except (ValueError, np.linalg.LinAlgError) as error:
            # derivatives at the end of the law's range
            raise ValueError(BEYOND) from error
        found.x = self._snapped(found.x)
        return found

    def _least(self, jac: Any, tolerance: float, start: Numbers) -> Any:
        from scipy.optimize import least_squares

        def differences(variables: Numbers) -> Numbers:
            return self.differences(self.flow(variables))

        return least_squares(
            differences,
            start,
            jac=jac,
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
        found: Numbers = np.where(self.high - low < AT_BOUND, self.high, low)
        return found

    def weighted(self) -> Any:
        """The optimum, with each kind of result weighted by the scatter that is left of it.

        One kind without a prior needs no weight. The rounds end as the sizes do not change.
        """
        found = self.solve()
        settled = {*self.accuracy}
        if len(self.sizes) - len(settled) + len(self.priors) <= 1 and not self.priors:
            return found
        free = [name for name in self.sizes if name not in settled]
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

    def near(self, found: Any) -> Linear:
        """The neighbourhood of an optimum."""
        # at its bound, and held there: a parameter without effect may have started there
        gradient = np.asarray(found.jac).T @ np.asarray(found.fun)
        side = np.where(found.x == self.low, -1, np.where(found.x == self.high, 1, 0))
        self.bound = np.where(side * gradient < 0.0, side, 0)
        free = self.bound == 0
        # points that repeat others to the last digit don't tell how much a measurement scatters
        enough = self.points.different + len(self.priors) > np.count_nonzero(free)
        freedom = len(found.fun) - int(np.count_nonzero(free)) if enough else 0
        return intervals.linear(
            found.x, np.asarray(found.jac), np.asarray(found.fun), free, freedom
        )


def fitted(problem: Problem, *, leave_out: bool, draws: int, seed: int) -> Fit:
    """The result of a fit."""
    _finite(problem)
    found = problem.weighted()
    left_out = 0
    wide = problem.law.outside(problem.points, problem.flow(found.x))
    if leave_out and np.any(wide):
        if np.all(wide):
            raise ValueError("all points are outside the validity of the law")
        left_out = int(np.count_nonzero(wide))
        problem = replace(problem, points=problem.points.without(wide))
        found = problem.weighted()
    flow = problem.flow(found.x)
    near = problem.near(found)
    trend = _trend(problem, flow)
    drawn = _drawn(problem, near, draws, seed, has_trend=trend is not None)
    said = _estimates(problem, near, found, drawn)
    few = near.freedom < FEWEST_FOR_BOOTSTRAP
    notes = [
        f"The bootstrap needs {FEWEST_FOR_BOOTSTRAP} points more than parameters."
        if draws > 0 and few
        else None,
        *_correlations(problem, near, said),
        *_priors(problem, near),
        _parts(problem, flow),
        trend,
        _outside(problem, wide, left_out),
    ]
    scene = problem.of(problem.given)
    left = problem.of(flow)
    values = problem.law.values(problem.points, flow)
    return Fit(
        kind=problem.points.kind,
        law=problem.law.law,
        estimates=tuple(said),
        count=problem.points.count,
        left_out=left_out,
        rms={name: _rms(it) for name, it in left.items()},
        rms_of_scene={name: _rms(it) for name, it in scene.items()},
        squares=float(np.sum(np.asarray(found.fun) ** 2)),
        notes=tuple(note for note in notes if note),
        columns=problem.points.notes,
        argument=problem.points.argument,
        points={**problem.points.arguments, "part": problem.points.part.astype(float)}
        | {f"{name}, measured": it for name, it in problem.points.results.items()}
        | {f"{name}, fitted": it for name, it in values.items()}
        | {f"{name}, scene": it + problem.points.results[name] for name, it in scene.items()},
        curves=_curves(problem, flow),
        data=problem.law.scene,
        body=problem.law.body,
        flow=flow,
        rates=problem.law.rates,
    )


def _finite(problem: Problem) -> None:
    start = problem.given
    if problem.points.kind == "record" and {"zero_point", "preload"} & {*problem.names}:
        return
    if not np.all(np.isfinite(problem.differences(start))):
        raise ValueError(BEYOND)


def _rms(differences: Numbers) -> float:
    return float(np.sqrt(np.nanmean(differences**2)))


def _drawn(
    problem: Problem, near: Linear, draws: int, seed: int, *, has_trend: bool
) -> list[tuple[float, float] | None]:
    """The intervals of the bootstrap."""
    errors = near.errors[near.free]
    usable = near.freedom >= FEWEST_FOR_BOOTSTRAP and bool(np.all(errors > 0.0))
    if draws <= 0 or not usable or not np.all(np.isfinite(errors)):
        return [None] * len(near.at)

    def differences(variables: Numbers) -> Numbers:
        return problem.differences(problem.flow(variables))

    expanded = intervals.expansion(differences, near, problem.low, problem.high)
    if not np.all(np.isfinite(expanded.curvature)):
        return [None] * len(near.at)
    # blocks as long as the cube root of the number of points, longer under a trend
    block = max(1, round(problem.points.count ** (0.5 if has_trend else 0.0)))
    return intervals.bootstrap(
        expanded,
        near,
        problem.groups(),
        problem.low,
        problem.high,
        draws=draws,
        block=block,
        seed=seed,
    )


def _estimates(
    problem: Problem, near: Linear, found: Any, drawn: Sequence[tuple[float, float] | None]
) -> list[Estimate]:
    effects = np.max(np.abs(np.asarray(found.jac)), axis=0, initial=0.0)
    values = problem.values(near.at)
    free = np.flatnonzero(near.free)
    estimates = []
    for index, name in enumerate(problem.names):
        one = parameter(name, problem.law.model)
        interval = intervals.interval(near, index, problem.low[index], problem.high[index])
        doubt = _doubt(problem, near, index, effects[index], interval)
        others = near.correlation[free == index][:, free != index]
        same = not bool(np.all(np.abs(others) < SAME))
        if not effects[index] > NO_EFFECT or same:
            # an interval says nothing where the parameter has no effect
            interval = None
        estimates.append(
            Estimate(
                problem.law.name(name),
                one.unit,
                problem.given[name],
                float(values[index]),
                _of_variables(problem, index, interval),
                doubt,
                _of_variables(problem, index, drawn[index]) if interval else None,
            )
        )
    return estimates


def _of_variables(
    problem: Problem, index: int, ends: tuple[float, float] | None
) -> tuple[float, float] | None:
    if ends is None:
        return None
    both = [np.where(np.arange(len(problem.names)) == index, end, 0.0) for end in ends]
    low, high = (float(problem.values(it)[index]) for it in both)
    return low, high


def _doubt(
    problem: Problem,
    near: Linear,
    index: int,
    effect: float,
    interval: tuple[float, float] | None,
) -> str | None:
    """The reason why the parameter at `index` is not determined."""
    name = problem.names[index]
    bound = problem.bound[index]
    if bound != 0:
        own = name in problem.bounds
        end = problem.values(np.where(bound < 0, problem.low, problem.high))[index]
        shown = quantity(float(end), parameter(name, problem.law.model).unit)
        if bound < 0 and end == 0.0:
            return "not distinguishable from 0: the best value would be negative"
        side = "below" if bound < 0 else "above"
        of = (
            "the bound"
            if own
            else "the smallest of a scene"
            if bound < 0
            else "the largest of a scene"
        )
        return f"not determined: the best value would be {side} {shown}, {of}"
    if not effect > NO_EFFECT:
        if problem.points.kind == "record":
            return (
                "not determined: no force depends on it; contacts that do not yield, for example, "
                "are elastic"
            )
        what = " or ".join(it.replace("_", " ") for it in problem.points.results)
        return (
            f"not determined: no {what} depends on it; impacts that do not yield, for example, "
            "rebound with all their energy"
        )
    count = int(np.count_nonzero(near.free))
    if near.freedom <= 0:
        different = problem.points.different
        word = "different " if different < problem.points.count else ""
        return (
            f"without an interval: {different} {word}points for {count} parameters leave nothing to "
            "judge it by"
        )
    if interval is None:
        return None
    low, high = interval
    if problem.logarithmic[index]:
        with np.errstate(over="ignore"):
            factor = float(np.exp(high - low))
        return (
            f"hardly determined: its interval spans a factor of {factor:.2e}"
            if factor > 4.0
            else None
        )
    if low <= 0.0 <= high and name not in ("zero_point", "preload"):
        return "not distinguishable from 0"
    return None


def _correlations(problem: Problem, near: Linear, said: Sequence[Estimate]) -> list[str]:
    """Which parameters the points can't tell apart."""
    free = np.flatnonzero(near.free)
    notes = []
    for one in range(len(free)):
        for other in range(one):
            value = near.correlation[one, other]
            first, second = (said[free[it]].name for it in (other, one))
            if said[free[one]].doubt is not None and "not determined" in str(said[free[one]].doubt):
                continue
            if not abs(value) < SAME:
                notes.append(
                    f"{first} and {second} can't be told apart by these points, which determine only a "
                    "combination of the parameters: each can make up for another. Fix one of them, or "
                    "give it a prior."
                )
            elif abs(value) >= ALIKE:
                way = "smaller" if value < 0 else "larger"
                notes.append(
                    f"{first} and {second} can hardly be told apart by these points (correlation "
                    f"{value:.3f}): a larger {first} with a {way} {second} explains them almost as well."
                )
    return notes


def _priors(problem: Problem, near: Linear) -> list[str]:
    """Values that are far from what was known of them."""
    flow = problem.flow(near.at)
    notes = []
    for name, (mean, deviation) in problem.priors.items():
        far = (flow[name] - mean) / deviation
        if abs(far) > 2.0:
            notes.append(
                f"{problem.law.name(name)} is {abs(far):.1f} standard deviations {'above' if far > 0 else 'below'} "
                "its prior: the points contradict it."
            )
    return notes


def _parts(problem: Problem, flow: Mapping[str, float]) -> str | None:
    """How well the unloadings of a record are explained, beside its loading."""
    if problem.points.kind != "record" or not problem.points.part.any():
        return None
    left = problem.of(flow)["force"]
    loading = problem.points.part == 0
    one, other = (quantity(_rms(left[it]), "N") for it in (loading, ~loading))
    return f"Root-mean-square difference of the first loading: {one}; of the unloadings: {other}."


def _outside(problem: Problem, wide: NDArray[np.bool_], left_out: int) -> str | None:
    count = int(np.count_nonzero(wide))
    if not count:
        return None
    words = f"The contact radius exceeds {LARGEST_RADIUS_RATIO} effective radii, where no law is valid, at "
    words += f"{count} of {len(wide)} points"
    if left_out:
        return f"{words}: they were left out."
    name = "depth" if problem.points.kind == "record" else "speed"
    at = problem.points.arguments[name][wide]
    unit = UNITS[name]
    ends = f"{quantity(at.min(), unit)} to {quantity(at.max(), unit)}"
    return f'{words} ({name}s from {ends}): outside="leave out" fits without them.'


def _trend(problem: Problem, flow: Mapping[str, float]) -> str | None:
    """A note if neighbouring differences resemble each other."""
    for name, all_of_them in problem.of(flow).items():
        differences = all_of_them[problem.known[name]] / problem._size(name)
        squares = float(np.sum(differences**2))
        # rounding has trends, too
        if len(differences) < FEWEST_FOR_TREND or not squares > ROUNDING:
            continue
        number = float(np.sum(np.diff(differences) ** 2)) / squares
        if number < TREND:
            return (
                f"The remaining differences follow a trend (Durbin-Watson {number:.2f}; independent "
                "ones have about 2): the law does not have the shape of the measurement, and the "
                "linearised intervals are too narrow; bootstrap=1000 draws blocks of neighbours."
            )
    return None


def _curves(problem: Problem, flow: Mapping[str, float]) -> dict[str, Numbers]:
    """The law over the range of the measurement, for a picture."""
    points = problem.points
    if points.kind == "hardness":
        return {}
    if points.kind == "record":
        return {}
    argument = points.argument
    at = points.arguments[argument]
    first, last = float(at.min()), float(at.max())
    if argument == "speed" and last >= 10.0 * first:
        line = np.geomspace(first / 1.5, 1.5 * last, 121)
    else:
        line = np.linspace(0.02 * last, 1.1 * last if argument == "speed" else last, 121)
    if "contact_time" in points.results or problem.law.model or argument == "angle":
        line = line[::4]
    arguments = {name: np.full(len(line), np.mean(it)) for name, it in points.arguments.items()}
    arguments[argument] = line
    along = replace(
        points,
        arguments=arguments,
        results={name: np.full(len(line), np.nan) for name in points.results},
        part=np.zeros(len(line), dtype=int),
    )
    found = {argument: line}
    for which, values in (("scene", problem.given), ("fitted", flow)):
        found |= {f"{name}, {which}": it for name, it in problem.law.values(along, values).items()}
    return found
