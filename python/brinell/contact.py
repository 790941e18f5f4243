"""A contact in a simulation: closing speed in, force out."""

from __future__ import annotations

import threading
from ctypes import byref, c_char, c_double, c_int, c_size_t, c_void_p
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import numpy as np

from .errors import ContactError, ContactWarning, tell
from .library import Instance, Library
from .stepping import Force, Stepping
from .variables import Gaps, Numbers, Parameters, Texts, Variables, number

AFTER_REFUSAL = "; the contact steps again after contact.reset(), or after contact.restore() with a saved state"


@dataclass(frozen=True)
class State:
    """The complete state of a contact at one time: it can be pickled, and restored in another
    contact of the same FMU."""

    time: float
    """Time [s] since the start."""
    data: bytes
    """The serialized state; only an FMU with the same GUID can read it."""


class Contact:
    """One instance of an FMU, with one contact or several.

    `fmu` is the path of an FMU, or of a scene (.toml), which is exported and loaded. `initial_gap`
    [m] is the distance of the bodies at the start (negative: pressed in); for several contacts, one
    number for each, or a mapping by name. All other parameters are keywords with underscores for
    dots, in SI units (`target_yield_strength=400e6`), or entries of `parameters` under their own
    names (`{"target.yield_strength": 400e6}`). A text has a unit: `"400 MPa"`. A parameter that each
    contact has for itself takes one number for all, or a sequence with one number for each.

    `force` selects what `step` returns:

    - `"mean"`: the FMU's `mean_force`, the impulse of the step divided by its length. If you apply
      it to the bodies over the same step, the momentum is right.
    - `"end"`: the FMU's `force` at the end of the step. Applied over the same step, it makes the
      leap-frog method.
    - `"auto"` (default): `"mean"` if the FMU knows the mass. Otherwise `"mean"` in a step with an
      acceleration, if the FMU has `mean_force`, and `"end"` in a step without. Each is then of the
      higher order: with a rate that is held, the mean force would add energy.

    A contact can be used from several threads; their calls wait for each other. It is freed by
    `close`, at the end of a `with` block, or with the last reference to it.
    """

    def __init__(
        self,
        fmu: str | Path | Library,
        *,
        initial_gap: Gaps | None = None,
        force: Force = "auto",
        parameters: Parameters | None = None,
        name: str = "contact",
        **keywords: Numbers | Texts,
    ) -> None:
        self._lock = threading.RLock()
        library = Library.of(fmu)
        self.path: Path = library.path
        self._variables = variables = Variables(library)
        self._count = len(variables.rates)
        self._stepping = Stepping(variables, force, library.path.name)
        self._given = variables.given(initial_gap, parameters, keywords)
        self._time = 0.0
        self._instance = Instance(library, name)
        try:
            self._start()
        except BaseException:
            self.close()
            raise

    # what the FMU has

    @property
    def directions(self) -> int:
        """The number of tangential directions, 0 without friction."""
        return self._variables.directions

    @property
    def contacts(self) -> tuple[str, ...]:
        """Name of each contact; `("",)` if there is only one, without a name."""
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
        """Whether the FMU moves the bodies itself within a step."""
        return self._variables.knows_mass

    @property
    def mass_is_settable(self) -> bool:
        """Whether the effective mass can be set between steps."""
        return self._variables.mass_is_settable

    @property
    def one_mass(self) -> bool:
        """Whether all contacts have the same effective mass."""
        return len(self._variables.masses) == 1

    @property
    def shares_bodies(self) -> bool:
        """Whether `step` takes `inverse_masses`: its contacts may move the same bodies."""
        return bool(self._variables.inverse_masses)

    @property
    def time(self) -> float:
        """Time [s] since the start: the sum of the steps."""
        return self._time

    # life

    def _start(self) -> None:
        call = self._instance.call
        self._instance.advice = ""
        call("SetupExperiment", False, 0.0, 0.0, False, 0.0)
        call("EnterInitializationMode")
        if self._given:
            count, references = len(self._given), self._variables.references(list(self._given))
            # all at once: each call moves every contact to its new start
            call("SetReal", references, count, (c_double * count)(*self._given.values()))
        call("ExitInitializationMode")
        self._instance.advice = AFTER_REFUSAL
        self._time = 0.0
        self._tell()

    def reset(
        self, *, initial_gap: Gaps | None = None, parameters: Parameters | None = None, **keywords: Numbers | Texts
    ) -> None:
        """Return to the start, at time 0. Parameters that are given replace the previous ones; the
        others keep their values. Warnings are logged again."""
        with self._lock:
            self._alive()
            given = self._variables.given(initial_gap, parameters, keywords)
            before, self._given = self._given, self._given | given
            self._instance.call("Reset")
            try:
                self._start()
            except ContactError:
                # rejected parameters are not tried again
                self._given = before
                raise

    def close(self) -> None:
        """Free the instance. A closed contact cannot be used any more; a second call does
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
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def __reduce__(self) -> Any:
        raise TypeError("a contact cannot be pickled or copied; save() returns a state that can")

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
            tell(text, ContactWarning)

    def step(
        self,
        h: float,
        rate: Numbers,
        acceleration: Numbers | None = None,
        jerk: Numbers | None = None,
        *,
        mass: Numbers | None = None,
        gap: Numbers | None = None,
        inverse_masses: Any = None,
        tangential_rate: Numbers | None = None,
        tangential_acceleration: Numbers | None = None,
    ) -> Any:
        """Make a step of `h` [s]; return the force [N] to apply to the bodies over this step,
        positive when it pushes them apart.

        `rate` [m/s] is the closing speed of the bodies at the start of the step, positive when they
        approach. `acceleration` [m/s^2] and `jerk` [m/s^3] are its time derivatives, for this step:
        if the FMU knows the mass, the acceleration by all forces except that of the contact
        (gravity, for example); otherwise by all forces. `mass` [kg] sets the effective mass from
        this step on, if the FMU has one that can be set between steps.

        `gap` [m] is the distance of the bodies at the start of the step in the simulation. An FMU
        integrates its rates. It drifts away from the simulation by what the two integrate
        differently, and by the rest of a step in which another contact has changed the speed. With
        `gap`, a contact that cannot touch within the step ends it where the bodies of the
        simulation do. Near the surface, and while it pushes, it keeps its own distance.

        `inverse_masses` [1/kg] is for contacts that share bodies, if the scene has `inverse_masses =
        "input"` under `[coupling]`: the symmetric matrix of how a force at one contact accelerates
        the others, a row and a column for each contact; with friction, then for the tangents of all
        contacts in each direction. It holds from this step on. `contact["impulse_moment"]` and
        `contact["tangential_impulse_moment"]` [N s^2] then displace the bodies: see the guide on
        coupling.

        `tangential_rate` [m/s] is the relative tangential speed of the two contact points, and
        `tangential_acceleration` [m/s^2] its time derivative, if the scene has friction. A rate
        that is not given keeps its value. `tangential_force` is then the force along it. With
        two tangential directions, both are pairs of numbers.

        An FMU with several contacts takes a sequence of one number for each contact (the mass may
        be one number for all), and returns an array of forces. Which force: see `Contact`.
        """
        with self._lock:
            self._alive()
            h = number("h", h)
            more = (acceleration, jerk, mass, gap, inverse_masses)
            slips = (tangential_rate, tangential_acceleration)
            force = self._stepping.advance(self._instance, self._time, h, rate, *more, *slips)
            self._time += h
            if self._instance.log:
                self._tell()
            return force

    @property
    def tangential_force(self) -> Any:
        """The tangential force [N] to apply to the bodies over the last step, against a positive
        `tangential_rate`: the mean force if `step` returned the mean force, otherwise the force at
        the end. A sphere of radius R also gets its torque."""
        with self._lock:
            self._alive()
            return self._stepping.tangential_force(self._instance)

    # values

    def __getitem__(self, name: str) -> Any:
        """Read any variable by its name, in SI units. With several contacts, the plain name of an
        output gives an array over the contacts; with two tangential directions, of pairs."""
        with self._lock:
            self._alive()
            return self._variables.reading(name)(self._instance)

    def derivative(self, name: str = "force", order: int = 1) -> Any:
        """Read the time derivative of an output at the end of the last step: per second (order 1),
        or per second squared (order 2)."""
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
        """Save the state, for `restore`: here, in another contact, or in another process."""
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
        """Return to `state`. The simulation then continues with the same bits as after `save`."""
        if not isinstance(state, State):
            raise TypeError(f"restore takes the result of save(), not {type(state).__name__}")
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

    def _keep(self) -> None:
        """Keep the state in memory, for `_back`: once, and faster than `save`."""
        with self._lock:
            self._alive()
            self._instance.keep()
            self._kept_time = self._time

    def _back(self) -> None:
        """Return to the state that was kept last."""
        with self._lock:
            self._alive()
            self._instance.back()
            self._time = self._kept_time
