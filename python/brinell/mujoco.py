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
        """Derivative of each distance by the engine's velocities, and the part of its second
        derivative [m/s^2] that the velocities make without any acceleration.

        The distance is that of the centre of the sphere, so that both are those of its centre. The
        centre and the point of contact lie on one normal and close at the same rate.
        """
        model, data = self.model, self.data
        away, bends = np.zeros((len(gaps), model.nv)), np.zeros(len(gaps))
        own, others, turn = (np.zeros((3, model.nv)) for _ in range(3))
        for index, (pair, normal) in enumerate(zip(self._pairs, normals, strict=True)):
            centre = data.geom_xpos[pair.geom]
            at = centre if pair.is_plane else data.geom_xpos[pair.other]
            mujoco.mj_jac(model, data, own, None, centre, pair.body)
            mujoco.mj_jac(model, data, others, turn, at, pair.other_body)
            away[index] = normal @ (own - others)
            slip = (own - others) @ data.qvel
            mujoco.mj_jacDot(model, data, own, None, centre, pair.body)
            mujoco.mj_jacDot(model, data, others, None, at, pair.other_body)
            bends[index] = normal @ (own - others) @ data.qvel
            if pair.is_plane:
                bends[index] -= 2.0 * normal @ np.cross(turn @ data.qvel, slip)
            else:
                sideways = slip - normal * (normal @ slip)
                bends[index] += sideways @ sideways / (gaps[index] + pair.radius)
        return away, bends

    def step(self) -> Array:
        """Make a step of the model, instead of `mj_step`; return the mean force [N] of each contact.

        MuJoCo computes the acceleration `a` of the bodies without these contacts, and the FMU the
        impulses `P` and their moments `Q`. The velocities get `h a` and the impulses at once, so
        that momentum is exact. MuJoCo's Euler method moves the bodies by `h` times the new
        velocity. Here they move by `h v + h^2/2 a` and by the moments of the impulses: exact for
        what the FMU integrates within the step. What is left is that directions change within a
        step. Bodies in contact are set to the indentations of the FMU, along the directions in
        which an impulse moves them; contacts that are apart follow the distances of the bodies.
        """
        model, data, contact = self.model, self.data, self.contact
        h = model.opt.timestep
        mujoco.mj_forward(model, data)
        self.gaps, normals = self._distances()
        away, bends = self._directions(self.gaps, normals)
        response = np.zeros_like(away)
        mujoco.mj_solveM(model, data, response, away)
        masses = away @ response.T
        self.inverse_masses = masses = 0.5 * (masses + masses.T)
        rates, accelerations = -(away @ data.qvel), -(away @ data.qacc + bends)
        given = {"inverse_masses": masses, "gap": self.gaps}
        self.forces = np.atleast_1d(contact.step(h, rates, accelerations, **given))
        moments = np.atleast_1d(contact["impulse_moment"])

        place, speed = data.qpos.copy(), data.qvel.copy()
        data.qvel += h * self.forces @ response
        pushed = data.qvel.copy()
        mujoco.mj_Euler(model, data)
        data.qpos = place
        mean = speed + 0.5 * (data.qvel - pushed) + moments @ response / h
        mujoco.mj_integratePos(model, data.qpos, mean, h)
        self._settle(response)
        return self.forces

    def _settle(self, response: Array) -> None:
        """Move the bodies of contacts that pushed in the last step to their indentations."""
        model, data = self.model, self.data
        mujoco.mj_kinematics(model, data)
        self.gaps, _ = self._distances()
        pushed = self.forces > 0.0
        if not pushed.any():
            return
        error = (self.gaps + np.atleast_1d(self.contact["indentation"]))[pushed]
        masses = self.inverse_masses[np.ix_(pushed, pushed)]
        way = np.linalg.lstsq(masses, -error, rcond=SINGULAR)[0]
        mujoco.mj_integratePos(model, data.qpos, way @ response[pushed], 1.0)
        mujoco.mj_kinematics(model, data)
        self.gaps, _ = self._distances()
