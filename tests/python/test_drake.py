"""What contacts in Drake have of their own: masses, coordinates, other systems of a diagram, and what is refused. The rest is that of
MuJoCo, and tested there."""

import brinell
import brinell.drake
import numpy as np
import pydrake.all as drake
import pytest
from brinell import ContactError
from brinell.drake import Plane, Sphere
from feet import FEET, INERTIA, MASS, held

CENTRE = np.array([3e-3, 1e-3, 2e-3])


def world(bodies, step=1e-3, gravity=9.81, more=lambda builder, plant: None):
    """A simulator of these free bodies, name: (mass, centre of mass, central inertia); the plant, its context."""
    builder = drake.DiagramBuilder()
    plant = builder.AddSystem(drake.MultibodyPlant(step))
    for name, (mass, centre, inertia) in bodies.items():
        central = drake.RotationalInertia(*inertia)
        plant.AddRigidBody(name, drake.SpatialInertia.MakeFromCentralInertia(mass, centre, central))
    plant.mutable_gravity_field().set_gravity_vector([0.0, 0.0, -gravity])
    plant.Finalize()
    more(builder, plant)
    simulator = drake.Simulator(builder.Build())
    return simulator, plant, plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())


def ball(mass, radius):
    return mass, np.zeros(3), np.full(3, 0.4 * mass * radius**2)


BOX = {"box": (MASS, CENTRE, INERTIA)}


def feet(plant):
    box = plant.GetBodyByName("box")
    return [(Sphere(box, 5e-3, foot), Plane()) for foot in FEET]


def put(plant, context, name, place, turn=(1.0, 0.0, 0.0, 0.0)):
    turn = np.array(turn) / np.linalg.norm(turn)
    pose = drake.RigidTransform(drake.Quaternion(turn), place)
    plant.SetFreeBodyPose(context, plant.GetBodyByName(name), pose)


def energy(plant, context, contact):
    return plant.EvalKineticEnergy(context) + plant.EvalPotentialEnergy(context) + held(contact)


def test_the_inverse_masses_of_a_box_are_those_of_its_arms(unit):
    simulator, plant, context = world(BOX)
    put(plant, context, "box", [0.1, 0.2, 0.3], [0.9, 0.3, -0.2, 0.1])
    turned = plant.EvalBodyPoseInWorld(context, plant.GetBodyByName("box")).rotation().matrix()
    with brinell.drake.attach(plant, simulator, feet(plant), unit(4, 2)) as attached:
        assert attached.gaps == pytest.approx(0.3 + (FEET @ turned.T)[:, 2] - 5e-3, abs=1e-15)
        assert not attached.step().any()
        found = attached.inverse_masses
    # arms of normals and of points of contact about the centre of mass, in the axes of the box
    levers = np.cross(FEET - CENTRE, turned[2])
    assert found[:4, :4] == pytest.approx(1.0 / MASS + levers @ (levers / INERTIA).T, rel=1e-12)
    # the tangents are along the axes of the ground, to either side
    points = FEET - CENTRE - 5e-3 * turned[2]
    diagonals = [1.0 / MASS + np.sum(np.cross(points, turned[axis]) ** 2 / INERTIA, axis=1) for axis in (0, 1)]
    assert sorted(found.diagonal()[4:]) == pytest.approx(sorted(np.concatenate(diagonals)), rel=1e-9)
    assert attached.contact.closed


