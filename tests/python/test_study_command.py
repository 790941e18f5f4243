"""The command line of studies: `python -m brinell study`."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from brinell.studies import store

SCENE = Path(os.environ["BRINELL_TEST_SCENES"]) / "mass_known.toml"


def command(*arguments):
    call = [sys.executable, "-m", "brinell", *map(str, arguments)]
    return subprocess.run(call, capture_output=True, encoding="utf-8", check=False)


def test_the_command_line(tmp_path):
    out = tmp_path / "x.parquet"
    done = command(
        "study",
        SCENE,
        "--vary",
        "target.yield_strength=200 MPa:900 MPa:4",
        "--vary",
        "speed=0.1:10:5log",
        "--set",
        "impactor.radius=4 mm",
        "--mass",
        "4 g",
        "-o",
        out,
        "-o",
        tmp_path / "x.svg",
        "--workers",
        "2",
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("20 runs, 0 failed") and "20/20" in done.stderr
    table = store.read(out)
    assert set(table["impactor.radius"]) == {4e-3} and len(table["speed"]) == 20
    assert table["target.yield_strength"].max() == 900e6 and set(table["mass"]) == {4e-3}
    done = command("study", SCENE, "--vary", "speed=1:2", "--sample", "sobol:8", "--quiet")
    assert done.returncode == 0 and done.stderr == "" and done.stdout.startswith("8 runs")


def test_the_command_names_failed_runs_with_their_parameters():
    strengths = ["target.yield_strength=3e8,-1,-2,4e8", "speed=1,2,3,4,5,6"]
    vary = [word for name in strengths for word in ("--vary", name)]
    done = command("study", SCENE, *vary, "--quiet", "--workers", "1")
    assert done.returncode == 0 and done.stdout.startswith("24 runs, 12 failed")
    lines = done.stderr.splitlines()
    assert lines[0].startswith("failed: target.yield_strength = -1, speed = 1: ")
    assert "allowed is" in lines[0] and len(lines) == 11 and "2 more" in lines[-1]


@pytest.mark.parametrize(
    ("arguments", "status", "words"),
    [
        (["study"], 2, "scene"),
        ([], 2, "command"),
        (["study", SCENE], 2, "--vary"),
        (["study", SCENE, "--vary", "speed"], 2, "NAME=VALUE"),
        (["study", SCENE, "--vary", "speed=x"], 1, "is not a range"),
        (["study", "nowhere.toml", "--vary", "speed=1:2"], 1, "nowhere.toml"),
        (
            ["study", SCENE, "--vary", "speed=1:2", "--set", "hardness=1"],
            1,
            "no parameter 'hardness'",
        ),
    ],
)
def test_mistakes_on_the_command_line(arguments, status, words):
    done = command(*arguments)
    assert done.returncode == status and words in done.stderr and "Traceback" not in done.stderr


def test_a_command_that_is_stopped_says_how_to_go_on(monkeypatch, capsys):
    from brinell import __main__ as line

    def stopped(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(line, "study", stopped)
    assert line.main(["study", str(SCENE), "--vary", "speed=1:2"]) == 130
    assert "the same call continues" in capsys.readouterr().err


def test_without_the_packages_of_a_study_the_command_says_what_to_install(monkeypatch, capsys):
    from brinell import __main__ as line

    def missing(*_, **__):
        raise ModuleNotFoundError("No module named 'pyarrow'", name="pyarrow")

    monkeypatch.setattr(line, "study", missing)
    assert line.main(["study", str(SCENE), "--vary", "speed=1:2"]) == 1
    assert "pip install 'brinell[study]'" in capsys.readouterr().err
