"""Numbers for other tools in tools that Debian has: each block is used as it is printed, and the ball rebounds as promised."""

import ctypes
import os
import re
import subprocess
from pathlib import Path

import brinell
import numpy as np
import pytest
from drops import PHASES, SCENE, compare

ROOT = Path(os.environ["BRINELL_TEST_DEBIAN"])
RADIUS, MASS, SPEED = 5e-3, 4e-3, 1.0
LIBRARIES = [
    ROOT / "usr/lib/x86_64-linux-gnu",
    ROOT / "usr/lib/x86_64-linux-gnu/openmpi/lib",
    ROOT / "lib/x86_64-linux-gnu",
]


Real, Vector = ctypes.c_double, ctypes.c_double * 4
SURFACE = "mu mu2 rho rho2 rhoN bounce bounce_vel soft_erp soft_cfm motion1 motion2 motionN slip1 slip2"
# ode/contact.h
MODES = {"dContactBounce": 0x004, "dContactSoftERP": 0x008, "dContactSoftCFM": 0x010}


class Surface(ctypes.Structure):
    _fields_ = [("mode", ctypes.c_int), *((name, Real) for name in SURFACE.split())]


class Geometry(ctypes.Structure):
    _fields_ = [
        ("pos", Vector),
        ("normal", Vector),
        ("depth", Real),
        ("g1", ctypes.c_void_p),
        ("g2", ctypes.c_void_p),
        ("side1", ctypes.c_int),
        ("side2", ctypes.c_int),
    ]


class Contact(ctypes.Structure):
    _fields_ = [("surface", Surface), ("geom", Geometry), ("fdir1", Vector)]


def ode():
    ctypes.CDLL(str(LIBRARIES[0] / "libccd.so.2"), mode=ctypes.RTLD_GLOBAL)
    library = ctypes.CDLL(str(LIBRARIES[0] / "libode.so.8"))
    pointer = ctypes.c_void_p
    for name in "dWorldCreate dBodyCreate dJointGroupCreate dJointCreateContact".split():
        getattr(library, name).restype = pointer
    for name in "dBodyGetPosition dBodyGetLinearVel".split():
        getattr(library, name).restype = ctypes.POINTER(Real)
        getattr(library, name).argtypes = [pointer]
    library.dBodyCreate.argtypes = [pointer]
    library.dBodySetPosition.argtypes = library.dBodySetLinearVel.argtypes = [pointer, Real, Real, Real]
    library.dMassSetSphereTotal.argtypes = [pointer, Real, Real]
    library.dBodySetMass.argtypes = [pointer, pointer]
    library.dJointCreateContact.argtypes = [pointer, pointer, ctypes.POINTER(Contact)]
    library.dJointAttach.argtypes = [pointer, pointer, pointer]
    library.dWorldStep.argtypes = [pointer, Real]
    library.dJointGroupEmpty.argtypes = [pointer]
    library.dJointGroupCreate.argtypes = [ctypes.c_int]
    library.dInitODE2(0)
    return library


@pytest.mark.parametrize("name", ["spring", "bounce"])
@pytest.mark.parametrize("step", [None, "1e-4"])
def test_ode(name, step):
    library = ode()
    way = brinell.translate(SCENE, "ode", step=step)[name]
    contact = Contact()
    for word, value in re.findall(r"contact\.surface\.(\w+) = (.*);", way.block):
        value = sum(MODES[mode] for mode in value.split(" | ")) if word == "mode" else float(value)
        setattr(contact.surface, word, value)
    time = way.step or float(step or 1e-3)
    rebounds = []
    for phase in PHASES:
        world, group = library.dWorldCreate(), library.dJointGroupCreate(0)
        body = library.dBodyCreate(world)
        mass = ctypes.create_string_buffer(512)
        library.dMassSetSphereTotal(mass, MASS, RADIUS)
        library.dBodySetMass(body, mass)
        library.dBodySetPosition(body, 0.0, 0.0, RADIUS + phase * time * SPEED)
        library.dBodySetLinearVel(body, 0.0, 0.0, -SPEED)
        for _ in range(1000):
            height = library.dBodyGetPosition(body)[2]
            speed = library.dBodyGetLinearVel(body)[2]
            if speed > 0 and height > RADIUS:
                break
            if height < RADIUS:
                contact.geom.normal[2], contact.geom.depth = 1.0, RADIUS - height
                joint = library.dJointCreateContact(world, group, ctypes.byref(contact))
                library.dJointAttach(joint, body, None)
            library.dWorldStep(world, time)
            library.dJointGroupEmpty(group)
        rebounds.append(speed / SPEED)
    compare(way, SPEED, rebounds, 1e-5)


SCRIPT = """
units si
atom_style granular
boundary f f f
newton off
communicate single vel yes
region box block -0.1 0.1 -0.1 0.1 -0.1 0.1 units box
create_box 1 box
neighbor 0.001 bin
{block}
create_atoms 1 single 0 0 {height:.17g}
set group all diameter {diameter} density {density:.17g}
velocity all set 0 0 -{speed}
fix move all nve/sphere
compute v all property/atom vz
compute s all reduce sum c_v
thermo_style custom step c_s
thermo 400
thermo_modify lost ignore norm no format float %.15g
run 400
"""


@pytest.mark.parametrize("name", ["hertz", "hooke", "luding", "thornton-ning"])
@pytest.mark.parametrize("step", [None, "1e-4"])
def test_liggghts(name, step, tmp_path):
    way = brinell.translate(SCENE, "liggghts", step=step)[name]
    density = MASS / (4 / 3 * np.pi * RADIUS**3)
    more = {
        "LD_LIBRARY_PATH": ":".join(map(str, LIBRARIES)),
        "OPAL_PREFIX": str(ROOT / "usr"),
        # one process without a daemon
        "OMPI_MCA_ess_singleton_isolated": "1",
        "OMPI_MCA_btl": "self",
        "OMPI_ALLOW_RUN_AS_ROOT": "1",
        "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    }
    rebounds = []
    for phase in PHASES:
        height = RADIUS + phase * way.step * SPEED
        script = SCRIPT.format(block=way.block, height=height, diameter=2 * RADIUS, density=density, speed=SPEED)
        (tmp_path / "in").write_text(script, encoding="utf-8")
        run = subprocess.run(
            [ROOT / "usr/bin/liggghts", "-in", "in"],
            cwd=tmp_path,
            env={**os.environ, **more},
            capture_output=True,
            text=True,
            errors="replace",
            check=False,
        )
        last = re.findall(r"^ +400 +(\S+)", run.stdout, re.M)
        assert last, run.stdout[-3000:] + run.stderr[-1000:]
        rebounds.append(float(last[-1]) / SPEED)
    compare(way, SPEED, rebounds, 1e-5)
