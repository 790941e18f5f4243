"""Measures what ../comparison.md says: a ball of 10 mm on mild steel in engines with their own numbers and with those of Brinell.
An engine that isn't installed is replaced by its published recursion, which the page says.

Where the numbers of the engines are from: the packages themselves at the versions that the page names (newton's step is that of its
examples, PhysX's material and step are SAPIEN's); BodyCreationSettings.h of Jolt 5.5; the manual of ODE
(https://ode.org/wiki/index.php/Manual); SDFormat (http://sdformat.org/spec?elem=surface) for Gazebo; ChContactMaterial.cpp and
ChContactMaterialSMC.cpp of Chrono (https://github.com/projectchrono/chrono) in 2026; NewtonIntegrator of Yade
(https://yade-dem.org/doc/yade.wrapper.html); the README of MathWorks' library of contact forces
(https://github.com/mathworks/Simscape-Multibody-Contact-Forces-Library), which says "start with"; the help of Adams View, "Contact
Parameters for Parts with Small Mass", made for steel parts of a kilogram, with the depth that the help of CONTACT calls reasonable; the
class TwoDContact in the help of MotionView 2021
(https://2021.help.altair.com/2021/hwdesktop/hwx/topics/reference/mv/contact_python_class_twodcontact_r.htm).

    pip install matplotlib scipy ./python -r tests/requirements-engines-large.txt
    python docs/guide/pictures/comparison.py           # writes the tables, and comparison.svg beside this file
    python docs/guide/pictures/comparison.py --check   # compares the tables instead
"""

import functools
import re
import sys
import tempfile
import time
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path

import brinell
import numpy as np

FOLDER = Path(__file__).parent
ROOT = FOLDER.parents[2]
PAGE = FOLDER.parent / "comparison.md"
sys.path.insert(0, str(ROOT / "tests/python"))
import drops
import in_engines

SCENE = ROOT / "scenes/trades/drop_test.toml"
FIT = brinell.predict(SCENE)
RADIUS, MASS, SPEED = 5e-3, FIT.mass, FIT.speed
BALL = (RADIUS, MASS)
RANGE = "0.1:5"
SPEEDS = (0.1, 0.2, 0.5, 1.0, 2.0, SPEED, 5.0)
SHOWN = (0.1, 0.5, 1.0, SPEED, 5.0)
PHASES = (np.arange(10) + 0.5) / 10


@functools.cache
def law(speed):
    return brinell.predict(SCENE, speed=speed)


@functools.cache
def translated(tool, step=None):
    return brinell.translate(SCENE, tool, speed=RANGE, step=step)


@dataclass
class Case:
    """An engine with its numbers."""

    title: str
    package: str = ""
    """The package of the engine."""
    own: object = None
    """The rebounds at a speed, one a phase, by what the engine's makers publish."""
    engine: object = None
    """The same in the engine."""
    tool: str = ""
    way: object = None
    """Numbers of Brinell."""

    def __post_init__(self):
        self.how, self.rebounds, self.seconds = "", {}, np.inf

    def measure(self):
        """The rebounds at all speeds, in the engine if it is here; none if it isn't and has no recursion."""
        run = self.engine if self.engine and self.is_here() else self.own
        self.how = "recursion" if run is self.own else f"{self.package} {metadata.version(self.package)}"
        for speed in SPEEDS if run else ():
            did = run(speed)
            if isinstance(did, in_engines.Drops):
                seconds = did.seconds / did.steps if did.seconds else np.inf
                self.seconds = min(self.seconds, seconds)
                did = did.rebounds
            self.rebounds[speed] = np.mean(did)
        return self

    def is_here(self):
        try:
            self.engine(1.0)
        except (ImportError, OSError):
            return False
        return True

    @property
    def error(self):
        """The largest difference from the law."""
        return max((e - law(speed).restitution for speed, e in self.rebounds.items()), key=abs)


def stepped(tool, name, numbers, step):
    """The rebounds by the published recursion of a tool."""
    return lambda speed: [drops.stepped(tool, name, numbers, RADIUS, MASS, speed, step, phase)["restitution"] for phase in PHASES]


