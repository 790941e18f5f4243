"""Numbers for other tools in Jolt, which Node.js runs: the block is used as it is printed, and the ball rebounds as promised."""

import re

import brinell
import pytest
from drops import PHASES, SCENE, compare, rebounds_in_node

RADIUS, SPEED = 5e-3, 1.0

# the bindings have the names of the C++ interface; a ball that bounces leaves the world to the next
SCRIPT = """
import Jolt from 'jolt-physics';
const { block, phases, radius, speed, time } = JSON.parse(process.argv.at(-1));
const jolt = await Jolt();
const { BodyCreationSettings, RVec3, Quat, Vec3 } = jolt;
const set = (object, name) =>
    block.filter(([whose]) => whose === name).forEach(([, key, value]) => {
        if (!(key in object)) throw new Error(`${name} has no ${key}`);
        object[key] = value;
    });
const pairs = new jolt.ObjectLayerPairFilterTable(2);
pairs.EnableCollision(0, 1);
const layers = new jolt.BroadPhaseLayerInterfaceTable(2, 2);
[0, 1].forEach(n => layers.MapObjectToBroadPhaseLayer(n, new jolt.BroadPhaseLayer(n)));
const worldSettings = new jolt.JoltSettings();
worldSettings.mObjectLayerPairFilter = pairs;
worldSettings.mBroadPhaseLayerInterface = layers;
worldSettings.mObjectVsBroadPhaseLayerFilter = new jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 2, pairs, 2);
const world = new jolt.JoltInterface(worldSettings);
const physics = world.GetPhysicsSystem();
physics.SetGravity(new Vec3(0, 0, 0));
const settings = physics.GetPhysicsSettings();
set(settings, 'settings');
physics.SetPhysicsSettings(settings);
const bodies = physics.GetBodyInterface();
const create = (shape, y, motion, layer, name, velocity) => {
    const made = new BodyCreationSettings(shape, new RVec3(0, y, 0), new Quat(0, 0, 0, 1), motion, layer);
    set(made, name);
    made.mLinearVelocity = new Vec3(0, velocity, 0);
    const body = bodies.CreateBody(made);
    bodies.AddBody(body.GetID(), jolt.EActivation_Activate);
    return body;
};
create(new jolt.BoxShape(new Vec3(1, 0.1, 1)), -0.1, jolt.EMotionType_Static, 0, 'flat', 0);
const rebounds = phases.map(phase => {
    const ball = create(
        new jolt.SphereShape(radius), radius + phase * time * speed, jolt.EMotionType_Dynamic, 1, 'ball', -speed);
    let count = 0;
    while (ball.GetLinearVelocity().GetY() < 0 && count++ < 100) world.Step(time, 1);
    // and what comes after
    for (let n = 0; n < 5; n++) world.Step(time, 1);
    const rebound = ball.GetLinearVelocity().GetY() / speed;
    bodies.RemoveBody(ball.GetID());
    bodies.DestroyBody(ball.GetID());
    return rebound;
});
console.log('rebounds', JSON.stringify(rebounds));
"""


def rebounds_in_jolt(block, step):
    # the settings are the same in both languages
    settings = re.findall(r"^(\w+)\.(m\w+) = (\S+?)f?;$", block, re.MULTILINE)
    assert len(settings) == 4, block
    asked = {
        "block": [(whose, key, float(value)) for whose, key, value in settings],
        "phases": list(PHASES),
        "radius": RADIUS,
        "speed": SPEED,
        "time": step,
    }
    return rebounds_in_node(SCRIPT, asked)


@pytest.mark.parametrize("step", [1e-3, 1e-4])
def test_jolt(step):
    way = brinell.translate(SCENE, "jolt", step=step)["restitution"]
    compare(way, SPEED, rebounds_in_jolt(way.block, step), 1e-6)


def test_jolt_bounces_not_below_its_threshold_which_the_block_sets_to_zero():
    block = brinell.translate(SCENE, "jolt")["restitution"].block
    threshold = block.replace("Restitution = 0.0f", "Restitution = 2.0f")
    assert threshold != block
    assert max(rebounds_in_jolt(threshold, 1e-3)) < 1e-3