def test_the_unit_ends_where_bodies_that_turn_do(unit):
    for step in (2e-3, 1e-3, 1e-4):
        simulator, plant, context = world({**BOX, "ball": ball(0.1, 4e-3)}, step)
        put(plant, context, "box", [0.1, 0.2, 0.06])
        put(plant, context, "ball", [0.13, 0.2, 0.1])
        plant.SetVelocities(context, [1.0, 4.0, -2.0, -0.3, 0.5, 0.2, 0.0, 0.0, 0.0, 0.4, -0.6, 0.3])
        corner = Sphere(plant.GetBodyByName("box"), 5e-3, [0.01, 0.0, 0.02])
        pairs = [(corner, Plane([0.0, 0.0, 0.0], [0.1, 0.0, 2.0])), (Sphere(plant.GetBodyByName("ball"), 4e-3), corner)]
        with brinell.drake.attach(plant, simulator, pairs, unit(2)) as attached:
            assert not attached.step().any()
            assert np.abs(attached.gaps + attached.contact["indentation"]).max() < 2e-12


def test_a_box_that_slides_ends_as_in_mujoco(unit):
    """Two engines, each by its own coordinates, masses and Jacobians."""
    mujoco = pytest.importorskip("mujoco")
    import brinell.mujoco

    ends, path = [], unit(4, 2)
    start, turn = [0.0, 0.0, 0.0305], np.array([0.999, 0.03, 0.02, 0.01])
    simulator, plant, context = world(BOX, 1e-4)
    put(plant, context, "box", start, turn)
    plant.SetVelocities(context, [0.0, 0.0, 1.0, 0.4, -0.2, -0.1])
    with brinell.drake.attach(plant, simulator, feet(plant), path) as attached:
        before = energy(plant, context, attached.contact)
        for _ in range(200):
            attached.step()
        assert np.sum(attached.contact["friction_work"]) > 1e-4
        assert energy(plant, context, attached.contact) == pytest.approx(before, rel=1e-5)
        box = plant.GetBodyByName("box")
        pose, speed = plant.EvalBodyPoseInWorld(context, box), plant.GetVelocities(context)
        ends.append(np.concatenate((pose.translation(), pose.rotation().matrix().ravel(), speed[3:])))

    geoms = "".join(f'<geom name="foot{i}" size="5e-3" pos="{x} {y} {z}"/>' for i, (x, y, z) in enumerate(FEET))
    model = mujoco.MjModel.from_xml_string(
        '<mujoco><option timestep="1e-4" gravity="0 0 -9.81"/><default><geom contype="0" conaffinity="0"/></default>'
        '<worldbody><geom name="floor" type="plane" size="1 1 .1"/><body name="box"><freejoint/>'
        f'<inertial pos="3e-3 1e-3 2e-3" mass="{MASS}" diaginertia="1.2e-4 2.6e-4 3.5e-4"/>{geoms}</body></worldbody></mujoco>'
    )
    data = mujoco.MjData(model)
    data.qpos[:3], data.qpos[3:] = start, turn / np.linalg.norm(turn)
    # MuJoCo's spin is in the axes of the box
    spin = np.zeros(3)
    mujoco.mju_rotVecQuat(spin, [0.0, 0.0, 1.0], data.qpos[3:] * [1.0, -1.0, -1.0, -1.0])
    data.qvel = [0.4, -0.2, -0.1, *spin]
    with brinell.mujoco.attach(model, data, [(f"foot{i}", "floor") for i in range(4)], path) as attached:
        for _ in range(200):
            attached.step()
    ends.append(np.concatenate((data.qpos[:3], data.body("box").xmat, data.qvel[:3])))
    assert ends[0] == pytest.approx(ends[1], abs=1e-6)


