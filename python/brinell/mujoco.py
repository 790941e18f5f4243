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
SINGULAR = 1e-9
"""Directions in which the inverse masses are smaller than this part of the largest are those of
redundant contacts, such as the fourth foot of a box: nothing moves along them."""

Array = NDArray[np.float64]


def attach(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    pairs: Sequence[tuple[str, str]],
    unit: str | Path | Library,
    **parameters: Any,
) -> Attached:
    """Let an FMU compute the contacts of these pairs of geoms: `Attached.step` then takes the place
    of `mj_step`.

    `pairs` are names of geoms, one pair for each contact of the FMU, in its order: a sphere and a
    plane, or two spheres. `unit` is an FMU whose scene has `inverse_masses = "input"` under
    `[coupling]`, and `parameters_per_contact = ["initial_gap"]` for contacts with a `count`. Its
    contacts start at the distances in `data`. `parameters` are those of `Contact`.

    MuJoCo's own contact of a pair must be off: `contype="0" conaffinity="0"`, or an `<exclude>`.
    The integrator must be Euler, MuJoCo's default. The bodies must be free to follow the impulses
    but for their joints: the FMU does not know the constraints of the engine (equalities, limits,
    other contacts), whose forces are those at the start of a step.
    """
    if model.opt.integrator != mujoco.mjtIntegrator.mjINT_EULER:
        name = mujoco.mjtIntegrator(model.opt.integrator).name.removeprefix("mjINT_").lower()
        raise ContactError(f"integrator = {name}: attach needs MuJoCo's default, Euler")
    return Attached(model, data, [_pair(model, names) for names in pairs], unit, parameters)


@dataclass(frozen=True)
class _Pair:
    """Two geoms that touch: a sphere, and a plane or another sphere."""

    geom: int
    body: int
    other: int
    other_body: int
    radius: float
    """Sum of the radii [m]; the radius of the sphere above a plane."""
    is_plane: bool


