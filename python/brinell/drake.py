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

    `contact`, the `[coupling]` and `[friction]` of its scene and `parameters` are as those of
    `brinell.mujoco.attach`: `effective_mass` for contacts that share no body, `inverse_masses =
    "input"` otherwise.

    Drake must not compute the contact of a pair, too: the bodies have no collision geometry, or
    a collision filter excludes the pair. The bodies must be free to follow the impulses but for
    their joints: the FMU does not know constraints, limits and contacts of Drake, whose forces are
    constant over a step.
    """
    if not plant.is_finalized():
        raise ContactError("the plant is not finalized: call plant.Finalize() before attach")
    if plant.time_step() == 0.0:
        raise ContactError("time_step = 0: attach needs a discrete plant, MultibodyPlant(time_step)")
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
        # each once, in the order of their numbers
        spheres = [sphere for pair in pairs for sphere in pair if isinstance(sphere, Sphere)]
        self._moving = {sphere.body.index(): sphere.body for sphere in spheres}
        numbers = {index: number for number, index in enumerate(self._moving)}
        shapes = []
        for first, other in pairs:
            own = numbers[first.body.index()]
            if isinstance(other, Sphere):
                both = (own, numbers[other.body.index()])
                shapes.append(Pair(first.radius, other.radius, False, both))
            else:
                shapes.append(Pair(first.radius, 0.0, True, (own, -1)))
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

    @property
    def _damping(self) -> Array:
        damping = self._joint_damping()
        for motor, first, gain in self._steered():
            damping[first] += gain if abs(self._torque(motor)) < motor.effort_limit() else 0.0
        return damping

    def _joint_damping(self) -> Array:
        plant, damping = self.plant, np.zeros(self.plant.num_velocities())
        for joint in map(plant.get_joint, plant.GetJointIndices()):
            part = slice(joint.velocity_start(), joint.velocity_start() + joint.num_velocities())
            damping[part] = joint.GetDampingVector(self.context)
        return damping

    def _steered(self) -> list[tuple[Any, int, float]]:
        """The actuators with a controller of the plant, where they act, and what acts as a damping."""
        plant, found = self.plant, []
        for index in plant.GetJointActuatorIndices():
            motor = plant.get_joint_actuator(index)
            if motor.has_controller():
                gains = motor.get_controller_gains()
                # the plant takes place and speed at the end of its step
                gain = gains.d + self._timestep * gains.p
                found.append((motor, motor.joint().velocity_start(), gain))
        return found

    def _torque(self, motor: Any) -> float:
        """What an actuator with a controller gives in a step of the plant [N or N m]."""
        torques = self.plant.get_net_actuation_output_port().Eval(self.context)
        return float(torques[motor.input_start()])

    def _acceleration(self) -> Array:
        plant, context, spare = self.plant, self.context, self._spare
        # with all that the plant computes in a step: actuators, springs, joint limits, constraints
        plant.CalcForcedUnrestrictedUpdate(context, spare.get_mutable_state())
        change = np.asarray(plant.GetVelocities(spare) - plant.GetVelocities(context))
        # and without what its step takes off the forces at the start
        lost = self._joint_damping() * change
        for motor, first, gain in self._steered():
            torque, limit = self._torque(motor), motor.effort_limit()
            lost[first] += np.clip(torque + gain * change[first], -limit, limit) - torque
        return change / self._timestep + (self._solve(lost[None])[0] if lost.any() else 0.0)

    def _solve(self, rows: Array) -> Array:
        return np.linalg.solve(self.plant.CalcMassMatrix(self.context), rows.T).T

    def _spheres(self) -> tuple[Array, Array, Array]:
        centres, others, axes = [], [], []
        for first, other in self._pairs:
            pose = self.plant.EvalBodyPoseInWorld(self.context, first.body)
            centres.append(pose.multiply(np.array(first.centre)))
            if isinstance(other, Plane):
                from_axis: Any = RotationMatrix.MakeFromOneVector
                others.append(np.array(other.point))
                axes.append(from_axis(np.array(other.normal), 2).matrix())
            else:
                pose = self.plant.EvalBodyPoseInWorld(self.context, other.body)
                others.append(pose.multiply(np.array(other.centre)))
                axes.append(pose.rotation().matrix())
        return np.array(centres), np.array(others), np.array(axes)

    def _jacobians(self) -> tuple[Array, Array]:
        plant, context, by = self.plant, self.context, JacobianWrtVariable.kV
        world, points = plant.world_frame(), np.zeros((len(self._moving) + 1, 3))
        motions = np.zeros((len(points), 2, 3, plant.num_velocities()))
        for point, motion, body in zip(points, motions, self._moving.values(), strict=False):
            frame = body.body_frame()
            turns, moves = plant.CalcJacobianSpatialVelocity(context, by, frame, np.zeros(3), world, world).reshape(
                2, 3, -1
            )
            motion[:] = moves, turns
            point[:] = plant.EvalBodyPoseInWorld(context, body).translation()
        return points, motions

    def _end(self, start: tuple[Array, Array], place: Array, speed: Array, acceleration: Array) -> None:
        # the other systems of a diagram see the bodies at the start of the step, then at its end
        self._put(*start)
        self.simulator.AdvancePendingEvents()
        h = self._timestep
        self._put(place, speed + h * acceleration)
        self.simulator.AdvanceTo(h * (self._steps() + 1))