def integrated(tool, name, numbers):
    def run(speed):
        try:
            return [drops.outcome_of(tool, name, numbers, RADIUS, MASS, speed, 40)["restitution"]]
        except drops.Stays:
            return [0.0]

    return run


def typed(restitution, threshold=0.0):
    """A restitution that the tool takes as it is, from a speed on."""
    return lambda speed: [restitution if speed > threshold else 0.0]


PLANT = """
from pydrake.geometry import AddContactMaterial, ProximityProperties
from pydrake.multibody.plant import AddMultibodyPlant, CoulombFriction, MultibodyPlantConfig
plant, scene_graph = AddMultibodyPlant(MultibodyPlantConfig(), builder)
ball, flat = ProximityProperties(), ProximityProperties()
for body in (ball, flat):
    AddContactMaterial(friction=CoulombFriction(1.0, 1.0), properties=body)
"""
SHAPES = """
contact = newton.ModelBuilder.ShapeConfig()
# solver = newton.solvers.SolverSemiImplicit(model); a step of 1e-3 s
"""


MDR = """
comm_modify vel yes
pair_style granular
pair_coeff * * mdr 206e9 0.3 300e6 0.0 0.5 0.0 damping mdr 1 tangential linear_nohistory 0.0 0.0
fix flat all wall/gran granular mdr 206e9 0.3 300e6 0.0 0.5 0.0 damping mdr 1 &
    tangential linear_nohistory 0.0 0.0 zplane 0.0 NULL
timestep 2e-8
"""
STEEL = {"youngs_modulus": 206e9, "yield_strength": 300e6}


def lammps_mdr(block, step, count):
    def run(speed):
        with tempfile.TemporaryDirectory() as folder:
            return in_engines.in_lammps_processes(block, *BALL, speed, PHASES, step, folder, count)

    return run


def own_numbers():
    """Engines with the numbers that they have, or that their documentation says to begin with."""
    # two equal bodies in series
    drake = {"stiffness": 0.5e6, "dissipation": 50.0}
    newton = {"stiffness": 2500.0, "damping": 100.0}
    # a spring that isn't there: the engine has these two numbers instead
    ode = {"erp": 0.2, "cfm": 1e-10, "stiffness": 1.0, "damping": 1.0}
    chrono = {"youngs_modulus": 2e5, "typed_restitution": 0.4}
    start = {"stiffness": 1e4, "damping": 1e2}
    adams = {"stiffness": 1e5 * 1e3**2.2, "exponent": 2.2, "damping": 1e4, "ramp": 1e-5}
    motionview = {"stiffness": 1e3 * 1e3**2.1, "exponent": 2.1, "damping": 1e2, "ramp": 1e-4}
    in_newton = functools.partial(in_engines.in_newton, SHAPES, *BALL, phases=PHASES, step=1e-3)
    return [
        Case("MuJoCo", "mujoco", engine=lambda v: in_engines.in_mujoco("", *BALL, v, PHASES)),
        Case("Bullet", "pybullet", engine=lambda v: in_engines.in_bullet("", *BALL, v, PHASES)),
        Case("Drake", "drake", stepped("drake", "point", drake, 1e-3), lambda v: in_engines.in_drake(PLANT, *BALL, v, PHASES)),
        Case("newton", "newton", stepped("newton", "semi-implicit", newton, 1e-3), lambda v: in_newton(speed=v)),
        Case("PhysX", "sapien", typed(0.1, 2.0), lambda v: in_engines.in_sapien(None, *BALL, v, PHASES, 1e-2)),
        Case("Jolt", own=typed(0.0)),
        Case("ODE", own=stepped("ode", "soft", ode, 1e-3)),
        Case("Gazebo Classic", own=lambda v: [min(0.01, (1 - phase) * v) / v for phase in PHASES]),
        Case("Chrono SMC", own=stepped("chrono", "hertz", chrono, 5e-5)),
        Case("Yade", own=typed(np.sqrt(0.8 / 1.2))),
        Case("Simscape", own=integrated("simscape", "smooth-spring-damper", start)),
        Case("Adams", own=integrated("adams", "impact", adams)),
        Case("MotionView", own=integrated("motionsolve", "impact", motionview)),
        Case("LAMMPS `mdr`", "lammps", stepped("lammps", "mdr", STEEL, 2e-8), lammps_mdr(MDR, 2e-8, 4000)),
    ]


