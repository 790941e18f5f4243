"""The law of a scene's first contact, with other strengths, hardening moduli and rate constants.

Numbers come from an FMU of the scene, whose parameters are set. The constants of a strain rate are
no parameters of an FMU: with others than the scene's, the program predicts each impact.
"""

from __future__ import annotations

import tempfile
import warnings
from bisect import bisect_left
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..contact import Contact
from ..errors import ContactError, ProgramError
from ..library import Library
from ..program import Prediction, export, predict, tables
from ..studies.impacts import impact
from ..studies.scene import of_impacts, toml
from .measured import Measured

Flow = Mapping[str, float]
"""Yield strength [Pa], hardening modulus [Pa] and rate constant of the softer body, by the names
`PARAMETERS`."""
Numbers = NDArray[np.float64]

PARAMETERS = ("yield_strength", "hardening_modulus", "rate")
"""What can be fitted."""
RATES = {"johnson-cook": ("c", ""), "cowper-symonds": ("d", "1/s")}
"""The constant of each rate model that can be fitted, with its unit."""
LARGEST_RADIUS_RATIO = 0.3
"""Contact radius over effective radius up to which laws are valid: that of FMUs and the program."""
UNYIELDING = 1e18
"""Strength [Pa] of a body that is not fitted: the largest of an FMU. The fitted body stays the
softer one."""


