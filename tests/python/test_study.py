"""Studies: plans, runs, failures and files."""

import multiprocessing
import os
import shutil
import subprocess
import sys
from pathlib import Path

import brinell
import numpy as np
import pandas
import pytest
from brinell import ContactError, ProgramError, ProgramWarning, Range, library
from brinell.studies import plan, scene, study

SCENES = Path(os.environ["BRINELL_TEST_SCENES"])
SCENE = SCENES / "mass_known.toml"


@pytest.fixture(scope="module")
def unit(tmp_path_factory):
    return scene.unit(SCENE, tmp_path_factory.mktemp("unit"), None)[0]


def quick(unit, vary, **arguments):
    arguments = {"mass": 4e-3, "progress": False, "workers": 1} | arguments
    if "speed" not in vary:
        arguments.setdefault("speed", 1.0)
    return brinell.study(unit, vary, **arguments)


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


@pytest.mark.parametrize(
    ("impact", "speed"),
    [("speed = 0.7", None), ('drop_height = "3 cm"', None), ("", 0.3), ("mass = 5e-3, speed = 0.7", None)],
)
def test_a_study_has_the_mass_and_the_speed_that_predictions_of_the_scene_have(impact, speed, tmp_path):
    file = tmp_path / "ball.toml"
    file.write_text(
        'name = "ball"\nimpactor = { radius = "5 mm", material = "mild steel" }\n'
        'target = { material = "mild steel", yield_strength = 200e6 }\n'
        + (f"impact = {{ {impact} }}\n" if impact else ""),
        encoding="utf-8",
    )
    expected = brinell.predict(file, speed=speed)
    vary = {"target.yield_strength": [200e6]}
    run = brinell.study(file, vary, speed=speed, progress=False, workers=1).iloc[0]
    assert (run["mass"], run["speed"]) == (expected.mass, expected.speed)
    assert run["restitution"] == pytest.approx(expected.restitution, rel=1e-9)
    heavier = brinell.study(file, vary, speed=speed, mass="1 kg", progress=False, workers=1).iloc[0]
    assert (heavier["mass"], heavier["speed"]) == (1.0, expected.speed)


def test_a_mass_that_is_unknown_is_asked_for(tmp_path):
    file = tmp_path / "ball.toml"
    text = 'name = "ball"\nimpactor = { radius = "5 mm" }\ntarget = { material = "mild steel" }\n'
    file.write_text(text, encoding="utf-8")
    with pytest.raises(ValueError, match=r"no density of \[impactor\]: pass mass= \(--mass\)"):
        brinell.study(file, {"speed": "1:2:3"}, progress=False)
    assert len(brinell.study(file, {"speed": "1:2:3"}, mass="4 g", progress=False)) == 3
    assert len(brinell.study(file, {"speed": "1:2:3", "mass": [1e-3]}, progress=False)) == 3


@pytest.mark.parametrize(
    "name", ["steel_ball", "coupled", "mass_known", "elastic", "two_contacts", "everything", "damped"]
)
def test_each_run_is_what_is_predicted(name):
    # rate-dependent laws are integrated
    rel = 1e-8 if name == "damped" else 1e-9
    vary = {"speed": "0.01:10:5log", "mass": [4e-3]}
    table = brinell.study(SCENES / f"{name}.toml", vary, workers=1, progress=False)
    assert list(table["error"]) == [""] * 5
    for index, speed in enumerate(table["speed"]):
        expected = brinell.predict(SCENES / f"{name}.toml", speed=speed, mass=4e-3)
        assert table["restitution"][index] == pytest.approx(expected.restitution, rel=rel)
        assert table["max_indentation"][index] == pytest.approx(expected.largest_indentation, rel=rel)
        assert table["dent"][index] == pytest.approx(expected.dent, rel=rel, abs=1e-18)
        assert table["energy_lost"][index] == pytest.approx(expected.energy_lost, rel=rel, abs=1e-15)


def test_the_impulse_makes_the_rebound(unit):
    table = quick(unit, {"mass": "1e-6:1e3:10log", "target.yield_strength": "1e8:1e9:3"})
    momentum = table["mass"] * (table["rebound_speed"] + 1.0)
    assert table["impulse"].to_numpy() == pytest.approx(momentum.to_numpy(), rel=1e-14)
    assert table["restitution"].to_numpy() == pytest.approx(table["rebound_speed"].to_numpy())