NUMBERS = {
    "MuJoCo": "`solref` 0.02 1, `solimp` 0.9 0.95 0.001 0.5 2, steps of 2 ms",
    "Bullet": "restitution 0, steps of 1/240 s",
    "Drake": "`point_stiffness` 1e6 N/m, dissipation 50 s/m, steps of 1 ms",
    "newton": "`ke` 2500, `kd` 100; steps of 1 ms",
    "PhysX": "SAPIEN's material: restitution 0.1; none below 2 m/s; steps of 10 ms",
    "Jolt": "restitution 0",
    "ODE": "ERP 0.2, CFM 1e-10, no bounce",
    "Gazebo Classic": "`kp` 1e12, `kd` 1, `max_vel` 0.01 m/s, steps of 1 ms",
    "Chrono SMC": "Young's modulus 2e5 Pa, restitution 0.4",
    "Yade": "elastic; damping of the integrator 0.2",
    "Simscape": '1e4 N/m, 1e2 N.s/m, "and adjust from there"',
    "Adams": "1e5 N/mm^2.2, 10 N.s/mm from 0.01 mm on",
    "MotionView": "1e3 N/mm^2.1, 0.1 N.s/mm from 0.1 mm on",
    "LAMMPS `mdr`": "none; mild steel's: 206 GPa, 300 MPa",
}

# tool, way, name in the table, package
WAYS = (
    ("jolt", "restitution", "PhysX, Jolt: restitution", "sapien"),
    ("bullet", "restitution", "Bullet, ODE: restitution", "pybullet"),
    ("mujoco", "pair", "MuJoCo", "mujoco"),
    ("bullet", "stiffness", "Bullet: stiffness and damping", "pybullet"),
    ("newton", "semi-implicit", "newton", "newton"),
    ("ode", "spring", "ODE, Gazebo Classic", ""),
    ("simscape", "smooth-spring-damper", "Simscape", ""),
    ("chrono", "hertz", "Chrono SMC, LIGGGHTS, Yade: Hertz", ""),
    ("lammps", "hertz", "LAMMPS: Hertz", "lammps"),
    ("modelica", "elastogap", "Modelica ElastoGap", ""),
    ("drake", "point", "Drake", "drake"),
    ("drake", "sap", "Drake: SAP", "drake"),
    ("recurdyn", "contact", "RecurDyn", ""),
    ("adams", "impact", "Adams, MotionSolve", ""),
    ("exudyn", "sphere", "Exudyn: impact model 2", "exudyn"),
    ("exudyn", "plastic", "Exudyn: plasticity ratio", "exudyn"),
    ("mercurydpm", "plastic", "MercuryDPM, LIGGGHTS, Yade: Luding", ""),
    ("liggghts", "thornton-ning", "LIGGGHTS: Thornton and Ning", ""),
    ("lammps", "mdr", "LAMMPS: `mdr`", "lammps"),
)


def brinells_numbers():
    """The same engines with the numbers of `brinell translate`."""
    return [
        Case(title, package, *runs_of(tool, name, package), tool=tool, way=translated(tool)[name]) for tool, name, title, package in WAYS
    ]


