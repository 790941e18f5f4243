"""Confidence intervals: linearised, near a bound, and by the bootstrap.

Linearised: the covariance of the parameters is `s^2 (J^T J)^-1`, with the derivatives `J` of the
differences at the optimum, and `s^2` their sum of squares over the degrees of freedom; the interval
is the estimate plus and minus the quantile of Student's t distribution times the standard error
(G. A. F. Seber, C. J. Wild, *Nonlinear Regression*, Wiley 1989, sections 2.1 and 5.1).

Near a bound: the unified interval of G. J. Feldman and R. D. Cousins, *Phys. Rev. D* 57 (1998)
3873-3889, section IV.B, which becomes one-sided by itself; its tails are taken of Student's t. The
interval of another parameter contains the values for which the best fit within all bounds has a sum of
squares that is larger by no more than `s^2 t^2` (profile likelihood): with a parameter held at its bound,
the others would seem surer than they are.

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
FAR = 5.0
"""Distance from a bound, in standard errors, at which it is of no account."""
ITERATIONS = 6
"""Steps of a fit to a draw."""


@dataclass(frozen=True)
class Linear:
    """The neighbourhood of an optimum within bounds."""

    at: Numbers
    low: Numbers
    high: Numbers
    free: NDArray[np.bool_]
    """Parameters that are not at a bound."""
    errors: Numbers
    """Standard error of each parameter: of a free one with the others held at their bounds, of one at
    a bound as if there were none; NaN if the points give none."""
    beyond: Numbers
    """The optimum without bounds, of the parameters that are at one."""
    correlation: Numbers
    """Correlations of the free parameters."""
    freedom: int
    """Degrees of freedom, of the free parameters."""
    root: Numbers
    """The upper triangle of the derivatives' QR decomposition, in units of the standard deviation of the
    differences."""
    rest: Numbers
    """The differences in its basis, in the same units."""

    def reach(self, index: int) -> float:
        """Distance of a parameter from its nearest bound, in standard errors."""
        room = min(self.beyond[index] - self.low[index], self.high[index] - self.beyond[index])
        if not np.isfinite(room):
            return np.inf
        return float(room / self.errors[index]) if self.errors[index] > 0.0 else np.inf


def linear(
    at: Numbers,
    jacobian: Numbers,
    differences: Numbers,
    free: NDArray[np.bool_],
    freedom: int,
    low: Numbers,
    high: Numbers,
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
    size = float(np.sqrt(np.sum(differences**2) / freedom)) if freedom > 0 else np.nan
    if inner is not None:
        errors[free] = spread * size
    whole = _inverse(jacobian)
    if whole is not None and not np.all(free):
        beyond = at - np.where(free, 0.0, whole @ (jacobian.T @ differences))
        with np.errstate(invalid="ignore"):
            errors[~free] = size * np.sqrt(np.diag(whole))[~free]
    basis, root = np.linalg.qr(jacobian)
    with np.errstate(invalid="ignore", divide="ignore"):
        rest = basis.T @ differences / size
        root = root / size
    return Linear(at, low, high, free, errors, beyond, correlation, freedom, root, rest)


def _inverse(jacobian: Numbers) -> Numbers | None:
    """The inverse of `J^T J`, by a decomposition: products would lose half of the digits."""
    try:
        root = np.linalg.inv(np.linalg.qr(jacobian, mode="r"))
        return np.asarray(root @ root.T)
    except np.linalg.LinAlgError:
        return None


def interval(near: Linear, index: int) -> tuple[float, float] | None:
    """The interval of a parameter; None if there is no standard error."""
    error, value = near.errors[index], near.beyond[index]
    low, high = near.low[index], near.high[index]
    freedom = near.freedom
    if not (np.isfinite(error) and error > 0.0 and freedom > 0):
        return (value, value) if error == 0.0 else None
    if near.reach(index) < FAR:
        if value - low <= high - value:
            first, last = _bounded(float((value - low) / error), freedom)
            return low + error * first, min(low + error * last, high)
        first, last = _bounded(float((high - value) / error), freedom)
        return max(high - error * last, low), high - error * first
    others = [it for it in range(len(near.at)) if it != index]
    if any(near.reach(it) < FAR for it in others):
        ends = _profiled(near, index)
        if ends is not None:
            return ends
    return _central(value, error, freedom)


def _profiled(near: Linear, index: int) -> tuple[float, float] | None:
    """The values of a parameter for which the others, within their bounds, explain the points almost as
    well; None if the points don't tell."""
    from scipy.optimize import brentq, lsq_linear

    if not (np.all(np.isfinite(near.root)) and np.all(np.isfinite(near.rest))):
        return None
    others = [it for it in range(len(near.at)) if it != index]
    room = near.low[others] - near.at[others], near.high[others] - near.at[others]
    most = quantile(0.5 + 0.5 * CONFIDENCE, near.freedom) ** 2
    least = float(np.sum(near.rest**2))

    def excess(step: float) -> float:
        right = -(near.rest + near.root[:, index] * step)
        if len(others) == 1:
            column = near.root[:, others[0]]
            best = np.clip(column @ right / (column @ column), room[0][0], room[1][0])
            left = float(np.sum((column * best - right) ** 2))
        else:
            left = 2.0 * float(lsq_linear(near.root[:, others], right, room, method="bvls").cost)
        return left - least - most

    whole = _inverse(near.root)
    if whole is None:
        return None
    # beyond this, not even without bounds
    far = np.sqrt(whole[index, index]) * np.sqrt(most + least)
    far += abs(float((whole @ (near.root.T @ near.rest))[index]))
    try:
        first, last = (sign * brentq(lambda it, s=sign: excess(s * it), 0.0, 1.01 * far) for sign in (-1.0, 1.0))
    except (ValueError, RuntimeError):
        # parameters that can't be told apart: the interval has no end
        return None
    value = near.at[index]
    return max(value + first, near.low[index]), min(value + last, near.high[index])


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


