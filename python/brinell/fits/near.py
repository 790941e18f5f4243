"""How sure an optimum is: confidence intervals, within bounds and by the bootstrap.

The differences are taken as linear around the optimum. An interval contains the values of a parameter for
which the best fit of the others, within all bounds, has a sum of squares that is larger by no more than
`s^2 t^2`: the profile of the likelihood, with Student's t (G. A. F. Seber, C. J. Wild, *Nonlinear
Regression*, Wiley 1989, sections 5.1 and 5.9). Away from bounds it is the estimate plus and minus t standard
errors; at a bound it becomes one-sided by itself.

Bootstrap: differences are drawn anew (in blocks, if they follow a trend), and the interval is that of the
studentised estimates (B. Efron, R. J. Tibshirani, *An Introduction to the Bootstrap*, Chapman & Hall 1993,
section 12.5).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.float64]
Ends = tuple[float, float]

CONFIDENCE = 0.95
"""Confidence of the intervals."""


@dataclass(frozen=True)
class Near:
    """The neighbourhood of an optimum within bounds."""

    at: Numbers
    low: Numbers
    high: Numbers
    jacobian: Numbers
    left: Numbers
    """The differences at the optimum."""
    free: NDArray[np.bool_]
    """Parameters that are not held at a bound."""
    freedom: int

    @cached_property
    def size(self) -> float:
        """The standard deviation of the differences."""
        return float(np.sqrt(np.sum(self.left**2) / self.freedom)) if self.freedom > 0 else np.nan

    @cached_property
    def inverse(self) -> Numbers:
        """The inverse of `J^T J` of the free parameters, by a decomposition: products would lose half of the
        digits."""
        triangle = np.asarray(np.linalg.qr(self.jacobian[:, self.free], mode="r"))
        try:
            root = np.linalg.inv(triangle)
        except np.linalg.LinAlgError:
            root = np.full_like(triangle, np.nan)
        return np.asarray(root @ root.T)

    @cached_property
    def errors(self) -> Numbers:
        """The standard error of each free parameter."""
        return np.asarray(self.size * np.sqrt(np.diag(self.inverse)))

    @property
    def correlation(self) -> Numbers:
        """Correlations of the free parameters."""
        spread = np.sqrt(np.diag(self.inverse))
        with np.errstate(invalid="ignore", divide="ignore"):
            return np.asarray(self.inverse / np.outer(spread, spread))

    def reach(self) -> float:
        """The least distance of a parameter from its bound, in standard errors."""
        if not self.free.all():
            return 0.0
        with np.errstate(invalid="ignore", divide="ignore"):
            return float(np.min(np.minimum(self.at - self.low, self.high - self.at) / self.errors))

    def interval(self, index: int) -> Ends | None:
        """The interval of a parameter; None if the points don't tell."""
        from scipy.optimize import brentq, lsq_linear
        from scipy.special import stdtrit

        if self.freedom <= 0 or self.size == 0.0:
            return None if self.freedom <= 0 else (float(self.at[index]),) * 2
        basis, root = np.linalg.qr(self.jacobian)
        others = np.arange(len(self.at)) != index
        room = self.low - self.at, self.high - self.at
        most = (stdtrit(self.freedom, 0.5 + 0.5 * CONFIDENCE) * self.size) ** 2
        rest = basis.T @ self.left
        least = float(rest @ rest)

        def excess(step: float) -> float:
            right = -(rest + root[:, index] * step)
            if not others.any():
                return float(right @ right - least - most)
            best = lsq_linear(root[:, others], right, (room[0][others], room[1][others]), method="bvls")
            return float(2.0 * best.cost - least - most)

        try:
            # beyond this, not even without bounds
            whole = np.linalg.inv(root)
            far = float(np.linalg.norm(whole[index]) * np.sqrt(most + least) + abs(whole[index] @ rest))
            ends = [float(self.at[index] + sign * brentq(lambda it, s=sign: excess(s * it), 0.0, 1.01 * far))
                    for sign in (-1.0, 1.0)]  # fmt: skip
        except (ValueError, RuntimeError, np.linalg.LinAlgError):
            # parameters that can't be told apart: the interval has no end
            return None
        return max(ends[0], float(self.low[index])), min(ends[1], float(self.high[index]))

    def bootstrap(self, groups: Sequence[NDArray[np.int_]], draws: int, block: int, seed: int) -> list[Ends | None]:
        """The interval of each parameter, of those that are all free.

        `groups` are the indices of differences that may replace each other; the others (priors) are
        redrawn from the normal distribution. `block` is the number of neighbours that stay together.
        """
        random = np.random.default_rng(seed)
        errors = random.standard_normal((draws, len(self.left)))
        for group in groups:
            drawn = _drawn(self.left[group], draws, block, random)
            errors[:, group] = np.sqrt(len(self.left) / self.freedom) * drawn
        steps = errors @ self.jacobian @ self.inverse
        sizes = np.sqrt(np.sum((errors - steps @ self.jacobian.T) ** 2, axis=1) / self.freedom)
        # each estimate over its own standard error
        studentised = steps / sizes[:, None] * self.size
        tails = [0.5 + 0.5 * CONFIDENCE, 0.5 - 0.5 * CONFIDENCE]
        ends = self.at - np.quantile(studentised, tails, axis=0, method="weibull")
        low, high = np.maximum(ends[0], self.low), np.minimum(ends[1], self.high)
        return list(zip(low.tolist(), high.tolist(), strict=True))


def _drawn(differences: Numbers, draws: int, block: int, random: np.random.Generator) -> Numbers:
    """Differences drawn anew, with a mean of zero, in blocks of neighbours."""
    count = len(differences)
    block = min(block, count)
    starts = random.integers(0, count - block + 1, (draws, -(-count // block)))
    places = (starts[:, :, None] + np.arange(block)).reshape(draws, -1)[:, :count]
    return np.asarray((differences - differences.mean() if count > 1 else differences)[places])
