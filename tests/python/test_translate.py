"""Numbers for other tools: MuJoCo runs its block; the laws of the others are integrated anew, from the numbers as typed."""

import functools
import re

import brinell
import numpy as np
import pytest
from brinell import ProgramError
from drops import PHASES, SCENE, outcome_of, promised_at, stepped, touched, two_spheres
from in_engines import in_mujoco
from units import LONG, some

RADIUS, MASS = 5e-3, 4e-3
translated = functools.cache(brinell.translate)


@pytest.mark.parametrize("step", [None, "1e-4"])
def test_a_ball_in_mujoco_rebounds_as_promised(step):
    way = brinell.translate(SCENE, "mujoco", step=step)["pair"]
    for form in ("direct", "positive"):
        block = way.block
        if form == "positive":
            numbers = way.numbers
            direct = f"-{numbers['stiffness_per_mass']:.7g} -{numbers['damping_per_mass']:.7g}"
            positive = f"{numbers['time_constant']:.7g} {numbers['damping_ratio']:.7g}"
            at = block.index('solref="-')
            block = block[:at] + f'solref="{positive}"' + block[block.index('"', at + 8) + 1 :]
            assert direct.split()[0][:6] in way.block
        for speed in (0.1, 1.0, 3.0):
            drops = in_mujoco(block, RADIUS, MASS, speed, PHASES)
            assert drops.step == way.step
            rebounds = drops.rebounds
            promise = promised_at(way, speed)
            assert np.mean(rebounds) == pytest.approx(promise["restitution"], abs=1e-5)
            assert np.min(rebounds) == pytest.approx(promise["least_restitution"], abs=1e-5)
            assert np.max(rebounds) == pytest.approx(promise["most_restitution"], abs=1e-5)


# impacts that lose little, for a model that is for them
SLOW = {"hunt-crossley": "0.05:0.2"}
INTEGRATED = [
    ("modelica", "elastogap"),
    ("adams", "impact"),
    ("motionsolve", "impact"),
    ("simscape", "smooth-spring-damper"),
    ("exudyn", "sphere"),
    ("exudyn", "hunt-crossley"),
    ("exudyn", "plastic"),
    ("exudyn", "damping"),
    ("recurdyn", "contact"),
]


# the law of MotionSolve is that of Adams
@pytest.mark.parametrize(("tool", "name"), [one for one in INTEGRATED if LONG or one[0] != "motionsolve"])
def test_the_published_law_integrated_anew_gives_what_is_promised(tool, name):
    way = translated(SCENE, tool, speed=SLOW.get(name))[name]
    assert way.step is None
    for speed in some(way.promised["speed"], 3):
        outcome = outcome_of(tool, name, way.numbers, RADIUS, MASS, speed)
        promise = promised_at(way, speed)
        for quantity, value in outcome.items():
            # a corner of the force falls between two instants of an integration
            tolerance = 1e-4 if quantity == "largest_force" else 2e-5
            assert value == pytest.approx(promise[quantity], rel=tolerance), (speed, quantity)


STEPPED = [
    ("chrono", "hooke"),
    ("chrono", "hertz"),
    ("chrono", "flores"),
    ("newton", "semi-implicit"),
    ("newton", "mujoco-solver"),
    ("lammps", "hooke"),
    ("lammps", "hertz"),
    ("lammps", "mdr"),
    ("liggghts", "hertz"),
    ("liggghts", "hooke"),
    ("liggghts", "luding"),
    ("liggghts", "thornton-ning"),
    ("mercurydpm", "linear"),
    ("mercurydpm", "plastic"),
    ("yade", "mindlin"),
    ("yade", "luding"),
    ("physx", "compliant"),
    ("ode", "spring"),
    ("gazebo", "spring"),
    ("bullet", "stiffness"),
    ("drake", "point"),
    ("drake", "sap"),
]


@pytest.mark.parametrize(("tool", "name"), STEPPED)
def test_the_published_recursion_run_anew_gives_what_is_promised(tool, name):
    # a softened sphere of mdr would be too deep
    for step in (None,) if name == "mdr" else (None, "1e-4"):
        way = translated(SCENE, tool, step=step)[name]
        for speed in some((0.1, 1.0, 3.0) if step else (1.0, 3.0, 0.1), 3):
            outcomes = [stepped(tool, name, way.numbers, RADIUS, MASS, speed, way.step, phase) for phase in PHASES]
            promise = promised_at(way, speed)
            for quantity in ("restitution", "contact_time", "depth", "largest_force"):
                mean = np.mean([outcome[quantity] for outcome in outcomes])
                assert mean == pytest.approx(promise[quantity], rel=2e-5), (step, speed, quantity)


