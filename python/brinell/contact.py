"""A contact as a simulation uses it: closing speed in, force out."""

from __future__ import annotations

import threading
import warnings
from collections.abc import Mapping
from ctypes import byref, c_char, c_double, c_int, c_size_t, c_void_p
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any, Literal, Self

import numpy as np

from .errors import ContactError, ContactWarning
from .library import WARNING, Instance, Library
from .variables import Gaps, Numbers, Variables, number

Force = Literal["auto", "mean", "end"]


@dataclass(frozen=True)
class State:
    """All that a contact is at one time: to be pickled, or restored in another contact of the same
    unit."""

    time: float
    """Time [s] since the start."""
    data: bytes
    """What the unit has written; only a unit with the same GUID reads it."""


class Contact:
    """One instance of a unit, with one contact or several.

    `fmu` is the path of a unit; `initial_gap` [m] the distance of the bodies at the start
    (negative: pressed in), for several contacts one for each or a mapping by name. All other
    parameters are keywords with underscores for dots, in SI units (`target_yield_strength=400e6`),
    or stand in `parameters` under their own names (`{"target.yield_strength": 400e6}`).

    `force` says what `step` gives:

    - `"mean"`: the unit's `mean_force`, the impulse of the step over its length. A master that
      applies it to the bodies over the same step gets the momentum right.
    - `"end"`: the unit's `force` at the end of the step. Applied over the same step it is the
      leap-frog method.
    - `"auto"` (default): `"mean"` if the unit knows the mass. Otherwise `"mean"` in a step with an
      acceleration, if the unit has `mean_force`, and `"end"` in a step without: each is then of the
      higher order, since over a rate that is held the mean force makes energy.

    A contact may go from thread to thread; calls of several threads wait for each other. It is
    freed by `close`, at the end of a `with` block, or with the last reference to it.
    """

    def __init__(
        self,
        fmu: str | Path,
        *,
        initial_gap: Gaps | None = None,
        force: Force = "auto",
        parameters: Mapping[str, float] | None = None,
        name: str = "contact",
        **keywords: float,
    ) -> None:
        self._lock = threading.RLock()
        library = Library.of(fmu)
        self.path: Path = library.path
        self._variables = variables = Variables(library)
        self._choose_force(force)
        # arrays for C are made once
        self._count = count = len(variables.rates)
        self._rate_references = variables.references(variables.rates)
        self._rates = (c_double * count)()
        self._twice = variables.references(variables.rates * 2)
        self._orders = (c_int * (2 * count))(*[1] * count, *[2] * count)
        self._derivatives = (c_double * (2 * count))()
        self._values = (c_double * count)()
        self._given = variables.given(initial_gap, parameters, keywords)
        self._time = 0.0
        self._instance = Instance(library, name)
        try:
            self._start()
        except BaseException:
            self.close()
            raise

    def _choose_force(self, force: Force) -> None:
        if force not in ("auto", "mean", "end"):
            raise ValueError(f"force = {force!r}; allowed are 'auto', 'mean' and 'end'")
        variables = self._variables
        mean = variables.every("mean_force")
        if not mean and (force == "mean" or (force == "auto" and variables.knows_mass)):
            raise ContactError(
                f"{self.path} has no output mean_force, which is the force to apply here: add it "
                'to outputs under [fmu] of its scene, or choose force="end"'
            )
        self._mean_always = bool(mean) and (force == "mean" or variables.knows_mass)
        self._mean_always &= force != "end"
        self._mean_sometimes = bool(mean) and force == "auto"
        self._end_references = variables.references(variables.every("force"))
        self._mean_references = variables.references(mean)

    # what the unit has

    @property
    def contacts(self) -> tuple[str, ...]:
        """Name of each contact; `("",)` if there is but one, without a name."""
        return self._variables.contacts

    @property
    def outputs(self) -> tuple[str, ...]:
        """Names of the outputs."""
        return self._variables.outputs

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names of the parameters."""
        return self._variables.parameters

    @property
    def knows_mass(self) -> bool:
        """Whether the unit moves the bodies itself within a step."""
        return self._variables.knows_mass

    @property
    def mass_is_settable(self) -> bool:
        """Whether the effective mass can be set between steps."""
        return self._variables.mass_is_settable

    @property
    def time(self) -> float:
        """Time [s] since the start: the sum of the steps."""
        return self._time

    # life

    def _start(self) -> None:
        call = self._instance.call
        call("SetupExperiment", False, 0.0, 0.0, False, 0.0)
        call("EnterInitializationMode")
        for name, value in self._given.items():
            call("SetReal", self._variables.references([name]), 1, (c_double * 1)(value))
        call("ExitInitializationMode")
        self._time = 0.0
        self._tell()

    def reset(
        self,
        *,
        initial_gap: Gaps | None = None,
        parameters: Mapping[str, float] | None = None,
        **keywords: float,
    ) -> None:
        """Back to the start, at time 0. Parameters that are given replace those of before; the
        others stay."""
        with self._lock:
            self._alive()
            given = self._variables.given(initial_gap, parameters, keywords)
            before, self._given = self._given, self._given | given
            self._instance.call("Reset")
            try:
                self._start()
            except ContactError:
                # what was refused isn't tried again
                self._given = before
                raise

    def close(self) -> None:
        """Frees the instance. What was closed can't be used any more; a second call does
        nothing."""
        with self._lock:
            self._instance.close()

    @property
    def closed(self) -> bool:
        """Whether `close` was called."""
        return self._instance.component is None

    def __enter__(self) -> Self:
        self._alive()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def __reduce__(self) -> Any:
        raise TypeError("a contact can't be pickled or copied; save() gives a state that can")

    def __repr__(self) -> str:
        state = "closed" if self.closed else f"t = {self._time:.9g} s"
        count = "" if self._count == 1 else f", {self._count} contacts"
        return f"<Contact {self.path.name}{count}, {state}>"

    def _alive(self) -> Any:
        component = self._instance.component
        if component is None:
            raise ContactError(f"the contact of {self.path.name} is closed")
        return component

    def _tell(self) -> None:
        for text in self._instance.warnings():
            # at the line of the user, below step() or reset() and what they call
            warnings.warn(text, ContactWarning, stacklevel=4)

    # steps

    def step(
        self,
        h: float,
        rate: Numbers,
        acceleration: Numbers | None = None,
        jerk: Numbers | None = None,
        *,
        mass: Numbers | None = None,
    ) -> Any:
        """One step of `h` [s]; gives the force [N] to apply to the bodies over this step, positive
        when it pushes them apart.

        `rate` [m/s] is the closing speed of the bodies at the start of the step, positive when they
        approach. `acceleration` [m/s^2] and `jerk` [m/s^3] are its derivatives by time, for this
        step: if the unit knows the mass, the acceleration by all forces but the contact's (gravity,
        say); otherwise by all forces. `mass` [kg] sets the effective mass from this step on, if the
        unit has one that can be set between steps.

        A unit with several contacts takes a sequence of one number for each (the mass may be one
        for all), and gives an array of forces. Which force it is: see `Contact`.
        """
        with self._lock:
            return self._advance(h, rate, acceleration, jerk, mass)

    def fly(self, h: float, gap: Numbers) -> None:
        """One step of `h` [s] in which the bodies stay apart; at its end their distance is `gap`
        [m], one for each contact.

        For engines that know where the bodies are: a unit adds up its rates, and drifts away from
        the engine by what the two integrate differently. Refused where the contact would have
        something to say: while it pushes, or for a gap below zero.
        """
        with self._lock:
            self._alive()
            h, goal = number("h", h), np.asarray(gap, dtype=float)
            force, way = self["force"], goal + self["indentation"]
            if np.any(goal < 0.0) or np.any(force != 0.0):
                raise ContactError(
                    f"fly: the bodies touch (gap = {gap} m, force = {force} N); use step"
                )
            # a step that isn't positive is refused by the unit
            rates = -way / h if h > 0.0 else way
            self._advance(h, float(rates) if np.ndim(rates) == 0 else rates)

    def _advance(
        self,
        h: float,
        rate: Any,
        acceleration: Numbers | None = None,
        jerk: Numbers | None = None,
        mass: Numbers | None = None,
    ) -> Any:
        component = self._alive()
        functions, count = self._instance.functions, self._count
        h = number("h", h)
        if mass is not None:
            self._set_mass(mass)
        self._fill(self._rates, 0, "rate", rate)
        references = self._rate_references
        if functions["fmi2SetReal"](component, references, count, self._rates) > WARNING:
            raise self._instance.refusal("SetReal")
        mean = self._mean_always
        if acceleration is not None or jerk is not None:
            self._set_derivatives(acceleration, jerk)
            mean |= self._mean_sometimes
        if functions["fmi2DoStep"](component, self._time, h, True) > WARNING:
            raise self._instance.refusal("DoStep")
        self._time += h
        references = self._mean_references if mean else self._end_references
        if functions["fmi2GetReal"](component, references, count, self._values) > WARNING:
            raise self._instance.refusal("GetReal")
        if self._instance.log:
            self._tell()
        return self._values[0] if count == 1 else np.array(self._values)

    def _fill(self, array: Any, first: int, name: str, values: Any) -> None:
        if self._count == 1 and (type(values) is float or np.shape(values) != (1,)):
            array[first] = number(name, values)
            return
        if isinstance(values, str | bytes) or np.shape(values) != (self._count,):
            shown = ", ".join(self.contacts[:8]) + (", ..." if self._count > 8 else "")
            raise TypeError(
                f"{name} = {values!r}: it takes {self._count} numbers, one for each of {shown}"
            )
        array[first : first + self._count] = [number(name, value) for value in values]

    def _set_derivatives(self, acceleration: Numbers | None, jerk: Numbers | None) -> None:
        count = self._count
        none: Numbers = 0.0 if count == 1 else [0.0] * count
        first = none if acceleration is None else acceleration
        self._fill(self._derivatives, 0, "acceleration", first)
        if jerk is not None:
            self._fill(self._derivatives, count, "jerk", jerk)
            count *= 2
        call, values = self._instance.call, self._derivatives
        call("SetRealInputDerivatives", self._twice, count, self._orders, values)

    def _set_mass(self, mass: Numbers) -> None:
        names = self._variables.masses
        if not names:
            raise ContactError(
                f"mass = {mass} kg: {self.path.name} has no effective_mass; "
                "it comes with [coupling] in its scene"
            )
        if not self.mass_is_settable:
            raise ContactError(
                f"mass = {mass} kg: effective_mass of {self.path.name} is fixed once a simulation "
                "has begun; reset(effective_mass=...) sets it at the start"
            )
        values = [mass] * len(names) if np.ndim(mass) == 0 else list(mass)  # type: ignore[arg-type]
        if len(values) != len(names):
            shown = ", ".join(names)
            raise TypeError(f"mass = {mass!r}: it takes one number, or {len(names)}, for {shown}")
        array = (c_double * len(names))(*[number("mass", value) for value in values])
        self._instance.call("SetReal", self._variables.references(names), len(names), array)

    # values

    def __getitem__(self, name: str) -> Any:
        """Any variable by its name, in SI units; of a unit with several contacts also an output by
        its plain name, as an array over the contacts."""
        with self._lock:
            component, variables = self._alive(), self._variables
            names = [name] if name in variables else variables.every(name)
            if not names:
                raise variables.unknown("variable", name)
            real = variables.is_real(names[0])
            values = ((c_double if real else c_int) * len(names))()
            function = "GetReal" if real else "GetInteger"
            get, references = (
                self._instance.functions["fmi2" + function],
                variables.references(names),
            )
            if get(component, references, len(names), values) > WARNING:
                raise self._instance.refusal(function)
            return values[0] if len(names) == 1 else np.array(values)

    def derivative(self, name: str = "force", order: int = 1) -> Any:
        """The derivative by time of an output at the end of the last step: per second, or per
        second squared."""
        with self._lock:
            self._alive()
            variables = self._variables
            names = [name] if name in self.outputs else variables.every(name)
            if not names or names[0] not in self.outputs:
                raise variables.unknown("output", name, self.outputs)
            count = len(names)
            values, orders = (c_double * count)(), (c_int * count)(*[order] * count)
            call, references = self._instance.call, variables.references(names)
            call("GetRealOutputDerivatives", references, count, orders, values)
            return values[0] if count == 1 else np.array(values)

    # states

    def save(self) -> State:
        """The state, to be given to `restore` later, here or in another contact or process."""
        with self._lock:
            self._alive()
            call, pointer, size = self._instance.call, c_void_p(), c_size_t()
            call("GetFMUstate", byref(pointer))
            try:
                call("SerializedFMUstateSize", pointer, byref(size))
                data = (c_char * size.value)()
                call("SerializeFMUstate", pointer, data, size.value)
            finally:
                call("FreeFMUstate", byref(pointer))
            return State(self._time, data.raw)

    def restore(self, state: State) -> None:
        """Back to `state`: what comes after has the same bits as after `save`."""
        if not isinstance(state, State):
            raise TypeError(f"restore takes what save() gave, not {type(state).__name__}")
        with self._lock:
            self._alive()
            call, pointer, size = self._instance.call, c_void_p(), len(state.data)
            data = (c_char * size).from_buffer_copy(state.data)
            call("DeSerializeFMUstate", data, size, byref(pointer))
            try:
                call("SetFMUstate", pointer)
            finally:
                call("FreeFMUstate", byref(pointer))
            self._time = state.time
