"""Studies: plans, runs, failures, files, and the command line."""

import subprocess
import sys
import warnings
from pathlib import Path

import brinell
import numpy as np
import pandas
import pytest
from brinell import ProgramError, ProgramWarning, Range
from brinell import __main__ as line
from brinell.studies import plan
from units import SCENES

SCENE = SCENES / "mass_known.toml"
BALL = """name = "ball"
impactor = { radius = "5 mm", material = "mild steel" }
target = { material = "mild steel", yield_strength = 200e6 }
"""
STEEL = """name = "ball"
impactor = { radius = 5e-3 }
impact = { mass = 4.11e-3, speed = 1.0 }
[target]
youngs_modulus = 206e9
poissons_ratio = 0.3
"""
JOHNSON_COOK = 'rate = { model = "johnson-cook", c = 0.03, reference_rate = 1.0 }\n'


def written(folder, text):
    path = folder / "scene.toml"
    path.write_text(text, encoding="utf-8")
    return path


# plans


def test_ranges():
    assert list(plan.read("1:3:3", "speed").values()) == [1.0, 2.0, 3.0]
    assert plan.read("1:100:3log", "speed").values() == pytest.approx([1.0, 10.0, 100.0], rel=1e-14)
    assert list(plan.read("2,1,5e-1", "speed")) == [2.0, 1.0, 0.5]
    assert plan.read("1:2", "speed") == Range(1.0, 2.0) and plan.read("1:2:log", "speed").logarithmic
    values = plan.read("0.1:0.7:50log", "speed").values()
    assert (values[0], values[-1]) == (0.1, 0.7)
    assert list(plan.read("3:1:2", "speed").values()) == [3.0, 1.0] and list(plan.read("3:4:1", "speed").values()) == [
        3.0
    ]


@pytest.mark.parametrize(
    "text", ["0.01:0.09:5", "0.01:0.1:5", "0.1:0.999:3", "0.1:2:6lin", "1:2:4log", "0.03:3:7", "0.05:0.5:log"]
)
def test_a_study_spaces_a_range_as_a_sweep_of_the_exporter_does(text):
    ours = plan.read(text, "speed")
    theirs = brinell.sweep(SCENE, {"speed": text})["speed"].to_numpy()
    assert Range(ours.first, ours.last, len(theirs), ours.logarithmic).values() == pytest.approx(theirs, rel=1e-14)
    if "l" not in text:
        assert Range(ours.first, ours.last).logarithmic == ours.logarithmic


@pytest.mark.parametrize(
    "text",
    [
        "",
        "a",
        "1:",
        "1:2:x",
        "1:2:3:4",
        "1,,2",
        "1:2:3linear",
        "1:2:-1",
        "0:1:3log",
        "-1:1:3log",
        "1:inf:3",
        "nan:1:3",
        "1:2:0",
    ],
)
def test_what_is_no_range(text):
    with pytest.raises(ValueError, match="range|values"):
        plan.read(text, "speed")


def test_a_grid_has_every_pair_once():
    columns = plan.runs({"a": "1:2:2", "b": [5.0, 6.0, 7.0]})
    assert list(columns["a"]) == [1.0] * 3 + [2.0] * 3 and list(columns["b"]) == [5.0, 6.0, 7.0] * 2


@pytest.mark.parametrize("kind", ["sobol", "lhs"])
def test_samples_fill_their_ranges_evenly_and_repeat_with_their_seed(kind):
    vary = {"a": Range(0.0, 8.0), "b": Range(1e-3, 1e5, logarithmic=True)}
    columns = plan.runs(vary, f"{kind}:64", seed=3)
    assert np.array_equal(columns["a"], plan.runs(vary, f"{kind}:64", seed=3)["a"])
    assert not np.array_equal(columns["a"], plan.runs(vary, f"{kind}:64", seed=4)["a"])
    # each eighth of either range contains its eighth of the samples
    assert set(np.histogram(columns["a"], bins=8, range=(0.0, 8.0))[0]) == {8}
    assert set(np.histogram(np.log10(columns["b"]), bins=8, range=(-3.0, 5.0))[0]) == {8}


@pytest.mark.parametrize(
    ("vary", "sample", "words"),
    [
        ({}, "grid", "nothing is varied"),
        ({"a": "1:2"}, "random:10", "sobol:COUNT"),
        ({"a": "1:2"}, "lhs:0", "lhs"),
        ({"a": [1.0]}, "lhs:4", "need a range"),
        ({"a": []}, "grid", "finite numbers"),
        ({"a": [float("nan")]}, "grid", "finite numbers"),
        ({"a": [[1.0]]}, "grid", "finite numbers"),
    ],
)
def test_plans_that_are_refused(vary, sample, words):
    with pytest.raises((ValueError, TypeError), match=words):
        plan.runs(vary, sample)