def spring_and_feedback(step, path):
    """A slide with a spring, and a motor whose force is 2 N/m times the place less 0.5 N s/m times the speed: times,
    and places and speeds as a logger of the diagram has them."""
    builder = drake.DiagramBuilder()
    plant = builder.AddSystem(drake.MultibodyPlant(step))
    body = plant.AddRigidBody("ball", drake.SpatialInertia.SolidSphereWithMass(0.1, 5e-3))
    slide = drake.PrismaticJoint("slide", plant.world_frame(), body.body_frame(), [0, 0, 1])
    slide = plant.AddJoint(slide)
    slide.set_default_translation(1.0)
    plant.AddForceElement(drake.PrismaticSpring(slide, 1.5, 20.0))
    plant.AddJointActuator("motor", slide)
    plant.Finalize()
    gain = builder.AddSystem(drake.MatrixGain(np.array([[2.0, -0.5]])))
    builder.Connect(plant.get_state_output_port(), gain.get_input_port())
    builder.Connect(gain.get_output_port(), plant.get_actuation_input_port())
    log = drake.LogVectorOutput(plant.get_state_output_port(), builder, step)
    simulator = drake.Simulator(builder.Build())
    with brinell.drake.attach(plant, simulator, [(Sphere(body, 5e-3), Plane())], path) as attached:
        for _ in range(round(0.2 / step)):
            assert not attached.step().any()
    logged = log.FindLog(simulator.get_context())
    return logged.sample_times(), logged.data()


def test_actuators_and_other_systems_of_a_diagram_act_and_see_each_state(unit):
    rates, shapes = np.linalg.eig(np.array([[0.0, 1.0], [-180.0, -5.0]]))  # 1/s^2, 1/s
    middle = (20.0 * 1.5 - 0.1 * 9.81) / 18.0  # m, where it would rest
    parts = np.linalg.solve(shapes, np.array([1.0 - middle, 0.0]))
    errors = []
    for step in (2e-3, 1e-3):
        times, found = spring_and_feedback(step, unit(1))
        assert len(times) == round(0.2 / step) + 1
        exact = ((shapes * parts) @ np.exp(np.outer(rates, times))).real + [[middle], [0.0]]
        errors.append(np.abs(found - exact).max())
    assert errors[0] < 5e-4
    # of second order
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.1)


@pytest.mark.parametrize("limit", [np.inf, 5.0])
@pytest.mark.parametrize("damping, gain", [(0.0, 0.0), (20.0, 0.0), (0.0, 20.0), (5.0, 50.0)])
def test_dampings_and_controllers_of_the_plant_press_with_their_whole_force(resting, damping, gain, limit):
    builder, step = drake.DiagramBuilder(), 1e-3
    plant = builder.AddSystem(drake.MultibodyPlant(step))
    body = plant.AddRigidBody("ball", drake.SpatialInertia.SolidSphereWithMass(0.1, 5e-3))
    slide = drake.PrismaticJoint("slide", plant.world_frame(), body.body_frame(), [0, 0, 1], damping=damping)
    motor = plant.AddJointActuator("motor", plant.AddJoint(slide), limit)
    if gain > 0.0:
        motor.set_controller_gains(drake.PdControllerGains(p=500.0, d=gain))
    plant.Finalize()
    aim = builder.AddSystem(drake.ConstantVectorSource([-0.02, 0.0] if gain > 0.0 else [-10.0]))
    port = (
        plant.get_desired_state_input_port(drake.ModelInstanceIndex(1))
        if gain > 0.0
        else plant.get_actuation_input_port()
    )
    builder.Connect(aim.get_output_port(), port)
    simulator = drake.Simulator(builder.Build())
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    plant.SetPositions(context, [5.1e-3])
    with brinell.drake.attach(plant, simulator, (Sphere(body, 5e-3), Plane()), resting) as attached:
        for _ in range(300):
            force = attached.step()[0]
        assert np.abs(attached.gaps + attached.contact["indentation"]).max() < 1e-12
    wanted = 500.0 * (0.02 + plant.GetPositions(context)[0]) if gain > 0.0 else 10.0
    assert force == pytest.approx(min(wanted, limit) + 0.1 * 9.81, rel=1e-6)


def test_a_step_begins_where_the_plant_makes_one(unit):
    simulator, plant, context = world(BOX)
    put(plant, context, "box", [0.0, 0.0, 0.3])
    simulator.AdvanceTo(2.5e-3)
    attached = brinell.drake.attach(plant, simulator, feet(plant), unit(4))
    with attached, pytest.raises(ContactError, match="time = 0.0025 s is within a step of the plant, of 0.001 s"):
        attached.step()


