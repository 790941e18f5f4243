"""Least squares: the parameters of a scene that explain a measurement, with confidence intervals.

The covariance of the parameters is `s^2 (J^T J)^-1`, with the derivatives `J` of the differences at
the optimum and `s^2` their sum of squares over the degrees of freedom. The interval is the estimate
plus and minus the 97.5 % quantile of Student's t distribution times the standard error. This holds
if the law is right and the errors of the measurement are independent, of equal size, and small
enough for the law to be linear in their range.

Reference: G. A. F. Seber, C. J. Wild, *Nonlinear Regression*, Wiley 1989, sections 2.1 and 5.1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .law import LARGEST_RADIUS_RATIO, PARAMETERS, Law
from .measured import KINDS, Measured, Table, measured
from .result import Estimate, Fit, quantity

Numbers = NDArray[np.float64]

CONFIDENCE = 0.95
"""Confidence of the intervals."""
NO_EFFECT = 1e-9
"""A parameter on which no point depends more than this is not determined."""
CORRELATED = 0.999
"""A correlation of two parameters of which only a combination is determined."""
TREND = 1.0
"""Durbin and Watson's number below which differences follow a trend; independent ones have 2."""
FEWEST_FOR_TREND = 8
"""Fewest points for that number."""
ROUNDING = 1e-14
"""A sum of squares that is rounding."""
STRENGTHS = np.geomspace(1e-6, 0.5, 61)
"""Yield strengths that the search may start at, relative to the effective modulus: the restitution
of some laws is not monotone."""
LARGEST_C = 1.0
"""The largest constant of Johnson and Cook that a scene can have."""
TOLERANCE = 1e-12
"""Relative change at which the search ends."""
POINTS = 121
"""Number of points of the curves of a picture."""
BEYOND = "the law of the scene can't be evaluated for all points of the measurement"


def fit(
    scene_file: str | Path,
    measurement: str | Path | Table,
    parameters: str | Sequence[str] = ("yield_strength",),
    *,
    mass: float | None = None,
) -> Fit:
    """Fit parameters of a scene's first contact to a measurement; return their values with 95 %
    confidence intervals.

    `measurement` is a CSV file or a table (a mapping or a pandas DataFrame) with two columns:
    "speed" [m/s] and "restitution" of rebounds, or "depth" [m] and "force" [N] of a slow first
    loading. A unit may follow the name: "depth [um]". Unloadings of a record are left out.

    `parameters` are "yield_strength", "hardening_modulus" and "rate" (the constant `c` of
    johnson-cook, or `d` of cowper-symonds) of the softer body. All impacts have the effective
    `mass` [kg], by default that of the scene. Where the best hardening modulus or `c` would be
    negative, it is zero, and the others are fitted again.

    Raises `ValueError` for a bad measurement, with line and column, and for parameters that the
    scene or the measurement has not; `ProgramError` for a bad scene.
    """
    names = [parameters] if isinstance(parameters, str) else list(parameters)
    for index, name in enumerate(names):
        if name not in PARAMETERS:
            raise ValueError(
                f"parameters: {name!r} can't be fitted; expected {', '.join(PARAMETERS)}"
            )
        if name in names[:index]:
            raise ValueError(f"parameters names {name} twice")
    if not names:
        raise ValueError(f"parameters is empty; expected some of {', '.join(PARAMETERS)}")
    points = measured(measurement)
    if "rate" in names and points.kind == "force":
        raise ValueError("rate needs speeds: a force over depth says nothing of the strain rate")
    if mass is not None and points.kind == "force":
        raise ValueError(f"mass = {mass!r} has no effect on a slow loading: leave it out")
    law = Law(scene_file, points, mass, hardens="hardening_modulus" in names)
    for name in names:
        if name == "rate" and law.model is None:
            raise ValueError(f"rate needs a rate model in the scene: give {law.body}.rate")
        if name != "rate" and law.is_power_law:
            raise ValueError(
                f"{law.name(name)} follows from {law.body}.power_law: there is nothing to fit"
            )
    return _Problem(law, points, names).fitted()


