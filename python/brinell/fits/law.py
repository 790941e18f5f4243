"""The law of a scene's first contact, with other numbers than the scene's.

Impacts are predicted by the program, all of them at once. The forces of a record come from an FMU of the
scene, whose parameters are set: 20 to 50 us for a point. Zero point, preload and compliance of a machine
are computed here.
"""

from __future__ import annotations

import json
import tempfile
import warnings
from collections import defaultdict
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import temporary
from ..contact import Contact
from ..errors import ContactError, ProgramError
from ..impacts import Numbers, impacts
from ..library import Library
from ..program import export, of_scene, options_of, run, tables
from .measured import Measured
from .parameters import DEFAULTS, INSTRUMENT, RATES
from .scene import BODIES, naming, of_first_contact, slow, toml, with_loading, without_readings

Flow = Mapping[str, float]
"""Values of parameters in SI units, by the names `PARAMETERS`; strength, hardening and rate are
those of the softer body."""

LARGEST_RADIUS_RATIO = 0.3
"""Contact radius over effective radius up to which laws are valid: that of FMUs and the program."""
UNYIELDING = 1e18
"""Strength [Pa] of a body that is not fitted: the largest of an FMU. The fitted body stays the
softer one."""
OBLIQUE = {"tangential_restitution", "rebound_angle"}
COLUMNS = {
    "restitution": (("restitution", 1.0),),
    "dent_depth": (("dent", 1.0),),
    "dent_diameter": (("largest_contact_radius", 2.0),),
    "contact_time": (("loading_time", 1.0), ("unloading_time", 1.0)),
    "largest_force": (("largest_force", 1.0),),
}
"""What results along the normal are made of: columns of the program, and their factors."""