def test_a_plant_that_is_the_whole_system_comes_to_rest_on_its_feet(unit):
    plant = drake.MultibodyPlant(1e-3)
    central = drake.RotationalInertia(*INERTIA)
    box = plant.AddRigidBody("box", drake.SpatialInertia.MakeFromCentralInertia(MASS, np.zeros(3), central))
    plant.Finalize()
    simulator = drake.Simulator(plant)
    context = simulator.get_mutable_context()
    put(plant, context, "box", [0.0, 0.0, 0.025])
    with brinell.drake.attach(plant, simulator, feet(plant), unit(4)) as attached:
        for step in range(1, 301):
            forces = attached.step()
            assert context.get_time() == pytest.approx(1e-3 * step, abs=1e-15)
            assert forces == pytest.approx(np.full(4, forces[0]), rel=1e-9)
            pose = plant.EvalBodyPoseInWorld(context, box)
            assert -1e-12 < 0.025 - pose.translation()[2] < 1e-6
            assert np.abs(pose.rotation().matrix() - np.eye(3)).max() < 1e-12


def test_bodies_stay_where_they_are_if_the_unit_refuses_a_step(unit):
    simulator, plant, context = world(BOX)
    put(plant, context, "box", [0.0, 0.0, 0.0252])
    plant.SetVelocities(context, [0.5, 0.0, 0.0, 0.0, 0.0, -0.5])
    start = np.array(plant.GetPositionsAndVelocities(context))
    with brinell.drake.attach(plant, simulator, feet(plant), unit(4)) as attached:
        made, steps = attached.contact.step, []

        def refuses_the_second(*arguments, **keywords):
            steps.append(arguments)
            if len(steps) == 2:
                raise ContactError("refused")
            return made(*arguments, **keywords)

        attached.contact.step = refuses_the_second
        with pytest.raises(ContactError, match="refused"):
            attached.step()
    assert len(steps) == 2 and context.get_time() == 0.0
    assert np.array_equal(plant.GetPositionsAndVelocities(context), start)


def test_what_is_refused_names_the_pair(unit):
    simulator, plant, _ = world({**BOX, "ball": ball(0.1, 5e-3)})
    box, other = (plant.GetBodyByName(name) for name in ("box", "ball"))
    foot, floor = Sphere(box, 5e-3), Plane()
    for pairs, text in (
        ([(floor, foot)], "pair 0: Plane and Sphere; allowed are Sphere and Plane, or Sphere and Sphere"),
        ([(foot, floor), (box, floor)], "pair 1: RigidBody and Plane; allowed are"),
        ([(foot,)], "pair 0: Sphere; allowed are"),
        ([(foot, Sphere(other, 0.0))], r"pair 0: radius = 0.0: a sphere needs one above 0 \[m\]"),
        ([(foot, Plane(normal=(0, 0, 0)))], r"pair 0: normal = \(0, 0, 0\): a plane needs one that is not zero"),
        ([(foot, Sphere(box, 5e-3, (0.1, 0, 0)))], "pair 0: both spheres belong to the body 'box'"),
        ([(foot, floor)], r"1 contacts of the engine: feet2.fmu has foot\[1\], foot\[2\]"),
    ):
        with pytest.raises(ContactError, match=text):
            brinell.drake.attach(plant, simulator, pairs, unit(2))
    continuous = drake.MultibodyPlant(0.0)
    with pytest.raises(ContactError, match="the plant is not finalized: call plant.Finalize"):
        brinell.drake.attach(continuous, simulator, [], unit(2))
    continuous.Finalize()
    with pytest.raises(
        ContactError, match=r"time_step = 0: attach needs a discrete plant, MultibodyPlant\(time_step\)"
    ):
        brinell.drake.attach(continuous, simulator, [], unit(2))
