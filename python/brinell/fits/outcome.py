"""What a fit says: estimates, doubts, correlations, points outside the validity, and the result."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..prediction import quantity
from .law import LARGEST_RADIUS_RATIO
from .measured import UNITS
from .near import Ends, Near, Numbers
from .parameters import parameter
from .problem import BEYOND, Problem
from .result import Estimate, Fit

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
FEWEST_FOR_BOOTSTRAP = 8
"""Fewest degrees of freedom of a bootstrap: of fewer differences, draws repeat each other."""
NEAR_BOUND = 3.0
"""Distance from a bound, in standard errors, below which draws of the bootstrap pile up there."""
USUAL_STRENGTHS = (1e6, 2e10)
"""Strengths [Pa] outside which a unit is probably wrong."""


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
    said = _estimates(problem, near, drawn)
    notes = [
        _usual(problem, flow),
        _without_bootstrap(near) if draws > 0 else None,
        *_correlations(problem, near, said),
        *_priors(problem, near),
        _parts(problem, flow),
        trend,
        _outside(problem, wide, left_out),
    ]
    scene = problem.of(problem.given)
    left = problem.of(flow)
    values = {name: it[0] for name, it in problem.law.values(problem.points, [flow]).items()}
    return Fit(
        kind=problem.points.kind,
        law=problem.law.law,
        estimates=tuple(said),
        count=problem.points.count,
        left_out=left_out,
        rms={name: _rms(it) for name, it in left.items()},
        rms_of_scene={name: _rms(it) for name, it in scene.items()},
        notes=tuple(note for note in notes if note),
        columns=problem.points.notes,
        argument=problem.points.argument,
        points={**problem.points.arguments, "part": problem.points.part.astype(float)}
        | {f"{name}, measured": it for name, it in problem.points.results.items()}
        | {f"{name}, fitted": it for name, it in values.items()}
        | {f"{name}, scene": it + problem.points.results[name] for name, it in scene.items()},
        data=problem.law.scene,
        body=problem.law.body,
        flow=flow,
        rates=problem.law.rates,
    )


def _usual(problem: Problem, flow: Mapping[str, float]) -> str | None:
    """A question at a strength that no metal has."""
    value = flow["yield_strength"]
    low, high = USUAL_STRENGTHS
    if "yield_strength" not in problem.names or low <= value <= high:
        return None
    return (
        f"A strength of {quantity(value, 'Pa')} is no metal's (1 MPa to 20 GPa): are the units of the "
        "columns and the bodies of the scene right?"
    )


def _finite(problem: Problem) -> None:
    start = problem.given
    if problem.points.kind == "record" and {"zero_point", "preload"} & {*problem.names}:
        return
    if not np.all(np.isfinite(problem.differences([start]))):
        raise ValueError(BEYOND)


def _rms(differences: Numbers) -> float:
    return float(np.sqrt(np.nanmean(differences**2)))


def _without_bootstrap(near: Near) -> str | None:
    """The reason why there is no bootstrap."""
    if near.freedom < FEWEST_FOR_BOOTSTRAP:
        return f"The bootstrap needs {FEWEST_FOR_BOOTSTRAP} points more than parameters."
    if near.reach() < NEAR_BOUND:
        return f"The bootstrap needs parameters that are {NEAR_BOUND:g} standard errors from their bounds."
    return None


def _drawn(problem: Problem, near: Near, draws: int, seed: int, *, has_trend: bool) -> list[Ends | None]:
    """The intervals of the bootstrap."""
    if draws <= 0 or _without_bootstrap(near) or not (near.errors > 0.0).all():
        return [None] * len(near.at)
    # longer blocks under a trend
    block = max(1, round(problem.points.count ** (0.5 if has_trend else 0.0)))
    return near.bootstrap(problem.groups(), draws, block, seed)


def _estimates(problem: Problem, near: Near, drawn: Sequence[Ends | None]) -> list[Estimate]:
    effects = np.max(np.abs(near.jacobian), axis=0, initial=0.0)
    values = problem.values(near.at)
    free = np.flatnonzero(near.free)
    estimates = []
    for index, name in enumerate(problem.names):
        others = near.correlation[free == index][:, free != index]
        interval = near.interval(index)
        doubt = _doubt(problem, near, index, effects[index], interval)
        if not effects[index] > NO_EFFECT or not bool(np.all(np.abs(others) < SAME)):
            # an interval says nothing where the parameter has no effect
            interval = None
        estimates.append(
            Estimate(
                problem.law.name(name),
                parameter(name, problem.law.model).unit,
                problem.given[name],
                float(values[index]),
                _of_variables(problem, index, interval),
                doubt,
                _of_variables(problem, index, drawn[index]) if interval else None,
            )
        )
    return estimates


def _of_variables(problem: Problem, index: int, ends: Ends | None) -> Ends | None:
    if ends is None:
        return None
    low, high = (float(problem.values(np.full(len(problem.names), end))[index]) for end in ends)
    return low, high


def _doubt(problem: Problem, near: Near, index: int, effect: float, interval: Ends | None) -> str | None:
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
        of = "the bound" if own else "the smallest of a scene" if bound < 0 else "the largest of a scene"
        return f"not determined: the best value would be {side} {shown}, {of}"
    if not effect > NO_EFFECT:
        if problem.points.kind == "record":
            return "not determined: no force depends on it; contacts that do not yield, for example, are elastic"
        what = " or ".join(it.replace("_", " ") for it in problem.points.results)
        return (
            f"not determined: no {what} depends on it; impacts that do not yield, for example, "
            "rebound with all their energy"
        )
    count = int(np.count_nonzero(near.free))
    if near.freedom <= 0:
        different = problem.points.different
        word = "different " if different < problem.points.count else ""
        return f"without an interval: {different} {word}points for {count} parameters leave nothing to judge it by"
    if interval is None:
        return None
    low, high = interval
    if problem.logarithmic[index]:
        with np.errstate(over="ignore"):
            factor = float(np.exp(high - low))
        return f"hardly determined: its interval spans a factor of {factor:.2e}" if factor > 4.0 else None
    if low <= 0.0 <= high and name not in ("zero_point", "preload"):
        return "not distinguishable from 0"
    return None


def _correlations(problem: Problem, near: Near, said: Sequence[Estimate]) -> list[str]:
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


def _priors(problem: Problem, near: Near) -> list[str]:
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
    narrow = problem.law.size < problem.law.radius
    of = "of the smaller body's radius" if narrow else "effective radii"
    words = f"The contact radius exceeds {LARGEST_RADIUS_RATIO} {of}, where no law is valid, at "
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
