"""Contacts in MuJoCo: distances, inverse masses, momentum, energy, and what is refused."""

import re

import brinell
import brinell.mujoco
import mujoco
import numpy as np
import pytest
from brinell import ContactError, UnknownName
from feet import FEET, INERTIA, MASS, held
from units import SCENES, some


def world(bodies, step=1e-3, gravity=-9.81, more=""):
    """A model with these bodies; geoms do not touch by themselves unless they say so."""
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{step}" gravity="0 0 {gravity}"/>'
        '<default><geom contype="0" conaffinity="0"/></default>'
        f"<worldbody>{bodies}</worldbody>{more}</mujoco>"
    )
    return model, mujoco.MjData(model)


FLOOR = '<geom name="floor" type="plane" size="1 1 .1"/>'
BOX = (
    f'<body name="box"><freejoint/><inertial pos="0 0 0" mass="{MASS}" diaginertia="1.2e-4 2.6e-4 3.5e-4"/>'
    + "".join(f'<geom name="foot{i}" size="5e-3" pos="{x} {y} {z}"/>' for i, (x, y, z) in enumerate(FEET))
    + "</body>"
)
PAIRS = [(f"foot{i}", "floor") for i in range(4)]


@pytest.mark.parametrize("directions", [0, 2])
def test_the_inverse_masses_of_a_box_are_those_of_its_arms(unit, directions):
    model, data = world(FLOOR + BOX)
    data.qpos[:] = [0.1, 0.2, 0.3, 0.9, 0.3, -0.2, 0.1]
    mujoco.mju_normalize4(data.qpos[3:])
    data.qvel[:] = [0.1, -0.2, 0.3, 1.0, 2.0, 3.0]
    mujoco.mj_forward(model, data)
    # the axes of the ground in those of the box: the normal, and the tangents, which may point to the other side
    axes = data.body("box").xmat.reshape(3, 3)[[2, 0, 1]].copy()
    with brinell.mujoco.attach(model, data, PAIRS, unit(4, directions)) as attached:
        assert attached.gaps == pytest.approx(0.3 + FEET @ axes[0] - 5e-3, abs=1e-15)
        assert not attached.step().any()
    rows = [(axis, np.cross(foot - 5e-3 * axes[0], axis)) for axis in axes[: 1 + directions] for foot in FEET]
    moves, turns = (np.array(part) for part in zip(*rows, strict=True))
    expected = moves @ moves.T / MASS + turns @ (turns / INERTIA).T
    assert np.abs(attached.inverse_masses) == pytest.approx(np.abs(expected), rel=1e-9, abs=1e-9)
    assert attached.inverse_masses[:4, :4] == pytest.approx(expected[:4, :4], rel=1e-12)
    assert attached.contact.closed


# a ball on an arm above the floor, and another beside it: every term of the second derivatives of distances
MOVING = """
<body name="first" pos="0.1 0.2 0.06"><freejoint/><inertial pos="0 0 0" mass="0.5" diaginertia="1e-4 1e-4 2e-4"/>
  <geom name="first" size="5e-3" pos=".01 0 .02"/></body>
<body name="second" pos="0.13 0.2 0.1"><freejoint/><geom name="second" size="4e-3" mass="0.1"/></body>
"""


def test_the_unit_ends_where_bodies_that_turn_do(unit):
    for step in (2e-3, 1e-3, 1e-4):
        model, data = world(FLOOR + MOVING, step)
        data.qvel[:] = [-0.3, 0.5, 0.2, 1.0, 4.0, -2.0, 0.4, -0.6, 0.3, 0.0, 0.0, 0.0]
        pairs = [("floor", "first"), ("second", "first")]
        with brinell.mujoco.attach(model, data, pairs, unit(2)) as attached:
            assert not attached.step().any()
            assert np.abs(attached.gaps + attached.contact["indentation"]).max() < 2e-12


CORNER = """
<body name="box"><freejoint/><inertial pos="3e-3 1e-3 2e-3" mass="0.3" diaginertia="1.2e-4 2.6e-4 3.5e-4"/>
  <geom name="corner" size="5e-3" pos=".03 .02 .01"/></body>
<body name="ball" pos=".045 .02 .012"><freejoint/><geom name="ball" size="5e-3" mass="0.05"/></body>
"""