@pytest.mark.parametrize(("tool", "name"), some((one for one in STEPPED if one != ("lammps", "mdr")), 4))
def test_between_two_spheres_the_published_recursion_gives_what_is_promised(tool, name, tmp_path):
    balls = two_spheres(tmp_path)
    translation = brinell.translate(balls.scene, tool)
    way = translation[name]
    # a recursion between equal spheres has the radius of one, the others the effective one
    radius = balls.radius if tool == "yade" else balls.radius / 2
    outcomes = [stepped(tool, name, way.numbers, radius, balls.mass / 2, 1.0, way.step, phase) for phase in PHASES]
    promise = promised_at(way, 1.0)
    for quantity in ("restitution", "contact_time", "depth", "largest_force"):
        mean = np.mean([outcome[quantity] for outcome in outcomes])
        assert mean == pytest.approx(promise[quantity], rel=2e-5), quantity
    if tool == "yade":
        density = float(re.search(r"density=([\d.]+)\)", way.block)[1])
        assert density * 4 / 3 * np.pi * balls.radius**3 == pytest.approx(balls.mass, rel=1e-6)


@pytest.mark.parametrize(("tool", "name"), [("lammps", "hooke"), ("mercurydpm", "linear"), ("newton", "semi-implicit")])
def test_what_numbers_for_one_mass_do_with_another_is_said(tool, name):
    way = translated(SCENE, tool)[name]
    said = next(note for note in way.notes if "one effective mass" in note)
    for part, words in ((0.5, "half of it"), (2.0, "twice of it")):
        rebounds = [
            stepped(tool, name, way.numbers, RADIUS, part * MASS, 1.0, way.step, phase)["restitution"]
            for phase in PHASES
        ]
        law = brinell.predict(SCENE, mass=part * MASS).restitution
        told = re.search(rf"{words}.*?restitution is ([\d.]+), by the scene's law ([\d.]*\d)", said)
        assert [float(told[1]), float(told[2])] == pytest.approx([np.mean(rebounds), law], abs=6e-4)
    if tool == "lammps":
        # the line for pairs has numbers of its own, with which two such balls rebound alike
        line = next(line for line in way.block.splitlines() if line.startswith("pair_coeff"))
        numbers = dict(zip(("stiffness", "damping"), map(float, line.split()[4:6]), strict=True))
        rebounds = [
            stepped(tool, name, numbers, RADIUS / 2, MASS / 2, 1.0, way.step / 2**0.5, phase) for phase in PHASES
        ]
        promise = promised_at(way, 1.0)["restitution"]
        assert np.mean([one["restitution"] for one in rebounds]) == pytest.approx(promise, abs=1e-6)


def test_at_the_speed_of_the_fit_restitution_and_contact_time_are_the_scenes():
    for tool, name in some(INTEGRATED, 2) + some(STEPPED, 2):
        translation = translated(SCENE, tool, speed=SLOW.get(name))
        promise = promised_at(translation[name], translation.speed)
        at = list(translation.wanted["speed"]).index(translation.speed)
        assert promise["restitution"] == pytest.approx(translation.wanted["restitution"][at], abs=1e-3)
        # in steps, a contact lasts a whole number of them
        assert promise["contact_time"] == pytest.approx(translation.wanted["contact_time"][at], rel=1.2e-2)


def test_what_is_wanted_is_the_prediction_of_the_scene():
    translation = brinell.translate(SCENE, "jolt", speed="0.2:2")
    columns = translation.wanted
    assert columns["speed"][0] == 0.2 and columns["speed"][-1] == 2.0 and 1.0 in columns["speed"]
    for at, speed in enumerate(columns["speed"]):
        predicted = brinell.predict(SCENE, speed=float(speed))
        assert columns["restitution"][at] == predicted.restitution
        assert columns["largest_force"][at] == predicted.largest_force
        assert columns["depth"][at] == predicted.largest_indentation
        assert columns["contact_time"][at] == predicted.loading_time + predicted.unloading_time
    promised = translation["restitution"].promised
    assert np.isnan(promised["contact_time"]).all() and np.isnan(promised["depth"]).all()
    assert promised["restitution"] == pytest.approx(brinell.predict(SCENE).restitution)


def test_a_step_longer_than_the_contact_softens_it_and_says_so():
    way = brinell.translate(SCENE, "mujoco", step="1 ms")["pair"]
    promise = promised_at(way, 1.0)
    assert way.step == 1e-3 and promise["contact_time"] == pytest.approx(0.03, rel=0.05)
    assert way.softening == pytest.approx(0.03 / 28.597e-6, rel=1e-3)
    assert any("softened until it has 30" in note for note in way.notes)


@pytest.mark.parametrize("tool", ["mujoco", "newton", "chrono", "lammps", "mercurydpm"])
def test_no_phase_gains_energy_up_to_the_largest_step_and_some_does_beyond(tool):
    way = translated(SCENE, tool).ways[0]
    phases = (np.arange(50) + 0.5) / 50

    def most(step):
        runs = (stepped(tool, way.name, way.numbers, RADIUS, MASS, 3.0, step, phase) for phase in phases)
        return max(run["restitution"] for run in runs)

    assert most(0.98 * way.largest_step) <= 1.0
    assert max(most(factor * way.largest_step) for factor in (1.1, 1.2, 1.4)) > 1.0