def _pair(model: mujoco.MjModel, names: tuple[str, str]) -> _Pair:
    shown = " and ".join(repr(name) for name in names)
    if isinstance(names, str) or len(names) != 2:
        raise ContactError(f"pair {names!r}: two names of geoms are needed")
    geoms = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_GEOM, name) for name in names]
    for name, geom in zip(names, geoms, strict=True):
        if geom < 0:
            there = ", ".join(model.geom(index).name for index in range(model.ngeom))
            raise UnknownName(f"the model has no geom {name!r}; there are: {there}")
    geoms.sort(key=lambda geom: model.geom_type[geom] != SPHERE)
    kinds = [mujoco.mjtGeom(model.geom_type[geom]) for geom in geoms]
    if kinds[0] != SPHERE or kinds[1] not in (SPHERE, PLANE):
        found = " and ".join(kind.name.removeprefix("mjGEOM_").lower() for kind in kinds)
        raise ContactError(
            f"pair {shown}: {found}; allowed are a sphere and a plane, or two spheres"
        )
    if _collide(model, *geoms):
        raise ContactError(
            f"pair {shown}: MuJoCo's own contact is on; switch it off with contype=\"0\" "
            'conaffinity="0" at the geoms, or with <exclude> for their bodies'
        )
    first, other = geoms
    is_plane = kinds[1] == PLANE
    radius = model.geom_size[first, 0] + (0.0 if is_plane else model.geom_size[other, 0])
    bodies = model.geom_bodyid
    return _Pair(first, bodies[first], other, bodies[other], float(radius), is_plane)


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
    gaps: Array
    """Distance [m] of each pair in the engine, after the last step; negative: pressed in."""
    inverse_masses: Array
    """The matrix of inverse effective masses [1/kg] in the last step."""

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
        self.forces, self.inverse_masses = np.zeros(count), np.zeros((count, count))
        self.contact = contact = Contact(unit, **parameters)
        try:
            if len(contact.contacts) != count:
                shown = ", ".join(contact.contacts)
                raise ContactError(f"{count} pairs of geoms: {contact.path.name} needs {shown}")
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
            between = data.geom_xpos[pair.geom] - data.geom_xpos[pair.other]
            if pair.is_plane:
                normals[index] = data.geom_xmat[pair.other].reshape(3, 3)[:, 2]
                distance = normals[index] @ between
            else:
                distance = np.linalg.norm(between)
                normals[index] = between / distance
            gaps[index] = distance - pair.radius
        return gaps, normals

    def _directions(self, gaps: Array, normals: Array) -> tuple[Array, Array]:
        """Derivative of each distance by the engine's velocities, and the time derivative of that.

        They are those of the centres of spheres: a centre and the point of contact lie on one normal
        and close at the same rate.
        """
        model, data = self.model, self.data
        away, change = np.zeros((2, len(gaps), model.nv))
        own, others, own_change, others_change = np.zeros((4, 3, model.nv))
        for index, (pair, normal) in enumerate(zip(self._pairs, normals, strict=True)):
            centre, other = data.geom_xpos[pair.geom], data.geom_xpos[pair.other]
            mujoco.mj_jac(model, data, own, None, centre, pair.body)
            mujoco.mj_jac(model, data, others, None, other, pair.other_body)
            mujoco.mj_jacDot(model, data, own_change, None, centre, pair.body)
            mujoco.mj_jacDot(model, data, others_change, None, other, pair.other_body)
            away[index] = normal @ (own - others)
            change[index] = normal @ (own_change - others_change)
            if not pair.is_plane:
                # planes stand still; the line between two centres turns
                slip = (own - others) @ data.qvel
                sideways = slip - normal * (normal @ slip)
                change[index] += sideways @ (own - others) / (gaps[index] + pair.radius)
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
        h = model.opt.timestep
        place, speed = data.qpos.copy(), data.qvel.copy()
        mujoco.mj_forward(model, data)
        self.gaps, away, change, response, _ = self._now()
        rates, accelerations = -(away @ speed), -(away @ data.qacc + change @ speed)
        self.inverse_masses = _symmetric(away @ response.T)
        given = {"gap": self.gaps, "inverse_masses": self.inverse_masses}
        before = contact.save()
        self.forces = np.atleast_1d(contact.step(h, rates, accelerations, **given))
        pushes, time = self.forces > 0.0, 0.5 * h
        if pushes.any():
            moments = np.atleast_1d(contact["impulse_moment"])
            time = h - moments.sum() / (h * self.forces.sum())

        mujoco.mj_integratePos(model, data.qpos, speed, time)
        data.qvel = speed + time * data.qacc
        mujoco.mj_forward(model, data)
        if not pushes.any():
            self._advance(place, speed, speed + 0.5 * h * data.qacc)
            return self.forces

        _, away, change, response, turning = self._now()
        accelerations = -(away @ data.qacc + change @ data.qvel)
        self.inverse_masses = _symmetric(away @ response.T)
        given["inverse_masses"] = self.inverse_masses
        contact.restore(before)
        self.forces = np.atleast_1d(contact.step(h, rates, accelerations, **given))
        moments, impulses = np.atleast_1d(contact["impulse_moment"]), h * self.forces
        pushes = self.forces > 0.0
        times = h - np.divide(moments, impulses, out=np.full_like(moments, h - time), where=pushes)
        response += (times - time)[:, None] * turning
        kick, pull = impulses @ response, data.qacc.copy()
        data.qvel += kick
        mujoco.mj_forward(model, data)
        data.qacc = (time * pull + (h - time) * data.qacc) / h
        mean = speed + 0.5 * h * data.qacc + moments @ response / h
        self._advance(place, speed + kick, mean)
        self._settle(pushes, response)
        return self.forces

    def _now(self) -> tuple[Array, Array, Array, Array, Array]:
        """Distances, their derivatives by the velocities, the time derivatives of these, and how an
        impulse at each contact changes the velocities by the former and by the latter."""
        gaps, normals = self._distances()
        away, change = self._directions(gaps, normals)
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
        """Move the bodies of these contacts to their indentations."""
        model, data = self.model, self.data
        error = (self.gaps + np.atleast_1d(self.contact["indentation"]))[pushed]
        masses = self.inverse_masses[np.ix_(pushed, pushed)]
        way = np.linalg.lstsq(masses, -error, rcond=SINGULAR)[0]
        mujoco.mj_integratePos(model, data.qpos, way @ response[pushed], 1.0)
        mujoco.mj_kinematics(model, data)
        self.gaps, _ = self._distances()


def _symmetric(matrix: Array) -> Array:
    """Without the rounding of a product."""
    return 0.5 * (matrix + matrix.T)