def momentum(model, data):
    """Linear momentum [N s], angular momentum about the origin [N m s] and kinetic energy [J]."""
    mujoco.mj_forward(model, data)
    linear, angular, kinetic = np.zeros(3), np.zeros(3), 0.0
    for body in range(1, model.nbody):
        speed = np.zeros(6)
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_XBODY, body, speed, 0)
        turn, mass, centre = speed[:3], model.body_mass[body], data.xipos[body]
        moves = speed[3:] + np.cross(turn, centre - data.xpos[body])
        axes = data.ximat[body].reshape(3, 3)
        spin = axes @ (model.body_inertia[body] * (axes.T @ turn))
        linear += mass * moves
        angular += spin + mass * np.cross(centre, moves)
        kinetic += 0.5 * mass * moves @ moves + 0.5 * spin @ turn
    return linear, angular, kinetic


def collide(path, bodies, pairs, speed, step):
    """How momentum, angular momentum and energy change as the last body hits the others at this speed
    [m/s], each over what that body has at first."""
    model, data = world(bodies, step, 0.0)
    data.qvel[-6:-3] = speed
    before = momentum(model, data)
    with brinell.mujoco.attach(model, data, pairs, path) as attached:
        for _ in range(round(0.02 / step)):
            attached.step()
        names = ["dissipated_energy"] + ["friction_work"] * (attached.contact.directions > 0)
        taken = sum(np.sum(attached.contact[name]) for name in names)
        assert taken > 0.1 * before[2] and np.all(attached.gaps > 0.0)
    after = momentum(model, data)
    scales = [np.linalg.norm(before[0]), np.linalg.norm(before[1]), before[2]]
    changes = [after[0] - before[0], after[1] - before[1], after[2] + taken - before[2]]
    return [np.max(np.abs(change)) / scale for change, scale in zip(changes, scales, strict=True)]


def balls(**places):
    """Balls of 4 g at these places."""
    geom = '<body name="{0}" pos="{1}"><freejoint/><geom name="{0}" size="5e-3" mass="4e-3"/></body>'
    return "".join(geom.format(name, place) for name, place in places.items())


RACK = balls(left="0 5e-3 0.1", right="0 -5.001e-3 0.1", cue="0.02 1e-3 0.1")
SPINS = balls(still="0 0 0.1", cue="0.02 3e-3 0.102")
# bodies, pairs, directions of friction, the speed [m/s]; at each step [s] what momentum, angular momentum and energy may change
COLLISIONS = [
    (RACK, [("left", "right"), ("cue", "left"), ("right", "cue")], 0, [-2.0, 0.1, 0.05], {1e-3: (1e-14, 5e-5, 1e-3)}),
    (CORNER, [("ball", "corner")], 0, [-0.5, 0.1, 0.0], {1e-3: (2e-6, 2e-6, 1e-3), 1e-4: (2e-7, 2e-7, 1e-5)}),
    (SPINS, [("cue", "still")], 2, [-2.0, 0.1, 0.05], {1e-3: (1e-14, 1e-4, 5e-3), 1e-4: (1e-14, 5e-6, 5e-4)}),
]


@pytest.mark.parametrize(("bodies", "pairs", "directions", "speed", "limits"), COLLISIONS, ids=["rack", "corner", "friction"])
def test_bodies_that_collide_keep_their_momentum_and_lose_what_the_contacts_take(unit, bodies, pairs, directions, speed, limits):
    for step, allowed in limits.items():
        errors = collide(unit(len(pairs), directions), bodies, pairs, speed, step)
        assert np.all(np.array(errors) < allowed), f"{step}: {errors}"


def test_a_pendulum_that_touches_nothing_keeps_its_energy(unit):
    arm = '<body pos="0 0 1"><joint axis="0 1 0" pos="0 0 0.1"/><geom name="bob" size="5e-3" mass="0.1"/></body>'
    for step, allowed in ((2e-3, 1.6e-4), (1e-3, 4e-5)):
        model, data = world(FLOOR + arm, step)
        data.qpos[0] = 1.0
        worst, inertia = 0.0, 0.1 * (0.01 + 0.4 * 25e-6)
        with brinell.mujoco.attach(model, data, [("bob", "floor")], unit(1)) as attached:
            # once to and fro
            for _ in range(round(0.7 / step)):
                attached.step()
                # above its lowest point, over the energy there
                height = 0.1 * (np.cos(1.0) - np.cos(data.qpos[0]))
                energy = 0.5 * inertia * data.qvel[0] ** 2 + 0.1 * 9.81 * height
                worst = max(worst, abs(energy))
        assert worst < allowed * 0.1 * 9.81 * 0.1 * (1.0 - np.cos(1.0))