def test_millimetres_are_the_same_contact():
    si, mm = (translated(SCENE, "adams", units=units)["impact"] for units in ("si", "mm-t-s"))
    exponent = si.numbers["exponent"]
    assert mm.units["stiffness"] == "N/mm^n" and mm.numbers["exponent"] == exponent
    assert mm.numbers["stiffness"] == pytest.approx(si.numbers["stiffness"] * 1e3**-exponent, rel=1e-6)
    assert mm.numbers["damping"] == pytest.approx(si.numbers["damping"] * 1e-3, rel=1e-6)
    assert mm.numbers["ramp"] == pytest.approx(si.numbers["ramp"] * 1e3, rel=1e-6)
    with pytest.raises(ProgramError, match="MuJoCo computes in SI units"):
        brinell.translate(SCENE, "mujoco", units="mm-t-s")


@pytest.mark.parametrize(
    ("units", "stiffness", "damping", "length"), [("si", "N/m", "N.s/m", "m"), ("mm-t-s", "N/mm", "N.s/mm", "mm")]
)
def test_a_scene_takes_the_four_numbers_as_they_stand_in_adams(units, stiffness, damping, length, tmp_path):
    way = translated(SCENE, "adams", units=units)["impact"]
    k, e, c, d = (way.numbers[name] for name in ("stiffness", "exponent", "damping", "ramp"))
    scene = tmp_path / "adams.toml"
    # no other radius or modulus matters
    scene.write_text(
        'name = "adams"\nimpactor = { radius = 0.02 }\n'
        "target = { youngs_modulus = 70e9, poissons_ratio = 0.2 }\n"
        f"impact = {{ mass = {MASS}, speed = 1.0 }}\n"
        f'[law]\nloading = "adams-impact"\n[law.loading_parameters]\nstiffness = "{k} {stiffness}^{e}"\n'
        f'exponent = {e}\nfull_damping = "{c} {damping}"\ndamping_depth = "{d} {length}"\n',
        encoding="utf-8",
    )
    for speed in way.promised["speed"]:
        promise = promised_at(way, speed)
        found = brinell.predict(scene, speed=float(speed))
        # the numbers are printed with seven digits
        assert found.restitution == pytest.approx(promise["restitution"], rel=1e-6)
        assert found.largest_force == pytest.approx(promise["largest_force"], rel=1e-5)
        assert found.contact_time == pytest.approx(promise["contact_time"], rel=1e-6)
        assert found.largest_indentation == pytest.approx(promise["depth"], rel=1e-6)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"tool": "mujocco"}, "did you mean `mujoco`"),
        ({"tool": "rubber"}, "`drake`, `bullet`"),
        ({"tool": "adams", "speed": "3:0.1"}, "FROM is above TO"),
        ({"tool": "adams", "speed": "0:1"}, "0 m/s is out of range: allowed is 0.000001 to 10000 m/s"),
        ({"tool": "adams", "speed": "1:1e9"}, "1e9 m/s is out of range"),
        ({"tool": "adams", "speed": "1:fast"}, "`fast`"),
        ({"tool": "ode", "step": 0.0}, "step = 0 s must be positive"),
        ({"tool": "ode", "step": -1e-3}, "step = -0.001 s must be positive"),
        ({"tool": "ode", "step": "1 kg"}, "kg"),
    ],
)
def test_what_makes_no_sense_is_refused(arguments, said):
    with pytest.raises(ProgramError) as refused:
        brinell.translate(SCENE, **arguments)
    assert said in " ".join(str(refused.value).split())


def test_speeds_at_which_the_law_is_not_valid_get_a_sentence():
    notes = brinell.translate(SCENE, "jolt", speed="1:100").notes
    assert any(note.startswith("At 100 m/s, the contact radius reaches") for note in notes)
    notes = brinell.translate(SCENE, "jolt").notes
    assert not any(note.startswith("At ") for note in notes)


def test_an_unknown_way_names_those_that_exist():
    with pytest.raises(KeyError, match="it has stiffness, restitution"):
        brinell.translate(SCENE, "bullet")["hertz"]


def test_a_scene_that_a_tool_cannot_express_gets_a_sentence():
    scenes = SCENE.parent
    rough = brinell.translate(scenes / "oblique.toml", "mujoco")
    assert any("friction" in note and "partial slip" in note for note in rough.notes)
    many = brinell.translate(scenes / "two_contacts.toml", "mujoco")
    assert any("2 contacts; the numbers are for the first" in note for note in many.notes)
    shared = brinell.translate(scenes / "stack.toml", "mujoco")
    assert any("share bodies" in note for note in shared.notes)
    dented = translated(SCENE, "mujoco")
    assert any("No tool remembers a dent" in note for note in dented.notes)


def test_smoothing_that_is_not_published_is_told_as_a_range():
    way = brinell.translate(SCENE, "simscape").ways[0]
    told = next(note for note in way.notes if "cubic" in note)
    k, c, width = (way.numbers[name] for name in ("stiffness", "damping", "width"))

    def force(x, w):
        y = min(max(x / width, 0.0), 1.0)
        return y * y * (3 - 2 * y) * (k * x + c * w)

    for pulls in (False, True):
        assert f"{touched(force, pulls, MASS, 1.0)['restitution']:.3g}" in told
