"""A ball falls onto a plate in Drake: the unit is a LeafSystem in a Diagram, in steps of a
millisecond.

    pip install drake ./python
    python examples/drake_ball.py [PICTURE.svg]

Drake may ask for an output more than once, and gives a system its state: the unit's state is saved
in it and restored.
"""

import brinell
import judge
import numpy as np
from pydrake.common.value import Value
from pydrake.geometry import HalfSpace, Sphere
from pydrake.math import RigidTransform
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph, CoulombFriction, MultibodyPlant
from pydrake.multibody.tree import PrismaticJoint, SpatialInertia
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder, LeafSystem

MASS, RADIUS, HEIGHT, STEP, END, GRAVITY = 4e-3, 5e-3, 0.05, 1e-3, 0.6, 9.81


class Plate(LeafSystem):
    """State of the ball in, force of the plate over the next step out."""

    def __init__(self, contact):
        LeafSystem.__init__(self)
        self.contact = contact
        self.ball = self.DeclareVectorInputPort("ball", 2)
        self.DeclareAbstractState(Value(contact.save()))
        self.DeclareVectorOutputPort("force", 1, self.force)
        self.DeclarePeriodicUnrestrictedUpdateEvent(STEP, 0.0, self.advance)

    def step(self, context):
        self.contact.restore(context.get_abstract_state(0).get_value())
        return self.contact.step(STEP, -self.ball.Eval(context)[1], GRAVITY)

    def force(self, context, output):
        output.SetAtIndex(0, self.step(context))

    def advance(self, context, state):
        self.step(context)
        state.get_mutable_abstract_state(0).set_value(self.contact.save())


def ball(plant):
    """A sphere on a vertical slide; its joint."""
    body = plant.AddRigidBody("ball", SpatialInertia.SolidSphereWithMass(MASS, RADIUS))
    joint = plant.AddJoint(
        PrismaticJoint("slide", plant.world_frame(), body.body_frame(), [0, 0, 1])
    )
    plant.mutable_gravity_field().set_gravity_vector([0, 0, -GRAVITY])
    return body, joint


def fall(path):
    """Height and speed in the engine, with the unit as the plate."""
    builder = DiagramBuilder()
    plant = builder.AddSystem(MultibodyPlant(STEP))
    _, joint = ball(plant)
    plant.AddJointActuator("plate", joint)
    plant.Finalize()
    rows = [(0.0, HEIGHT, 0.0)]
    with brinell.Contact(path, initial_gap=HEIGHT) as contact:
        plate = builder.AddSystem(Plate(contact))
        builder.Connect(plant.get_state_output_port(), plate.ball)
        builder.Connect(plate.get_output_port(), plant.get_actuation_input_port())
        simulator = Simulator(builder.Build())
        context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
        plant.SetPositions(context, [HEIGHT])
        balance = judge.Balance(contact)
        for step in range(1, round(END / STEP) + 1):
            before = plant.GetVelocities(context)[0]
            simulator.AdvanceTo(step * STEP)
            # the contact is where the last step of either kind has left it: at the end of this one
            force = contact["mean_force"]
            if force > 0.0:
                # the engine can't know when within the step the ball has turned
                plant.SetPositions(context, [-contact["indentation"]])
            speed = plant.GetVelocities(context)[0]
            balance.step(STEP, MASS, force, -before, -speed - GRAVITY * STEP, GRAVITY)
            rows.append((step * STEP, plant.GetPositions(context)[0], speed))
    balance.told()
    return np.array(rows).T


def soft():
    """Height by the engine's own contact."""
    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlantSceneGraph(builder, STEP)
    body, _ = ball(plant)
    friction = CoulombFriction(0.0, 0.0)
    plant.RegisterCollisionGeometry(body, RigidTransform(), Sphere(RADIUS), "ball", friction)
    down = RigidTransform([0, 0, -RADIUS])
    plant.RegisterCollisionGeometry(plant.world_body(), down, HalfSpace(), "plate", friction)
    plant.Finalize()
    simulator = Simulator(builder.Build())
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    plant.SetPositions(context, [HEIGHT])
    rows = [(0.0, HEIGHT)]
    for step in range(1, round(END / STEP) + 1):
        simulator.AdvanceTo(step * STEP)
        rows.append((step * STEP, plant.GetPositions(context)[0]))
    return np.array(rows).T


if __name__ == "__main__":
    path = judge.unit("ball")
    reference = judge.alone(path, HEIGHT, GRAVITY, MASS, END, STEP)
    # the engine's Euler method adds half a step's fall per step of flight, up to the next impact
    judge.ball("Drake", fall(path), reference, soft(), 1.5e-3)
