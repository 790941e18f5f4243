"""Least squares: the parameters of a scene that explain a measurement."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Literal

from ..errors import ProgramError, one_of
from ..program import in_si
from .law import Law, strengths_of
from .measured import UNITS, Measured, Table, measured
from .outcome import fitted
from .parameters import PARAMETERS, parameter
from .problem import Problem
from .reading import Decimal
from .result import Fit

Value = float | str
"""A number in SI units, or a text with a unit, such as `"240 MPa"`."""
Pairs = Mapping[str, tuple[Value, Value]]


def fit(
    scene_file: str | Path,
    measurement: str | Path | Table,
    parameters: str | Sequence[str] = ("yield_strength",),
    *,
    mass: float | None = None,
    fixed: Mapping[str, Value] | None = None,
    bounds: Pairs | None = None,
    priors: Pairs | None = None,
    accuracy: Mapping[str, Value] | None = None,
    laws: Sequence[str] | None = None,
    outside: Literal["mark", "leave out"] = "mark",
    unloading: bool = True,
    columns: Mapping[str, str] | None = None,
    decimal: Decimal | None = None,
    bootstrap: int = 0,
    seed: int = 0,
) -> Fit:
    """Fit parameters of a scene's first contact to a measurement; return their values with 95 %
    confidence intervals.

    `measurement` is a file (CSV of any dialect, Excel, Parquet) or a table (a DataFrame or another
    mapping from headings to columns). Headings have units: "depth [um]". It has

    - impacts: speed or drop height, and one or several of restitution, rebound speed, rebound
      height, dent depth, dent diameter, contact time, largest force; with an angle [deg]
      tangential restitution or rebound angle; a mass, if it differs;
    - the record of a slow indentation: depth and force, with its unloadings;
    - or readings of hardness: "HV10", "HBW 10/3000", "HRC".

    `columns` gives headings other names, and `decimal` says the decimal sign ("." or ",") where a
    file leaves it open.

    `parameters` are free: "yield_strength", "hardening_modulus" and "rate" (the constant `c` of
    johnson-cook, or `d` of cowper-symonds) of the softer body, "elastic_restitution", "friction";
    of a machine that records "zero_point" [m] (indentation at depth 0), "preload" [N] (force at a
    recorded force of 0) and "compliance" [m/N]. `fixed` gives others of them a value, `bounds` a
    lowest and a largest value, `priors` a mean and a standard deviation. Where the best value is
    beyond a bound, the parameter is held there, and the others are fitted again.

    All impacts have the effective `mass` [kg], by default that of the scene. `accuracy` gives the
    standard deviations of results ("restitution": 0.01); otherwise the differences tell them.
    `laws` ("LOADING" or "LOADING/UNLOADING") are tried beside each other; the best is returned, and
    all are in `laws` of the result. Points whose contact is wider than laws are valid are named;
    `outside="leave out"` fits without them. `unloading=False` fits the first loading of a record
    alone. `bootstrap` is the number of draws for the second kind of interval, such as 1000.

    Raises `ValueError` for a bad measurement, with line and column, and for parameters that the
    scene or the measurement has not; `ProgramError` for a bad scene.
    """
    names = [parameters] if isinstance(parameters, str) else list(parameters)
    points = measured(measurement, decimal=decimal, columns=columns)
    _check(points, names, mass, [*(fixed or {}), *(bounds or {}), *(priors or {})])
    for name in fixed or {}:
        if name in names:
            raise ValueError(f"{name} is free and fixed: leave it out of one of them")
    for name in {*(bounds or {}), *(priors or {})} - {*names}:
        raise ValueError(f"{name} has bounds or a prior, but it is not fitted: add it to parameters")
    if outside not in ("mark", "leave out"):
        raise ValueError(f"outside = {outside!r}; allowed are 'mark' and 'leave out'")
    if not unloading and points.kind == "record":
        points = points.without(points.part > 0)
    fits = []
    for loading in laws if laws else (None,):
        law = Law(scene_file, points, mass, {*names, *(fixed or {})}, loading)
        own = points
        if points.kind == "hardness":
            values = strengths_of(points.readings, scene_file, law)
            own = Measured("hardness", {}, {"flow_stress": values}, points.part, points.notes, points.readings)
        _check_scene(law, [*names, *(fixed or {})])
        problem = Problem(
            law,
            own,
            names,
            fixed={it: _number(it, value, law.model) for it, value in (fixed or {}).items()},
            bounds=_pairs("bounds", bounds, law.model),
            priors=_pairs("priors", priors, law.model),
            accuracy=_accuracy(accuracy, own),
        )
        fits.append(fitted(problem, leave_out=outside == "leave out", draws=bootstrap, seed=seed))
    return Fit.best(fits)


def _check(points: Measured, names: list[str], mass: float | None, others: list[str]) -> None:
    if not names:
        raise ValueError(f"parameters is empty; expected some of {', '.join(PARAMETERS)}")
    for index, name in enumerate([*names, *others]):
        if name not in PARAMETERS:
            raise ValueError(f"parameters: {name!r} can't be fitted; expected {', '.join(PARAMETERS)}")
        if name in names[:index] and index < len(names):
            raise ValueError(f"parameters names {name} twice")
        if points.kind not in PARAMETERS[name].kinds:
            why = {
                "record": "a force over depth says nothing of it",
                "impacts": "it belongs to a machine that records force and depth",
                "hardness": "readings of hardness say nothing of it",
            }[points.kind]
            needs = "rate needs speeds: " if name == "rate" else f"{name} can't be fitted here: "
            raise ValueError(needs + why)
    if mass is not None and points.kind != "impacts":
        raise ValueError(f"mass = {mass!r} has no effect on a {points.kind}: leave it out")
    if mass is not None and "mass" in points.arguments:
        raise ValueError(f"mass = {mass!r}: the measurement has a column of masses; leave one out")
    if "friction" in names and not {"tangential_restitution", "rebound_angle"} & {*points.results}:
        raise ValueError("friction needs a column `tangential restitution` or `rebound angle`")
    if points.kind == "record" and not {"zero_point"} & {*names, *others}:
        low = float(points.arguments["depth"].min())
        if low <= 0.0:
            raise ValueError(
                f"the record has a force at a depth of {low:g} m: depths count from the first touch; "
                "fit zero_point, or give it in fixed"
            )


def _check_scene(law: Law, names: Sequence[str]) -> None:
    for name in names:
        if name == "rate" and law.model is None:
            raise ValueError(f"rate needs a rate model in the scene: give {law.body}.rate")
        if name in ("yield_strength", "hardening_modulus") and law.is_power_law:
            raise ValueError(f"{law.name(name)} follows from {law.body}.power_law: there is nothing to fit")


def _number(name: str, value: Value, model: str | None) -> float:
    return _in_si(name, parameter(name, model).unit, value)


def _in_si(name: str, unit: str, value: Value) -> float:
    if isinstance(value, bool | bytes):
        raise TypeError(f"{name} = {value!r}: a number is needed")
    try:
        # what has no unit is a number
        return in_si(unit, value) if unit else float(value)
    except (ProgramError, ValueError) as error:
        why = str(error).split(": ", 1)[-1] if unit else "a number is needed"
        raise ValueError(f"{name} = {value!r}: {why}") from None


def _pairs(what: str, pairs: Pairs | None, model: str | None) -> dict[str, tuple[float, float]]:
    found = {}
    for name, pair in (pairs or {}).items():
        if isinstance(pair, str) or len(pair) != 2:
            raise ValueError(f"{what}: {name} = {pair!r}; two numbers are needed")
        first, second = (_number(name, it, model) for it in pair)
        if what == "bounds" and not first < second:
            raise ValueError(f"bounds: {name} = {pair!r}; the first must be below the second")
        if what == "priors" and not second > 0.0:
            raise ValueError(f"priors: {name} = {pair!r}; the standard deviation must be positive")
        found[name] = (first, second)
    return found


def _accuracy(accuracy: Mapping[str, Value] | None, points: Measured) -> dict[str, float]:
    found = {}
    for name, value in (accuracy or {}).items():
        if name not in points.results:
            raise ValueError(f"accuracy: {name!r} was not measured; expected {one_of(points.results)}")
        found[name] = _in_si(name, UNITS[name], value)
        if not found[name] > 0.0:
            raise ValueError(f"accuracy: {name} = {value!r} must be positive")
    return found
