"""A box falls on its four feet in Drake and comes to rest, in steps of a millisecond.

    pip install drake ./python
    python examples/drake_box.py [PICTURE.svg]

It is the box of mujoco_box.py. The FMU moves all feet together within a step, with the inverse masses
that the engine's mass matrix gives.
"""

import brinell.drake
import judge
import numpy as np
import pydrake.all as drake

STEP, FINE, END, COMPARED = 1e-3, 2e-5, 0.6, 0.1  # s
MASS, CENTRE, INERTIA = 0.3, [4e-3, 2e-3, 0.0], [1.2e-4, 2.6e-4, 3.5e-4]  # kg, m, kg m^2
CORNERS = np.array([(x, y, -0.02) for x in (-0.04, 0.04) for y in (-0.025, 0.025)])  # m
RADIUS, HEIGHT = 5e-3, 5e-3  # m: of the feet, and of the lowest foot above the ground


def start(step, collide=None):
    """The engine with the box above the ground; `collide` adds shapes for its own contact."""
    builder = drake.DiagramBuilder()
    plant, _ = drake.AddMultibodyPlantSceneGraph(builder, step)
    inertia = drake.RotationalInertia(*INERTIA)
    inertia = drake.SpatialInertia.MakeFromCentralInertia(MASS, CENTRE, inertia)
    box = plant.AddRigidBody("box", inertia)
    if collide:
        collide(plant, box)
    plant.Finalize()
    simulator = drake.Simulator(builder.Build())
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    tilt = drake.RotationMatrix.MakeXRotation(np.radians(6.0))
    tilt = tilt.multiply(drake.RotationMatrix.MakeYRotation(np.radians(8.0)))
    lowest = (CORNERS @ tilt.matrix().T)[:, 2].min() - RADIUS
    pose = drake.RigidTransform(tilt, [0.0, 0.0, HEIGHT - lowest])
    plant.SetFreeBodyPose(context, box, pose)
    return simulator, plant, context, box


def fall(path, step, end):
    """Times, heights of the centre of mass, vertical speeds and spins about the box's x and y; the
    forces at the end."""
    simulator, plant, context, box = start(step)
    pairs = [
        (brinell.drake.Sphere(box, RADIUS, corner), brinell.drake.Plane()) for corner in CORNERS
    ]
    rows = []
    with brinell.drake.attach(plant, simulator, pairs, path) as feet:
        balance = judge.Energy(
            lambda: plant.EvalKineticEnergy(context) + plant.EvalPotentialEnergy(context),
            feet.contact,
        )
        while (time := context.get_time()) < end - step / 2.0:
            pose, speed = plant.EvalBodyPoseInWorld(context, box), plant.GetVelocities(context)
            centre, turn = pose.multiply(CENTRE), pose.rotation().matrix().T @ speed[:3]
            rows.append((time, centre[2], speed[5], *turn[:2]))
            forces = feet.step()
            balance.step()
    if step == STEP:
        balance.told("energy of the fall", MASS * 9.81 * (rows[0][1] - rows[-1][1]))
    return np.array(rows).T, forces


def soft():
    """Times and heights with the engine's own contact and default settings."""

    def collide(plant, box):
        friction = drake.CoulombFriction(0.0, 0.0)
        for index, corner in enumerate(CORNERS):
            place, foot = drake.RigidTransform(corner), drake.Sphere(RADIUS)
            plant.RegisterCollisionGeometry(box, place, foot, f"foot{index}", friction)
        world, ground = plant.world_body(), drake.HalfSpace()
        plant.RegisterCollisionGeometry(world, drake.RigidTransform(), ground, "ground", friction)

    simulator, plant, context, box = start(STEP, collide)
    rows = []
    for step in range(round(END / STEP)):
        simulator.AdvanceTo(step * STEP)
        rows.append((step * STEP, plant.EvalBodyPoseInWorld(context, box).multiply(CENTRE)[2]))
    return np.array(rows).T


if __name__ == "__main__":
    path = judge.unit("feet")
    rows, forces = fall(path, STEP, END)
    small, _ = fall(path, FINE, COMPARED)
    until, every = round(COMPARED / STEP), round(STEP / FINE)
    same = small[:, ::every]
    judge.agree("height against steps of 20 us, 0.1 s [m]", rows[1, :until], same[1], 1e-6)
    judge.agree("spin against steps of 20 us, 0.1 s [rad/s]", rows[3:, :until], same[3:], 5e-2)
    judge.agree("forces at rest against the weight [N]", forces.sum(), MASS * 9.81, 1e-6)
    judge.agree("speed and spins at rest [m/s, rad/s]", rows[2:, -1], 0.0, 1e-5)
    own = soft()
    judge.picture(
        "Drake: a tilted box falls on its four feet, 1 ms steps",
        [
            (rows[0], 1e3 * rows[1], "engine with the unit", "-"),
            (same[0, ::3], 1e3 * same[1, ::3], "the same in steps of 20 us", "."),
            (own[0], 1e3 * own[1], "the engine's own contact", "--"),
        ],
        y="height of the centre [mm]",
    )