@dataclass
class _Problem:
    """The fitted variables are logarithms of what is positive, and errors of which are ratios."""

    law: Law
    points: Measured
    names: list[str]

    def __post_init__(self) -> None:
        sizes = {"hardening_modulus": self.law.modulus}
        self.sizes = np.array([sizes.get(name, 1.0) for name in self.names])
        self.logarithmic = np.array([self._is_logarithmic(name) for name in self.names])

    def _is_logarithmic(self, name: str) -> bool:
        return name == "yield_strength" or (name == "rate" and self.law.model == "cowper-symonds")

    def variables(self, flow: dict[str, float]) -> Numbers:
        values = np.array([flow[name] for name in self.names])
        with np.errstate(divide="ignore"):
            found: Numbers = np.where(self.logarithmic, np.log(values), values / self.sizes)
        return found

    def values(self, variables: Numbers) -> list[float]:
        with np.errstate(over="ignore"):
            found = np.where(self.logarithmic, np.exp(variables), variables * self.sizes)
        return [float(it) for it in found]

    def flow(self, variables: Numbers) -> dict[str, float]:
        return self.law.given | dict(zip(self.names, self.values(variables), strict=True))

    def differences(self, flow: dict[str, float]) -> Numbers:
        """Of the law from the measurement, in units of `Measured.size`."""
        points = self.points
        return (self.law.values(points.at, flow) - points.values) / points.size

    def starts(self) -> list[Numbers]:
        """The scene's values, and other strengths."""
        own = self.variables(self.law.given)
        starts = [own]
        if "yield_strength" in self.names:
            for strength in STRENGTHS * self.law.modulus:
                starts.append(own.copy())
                starts[-1][self.names.index("yield_strength")] = np.log(strength)
        return starts

    def solve(self) -> Any:
        """The optimum within the bounds, by scipy."""
        from scipy.optimize import least_squares

        def squares(start: Numbers) -> float:
            sum_ = float(np.sum(self.differences(self.flow(start)) ** 2))
            return sum_ if np.isfinite(sum_) else np.inf

        start = min(self.starts(), key=squares)
        low = np.where(self.logarithmic, -np.inf, 0.0)
        is_c = ~self.logarithmic & (np.array(self.names) == "rate")
        high = np.where(is_c, LARGEST_C, np.inf)
        try:
            return least_squares(
                lambda variables: self.differences(self.flow(variables)),
                start,
                jac="3-point",
                bounds=(low, high),
                method="dogbox",
                xtol=TOLERANCE,
                ftol=TOLERANCE,
                gtol=TOLERANCE,
            )
        except (ValueError, np.linalg.LinAlgError) as error:
            # derivatives at the end of the law's range
            raise ValueError(BEYOND) from error

    def fitted(self) -> Fit:
        before = self.differences(self.law.given)
        if not np.all(np.isfinite(before)):
            raise ValueError(BEYOND)
        found = self.solve()
        flow, differences = self.flow(found.x), np.asarray(found.fun)
        estimates, combined = self.estimates(found)
        notes = [
            combined,
            _trend(differences),
            self._left_out(),
            self._outside(self.law.outside(self.points.at, flow)),
        ]
        argument, value = KINDS[self.points.kind]

        def table(at: Numbers) -> dict[str, Numbers]:
            law = self.law
            return {
                argument: at,
                "scene": law.values(at, law.given),
                "fitted": law.values(at, flow),
            }

        return Fit(
            kind=self.points.kind,
            estimates=tuple(estimates),
            count=len(self.points.at),
            left_out=self.points.left_out,
            rms=self._rms(differences),
            rms_of_scene=self._rms(before),
            notes=tuple(note for note in notes if note),
            points=table(self.points.at) | {value: self.points.values},
            curves=table(self._arguments()),
        )

    def _rms(self, differences: Numbers) -> float:
        return self.points.size * float(np.sqrt(np.mean(differences**2)))

    def _arguments(self) -> Numbers:
        """Those of the curves of a picture."""
        first, last = self.points.at[0], self.points.at[-1]
        if self.points.kind == "restitution" and last >= 10.0 * first:
            return np.geomspace(first / 1.5, 1.5 * last, POINTS)
        return np.linspace(0.02 * last, 1.1 * last, POINTS)

    def _left_out(self) -> str | None:
        if not self.points.left_out:
            return None
        return (
            f"The record has unloadings: {self.points.left_out} points without a greater depth and "
            "force than all before them were left out, since they belong to no first loading."
        )

    def _outside(self, wide: Numbers) -> str | None:
        if not len(wide):
            return None
        name, unit = {"restitution": ("speeds", "m/s"), "force": ("depths", "m")}[self.points.kind]
        return (
            f"The contact radius exceeds {LARGEST_RADIUS_RATIO} effective radii, where no law is "
            f"valid, at {len(wide)} of {len(self.points.at)} points ({name} from "
            f"{quantity(wide[0], unit)} to {quantity(wide[-1], unit)}): leave them out."
        )

    def estimates(self, found: Any) -> tuple[list[Estimate], str | None]:
        """The estimates with their intervals, and a note on parameters that can't be told apart."""
        from scipy.special import stdtrit

        at, differences = found.x, found.fun
        # at its bound, and held there: a parameter without effect may have started there
        bound = np.where(found.active_mask * found.grad < 0.0, found.active_mask, 0)
        free = bound == 0
        jacobian = np.asarray(found.jac)[:, free]
        effects = np.max(np.abs(jacobian), axis=0, initial=0.0)
        # points that repeat others to the last digit don't tell how much a measurement scatters
        count = int(np.count_nonzero(free))
        enough = self.points.different > count
        freedom = len(differences) - count if enough else 0
        covariance = _inverse(jacobian)
        correlated = count > 1 and bool(np.all(effects > NO_EFFECT)) and _is_correlated(covariance)
        errors = np.full(count, np.nan)
        if freedom > 0 and covariance is not None:
            variances = np.sum(differences**2) / freedom * np.diag(covariance)
            with np.errstate(invalid="ignore"):
                errors = stdtrit(freedom, 0.5 + 0.5 * CONFIDENCE) * np.sqrt(variances)
        estimates, ordinals = [], np.cumsum(free) - 1
        for index, name in enumerate(self.names):
            value, interval, doubt = self.values(at)[index], None, None
            if bound[index] < 0:
                doubt = "not distinguishable from 0: the best value would be negative"
            elif bound[index] > 0:
                doubt = (
                    f"not determined: the best value would be above {LARGEST_C:g}, the largest of a "
                    "scene"
                )
            else:
                error, effect = errors[ordinals[index]], effects[ordinals[index]]
                if np.isfinite(error):
                    ends = [
                        np.where(np.arange(len(at)) == index, at + it, at) for it in (-error, error)
                    ]
                    low, high = (max(self.values(end)[index], 0.0) for end in ends)
                    interval = (low, high)
                doubt = self._doubt(index, at[index], effect, freedom, count, error, interval)
                # an interval says nothing where the parameter has no effect
                if not effect > NO_EFFECT or correlated:
                    interval = None
            unit = self.law.unit(name)
            scene = self.law.given[name]
            estimates.append(Estimate(self.law.name(name), unit, scene, value, interval, doubt))
        combined = (
            "The measurement determines only a combination of the parameters: each can make up for "
            "another. Fit one of them."
        )
        return estimates, combined if correlated else None

    def _doubt(
        self,
        index: int,
        at: float,
        effect: float,
        freedom: int,
        count: int,
        error: float,
        interval: tuple[float, float] | None,
    ) -> str | None:
        """The reason why the parameter at `index` is not determined."""
        if not effect > NO_EFFECT:
            why = {
                "restitution": "no restitution depends on it; impacts that do not yield, for "
                "example, rebound with all their energy",
                "force": "no force depends on it; contacts that do not yield, for example, are "
                "elastic",
            }
            return f"not determined: {why[self.points.kind]}"
        if freedom <= 0:
            different = self.points.different
            word = "different " if different < len(self.points.at) else ""
            return (
                f"without an interval: {different} {word}points for {count} parameters leave "
                "nothing to judge it by"
            )
        if interval is None:
            return None
        low, high = interval
        if self.logarithmic[index]:
            factor = high / low if low > 0.0 else np.inf
            hardly = f"hardly determined: its interval spans a factor of {factor:.2e}"
            return hardly if error > np.log(2.0) else None
        return "not distinguishable from 0" if at - error <= 0.0 else None


def _inverse(jacobian: Numbers) -> Numbers | None:
    try:
        return np.asarray(np.linalg.inv(jacobian.T @ jacobian))
    except np.linalg.LinAlgError:
        return None


def _is_correlated(covariance: Numbers | None) -> bool:
    """Whether two parameters can hardly be told apart."""
    if covariance is None:
        return True
    with np.errstate(invalid="ignore"):
        spread = np.sqrt(np.diag(covariance))
        pairs = (covariance / np.outer(spread, spread))[np.triu_indices(len(covariance), 1)]
    # rounding may make the root of a negative number
    return bool(np.any(np.isnan(pairs) | (np.abs(pairs) >= CORRELATED)))


def _trend(differences: Numbers) -> str | None:
    """A note if neighbouring differences resemble each other."""
    squares = float(np.sum(differences**2))
    # rounding has trends, too
    if len(differences) < FEWEST_FOR_TREND or not squares > ROUNDING:
        return None
    number = float(np.sum(np.diff(differences) ** 2)) / squares
    if number >= TREND:
        return None
    return (
        f"The remaining differences follow a trend (Durbin-Watson {number:.2f}; independent ones "
        "have about 2): the law does not have the shape of the measurement, and the intervals are too "
        "narrow."
    )