def test_a_ball_between_two_walls_has_equal_and_opposite_indentations(unit):
    walls = '<geom name="{}" type="plane" size="1 1 .1" pos="{} 0 0" euler="0 {} 0"/>'
    ball = '<body><joint type="slide" axis="1 0 0"/><geom name="ball" size="5e-3" mass="4e-3"/></body>'
    both = walls.format("left", "-5e-3", 90) + walls.format("right", "5e-3", -90)
    for step in (1e-4, 1e-3):
        model, data = world(both + ball, step)
        data.qvel[:] = 0.5
        pairs = [("ball", "right"), ("ball", "left")]
        with brinell.mujoco.attach(model, data, pairs, unit(2)) as attached:
            contact, start = attached.contact, 0.5 * 4e-3 * 0.25
            for _ in range(100):
                attached.step()
                first, second = contact["indentation"]
                assert first == pytest.approx(-second, abs=1e-14)
                assert data.qpos[0] == pytest.approx(first, abs=1e-14)
                assert 0.5 * 4e-3 * data.qvel[0] ** 2 + held(contact) == pytest.approx(start, rel=1e-9)


def test_a_box_set_on_its_feet_stays(unit):
    model, data = world(FLOOR + BOX)
    data.qpos[2] = 0.025
    with brinell.mujoco.attach(model, data, PAIRS, unit(4)) as attached:
        place = []
        for _ in range(150):
            forces = attached.step()
            place.append(data.qpos.copy())
            assert forces == pytest.approx(np.full(4, forces[0]), rel=1e-9)
    # it swings about the place at which its feet carry it, by no more than that sinks
    heights = 0.025 - np.array(place)[:, 2]
    assert np.all(heights > -1e-12) and heights.max() < 1e-6
    assert np.abs(np.array(place)[:, 3:] - [1.0, 0.0, 0.0, 0.0]).max() < 1e-12


def servos(model, step, share, rng):
    """The damping kv of servos at some hinges and slides, with h kv/I up to `share` in the worst of some poses."""
    inverse, damped, worst = np.zeros((2, model.nv, model.nv)), np.zeros(model.nv), 0.0
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    mujoco.mj_solveM(model, data, inverse[0], np.eye(model.nv))
    single = (mujoco.mjtJoint.mjJNT_SLIDE, mujoco.mjtJoint.mjJNT_HINGE)
    joints = [joint for joint in range(model.njnt) if model.jnt_type[joint] in single]
    for joint in joints:
        first = model.jnt_dofadr[joint]
        damped[first] = rng.integers(2) / inverse[0, first, first]
    for _ in range(30):
        for joint in joints:
            data.qpos[model.jnt_qposadr[joint]] = 2.0 * rng.normal()
        mujoco.mj_forward(model, data)
        mujoco.mj_solveM(model, data, inverse[1], np.eye(model.nv))
        worst = max(worst, step * np.abs(np.linalg.eigvals(inverse[1] * damped)).max())
    return {model.joint(joint).name: damped[model.jnt_dofadr[joint]] * share / max(worst, 1e-9) for joint in joints}


BASES = {
    "free": "<freejoint/>",
    "plane": '<joint name="x" type="slide" axis="1 0 0"/><joint name="z" type="slide" axis="0 0 1"/><joint name="y" axis="0 1 0"/>',
    "lift": '<joint name="z" type="slide" axis="0 0 1"/>',
    "wall": "",
}


