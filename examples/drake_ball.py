"""A ball falls onto a plate in Drake: the FMU is a LeafSystem in a Diagram, in steps of a
millisecond.

    pip install drake ./python
    python examples/drake_ball.py [PICTURE.svg]

Drake may evaluate an output more than once, and manages the state of a system. The state of the FMU
is therefore saved in it and restored.
"""

import brinell
import judge
import numpy as np
import pydrake.all as drake

MASS, RADIUS, HEIGHT, STEP, END, GRAVITY = 4e-3, 5e-3, 0.05, 1e-3, 0.6, 9.81


class Plate(drake.LeafSystem):
    """Input: the state of the ball; output: the force of the plate over the next step."""

    def __init__(self, contact):
        drake.LeafSystem.__init__(self)
        self.contact, self.ball = contact, self.DeclareVectorInputPort("ball", 2)
        self.DeclareAbstractState(drake.Value(contact.save()))
        self.DeclareVectorOutputPort("force", 1, self.force)
        self.DeclarePeriodicUnrestrictedUpdateEvent(STEP, 0.0, self.advance)

    def force(self, context, output):
        self.contact.restore(context.get_abstract_state(0).get_value())
        output.SetAtIndex(0, self.contact.step(STEP, -self.ball.Eval(context)[1], GRAVITY))

    def advance(self, context, state):
        self.force(context, drake.BasicVector(1))
        state.get_mutable_abstract_state(0).set_value(self.contact.save())


def ball(plant):
    """A sphere on a vertical slide."""
    body = plant.AddRigidBody("ball", drake.SpatialInertia.SolidSphereWithMass(MASS, RADIUS))
    joint = drake.PrismaticJoint("slide", plant.world_frame(), body.body_frame(), [0, 0, 1])
    plant.AddJoint(joint).set_default_translation(HEIGHT)
    return body


def fall(path):
    """Height and speed in the engine, with the FMU as the plate."""
    builder, rows = drake.DiagramBuilder(), [(0.0, HEIGHT, 0.0)]
    plant = builder.AddSystem(drake.MultibodyPlant(STEP))
    ball(plant)
    plant.AddJointActuator("plate", plant.GetJointByName("slide"))
    plant.Finalize()
    with brinell.Contact(path, initial_gap=HEIGHT) as contact:
        plate = builder.AddSystem(Plate(contact))
        builder.Connect(plant.get_state_output_port(), plate.ball)
        builder.Connect(plate.get_output_port(), plant.get_actuation_input_port())
        simulator = drake.Simulator(builder.Build())
        context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
        balance = judge.Balance(contact)
        for time in STEP * np.arange(1, round(END / STEP) + 1):
            simulator.AdvanceTo(time)
            # the contact is at the end of this step, whichever of the two functions made it
            if (force := contact["mean_force"]) > 0.0:
                # the engine cannot know when within the step the ball turned
                plant.SetPositions(context, [-contact["indentation"]])
            rows.append((time, *plant.GetPositionsAndVelocities(context)))
            balance.step(STEP, MASS, force, -rows[-2][2], -rows[-1][2] - GRAVITY * STEP, GRAVITY)
    balance.told()
    return np.array(rows).T


def soft():
    """Height with the engine's own contact."""
    builder = drake.DiagramBuilder()
    plant, _ = drake.AddMultibodyPlantSceneGraph(builder, STEP)
    body = ball(plant)
    friction = drake.CoulombFriction(0.0, 0.0)
    sphere, plate = drake.Sphere(RADIUS), drake.HalfSpace()
    plant.RegisterCollisionGeometry(body, drake.RigidTransform(), sphere, "ball", friction)
    down = drake.RigidTransform([0, 0, -RADIUS])
    plant.RegisterCollisionGeometry(plant.world_body(), down, plate, "plate", friction)
    plant.Finalize()
    simulator = drake.Simulator(builder.Build())
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
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
