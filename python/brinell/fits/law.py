"""The law of a scene's first contact, with other numbers than the scene's.

The forces of a record come from an FMU of the scene, whose parameters are set: 20 to 50 us for a
point. Impacts are predicted by the program, all of them at once. Zero point, preload and compliance of
a machine are computed here.
"""

from __future__ import annotations

import json
import warnings
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import temporary
from ..contact import Contact
from ..errors import ContactError, ProgramError
from ..library import Library
from ..program import export, of_scene, options_of, run, tables
from ..studies.scene import has_bodies, naming, of_impacts, toml
from ..sweeps import LISTED, range_of
from .measured import Measured
from .parameters import DEFAULTS, INSTRUMENT, RATES

Flow = Mapping[str, float]
"""Values of parameters in SI units, by the names `PARAMETERS`; strength, hardening and rate are
those of the softer body."""
Numbers = NDArray[np.float64]

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
WANTED = sorted({column for parts in COLUMNS.values() for column, _ in parts})


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
        self.rates: dict[str, dict[str, Any]] = {}
        """The strain rates of bodies whose strength was read from a test, with all their numbers."""
        self._of_impacts = points.kind == "impacts"
        speed = float(points.arguments["speed"][0]) if self._of_impacts else None
        if "mass" in points.arguments:
            mass = float(points.arguments["mass"][0])
        # the program knows the mass of a solid ball, and tells what is wrong with a scene
        options = options_of({"mass": mass, "speed": speed}, None)
        said = json.loads(of_scene("predict", path, *options)[0])
        self._mass: float = said["mass"]
        self._said_rates: dict[str, dict[str, Any] | None] = said["rates"]
        self.scene = tables(path)
        for body in ("impactor", "target"):
            if isinstance(self.scene.get(body, {}).get("radius"), list):
                raise ValueError(f"{path}: {body}.radius is a list: fits are those of round contacts")
        data = {**self.scene}
        if loading is not None:
            data["law"] = with_loading(data.get("law", {}), loading)
        self._friction = {**data.pop("friction", {})}
        if "elastic_restitution" in fitted:
            data["law"] = {"elastic_restitution": DEFAULTS["elastic_restitution"]} | {
                key: it
                for key, it in data.get("law", {}).items()
                if key != "elastic_restitution" or not isinstance(it, str)
            }
        self._data = of_impacts(data, self._mass) if self._of_impacts else _slow(data)
        losses = {"elastic_restitution"} & {*self._data.get("law", ())}
        self._is_lossy = bool(losses | ({"plate_thickness"} & {*self._data["target"]}))
        self._open()
        if self._forget_readings():
            self._open()
        self.law: str = loading or said["laws"][0]["law"]
        self.body = self._softer(path, fitted)
        own: dict[str, Any] = self._data[self.body]
        self.is_power_law = "power_law" in own and "yield_strength" not in own
        if (
            "hardening_modulus" in fitted
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

    # the scene

    def _open(self) -> None:
        """Export the FMU, and make its instance."""
        # with a loss, the FMU would have the strength of the scene's impact
        data = _without_rates(self._data) if self._is_lossy else self._data
        with temporary.folder() as folder:
            path = folder / "scene.toml"
            path.write_text(toml(data), encoding="utf-8")
            with naming(self._path, path):
                library = Library.of(export(path, folder / "unit.fmu"))
        parameters = (one for one in library.variables.values() if one.causality == "parameter")
        self._starts = {one.name: float(one.start) for one in parameters}
        self._contact = Contact(library)

    def _forget_readings(self) -> bool:
        """Put the strength of the scene in place of a hardness, a tensile strength or that of a
        material, since a strength is fitted; return whether there was one."""
        found = False
        for body in ("impactor", "target"):
            strength = self._starts.get(f"{body}.yield_strength")
            if strength is not None and not {"yield_strength", "power_law"} & {*self._data[body]}:
                # a strength that was read from a slow test has a rate, also if the scene gives none
                if rate := self._said_rates[body]:
                    self.rates[body] = rate
                kept = without_readings(self._data[body]) | {"yield_strength": strength}
                if self._of_impacts and body in self.rates:
                    kept["rate"] = self.rates[body]
                self._data[body] = kept
                found = True
        return found

    def _softer(self, path: str | Path, fitted: set[str]) -> str:
        strengths = {
            body: self._starts[f"{body}.yield_strength"]
            for body in ("target", "impactor")
            if f"{body}.yield_strength" in self._starts
        }
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

    def _name(self, parameter: str) -> str:
        return f"{self.body}.{parameter}"

    def name(self, parameter: str) -> str:
        """The name of a parameter in the scene, or of one of the instrument."""
        if parameter in INSTRUMENT:
            return f"instrument.{parameter}"
        if parameter == "elastic_restitution":
            return "law.elastic_restitution"
        if parameter == "friction":
            return "friction.coefficient"
        if parameter == "rate" and self.model:
            return self._name(f"rate.{RATES[self.model][0]}")
        return self._name(parameter)

    def _given(self) -> dict[str, float]:
        given = {name: 0.0 for name in INSTRUMENT} | {
            "yield_strength": self._starts.get(self._name("yield_strength"), np.nan),
            "hardening_modulus": self._starts.get(self._name("hardening_modulus"), 0.0),
            "elastic_restitution": self._starts.get("elastic_restitution", 1.0),
            "friction": float(self._friction.get("coefficient", 0.0)),
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
        return 1.0 / sum((1.0 - self._starts[f"{body}.poissons_ratio"] ** 2) / it for body, it in moduli.items())

    @property
    def radius(self) -> float:
        """Effective radius [m]: `1/R = sum of 1/R_i`; a target without a radius is flat."""
        radii = (f"{body}.radius" for body in ("impactor", "target"))
        return 1.0 / sum(1.0 / self._starts[name] for name in radii if name in self._starts)

    @property
    def size(self) -> float:
        """The radius of the smaller body [m]: its own, or that of a rod's cross-section."""
        radii = [f"{body}.radius" for body in ("impactor", "target")]
        areas = [self._data[body]["area"] for body in ("impactor", "target") if "area" in self._data[body]]
        own = [abs(self._starts[name]) for name in radii if name in self._starts]
        return min(*own, *(float(np.sqrt(area / np.pi)) for area in areas), np.inf)

    # values

    def values(self, points: Measured, flow: Flow) -> dict[str, Numbers]:
        """What the law says instead of each result of these points; NaN beyond its range."""
        if points.kind == "hardness":
            return {"flow_stress": np.full(points.count, flow["yield_strength"])}
        with warnings.catch_warnings():
            # trial values may be implausible; points outside the validity are told at the end
            warnings.simplefilter("ignore")
            if points.kind == "record":
                return {"force": self._recorded(points, flow)[0]}
            return self._impacts(points, flow)

    def outside(self, points: Measured, flow: Flow) -> NDArray[np.bool_]:
        """Which of the points have a contact that is wider than laws are valid."""
        if points.kind == "hardness":
            return np.zeros(points.count, dtype=bool)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            if points.kind == "record":
                radii = self._recorded(points, flow)[1]
            else:
                radii = self._table(points, flow)["largest_contact_radius"]
        # beyond the range of the law, nothing is known
        return ~(radii <= LARGEST_RADIUS_RATIO * min(self.radius, self.size))

    def _own(self, flow: Flow) -> dict[str, float]:
        """The parameters of the FMU."""
        names = ("yield_strength", "hardening_modulus")
        own = {self._name(it): flow[it] for it in names if self._name(it) in self._starts}
        if "elastic_restitution" in self._starts and "elastic_restitution" in flow:
            own["elastic_restitution"] = flow["elastic_restitution"]
        return own | {f"{body}.yield_strength": UNYIELDING for body in self._harder}

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
        plain = {**flow} | {name: 0.0 for name in INSTRUMENT}
        values = self.values(line, plain)["force"]
        known = np.isfinite(values)
        found: Numbers = np.interp(forces, values[known], grid[known])
        return found

    def _impacts(self, points: Measured, flow: Flow) -> dict[str, Numbers]:
        found, names = dict[str, Numbers](), set(points.results)
        if OBLIQUE & names:
            found |= self._oblique(points, flow)
        if names - OBLIQUE:
            table = self._table(points, flow)
            for name in names - OBLIQUE:
                found[name] = np.sum([size * table[column] for column, size in COLUMNS[name]], axis=0)
        return {name: found[name] for name in points.results}

    def _masses(self, points: Measured) -> Numbers:
        return points.arguments.get("mass", np.full(points.count, self._mass))

    def _table(self, points: Measured, flow: Flow) -> dict[str, Numbers]:
        """The program's predictions along the normal, for each point."""
        angles = np.radians(points.arguments.get("angle", np.zeros(points.count)))
        # the speed of oblique impacts is that along the path
        speeds = points.arguments["speed"] * np.cos(angles)
        # over a speed, a table has the strength of one impact
        follows = bool(self.model or self.is_power_law)
        groups = {"mass": self._masses(points)} | ({"speed": speeds} if follows else {})
        return self._swept(self.changed(flow), "speed", speeds, groups, WANTED)

    def _oblique(self, points: Measured, flow: Flow) -> dict[str, Numbers]:
        data = self.changed(flow) | {"friction": self._friction | {"coefficient": flow["friction"]}}
        for key in ("coupling", "fmu"):
            data.pop(key, None)
        groups = {"speed": points.arguments["speed"], "mass": self._masses(points)}
        if has_bodies(self.scene):
            if "mass" in points.arguments:
                raise ValueError(
                    f"{self._path}: the masses of oblique impacts are those of its tables [[body]]: "
                    "leave the column of masses out"
                )
            del groups["mass"]
            first, *others = self.scene["contact"]
            # what the first contact has of its own is in the tables of all already
            first = {key: it for key, it in first.items() if key not in ("impactor", "target")}
            data |= {"body": self.scene["body"], "contact": [first, *others]}
            if "impact" in data:
                data["impact"] = {key: it for key, it in data["impact"].items() if key != "mass"}
        return self._swept(data, "angle", points.arguments["angle"], groups, sorted(OBLIQUE))

    def _swept(
        self, data: Mapping[str, Any], name: str, values: Numbers, groups: Mapping[str, Numbers], wanted: Sequence[str]
    ) -> dict[str, Numbers]:
        """Columns of the program's tables over the quantity `name`, one table for each group of points
        that agree in the others; NaN beyond the law."""
        found = {column: np.full(len(values), np.nan) for column in wanted}
        keys, group_of = np.unique(np.column_stack([*groups.values()]), axis=0, return_inverse=True)

        def one(number: int) -> None:
            inside = np.flatnonzero(group_of.ravel() == number)
            different, places = np.unique(values[inside], return_inverse=True)
            options = options_of(dict(zip(groups, keys[number].tolist(), strict=True)), None)
            with suppress(ProgramError):
                parts = []
                for at in range(0, len(different), LISTED):
                    axis = range_of(name, different[at : at + LISTED])
                    said = of_scene("predict", path, f"--sweep={name}={axis}", *options)[0]
                    parts.append(json.loads(said)["laws"][0])
                for column in wanted:
                    # a number that the law doesn't have is null
                    found[column][inside] = np.array(sum((it[column] for it in parts), []), dtype=float)[places]

        with temporary.folder() as folder, warnings.catch_warnings(), ThreadPoolExecutor() as pool:
            warnings.simplefilter("ignore")
            path = folder / "scene.toml"
            path.write_text(toml(data), encoding="utf-8")
            list(pool.map(one, range(len(keys))))
        return found

    def changed(self, flow: Flow) -> dict[str, Any]:
        """The scene of impacts with these values."""
        data = {**self._data, self.body: {**self._data[self.body]}}
        own = data[self.body]
        if self._yields and not self.is_power_law:
            own["yield_strength"] = flow["yield_strength"]
            own.pop("tangent_modulus", None)
            if self._name("hardening_modulus") in self._starts:
                own["hardening_modulus"] = flow["hardening_modulus"]
        if self.model:
            own["rate"] = own["rate"] | {RATES[self.model][0]: flow["rate"]}
        if "elastic_restitution" in self._starts:
            data["law"] = data["law"] | {"elastic_restitution": flow["elastic_restitution"]}
        for body in self._harder:
            kept = {key: it for key, it in data[body].items() if key not in ("rate", "power_law")}
            data[body] = kept | {"yield_strength": UNYIELDING}
        return data


def with_loading(law: Mapping[str, Any], loading: str) -> dict[str, Any]:
    """The table `law` of a scene with another law, and the same losses."""
    first, _, second = loading.partition("/")
    kept = {key: it for key, it in law.items() if key == "elastic_restitution"}
    return kept | {"loading": first} | ({"unloading": second} if second else {})


def without_readings(body: Mapping[str, Any]) -> dict[str, Any]:
    """A body without hardness, tensile strength and tensile test."""
    readings = {"hardness", "tensile_strength", "tensile_test", "hardening_exponent"}
    return {key: it for key, it in body.items() if key not in readings}


def _slow(data: Mapping[str, Any]) -> dict[str, Any]:
    """The scene of a slow first loading: without a mass, a rate, and losses."""
    made = of_impacts(data, 1.0)
    made["fmu"] = {"outputs": ["contact_radius", "stiffness"]}
    for key in ("coupling", "impact"):
        made.pop(key, None)
    made["law"] = {key: it for key, it in made.get("law", {}).items() if key != "elastic_restitution"}
    made["target"].pop("plate_thickness", None)
    return _without_rates(made)


def _without_rates(data: Mapping[str, Any]) -> dict[str, Any]:
    bodies = ("impactor", "target")
    return {**data} | {body: {key: it for key, it in data[body].items() if key != "rate"} for body in bodies}


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
