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
from scene_page import ROOT, ScenePage, brinell, export, scene, wait_until

# One of each kind of library and of description.
SCENES = [
    "damped", "everything", "mass_known", "rough_contacts", "slope",
    "stack", "steel_ball", "two_contacts", "two_directions", "wired",
    "roller", "two_rollers", "shapes/cam_pin", "shapes/raceway",
]  # fmt: skip


def downloaded(opened: ScenePage, button: str) -> tuple[str, bytes]:
    """The name and the bytes of the file that a button of the page gives."""
    with opened.page.expect_download() as download:
        opened.at(button).click()
    return download.value.suggested_filename, download.value.path().read_bytes()


def run_script(folder: Path, name: str) -> str:
    """What a script of the page prints, which no FMU warns about."""
    ran = subprocess.run([sys.executable, name], cwd=folder, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    assert "WARN" not in ran.stdout
    return ran.stdout


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


def test_from_hardness_and_drop_height_in_the_form_to_a_ball_that_bounces_to_rest(opened: ScenePage, tmp_path: Path) -> None:
    """As one who opens the page for the first time: by the form, until the ball lies still in fmpy."""
    opened.write('name = "mine"\n[impactor]\nradius = "5 mm"\n[target]\nmaterial = "mild steel"\n[impact]\nspeed = 1\n')
    opened.at("impactor.radius").fill("4")
    opened.choose("impactor.body", "elastic: a material")
    opened.choose("target.strength", "hardness")
    opened.at("target.hardness").fill("180")
    opened.choose("impact.by", "a drop height")
    opened.at("impact.drop_height").fill("30 cm")
    expected = {
        "name": "mine",
        "impactor": {"radius": "4 mm", "material": "bearing steel 52100, hardened"},
        "target": {"material": "mild steel", "hardness": "180 HBW 10/3000"},
        "impact": {"drop_height": "30 cm"},
    }
    wait_until(lambda: tomllib.loads(opened.text), expected)
    choose_linux(opened)
    opened.at("python.says").get_by_text("hits and leaves").wait_for()
    opened.at("download.rest").click()
    expected["target"] |= {"surface": "fresh"}
    expected |= {"law": {"elastic_restitution": 0.98}, "coupling": {"effective_mass": "2.099 g"}}
    wait_until(lambda: tomllib.loads(opened.text), expected)
    opened.at("python.says").get_by_text("until it lies still").wait_for()
    assert opened.at("download.rest").is_hidden()
    for file, content in (downloaded(opened, "download.fmu"), downloaded(opened, "download.python")):
        (tmp_path / file).write_bytes(content)
    assert (tmp_path / "mine.fmu").read_bytes() == export(tmp_path, opened.text)
    first, *_, last = run_script(tmp_path, "mine.py").splitlines()
    predicted = json.loads(brinell(tmp_path, "predict", "scene.toml", "--json").stdout)
    # the step ends within 1 ms of the rebound
    leaves = predicted["laws"][0]["rebound_speed"]
    assert float(first.removesuffix(" m/s").split()[-1]) == pytest.approx(leaves - 0.005, abs=0.006)
    weight = re.search(r"lies still, held by ([\d.]+) N", last)
    assert weight, last
    assert float(weight[1]) == pytest.approx(2.099e-3 * 9.80665, rel=1e-3)


@pytest.mark.parametrize(
    ("name", "coupling"),
    [("serial", ""), ("parallel", 'master = "parallel"'), ("wired", 'inputs = ["external_acceleration", "effective_mass"]')],
)
def test_the_script_lets_the_ball_fall_as_its_coupling_asks(
    opened: ScenePage, name: str, coupling: str, tmp_path: Path
) -> None:
    opened.write(
        f'name = "{name}"\n[impactor]\nradius = "5 mm"\n[target]\nmaterial = "mild steel"\nsurface = "fresh"\n[law]\n'
        f'elastic_restitution = 0.9\n[impact]\nspeed = 1\n[coupling]\neffective_mass = "4 g"\n{coupling}\n'
    )
    choose_linux(opened)
    wait_until(lambda: f'"{name}.fmu"' in (opened.at("python").text_content() or ""), True)
    for file, content in (downloaded(opened, "download.fmu"), downloaded(opened, "download.python")):
        (tmp_path / file).write_bytes(content)
    lines = run_script(tmp_path, f"{name}.py").splitlines()
    assert 3 < len(lines) < 10
    assert "lies still, held by 0.0392" in lines[-1]


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
    printed = run_script(tmp_path, "steel_ball.py")
    force = re.search(r"largest force ([\d.]+) N", printed)
    assert force, printed
    predicted = json.loads(brinell(tmp_path, "predict", "scene.toml", "--json").stdout)
    assert float(force[1]) == pytest.approx(predicted["laws"][0]["largest_force"], rel=0.02)


def test_a_curve_of_depth_and_force_dropped_on_it_is_the_loading_law(opened: ScenePage, tmp_path: Path) -> None:
    text, record = scene("shapes/record"), (ROOT / "scenes/shapes/record.csv").read_bytes()
    (tmp_path / "scene.toml").write_text(text)
    (tmp_path / "record.csv").write_bytes(record)
    ran = brinell(tmp_path, "predict", "scene.toml", "--json")
    assert ran.returncode == 0, ran.stderr

    # in the place of the file that the page can't read, and of another law
    other = text.replace('{ table = "record.csv" }', '"hertz"\nunloading = "thornton"')
    for before in (text, other):
        opened.write(before)
        if before == text:
            opened.at("mistake").get_by_text("the file isn't at hand; drop the file on this page").wait_for()
        opened.drop("record.csv", record)
        changed = opened.changes_from(before)
        law = tomllib.loads(changed)["law"]
        assert law.keys() == {"loading"}
        assert len(law["loading"]["table"]["depth"]) == len(law["loading"]["table"]["force"]) > 20
        [answer] = opened.ask({"method": "predict", "text": changed})
        assert answer["ok"]["laws"] == json.loads(ran.stdout)["laws"]
        assert opened.at("law.chosen").text_content() == "Law: a curve of your own"
    choose_linux(opened)
    assert downloaded(opened, "download.fmu")[1] == export(tmp_path, changed)
    # one without a radius of the contact takes the place of one with it
    rows = "".join(f"{depth};{depth**1.4:.6g};{0.1 * depth**0.5:.6g}\n" for depth in range(1, 20))
    opened.drop("wide.csv", f"depth [um];force [N];contact radius [mm]\n{rows}".encode())
    wide = opened.changes_from(changed)
    assert "contact_radius" in tomllib.loads(wide)["law"]["loading"]["table"]
    opened.drop("record.csv", record)
    assert "contact_radius" not in tomllib.loads(opened.changes_from(wide))["law"]["loading"]["table"]
    # a file that is neither changes nothing, and says what each would have
    opened.drop("neither.csv", b"time [s];force [N]\n0;1\n1;2\n")
    opened.at("toast").get_by_text("no loading curve: no column is called depth").wait_for()