def mechanism(rng, step, count):
    """A chain of links on a base, with feet just above the floor, driven by servos: a model, data, and the
    targets of its servos."""
    planar = rng.random() < 0.5
    base = rng.choice(list(BASES)[planar:])

    def axis(slides):
        across = np.array([rng.normal() * (not planar), 1.0, rng.normal() * (not planar)])
        along = np.array([rng.normal(), rng.normal() * (not planar), 1.0])
        return " ".join(map(str, along if slides else across))

    links = ""
    size = rng.integers(1, 4)
    for link in range(size):
        slides = rng.random() < 0.25
        links += (
            f'<body pos="0 0 {-0.1 * (link > 0)}"><joint name="{link}" type="{("hinge", "slide")[slides]}" '
            f'axis="{axis(slides)}" damping="{rng.choice([0.0, 0.0, 0.003, 0.1])}"/>'
            f'<geom type="capsule" fromto="0 0 0 0 0 -.1" size=".008" mass="{rng.uniform(0.02, 0.3)}"/>'
        )
    for foot in range(count):
        place = [rng.uniform(-0.05, 0.05), rng.uniform(-0.05, 0.05) * (not planar), -0.1 - 0.02 * foot * rng.random()]
        links += f'<geom name="foot{foot}" size="5e-3" mass=".01" pos="{" ".join(map(str, place))}"/>'
    links += "</body>" * size
    bodies = '<body pos="0 0 {}" euler="0 0 {}">' + BASES[base] + f'<geom size=".03" mass="1"/>{links}</body>'
    turn, height = 360.0 * rng.random(), 1.0
    model, data = world(FLOOR + bodies.format(height, turn), step)
    bent = [
        model.jnt_qposadr[joint] for joint in range(model.njnt) if model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_HINGE
    ]
    data.qpos[bent] = 0.5 * rng.normal(size=len(bent))
    mujoco.mj_forward(model, data)
    kept, height = data.qpos.copy(), height + 5e-3 - min(data.geom(f"foot{i}").xpos[2] for i in range(count))
    height += 1e-4 * rng.random()
    rates = servos(model, step, rng.uniform(0.0, 1.9), rng)
    motors = "".join(
        f'<position joint="{n}" kp="{kv * rng.uniform(5, 60)}" kv="{kv}"/>' for n, kv in rates.items() if kv
    )
    model, data = world(FLOOR + bodies.format(height, turn), step, more=f"<actuator>{motors}</actuator>")
    data.qpos[:] = kept
    if base == "free":
        data.qpos[2] = height
    data.qvel[:] = 0.3 * rng.normal(size=model.nv)
    mujoco.mj_forward(model, data)
    lowest = min((data.geom(f"foot{i}") for i in range(count)), key=lambda foot: foot.xpos[2])
    slopes = np.zeros((3, model.nv))
    mujoco.mj_jac(model, data, slopes, None, lowest.xpos, model.geom_bodyid[lowest.id])
    # downwards
    data.qvel *= -np.sign(slopes[2] @ data.qvel) or 1.0
    joints = model.actuator_trnid[:, 0]
    middle, swing = data.qpos[model.jnt_qposadr[joints]], rng.uniform(0.0, 0.5, model.nu)
    swing[model.jnt_type[joints] == mujoco.mjtJoint.mjJNT_SLIDE] *= 0.1
    speed = rng.uniform(5.0, 30.0, model.nu)
    return model, data, lambda time: middle + swing * np.sin(speed * time)


