"""The compliant contact of PhysX, which Node.js runs: the numbers are used as they are printed, and the ball rebounds as promised."""

import re

import brinell
import pytest
from drops import PHASES, SCENE, compare, rebounds_in_node

RADIUS, MASS, SPEED = 5e-3, 4e-3, 1.0

# The package is made for browsers. Its bindings lack setDamping: the damping follows the restitution in the memory of the material,
# and a setter tells the scene. A static plane is normal to x.
SCRIPT = """
import { readFileSync } from 'node:fs';
const { friction, sliding, restitution, damping, solver, phases, radius, mass, speed, time } = JSON.parse(process.argv.at(-1));
const folder = './node_modules/physx-js-webidl/physx-js-webidl';
const wasm = new WebAssembly.Module(readFileSync(folder + '.wasm'));
const { default: make } = await import(process.cwd() + folder.slice(1) + '.mjs');
const { process: node } = globalThis;
globalThis.window = globalThis;
delete globalThis.process;
let memory;
const px = await make({
    instantiateWasm(imports, done) {
        const { exports } = new WebAssembly.Instance(wasm, imports);
        memory = Object.values(exports).find(one => one instanceof WebAssembly.Memory);
        done({ exports });
        return exports;
    },
});
globalThis.process = node;
const top = px.PxTopLevelFunctions.prototype;
const foundation = px.CreateFoundation(px.PHYSICS_VERSION, new px.PxDefaultAllocator(), new px.PxDefaultErrorCallback());
const scale = new px.PxTolerancesScale();
const physics = px.CreatePhysics(px.PHYSICS_VERSION, foundation, scale);
const material = physics.createMaterial(friction, sliding, restitution);
const floats = new Float32Array(memory.buffer);
const place = floats.indexOf(Math.fround(restitution), material.ptr >> 2);
if (place - (material.ptr >> 2) > 64) throw new Error('no restitution in the material');
floats[place + 1] = damping;
material.setRestitution(restitution);
const still = new px.PxQuat(0, 0, 0, 1);
const flags = new px.PxShapeFlags(px.PxShapeFlagEnum.eSIMULATION_SHAPE);
const add = (scene, actor, geometry) => {
    const shape = physics.createShape(geometry, material, true, flags);
    shape.setSimulationFilterData(new px.PxFilterData(1, 1, 0, 0));
    actor.attachShape(shape);
    scene.addActor(actor);
};
const rebounds = phases.map(phase => {
    const settings = new px.PxSceneDesc(scale);
    settings.gravity = new px.PxVec3(0, 0, 0);
    settings.cpuDispatcher = px.DefaultCpuDispatcherCreate(0);
    settings.filterShader = px.DefaultFilterShader();
    settings.solverType = px.PxSolverTypeEnum[solver];
    const scene = physics.createScene(settings);
    add(scene, physics.createRigidStatic(new px.PxTransform(new px.PxVec3(0, 0, 0), still)), new px.PxPlaneGeometry());
    const above = new px.PxTransform(new px.PxVec3(radius + phase * time * speed, 0, 0), still);
    const ball = physics.createRigidDynamic(above);
    ball.setMass(mass);
    ball.setLinearDamping(0);
    add(scene, ball, new px.PxSphereGeometry(radius));
    ball.setLinearVelocity(new px.PxVec3(-speed, 0, 0));
    for (let n = 0; n < 400; n++) {
        scene.simulate(time);
        scene.fetchResults(true);
        if (ball.getLinearVelocity().x > 0 && ball.getGlobalPose().p.x > radius) break;
    }
    const rebound = ball.getLinearVelocity().x / speed;
    scene.release();
    return rebound;
});
console.log('rebounds', JSON.stringify(rebounds));
"""


def rebounds_in_physx(block, step):
    # what the block says in C++, by the names of the bindings
    made = re.search(r"createMaterial\((\S+)f, (\S+)f, (\S+)f\);", block)
    asked = {
        **dict(zip(("friction", "sliding", "restitution"), map(float, made.groups()), strict=True)),
        "damping": float(re.search(r"setDamping\((\S+)f\);", block)[1]),
        "solver": re.search(r"solverType = PxSolverType::(\w+);", block)[1],
        "phases": list(PHASES),
        "radius": RADIUS,
        "mass": MASS,
        "speed": SPEED,
        "time": step,
    }
    return rebounds_in_node(SCRIPT, asked)


@pytest.mark.parametrize("step", [None, "1e-4"])
def test_physx_compliant(step):
    way = brinell.translate(SCENE, "physx", step=step)["compliant"]
    compare(way, SPEED, rebounds_in_physx(way.block, way.step), 2e-4)


def test_physx_damps_more_with_the_other_solver():
    way = brinell.translate(SCENE, "physx")["compliant"]
    other = way.block.replace("ePGS", "eTGS")
    assert other != way.block
    assert max(rebounds_in_physx(other, way.step)) < min(rebounds_in_physx(way.block, way.step))