class Law:
    """The law of the first contact of a scene file, for one measurement.

    `mass` [kg] replaces that of the scene's impact. `hardens` is whether the hardening modulus must
    be settable, although the scene gives none.
    """

    def __init__(
        self, path: str | Path, points: Measured, mass: float | None, *, hardens: bool
    ) -> None:
        self._of_impacts = points.kind == "restitution"
        # the program knows the mass of a solid ball, and tells what is wrong with a scene
        found = predict(path, mass=mass, speed=float(points.at[0]) if self._of_impacts else None)
        self._mass = found.mass
        data = tables(path)
        # all impacts are along the normal
        data.pop("friction", None)
        self._data = of_impacts(data, self._mass) if self._of_impacts else _slow(data)
        losses = {"elastic_restitution"} & {*self._data.get("law", ())}
        self._is_lossy = bool(losses | ({"plate_thickness"} & {*self._data["target"]}))
        self._open()
        if self._forget_readings():
            self._open()
        self.body = self._softer(path, found.law)
        own: dict[str, Any] = self._data[self.body]
        self.is_power_law = "power_law" in own and "yield_strength" not in own
        if (
            hardens
            and not self.is_power_law
            and self._name("hardening_modulus") not in self._starts
        ):
            own["hardening_modulus"] = 0.0
            try:
                self._open()
            except ProgramError as error:
                raise ValueError(f"hardening_modulus can't be fitted: {error}") from error
        self.model: str | None = own.get("rate", {}).get("model")
        self.given = self._given()
        # an FMU finds anew in each impact neither a power law nor a rate beside another loss
        self._unit_follows = not self.is_power_law and not (self.model and self._is_lossy)

    def _open(self) -> None:
        """Export the FMU, and make its instance."""
        # with a loss, the FMU would have the strength of the scene's impact
        data = _without_rates(self._data) if self._is_lossy else self._data
        with tempfile.TemporaryDirectory(prefix="brinell-") as folder:
            path = Path(folder) / "scene.toml"
            path.write_text(toml(data), encoding="utf-8")
            library = Library.of(export(path, Path(folder) / "unit.fmu"))
        parameters = (one for one in library.variables.values() if one.causality == "parameter")
        self._starts = {one.name: float(one.start) for one in parameters}
        self._contact = Contact(library)

    def _forget_readings(self) -> bool:
        """Put the strength of the scene in place of a hardness, a tensile strength or that of a material,
        since a strength is fitted; return whether there was one."""
        readings = {"hardness", "tensile_strength", "hardening_exponent"}
        found = False
        for body in ("impactor", "target"):
            table = self._data[body]
            strength = self._starts.get(f"{body}.yield_strength")
            if strength is not None and not {"yield_strength", "power_law"} & {*table}:
                kept = {key: it for key, it in table.items() if key not in readings}
                self._data[body] = kept | {"yield_strength": strength}
                found = True
        return found

    def _softer(self, path: str | Path, law: str) -> str:
        strengths = {
            body: self._starts[f"{body}.yield_strength"]
            for body in ("target", "impactor")
            if f"{body}.yield_strength" in self._starts
        }
        if not strengths:
            raise ValueError(f"{path}: the law {law} doesn't yield: it has no parameter to fit")
        # at equal strengths the target, as in an FMU
        softer = min(strengths, key=lambda body: strengths[body])
        self._harder = [body for body in strengths if body != softer]
        return softer

    def _name(self, parameter: str) -> str:
        return f"{self.body}.{parameter}"

    def name(self, parameter: str) -> str:
        """The name of a parameter in the scene."""
        return self._name(
            f"rate.{RATES[self.model][0]}" if parameter == "rate" and self.model else parameter
        )

    def unit(self, parameter: str) -> str:
        """Its SI unit."""
        return RATES[self.model][1] if parameter == "rate" and self.model else "Pa"

    def _given(self) -> dict[str, float]:
        given = {
            "yield_strength": self._starts[self._name("yield_strength")],
            "hardening_modulus": self._starts.get(self._name("hardening_modulus"), 0.0),
        }
        if self.model:
            given["rate"] = float(self._data[self.body]["rate"][RATES[self.model][0]])
        return given

    @property
    def modulus(self) -> float:
        """Effective modulus [Pa]: `1/E* = sum of (1 - nu^2)/E`; a body without E is rigid."""
        moduli = {
            body: self._starts[f"{body}.youngs_modulus"]
            for body in ("impactor", "target")
            if f"{body}.youngs_modulus" in self._starts
        }
        return 1.0 / sum(
            (1.0 - self._starts[f"{body}.poissons_ratio"] ** 2) / it for body, it in moduli.items()
        )

    @property
    def _radius(self) -> float:
        """Effective radius [m]: `1/R = sum of 1/R_i`; a target without a radius is flat."""
        radii = (f"{body}.radius" for body in ("impactor", "target"))
        return 1.0 / sum(1.0 / self._starts[name] for name in radii if name in self._starts)

    def values(self, at: Numbers, flow: Flow) -> Numbers:
        """Restitutions at closing speeds [m/s], or forces [N] of a slow first loading to depths
        [m]; NaN beyond the range of the law."""
        if not self._of_impacts:
            return self._by_unit(at, flow, self._force)
        if self._unit_follows and flow.get("rate") == self.given.get("rate"):
            return self._by_unit(at, flow, self._restitution)
        return np.array(
            [np.nan if it is None else it.restitution for it in self._predicted(at, flow)]
        )

    def outside(self, at: Numbers, flow: Flow) -> Numbers:
        """Those of the ascending arguments `at` whose contact is wider than laws are valid."""
        if not self._of_impacts:
            radii = self._by_unit(
                at, flow, lambda depth, own: self._force(depth, own, "contact_radius")
            )
            return at[radii > LARGEST_RADIUS_RATIO * self._radius]

        def is_wide(speed: float) -> bool:
            it = self._predicted(np.array([speed]), flow)[0]
            return it is None or it.largest_contact_radius > LARGEST_RADIUS_RATIO * self._radius

        # the faster an impact, the wider its contact
        return at[bisect_left(at.tolist(), True, key=is_wide) :]

    def _by_unit(
        self, at: Numbers, flow: Flow, value: Callable[[float, dict[str, float]], float]
    ) -> Numbers:
        names = [name for name in PARAMETERS if self._name(name) in self._starts]
        own = {self._name(name): flow[name] for name in names}
        own |= {f"{body}.yield_strength": UNYIELDING for body in self._harder}
        found = np.full(len(at), np.nan)
        with warnings.catch_warnings():
            # trial values may be implausible; points outside the validity are told at the end
            warnings.simplefilter("ignore")
            for index, argument in enumerate(at.tolist()):
                try:
                    found[index] = value(argument, own)
                except ContactError:
                    pass
        return found

    def _force(self, depth: float, own: dict[str, float], output: str = "force") -> float:
        # bodies that start pressed in are on the loading curve
        self._contact.reset(initial_gap=-depth, parameters=own)
        return float(self._contact[output])

    def _restitution(self, speed: float, own: dict[str, float]) -> float:
        return impact(self._contact, {"speed": speed, "mass": self._mass, **own})[0]

    def _predicted(self, speeds: Numbers, flow: Flow) -> list[Prediction | None]:
        """The program's predictions; None beyond the range of the law."""
        data = {**self._data, self.body: {**self._data[self.body]}}
        own = data[self.body]
        if not self.is_power_law:
            own["yield_strength"] = flow["yield_strength"]
            own.pop("tangent_modulus", None)
            if self._name("hardening_modulus") in self._starts:
                own["hardening_modulus"] = flow["hardening_modulus"]
        if self.model:
            own["rate"] = own["rate"] | {RATES[self.model][0]: flow["rate"]}
        for body in self._harder:
            kept = {key: it for key, it in data[body].items() if key not in ("rate", "power_law")}
            data[body] = kept | {"yield_strength": UNYIELDING}
        with tempfile.TemporaryDirectory(prefix="brinell-") as folder, warnings.catch_warnings():
            warnings.simplefilter("ignore")
            path = Path(folder) / "scene.toml"
            path.write_text(toml(data), encoding="utf-8")

            def one(speed: float) -> Prediction | None:
                try:
                    return predict(path, mass=self._mass, speed=speed)
                except ProgramError:
                    return None

            with ThreadPoolExecutor() as pool:
                return list(pool.map(one, speeds.tolist()))


def _slow(data: Mapping[str, Any]) -> dict[str, Any]:
    """The scene of a slow first loading: without a mass, a rate, and losses."""
    made = of_impacts(data, 1.0)
    made["fmu"] = {"outputs": ["contact_radius"]}
    for key in ("coupling", "impact"):
        made.pop(key, None)
    made["law"] = {
        key: it for key, it in made.get("law", {}).items() if key != "elastic_restitution"
    }
    made["target"].pop("plate_thickness", None)
    return _without_rates(made)


def _without_rates(data: Mapping[str, Any]) -> dict[str, Any]:
    bodies = ("impactor", "target")
    return {**data} | {
        body: {key: it for key, it in data[body].items() if key != "rate"} for body in bodies
    }