# runs


def is_predicted(table, path, rel=1e-13, **more):
    """Each run is what is predicted of the same impact."""
    assert list(table["error"]) == [""] * len(table)
    for _, run in table.iterrows():
        expected = brinell.predict(path, speed=run["speed"], mass=run["mass"], **more)
        for name in ("restitution", "dent", "energy_lost", "rebound_speed"):
            assert run[name] == pytest.approx(getattr(expected, name), rel=rel, abs=1e-18), name
        assert run["max_indentation"] == pytest.approx(expected.largest_indentation, rel=rel)
        momentum = run["mass"] * (run["speed"] + expected.rebound_speed)
        assert run["impulse"] == pytest.approx(momentum, rel=rel)


@pytest.mark.parametrize(
    "name", ["steel_ball", "coupled", "mass_known", "elastic", "two_contacts", "everything", "damped"]
)
def test_each_run_is_what_is_predicted(name):
    path = SCENES / f"{name}.toml"
    is_predicted(brinell.study(path, {"speed": "0.01:10:5log", "mass": [1e-3, 4e-3]}), path)


@pytest.mark.parametrize(
    "own",
    [
        "yield_strength = 300e6\n" + JOHNSON_COOK,
        'yield_strength = 300e6\nrate = { model = "cowper-symonds", d = 8000.0, q = 5.0 }\n',
        "power_law = { coefficient = 700e6, exponent = 0.2 }\n" + JOHNSON_COOK,
        'hardness = "200 HBW 10/3000"\n',
        "yield_strength = 300e6\n" + JOHNSON_COOK + "[coupling]\neffective_mass = 4.11e-3\n",
        "yield_strength = 300e6\nplate_thickness = 0.01\ndensity = 7850.0\n" + JOHNSON_COOK,
    ],
)
def test_each_run_has_the_strength_at_its_own_rate_and_strain(own, tmp_path):
    path = written(tmp_path, STEEL + own)
    vary = {"speed": "0.05:20:6log", "mass": [1e-3, 4e-3]}
    table = brinell.study(path, vary)
    is_predicted(table, path)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ProgramWarning)
        swept = brinell.sweep(path, vary)
    # the speeds of the two are the same to rounding
    assert swept["restitution"].to_numpy() == pytest.approx(table["restitution"].to_numpy(), rel=1e-13)


def test_a_parameter_says_what_the_scene_would_say(tmp_path):
    strengths, constants = (200e6, 900e6), (0.0, 0.05)
    path = written(tmp_path, STEEL + "yield_strength = 300e6\n" + JOHNSON_COOK)
    table = brinell.study(path, {"target.yield_strength": strengths, "target.rate.c": constants, "speed": [0.2, 5.0]})
    for (strength, constant), runs in table.groupby(["target.yield_strength", "target.rate.c"]):
        other = STEEL + f"yield_strength = {strength!r}\n" + JOHNSON_COOK.replace("0.03", repr(constant))
        is_predicted(runs, written(tmp_path, other))


@pytest.mark.parametrize(
    ("impact", "speed"),
    [("speed = 0.7", None), ('drop_height = "3 cm"', None), ("", 0.3), ("", None), ("mass = 5e-3, speed = 0.7", None)],
)
def test_a_study_has_the_mass_and_the_speed_that_predictions_of_the_scene_have(impact, speed, tmp_path):
    file = written(tmp_path, BALL + (f"impact = {{ {impact} }}\n" if impact else ""))
    expected = brinell.predict(file, speed=speed)
    run = brinell.study(file, {"target.yield_strength": [200e6]}, speed=speed).iloc[0]
    assert (run["mass"], run["speed"]) == (expected.mass, expected.speed)
    heavier = brinell.study(file, {"target.yield_strength": [200e6]}, speed=speed, mass="1 kg").iloc[0]
    assert (heavier["mass"], heavier["speed"]) == (1.0, expected.speed)
    energy = brinell.study(file, {"energy": [1e-3], "mass": [4e-3]}).iloc[0]
    assert energy["speed"] == pytest.approx(np.sqrt(0.5), rel=1e-14)