def runs_of(tool, name, package):
    """How to let the ball fall with numbers of Brinell: by the published recursion, and in the engine."""
    way = translated(tool)[name]
    block, step = way.block, way.step
    if name == "restitution":
        own = typed(way.numbers["restitution"])
    elif step:
        own = stepped(tool, name, way.numbers, step)
    else:
        own = integrated(tool, name, way.numbers)
    engines = {
        "mujoco": lambda v: in_engines.in_mujoco(block, *BALL, v, PHASES),
        "pybullet": lambda v: in_engines.in_bullet(block, *BALL, v, PHASES, step or 1e-3),
        "drake": lambda v: in_engines.in_drake(block, *BALL, v, PHASES),
        "newton": lambda v: in_engines.in_newton(block, *BALL, v, PHASES, step),
        "exudyn": lambda v: in_engines.in_exudyn(block, *BALL, v, law(v).contact_time),
        "sapien": lambda v: in_physx(way.numbers["restitution"], v),
        "lammps": lammps_mdr(block, step, 400) if name == "mdr" else lambda v: in_lammps(block, v, step),
    }
    return own, engines.get(package)


def in_physx(restitution, speed):
    import sapien

    material = sapien.physx.PhysxMaterial(0.0, 0.0, restitution)
    return in_engines.in_sapien(material, *BALL, speed, PHASES, 1e-3, bounce_threshold=1e-6, enable_tgs=True)


@functools.cache
def lammps():
    return in_engines.lammps_loaded()


def in_lammps(block, speed, step):
    return in_engines.in_lammps(lammps(), block, *BALL, speed, PHASES, step)


def longest_step(tool, name):
    """The longest step [s] with which every rebound at the speed of the numbers is within 0.01 of the law's, and no contact is softened."""
    for count in (30, 40, 50, 70, 100, 140, 200, 300, 500):
        step = FIT.contact_time / count
        way = translated(tool, step)[name]
        at = int(np.argmin(abs(way.promised["speed"] - SPEED)))
        ends = (way.promised[end][at] for end in ("least_restitution", "most_restitution"))
        if way.softening == 1.0 and max(abs(end - FIT.restitution) for end in ends) <= 0.01:
            return step
    raise SystemExit(f"{tool} {name} needs more than 500 steps")


@functools.cache
def brinell_itself():
    """The largest difference of the FMU's restitution from the law with one step of 1 ms, and the time of such a step [s]."""
    scene = SCENE.read_text(encoding="utf-8")
    for old, new in ("[fmu]", f"[coupling]\neffective_mass = {MASS!r}\n\n[fmu]"), ('"indentation"', '"mean_force", "indentation"'):
        scene = scene.replace(old, new)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "drop_test.toml"
        path.write_text(scene, encoding="utf-8")
        with brinell.Contact(path) as contact:

            def restitution(speed):
                contact.reset()
                return 1e-3 * contact.step(1e-3, speed) / MASS / speed - 1.0

            error = max(abs(restitution(speed) - law(speed).restitution) for speed in SPEEDS)
            return error, min(seconds_of(contact) for _ in range(500))


def seconds_of(contact):
    """What a step takes that has the whole impact in it."""
    contact.reset()
    start = time.process_time()
    contact.step(1e-3, SPEED)
    return time.process_time() - start


def cells(values):
    return " | ".join(f"{value:.3f}" if value < 1.5 else f"{value:.3g}" for value in values)


def heads(*more):
    names = [*more[0], *(f"{speed:.3g} m/s" for speed in SHOWN), *more[1]]
    return f"| {' | '.join(names)} |\n{'|---' * len(names)}|\n"


def shown(case):
    return cells(max(case.rebounds[speed], 0.0) for speed in SHOWN)


def table_of_own_numbers(cases):
    text = heads(["tool", "its own numbers"], ["run in"])
    text += f"| **the law** | | {cells(law(speed).restitution for speed in SHOWN)} | |\n"
    for case in filter(lambda case: case.rebounds, cases):
        text += f"| {case.title} | {NUMBERS[case.title]} | {shown(case)} | {case.how} |\n"
    return text


def table_of_brinells_numbers(cases):
    error, _ = brinell_itself()
    text = heads(["tool, model"], ["largest difference", "force at 5 m/s", "longest step", "run in"])
    text += f"| **Brinell's FMU** | {cells(law(speed).restitution for speed in SHOWN)} | {error:.0e} | | any; 1 ms here | brinell |\n"
    for case in cases:
        promised = case.way.promised
        force = promised["largest_force"][-1] / law(5.0).largest_force - 1
        force = "not defined" if np.isnan(force) else f"{100 * force:+.0f} %"
        step = "its own"
        if case.way.step:
            step = f"{1e6 * longest_step(case.tool, case.way.name):.2g} us"
        elif case.way.name == "restitution":
            step = "any"
        text += f"| {case.title} | {shown(case)} | {case.error:+.2f} | {force} | {step} | {case.how} |\n"
    return text


