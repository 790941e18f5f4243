"""The command line of studies: `python -m brinell study`."""

import os
import subprocess
import sys
from pathlib import Path

import pandas
import pytest
from brinell import __main__ as line

SCENE = Path(os.environ["BRINELL_TEST_SCENES"]) / "mass_known.toml"


def test_the_command_line(tmp_path):
    table, picture = tmp_path / "x.parquet", tmp_path / "x.svg"
    call = ["study", SCENE, "--vary", "target.yield_strength=200 MPa:900 MPa:4", "--vary", "speed=0.1:10:5log"]
    call += ["--set", "impactor.radius=4 mm", "--mass", "4 g", "-o", table, "-o", picture, "--workers", "2"]
    call = [sys.executable, "-m", "brinell", *map(str, call)]
    done = subprocess.run(call, capture_output=True, encoding="utf-8", check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("20 runs, 0 failed") and "20/20" in done.stderr
    found = pandas.read_parquet(table)
    assert set(found["impactor.radius"]) == {4e-3} and len(found["speed"]) == 20
    assert found["target.yield_strength"].max() == 900e6 and set(found["mass"]) == {4e-3}


def test_the_command_names_failed_runs_with_their_parameters(capsys):
    strengths = ["target.yield_strength=3e8,-1,-2,4e8", "speed=1,2,3,4,5,6"]
    vary = [word for name in strengths for word in ("--vary", name)]
    assert line.main(["study", str(SCENE), *vary, "--quiet", "--workers", "1"]) == 0
    done = capsys.readouterr()
    assert done.out.startswith("24 runs, 12 failed")
    lines = done.err.splitlines()
    assert lines[0].startswith("failed: target.yield_strength = -1, speed = 1: ")
    assert "allowed is" in lines[0] and len(lines) == 11 and "2 more" in lines[-1]


def test_samples_and_spreads_are_taken_quietly(tmp_path, capsys):
    path = tmp_path / "x.csv"
    call = ["study", str(SCENE), "--vary", "speed=0.5:1", "--sample", "sobol:8", "--quiet"]
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
        (["study", "nowhere.toml", "--vary", "speed=1:2"], 1, "nowhere.toml"),
        (["study", SCENE, "--vary", "speed=1:2", "--set", "hardness=1"], 1, "no parameter 'hardness'"),
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
