"""Contacts that share bodies in MuJoCo: one FMU moves all of them together, in the engine's own steps."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import mujoco
import numpy as np
from numpy.typing import NDArray

from .contact import Contact
from .errors import ContactError, UnknownName
from .library import Library

SPHERE, PLANE = mujoco.mjtGeom.mjGEOM_SPHERE, mujoco.mjtGeom.mjGEOM_PLANE
CAPSULE, BOX = mujoco.mjtGeom.mjGEOM_CAPSULE, mujoco.mjtGeom.mjGEOM_BOX
SINGULAR = 1e-9
"""Directions in which the inverse masses are smaller than this part of the largest are those of
redundant contacts, such as the fourth foot of a box: nothing moves along them."""

Array = NDArray[np.float64]


def attach(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    pairs: Sequence[tuple[str, str]],
    unit: str | Path | Library,
    *,
    corner: float | None = None,
    **parameters: Any,
) -> Attached:
    """Let an FMU compute the contacts of these pairs of geoms: `Attached.step` then takes the place
    of `mj_step`.

    `pairs` are names of geoms, in the order of the contacts of the FMU:

    - a sphere and a plane, or two spheres: one contact;
    - a capsule and a plane: its two ends, the positive one first;
    - a box and a plane: its eight corners, spheres of the radius `corner` [m] inside the box, in
      the order of their coordinates (x first, negative ones first).

    `unit` is an FMU whose scene has `inverse_masses = "input"` under `[coupling]`, and
    `parameters_per_contact = ["initial_gap"]` for contacts with a `count`. Its contacts start at
    the distances in `data`. A scene with `[friction]` should have `directions = 2`; with one, only
    the first tangent of each contact has friction, which is across the normal along an axis of the
    other geom. `parameters` are those of `Contact`.

    MuJoCo's own contact of a pair must be off: `contype="0" conaffinity="0"`, or an `<exclude>`.
    The integrator must be Euler, MuJoCo's default. The bodies must be free to follow the impulses
    but for their joints: the FMU does not know the constraints of the engine (equalities, limits,
    other contacts), whose forces are those at the start of a step.
    """
    if model.opt.integrator != mujoco.mjtIntegrator.mjINT_EULER:
        name = mujoco.mjtIntegrator(model.opt.integrator).name.removeprefix("mjINT_").lower()
        raise ContactError(f"integrator = {name}: attach needs MuJoCo's default, Euler")
    spheres = [pair for names in pairs for pair in _pairs_of(model, names, corner)]
    return Attached(model, data, spheres, unit, parameters)


@dataclass(frozen=True)
class _Pair:
    """A sphere that touches a plane or another sphere."""

    geom: int
    body: int
    place: Array
    """The centre of the sphere in its geom [m]."""
    own: float
    """Its radius [m]."""
    other: int
    other_body: int
    reach: float
    """Radius of the other sphere [m]; zero for a plane."""
    is_plane: bool

    @property
    def radius(self) -> float:
        """Distance of the centres when the surfaces touch [m]."""
        return self.own + self.reach

    def centre(self, data: mujoco.MjData) -> Array:
        """The centre of the sphere in the world [m]."""
        turned = data.geom_xmat[self.geom].reshape(3, 3) @ self.place
        return np.asarray(data.geom_xpos[self.geom] + turned)


def _pairs_of(model: mujoco.MjModel, names: tuple[str, str], corner: float | None) -> list[_Pair]:
    """The spheres of a pair of geoms."""
    shown = " and ".join(repr(name) for name in names)
    if isinstance(names, str) or len(names) != 2:
        raise ContactError(f"pair {names!r}: two names of geoms are needed")
    geoms = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_GEOM, name) for name in names]
    for name, geom in zip(names, geoms, strict=True):
        if geom < 0:
            there = ", ".join(model.geom(index).name for index in range(model.ngeom))
            raise UnknownName(f"the model has no geom {name!r}; there are: {there}")
    geoms.sort(key=lambda geom: model.geom_type[geom] == PLANE)
    kinds = [mujoco.mjtGeom(model.geom_type[geom]) for geom in geoms]
    on_plane = kinds[0] in (SPHERE, CAPSULE, BOX) and kinds[1] == PLANE
    if not on_plane and kinds != [SPHERE, SPHERE]:
        found = " and ".join(kind.name.removeprefix("mjGEOM_").lower() for kind in kinds)
        raise ContactError(
            f"pair {shown}: {found}; allowed are a sphere, a capsule or a box and a plane, or two "
            "spheres"
        )
    if _collide(model, *geoms):
        raise ContactError(
            f"pair {shown}: MuJoCo's own contact is on; switch it off with contype=\"0\" "
            'conaffinity="0" at the geoms, or with <exclude> for their bodies'
        )
    first, other = geoms
    size, bodies = model.geom_size[first], model.geom_bodyid
    own, places = float(size[0]), np.zeros((1, 3))
    if kinds[0] == CAPSULE:
        places = np.array([[0.0, 0.0, size[1]], [0.0, 0.0, -size[1]]])
    elif kinds[0] == BOX:
        if corner is None or not 0.0 < corner <= size.min():
            raise ContactError(
                f"pair {shown}: corner = {corner}: a box needs the radius of its corners [m], "
                f"above 0 and at most {size.min():g}"
            )
        own = corner
        signs = np.stack(np.meshgrid(*[[-1.0, 1.0]] * 3, indexing="ij"), axis=-1).reshape(8, 3)
        places = signs * (size - corner)
    reach = 0.0 if on_plane else float(model.geom_size[other, 0])
    return [
        _Pair(first, bodies[first], place, own, other, bodies[other], reach, on_plane)
        for place in places
    ]


def _collide(model: mujoco.MjModel, first: int, other: int) -> bool:
    """Whether MuJoCo looks for contacts of two geoms."""
    if model.opt.disableflags & mujoco.mjtDisableBit.mjDSBL_CONTACT:
        return False
    explicit = zip(model.pair_geom1, model.pair_geom2, strict=True)
    if any({first, other} == {*both} for both in explicit):
        return True
    low, high = sorted(int(model.geom_bodyid[geom]) for geom in (first, other))
    if (low << 16) + high in model.exclude_signature:
        return False
    kinds, others = model.geom_contype, model.geom_conaffinity
    return bool(kinds[first] & others[other] or kinds[other] & others[first])


class Attached:
    """The contacts of an FMU in a model of MuJoCo; `attach` makes it."""

    contact: Contact
    """The FMU: `contact["dissipated_energy"]` reads its variables."""
    forces: Array
    """Mean force [N] of each contact over the last step."""
    tangential_forces: Array
    """Mean tangential forces [N] of each contact over the last step, in world coordinates, on the
    first geom of its pair; zero without friction."""
    gaps: Array
    """Distance [m] of each pair in the engine, after the last step; negative: pressed in."""
    inverse_masses: Array
    """The matrix of inverse effective masses [1/kg] in the last step: of the normals, then of the
    tangents in each direction."""

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        pairs: Sequence[_Pair],
        unit: str | Path | Library,
        parameters: dict[str, Any],
    ) -> None:
        self.model, self.data, self._pairs = model, data, pairs
        mujoco.mj_kinematics(model, data)
        self.gaps, _ = self._distances()
        count = len(pairs)
        self.forces, self.tangential_forces = np.zeros(count), np.zeros((count, 3))
        self._tangents = np.zeros((0, count, 3))
        self.contact = contact = Contact(unit, **parameters)
        self._directions = contact.directions
        rows = count * (1 + self._directions)
        self.inverse_masses = np.zeros((rows, rows))
        try:
            if len(contact.contacts) != count:
                shown = ", ".join(contact.contacts)
                raise ContactError(f"{count} contacts of geoms: {contact.path.name} has {shown}")
            contact.reset(initial_gap=self.gaps)
        except BaseException:
            contact.close()
            raise

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

    def _distances(self) -> tuple[Array, Array]:
        """Distance [m] of each pair, and its direction from the other geom to the first."""
        data = self.data
        gaps, normals = np.zeros(len(self._pairs)), np.zeros((len(self._pairs), 3))
        for index, pair in enumerate(self._pairs):
            between = pair.centre(data) - data.geom_xpos[pair.other]
            if pair.is_plane:
                normals[index] = data.geom_xmat[pair.other].reshape(3, 3)[:, 2]
                distance = normals[index] @ between
            else:
                distance = np.linalg.norm(between)
                normals[index] = between / distance
            gaps[index] = distance - pair.radius
        return gaps, normals

    def _turn_tangents(self, normals: Array) -> Array:
        """The tangents of each contact in each direction: those of the step before, turned with the
        normal; at first, along the axes of the other geom."""
        before = self._tangents
        if len(before) == 0:
            axes = [self.data.geom_xmat[pair.other].reshape(3, 3).T for pair in self._pairs]
            # the axis that is most across the normal
            best = [
                axis[np.argmin(np.abs(axis @ normal))]
                for axis, normal in zip(axes, normals, strict=True)
            ]
            before = np.array([best, np.cross(normals, best)])[: self._directions]
        along = np.einsum("dcx,cx->dc", before, normals)
        across = before - along[..., None] * normals
        return np.asarray(across / np.linalg.norm(across, axis=2, keepdims=True))

    def _rows(self, gaps: Array, normals: Array) -> tuple[Array, Array]:
        """Derivative of each distance by the engine's velocities, and the time derivative of that;
        then those of the way by which the first point of contact is behind the other, along each
        tangent. An impulse against the rates acts along these rows.

        Distances are those of the centres of spheres: a centre and the point of contact lie on one
        normal and close at the same rate.
        """
        model, data = self.model, self.data
        count = len(gaps)
        tangents = self._tangents
        away, change = np.zeros((2, count * (1 + len(tangents)), model.nv))
        jac, others = np.zeros((2, 2, 3, model.nv)), np.zeros((2, 2, 3, model.nv))
        for index, (pair, normal) in enumerate(zip(self._pairs, normals, strict=True)):
            centre, other = pair.centre(data), data.geom_xpos[pair.other]
            # translation and rotation, and their time derivatives
            mujoco.mj_jac(model, data, *jac[0], centre, pair.body)
            mujoco.mj_jac(model, data, *others[0], other, pair.other_body)
            mujoco.mj_jacDot(model, data, *jac[1], centre, pair.body)
            mujoco.mj_jacDot(model, data, *others[1], other, pair.other_body)
            apart, apart_change = jac[0, 0] - others[0, 0], jac[1, 0] - others[1, 0]
            away[index] = normal @ apart
            change[index] = normal @ apart_change
            turning = np.zeros(3)
            if not pair.is_plane:
                # planes stand still; the line between two centres turns
                slip = apart @ data.qvel
                turning = (slip - normal * (normal @ slip)) / (gaps[index] + pair.radius)
                change[index] += turning @ apart
            # from the centres to the point of contact, which both have in common while they are
            # pressed; a plane does not turn
            pressed = min(1.0, 1.0 + gaps[index] / pair.radius)
            radius, reach = pressed * pair.own, pressed * pair.reach
            for direction, tangent in enumerate(tangents[:, index]):
                row = (1 + direction) * count + index
                arm = np.cross(normal, tangent)
                tangent_turning = -normal * (tangent @ turning)
                arm_turning = np.cross(turning, tangent) + np.cross(normal, tangent_turning)
                rolling = radius * jac[:, 1] + reach * others[:, 1]
                away[row] = arm @ rolling[0] - tangent @ apart
                change[row] = arm @ rolling[1] - tangent @ apart_change
                change[row] += arm_turning @ rolling[0] - tangent_turning @ apart
        return away, change

    def step(self) -> Array:
        """Make a step of the model, instead of `mj_step`; return the mean force [N] of each contact.

        MuJoCo computes the acceleration `a` of its bodies without these contacts, and the FMU the
        impulses `P` of the contacts and their moments `Q`. The velocities change by `h a` and by
        the impulses. MuJoCo's Euler method moves the bodies by `h` times the new velocity. Here
        they move by `h v + h^2/2 a` and by the moments, which is exact for what the FMU integrates.

        Bodies turn within a step. So `a` is that at the middle of a step (the Verlet method, which
        is symplectic as MuJoCo's is, but of second order). If any contact pushes, the FMU makes the
        step again, with the bodies at the mean time of the impulses: with their inverse masses and
        accelerations there, with the directions and arms of each impulse at its own mean time, and
        with the velocities before the impulses until then, and those after them from then on.
        Errors are of second order in the angle of a step.

        Contacts that pushed: the bodies are set to the indentations of the FMU, along the
        directions in which impulses move them. Contacts that are apart follow the bodies.
        """
        model, data, contact = self.model, self.data, self.contact
        h, count = model.opt.timestep, len(self._pairs)
        place, speed = data.qpos.copy(), data.qvel.copy()
        mujoco.mj_forward(model, data)
        self.gaps, away, change, response, _ = self._now()
        rates, accelerations = -(away @ speed), -(away @ data.qacc + change @ speed)
        self.inverse_masses = _symmetric(away @ response.T)
        gaps, before = self.gaps, contact.save()
        impulses, moments = self._step(h, rates, accelerations, gaps)
        pushes, time = self.forces > 0.0, 0.5 * h
        if pushes.any():
            time = h - moments[:count].sum() / impulses[:count].sum()

        mujoco.mj_integratePos(model, data.qpos, speed, time)
        data.qvel = speed + time * data.qacc
        mujoco.mj_forward(model, data)
        if not pushes.any():
            self._advance(place, speed, speed + 0.5 * h * data.qacc)
            return self.forces

        _, away, change, response, turning = self._now()
        accelerations = -(away @ data.qacc + change @ data.qvel)
        self.inverse_masses = _symmetric(away @ response.T)
        contact.restore(before)
        impulses, moments = self._step(h, rates, accelerations, gaps)
        pushes = self.forces > 0.0
        parts = np.full(count, h - time)
        np.divide(moments[:count], impulses[:count], out=parts, where=pushes)
        # friction acts while its contact pushes
        times = np.tile(h - parts, 1 + self._directions)
        response += (times - time)[:, None] * turning
        kick, pull = impulses @ response, data.qacc.copy()
        data.qvel += kick
        mujoco.mj_forward(model, data)
        data.qacc = (time * pull + (h - time) * data.qacc) / h
        mean = speed + 0.5 * h * data.qacc + moments @ response / h
        self._advance(place, speed + kick, mean)
        self._settle(pushes, response)
        return self.forces

    def _step(
        self, h: float, rates: Array, accelerations: Array, gaps: Array
    ) -> tuple[Array, Array]:
        """A step of the FMU; the impulses [N s] of all rows and their moments [N s^2]."""
        contact, count, directions = self.contact, len(self._pairs), self._directions
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

    def _by_contact(self, rows: Array) -> Array:
        """The tangential part of a number for each row, as the FMU takes it."""
        count = len(self._pairs)
        by_contact = rows[count:].reshape(self._directions, count).T
        return by_contact[:, 0] if self._directions == 1 else by_contact

    def _now(self) -> tuple[Array, Array, Array, Array, Array]:
        """Distances, their derivatives by the velocities, the time derivatives of these, and how an
        impulse at each contact changes the velocities by the former and by the latter."""
        gaps, normals = self._distances()
        if self._directions > 0:
            self._tangents = self._turn_tangents(normals)
        away, change = self._rows(gaps, normals)
        response, turning = np.zeros_like(away), np.zeros_like(away)
        mujoco.mj_solveM(self.model, self.data, response, away)
        mujoco.mj_solveM(self.model, self.data, turning, change)
        return gaps, away, change, response, turning

    def _advance(self, place: Array, speed: Array, mean: Array) -> None:
        """The engine's step from `place` and `speed` with its present acceleration, but with `mean`
        as the mean velocity over the step."""
        model, data = self.model, self.data
        data.qvel = speed
        mujoco.mj_Euler(model, data)
        data.qpos = place
        mujoco.mj_integratePos(model, data.qpos, mean, model.opt.timestep)
        mujoco.mj_kinematics(model, data)
        self.gaps, _ = self._distances()

    def _settle(self, pushed: NDArray[np.bool_], response: Array) -> None:
        """Move the bodies of these contacts to their indentations, without slip."""
        model, data = self.model, self.data
        rows = len(self.inverse_masses)
        error = np.zeros(rows)
        error[: len(pushed)] = self.gaps + np.atleast_1d(self.contact["indentation"])
        pushed = np.tile(pushed, 1 + self._directions)
        masses = self.inverse_masses[np.ix_(pushed, pushed)]
        way = np.linalg.lstsq(masses, -error[pushed], rcond=SINGULAR)[0]
        mujoco.mj_integratePos(model, data.qpos, way @ response[pushed], 1.0)
        mujoco.mj_kinematics(model, data)
        self.gaps, _ = self._distances()


def _symmetric(matrix: Array) -> Array:
    """Without the rounding of a product."""
    return 0.5 * (matrix + matrix.T)

