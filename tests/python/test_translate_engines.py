"""Numbers for other tools in the tools themselves: each block is run as it is printed, and rebounds as promised."""

import re
import sys
from pathlib import Path

import brinell
import numpy as np
import pytest
from drops import BALLS, BALLS_AND_STEPS, PHASES, SCENE, ball_of, compare, promised_at, stepped, two_spheres
from in_engines import (
    in_bullet,
    in_drake,
    in_exudyn,
    in_lammps,
    in_lammps_processes,
    in_newton,
    in_sapien,
    lammps_loaded,
    speeds_in_lammps,
)

RADIUS, MASS = 5e-3, 4e-3
SPEED = 1.0
STEPS = (None, "1e-4")


@pytest.mark.parametrize("name", ["point", "sap"])
@pytest.mark.parametrize(("which", "step"), BALLS_AND_STEPS)
def test_drake(name, which, step, tmp_path):
    pytest.importorskip("pydrake.all")
    scene, radius, mass, fast = ball_of(tmp_path, which)
    way = brinell.translate(scene, "drake", step=step)[name]
    rebounds = in_drake(way.block, radius, mass, fast, PHASES).rebounds
    compare(way, fast, rebounds, 1e-5)


@pytest.mark.parametrize("name", ["stiffness", "restitution"])
@pytest.mark.parametrize(("which", "step"), [*BALLS_AND_STEPS, ("mild", "1e-5")])
def test_pybullet(name, which, step, tmp_path):
    pytest.importorskip("pybullet")
    scene, radius, mass, fast = ball_of(tmp_path, which)
    way = brinell.translate(scene, "bullet", step=step)[name]
    # a restitution holds for any step
    time = way.step or float(step or 1e-3)
    rebounds = in_bullet(way.block, radius, mass, fast, PHASES, time).rebounds
    compare(way, fast, rebounds, 1e-5)


@pytest.mark.parametrize(
    ("name", "step", "tolerance"), [("semi-implicit", "1e-4", 1e-3), ("mujoco-solver", "1e-4", 1e-3)]
)
def test_newton(name, step, tolerance):
    pytest.importorskip("newton")
    way = brinell.translate(SCENE, "newton", step=step)[name]
    rebounds = in_newton(way.block, RADIUS, MASS, SPEED, PHASES, way.step).rebounds
    assert np.mean(rebounds) == pytest.approx(promised_at(way, SPEED)["restitution"], abs=tolerance)


@pytest.mark.parametrize("name", ["sphere", "hunt-crossley", "plastic", "damping"])
@pytest.mark.parametrize("which", BALLS)
def test_exudyn(name, which, tmp_path):
    pytest.importorskip("exudyn")
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
        [rebound] = in_exudyn(way.block, radius, mass, speed, promise["contact_time"]).rebounds
        assert rebound == pytest.approx(promise["restitution"], abs=1e-3)


@pytest.fixture(scope="module")
def lammps():
    try:
        return lammps_loaded()
    except (ImportError, OSError) as error:
        pytest.skip(f"LAMMPS can't be loaded here: {error}")


@pytest.mark.parametrize("name", ["hooke", "hertz"])
@pytest.mark.parametrize(("which", "step"), BALLS_AND_STEPS)
def test_lammps(lammps, name, which, step, tmp_path):
    scene, radius, mass, fast = ball_of(tmp_path, which)
    way = brinell.translate(scene, "lammps", step=step)[name]
    rebounds = in_lammps(lammps, way.block, radius, mass, fast, PHASES, way.step).rebounds
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


def test_lammps_mdr(tmp_path):
    if not (Path(sys.prefix) / "bin" / "lmp").exists():
        pytest.skip("LAMMPS can't be installed here")
    way = brinell.translate(SCENE, "lammps")["mdr"]
    drops = in_lammps_processes(way.block, RADIUS, MASS, SPEED, PHASES, way.step, tmp_path)
    rebounds = drops.rebounds
    compare(way, SPEED, rebounds, 1e-4)


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
    drops = in_sapien(made, RADIUS, MASS, SPEED, PHASES, step, **settings)
    compare(way, SPEED, drops.rebounds, 1e-5)


@pytest.mark.parametrize("step", STEPS)
def test_sapien_has_the_compliant_contact_of_physx(step):
    sapien = pytest.importorskip("sapien")
    way = brinell.translate(SCENE, "physx", step=step)["compliant"]
    # these bindings have no damping
    numbers = {**way.numbers, "damping": 0.0}
    made = sapien.physx.PhysxMaterial(0.0, 0.0, -numbers["stiffness"])
    drops = in_sapien(made, RADIUS, MASS, SPEED, PHASES, way.step, enable_tgs=False)
    rebounds = drops.rebounds
    impacts = [stepped("physx", "compliant", numbers, RADIUS, MASS, SPEED, way.step, phase) for phase in PHASES]
    expected = [impact["restitution"] for impact in impacts]
    assert rebounds == pytest.approx(expected, abs=5e-4)
    assert np.mean(rebounds) == pytest.approx(np.mean(expected), abs=1e-4)
