"""From the empty page to an FMU: the bytes of the command line's, which fmpy loads and runs."""

import json
import math
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import fmpy
import pytest
from fmpy.validation import validate_fmu
from scene_page import ScenePage, brinell, export, scene, wait_until

# One of each kind of library and of description.
SCENES = [
    "damped", "everything", "mass_known", "rough_contacts", "slope",
    "stack", "steel_ball", "two_contacts", "two_directions", "wired",
]  # fmt: skip


def downloaded(opened: ScenePage, button: str) -> tuple[str, bytes]:
    """The name and the bytes of the file that a button of the page gives."""
    with opened.page.expect_download() as download:
        opened.at(button).click()
    return download.value.suggested_filename, download.value.path().read_bytes()


def choose_linux(opened: ScenePage) -> None:
    opened.at("tab.download").click()
    for box in opened.page.locator('[data-test^="platform."]').all():
        box.set_checked(box.get_attribute("data-test") == "platform.linux64")


@pytest.mark.parametrize("name", SCENES)
def test_the_fmu_has_the_bytes_of_the_command_line_and_runs(opened: ScenePage, name: str, tmp_path: Path) -> None:
    text = scene(name)
    opened.write(text)
    choose_linux(opened)
    file, fmu = downloaded(opened, "download.fmu")
    assert fmu == export(tmp_path, text)
    path = tmp_path / file
    path.write_bytes(fmu)
    assert validate_fmu(path) == []
    result = fmpy.simulate_fmu(path, stop_time=1e-4, output_interval=1e-5)
    assert len(result) > 10
    assert all(math.isfinite(value) for row in result for value in row)


def test_from_hardness_and_drop_height_in_the_form_to_an_fmu(opened: ScenePage, tmp_path: Path) -> None:
    """As one who opens the page for the first time: by the form alone."""
    opened.write('name = "mine"\n[impactor]\nradius = "5 mm"\n[target]\nmaterial = "mild steel"\n[impact]\nspeed = 1\n')
    opened.at("impactor.radius").fill("4")
    opened.choose("impactor.body", "elastic: a material")
    opened.choose("target.strength", "hardness")
    opened.at("target.hardness").fill("180")
    opened.at("target.hardness.scale").select_option("HV10")
    opened.choose("impact.by", "a drop height")
    opened.at("impact.drop_height").fill("30 cm")
    expected = {
        "name": "mine",
        "impactor": {"radius": "4 mm", "material": "bearing steel 52100, hardened"},
        "target": {"material": "mild steel", "hardness": "180 HV10"},
        "impact": {"drop_height": "30 cm"},
    }
    wait_until(lambda: tomllib.loads(opened.text), expected)
    choose_linux(opened)
    file, fmu = downloaded(opened, "download.fmu")
    assert file == "mine.fmu"
    assert fmu == export(tmp_path, opened.text)


def test_scene_curve_picture_and_a_script_that_runs_the_fmu(opened: ScenePage, tmp_path: Path) -> None:
    text = scene("steel_ball")
    opened.write(text)
    choose_linux(opened)
    (tmp_path / "scene.toml").write_text(text)
    for kind in ("csv", "svg"):
        assert brinell(tmp_path, "curve", "scene.toml", "-o", f"curve.{kind}").returncode == 0
        assert downloaded(opened, f"download.{kind}")[1] == (tmp_path / f"curve.{kind}").read_bytes()
    for button in ("download.toml", "download.fmu", "download.python"):
        name, content = downloaded(opened, button)
        (tmp_path / name).write_bytes(content)
    assert (tmp_path / "steel_ball.toml").read_text() == text
    ran = subprocess.run([sys.executable, "steel_ball.py"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    force = re.search(r"largest force ([\d.]+) N", ran.stdout)
    assert force, ran.stdout
    predicted = json.loads(brinell(tmp_path, "predict", "scene.toml", "--json").stdout)
    assert float(force[1]) == pytest.approx(predicted["laws"][0]["largest_force"], rel=0.02)