def test_an_impact_that_is_longer_than_a_step_is_run_to_its_end(unit):
    table = quick(unit, {"mass": [4e-3, 1e7]}, speed=1e-6, parameters={"target.youngs_modulus": 1e3})
    assert list(table["error"]) == ["", ""]
    assert (table["restitution"] > 0.0).all() and (table["restitution"] <= 1.0 + 1e-12).all()


def test_a_study_is_a_table_with_units(unit):
    table = quick(unit, {"target.yield_strength": [3e8, 4e8]})
    units = table.attrs["units"]
    assert list(units) == list(table) and table["restitution"].between(0.0, 1.0).all()
    assert [units[name] for name in ("target.yield_strength", "speed", "dent")] == ["Pa", "m/s", "m"]


def test_numbers_of_a_study_are_texts_with_a_unit(unit):
    vary = {"speed": "10 mm/s:1 m/s:3log", "target.yield_strength": ["300 MPa", 4e8]}
    texts = quick(unit, vary, mass="4 g", parameters={"impactor.radius": "4 mm"})
    vary = {"speed": "0.01:1:3log", "target.yield_strength": [3e8, 4e8]}
    assert texts.equals(quick(unit, vary, mass=4e-3, parameters={"impactor.radius": 4e-3}))
    with pytest.raises(ValueError, match="speed = '1 kg:2' is not a range .*kg is a mass"):
        quick(unit, {"speed": "1 kg:2"})
    with pytest.raises(ProgramError, match="impactor.radius = 4 kg: kg is a mass"):
        quick(unit, {"speed": "1:2:2"}, parameters={"impactor.radius": "4 kg"})


def test_failed_runs_have_a_reason_and_the_others_their_results(unit):
    table = quick(unit, {"target.yield_strength": [3e8, -1.0, 4e8], "speed": [1.0, 0.0]})
    good = (table["target.yield_strength"] > 0.0) & (table["speed"] > 0.0)
    assert np.array_equal(table["error"] == "", good)
    assert np.isfinite(table["restitution"][good]).all() and np.isnan(table["restitution"][~good]).all()
    assert "yield_strength" in table["error"][2] and "speed = 0.0 m/s" in table["error"][1]


def test_warnings_belong_to_their_run(unit):
    table = quick(unit, {"speed": [1.0, 40.0, 1.0, 40.0]})
    assert [bool(text) for text in table["warning"]] == [False, True, False, True]


@pytest.mark.skipif(multiprocessing.get_start_method() != "fork", reason="no process is forked")
def test_the_processes_of_a_study_do_not_unpack_the_unit_again(unit, tmp_path, monkeypatch):
    unpack, log = library.unpack, tmp_path / "log"

    def logged(*arguments, **more):
        with open(log, "a") as file:
            file.write(f"{os.getpid()}\n")
        return unpack(*arguments, **more)

    monkeypatch.setattr(library, "unpack", logged)
    # one that this process hasn't unpacked yet
    fresh = Path(shutil.copy(unit, tmp_path / "fresh.fmu"))
    quick(fresh, {"speed": "1:2:400"}, workers=2)
    assert log.read_text() == f"{os.getpid()}\n"


def test_a_short_study_has_one_process_and_a_long_one_all_cores(monkeypatch):
    monkeypatch.setattr(os, "cpu_count", lambda: 4)
    assert [study._workers(runs) for runs in (1, 1999, 2000, 3999, 10**6)] == [1, 1, 2, 3, 4]


def test_more_processes_change_nothing(unit):
    vary = {"speed": "0.1:10:30log", "target.yield_strength": "2e8:9e8:11"}
    assert quick(unit, vary, workers=2).equals(quick(unit, vary))


@pytest.mark.parametrize(
    ("arguments", "error", "words"),
    [
        ({"vary": {"hardness": "1:2"}}, KeyError, "speed, mass, impactor.radius"),
        ({"output": "x.txt"}, ValueError, ".parquet, .csv"),
        ({"output": "/nowhere/at/all/x.csv"}, FileNotFoundError, "no folder"),
    ],
)
def test_studies_that_are_refused(unit, arguments, error, words):
    with pytest.raises(error, match=words):
        quick(unit, **({"vary": {"speed": "1:2:4"}} | arguments))


def test_what_the_program_doubts_about_the_scene_is_a_warning_of_the_study(tmp_path):
    path = tmp_path / "wide.toml"
    path.write_text(SCENE.read_text().replace("radius = 5e-3", "radius = 5"))
    with pytest.warns(ProgramWarning, match="radius = 5 m; did you mean 5e-3") as told:
        brinell.study(path, {"speed": "1:2:2"}, progress=False, workers=1)
    assert len(told) == 1