def test_an_fmu_is_studied_by_the_scene_in_it(tmp_path):
    unit = brinell.export(SCENE, tmp_path / "unit.fmu")
    assert brinell.study(unit, {"speed": "1:2:3"}).equals(brinell.study(SCENE, {"speed": "1:2:3"}))


def test_a_study_is_a_table_with_units():
    table = brinell.study(SCENE, {"target.yield_strength": [3e8, 4e8]})
    units = table.attrs["units"]
    assert list(units) == list(table) and table["restitution"].between(0.0, 1.0).all()
    assert [units[name] for name in ("target.yield_strength", "speed", "dent")] == ["Pa", "m/s", "m"]


def test_numbers_of_a_study_are_texts_with_a_unit():
    vary = {"speed": "10 mm/s:1 m/s:3log", "target.yield_strength": ["300 MPa", 4e8]}
    texts = brinell.study(SCENE, vary, mass="4 g", parameters={"impactor.radius": "4 mm"})
    vary = {"speed": "0.01:1:3log", "target.yield_strength": [3e8, 4e8]}
    assert texts.equals(brinell.study(SCENE, vary, mass=4e-3, parameters={"impactor.radius": 4e-3}))
    with pytest.raises(ValueError, match="speed = '1 kg:2' is not a range .*kg is a mass"):
        brinell.study(SCENE, {"speed": "1 kg:2"})
    with pytest.raises(ProgramError, match="impactor.radius = 4 kg: kg is a mass"):
        brinell.study(SCENE, {"speed": "1:2:2"}, parameters={"impactor.radius": "4 kg"})


def test_failed_runs_have_a_reason_and_the_others_their_results():
    table = brinell.study(SCENE, {"target.yield_strength": [3e8, -1.0, 4e8], "speed": [1.0, 0.0]})
    good = (table["target.yield_strength"] > 0.0) & (table["speed"] > 0.0)
    assert np.array_equal(table["error"] == "", good)
    assert np.isfinite(table["restitution"][good]).all() and np.isnan(table["restitution"][~good]).all()
    assert "yield_strength" in table["error"][2] and "speed = 0 must be positive" in table["error"][1]
    none = brinell.study(SCENE, {"speed": [-1.0, 0.0]})
    assert none["restitution"].isna().all() and (none["error"] != "").all()


def test_warnings_belong_to_their_run():
    table = brinell.study(SCENE, {"speed": [1.0, 40.0, 1.0, 40.0]})
    assert [bool(text) for text in table["warning"]] == [False, True, False, True]


@pytest.mark.parametrize(
    ("arguments", "error", "words"),
    [
        ({"vary": {"hardness": [1.0]}}, ProgramError, "^no quantity is called `hardness`"),
        ({"vary": {"speed": [1.0], "energy": [1.0]}}, ProgramError, "determine each other"),
        ({"output": "x.txt"}, ValueError, ".parquet, .csv"),
        ({"output": "/nowhere/at/all/x.csv"}, FileNotFoundError, "no folder"),
    ],
)
def test_studies_that_are_refused(arguments, error, words):
    with pytest.raises(error, match=words):
        brinell.study(**({"scene_file": SCENE, "vary": {"speed": "1:2:4"}} | arguments))


# files


def test_tables_and_pictures_are_written(tmp_path):
    for vary, picture in (
        ({"speed": "0.1:1:4log", "mass": "1e-3:1e-2:3"}, "x.svg"),
        ({"speed": "1:2:3"}, "x.png"),
        ({"speed": "1:2", "mass": "1:2", "target.yield_strength": "1e8:2e8"}, "x.svg"),
    ):
        sample = "grid" if len(vary) < 3 else "lhs:20"
        files = [tmp_path / name for name in ("x.parquet", "x.csv", picture)]
        table = brinell.study(SCENE, vary, output=files, sample=sample)
        assert all(file.stat().st_size > 100 for file in files)
        assert pandas.read_parquet(files[0]).equals(table)
        lines = files[1].read_text().splitlines()
        assert len(lines) == len(table["speed"]) + 1 and "restitution" in lines[0]
        assert {path.name for path in tmp_path.iterdir()} == {file.name for file in files}
        files[2].unlink()