class Law:
    """The law of the first contact of a scene file, for one measurement.

    `mass` [kg] replaces that of the scene's impact, where the measurement has none. `fitted` are
    the parameters that must be settable, although the scene gives none. `loading` replaces the
    loading law of the scene, "LOADING" or "LOADING/UNLOADING".
    """

    def __init__(
        self, path: str | Path, points: Measured, mass: float | None, fitted: set[str], loading: str | None = None
    ) -> None:
        self.points = points
        self._path = path
        self._last: tuple[Any, Mapping[str, Numbers]] = (None, {})
        """What was predicted last: several results are columns of one table."""
        self._folder = tempfile.TemporaryDirectory(prefix="brinell-", ignore_cleanup_errors=True)
        self.rates: dict[str, dict[str, Any]] = {}
        """The strain rates of bodies whose strength was read from a test, with all their numbers."""
        self._of_impacts = points.kind == "impacts"
        speed = float(points.arguments["speed"][0]) if self._of_impacts else None
        if "mass" in points.arguments:
            mass = float(points.arguments["mass"][0])
        # the program knows the mass of a solid ball, and tells what is wrong with a scene
        self._impact = options_of({"mass": mass, "speed": speed}, None)
        said = json.loads(of_scene("predict", path, *self._impact)[0])
        self._mass: float = said["mass"]
        self.scene = tables(path)
        for body in BODIES:
            if isinstance(self.scene.get(body, {}).get("radius"), list):
                raise ValueError(f"{path}: {body}.radius is a list: fits are those of round contacts")
        data = {**self.scene}
        if loading is not None:
            data["law"] = with_loading(data.get("law", {}), loading)
        if "elastic_restitution" in fitted:
            given = data.get("law", {})
            has_own = not isinstance(given.get("elastic_restitution", ""), str)
            data["law"] = given | ({} if has_own else {"elastic_restitution": DEFAULTS["elastic_restitution"]})
        self._friction = data.get("friction", {})
        self._data = of_first_contact(data) if self._of_impacts else slow(data)
        if "impact" in self._data:
            self._data["impact"] = {**self._data["impact"], "mass": self._mass}
        self._starts = self._parameters()
        self._forget_readings(said["rates"])
        self.law: str = loading or said["laws"][0]["law"]
        self.body = self._softer(path, fitted)
        own: dict[str, Any] = self._data[self.body]
        self.is_power_law = "power_law" in own and "yield_strength" not in own
        if (
            "hardening_modulus" in fitted
            and self._name("hardening_modulus") not in self._starts
            and not self.is_power_law
        ):
            own["hardening_modulus"] = 0.0
            try:
                self._starts = self._parameters()
            except ProgramError as error:
                raise ValueError(f"hardening_modulus can't be fitted: {error}") from error
        self.model: str | None = own.get("rate", {}).get("model")
        self.given = self._given()
        if not self._of_impacts:
            file = self._written(self._data)
            with naming(path, file):
                self._contact = Contact(Library.of(export(file, file.with_suffix(".fmu"))))
            return
        if self.model:
            # no dependence on the rate would not be one whose constant varies
            own["rate"] = own["rate"] | {self._rate: self.given["rate"] or 0.01}
        self._normal = self._written(self._data)
        self._oblique = self._written(self._oblique_data(), "oblique") if OBLIQUE & {*points.results} else None

    # the scene

    def _written(self, data: Mapping[str, Any], name: str = "scene") -> Path:
        file = Path(self._folder.name) / f"{name}.toml"
        file.write_text(toml(data), encoding="utf-8")
        return file

    def _parameters(self) -> dict[str, float]:
        """The numbers of the contact, with strengths under a slow load."""
        file = self._written(self._data)
        with naming(self._path, file), warnings.catch_warnings():
            # it was doubted already
            warnings.simplefilter("ignore")
            found: dict[str, float] = json.loads(of_scene("predict", file, *self._impact)[0])["parameters"]
        return found

    def _forget_readings(self, rates: Mapping[str, dict[str, Any] | None]) -> None:
        """Put the strength of the scene in place of a hardness, a tensile strength or that of a
        material, since a strength is fitted."""
        for body in BODIES:
            strength = self._starts.get(f"{body}.yield_strength")
            if strength is not None and not {"yield_strength", "power_law"} & {*self._data[body]}:
                # a strength that was read from a slow test has a rate, also if the scene gives none
                if rate := rates[body]:
                    self.rates[body] = rate
                kept = without_readings(self._data[body]) | {"yield_strength": strength}
                if self._of_impacts and body in self.rates:
                    kept["rate"] = self.rates[body]
                self._data[body] = kept
        self._starts = self._parameters()

    def _softer(self, path: str | Path, fitted: set[str]) -> str:
        names = {body: f"{body}.yield_strength" for body in ("target", "impactor")}
        strengths = {body: self._starts[name] for body, name in names.items() if name in self._starts}
        self._yields = bool(strengths)
        if not strengths:
            self._harder: list[str] = []
            if fitted <= {"friction", "elastic_restitution", *INSTRUMENT}:
                return "target"
            raise ValueError(f"{path}: the law {self.law} doesn't yield: it has no parameter to fit")
        # at equal strengths the target, as in an FMU
        softer = min(strengths, key=lambda body: strengths[body])
        self._harder = [body for body in strengths if body != softer]
        return softer

    def _oblique_data(self) -> dict[str, Any]:
        """The scene of oblique impacts, whose masses may be those of tables."""
        data = self._data | {"friction": {**self._friction, "coefficient": self.given["friction"]}}
        if self.scene.get("body"):
            if "mass" in self.points.arguments:
                raise ValueError(
                    f"{self._path}: the masses of oblique impacts are those of its tables [[body]]: "
                    "leave the column of masses out"
                )
            first, *others = self.scene["contact"]
            # what the first contact has of its own is in the tables of all already
            first = {key: it for key, it in first.items() if key not in BODIES}
            data |= {"body": self.scene["body"], "contact": [first, *others]}
            if "impact" in data:
                data["impact"] = {key: it for key, it in data["impact"].items() if key != "mass"}
        return data

    def _name(self, parameter: str) -> str:
        return f"{self.body}.{parameter}"

    @property
    def _rate(self) -> str:
        """The constant of the rate model."""
        return RATES[self.model or "johnson-cook"][0]

    def name(self, parameter: str) -> str:
        """The name of a parameter in the scene, or of one of the instrument."""
        if parameter in INSTRUMENT:
            return f"instrument.{parameter}"
        if parameter == "elastic_restitution":
            return "law.elastic_restitution"
        if parameter == "friction":
            return "friction.coefficient"
        return self._name(f"rate.{self._rate}" if parameter == "rate" else parameter)

    def _given(self) -> dict[str, float]:
        given = {name: 0.0 for name in INSTRUMENT} | {
            "yield_strength": self._starts.get(self._name("yield_strength"), np.nan),
            "hardening_modulus": self._starts.get(self._name("hardening_modulus"), 0.0),
            "elastic_restitution": self._starts.get("elastic_restitution", 1.0),
            "friction": float(self._friction.get("coefficient", 0.0)),
        }
        if self.model:
            given["rate"] = float(self._data[self.body]["rate"][self._rate])
        return given

    @property
    def modulus(self) -> float:
        """Effective modulus [Pa]: `1/E* = sum of (1 - nu^2)/E`; a body without E is rigid."""
        own = [body for body in BODIES if f"{body}.youngs_modulus" in self._starts]
        ratio, modulus = "{}.poissons_ratio", "{}.youngs_modulus"
        return 1.0 / sum((1.0 - self._starts[ratio.format(it)] ** 2) / self._starts[modulus.format(it)] for it in own)

    @property
    def radius(self) -> float:
        """Effective radius [m]: `1/R = sum of 1/R_i`; a target without a radius is flat."""
        radii = (f"{body}.radius" for body in BODIES)
        return 1.0 / sum(1.0 / self._starts[name] for name in radii if name in self._starts)

    @property
    def size(self) -> float:
        """The radius of the smaller body [m]: its own, or that of a rod's cross-section."""
        areas = [self._data[body]["area"] for body in BODIES if "area" in self._data[body]]
        own = [abs(self._starts[name]) for name in (f"{body}.radius" for body in BODIES) if name in self._starts]
        return min(*own, *(float(np.sqrt(area / np.pi)) for area in areas), np.inf)

    # values

    def values(self, points: Measured, flows: Sequence[Flow]) -> dict[str, Numbers]:
        """What the law says instead of each result of these points, a row for each of the `flows`; NaN
        beyond its range."""
        if points.kind == "hardness":
            return {"flow_stress": np.array([[flow["yield_strength"]] * points.count for flow in flows])}
        if points.kind == "record":
            return {"force": np.array([self._recorded(points, flow)[0] for flow in flows])}
        found = dict[str, Numbers]()
        for name in points.results:
            is_oblique = name in OBLIQUE
            table = self._predicted(points, flows, is_oblique=is_oblique)
            parts = [(name, 1.0)] if is_oblique else COLUMNS[name]
            found[name] = np.sum([size * table[column] for column, size in parts], axis=0)
        return found

    def outside(self, points: Measured, flow: Flow) -> NDArray[np.bool_]:
        """Which of the points have a contact that is wider than laws are valid."""
        if points.kind == "hardness":
            return np.zeros(points.count, dtype=bool)
        if points.kind == "record":
            radii = self._recorded(points, flow)[1]
        else:
            radii = self._predicted(points, [flow], is_oblique=False)["largest_contact_radius"][0]
        # beyond the range of the law, nothing is known
        return ~(radii <= LARGEST_RADIUS_RATIO * min(self.radius, self.size))

    def _own(self, flow: Flow) -> dict[str, float]:
        """The parameters of the contact."""
        names = () if self.is_power_law else ("yield_strength", "hardening_modulus")
        own = {self._name(it): flow[it] for it in names if self._name(it) in self._starts}
        if "elastic_restitution" in self._starts:
            own["elastic_restitution"] = flow["elastic_restitution"]
        if self.model and self._of_impacts:
            own[self._name(f"rate.{self._rate}")] = flow["rate"]
        return own | {f"{body}.yield_strength": UNYIELDING for body in self._harder}

    def _predicted(self, points: Measured, flows: Sequence[Flow], *, is_oblique: bool) -> Mapping[str, Numbers]:
        """The columns of the program for all points with each of the `flows`; NaN beyond the law."""
        rows = dict(points.arguments)
        if not is_oblique and "angle" in rows:
            # the speed of oblique impacts is that along the path
            rows["speed"] = rows["speed"] * np.cos(np.radians(rows.pop("angle")))
        if "mass" not in rows and not (is_oblique and self.scene.get("body")):
            rows["mass"] = np.full(points.count, self._mass)
        rows = {name: np.tile(column, len(flows)) for name, column in rows.items()}
        own = [self._own(flow) | ({"friction.coefficient": flow["friction"]} if is_oblique else {}) for flow in flows]
        rows |= {name: np.repeat([one[name] for one in own], points.count) for name in own[0]}
        key = (is_oblique, *(column.tobytes() for column in rows.values()))
        if self._last[0] != key:
            with warnings.catch_warnings():
                # trial values may be implausible; points outside the validity are told at the end
                warnings.simplefilter("ignore")
                table, _ = impacts((is_oblique and self._oblique) or self._normal, rows)
            shape = (len(flows), points.count)
            numbers = {name: it.reshape(shape) for name, it in table.items() if it.dtype == float}
            self._last = key, defaultdict(lambda: np.full(shape, np.nan), numbers)
        return self._last[1]

    def _recorded(self, points: Measured, flow: Flow) -> tuple[Numbers, Numbers]:
        """The force that the machine would record at each depth, and the contact radius.

        The bodies are pressed in by `depth + zero_point - compliance (force + preload)`. The force
        within the bracket is the recorded one; one step of Newton's method, by the stiffness of the
        contact, turns it into that of the law.
        """
        depth, force = points.arguments["depth"], points.arguments["force"]
        preload, compliance = flow["preload"], flow["compliance"]
        pressed = depth + flow["zero_point"] - compliance * (force + preload)
        own, count = self._own(flow), len(depth)
        found, radius = np.full(count, np.nan), np.full(count, np.nan)
        stiffness = np.zeros(count)
        contact, deepest, at, before, deep = self._contact, -np.inf, 0.0, -1, self.radius
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for index, (part, now) in enumerate(zip(points.part.tolist(), pressed.tolist(), strict=True)):
                try:
                    if part == 0:
                        # beyond its radius, the FMU says what it takes
                        self._load(at if before == 0 and now < deep else np.inf, now, own)
                        deepest = max(deepest, now)
                    else:
                        if before != part:
                            contact.reset(initial_gap=-max(deepest, now), parameters=own)
                            at = max(deepest, now)
                        # each step of a second is one of the record
                        contact.step(1.0, now - at)
                    at = now
                    before = part
                    found[index] = contact["force"]
                    radius[index] = contact["contact_radius"]
                    if compliance != 0.0:
                        stiffness[index] = contact["stiffness"]
                except ContactError:
                    before = -1
        recorded = force + (found - force - preload) / (1.0 + stiffness * compliance)
        return recorded, radius

    def _load(self, at: float, now: float, own: Mapping[str, float]) -> None:
        """Press the bodies in to the depth `now`, on the loading curve: from `at`, if they are there."""
        if now > at:
            with suppress(ContactError):
                self._contact.step(1.0, now - at)
                return
        # bodies that start pressed in are on it, too
        self._contact.reset(initial_gap=-now, parameters=own)

    def depths(self, forces: Numbers, flow: Flow) -> Numbers:
        """The depths [m] of a first loading at these forces [N], by interpolation: a start."""
        grid = self.radius * np.geomspace(1e-6, 0.5, 60)
        line = Measured("record", {"depth": grid, "force": 0.0 * grid}, {}, np.zeros(60, dtype=int))
        values = self._recorded(line, {**flow} | {name: 0.0 for name in INSTRUMENT})[0]
        known = np.isfinite(values)
        return np.asarray(np.interp(forces, values[known], grid[known]))


def strengths_of(readings: tuple[str, ...], path: str | Path, law: Law) -> Numbers:
    """The slow flow stress [Pa] of the softer body at the strain of the scene's impact, for each
    reading of its hardness."""
    scene = tables(path)
    others = ("yield_strength", "power_law", "hardening_modulus", "tangent_modulus")
    own = {key: it for key, it in without_readings(scene[law.body]).items() if key not in others}
    found = dict.fromkeys(readings, np.nan)
    with temporary.folder() as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        one = folder / "scene.toml"
        for reading in found:
            one.write_text(toml(scene | {law.body: own | {"hardness": reading}}), encoding="utf-8")
            try:
                strength = json.loads(run("predict", one)[0])["strength"]
            except ProgramError as error:
                # nobody wrote that scene
                raise ValueError(str(error).split(f"{one.name}:")[-1].split(": ", 1)[-1]) from None
            if strength is None:
                raise ValueError(f"the program gives no strength for {reading}")
            found[reading] = float(strength["yield_strength"] / strength["factor"])
    return np.array([found[it] for it in readings])
