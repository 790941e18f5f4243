"""Numbers for other tools in Yade of Debian: each block is run as it is printed, and the ball rebounds as promised."""

import json
import os
import subprocess
from pathlib import Path

import brinell
import pytest
from drops import BALLS_AND_STEPS, PHASES, SCENE, ball_of, compare

ROOT = Path(os.environ["BRINELL_TEST_DEBIAN"])
MODULES = ROOT / "usr/lib/x86_64-linux-gnu/yade-double/py"
LIBRARIES = [
    *(ROOT / "usr/lib/x86_64-linux-gnu" / name for name in ("", "yade-double", "openmpi/lib")),
    *(ROOT / "usr/lib/x86_64-linux-gnu" / name for name in ("openblas-pthread", "lapack", "blas")),
    *(MODULES / name for name in ("yade", "yade/qt", "gts")),
]

SCRIPT = """
import json, sys
from yade import *
from yade.wrapper import *
from yade import utils
asked = json.loads(sys.argv[1])
radius, speed, rebounds = asked["radius"], asked["speed"], []
for phase in asked["phases"]:
    O.reset()
    exec(asked["block"])
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()]),
        InteractionLoop(
            [Ig2_Wall_Sphere_ScGeom(), Ig2_Sphere_Sphere_ScGeom()],
            [physics],
            [Law2_ScGeom_MindlinPhys_Mindlin(), Law2_ScGeom_LudingPhys_Basic()],
        ),
        integrator,
    ]
    O.materials.append(material)
    if asked["on_wall"]:
        O.bodies.append(utils.wall(0, axis=2, material=material))
    else:
        O.bodies.append(utils.sphere((0, 0, -radius), radius, fixed=True, material=material))
    height = radius + phase * O.dt * speed
    ball = O.bodies[O.bodies.append(utils.sphere((0, 0, height), radius, material=material))]
    ball.state.vel = (0, 0, -speed)
    O.run(400, True)
    rebounds.append(ball.state.vel[2] / speed)
print("rebounds", json.dumps(rebounds))
"""


def rebounds_in_yade(block, on_wall=True, radius=5e-3, speed=1.0):
    asked = {"block": block, "on_wall": on_wall, "phases": list(PHASES), "radius": radius, "speed": speed}
    # the interpreter of Debian, for which its modules are
    own = ROOT / "usr/bin/python3.11"
    python = own if own.exists() else Path("/usr/bin/python3.11")
    run = subprocess.run(
        [python, "-c", SCRIPT, json.dumps(asked)],
        env={
            "PATH": os.environ["PATH"],
            "HOME": os.environ.get("TMPDIR", "/tmp"),
            "PYTHONPATH": f"{MODULES}:{ROOT / 'usr/lib/python3/dist-packages'}",
            "PYTHONDONTWRITEBYTECODE": "1",
            "LD_LIBRARY_PATH": ":".join(map(str, LIBRARIES)),
            "OPAL_PREFIX": str(ROOT / "usr"),
            "YADE_PREFIX": str(ROOT / "usr"),
            "OMP_NUM_THREADS": "1",
        },
        capture_output=True,
        text=True,
        check=False,
    )
    # the modules of Open MPI speak on stdout, too
    found = [line for line in run.stdout.splitlines() if line.startswith("rebounds ")]
    assert found, run.stdout[-2000:] + run.stderr[-2000:]
    return json.loads(found[0].removeprefix("rebounds "))


@pytest.mark.parametrize(("which", "step"), BALLS_AND_STEPS)
@pytest.mark.parametrize("name", ["mindlin", "luding"])
def test_yade(name, which, step, tmp_path):
    ball = ball_of(tmp_path, which)
    way = brinell.translate(ball.scene, "yade", step=step)[name]
    found = rebounds_in_yade(way.block, name == "mindlin", ball.radius, ball.speed)
    # the density is printed with seven digits
    compare(way, ball.speed, found, 1e-6)


def test_yades_luding_is_elastic_on_a_wall():
    block = brinell.translate(SCENE, "yade")["luding"].block
    assert min(rebounds_in_yade(block)) > 0.99


def test_yade_damps_more_without_the_integrator_of_the_block():
    block = brinell.translate(SCENE, "yade")["mindlin"].block
    other = block.replace("damping=0.0", "damping=0.2")
    assert other != block
    assert max(rebounds_in_yade(other)) < min(rebounds_in_yade(block)) - 0.01