def expansion(function: Function, near: Linear) -> Expansion:
    """The expansion of `function` within about a standard error of the optimum."""
    free = np.flatnonzero(near.free)
    start = function(near.at)
    count = len(free)
    slope = np.zeros((len(start), count))
    curvature = np.zeros((count, count, len(start)))
    steps = np.zeros((count, len(near.at)))
    for row, index in enumerate(free):
        step = near.errors[index]
        steps[row, index] = step
        first = function(near.at + steps[row])
        second = function(near.at - steps[row])
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
    expanded: Expansion, near: Linear, groups: Sequence[NDArray[np.int_]], *, draws: int, block: int, seed: int
) -> list[tuple[float, float] | None]:
    """The interval of each parameter.

    `groups` are the indices of differences that may replace each other; the others (priors) are
    redrawn from the normal distribution. `block` is the number of neighbours that stay together.
    """
    random = np.random.default_rng(seed)
    free = expanded.free
    count, size = len(free), len(expanded.value)
    measured = np.concatenate(list(groups)) if groups else np.empty(0, dtype=int)
    prior = np.setdiff1d(np.arange(size), measured)
    widths = near.errors[free]
    room = near.low[free] - near.at[free], near.high[free] - near.at[free]
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
        first, last = np.quantile(known, [0.5 + 0.5 * CONFIDENCE, 0.5 - 0.5 * CONFIDENCE], method="weibull")
        ends = near.at[index] - widths[row] * np.array([first, last])
        intervals[index] = (max(float(ends[0]), near.low[index]), min(float(ends[1]), near.high[index]))
    return intervals


def _drawn(differences: Numbers, block: int, random: np.random.Generator) -> Numbers:
    """Differences drawn anew, with a mean of zero, in blocks of neighbours."""
    count = len(differences)
    centred = differences - differences.mean() if count > 1 else differences
    block = min(block, count)
    starts = random.integers(0, count - block + 1, -(-count // block))
    found: Numbers = centred[(starts[:, None] + np.arange(block)).ravel()[:count]]
    return found
