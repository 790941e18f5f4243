"""Contacts between bodies of an engine: what does not depend on the engine."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from .contact import Contact
from .errors import ContactError
from .library import Library

SINGULAR = 1e-9
"""Directions in which the inverse masses are smaller than this part of the largest are those of
redundant contacts, such as the fourth foot of a box: nothing moves along them."""
ALONE = 1e-9
"""Contacts whose inverse masses couple by less than this part of their own share no body."""
APART = 1e-2
"""Time derivatives are differences between this part of a step later and earlier."""

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

    @property
    def radius(self) -> float:
        """Distance of the centres when the surfaces touch [m]."""
        return self.own + self.reach


@dataclass(frozen=True)
class _Here:
    """What a step needs to know of a state of the engine."""

    gaps: Array
    """Distance [m] of each pair."""
    pressed: Array
    """Distance of the centres, over that when the surfaces touch; at most 1. For each row."""
    acceleration: Array
    """By all but these contacts."""
    away: Array
    """How velocities change the distances, and the ways along the tangents: the rows."""
    rolling: Array
    """How the rows change with `pressed`: a dent shortens the arms of friction."""
    change: Array
    """How the rows change with time."""
    response: Array
    """How an impulse along each row changes the velocities."""
    turning: Array
    """How that changes with time."""


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
    tangents in each direction."""

    def __init__(
        self, pairs: Sequence[Pair], contact: Attachable, parameters: dict[str, Any]
    ) -> None:
        self._shapes = pairs
        self.gaps, _ = self._distances()
        count = len(pairs)
        self.forces, self.tangential_forces = np.zeros(count), np.zeros((count, 3))
        self._tangents = np.zeros((0, count, 3))
        if not isinstance(contact, Contact):
            contact, parameters = Contact(contact, **parameters), {}
        self.contact = contact
        self._directions = contact.directions
        rows = count * (1 + self._directions)
        self.inverse_masses = np.zeros((rows, rows))
        # way along each row since its contact began to push that only a correction made [m]
        self._slipped = np.zeros(rows)
        try:
            if len(contact.contacts) != count:
                shown = ", ".join(contact.contacts)
                raise ContactError(
                    f"{count} contacts of the engine: {contact.path.name} has {shown}"
                )
            if not contact.shares_bodies:
                self._check_alone()
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
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
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
        """The acceleration in this state by all but these contacts."""

    @abstractmethod
    def _solve(self, rows: Array) -> Array:
        """The inverse of the mass matrix times each of these rows."""

    @abstractmethod
    def _geometry(self, index: int) -> tuple[Array, Array, Array]:
        """Of a pair: the centre of its sphere and that of the other one, or a point of the plane
        [m], and the axes of the other one as rows, of which the third is the normal of a plane."""

    @abstractmethod
    def _jacobians(self, index: int) -> tuple[Array, Array]:
        """Of a pair: how velocities move the centre of its sphere and turn it, and the same of the
        other: two of 3 rows each."""

    @abstractmethod
    def _end(
        self, start: tuple[Array, Array], place: Array, speed: Array, acceleration: Array
    ) -> None:
        """The engine's own step from the state `start`, after which its places are `place`, and its
        velocities `speed` plus those of a step with this acceleration."""

    # what is the same

    def _distances(self) -> tuple[Array, Array]:
        """Distance [m] of each pair, and its direction from the other to the first."""
        gaps, normals = np.zeros(len(self._shapes)), np.zeros((len(self._shapes), 3))
        for index, pair in enumerate(self._shapes):
            centre, other, axes = self._geometry(index)
            between = centre - other
            if pair.is_plane:
                normals[index] = axes[2]
                distance = axes[2] @ between
            else:
                distance = np.linalg.norm(between)
                normals[index] = between / distance
            gaps[index] = distance - pair.radius
        return gaps, normals

    def _turned_tangents(self, normals: Array) -> Array:
        """The tangents of each contact in each direction: those of the step before, turned with the
        normal; at first, along the axes of the other one of its pair."""
        before = self._tangents
        if len(before) == 0:
            axes = [self._geometry(index)[2] for index in range(len(normals))]
            # the axis that is most across the normal
            best = [
                axis[np.argmin(np.abs(axis @ normal))]
                for axis, normal in zip(axes, normals, strict=True)
            ]
            before = np.array([best, np.cross(normals, best)])[: self._directions]
        along = np.einsum("dcx,cx->dc", before, normals)
        across = before - along[..., None] * normals
        return np.asarray(across / np.linalg.norm(across, axis=2, keepdims=True))

    def _rows(self, pressed: Array) -> tuple[Array, Array, Array]:
        """Derivative of each distance by the engine's velocities; then that of the way by which the
        first point of contact is behind the other, along each tangent. An impulse against the rates
        acts along these rows. Also how they change with `pressed`, and the tangents.

        Distances are those of the centres of spheres: a centre and the point of contact lie on one
        normal and close at the same rate. `pressed` says where the point of contact is.
        """
        _, normals = self._distances()
        tangents, sliding, rolling = self._tangents, [], []
        if self._directions > 0:
            tangents = self._turned_tangents(normals)
        for index, (pair, normal) in enumerate(zip(self._shapes, normals, strict=True)):
            first, other = self._jacobians(index)
            apart, along = first[0] - other[0], tangents[:, index]
            sliding.append([normal @ apart, *(-along @ apart)])
            # from the centres to the point of contact, which both have in common while pressed
            turns = pair.own * first[1] + pair.reach * other[1]
            rolling.append([np.zeros_like(apart[0]), *(np.cross(normal, along) @ turns)])
        parts = np.swapaxes((sliding, rolling), 1, 2).reshape(2, len(pressed), -1)
        return parts[0] + pressed[:, None] * parts[1], parts[1], tangents

    def _now(self, place: Array, speed: Array) -> _Here:
        """What a step needs to know of this state."""
        self._put(place, speed)
        acceleration, (gaps, _) = self._acceleration(), self._distances()
        # how deep they are pressed changes at other rates, within an impact
        radii = np.array([pair.radius for pair in self._shapes])
        pressed = np.tile(np.minimum(1.0, 1.0 + gaps / radii), 1 + self._directions)
        away, rolling, self._tangents = self._rows(pressed)
        response, time, ends = self._solve(away), APART * self._timestep, []
        for way in (time, -time):
            self._put(self._moved(place, speed, way), speed)
            rows = self._rows(pressed)[0]
            ends.append((rows, self._solve(rows)))
        (away_after, after), (away_before, before) = ends
        change, turning = (away_after - away_before) / (2 * time), (after - before) / (2 * time)
        return _Here(gaps, pressed, acceleration, away, rolling, change, response, turning)

    def step(self) -> Array:
        """Make a step of the engine, instead of its own; return the mean force [N] of each contact.

        The engine computes the acceleration `a` of its bodies without these contacts, and the FMU
        the impulses `P` of the contacts and their moments `Q`. The velocities change by `h a` and
        by the impulses. An engine's Euler method moves the bodies by `h` times the new velocity.
        Here they move by `h v + h^2/2 a` and by the moments, which is exact for what the FMU
        integrates.

        Bodies turn within a step. So `a` is that at the middle of a step (the Verlet method, of
        second order). If any contact pushes, the FMU makes the step again, with the bodies at the
        mean time of the impulses: with their inverse masses and accelerations there, with the
        directions and arms of each impulse at its own mean time, and with the velocities before the
        impulses until then, and those after them from then on. Errors are of second order in the
        angle of a step.

        Contacts that pushed: the bodies are set to the indentations of the FMU, along the
        directions in which impulses move them. Contacts that are apart follow the bodies.

        If the FMU refuses the step, the bodies stay where they are.
        """
        start = self._state()
        try:
            self._advance(start)
        except BaseException:
            self._put(*start)
            raise
        return self.forces

    def _advance(self, start: tuple[Array, Array]) -> None:
        """The step from this state."""
        contact, h, count = self.contact, self._timestep, len(self._shapes)
        place, speed = start
        here = self._now(place, speed)
        gaps, before = here.gaps, contact.save()
        self.inverse_masses = _symmetric(here.away @ here.response.T)
        rates, pull = -(here.away @ speed), here.acceleration
        impulses, moments = self._step(rates, -(here.away @ pull + here.change @ speed), gaps)
        pushes, time = self.forces > 0.0, 0.5 * h
        if pushes.any():
            time = h - moments[:count].sum() / impulses[:count].sum()

        middle, fast = self._moved(place, speed, time), speed + time * pull
        if not pushes.any():
            self._put(middle, fast)
            pull = self._acceleration()
            self._end(start, self._moved(place, speed + 0.5 * h * pull, h), speed, pull)
            self.gaps, _ = self._distances()
            self._slipped[:] = 0.0
            return

        there = self._now(middle, fast)
        self.inverse_masses = _symmetric(there.away @ there.response.T)
        # impulses act at the arms of this time: other ones for the rates would take energy
        rates -= (there.pressed - here.pressed) * (here.rolling @ speed)
        pull = there.acceleration
        contact.restore(before)
        impulses, moments = self._step(rates, -(there.away @ pull + there.change @ fast), gaps)
        pushes = self.forces > 0.0
        parts = np.full(count, h - time)
        np.divide(moments[:count], impulses[:count], out=parts, where=pushes)
        # friction acts while its contact pushes
        times = np.tile(h - parts, 1 + self._directions)
        response = there.response + (times - time)[:, None] * there.turning
        kick = impulses @ response
        self._put(middle, fast + kick)
        pull = (time * pull + (h - time) * self._acceleration()) / h
        mean = speed + 0.5 * h * pull + moments @ response / h
        self._end(start, self._moved(place, mean, h), speed + kick, pull)
        self._settle(pushes, response)

    def _step(self, rates: Array, accelerations: Array, gaps: Array) -> tuple[Array, Array]:
        """A step of the FMU; the impulses [N s] of all rows and their moments [N s^2]."""
        contact, h = self.contact, self._timestep
        count, directions = len(gaps), self._directions
        if not contact.shares_bodies:
            return self._step_alone(rates, accelerations, gaps)
        given: dict[str, Any] = {"gap": gaps, "inverse_masses": self.inverse_masses}
        if directions > 0:
            given["tangential_rate"] = self._by_contact(rates)
            given["tangential_acceleration"] = self._by_contact(accelerations)
        self.forces = np.atleast_1d(contact.step(h, rates[:count], accelerations[:count], **given))
        moments = np.atleast_1d(contact["impulse_moment"])
        if directions == 0:
            return h * self.forces, moments
        tangential = [contact.tangential_force, contact["tangential_impulse_moment"]]
        forces, more = (np.reshape(values, (count, directions)).T for values in tangential)
        self.tangential_forces = -np.einsum("dc,dcx->cx", forces, self._tangents)
        return (
            h * np.concatenate((self.forces, forces.ravel())),
            np.concatenate((moments, more.ravel())),
        )

    def _step_alone(self, rates: Array, accelerations: Array, gaps: Array) -> tuple[Array, Array]:
        """The same with an FMU that moves each pair of bodies by its effective mass."""
        contact, h = self.contact, self._timestep
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
        forces = contact.step(h, rates, accelerations, gap=gaps, mass=given)
        self.forces = np.atleast_1d(forces)
        # what a contact that pushes lacks of the way without its force
        lacking = h * (rates + 0.5 * h * accelerations)
        lacking -= np.atleast_1d(contact["indentation"]) - before
        return h * self.forces, np.where(self.forces > 0.0, lacking / own, 0.0)

    def _by_contact(self, rows: Array) -> Array:
        """The tangential part of a number for each row, as the FMU takes it."""
        count = len(self._shapes)
        by_contact = rows[count:].reshape(self._directions, count).T
        return by_contact[:, 0] if self._directions == 1 else by_contact

    def _settle(self, pushed: NDArray[np.bool_], response: Array) -> None:
        """Move the bodies of these contacts to their indentations, without slip. Redundant contacts
        can't all follow; what has slipped counts in later steps, or jammed bodies would creep."""
        self.gaps, _ = self._distances()
        count, rows = len(pushed), np.tile(pushed, 1 + self._directions)
        error = np.where(rows, self._slipped, 0.0)
        error[:count] = self.gaps + np.atleast_1d(self.contact["indentation"])
        masses = self.inverse_masses[:, rows]
        way = np.linalg.lstsq(masses[rows], -error[rows], rcond=SINGULAR)[0]
        self._slipped = np.where(rows, error + masses @ way, 0.0)
        place, speed = self._state()
        self._put(self._moved(place, way @ response[rows], 1.0), speed)
        self.gaps, _ = self._distances()


def _symmetric(matrix: Array) -> Array:
    """Without the rounding of a product."""
    return 0.5 * (matrix + matrix.T)
