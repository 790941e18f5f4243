"""The variables of an FMU: its contacts, and the parameters that a caller refers to."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from ctypes import c_double, c_int, c_uint
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import ContactError, UnknownName, nearest
from .library import WARNING, Instance, Library
from .program import in_si

RATE = "indentation_rate"
Numbers = float | Sequence[float] | NDArray[np.float64]
"""One number, or one for each contact of the FMU."""
Texts = str | Sequence[str]
"""One number with its unit, or one for each contact of the FMU: "400 MPa"."""
Gaps = Numbers | Texts | Mapping[str, float | str]
"""Like `Numbers` or `Texts`, or a mapping from the names of contacts."""
Parameters = Mapping[str, Numbers | Texts]
"""By name. A parameter that each contact has for itself takes one number for all, or one for each."""


class Reading:
    """Variables that are read together. Arrays for C are made once."""

    def __init__(self, references: Any, is_real: bool, shape: tuple[int, ...]) -> None:
        self._function = "GetReal" if is_real else "GetInteger"
        self._values = ((c_double if is_real else c_int) * len(references))()
        self._shown = np.ctypeslib.as_array(self._values).reshape(shape)
        self._references = references

    def __call__(self, instance: Instance) -> Any:
        """Their values: a number, or an array."""
        get, values = instance.functions["fmi2" + self._function], self._values
        if get(instance.component, self._references, len(values), values) > WARNING:
            raise instance.refusal(self._function)
        return values[0] if self._shown.ndim == 0 else self._shown.copy()


class Variables:
    """The variables of an FMU, read once from its description."""

    def __init__(self, library: Library) -> None:
        self._all = library.variables
        self._path = library.path
        self._readings: dict[str, Reading] = {}
        rates = self.owners(RATE, "input")
        if not rates:
            raise ContactError(f"{self._path} has no input {RATE}: it is not an FMU of Brinell")
        self.rates = rates
        self.contacts = tuple(name[: -len(RATE)].rstrip(".") for name in rates)
        self.outputs = tuple(n for n, it in self._all.items() if it.causality == "output")
        self.parameters = tuple(n for n, it in self._all.items() if it.causality == "parameter")
        # only the description distinguishes them: effective_mass may be a constant, or belong to the damping
        texts = [self._all[name].description or "" for name in rates]
        self.knows_mass = any("moves the bodies" in text for text in texts)
        mean = [self._all[name].description or "" for name in self.owners("mean_force")]
        self.is_for_next_step = any("over the next step" in text for text in mean)
        # in the order of the contacts, if each has one
        self.masses = self.every("effective_mass") or self.owners("effective_mass")
        self._gap_names = self.owners("initial_gap")
        # the upper triangle, row by row
        self.inverse_masses = [name for name in self._all if name.startswith("inverse_mass[")]
        self.mass_is_settable = bool(self.masses) and all(
            self._all[name].causality == "input" or self._all[name].variability == "tunable" for name in self.masses
        )

    def __contains__(self, name: object) -> bool:
        return name in self._all

    def is_real(self, name: str) -> bool:
        """Whether fmi2GetReal reads it; all other variables are integers."""
        return bool(self._all[name].type == "Real")

    def every(self, name: str) -> list[str]:
        """The variable `name` of each contact; empty if a contact lacks it."""
        names = [f"{contact}.{name}" if contact else name for contact in self.contacts]
        return names if all(name in self._all for name in names) else []

    def components(self, name: str) -> list[str]:
        """The variable `name` of each contact, or its components `name[1]` and `name[2]`, those of
        one contact behind each other; empty if a contact lacks it."""
        whole, parts = self.every(name), (self.every(f"{name}[1]"), self.every(f"{name}[2]"))
        return whole or [it for both in zip(*parts, strict=True) for it in both]

    @property
    def directions(self) -> int:
        """The number of tangential directions, 0 without friction."""
        return len(self.components("tangential_rate")) // len(self.contacts)

    def reading(self, name: str) -> Reading:
        """Any variable by its name. With several contacts, the plain name of an output is an array over
        the contacts; with two tangential directions, of pairs."""
        found = self._readings.get(name)
        if found is not None:
            return found
        names = [name] if name in self._all else self.components(name)
        if not names:
            raise self.unknown("variable", name)
        # what each contact has, and how many of it
        sizes = (len(self.contacts), len(names) // len(self.contacts))
        shape = () if len(names) == 1 else tuple(size for size in sizes if size > 1)
        made = Reading(self.references(names), self.is_real(names[0]), shape)
        self._readings[name] = made
        return made

    def owners(self, name: str, causality: str | None = None) -> list[str]:
        """All variables with this name, with or without the name of a contact or group in front."""
        return [
            it
            for it, variable in self._all.items()
            if (it == name or it.endswith("." + name)) and causality in (None, variable.causality)
        ]

    def references(self, names: Sequence[str]) -> Any:
        """Value references as a C array."""
        return (c_uint * len(names))(*[self._all[name].valueReference for name in names])

    def unknown(self, kind: str, name: object, names: Sequence[str] | None = None) -> UnknownName:
        """The error for an unknown name."""
        names = tuple(self._all) if names is None else names
        shown = ", ".join(names[:40]) + (", ..." if len(names) > 40 else "")
        near = nearest(name, names)
        return UnknownName(f"{self._path.name} has no {kind} {name!r}{near}; there are: {shown or 'none'}")

    def given(self, gap: Gaps | None, parameters: Parameters | None, keywords: Parameters) -> dict[str, float]:
        """The parameters that a caller passes in three ways, under their own names."""
        given: dict[str, Numbers | Texts] = dict(parameters or {})
        if keywords:
            known = {_plain(name): name for name in self.parameters}
            # a parameter that each contact has for itself is known by the part of its name after the contact
            for contact in self.contacts[:1]:
                behind = contact + "."
                own = [name for name in self.parameters if name.startswith(behind)]
                known = {_plain(name[len(behind) :]): name[len(behind) :] for name in own} | known
            for keyword, value in keywords.items():
                given[known.get(keyword, keyword)] = value
        if gap is not None:
            given |= self._gaps(gap)
        all_of_them: dict[str, float] = {}
        known_names = set(self.parameters)
        for name, value in given.items():
            if name in known_names:
                all_of_them[name] = _parameter(name, value)
                continue
            own = self.every(name)
            if not own or not known_names.issuperset(own):
                raise self.unknown("parameter", name, self.parameters)
            all_of_them |= zip(own, self._each(name, value), strict=True)
        return all_of_them

    def _each(self, name: str, value: Numbers | Texts) -> list[float]:
        """A number for each contact."""
        count = len(self.contacts)
        if isinstance(value, str | bytes) or np.ndim(value) == 0:
            return [_parameter(name, value)] * count
        if np.shape(value) != (count,):
            raise ContactError(f"{name} = {value!r}: it takes one number, or {count}, one for each contact")
        return [_parameter(name, one) for one in np.asarray(value).tolist()]

    def _gaps(self, gap: Gaps) -> Parameters:
        names = self._gap_names
        if not names:
            raise self.unknown("parameter", "initial_gap", self.parameters)
        if isinstance(gap, Mapping):
            return {f"{contact}.initial_gap": value for contact, value in gap.items()}
        if isinstance(gap, float) or np.ndim(gap) == 0:
            return dict.fromkeys(names, _parameter("initial_gap", gap))
        own = self.every("initial_gap")
        if np.shape(gap) != (len(self.contacts),) or not own:
            raise ContactError(
                f"initial_gap = {gap}: the FMU has {len(self.contacts)} contacts, "
                f"and the parameters {', '.join(names)}; "
                'parameters_per_contact = ["initial_gap"] in its scene gives each its own'
            )
        return dict(zip(own, [_parameter("initial_gap", one) for one in np.asarray(gap).tolist()], strict=True))


def _parameter(name: str, value: Any) -> float:
    """The value of a parameter in SI units; a text has a unit."""
    return in_si(name, value) if isinstance(value, str) else number(name, value)


def number(name: str, value: Any) -> float:
    """`value` as a float; strings, for example, are rejected."""
    if type(value) is float:
        return value
    try:
        if isinstance(value, str | bytes | bool) or value is None:
            raise TypeError
        return float(value)
    except (TypeError, ValueError):
        kind = type(value).__name__
        raise TypeError(f"{name} = {value!r}: a number is needed, not {kind}") from None


def _plain(name: str) -> str:
    """A name as a keyword: `target.yield_strength` is `target_yield_strength`."""
    return name.replace(".", "_").replace("[", "_").replace("]", "")