@pytest.mark.parametrize("ending", [".csv", ".parquet", ".png"])
def test_a_table_that_cannot_be_written_whole_leaves_the_one_before(ending, tmp_path, monkeypatch):
    def half(path, *_, **__):
        Path(path).write_text("half")
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pandas.DataFrame.to_csv", lambda _, path, **__: half(path))
    monkeypatch.setattr("pandas.DataFrame.to_parquet", lambda _, path, **__: half(path))
    monkeypatch.setattr("matplotlib.figure.Figure.savefig", lambda _, path, **__: half(path))
    before = tmp_path / f"table{ending}"
    before.write_text("an older one")
    with pytest.raises(OSError, match="No space"):
        brinell.study(SCENE, {"speed": "1:2:2"}, output=before)
    assert [(path.name, path.read_text()) for path in tmp_path.iterdir()] == [(before.name, "an older one")]


BODIES = """\
name = "thrown"
impactor = { radius = "5 mm", material = "mild steel" }
target = { material = "mild steel" }
friction = { coefficient = 0.3 }
[[body]]
name = "ball"
mass = "4.1 g"
inertia = 4.1e-8
[[contact]]
name = "floor"
between = ["ball", "ground"]
normal = [0, 0, -1]
tangent = [1, 0, 0]
arms = [[0, 0, -5e-3], []]
[impact]
speed = 1
"""


def test_a_study_of_a_scene_with_bodies_has_the_mass_of_its_contact(tmp_path):
    path = written(tmp_path, BODIES)
    table = brinell.study(path, {"speed": [0.5, 2.0]})
    is_predicted(table, path)
    assert set(table["mass"]) == {4.1e-3}


# the command


def test_the_command_line(tmp_path):
    table = tmp_path / "x.parquet"
    call = ["study", SCENE, "--vary", "target.yield_strength=200 MPa:900 MPa:4", "--vary", "speed=0.1:10:5log"]
    call += ["--set", "impactor.radius=4 mm", "--mass", "4 g", "-o", table]
    call = [sys.executable, "-m", "brinell", *map(str, call)]
    done = subprocess.run(call, capture_output=True, encoding="utf-8", check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("20 runs, 0 failed")
    found = pandas.read_parquet(table)
    assert set(found["impactor.radius"]) == {4e-3} and len(found["speed"]) == 20
    assert found["target.yield_strength"].max() == 900e6 and set(found["mass"]) == {4e-3}


def test_the_command_names_failed_runs_with_their_parameters(capsys):
    strengths = ["target.yield_strength=3e8,-1,-2,4e8", "speed=1,2,3,4,5,6"]
    vary = [word for name in strengths for word in ("--vary", name)]
    assert line.main(["study", str(SCENE), *vary]) == 0
    done = capsys.readouterr()
    assert done.out.startswith("24 runs, 12 failed")
    lines = done.err.splitlines()
    assert lines[0].startswith("failed: target.yield_strength = -1, speed = 1: ")
    assert "allowed is" in lines[0] and len(lines) == 11 and "2 more" in lines[-1]


def test_samples_and_spreads_are_taken(tmp_path, capsys):
    path = tmp_path / "x.csv"
    call = ["study", str(SCENE), "--vary", "speed=0.5:1", "--sample", "sobol:8"]
    call += ["--uncertain", "target.yield_strength=8 %", "-o", str(path)]
    assert line.main(call) == 0
    done = capsys.readouterr()
    assert done.err == "" and done.out.startswith("8 runs")
    assert "restitution_low" in path.read_text().splitlines()[0]


@pytest.mark.parametrize(
    ("arguments", "status", "words"),
    [
        (["study"], 2, "scene"),
        ([], 2, "command"),
        (["study", SCENE], 2, "--vary"),
        (["study", SCENE, "--vary", "speed"], 2, "NAME=VALUE"),
        (["study", SCENE, "--vary", "speed=x"], 1, "is not a range"),
        (["study", SCENE, "--vary", "speed=1:2", "--set", "hardness=1"], 1, "no quantity is called `hardness`"),
    ],
)
def test_mistakes_on_the_command_line(arguments, status, words, capsys):
    try:
        assert line.main([*map(str, arguments)]) == status
    except SystemExit as ended:
        assert ended.code == status
    assert words in capsys.readouterr().err


@pytest.mark.parametrize(
    ("error", "status", "words"),
    [
        (KeyboardInterrupt(), 130, ""),
        (ModuleNotFoundError("No module named 'pyarrow'", name="pyarrow"), 1, "pip install 'brinell[study]'"),
    ],
)
def test_a_command_that_can_not_go_on_says_how_to(error, status, words, monkeypatch, capsys):
    def stopped(*_, **__):
        raise error

    monkeypatch.setattr(line, "study", stopped)
    assert line.main(["study", str(SCENE), "--vary", "speed=1:2"]) == status
    assert words in capsys.readouterr().err