def table_of_costs(cases):
    """The time of a step of one ball, where it was measured; not compared."""
    text = "| | a step | steps a contact | a contact |\n|---|---|---|---|\n"
    rows = [("Brinell's FMU, from Python", brinell_itself()[1], 1)]
    for case in cases:
        if case.seconds < np.inf and case.way.step:
            rows.append((case.title, case.seconds, round(FIT.contact_time / longest_step(case.tool, case.way.name))))
    for title, seconds, count in rows:
        step, contact = (f"{1e6 * value:.3g}" if value < 1e-3 else f"{1e6 * value:.0f}" for value in (seconds, count * seconds))
        text += f"| {title} | {step} us | {count} | {contact} us |\n"
    return text


def leeb():
    """Rebounds of the device D over the hardness: hardness, measured, by Brinell, and with one number that is typed."""
    lines = (ROOT / "data/experiment/leeb_restitution.csv").read_text().splitlines()[1:]
    measured, hardness = np.array([line.split(",") for line in lines], dtype=float).T
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "device.toml"
        found = []
        for vickers in hardness:
            path.write_text(DEVICE.format(vickers))
            found.append(brinell.predict(path).restitution)
    return hardness, measured, np.array(found)


def table_of_leeb():
    hardness, measured, found = leeb()
    at = int(np.argmin(abs(hardness - 484.1)))
    text = "| hardness | measured | Brinell | one typed restitution |\n|---|---|---|---|\n"
    for n in (0, 4, at, 12, len(hardness) - 1):
        text += f"| {hardness[n]:.0f} HV | {measured[n]:.3f} | {found[n]:.3f} | {measured[at]:.3f} |\n"
    wrong, flat = (max(abs(values / measured - 1)) for values in (found, np.full_like(measured, measured[at])))
    return text + f"| largest error | | {100 * wrong:.1f} % | {100 * flat:.1f} % |\n"


def block(name):
    begin, end = (f"<!-- table of {name}: {where} -->" for where in ("begin", "end"))
    return re.compile(f"({re.escape(begin)}\n)(.*?)({re.escape(end)})", re.DOTALL)


def differences(shown, measured):
    """Rows that differ by more than an engine's single precision, or a recursion from its engine. Where it ran is left out."""
    shown = {row.split("|")[1]: row for row in shown.splitlines()}
    rows = [(shown.get(row.split("|")[1], "none"), row) for row in measured.splitlines()]
    return [f"shown:    {old}\nmeasured: {new}" for old, new in rows if not alike(old, new)]


def alike(shown, measured):
    ran = r"\| (recursion|brinell|\w+ \d[\w.]*) \|$"
    shown, measured = (re.sub(ran, "|", row) for row in (shown, measured))
    number = r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?"
    same_words = re.sub(number, "#", shown) == re.sub(number, "#", measured)
    pairs = zip(re.findall(number, shown), re.findall(number, measured), strict=False)
    return same_words and all(abs(float(a) - float(b)) <= 0.003 + 0.02 * abs(float(a)) for a, b in pairs)


