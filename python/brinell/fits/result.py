"""The result of a fit."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import temporary
from ..prediction import quantity
from .measured import UNITS, Kind
from .parameters import RATES
from .scene import toml, with_loading, without_readings

Columns = dict[str, NDArray[np.float64]]


@dataclass(frozen=True)
class Estimate:
    """A fitted parameter, in its SI unit."""

    name: str
    """Its name in the scene."""
    unit: str
    scene: float
    """The scene's value."""
    value: float
    interval: tuple[float, float] | None
    """95 % confidence interval, linearised, if the measurement gives one."""
    doubt: str | None
    """The reason why the measurement does not determine the parameter."""
    bootstrap: tuple[float, float] | None = None
    """95 % confidence interval of the bootstrap, if it was asked for."""

    def __str__(self) -> str:
        words = f"{self.name}: {quantity(self.value, self.unit)}"
        for interval, kind in ((self.interval, ""), (self.bootstrap, "bootstrap: ")):
            if interval:
                low, high = (quantity(it, self.unit) for it in interval)
                words += f", {kind}with 95 % confidence {low} to {high}"
        if self.doubt:
            words += f" ({self.doubt})"
        if self.name.startswith("instrument."):
            return f"{words}."
        return f"{words}; in the scene {quantity(self.scene, self.unit)}."


@dataclass(frozen=True)
class Fit:
    """The parameters that explain a measurement; `print` tells all but the points."""

    kind: Kind
    """What was measured: "impacts", "record" or "hardness"."""
    law: str
    estimates: tuple[Estimate, ...]
    count: int
    """Number of points that were fitted."""
    left_out: int
    """Number of points besides, outside the validity of the law."""
    rms: Mapping[str, float]
    """Root mean square of the differences that remain, for each kind of result, in SI units."""
    rms_of_scene: Mapping[str, float]
    """The same with the scene's values."""
    notes: tuple[str, ...]
    """Remarks on the quality of the fit."""
    columns: tuple[str, ...]
    """What was read: columns, units, and what was not used."""
    argument: str = field(repr=False)
    points: Columns = field(repr=False)
    """The points in SI units: arguments, and for each result the values "measured", by the "scene"
    and "fitted": `points["restitution, fitted"]`."""
    data: Mapping[str, Any] = field(repr=False)
    """The tables of the scene that was fitted."""
    body: str = field(repr=False)
    flow: Mapping[str, float] = field(repr=False)
    rates: Mapping[str, Mapping[str, Any]] = field(repr=False)
    laws: tuple[Fit, ...] = field(default=(), repr=False)
    """The fits of all laws that were asked for, the best first."""

    @staticmethod
    def best(fits: Sequence[Fit]) -> Fit:
        """The best of the fits of several laws, with a note on the others."""
        if len(fits) == 1:
            return fits[0]
        ordered = sorted(fits, key=lambda one: one._misfit())
        first, second = ordered[0], ordered[1]
        listed = "; ".join(f"{one.law}: {one._differences(one.rms)}" for one in ordered)
        note = f"Of the laws asked, {first.law} explains the points best ({listed})."
        # by Akaike's criterion for equal numbers of parameters
        if first.count * (second._misfit() - first._misfit()) < 2.0:
            note += f" {second.law} is as good: the points don't tell them apart."
        return replace(first, notes=(*first.notes, note), laws=tuple(ordered))

    def _misfit(self) -> float:
        """Logarithm of the mean square difference, over all kinds of results."""
        return float(sum(2.0 * math.log(max(it, 1e-300)) for it in self.rms.values()))

    @property
    def values(self) -> dict[str, float]:
        """The fitted values in SI units, by their names in the scene."""
        return {estimate.name: estimate.value for estimate in self.estimates}

    @staticmethod
    def _differences(rms: Mapping[str, float]) -> str:
        named = len(rms) > 1
        return ", ".join(
            quantity(it, UNITS[name]) + (f" ({name.replace('_', ' ')})" if named else "") for name, it in rms.items()
        )

    def __str__(self) -> str:
        rms = (
            f"{self.count} measured points, law {self.law}. Root-mean-square difference with the "
            f"scene's values: {self._differences(self.rms_of_scene)}; with the fitted ones: "
            f"{self._differences(self.rms)}."
        )
        return "\n".join([*self.columns, rms, *map(str, self.estimates), *self.notes])

    def scene(self, path: str | Path | None = None) -> str:
        """The scene with the fitted numbers, ready to export; it is also written to `path`."""
        data = {**self.data}
        first = data.get("contact", [{}])[0]
        # a contact may have a body of its own
        of_contact = first.get(self.body, {})
        if {"yield_strength", "hardness", "tensile_strength", "tensile_test", "material"} & {*of_contact}:
            own = {**first, self.body: self._body(of_contact)}
            data["contact"] = [own, *data["contact"][1:]]
        else:
            data[self.body] = self._body(data.get(self.body, {}))
        law = {**data.get("law", {})}
        if self.law != "" and self.laws:
            law = with_loading(law, self.law)
        if "law.elastic_restitution" in self.values:
            law["elastic_restitution"] = self.values["law.elastic_restitution"]
        if law:
            data["law"] = law
        if "friction.coefficient" in self.values:
            coefficient = self.values["friction.coefficient"]
            data["friction"] = {**data.get("friction", {}), "coefficient": coefficient}
        lines = [f"# fitted: {it}" for it in map(str, self.estimates)]
        text = "\n".join(lines) + "\n" + toml(data)
        if path is not None:
            with temporary.draft(Path(path)) as whole:
                whole.write_text(text, encoding="utf-8")
        return text

    def _body(self, given: Mapping[str, Any]) -> dict[str, Any]:
        """A body with the fitted numbers."""
        fitted = {it.name.removeprefix(f"{self.body}.").split(".")[0] for it in self.estimates}
        if not fitted & {"yield_strength", "hardening_modulus", "rate"}:
            return {**given}
        body = without_readings(given)
        if "yield_strength" in fitted or len(body) < len(given):
            body["yield_strength"] = self.flow["yield_strength"]
        if self.body in self.rates:
            body["rate"] = dict(self.rates[self.body])
        if "hardening_modulus" in fitted:
            body.pop("tangent_modulus", None)
            body["hardening_modulus"] = self.flow["hardening_modulus"]
        if "rate" in fitted:
            key = RATES[body["rate"]["model"]][0]
            body["rate"] = {**body["rate"], key: self.flow["rate"]}
        return body

    def plot(self, path: str | Path | None = None) -> Any:
        """Draw measurement, scene and fit with matplotlib, and the differences below; return the
        figure. It is also written to `path`, whose extension selects the format."""
        from .picture import draw

        return draw(self, path)