@pytest.mark.filterwarnings("ignore::brinell.ContactWarning")  # of speeds and directions
def test_bodies_stay_where_the_unit_says_in_any_mechanism(unit):
    pushed = 0
    seeds = some(range(36), 5)
    for seed in seeds:
        rng = np.random.default_rng(seed)
        step, count = 10.0 ** rng.uniform(-4.0, np.log10(2e-3)), 1 + seed % 6
        model, data, targets = mechanism(rng, step, count)
        pairs, path = [(f"foot{foot}", "floor") for foot in range(count)], unit(count, seed // 6 % 3)
        with brinell.mujoco.attach(model, data, pairs, path) as attached:
            for _ in range(40):
                data.ctrl[:] = targets(data.time)
                pushed += attached.step().any()
                indentations = np.atleast_1d(attached.contact["indentation"])
                off = np.abs(attached.gaps + indentations) / np.maximum(1e-6, 1e-3 * np.abs(indentations))
                assert off.max() <= 1.0, f"{seed}: {off} of what is allowed"
                mujoco.mj_forward(model, data)
                places = [data.geom(name).xpos[2] - 5e-3 for name, _ in pairs]
                assert attached.gaps == pytest.approx(places, abs=1e-14)
    assert pushed > 3 * len(seeds)


PRESS = '<body pos="0 0 .006"><joint name="z" type="slide" axis="0 0 1" damping="{}"/><geom name="ball" size="5e-3" mass=".1"/></body>'


@pytest.mark.parametrize(
    "damping, share, allowed", [(0, 0, 1e-9), (0, 0.2, 1e-9), (0, 1.9, 1e-9), (5, 0.5, 1e-9), (300, 0, 2e-3)]
)
def test_a_servo_presses_with_its_whole_force(resting, damping, share, allowed):
    step = 1e-3
    motor = f'<actuator><position joint="z" kp="500" kv="{0.1 * share / step}"/></actuator>'
    model, data = world(FLOOR + PRESS.format(damping), step, more=motor)
    data.ctrl[0] = -0.02
    with brinell.mujoco.attach(model, data, ("ball", "floor"), resting) as attached:
        for _ in range(300):
            force = attached.step()[0]
    # -500 N/m of the way to the target, and the weight
    assert force == pytest.approx(500.0 * (0.02 + data.qpos[0]) + 0.981, rel=allowed)


def test_a_body_at_rest_costs_one_step_of_the_unit_and_one_evaluation_of_the_engine(resting, monkeypatch):
    model, data = world(FLOOR + PRESS.format(0))
    with brinell.mujoco.attach(model, data, ("ball", "floor"), resting) as attached:
        for _ in range(300):
            attached.step()
        counts = {"unit": 0, "engine": 0}

        def counted(name, function):
            def call(*arguments, **keywords):
                counts[name] += 1
                return function(*arguments, **keywords)

            return call

        attached.contact.step = counted("unit", attached.contact.step)
        monkeypatch.setattr(mujoco, "mj_forwardSkip", counted("engine", mujoco.mj_forwardSkip))
        for _ in range(100):
            attached.step()
    assert counts == {"unit": 100, "engine": 100}


SLIDER = '<body pos="0 0 6e-3" euler="0 0 {}"><joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/><geom name="ball" size="5e-3" mass=".1"/></body>'


@pytest.mark.filterwarnings("error")
def test_bodies_in_a_plane_rub_as_a_ball_that_does_not_turn(unit):
    ends = []
    for directions in (1, 2):
        for turn in (0, 30, 90):
            model, data = world(FLOOR + SLIDER.format(turn))
            data.qvel[:] = [0.5, -0.1]
            with brinell.mujoco.attach(model, data, ("ball", "floor"), unit(1, directions)) as attached:
                for _ in range(50):
                    attached.step()
                assert attached.contact["friction_work"] > 1e-3
            ends.append(np.concatenate((data.qpos, data.qvel)))
    assert np.array(ends) == pytest.approx(np.tile(ends[0], (6, 1)), abs=1e-3)
    assert np.array(ends[:3]) == pytest.approx(np.tile(ends[0], (3, 1)), abs=1e-12)


def test_bodies_that_can_slide_in_two_directions_are_warned_of_friction_in_one(unit):
    hinge = '<body pos="0 0 .1"><joint axis="0 0 1"/><joint type="slide" axis="0 0 1"/><geom name="foot" size="5e-3" pos=".1 0 0"/></body>'
    for body, pairs in ((BOX, PAIRS), (hinge, [("foot", "floor")])):
        model, data = world(FLOOR + body)
        data.qpos[:] = model.qpos0
        with pytest.warns(
            brinell.ContactWarning, match=r"friction in one direction, but the bodies of foot.* directions = 2"
        ):
            brinell.mujoco.attach(model, data, pairs, unit(len(pairs), 1)).close()


def test_a_contact_pushes_only_along_what_its_bodies_can_move(unit):
    """A pendulum above the floor, whose bob can't move along the normal where it hangs, and a slider above it."""
    arm = '<body pos="0 0 {}"><joint axis="0 1 0" pos="0 0 0.1"/><geom name="bob" size="5e-3" mass="0.1"/></body>'
    model, data = world(FLOOR + arm.format(0.006))
    with brinell.mujoco.attach(model, data, ("bob", "floor"), unit(1)) as attached:
        for _ in range(10):
            assert not attached.step().any()
    model, data = world(FLOOR + arm.format(0.0049))
    with (
        brinell.mujoco.attach(model, data, ("bob", "floor"), unit(1)) as attached,
        pytest.raises(ContactError, match=r"pushes, but its bodies can't move along its normal in this pose"),
    ):
        attached.step()


def test_bodies_that_were_moved_into_each_other_are_refused_and_apart_are_followed(unit):
    model, data = world(FLOOR + BOX)
    data.qpos[2] = 0.1
    with brinell.mujoco.attach(model, data, PAIRS, unit(4)) as attached:
        data.qpos[2] = 0.2
        attached.step()
        assert attached.gaps == pytest.approx(-attached.contact["indentation"], abs=1e-12)
        data.qpos[2] = 0.0249
        before = data.qpos.copy()
        with pytest.raises(ContactError, match=r"foot\[1\]: distance -0.0001 m .*: the bodies were moved since"):
            attached.step()
        assert np.array_equal(data.qpos, before) and attached.contact.time == 1e-3


def test_what_is_refused_names_the_pair(unit):
    on = FLOOR.replace("/>", ' conaffinity="1"/>') + BOX.replace('size="5e-3" ', 'size="5e-3" contype="1" ')
    model, data = world(on)
    with pytest.raises(ContactError, match=r"pair 'foot0' and 'floor': MuJoCo's own contact is on; .*contype"):
        brinell.mujoco.attach(model, data, PAIRS, unit(4))
    model, data = world(on, more='<contact><exclude body1="box" body2="world"/></contact>')
    data.qpos[2] = 0.1
    brinell.mujoco.attach(model, data, PAIRS, unit(4)).close()
    explicit = '<contact><pair geom1="floor" geom2="foot1"/></contact>'
    model, data = world(FLOOR + BOX, more=explicit)
    with pytest.raises(ContactError, match="pair 'foot1' and 'floor'"):
        brinell.mujoco.attach(model, data, PAIRS, unit(4))

    log = '<geom name="log" type="cylinder" size=".1 .1" euler="88 0 0" contype="0" conaffinity="0"/>'
    model, data = world(FLOOR + BOX + log)
    with pytest.raises(ContactError, match="cylinder 'log': its axis is tilted by 0.0349 rad against the plane"):
        brinell.mujoco.attach(model, data, [("log", "floor")] * 4, unit(4))

    model, data = world(FLOOR + BOX + '<geom name="block" type="box" size=".1 .1 .1"/>')
    for pairs, error, text in (
        ([("foot0", "roof")], UnknownName, r"no geom 'roof'; there are: floor, block, foot0"),
        (
            [("foot0", "block")],
            ContactError,
            r"pair 'foot0' and 'block': sphere and box; allowed are a sphere, a cylinder, a capsule or a box and a plane",
        ),
        (["foot0"], ContactError, r"pair 'foot0': two names of geoms are needed"),
        ([("block", "floor")], ContactError, r"pair 'block' and 'floor': corner = None: a box needs the radius"),
        ([("foot0", "flor")], UnknownName, r"no geom 'flor' \(did you mean 'floor'\?\); there are"),
        (PAIRS[:3], ContactError, r"3 contacts of the engine: feet4.fmu has foot\[1\], foot\[2\]"),
    ):
        with pytest.raises(error, match=text):
            brinell.mujoco.attach(model, data, pairs, unit(4))
    with pytest.raises(
        ContactError, match=r"moves each contact alone, but these contacts share bodies: inverse_masses"
    ):
        brinell.mujoco.attach(model, data, PAIRS, unit(4, coupling="[coupling]\neffective_mass = 0.1")).step()
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
    with pytest.raises(ContactError, match="integrator = rk4: attach needs MuJoCo's default, Euler"):
        brinell.mujoco.attach(model, data, PAIRS, unit(4))


def slide(path, step, end=0.03):
    """A box that is thrown onto the floor: its velocities at the end, and the error of the energy."""
    model, data = world(FLOOR + BOX, step)
    data.qpos[:] = [0.0, 0.0, 0.0305, 0.999, 0.03, 0.02, 0.01]
    mujoco.mju_normalize4(data.qpos[3:])
    data.qvel[:] = [0.4, -0.2, -0.1, 0.0, 0.0, 1.0]
    with brinell.mujoco.attach(model, data, PAIRS, path) as attached:

        def total():
            mujoco.mj_forward(model, data)
            mujoco.mj_energyPos(model, data)
            mujoco.mj_energyVel(model, data)
            return data.energy.sum() + held(attached.contact)

        start = total()
        while data.time < end - 0.5 * step:
            attached.step()
        assert np.sum(attached.contact["friction_work"]) > 1e-4
        return data.qvel.copy(), abs(total() - start) / start


def test_a_box_that_slides_ends_alike_in_long_and_short_steps(unit):
    path = unit(4, directions=2)
    (long, long_error), (short, short_error) = slide(path, 1e-3), slide(path, 1e-4)
    assert long_error < 1e-4 and short_error < 1e-5
    assert long[:3] == pytest.approx(short[:3], abs=2e-3)


def test_the_arm_of_friction_is_the_same_for_rates_and_impulses(unit):
    """A ball spins fast when it hits: the dent shortens the arm, by which its point of contact slips less."""
    ball, ends = balls(ball="0 0 6e-3"), []
    for step in (1e-3, 1e-5):
        model, data = world(FLOOR + ball, step, 0.0)
        data.qvel[:] = [0.0, 0.0, -0.5, 20.0, 100.0, 30.0]
        kinetic = momentum(model, data)[2]
        with brinell.mujoco.attach(model, data, [("ball", "floor")], unit(1, directions=2)) as attached:
            while data.time < 4e-3 - 0.5 * step:
                attached.step()
            taken = sum(np.sum(attached.contact[name]) for name in ("dissipated_energy", "friction_work"))
        assert taken > 0.3 * kinetic
        assert momentum(model, data)[2] + taken == pytest.approx(kinetic, rel=1e-11)
        ends.append(data.qvel.copy())
    assert ends[0] == pytest.approx(ends[1], rel=1e-3, abs=1e-2)


def test_ends_of_capsules_and_corners_of_boxes_are_spheres(unit):
    inertial = f'<inertial pos="0 0 0" mass="{MASS}" diaginertia="1.2e-4 2.6e-4 3.5e-4"/>'
    shapes = {
        2: ('<geom name="shape" type="capsule" size="5e-3 .03"/>', [(0, 0, 0.03), (0, 0, -0.03)]),
        8: (
            '<geom name="shape" type="box" size=".04 .03 .02"/>',
            [(x, y, z) for x in (-0.035, 0.035) for y in (-0.025, 0.025) for z in (-0.015, 0.015)],
        ),
    }
    for count, (shape, places) in shapes.items():
        spheres = "".join(f'<geom name="s{i}" size="5e-3" pos="{x} {y} {z}"/>' for i, (x, y, z) in enumerate(places))
        ends = []
        for geoms, pairs in ((shape, [("shape", "floor")]), (spheres, [(f"s{i}", "floor") for i in range(count)])):
            body = f'<body name="body" pos="0 0 .045" euler="20 35 0"><freejoint/>{inertial}{geoms}</body>'
            model, data = world(FLOOR + body)
            data.qvel[:] = [0.2, 0.1, -0.5, 1.0, 0.0, 0.0]
            with brinell.mujoco.attach(model, data, pairs, unit(count, directions=2), corner=5e-3) as attached:
                for _ in range(40):
                    attached.step()
                assert np.sum(attached.contact["dissipated_energy"]) > 1e-4
            ends.append(np.concatenate((data.qpos, data.qvel)))
        assert ends[0] == pytest.approx(ends[1], abs=1e-9)


# a contact that knows the mass


def dropped(path, mass=4e-3, height=0.01, steps=100, **arguments):
    """A ball of this mass [kg] that falls from a height [m], with the lost energy [J]."""
    ball = (
        f'<body name="ball" pos="0 0 {0.005 + height}"><freejoint/><geom name="ball" size="5e-3" mass="{mass}"/></body>'
    )
    model, data = world(FLOOR + ball)
    with brinell.mujoco.attach(model, data, ("ball", "floor"), path, **arguments) as attached:
        for _ in range(steps):
            attached.step()
        return data.qpos[2], data.qvel[2], attached.contact["dissipated_energy"]


ALONE = "[coupling]\neffective_mass = 0.1"


def test_one_pair_bounces_by_its_own_mass_as_by_inverse_masses(unit):
    expected = dropped(unit(1))
    assert expected[2] > 1e-5
    assert dropped(unit(1, coupling=ALONE)) == pytest.approx(expected, rel=1e-12, abs=1e-15)


SHAPES = {"roller": 'type="cylinder" size=".01 .01" euler="90 0 0"', "shapes/raceway": 'size="5e-3"'}


@pytest.mark.parametrize("name, height, steps, dents", [("roller", 5e-4, 150, False), ("shapes/raceway", 0.01, 500, True)])
def test_lines_and_ellipses_keep_their_energy_in_steps_of_a_millisecond(tmp_path, name, height, steps, dents):
    text = (SCENES / f"{name}.toml").read_text(encoding="utf-8")
    text = re.sub("outputs = .*", 'outputs = ["indentation", "elastic_energy", "dissipated_energy"]', text)
    # those of a scene that is asked for none have the mass
    text = re.sub("parameters = .*", "", text)
    scene = tmp_path / "scene.toml"
    scene.write_text(text + '[coupling]\neffective_mass = "20 g"\n', encoding="utf-8")
    radius = 0.01 if name == "roller" else 5e-3
    body = f'<body pos="0 0 {radius + height}"><joint type="slide" axis="0 0 1"/><geom name="body" mass=".02" {SHAPES[name]}/></body>'
    model, data = world(FLOOR + body)
    with brinell.mujoco.attach(model, data, ("body", "floor"), scene) as attached:

        def total():
            return 0.02 * (9.81 * (data.qpos[0] + height) + 0.5 * data.qvel[0] ** 2) + held(attached.contact)

        impacts = 0
        for _ in range(steps):
            impacts += attached.step().any()
            assert total() == pytest.approx(0.02 * 9.81 * height, rel=1e-9)
        assert impacts > 4
        assert (attached.contact["dissipated_energy"] > 1e-6) == dents


def test_a_contact_that_exists_and_a_scene_can_be_attached(unit):
    path = unit(1, coupling=ALONE)
    expected = dropped(path, target_yield_strength="400 MPa")
    assert expected != dropped(path)
    contact = brinell.Contact(path)
    assert dropped(contact, target_yield_strength="400 MPa") == expected
    assert contact.closed
    assert dropped(path.with_suffix(".toml"), target_yield_strength=4e8) == expected


# two balls; and a bob on two hinges, whose effective mass changes while it swings
TWO = "".join(
    f'<body name="{name}" pos="{x} 0 .01"><freejoint/><geom name="{name}" size="5e-3" mass="{mass}"/></body>'
    for name, x, mass in (("light", 0.0, 4e-3), ("heavy", 0.1, 4e-2))
)
ARM = """<body pos="0 0 .3"><joint axis="0 1 0"/><geom size="5e-3" mass="0.05"/><geom pos=".2 0 0" size="5e-3" mass="0.05"/>
  <body pos=".2 0 0"><joint axis="0 1 0"/><geom name="bob" size="5e-3" pos=".15 0 0" mass="0.1"/></body></body>"""


@pytest.mark.parametrize(("bodies", "names", "steps", "error"), [(TWO, ["light", "heavy"], 40, 1e-12), (ARM, ["bob"], 400, 1e-6)])
def test_pairs_that_share_no_body_each_move_by_their_own_mass_in_any_pose(unit, bodies, names, steps, error):
    ends, count = [], len(names)
    for path in (unit(count), unit(count, coupling=ALONE, own_masses=count > 1)):
        model, data = world(FLOOR + bodies)
        with brinell.mujoco.attach(model, data, [(name, "floor") for name in names], path) as attached:
            masses = []
            for _ in range(steps):
                attached.step()
                masses.append(1.0 / attached.inverse_masses[0, 0])
            assert np.sum(attached.contact["dissipated_energy"]) > 1e-5
            assert (max(masses) > 1.5 * min(masses)) == (count == 1)
        ends.append(np.concatenate((data.qpos, data.qvel)))
    assert ends[0] == pytest.approx(ends[1], rel=error, abs=0.1 * error)


def test_pairs_of_several_masses_need_several_numbers(unit):
    model, data = world(FLOOR + TWO)
    with (
        brinell.mujoco.attach(model, data, [("light", "floor"), ("heavy", "floor")], unit(2, coupling=ALONE)) as attached,
        pytest.raises(ContactError, match=r"one effective_mass, .*0.004 0.04 *\] kg: parameters_per_contact"),
    ):
        attached.step()


def test_a_contact_that_the_engine_cannot_give_its_masses_is_refused(unit):
    with pytest.raises(ContactError, match=r"plain.fmu can't be given the masses .*effective_mass for one contact"):
        dropped(unit(1, coupling=""))
