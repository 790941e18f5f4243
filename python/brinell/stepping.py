"""A step of an instance: its inputs, and the force that it returns. Arrays for C are made once."""

from __future__ import annotations

from ctypes import c_double, c_int
from typing import Any, Literal

import numpy as np

from .errors import ContactError
from .library import WARNING, Instance
from .variables import Numbers, Variables, number

Force = Literal["auto", "mean", "end"]
SYMMETRIC = 1e-9
"""Largest difference of two entries of the inverse masses that should be equal, over the largest
entry."""


class Stepping:
    """The inputs of an FMU and the force that it returns, for each of its contacts."""

    def __init__(self, variables: Variables, force: Force, path: str) -> None:
        self._variables, self._path = variables, path
        self._count = count = len(variables.rates)
        self._rate_references = variables.references(variables.rates)
        self._rates = (c_double * count)()
        self._external = variables.references(variables.every("external_acceleration"))
        self._tangential = variables.references(variables.components("tangential_rate"))
        self._tangential_values = (c_double * len(self._tangential))()
        across = variables.components("external_tangential_acceleration")
        self._external_tangential = variables.references(across)
        # orders 1 of all contacts, then orders 2
        self._twice = variables.references(variables.rates * 2)
        self._orders = (c_int * (2 * count))(*[1] * count, *[2] * count)
        self._derivatives = (c_double * (2 * count))()
        # whether any derivative is not zero
        self._set = False
        self._values = (c_double * count)()
        # of the upper triangle of the inverse masses, made when they are first given
        self._masses: tuple[Any, int, Any] | None = None
        self._choose(force)

    def _choose(self, force: Force) -> None:
        if force not in ("auto", "mean", "end"):
            raise ValueError(f"force = {force!r}; allowed are 'auto', 'mean' and 'end'")
        variables = self._variables
        mean = variables.every("mean_force")
        if not mean and (force == "mean" or (force == "auto" and variables.knows_mass)):
            raise ContactError(
                f"{self._path} has no output mean_force, which is the force to apply here: add it "
                'to outputs under [fmu] of its scene, or choose force="end"'
            )
        if force == "auto" and variables.is_for_next_step:
            raise ContactError(
                f"{self._path} is made for importers that step all FMUs at once: its mean_force "
                'belongs to the next step. Write master = "serial" under [coupling] of its scene, '
                'or choose force="mean" and apply it over the next step'
            )
        self._mean_always = force == "mean" or (force == "auto" and variables.knows_mass)
        self._mean_sometimes = bool(mean) and force == "auto"
        self._end_references = variables.references(variables.every("force"))
        self._mean_references = variables.references(mean)
        # of the last step
        self._was_mean = False

    def advance(
        self,
        instance: Instance,
        time: float,
        h: float,
        rate: Numbers,
        acceleration: Numbers | None,
        jerk: Numbers | None,
        mass: Numbers | None,
        gap: Numbers | None,
        inverse_masses: Any,
        tangential_rate: Numbers | None,
        tangential_acceleration: Numbers | None,
    ) -> Any:
        """Make the step from `time` to `time + h` [s]; return the force [N] of each contact."""
        functions, component, count = instance.functions, instance.component, self._count
        # everything is checked before anything is set
        self._fill(self._rates, 0, "rate", rate)
        orders = self._take_derivatives(acceleration, jerk)
        is_held = tangential_rate is None and tangential_acceleration is None
        slips = () if is_held else self._take_tangential(tangential_rate, tangential_acceleration)
        if gap is not None:
            self._follow(instance, h, gap)
        if mass is not None:
            self._set_mass(instance, mass)
        if inverse_masses is not None:
            self._set_inverse_masses(instance, inverse_masses)
        rates = self._rates
        if functions["fmi2SetReal"](component, self._rate_references, count, rates) > WARNING:
            raise instance.refusal("SetReal")
        for function, arguments in slips:
            instance.call(function, *arguments)
        if len(self._external) > 0:
            instance.call("SetReal", self._external, count, self._derivatives)
        elif orders:
            more = (self._twice, orders * count, self._orders, self._derivatives)
            instance.call("SetRealInputDerivatives", *more)
        if functions["fmi2DoStep"](component, time, h, True) > WARNING:
            raise instance.refusal("DoStep")
        mean = self._mean_always or (self._mean_sometimes and orders > 0)
        self._was_mean = mean
        references = self._mean_references if mean else self._end_references
        if functions["fmi2GetReal"](component, references, count, self._values) > WARNING:
            raise instance.refusal("GetReal")
        return self._values[0] if count == 1 else np.array(self._values)

    def _fill(self, array: Any, first: int, name: str, values: Any) -> None:
        if type(values) is np.ndarray and values.dtype == float and values.shape == (self._count,):
            array[first : first + self._count] = values.tolist()
            return
        if self._count == 1 and (type(values) is float or np.shape(values) != (1,)):
            array[first] = number(name, values)
            return
        if isinstance(values, str | bytes) or np.shape(values) != (self._count,):
            contacts = self._variables.contacts
            shown = ", ".join(contacts[:8]) + (", ..." if self._count > 8 else "")
            raise TypeError(f"{name} = {values!r}: {self._count} numbers are needed, one for each of {shown}")
        array[first : first + self._count] = [number(name, value) for value in values]

    def _take_derivatives(self, acceleration: Numbers | None, jerk: Numbers | None) -> int:
        """Return the number of orders."""
        count, orders = self._count, 0
        if self._set:
            self._derivatives[:] = [0.0] * (2 * count)
        if acceleration is not None:
            self._fill(self._derivatives, 0, "acceleration", acceleration)
            orders = 1
        if jerk is not None:
            self._fill(self._derivatives, count, "jerk", jerk)
            orders = 2
        self._set = orders > 0
        if orders == 2 and len(self._external) > 0:
            raise ContactError(
                f"jerk = {jerk} m/s^3: {self._path} takes its acceleration by the input "
                "external_acceleration, which is held over a step"
            )
        return orders

    def _take_tangential(self, rate: Numbers | None, acceleration: Numbers | None) -> list[tuple[str, tuple[Any, ...]]]:
        """Return the calls that set the tangential rates and their derivatives."""
        references = self._tangential
        count = len(references)
        if count == 0:
            name, value = ("tangential_rate", rate)
            if rate is None:
                name, value = ("tangential_acceleration", acceleration)
            raise ContactError(f"{name} = {value}: {self._path} has no friction; [friction] in its scene adds it")
        calls: list[tuple[str, tuple[Any, ...]]] = []
        if rate is not None:
            # the FMU keeps the values until they are set again
            self._fill_tangential(self._tangential_values, "tangential_rate", rate)
            calls.append(("SetReal", (references, count, self._tangential_values)))
        if acceleration is not None:
            values = (c_double * count)()
            self._fill_tangential(values, "tangential_acceleration", acceleration)
            if len(self._external_tangential) > 0:
                calls.append(("SetReal", (self._external_tangential, count, values)))
                return calls
            orders = (c_int * count)(*[1] * count)
            calls.append(("SetRealInputDerivatives", (references, count, orders, values)))
        return calls

    def _fill_tangential(self, array: Any, name: str, values: Any) -> None:
        """One number for each contact, or two with two tangential directions."""
        if len(array) == self._count:
            self._fill(array, 0, name, values)
            return
        shapes = [(self._count, 2), (2,)] if self._count == 1 else [(self._count, 2)]
        if isinstance(values, str | bytes) or np.shape(values) not in shapes:
            one = "two numbers are needed, one for each tangential direction"
            all_of_them = f"{self._count} pairs of numbers are needed, one pair for each contact"
            raise TypeError(f"{name} = {values!r}: {one if self._count == 1 else all_of_them}")
        array[:] = [number(name, value) for value in np.ravel(values).tolist()]

    def tangential_force(self, instance: Instance) -> Any:
        """The tangential force [N] of each contact that belongs to the force of the last step; an
        array of its two components with two tangential directions."""
        name = "mean_tangential_force" if self._was_mean else "tangential_force"
        return self._variables.reading(name)(instance)

    def _follow(self, instance: Instance, h: float, gap: Numbers) -> None:
        """Contacts that cannot touch within the step end it where those of the engine do: a rate
        that differs by what they have drifted takes them there."""
        count, variables = self._count, self._variables
        gaps, now = (c_double * count)(), {}
        self._fill(gaps, 0, "gap", gap)
        for name in ("indentation", "force"):
            if not variables.every(name):
                raise variables.unknown("output", name)
            now[name] = np.atleast_1d(variables.reading(name)(instance))
        rate, (first, second) = np.array(self._rates), np.reshape(self._derivatives, (2, count))
        closer = [np.maximum(part, 0.0) for part in (rate, first, second)]
        reach = h * (closer[0] + h / 2.0 * (closer[1] + h / 3.0 * closer[2]))
        apart = (now["force"] == 0.0) & (np.array(gaps) > reach) & (h > 0.0)
        rate[apart] -= (np.array(gaps) + now["indentation"])[apart] / h
        self._rates[:] = rate.tolist()

    def _set_mass(self, instance: Instance, mass: Numbers) -> None:
        names, path = self._variables.masses, self._path
        if not names:
            raise ContactError(f"mass = {mass} kg: {path} has no effective_mass; [coupling] in its scene adds one")
        if not self._variables.mass_is_settable:
            raise ContactError(
                f"mass = {mass} kg: effective_mass of {path} is fixed once a simulation "
                "has started; reset(effective_mass=...) sets it at the start"
            )
        values = [mass] * len(names) if np.ndim(mass) == 0 else list(mass)  # type: ignore[arg-type]
        if len(values) != len(names):
            shown = ", ".join(names)
            raise TypeError(f"mass = {mass!r}: one number is needed, or {len(names)}, for {shown}")
        array = (c_double * len(names))(*[number("mass", value) for value in values])
        instance.call("SetReal", self._variables.references(names), len(names), array)

    def _set_inverse_masses(self, instance: Instance, matrix: Any) -> None:
        variables, path = self._variables, self._path
        names, count = variables.inverse_masses, self._count * (1 + variables.directions)
        if not names:
            raise ContactError(
                f'inverse_masses: {path} has no such inputs; inverse_masses = "input" under '
                "[coupling] of its scene adds them"
            )
        if np.shape(matrix) != (count, count):
            raise TypeError(
                f"inverse_masses = {matrix!r}: {count} x {count} numbers are needed, a row and a "
                "column for each contact" + (", and for each of its tangents" if variables.directions else "")
            )
        values = matrix
        if type(matrix) is not np.ndarray or matrix.dtype != float:
            values = np.array([[number("inverse_masses", it) for it in row] for row in matrix])
        skew = np.abs(values - values.T)
        # products of an engine's matrices are symmetric to rounding
        if skew.any() and np.any(skew > SYMMETRIC * np.abs(values).max()):
            row, column = np.unravel_index(np.nanargmax(skew), skew.shape)
            raise ContactError(
                f"inverse_masses: entry [{row + 1},{column + 1}] = {values[row, column]} and "
                f"[{column + 1},{row + 1}] = {values[column, row]} 1/kg must be equal"
            )
        if self._masses is None:
            self._upper = np.triu_indices(count)
            self._masses = (variables.references(names), len(names), (c_double * len(names))())
        self._masses[2][:] = values[self._upper].tolist()
        instance.call("SetReal", *self._masses)
