"""Confidence intervals: linearised, near a bound, and by the bootstrap.

Linearised: the covariance of the parameters is `s^2 (J^T J)^-1`, with the derivatives `J` of the
differences at the optimum, and `s^2` their sum of squares over the degrees of freedom; the interval
is the estimate plus and minus the quantile of Student's t distribution times the standard error
(G. A. F. Seber, C. J. Wild, *Nonlinear Regression*, Wiley 1989, sections 2.1 and 5.1).

Near a bound: the unified interval of G. J. Feldman and R. D. Cousins, *Phys. Rev. D* 57 (1998)
3873-3889, section IV.B, which becomes one-sided by itself; its tails are taken of Student's t.

Bootstrap: differences are drawn anew (in blocks, if they follow a trend), and the law is fitted to
each draw by its expansion to second order; the interval is that of the studentised estimates
(B. Efron, R. J. Tibshirani, *An Introduction to the Bootstrap*, Chapman & Hall 1993, section 12.5).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.float64]
Function = Callable[[Numbers], Numbers]

CONFIDENCE = 0.95
"""Confidence of the intervals."""
ITERATIONS = 6
"""Steps of a fit to a draw."""


@dataclass(frozen=True)
class Linear:
    """The neighbourhood of an optimum. At a bound, a parameter is held there for all others."""

    at: Numbers
    free: NDArray[np.bool_]
    """Parameters that are not at a bound."""
    errors: Numbers
    """Standard error of each parameter; NaN if the points give none."""
    beyond: Numbers
    """The optimum without bounds."""
    correlation: Numbers
    """Correlations of the free parameters."""
    freedom: int
    """Degrees of freedom."""


def linear(
    at: Numbers, jacobian: Numbers, differences: Numbers, free: NDArray[np.bool_], freedom: int
) -> Linear:
    """The neighbourhood of the optimum `at`."""
    count = len(at)
    errors, beyond = np.full(count, np.nan), at.copy()
    correlation = np.full((np.count_nonzero(free),) * 2, np.nan)
    inner = _inverse(jacobian[:, free])
    if inner is not None:
        with np.errstate(invalid="ignore", divide="ignore"):
            spread = np.sqrt(np.diag(inner))
            correlation = inner / np.outer(spread, spread)
        if freedom > 0:
            errors[free] = spread * np.sqrt(np.sum(differences**2) / freedom)
    whole = _inverse(jacobian)
    held = freedom - np.count_nonzero(~free)
    if whole is not None and not np.all(free):
        step = -whole @ (jacobian.T @ differences)
        beyond = at + np.where(free, 0.0, step)
        left = differences + jacobian @ step
        if held > 0:
            size = np.sqrt(np.sum(left**2) / held)
            with np.errstate(invalid="ignore"):
                errors[~free] = size * np.sqrt(np.diag(whole))[~free]
    return Linear(at, free, errors, beyond, correlation, freedom)


def _inverse(jacobian: Numbers) -> Numbers | None:
    try:
        return np.asarray(np.linalg.inv(jacobian.T @ jacobian))
    except np.linalg.LinAlgError:
        return None


def interval(near: Linear, index: int, low: float, high: float) -> tuple[float, float] | None:
    """The interval of a parameter with these bounds; None if there is no standard error."""
    error, value = near.errors[index], near.beyond[index]
    freedom = near.freedom - (0 if near.free[index] else int(np.count_nonzero(~near.free)))
    if not (np.isfinite(error) and error > 0.0 and freedom > 0):
        return (value, value) if error == 0.0 else None
    below, above = (value - low) / error, (high - value) / error
    if below <= above:
        first, last = _bounded(float(below), freedom)
        found = (
            (low + error * first, low + error * last)
            if np.isfinite(low)
            else _central(value, error, freedom)
        )
    else:
        first, last = _bounded(float(above), freedom)
        found = (high - error * last, high - error * first)
    return max(found[0], low), min(found[1], high)


def _central(value: float, error: float, freedom: int) -> tuple[float, float]:
    half = quantile(0.5 + 0.5 * CONFIDENCE, freedom) * error
    return value - half, value + half


def quantile(probability: float, freedom: int) -> float:
    """That of Student's t distribution."""
    from scipy.special import stdtrit

    return float(stdtrit(freedom, probability))


def _bounded(at: float, freedom: int) -> tuple[float, float]:
    """The interval of a parameter that can't be negative, whose estimate without that bound is `at`
    standard errors."""
    from scipy.optimize import brentq

    far = quantile(0.5 + 0.5 * CONFIDENCE, freedom)
    if at > far + 4.0:
        return at - far, at + far

    def lower(true: float) -> float:
        return at - true - quantile(1.0 - _tails(true)[1], freedom)

    def upper(true: float) -> float:
        below = _tails(true)[0]
        return at - true - (quantile(below, freedom) if below > 1e-12 else -1e6)

    largest = max(at, 0.0) + far + 4.0
    first = brentq(lower, 0.0, largest) if lower(0.0) > 0.0 else 0.0
    last = brentq(upper, 1e-9, largest) if upper(1e-9) > 0.0 else 0.0
    return float(first), float(last)


@lru_cache(maxsize=4096)
def _tails(true: float) -> tuple[float, float]:
    """The probabilities below and above the estimates that belong to a true value of so many
    standard errors, of all estimates that the likelihood ratio puts first."""
    from scipy.optimize import brentq
    from scipy.special import ndtr, ndtri

    outside = 1.0 - CONFIDENCE
    half = float(ndtri(1.0 - 0.5 * outside))
    if true >= half:
        return 0.5 * outside, 0.5 * outside
    if true < 1e-6:
        return 0.0, outside

    def below(width: float) -> float:
        """The smallest of those estimates, if the largest is `width` above the true value."""
        return true - width if width <= true else (true**2 - width**2) / (2.0 * true)

    def excess(width: float) -> float:
        return float(ndtr(width) - ndtr(below(width) - true)) - CONFIDENCE

    width = float(brentq(excess, 0.1, half + 1.0))
    return float(ndtr(below(width) - true)), float(1.0 - ndtr(width))