def test_scenes_that_are_refused(tmp_path):
    with pytest.raises(FileNotFoundError):
        brinell.study(tmp_path / "nowhere.toml", {"speed": "1:2:2"}, progress=False)
    plain = brinell.export(SCENES / "coupled.toml", tmp_path / "plain.fmu")
    with pytest.raises(ContactError, match="knows the mass"):
        quick(plain, {"speed": "1:2:2"})
    (tmp_path / "bare.toml").write_text(
        'name = "x"\nimpactor = { radius = 5e-3 }\ntarget = { material = "mild steel" }'
    )
    with pytest.raises(ValueError, match="mass"):
        brinell.study(tmp_path / "bare.toml", {"speed": "1:2:2"}, progress=False)


# files


def test_tables_and_pictures_are_written(unit, tmp_path):
    files = [tmp_path / name for name in ("x.parquet", "x.csv", "x.svg", "x.png")]
    for vary in (
        {"speed": "0.1:1:4log", "mass": "1e-3:1e-2:3"},
        {"speed": "1:2:3"},
        {"speed": "1:2", "mass": "1:2", "target.yield_strength": "1e8:2e8"},
    ):
        sample = "grid" if len(vary) < 3 else "lhs:20"
        table = quick(unit, vary, output=files, sample=sample)
        assert all(file.stat().st_size > 100 for file in files)
        assert pandas.read_parquet(files[0]).equals(table)
        lines = files[1].read_text().splitlines()
        assert len(lines) == len(table["speed"]) + 1 and "restitution" in lines[0]
        assert sorted(path.name for path in tmp_path.iterdir()) == sorted(file.name for file in files)


@pytest.mark.parametrize("ending", [".csv", ".parquet", ".svg"])
def test_a_table_that_cannot_be_written_whole_leaves_the_one_before(ending, unit, tmp_path, monkeypatch):
    def half(path, *_, **__):
        Path(path).write_text("half")
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pandas.DataFrame.to_csv", lambda _, path, **__: half(path))
    monkeypatch.setattr("pandas.DataFrame.to_parquet", lambda _, path, **__: half(path))
    monkeypatch.setattr("brinell.studies.picture.draw", half)
    before = tmp_path / f"table{ending}"
    before.write_text("an older one")
    with pytest.raises(OSError, match="No space"):
        brinell.study(unit, {"speed": "1:2:2"}, mass=4e-3, output=before, progress=False)
    assert [(path.name, path.read_text()) for path in tmp_path.iterdir()] == [(before.name, "an older one")]


@pytest.mark.skipif(os.name == "nt", reason="needs SIGKILL")
def test_the_processes_of_a_killed_study_end_with_it(unit, tmp_path):
    program = f"""
import os, signal, brinell, tqdm
tqdm.tqdm.update = lambda *_: os.kill(os.getpid(), signal.SIGKILL)
brinell.study({str(unit)!r}, {{"speed": "0.1:10:400"}}, mass=4e-3, workers=2)
"""
    # the output ends when the last process that could write to it has ended
    killed = subprocess.run([sys.executable, "-c", program], cwd=tmp_path, capture_output=True, timeout=60, check=False)
    assert killed.returncode < 0, killed.stderr


def test_progress_is_counted_in_runs(unit, capsys):
    quick(unit, {"speed": "1:2:7"}, progress=True)
    assert "7/7" in capsys.readouterr().err


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
    path = tmp_path / "slope.toml"
    path.write_text(BODIES)
    table = brinell.study(path, {"speed": [0.5, 2.0]}, progress=False)
    for speed, found in zip(table["speed"], table["restitution"], strict=True):
        assert found == pytest.approx(brinell.predict(path, speed=speed).restitution, rel=1e-9)
    assert set(table["mass"]) == {4.1e-3}
    with pytest.raises(ContactError) as told:
        brinell.study(path, {"target.strength": [1.0]}, progress=False)
    assert str(told.value).startswith(f"{path} has no parameter 'target.strength'")


def test_what_is_wrong_with_a_scene_that_was_made_names_the_file_of_the_user(tmp_path):
    made = tmp_path / "made.toml"
    made.write_text(BODIES.replace("speed = 1", "speed = -1"))
    with pytest.raises(ProgramError) as told, scene.naming("mine.toml", made):
        brinell.export(made, tmp_path / "unit.fmu")
    assert str(told.value).startswith("mine.toml: impact.speed = -1"), told.value
