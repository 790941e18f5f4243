"""Contacts between bodies of Drake by an FMU, in the plant's own steps."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from pydrake.math import RotationMatrix
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import JacobianWrtVariable, RigidBody
from pydrake.systems.analysis import Simulator

from . import attached
from .attached import Array, Attachable, Pair
from .errors import ContactError

WITHIN = 1e-6
"""Part of a step by which the time may differ from a multiple of it."""


@dataclass(frozen=True)
class Sphere:
    """A sphere that belongs to a body of a plant."""

    body: RigidBody
    radius: float
    """Its radius [m]."""
    centre: Sequence[float] = (0.0, 0.0, 0.0)
    """Its centre in the frame of the body [m]."""


@dataclass(frozen=True)
class Plane:
    """A plane that stands still; without arguments, the ground z = 0."""

    point: Sequence[float] = (0.0, 0.0, 0.0)
    """Any point of it in the world [m]."""
    normal: Sequence[float] = (0.0, 0.0, 1.0)
    """Its normal in the world, of any length, towards the spheres."""


def attach(
    plant: MultibodyPlant,
    simulator: Simulator,
    pairs: tuple[Sphere, Sphere | Plane] | Sequence[tuple[Sphere, Sphere | Plane]],
    contact: Attachable,
    **parameters: Any,
) -> Attached:
    """Let an FMU compute the contacts of these pairs: `Attached.step` then takes the place of
    `simulator.AdvanceTo`, by one step of the plant.

    `plant` is discrete and finalized: the system of `simulator`, or a part of its diagram. `pairs`
    are a sphere and a plane, or two spheres of different bodies: one pair, or several in the order
    of the contacts of the FMU.

    `contact` is the path of an FMU or of a scene, or a `Contact`, which starts anew and is
    closed with what `attach` returns. Its
    contacts start at the distances in `simulator`, and have the masses of the plant. `[coupling]` of
    its scene has

    - `effective_mass`, for one contact, or for several that share no body;
    - `inverse_masses = "input"`, for contacts that share bodies and for friction; with
      `parameters_per_contact = ["initial_gap"]` for contacts with a `count`.

    A scene with `[friction]` should have `directions = 2`. `parameters` are those of `Contact`.

    Drake must not compute the contact of a pair, too: the bodies have no collision geometry, or
    a collision filter excludes the pair. The bodies must be free to follow the impulses but for
    their joints: the FMU does not know constraints, limits and contacts of Drake, whose forces are
    those at the start of a step.
    """
    if not plant.is_finalized():
        raise ContactError("the plant is not finalized: call plant.Finalize() before attach")
    if plant.time_step() == 0.0:
        raise ContactError(
            "time_step = 0: attach needs a discrete plant, MultibodyPlant(time_step)"
        )
    is_one = len(pairs) == 2 and isinstance(pairs[0], Sphere | Plane)
    several: Any = [pairs] if is_one else pairs
    for index, pair in enumerate(several):
        _check(f"pair {index}", pair)
    return Attached(plant, simulator, several, contact, parameters)


def _check(name: str, pair: tuple[Sphere, Sphere | Plane]) -> None:
    kinds = [type(part).__name__ for part in pair]
    if kinds not in (["Sphere", "Plane"], ["Sphere", "Sphere"]):
        found = " and ".join(kinds)
        raise ContactError(f"{name}: {found}; allowed are Sphere and Plane, or Sphere and Sphere")
    first, other = pair
    for part in pair:
        if isinstance(part, Sphere) and not part.radius > 0.0:
            raise ContactError(f"{name}: radius = {part.radius}: a sphere needs one above 0 [m]")
    if isinstance(other, Plane) and not np.linalg.norm(other.normal) > 0.0:
        raise ContactError(f"{name}: normal = {other.normal}: a plane needs one that is not zero")
    if isinstance(other, Sphere) and other.body is first.body:
        raise ContactError(f"{name}: both spheres belong to the body {first.body.name()!r}")


class Attached(attached.Attached):
    """The contacts of an FMU in a plant of Drake; `attach` makes it."""

    # Drake's stubs say arrays of a type that is none
    plant: Any
    context: Any
    """Of the plant: its state and its inputs."""

    def __init__(
        self,
        plant: MultibodyPlant,
        simulator: Simulator,
        pairs: Sequence[tuple[Sphere, Sphere | Plane]],
        contact: Attachable,
        parameters: dict[str, Any],
    ) -> None:
        self.plant, self.simulator, self._pairs = plant, simulator, pairs
        self.context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
        self._spare: Any = plant.CreateDefaultContext()
        shapes = []
        for first, other in pairs:
            reach = other.radius if isinstance(other, Sphere) else 0.0
            shapes.append(Pair(first.radius, reach, isinstance(other, Plane)))
        super().__init__(shapes, contact, parameters)

    def _steps(self) -> int:
        """The number of steps of the plant until now."""
        time, h = float(self.context.get_time()), self._timestep
        if abs(time - h * round(time / h)) > WITHIN * h:
            raise ContactError(
                f"time = {time:.9g} s is within a step of the plant, of {h:g} s: attached.step() "
                "begins where the plant makes a step"
            )
        return round(time / h)

    @property
    def _timestep(self) -> float:
        return float(self.plant.time_step())

    def _state(self) -> tuple[Array, Array]:
        self._steps()
        plant, context = self.plant, self.context
        return np.array(plant.GetPositions(context)), np.array(plant.GetVelocities(context))

    def _put(self, place: Array, speed: Array) -> None:
        self.plant.SetPositionsAndVelocities(self.context, np.concatenate((place, speed)))

    def _moved(self, place: Array, speed: Array, time: float) -> Array:
        plant, context = self.plant, self.context
        if plant.IsVelocityEqualToQDot():
            return place + time * speed
        here, slopes = plant.GetPositions(context), [np.zeros_like(place)]
        # Runge and Kutta: quaternions turn
        for part in (0.0, 0.5, 0.5, 1.0):
            plant.SetPositions(context, place + part * time * slopes[-1])
            slopes.append(np.array(plant.MapVelocityToQDot(context, speed)))
        plant.SetPositions(context, here)
        _, first, second, third, fourth = slopes
        return np.asarray(place + time / 6.0 * (first + 2.0 * second + 2.0 * third + fourth))

    def _acceleration(self) -> Array:
        plant, context, spare = self.plant, self.context, self._spare
        # with all that the plant computes in a step: actuators, springs, joint limits, constraints
        plant.CalcForcedUnrestrictedUpdate(context, spare.get_mutable_state())
        change = plant.GetVelocities(spare) - plant.GetVelocities(context)
        return np.asarray(change / self._timestep)

    def _solve(self, rows: Array) -> Array:
        return np.linalg.solve(self.plant.CalcMassMatrix(self.context), rows.T).T

    def _geometry(self, index: int) -> tuple[Array, Array, Array]:
        first, other = self._pairs[index]
        pose = self.plant.EvalBodyPoseInWorld(self.context, first.body)
        centre = pose.multiply(np.array(first.centre))
        if isinstance(other, Plane):
            from_axis: Any = RotationMatrix.MakeFromOneVector
            return centre, np.array(other.point), from_axis(np.array(other.normal), 2).matrix().T
        pose = self.plant.EvalBodyPoseInWorld(self.context, other.body)
        return centre, pose.multiply(np.array(other.centre)), pose.rotation().matrix().T

    def _jacobians(self, index: int) -> tuple[Array, Array]:
        plant, found = self.plant, np.zeros((2, 2, 3, self.plant.num_velocities()))
        world, by = plant.world_frame(), JacobianWrtVariable.kV
        for part, sphere in enumerate(self._pairs[index]):
            if isinstance(sphere, Sphere):
                frame, centre = sphere.body.body_frame(), np.array(sphere.centre)
                turns, moves = plant.CalcJacobianSpatialVelocity(
                    self.context, by, frame, centre, world, world
                ).reshape(2, 3, -1)
                found[part] = moves, turns
        return found[0], found[1]

    def _end(
        self, start: tuple[Array, Array], place: Array, speed: Array, acceleration: Array
    ) -> None:
        # the other systems of a diagram see the bodies at the start of the step, then at its end
        self._put(*start)
        self.simulator.AdvancePendingEvents()
        h = self._timestep
        self._put(place, speed + h * acceleration)
        self.simulator.AdvanceTo(h * (self._steps() + 1))