@dataclass(frozen=True)
class Expansion:
    """A function to second order around a point, in the parameters that are free."""

    at: Numbers
    free: NDArray[np.int_]
    value: Numbers
    slope: Numbers
    """First derivatives: a column for each free parameter."""
    curvature: Numbers
    """Second derivatives: the first two axes are the parameters."""

    def __call__(self, step: Numbers) -> Numbers:
        """The values at a step of the free parameters from the point."""
        second = np.tensordot(np.outer(step, step), self.curvature, 2)
        found: Numbers = self.value + self.slope @ step + 0.5 * second
        return found

    def slopes(self, step: Numbers) -> Numbers:
        """The first derivatives there."""
        found: Numbers = self.slope + np.tensordot(step, self.curvature, 1).T
        return found


def expansion(function: Function, near: Linear, low: Numbers, high: Numbers) -> Expansion:
    """The expansion of `function` within about a standard error of the optimum."""
    free = np.flatnonzero(near.free)
    start = function(near.at)
    count = len(free)
    slope = np.zeros((len(start), count))
    curvature = np.zeros((count, count, len(start)))
    steps = np.zeros((count, len(near.at)))
    firsts = []
    for row, index in enumerate(free):
        room = min(near.at[index] - low[index], high[index] - near.at[index])
        step = near.errors[index]
        # to one side where the other is beyond a bound
        one_sided = room < step
        if one_sided and high[index] - near.at[index] < near.at[index] - low[index]:
            step = -step
        steps[row, index] = step
        first = function(near.at + steps[row])
        second = function(near.at + (2.0 if one_sided else -1.0) * steps[row])
        firsts.append(first)
        if one_sided:
            slope[:, row] = (4.0 * first - 3.0 * start - second) / (2.0 * step)
            curvature[row, row] = (second - 2.0 * first + start) / step**2
        else:
            slope[:, row] = (first - second) / (2.0 * step)
            curvature[row, row] = (first - 2.0 * start + second) / step**2
    for row in range(count):
        for column in range(row):
            both = function(near.at + steps[row] + steps[column])
            one, other = steps[row, free[row]], steps[column, free[column]]
            mixed = both - start - slope[:, row] * one - slope[:, column] * other
            mixed -= 0.5 * (curvature[row, row] * one**2 + curvature[column, column] * other**2)
            curvature[row, column] = curvature[column, row] = mixed / (one * other)
    return Expansion(near.at, free, start, slope, curvature)


def bootstrap(
    expanded: Expansion,
    near: Linear,
    groups: Sequence[NDArray[np.int_]],
    low: Numbers,
    high: Numbers,
    *,
    draws: int,
    block: int,
    seed: int,
) -> list[tuple[float, float] | None]:
    """The interval of each parameter; None for those at a bound.

    `groups` are the indices of differences that may replace each other; the others (priors) are
    redrawn from the normal distribution. `block` is the number of neighbours that stay together.
    """
    random = np.random.default_rng(seed)
    free = expanded.free
    count, size = len(free), len(expanded.value)
    measured = np.concatenate(list(groups)) if groups else np.empty(0, dtype=int)
    prior = np.setdiff1d(np.arange(size), measured)
    widths = near.errors[free]
    room = (low[free] - near.at[free], high[free] - near.at[free])
    scale = np.sqrt(size / max(near.freedom, 1))
    found = np.full((draws, count), np.nan)
    for draw in range(draws):
        errors = np.zeros(size)
        for group in groups:
            errors[group] = -scale * _drawn(expanded.value[group], block, random)
        errors[prior] = random.standard_normal(len(prior))
        step = np.zeros(count)
        for _ in range(ITERATIONS):
            slopes = expanded.slopes(step)
            left = expanded(step) - expanded.value - errors
            step = np.clip(step - np.linalg.lstsq(slopes, left, rcond=None)[0], *room)
        left = expanded(step) - expanded.value - errors
        inverse = _inverse(expanded.slopes(step))
        if inverse is None or near.freedom <= 0:
            continue
        with np.errstate(invalid="ignore", divide="ignore"):
            error = np.sqrt(np.sum(left**2) / near.freedom * np.diag(inverse))
            found[draw] = step / error
    intervals: list[tuple[float, float] | None] = [None] * len(near.at)
    for row, index in enumerate(free):
        known = found[np.isfinite(found[:, row]), row]
        if len(known) < 0.9 * draws or not np.isfinite(widths[row]):
            continue
        first, last = np.quantile(
            known, [0.5 + 0.5 * CONFIDENCE, 0.5 - 0.5 * CONFIDENCE], method="weibull"
        )
        ends = near.at[index] - widths[row] * np.array([first, last])
        intervals[index] = (max(float(ends[0]), low[index]), min(float(ends[1]), high[index]))
    return intervals


def _drawn(differences: Numbers, block: int, random: np.random.Generator) -> Numbers:
    """Differences drawn anew, with a mean of zero, in blocks of neighbours."""
    count = len(differences)
    centred = differences - differences.mean() if count > 1 else differences
    block = min(block, count)
    starts = random.integers(0, count - block + 1, -(-count // block))
    found: Numbers = centred[(starts[:, None] + np.arange(block)).ravel()[:count]]
    return found