def picture(own, given):
    import matplotlib

    matplotlib.use("svg")
    from brinell.pictures import save
    from matplotlib import pyplot
    from style import STYLE

    matplotlib.rcParams.update(STYLE)
    figure, (first, second, third) = pyplot.subplots(3, figsize=(5.2, 9.8), layout="constrained")
    fine = np.geomspace(0.1, 5, 41)
    curve = [law(float(speed)).restitution for speed in fine]
    for axes, cases, styles in ((first, own, OWN_STYLES), (second, given, GIVEN_STYLES)):
        axes.plot(fine, curve, color="black", linewidth=2.5, label="Brinell")
        for case in cases:
            if case.title in styles:
                label, colour = styles[case.title]
                heights = [case.rebounds[speed] for speed in SPEEDS]
                axes.plot(SPEEDS, heights, color=colour, linewidth=1, label=label)
        axes.set(xscale="log", xlabel="speed [m/s]", ylabel="restitution", ylim=(-0.03, 1.08))
        axes.set_xticks([0.1, 0.3, 1, 3], ["0.1", "0.3", "1", "3"])
        axes.minorticks_off()
    first.set_title("with their own numbers", fontsize=10)
    first.annotate("newton: 24, off the picture", (0.12, 1.05), fontsize=7.5, va="top")
    second.set_title("with Brinell's numbers, right at 3.13 m/s", fontsize=10)
    hardness, measured, found = leeb()
    third.errorbar(hardness, measured, 0.012, fmt="o", color="#777777", markersize=3, linewidth=1, label="measured")
    third.plot(hardness, found, color="black", linewidth=2, label="Brinell")
    third.axhline(measured[8], color="#0072b2", linewidth=1, label="one restitution")
    third.set(xlabel="Vickers hardness of the steel", ylabel="restitution", ylim=(0.4, 1.0))
    third.set_title("measured: carbide on steel at 2.05 m/s", fontsize=10)
    for axes in (first, second, third):
        axes.legend(fontsize=7.5, loc="upper center", bbox_to_anchor=(0.5, -0.19), ncols=3, frameon=False)
    save(figure, FOLDER / "comparison.svg")


OWN_STYLES = {
    "MuJoCo": ("MuJoCo", "#0072b2"),
    "Drake": ("Drake", "#d55e00"),
    "PhysX": ("PhysX in SAPIEN", "#56b4e9"),
    "Chrono SMC": ("Chrono", "#009e73"),
    "Yade": ("Yade", "#cc79a7"),
    "Adams": ("Adams", "#999999"),
    "MotionView": ("MotionView", "#666666"),
    "LAMMPS `mdr`": ("LAMMPS mdr, of steel", "#e69f00"),
    "Bullet": ("Bullet, Jolt", "#8c6d31"),
}
GIVEN_STYLES = {
    "MuJoCo": ("MuJoCo, Bullet, newton ...", "#0072b2"),
    "Modelica ElastoGap": ("Modelica", "#cc79a7"),
    "Drake": ("Drake", "#d55e00"),
    "Adams, MotionSolve": ("Adams, MotionSolve", "#009e73"),
    "MercuryDPM, LIGGGHTS, Yade: Luding": ("Luding's law", "#56b4e9"),
    "LAMMPS: `mdr`": ("LAMMPS mdr", "#e69f00"),
}
DEVICE = """
name = "device"
impactor = {{ radius = "1.5 mm", youngs_modulus = "620 GPa", poissons_ratio = 0.22 }}
impact = {{ mass = "5.45 g", speed = 2.05 }}
target = {{ youngs_modulus = "210 GPa", poissons_ratio = 0.3, hardness = "{:.1f} HV10" }}
"""


def main():
    own, given = ([case.measure() for case in cases()] for cases in (own_numbers, brinells_numbers))
    tables = {
        "own numbers": table_of_own_numbers(own),
        "brinell's numbers": table_of_brinells_numbers(given),
        "rebounds over hardness": table_of_leeb(),
    }
    page = PAGE.read_text(encoding="utf-8")
    if "--check" in sys.argv[1:]:
        wrong = [line for name, table in tables.items() for line in differences(block(name).search(page)[2].strip(), table.strip())]
        sys.exit("\n".join(wrong) if wrong else 0)
    if missing := [case.title for case in own + given if not case.rebounds]:
        sys.exit(f"to write the page, install what runs {', '.join(missing)}")
    for name, table in (tables | {"costs": table_of_costs(given)}).items():
        page = block(name).sub(lambda found, table=table: f"{found[1]}\n{table}\n{found[3]}", page)
    PAGE.write_text(page, encoding="utf-8")
    picture(own, given)


if __name__ == "__main__":
    main()
