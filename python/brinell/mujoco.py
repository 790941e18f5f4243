"""Contacts between geoms of MuJoCo by an FMU, in the engine's own steps."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import mujoco
import numpy as np

from . import attached
from .attached import Array, Attachable
from .errors import ContactError, UnknownName, nearest

SPHERE, PLANE = mujoco.mjtGeom.mjGEOM_SPHERE, mujoco.mjtGeom.mjGEOM_PLANE
CAPSULE, BOX = mujoco.mjtGeom.mjGEOM_CAPSULE, mujoco.mjtGeom.mjGEOM_BOX
CYLINDER = mujoco.mjtGeom.mjGEOM_CYLINDER
LEVEL = 1e-6
"""Largest angle between the axis of a cylinder and its plane [rad]."""


def attach(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    pairs: tuple[str, str] | Sequence[tuple[str, str]],
    contact: Attachable,
    *,
    corner: float | None = None,
    **parameters: Any,
) -> Attached:
    """Let an FMU compute the contacts of these pairs of geoms: `Attached.step` then takes the place
    of `mj_step`.

    `pairs` are names of geoms, of one pair or of several in the order of the contacts of the FMU:

    - a sphere and a plane, or two spheres: one contact;
    - a cylinder that lies on a plane: one contact along its length, for a scene with
      `impactor.shape = "cylinder"`; its axis must stay parallel to the plane;
    - a capsule and a plane: its two ends, the positive one first;
    - a box and a plane: its eight corners, spheres of the radius `corner` [m] inside the box, in
      the order of their coordinates (x first, negative ones first).

    `contact` is the path of an FMU or of a scene, or a `Contact`, which starts anew and is
    closed with what `attach` returns. Its
    contacts start at the distances in `data`, and have the masses of the model. `[coupling]` of its
    scene has

    - `effective_mass`, for one contact, or for several that share no body;
    - `inverse_masses = "input"`, for contacts that share bodies and for friction; with
      `parameters_per_contact = ["initial_gap"]` for contacts with a `count`.

    A scene with `[friction]` should have `directions = 2`, unless the bodies can slide in one
    direction only, which is then that of the friction; otherwise a warning says so. Directions in
    which they can't move are left out. `parameters` are those of `Contact`.

    MuJoCo's own contact of a pair must be off: `contype="0" conaffinity="0"`, or an `<exclude>`.
    The integrator must be Euler, MuJoCo's default, for which `h kv/I` of servos is below 2. The
    bodies must be free to follow the impulses but for their joints: the FMU does not know the
    constraints of the engine (equalities, limits, other contacts), whose forces are constant over a
    step.
    """
    if model.opt.integrator != mujoco.mjtIntegrator.mjINT_EULER:
        name = mujoco.mjtIntegrator(model.opt.integrator).name.removeprefix("mjINT_").lower()
        raise ContactError(f"integrator = {name}: attach needs MuJoCo's default, Euler")
    several: Any = [pairs] if len(pairs) == 2 and isinstance(pairs[0], str) else pairs
    spheres = [pair for names in several for pair in _pairs_of(model, names, corner)]
    return Attached(model, data, spheres, contact, parameters)


@dataclass(frozen=True)
class _Pair(attached.Pair):
    """A sphere that touches a plane or another sphere, in a model of MuJoCo."""

    geom: int
    place: Array
    """The centre of the sphere in its geom [m]."""
    other: int


def _pairs_of(model: mujoco.MjModel, names: tuple[str, str], corner: float | None) -> list[_Pair]:
    """The spheres of a pair of geoms."""
    shown = " and ".join(repr(name) for name in names)
    if isinstance(names, str) or len(names) != 2:
        raise ContactError(f"pair {names!r}: two names of geoms are needed")
    geoms = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_GEOM, name) for name in names]
    for name, geom in zip(names, geoms, strict=True):
        if geom < 0:
            named = [model.geom(index).name for index in range(model.ngeom)]
            there = ", ".join(named)
            raise UnknownName(f"the model has no geom {name!r}{nearest(name, named)}; there are: {there}")
    geoms.sort(key=lambda geom: model.geom_type[geom] == PLANE)
    kinds = [mujoco.mjtGeom(model.geom_type[geom]) for geom in geoms]
    on_plane = kinds[0] in (SPHERE, CYLINDER, CAPSULE, BOX) and kinds[1] == PLANE
    if not on_plane and kinds != [SPHERE, SPHERE]:
        found = " and ".join(kind.name.removeprefix("mjGEOM_").lower() for kind in kinds)
        raise ContactError(
            f"pair {shown}: {found}; allowed are a sphere, a cylinder, a capsule or a box and a plane, or two spheres"
        )
    if _collide(model, *geoms):
        raise ContactError(
            f'pair {shown}: MuJoCo\'s own contact is on; switch it off with contype="0" '
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
    both = (int(bodies[first]), int(bodies[other]))
    return [_Pair(own, reach, on_plane, both, first, place, other) for place in places]


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


class Attached(attached.Attached):
    """The contacts of an FMU in a model of MuJoCo; `attach` makes it."""

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        pairs: Sequence[_Pair],
        contact: Attachable,
        parameters: dict[str, Any],
    ) -> None:
        self.model, self.data = model, data
        self._geoms = np.array([pair.geom for pair in pairs])
        self._places = np.array([pair.place for pair in pairs])
        self._others = np.array([pair.other for pair in pairs])
        self._lying = np.flatnonzero(model.geom_type[self._geoms] == CYLINDER)
        # those that joints move
        moving = {body for pair in pairs for body in pair.bodies if model.body_weldid[body] > 0}
        self._moving = sorted(moving)
        self._motions = np.zeros((len(moving) + 1, 2, 3, model.nv))
        self._points = np.zeros((len(moving) + 1, 3))
        mujoco.mj_fwdPosition(model, data)
        numbers = {body: number for number, body in enumerate(self._moving)}
        numbered = []
        for pair in pairs:
            first, other = (numbers.get(body, -1) for body in pair.bodies)
            numbered.append(replace(pair, bodies=(first, other)))
        super().__init__(numbered, contact, parameters)

    @property
    def _timestep(self) -> float:
        return float(self.model.opt.timestep)

    @property
    def _damping(self) -> Array:
        return np.asarray(self.model.dof_damping)

    def _state(self) -> tuple[Array, Array]:
        return self.data.qpos.copy(), self.data.qvel.copy()

    def _put(self, place: Array, speed: Array) -> None:
        self.data.qpos, self.data.qvel = place, speed
        mujoco.mj_fwdPosition(self.model, self.data)

    def _moved(self, place: Array, speed: Array, time: float) -> Array:
        moved = place.copy()
        mujoco.mj_integratePos(self.model, moved, speed, time)
        return moved

    def _acceleration(self) -> Array:
        # the places were put
        mujoco.mj_forwardSkip(self.model, self.data, mujoco.mjtStage.mjSTAGE_POS, 0)
        return np.array(self.data.qacc)

    def _solve(self, rows: Array) -> Array:
        solved = np.zeros_like(rows)
        mujoco.mj_solveM(self.model, self.data, solved, rows)
        return solved

    def _spheres(self) -> tuple[Array, Array, Array]:
        places, axes = self.data.geom_xpos, self.data.geom_xmat.reshape(-1, 3, 3)
        for pair in self._lying:
            first, other = self._geoms[pair], self._others[pair]
            tilt = abs(float(axes[first, :, 2] @ axes[other, :, 2]))
            if not tilt <= LEVEL:
                raise ContactError(
                    f"cylinder {self.model.geom(first).name!r}: its axis is tilted by {tilt:.3g} rad "
                    f"against the plane; allowed is {LEVEL:g}: it touches along its whole length"
                )
        centres = places[self._geoms]
        if self._places.any():
            centres += (axes[self._geoms] @ self._places[..., None])[..., 0]
        return centres, places[self._others], axes[self._others]

    def _jacobians(self) -> tuple[Array, Array]:
        for body, motion, point in zip(self._moving, self._motions, self._points, strict=False):
            point[:] = self.data.xpos[body]
            mujoco.mj_jac(self.model, self.data, *motion, point, body)
        return self._points, self._motions

    def _end(self, start: tuple[Array, Array], place: Array, speed: Array, acceleration: Array) -> None:
        # the time, the activations of actuators, and what else a step of the engine changes
        self.data.qacc = acceleration
        mujoco.mj_Euler(self.model, self.data)
        self._put(place, speed + self._timestep * acceleration)
