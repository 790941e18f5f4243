"""Contacts between bodies of an engine: what does not depend on the engine."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from .contact import Contact
from .errors import ContactError, ContactWarning, tell
from .library import Library

SINGULAR = 1e-9
"""Directions in which the inverse masses are smaller than this part of the largest are those of
redundant contacts, such as the fourth foot of a box: nothing moves along them."""
LEVER = 1e-3
"""The same for slips beside the distances: bodies that must move far for a small slip don't."""
ALONE = 1e-9
"""Contacts whose inverse masses couple by less than this part of their own share no body."""
STILL = 1e-6
"""Bodies that move along a row by less than this part of what their joints move can't move along it."""
TURNED = 1e-6
"""Rows that change by less than this part in a step belong to bodies that don't turn."""
CHANGED = 1e-6
"""Accelerations that differ by less than this part are the same for the FMU."""
EQUAL = 1e-12
"""Distances that differ by less [m] are the same but for rounding."""
WITHIN, PART = 1e-6, 1e-3
"""The bodies and the FMU may differ by this [m], or by this part of the indentation or distance."""
STIFF = 0.5
"""Part of the change by an impulse that the engine's forces take back within the step, from which on
its contact lasts."""
TRIES = 10
"""Corrections of the places after a step."""
SLOW = 1e-10
"""Ways in a step [m or rad] within which nothing changes."""
AROUND = 0.3
"""Way [m or rad] to other poses at which the directions of friction are looked at."""

MOVED = "the bodies were moved since the last step, but not apart; contact.reset(initial_gap=...) starts anew"
NOTHING = np.zeros(0)
CROSS = -np.array([np.cross(np.eye(3), axis).ravel() for axis in np.eye(3)])
"""An arm times this is the matrix, row by row, by which a spin moves its end."""

Array = NDArray[np.float64]
Attachable = str | Path | Library | Contact
"""The path of an FMU or of a scene, which is exported, or a contact that exists."""


@dataclass(frozen=True)
class Pair:
    """A sphere that touches a plane or another sphere."""

    own: float
    """Radius of the sphere [m]."""
    reach: float
    """Radius of the other sphere [m]; zero for a plane."""
    is_plane: bool
    bodies: tuple[int, int]
    """Those of the sphere and of the other one, as `_jacobians` numbers them; -1 stands still."""


class _Distances(NamedTuple):
    """Where the spheres are."""

    gaps: Array
    """Distance [m] of each pair."""
    normals: Array
    """From the other to the first of each pair."""
    centres: tuple[Array, Array]
    """Those of the first, and those of the other of each pair [m]."""


class _Here(NamedTuple):
    """What a step needs to know of a place of the bodies. Each row is a direction of a contact: of
    its normal, then of its tangents."""

    gaps: Array
    """Distance [m] of each pair."""
    tangents: Array
    """Of each contact in each direction."""
    pressed: Array
    """Distance of the centres, over that when the surfaces touch; at most 1."""
    away: Array
    """How velocities change the distances, and the ways along the tangents: the rows."""
    rolling: Array
    """How the rows change with `pressed`: a dent shortens the arms of friction."""
    response: Array
    """How an impulse along each row changes the velocities."""
    still: NDArray[np.bool_]
    """Rows along which the bodies can't move; they are zero."""

    def inverse_masses(self) -> Array:
        """The matrix for the FMU. A row along which nothing moves is coupled to no other: without a
        rate, friction along it is zero whatever its mass."""
        product = self.away @ self.response.T
        # without the rounding of a product
        matrix = np.asarray(0.5 * (product + product.T))
        if self.still.any():
            own = np.diagonal(matrix).copy()
            own[self.still] = own.max() or 1.0
            np.fill_diagonal(matrix, own)
        return matrix


@dataclass
class _Step:
    """A step that is being made."""

    start: tuple[Array, Array]
    """The places and velocities."""
    pull: Array
    """The acceleration without contacts, over the step."""
    here: _Here
    ahead: _Here | None
    """The place where the bodies would be at the end without contacts; none: where they are."""
    rates: Array
    """For the FMU, of each row at the start."""
    accelerations: Array
    """For the FMU, of each row over the step."""


class Attached(ABC):
    """The contacts of an FMU in an engine; `attach` of the engine's module makes it."""

    contact: Contact
    """The FMU: `contact["dissipated_energy"]` reads its variables."""
    forces: Array
    """Mean force [N] of each contact over the last step."""
    tangential_forces: Array
    """Mean tangential forces [N] of each contact over the last step, in world coordinates, on the
    first of its pair; zero without friction."""
    gaps: Array
    """Distance [m] of each pair in the engine, after the last step; negative: pressed in."""
    inverse_masses: Array
    """The matrix of inverse effective masses [1/kg] in the last step: of the normals, then of the
    tangents in each direction. A direction in which the bodies can't move has no couplings."""

    def __init__(self, pairs: Sequence[Pair], contact: Attachable, parameters: dict[str, Any]) -> None:
        self._own = np.array([pair.own for pair in pairs])
        self._reach = np.array([pair.reach for pair in pairs])
        self._touching = self._own + self._reach
        self._planes = np.array([pair.is_plane for pair in pairs])
        self._planar = bool(self._planes.all())
        self._bodies = np.array([pair.bodies for pair in pairs]).T
        self.gaps = self._distances().gaps
        count = len(pairs)
        self.forces, self.tangential_forces = np.zeros(count), np.zeros((count, 3))
        if not isinstance(contact, Contact):
            contact, parameters = Contact(contact, **parameters), {}
        self.contact = contact
        self._directions = contact.directions
        self._contact_of = np.tile(np.arange(count), 1 + self._directions)
        rows = len(self._contact_of)
        self.inverse_masses = np.zeros((rows, rows))
        # way along each row since its contact began to push that only a correction made [m]
        self._slipped = np.zeros(rows)
        self._h, self._damped, self._drag = self._timestep, False, NOTHING
        try:
            if len(contact.contacts) != count:
                shown = ", ".join(contact.contacts)
                raise ContactError(f"{count} contacts of the engine: {contact.path.name} has {shown}")
            if not contact.shares_bodies:
                self._check_alone()
            self._tangents = self._first_tangents()
            contact.reset(initial_gap=self.gaps, **parameters)
        except BaseException:
            contact.close()
            raise

    def _check_alone(self) -> None:
        """Whether the FMU moves each pair of bodies by itself."""
        contact, name = self.contact, self.contact.path.name
        if not contact.knows_mass or not contact.mass_is_settable:
            raise ContactError(
                f"{name} can't be given the masses of the engine: [coupling] of its scene needs "
                'effective_mass for one contact, or inverse_masses = "input" for contacts that '
                "share bodies and for friction"
            )

    def close(self) -> None:
        """Free the FMU."""
        self.contact.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    # what each engine has in its own way; places and velocities are the engine's coordinates

    @property
    @abstractmethod
    def _timestep(self) -> float:
        """The engine's step [s]."""

    @abstractmethod
    def _state(self) -> tuple[Array, Array]:
        """A copy of the places and of the velocities."""

    @abstractmethod
    def _put(self, place: Array, speed: Array) -> None:
        """Set the places and velocities."""

    @abstractmethod
    def _moved(self, place: Array, speed: Array, time: float) -> Array:
        """The places after `time` [s] at a constant velocity."""

    @abstractmethod
    def _acceleration(self) -> Array:
        """The acceleration in this state by all but these contacts, as its forces and the mass
        matrix say: nothing in it is implicit."""

    @property
    @abstractmethod
    def _damping(self) -> Array:
        """The damping of each velocity that the engine takes implicitly."""

    @abstractmethod
    def _solve(self, rows: Array) -> Array:
        """The inverse of the mass matrix times each of these rows."""

    @abstractmethod
    def _spheres(self) -> tuple[Array, Array, Array]:
        """Of each pair: the centre of its sphere and that of the other one, or a point of the plane
        [m], and the axes of the other one as columns, of which the third is the normal of a
        plane."""

    @abstractmethod
    def _jacobians(self) -> tuple[Array, Array]:
        """Of each body: a point of it [m], and how velocities move this point and turn the body: two
        of 3 rows each. A last one stands still."""

    @abstractmethod
    def _end(self, start: tuple[Array, Array], place: Array, speed: Array, acceleration: Array) -> None:
        """The engine's own step from the state `start`, after which its places are `place`, and its
        velocities `speed` plus those of a step with this acceleration."""

    # what is the same

    def _distances(self) -> _Distances:
        centres, others, axes = self._spheres()
        between, normals = centres - others, axes[:, :, 2]
        distances = np.einsum("cx,cx->c", normals, between)
        if not self._planar:
            planes, lengths = self._planes, np.sqrt(np.einsum("cx,cx->c", between, between))
            normals = np.where(planes[:, None], normals, between / lengths[:, None])
            distances = np.where(planes, distances, lengths)
        return _Distances(distances - self._touching, normals, (centres, others))

    def _first_tangents(self) -> Array:
        """The tangents of each contact in each direction: along the axes of the other one of its
        pair. With one direction, that in which the bodies can move, if there is only one."""
        count, directions = len(self.gaps), self._directions
        at, axes = self._distances(), self._spheres()[2]
        if directions == 0:
            return np.zeros((0, count, 3))
        across = np.abs(np.einsum("cxa,cx->ca", axes, at.normals)).argmin(axis=1)
        first = _across(axes[np.arange(count), :, across], at.normals)
        both = np.array([first, np.cross(at.normals, first)])
        if directions == 2:
            return both
        masses = self._tangential_masses(both)
        values, vectors = np.linalg.eigh(masses)
        one = values[:, 0] <= SINGULAR * values[:, 1]
        turns = np.where((one & (values[:, 1] > 0.0))[:, None], vectors[:, :, 1], [1.0, 0.0])
        along = np.einsum("cd,dcx->cx", turns, both)
        # bodies that can move in one direction here may move in another one elsewhere
        place, speed = self._state()
        self._put(self._moved(place, np.full_like(speed, AROUND), 1.0), speed)
        along_there = _across(along, self._distances().normals)
        across = np.cross(self._distances().normals, along_there)
        masses = self._tangential_masses(np.array([along_there, across]))
        one &= masses[:, 1, 1] <= SINGULAR * np.trace(masses, axis1=1, axis2=2)
        self._put(place, speed)
        self._tell_of_slides([index for index in range(count) if not one[index]])
        return np.array([along])

    def _tangential_masses(self, tangents: Array) -> Array:
        """The inverse masses of each contact along these two tangents."""
        count = len(self.gaps)
        rows = self._rows(self._distances(), tangents, np.ones(count))[0][count:]
        products = (rows @ self._solve(rows).T).reshape(2, count, 2, count)
        return np.asarray(np.einsum("dcec->cde", products))

    def _tell_of_slides(self, slides: list[int]) -> None:
        """Warn of bodies that slide in a direction in which the FMU has no friction."""
        if slides:
            names = ", ".join(map(self._name, slides))
            tell(
                f"{self.contact.path.name} has friction in one direction, but the bodies of {names} "
                "can slide in two: nothing resists them across it; directions = 2 under [friction] "
                "of the scene does",
                ContactWarning,
            )

    def _rows(self, at: _Distances, tangents: Array, pressed: Array) -> tuple[Array, Array, float]:
        """Derivative of each distance by the engine's velocities; then that of the way by which the
        first point of contact is behind the other, along each tangent. An impulse against the rates
        acts along these rows. Also how they change with `pressed`, and the largest motion of a body.

        Distances are those of the centres of spheres: a centre and the point of contact lie on one
        normal and close at the same rate. `pressed` says where the point of contact is.
        """
        points, motions = self._jacobians()
        along = np.concatenate((at.normals[:, None], -tangents.swapaxes(0, 1)), axis=1)
        rows, rolling = np.zeros((2, *along.shape[:2], motions.shape[-1]))
        # from the centres to the point of contact, which both have in common while pressed
        radii = (-self._own, self._reach)
        for body, middles, radius, sign in zip(self._bodies, at.centres, radii, (1.0, -1.0), strict=True):
            if body.max() < 0:
                continue
            moves, turns = motions[body, 0], motions[body, 1]
            to_surface = (sign * radius)[:, None] * at.normals
            arms = sign * (middles - points[body]) + pressed[:, None] * to_surface
            rows += along @ (sign * moves + (arms @ CROSS).reshape(-1, 3, 3) @ turns)
            if self._directions > 0:
                rolling += along @ ((to_surface @ CROSS).reshape(-1, 3, 3) @ turns)
        # the normals of all contacts first
        shape = (along.shape[0] * along.shape[1], -1)
        rows, rolling = (part.swapaxes(0, 1).reshape(shape) for part in (rows, rolling))
        return rows, rolling, float(np.abs(motions).max())

    def _here(self, pressed: Array | None = None) -> _Here:
        """What a step needs to know of the place where the bodies are."""
        at = self._distances()
        tangents = _across(self._tangents, at.normals)
        if pressed is None:
            # how deep they are pressed changes at other rates, within an impact
            pressed = np.minimum(1.0, 1.0 + at.gaps / self._touching)
        away, rolling, largest = self._rows(at, tangents, pressed)
        still = np.abs(away).max(axis=1) <= STILL * largest
        if still.any():
            away[still] = 0.0
        return _Here(at.gaps, tangents, pressed, away, rolling, self._dragged(self._solve(away)), still)

    def _accelerate(self) -> Array:
        """The acceleration in this state by all but these contacts."""
        return self._dragged(self._acceleration())

    def _dragged(self, changes: Array) -> Array:
        """These changes of the velocities, with a mass in place of the damping by which a velocity would
        fade in less than a step."""
        if len(self._drag) == 0:
            return changes
        inverse = self._solve(np.diag(self._h * self._drag)).T
        return np.asarray(np.linalg.solve(np.eye(len(inverse)) + inverse, changes.T).T)

    def _strong(self) -> Array:
        """The part of the damping by which a velocity would fade in less than a step."""
        damping = self._damping
        self._damped = bool(damping.any())
        if not self._damped:
            return NOTHING
        masses = 1.0 / np.diagonal(self._solve(np.eye(len(damping))))
        drag = np.maximum(damping - masses / self._h, 0.0)
        return drag if drag.any() else NOTHING

    def _implicit(self, acceleration: Array, time: float, free: Array | None = None) -> Array:
        """An acceleration, or what is added to one, as it is over this `time` [s] with the damping of
        what it adds to the velocities: all of it, or what `free` leaves."""
        if not self._damped:
            return acceleration
        drag = self._dragged(self._solve(np.diag(0.5 * time * self._damping))).T
        if free is not None:
            drag = drag @ free
        return np.asarray(np.linalg.solve(np.eye(len(drag)) + drag, acceleration))

    def _phase(self, place: Array, speed: Array, pull: Array, time: float) -> Array:
        """The mean acceleration of a motion without contacts of this `time` [s], of which `pull` is a
        guess."""
        self._put(self._moved(place, speed, 0.5 * time), speed + 0.5 * time * pull)
        return pull + self._implicit(self._accelerate() - pull, time)

    def _unheld(self, here: _Here) -> Array | None:
        """What contacts that keep pushing leave of an acceleration, where that matters."""
        if not self._damped:
            return None
        rows = self._of_all(self.forces > 0.0)
        away, response = here.away[rows], here.response[rows]
        masses = away @ response.T
        held = _inverse(masses, np.diagonal(masses).max())
        return np.asarray(np.eye(away.shape[1]) - response.T @ held @ away)

    def step(self) -> Array:
        """Make a step of the engine, instead of its own; return the mean force [N] of each contact.

        The engine computes the acceleration `a` of its bodies without these contacts, and the FMU
        the impulses `P` of the contacts and their moments `Q`. The velocities change by `h a` and
        by the impulses. An engine's Euler method moves the bodies by `h` times the new velocity.
        Here they move by `h v + h^2/2 a` and by the moments, which is exact for what the FMU
        integrates.

        Bodies turn within a step, and their forces depend on velocities (servos, damping). So `a`
        is that at the middle of a step (of second order), and the FMU gets the acceleration of each
        contact by which the engine ends where it does. If a contact begins to push, the velocities
        before its impulse count until its mean time, and those after it from then on. While contacts
        keep pushing, `a` is that of the mean motion with their impulses: a servo that presses a
        foot onto the floor presses with its whole force. If the bodies turn, or `a` has changed,
        the FMU makes the step again, with the inverse masses at the mean time of the impulses, and
        with the directions and arms of each impulse at its own mean time. Errors are of second
        order in the angle of a step.

        After the step, the bodies are at the indentations of the FMU: what differs is removed along
        the directions in which impulses move them. It stays below 1 um, or 1e-3 of the indentation
        or distance, or the step raises an error that says why.

        If the step is refused, the bodies stay where they are, and the FMU as it was.
        """
        start = self._state()
        self.contact._keep()
        try:
            self._advance(start)
        except BaseException:
            self._put(*start)
            self.contact._back()
            raise
        return self.forces

    def _advance(self, start: tuple[Array, Array]) -> None:
        """The step from this state."""
        place, speed = start
        h = self._h = self._timestep
        self._put(*start)
        self._drag = self._strong()
        pull, here = self._accelerate(), self._here()
        self._tangents = here.tangents
        pressed = self._pressed()
        ahead, fast = None, speed
        # bodies at rest stay in their place
        if not pressed.any() or h * np.abs(speed).max() > SLOW:
            pull = self._implicit(pull, h)
            if not pressed.any():
                pull = self._phase(place, speed, pull, h)
            fast = speed + h * pull
            self._put(self._moved(place, 0.5 * (speed + fast), h), fast)
            ahead = self._here(here.pressed)
        rates, accelerations = self._motion(here, speed, pull, ahead, fast)
        rates = self._follow(here.gaps, rates, accelerations, pressed)
        step = _Step(start, pull, here, ahead, rates, accelerations)
        impulses, moments = self._run(step, here)
        pushes = self.forces > 0.0
        if pushes.any():
            speed, pull, drift = self._push(step, impulses, moments, pressed)
        else:
            self._put(self._moved(place, speed + 0.5 * h * pull, h), speed)
            self.gaps, self._slipped = self._distances().gaps, 0.0 * self._slipped
            drift = self._drift(self.gaps)
        self._check(drift, f"the bodies can't follow in a step of {h:g} s; a shorter one helps")
        self._end(start, self._state()[0], speed, pull)

    def _push(
        self, step: _Step, impulses: Array, moments: Array, pressed: NDArray[np.bool_]
    ) -> tuple[Array, Array, Array]:
        """The rest of a step in which contacts push, of which the FMU gave these impulses and moments;
        those that were `pressed` did before. Moves the bodies; returns their velocities at the start
        with the impulses, and the acceleration of the step."""
        h, count, here = self._h, len(self.gaps), step.here
        place, speed = step.start
        time = h - moments[:count].sum() / impulses[:count].sum()
        moved, fast = speed + 0.5 * time * step.pull, speed + time * step.pull
        lasting = self._lasts(step, impulses, time, pressed)
        if lasting:
            way = moments @ here.response / h
            moved = fast = speed + 0.5 * h * step.pull + way
        middle = self._moved(place, moved, time)
        rests = step.ahead is None and h * np.abs(moved).max() < SLOW
        there, again = here, False
        if not rests:
            self._put(middle, fast)
            there, again = self._there(step, time, lasting)
        for _ in range(TRIES):
            if again:
                self.contact._back()
                impulses, moments = self._run(step, there)
            pushes = self.forces > 0.0
            response, pull = self._response(step, there, impulses, moments, time), step.pull
            kick, way = impulses @ response, h * speed + moments @ response
            if lasting:
                way += 0.5 * h**2 * pull
            else:
                # velocities after the impulses count from then on
                first, later = self._phases(step, time, kick)
                pull = (time * first + (h - time) * later) / h
                way += (0.5 * time**2 + time * (h - time)) * first + 0.5 * (h - time) ** 2 * later
            self._put(self._moved(place, way, 1.0), fast)
            slipped, drift = self._settle(pushes, there)
            if pushes.all():
                break
            off = ~pushes & (np.abs(drift) > 0.1 * _allowed(self.gaps))
            if not off.any():
                break
            # those that are apart end where the bodies do
            step.accelerations[:count] -= 2.0 / h**2 * np.where(off, drift, 0.0)
            again = True
        self._slipped = slipped
        return speed + kick, pull, drift

    def _lasts(self, step: _Step, impulses: Array, time: float, pressed: NDArray[np.bool_]) -> bool:
        """Whether the contacts that push go on pushing, or have no speed to bounce; or forces of the
        engine, such as a strong damping, soon make up for their impulses."""
        h, pushes = self._h, self.forces > 0.0
        slow = step.rates[: len(pushes)] < h * step.accelerations[: len(pushes)]
        if (slow | (pressed & self._pressed()))[pushes].all():
            return True
        kick = impulses @ step.here.response
        first, later = self._phases(step, time, kick)
        rows = step.here.away[: len(pushes)][pushes]
        return _differ(rows @ ((h - time) * (later - first)), rows @ kick, STIFF)

    def _phases(self, step: _Step, time: float, kick: Array) -> tuple[Array, Array]:
        """The accelerations before this time, at which the velocities change by `kick`, and after it."""
        (place, speed), rest = step.start, self._h - time
        first = self._phase(place, speed, step.pull, time)
        middle = self._moved(place, speed + 0.5 * time * first, time)
        return first, self._phase(middle, speed + time * first + kick, step.pull, rest)

    def _there(self, step: _Step, time: float, lasting: bool) -> tuple[_Here, bool]:
        """What a step needs to know of the place at the mean time of its impulses, where the bodies
        are, and whether the FMU must make the step again: with other rows or accelerations."""
        here, ahead, again = step.here, step.ahead, False
        there, speed = here, step.start[1]
        if ahead is not None and _differ(ahead.away - here.away, here.away, TURNED):
            there, again = self._here(), True
            # impulses act at the arms of this time: other ones for the rates would take energy
            arms = self._of_all(there.pressed - here.pressed)
            step.rates = step.rates - arms * (here.rolling @ speed)
        if again:
            # without the impulses, those that push would have the rates of this time
            free = speed + time * step.pull
            meet = (-(there.away @ free) - step.rates) / time
            step.accelerations = np.where(self._of_all(self.forces > 0.0), meet, step.accelerations)
        if lasting:
            # forces are those of the mean motion
            change = self._accelerate() - step.pull
            change = self._implicit(change, self._h, self._unheld(here))
            more = -(there.away @ change)
            if _differ(more, step.accelerations, CHANGED):
                step.pull, step.accelerations = step.pull + change, step.accelerations + more
                again = True
        return there, again

    def _response(self, step: _Step, there: _Here, impulses: Array, moments: Array, time: float) -> Array:
        """How the impulse of each row changes the velocities, each at its own mean time."""
        here, ahead, h, count = step.here, step.ahead, self._h, len(self.gaps)
        if there is here or ahead is None:
            return there.response
        parts = np.full(count, h - time)
        np.divide(moments[:count], impulses[:count], out=parts, where=self.forces > 0.0)
        # friction acts while its contact pushes
        later = self._of_all(h - parts) - time
        turning = (ahead.response - here.response) / h
        return np.asarray(there.response + later[:, None] * turning)

    def _motion(self, here: _Here, speed: Array, pull: Array, ahead: _Here | None, fast: Array) -> tuple[Array, Array]:
        """The rate of each row at the start of a step, and its acceleration to the end, which is
        without contacts."""
        h, count, rates = self._h, len(self.gaps), -(here.away @ speed)
        if ahead is None:
            return rates, -(here.away @ pull)
        later = -(ahead.away @ fast)
        accelerations = (later - rates) / h
        # by which the distances end where those of the engine do
        short = here.gaps - ahead.gaps - 0.5 * h * (rates + later)[:count]
        short[np.abs(short) < EQUAL] = 0.0
        accelerations[:count] += 2.0 / h**2 * short
        return rates, accelerations

    def _follow(self, gaps: Array, rates: Array, accelerations: Array, pressed: NDArray[np.bool_]) -> Array:
        """Contacts that can't touch within the step end it where the bodies do: a rate that differs
        by what they have drifted takes them there."""
        h, count = self._h, len(gaps)
        self.gaps, drift = gaps, self._drift(gaps)
        if np.abs(drift).max() < EQUAL:
            return rates
        closer = np.maximum(rates[:count], 0.0) + 0.5 * h * np.maximum(accelerations[:count], 0.0)
        apart = ~pressed & (gaps > h * closer)
        self._check(np.where(apart, 0.0, drift), MOVED)
        rates = rates.copy()
        rates[:count] -= np.where(apart, drift / h, 0.0)
        return rates

    def _name(self, index: int) -> str:
        return self.contact.contacts[index] or "the contact"

    def _pressed(self) -> NDArray[np.bool_]:
        """Which contacts push now."""
        return np.asarray(np.atleast_1d(self.contact["force"]) > 0.0)

    def _drift(self, gaps: Array) -> Array:
        """What is between the bodies and the FMU, for each contact [m]."""
        return np.asarray(gaps + np.atleast_1d(self.contact["indentation"]))

    def _check(self, drift: Array, why: str) -> None:
        """Refuse what differs by too much."""
        gaps = self.gaps
        if np.abs(drift).max() <= WITHIN:
            return
        wrong = np.abs(drift) > _allowed(gaps)
        if wrong.any():
            index = int(np.abs(drift * wrong).argmax())
            raise ContactError(
                f"{self._name(index)}: distance {gaps[index]:.6g} m in the engine, indentation "
                f"{drift[index] - gaps[index]:.6g} m in the FMU, {abs(drift[index]):.3g} m apart: {why}"
            )

    def _run(self, step: _Step, here: _Here) -> tuple[Array, Array]:
        """A step of the FMU with the rows `here`; the impulses [N s] of all rows and their moments
        [N s^2]."""
        contact, count, directions = self.contact, len(self.gaps), self._directions
        self.inverse_masses = here.inverse_masses()
        run = self._run_together if contact.shares_bodies else self._run_alone
        impulses, moments = run(step.rates, step.accelerations)
        if directions > 0:
            forces = impulses[count:].reshape(directions, count) / self._h
            self.tangential_forces = -np.einsum("dc,dcx->cx", forces, here.tangents)
        stuck = (self.forces > 0.0) & here.still[:count]
        if stuck.any():
            raise ContactError(
                f"{self._name(int(stuck.argmax()))} pushes, but its bodies can't move along its normal in this pose: "
                "a contact needs a joint that lets them move apart"
            )
        return impulses, moments

    def _run_together(self, rates: Array, accelerations: Array) -> tuple[Array, Array]:
        """The same with an FMU that moves the bodies of all contacts by the inverse masses."""
        contact, h = self.contact, self._h
        count, directions = len(self.gaps), self._directions
        given: dict[str, Any] = {"inverse_masses": self.inverse_masses}
        if directions > 0:
            given["tangential_rate"] = self._by_contact(rates)
            given["tangential_acceleration"] = self._by_contact(accelerations)
        self.forces = np.atleast_1d(contact.step(h, rates[:count], accelerations[:count], **given))
        moments = np.atleast_1d(contact["impulse_moment"])
        if directions == 0:
            return h * self.forces, moments
        tangential = [contact.tangential_force, contact["tangential_impulse_moment"]]
        forces, more = (np.reshape(values, (count, directions)).T for values in tangential)
        return (h * np.concatenate((self.forces, forces.ravel())), np.concatenate((moments, more.ravel())))

    def _run_alone(self, rates: Array, accelerations: Array) -> tuple[Array, Array]:
        """The same with an FMU that moves each pair of bodies by its effective mass."""
        contact, h = self.contact, self._h
        own = np.diagonal(self.inverse_masses)
        coupled = np.abs(self.inverse_masses - np.diag(own)).max()
        if coupled > ALONE * own.max():
            raise ContactError(
                f"{contact.path.name} moves each contact alone, but these contacts share bodies: "
                'inverse_masses = "input" under [coupling] of its scene must stand in place of '
                "effective_mass"
            )
        masses = 1.0 / own
        if contact.one_mass and np.ptp(masses) > ALONE * masses.max():
            raise ContactError(
                f"{contact.path.name} has one effective_mass, and these contacts have {masses} kg: "
                'parameters_per_contact = ["effective_mass"] in its scene gives each its own'
            )
        before = np.atleast_1d(contact["indentation"])
        given = float(masses[0]) if contact.one_mass else masses
        self.forces = np.atleast_1d(contact.step(h, rates, accelerations, mass=given))
        # what a contact that pushes lacks of the way without its force
        lacking = h * (rates + 0.5 * h * accelerations)
        lacking -= np.atleast_1d(contact["indentation"]) - before
        return h * self.forces, np.where(self.forces > 0.0, lacking / own, 0.0)

    def _of_all(self, each: Any) -> Any:
        """What each contact has, for all of its rows."""
        return each[self._contact_of]

    def _by_contact(self, rows: Array) -> Array:
        """The tangential part of a number for each row, as the FMU takes it."""
        count = len(self.gaps)
        by_contact = rows[count:].reshape(self._directions, count).T
        return by_contact[:, 0] if self._directions == 1 else by_contact

    def _settle(self, pushed: NDArray[np.bool_], there: _Here) -> tuple[Array, Array]:
        """Move the bodies to the indentations of contacts that have pushed, with as little slip as this
        leaves. What has slipped counts in later steps, or jammed bodies would creep: returns it, and
        what is left between the bodies and the FMU."""
        count, slipped = len(pushed), self._slipped * self._of_all(pushed)
        for tries in range(TRIES):
            self.gaps = self._distances().gaps
            drift = self._drift(self.gaps)
            if tries == TRIES - 1 or not np.abs(drift[pushed]).max(initial=0.0) > EQUAL:
                break
            rows = np.flatnonzero(self._of_all(pushed) & ~there.still)
            normals, slips = rows[rows < count], rows[rows >= count]
            way, slipped[slips] = self._way(normals, -drift[normals], slips, -slipped[slips])
            place, speed = self._state()
            self._put(self._moved(place, way @ there.response[rows], 1.0), speed)
        return slipped, drift

    def _way(self, normals: Any, ways: Array, slips: Any, back: Array) -> tuple[Array, Array]:
        """Impulses over a time of 1 s that move the bodies along the rows `normals` by these ways, and
        along the rows `slips` by those of `back`, as far as they can. Redundant contacts can't all
        follow. Also what is left of the slips."""
        masses = self.inverse_masses
        largest = np.diagonal(masses).max()
        coupling = masses[np.ix_(slips, normals)]
        inverse = _inverse(masses[np.ix_(normals, normals)], largest)
        free = masses[np.ix_(slips, slips)] - coupling @ inverse @ coupling.T
        back = back - coupling @ (inverse @ ways)
        along = _inverse(free, largest, LEVER) @ back
        return np.concatenate((inverse @ (ways - coupling.T @ along), along)), free @ along - back


def _inverse(matrix: Array, largest: float, part: float = SINGULAR) -> Array:
    """The inverse, without the directions in which nothing moves."""
    values, vectors = np.linalg.eigh(matrix)
    moves = values > part * largest
    return np.asarray((vectors[:, moves] / values[moves]) @ vectors[:, moves].T)


def _across(vectors: Array, normals: Array) -> Array:
    """These vectors without their part along the normals, of length 1."""
    along = np.einsum("...x,...x->...", vectors, normals)
    across = vectors - along[..., None] * normals
    return np.asarray(across / np.sqrt(np.einsum("...x,...x->...", across, across))[..., None])


def _differ(change: Array, whole: Array, part: float) -> bool:
    """Whether this is more than a part of the whole."""
    return bool(np.abs(change).max() > part * np.abs(whole).max())


def _allowed(gaps: Array) -> Array:
    """By how much these distances may differ from those of the FMU [m]."""
    return np.maximum(WITHIN, PART * np.abs(gaps))
