"""The first five minutes: what the page shows to somebody who has never heard of an FMU."""

import json
import os
import re
import tomllib
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Page
from scene_page import ROOT, ScenePage, brinell, scene, wait_until

EXAMPLES = sorted((ROOT / "scenes/trades").glob("*.toml"))
# a link opens a page of its own
LINKED = EXAMPLES if os.environ.get("BRINELL_LONG") == "1" else EXAMPLES[::5]
CHOSEN = "() => document.querySelector('[data-test=examples]').selectedOptions[0].textContent"


def example(name: str) -> str:
    """A scene of a trade."""
    return (ROOT / f"scenes/trades/{name}.toml").read_text()


def predicted(opened: ScenePage, text: str, **more: Any) -> Any:
    """What the page's exporter predicts."""
    [answer] = opened.ask({"method": "predict", "text": text, **more})
    return answer["ok"]


def shows(opened: ScenePage, text: str) -> Any:
    """Puts a scene in the page, and waits for its numbers; returns the prediction."""
    opened.at("tab.result").click()
    opened.write(text)
    answer = predicted(opened, text)
    wait_until(lambda: opened.at("words").text_content(), answer["text"])
    return answer


def test_it_opens_with_a_fresh_drop_test_in_words(page: Page) -> None:
    opened = ScenePage(page)
    assert tomllib.loads(opened.text)["target"]["surface"] == "fresh"
    assert opened.text == example("drop_test")
    words = (opened.at("headline").text_content() or "").replace("\u00a0", " ")
    assert words == "A dent 30.3 µm deep and 1.27 mm wide remains. It bounces back with 47.6 % of its speed."
    assert opened.at("drawing.svg").is_visible()


@pytest.mark.parametrize("path", LINKED, ids=lambda path: path.stem)
def test_a_link_with_its_name_opens_an_example(page: Page, path: Path) -> None:
    opened = ScenePage(page, f"#example={path.stem}")
    assert opened.text == path.read_text()


def test_a_link_with_an_unknown_name_says_which_examples_there_are(page: Page) -> None:
    opened = ScenePage(page, "#example=anvil")
    said = opened.at("toast").text_content() or ""
    assert said.startswith("There is no example anvil; there are drop_test, ")
    assert opened.text == example("drop_test")


# The outlines of both bodies in each panel, in pixels, and the pixels of a metre.
OUTLINES = """() => {
  const svg = document.querySelector('[data-test="drawing.svg"]');
  const points = (one) => one.getAttribute("points").split(" ").map((pair) => pair.split(",").map(Number)).slice(0, -2);
  return { scale: Number(svg.dataset.scale), texts: [...svg.querySelectorAll("text")].map((text) => text.textContent),
    panels: [...svg.querySelectorAll("g")].map((panel) => [...panel.querySelectorAll("polygon")].map(points)).filter((panel) => panel.length) };
}"""

SOCKET = """name = "a"
impactor = { radius = "8 mm" }
target = { radius = "-12 mm", material = "mild steel" }
impact = { mass = "20 g", speed = "2 m/s" }
"""


@pytest.mark.parametrize("name", ["drop_test", "hammer_blow", "newtons_cradle", "elastic", "socket"])
def test_the_drawing_is_to_scale(opened: ScenePage, name: str) -> None:
    known = {"elastic": scene("elastic"), "socket": SOCKET}
    answer = shows(opened, known.get(name) or example(name))
    law, shape = answer["laws"][0], answer["shape"]
    drawn = opened.page.evaluate(OUTLINES)
    scale = drawn["scale"]
    [[target, ball], [dented, lifted]] = drawn["panels"]
    middle = len(ball) // 2
    width = 2 * law["largest_contact_radius"]

    # they touch where the contact is, and nowhere else
    assert all(below[1] - above[1] > -0.02 for above, below in zip(ball, target, strict=True))
    touching = [above[0] for above, below in zip(ball, target, strict=True) if below[1] - above[1] < 0.02]
    step = ball[1][0] - ball[0][0]
    assert touching[-1] - touching[0] == pytest.approx(width * scale, abs=5 * step)

    # what is missing of both bodies after it is the dent
    def missing(outline: list[list[float]], radius: float, down: float) -> float:
        edge = (outline[-1][0] - outline[0][0]) / 2 / scale
        round_ = radius and abs(radius) - (radius**2 - edge**2) ** 0.5
        return down * (outline[middle][1] - outline[0][1]) - (1 if radius < 0 else -1) * round_ * scale

    radii = shape["radii"]
    depth = missing(dented, radii[1], 1) + missing(lifted, radii[0], -1)
    assert depth == pytest.approx(law["dent"] * scale, abs=0.05)
    # the zoom that is said, on a screen of 96 pixels in an inch
    zoom = re.search(r"deepest, ([\d.e+]+)×", " ".join(drawn["texts"]))
    assert zoom and float(zoom[1]) == pytest.approx(scale * 0.0254 / 96, rel=0.06)


def test_the_drawing_follows_the_numbers(opened: ScenePage) -> None:
    shows(opened, example("drop_test"))
    before = opened.page.evaluate(OUTLINES)
    opened.type("impact.drop_height", "5")
    wait_until(lambda: opened.page.evaluate(OUTLINES)["scale"] > 1.5 * before["scale"], True)
    assert "deep, " in opened.page.evaluate(OUTLINES)["texts"][2]


def test_a_drawing_too_flat_to_see_says_so(opened: ScenePage) -> None:
    shows(opened, example("drop_test").replace("50 cm", "1 um"))
    assert "flatter than a line" in (opened.at("drawing.caption").text_content() or "")
    assert opened.page.evaluate(OUTLINES)["texts"][2] == "after: no dent"


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_each_example_opens_with_what_to_look_at(opened: ScenePage, path: Path) -> None:
    text = path.read_text()
    title, *look = [line.removeprefix("# ") for line in text.partition("name =")[0].splitlines()]
    opened.write(scene("elastic"))
    assert opened.page.evaluate(CHOSEN).startswith("Examples by trade")
    opened.at("examples").select_option(label=title)
    opened.has_read(text)
    assert opened.at("mistake").is_hidden()
    assert opened.at("examples.look").text_content() == " ".join(look)
    assert opened.page.evaluate(CHOSEN) == title
    opened.at("undo").click()
    opened.has_read(scene("elastic"))


# The quantities of the cards, with the name that a band has.
BANDS = {
    "force": "largest_force",
    "dent": "dent",
    "restitution": "restitution",
    "time": "contact_time",
    "energy": "energy_lost",
}


def test_every_card_has_the_band_of_a_hardness(opened: ScenePage) -> None:
    answer = shows(opened, example("shot_peening"))
    assert answer["deviation"] == pytest.approx(0.08)
    for card, name in BANDS.items():
        low, high = answer["laws"][0]["spread"][name]
        numbers = re.findall(r"[\d.]+", opened.at(f"band.{card}").text_content() or "")
        assert float(numbers[1]) / float(numbers[0]) == pytest.approx(high / low, rel=0.01), card
    # a regime has a band where both ends differ
    speed = answer["laws"][0]["onsets"][1]["speed"]
    shows(opened, example("shot_peening").replace('"40 m/s"', f"{speed:.4g}"))
    assert opened.at("band.regime").text_content() == "elastoplastic (first region) to elastoplastic (second region)"


def test_somebody_may_give_the_uncertainty_of_the_strength(opened: ScenePage) -> None:
    shows(opened, scene("steel_ball"))
    deviation = opened.at("deviation")
    assert deviation.get_attribute("placeholder") == "none"
    assert opened.page.locator("[data-test^='band.']").count() == 0
    deviation.fill("12,5")
    opened.at("band.force").wait_for()
    low, high = predicted(opened, scene("steel_ball"), deviation=0.125)["laws"][0]["spread"]["restitution"]
    assert opened.at("band.restitution").text_content() == f"{low:.3g} to {high:.3g}"
    deviation.fill("41")
    opened.at("deviation.wrong").get_by_text("from 0 to 40 %").wait_for()
    deviation.fill("")
    opened.at("band.force").wait_for(state="detached")


READ = """(test) => {
  const plot = document.querySelector(`[data-test="${test}.plot"]`);
  plot.focus();
  for (let press = 0; press < 6; press++) plot.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", shiftKey: true, bubbles: true }));
  return document.querySelector(`[data-test="${test}.readout"]`).textContent;
}"""


@pytest.mark.parametrize("chart", ["chart.curve", "chart.history", "chart.sweep"])
def test_every_curve_has_the_band_of_a_hardness(opened: ScenePage, chart: str) -> None:
    shows(opened, example("hammer_blow"))
    wait_until(lambda: bool(re.search(r"\([\d.e-]+.* to [\d.e-]+.*\)", opened.page.evaluate(READ, chart))), True)
    shows(opened, scene("elastic"))
    wait_until(lambda: " to " in opened.page.evaluate(READ, chart), False)


def test_a_switch_shows_the_curves_of_other_laws(opened: ScenePage) -> None:
    shows(opened, example("end_stop"))
    others = opened.at("others")
    others.check()
    for law in ("big-alabo", "ma-liu", "jackson-green", "thornton"):
        wait_until(lambda law=law: law in (opened.at("chart.sweep.readout").text_content() or ""), True)
    others.uncheck()
    wait_until(lambda: "thornton" in (opened.at("chart.sweep.readout").text_content() or ""), False)


def test_a_line_says_what_an_fmu_is_and_leads_to_who_can_use_none(opened: ScenePage) -> None:
    shows(opened, example("drop_test"))
    assert (opened.at("fmu.what").text_content() or "").startswith("An FMU is this contact as one file, which Simulink")
    opened.at("fmu.tools").click()
    assert opened.at("panel.tools").is_visible()
    opened.at("tab.result").click()


@pytest.mark.chromium
@pytest.mark.parametrize("width", [390, 1440])
def test_numbers_for_a_tool_are_on_the_first_row_of_tabs(opened: ScenePage, width: int) -> None:
    opened.page.set_viewport_size({"width": width, "height": 844})
    boxes = [opened.at(f"tab.{name}").bounding_box() for name in ("result", "tools", "try", "download", "link")]
    opened.page.set_viewport_size({"width": 1440, "height": 900})
    assert all(box and box["x"] >= 0 and box["x"] + box["width"] <= width for box in boxes), boxes
    assert len({round(box["y"]) for box in boxes if box}) == 1, boxes


def test_regimes_are_said_in_words(opened: ScenePage) -> None:
    [about] = opened.ask({"method": "about"})
    means = {regime["name"]: regime["means"] for regime in about["ok"]["regimes"]}
    for speed in (0.001, 0.05, 0.5, 5.0):
        text = example("drop_test").replace('drop_height = "50 cm"', f"speed = {speed}")
        regime = shows(opened, text)["laws"][0]["regime_name"]
        assert opened.at("regime.means").text_content() == means[regime]
    assert "reached the surface" in means["elastoplastic (second region)"]
    folded = opened.at("fold.regimes").text_content() or ""
    assert all(means[name] in folded for name in list(means)[1:5])


def test_the_list_of_materials_has_all_of_their_numbers(opened: ScenePage) -> None:
    opened.write(example("drop_test"))
    [about] = opened.ask({"method": "about"})
    opened.at("target.material").focus()
    opened.at("target.material.list").wait_for()
    entries = opened.page.evaluate("""() => Object.fromEntries([...document.querySelectorAll('[data-test="target.material.list"] li')]
      .map((entry) => [entry.dataset.value, entry.textContent]))""")
    opened.page.keyboard.press("Escape")
    for material in about["ok"]["materials"]:
        entry = entries[material["name"]]
        tension = material.get("tension") or {}
        numbers = {
            "GPa": (material["youngs_modulus"], 1e9),
            "ν": (material["poissons_ratio"], 1),
            "MPa": (material["yield_strength"], 1e6),
            "K": (tension.get("coefficient"), 1e6),
            "n": (tension.get("exponent"), 1),
            "kg": (material["density"], 1),
        }
        for name, (value, unit) in numbers.items():
            assert value is None or f"{value / unit:.10g}" in entry, (name, entry)
        assert material["hardness"] is None or material["hardness"] in entry


def test_a_chosen_material_says_its_numbers_their_source_and_what_to_mind(opened: ScenePage) -> None:
    opened.write(example("hardness_test"))
    wait_until(lambda: "E 630 GPa" in (opened.at("impactor.material.numbers").text_content() or ""), True)
    assert "brittle" in (opened.at("impactor.material.warning").text_content() or "")
    assert (opened.at("impactor.material.source").text_content() or "").startswith("Source: ")


FOCUSED = """() => {
  const now = document.activeElement;
  return [now.dataset.test, parseFloat(getComputedStyle(now).outlineWidth), now.getAttribute("aria-selected")];
}"""


def test_tabs_are_used_by_the_keyboard(opened: ScenePage) -> None:
    opened.write(example("drop_test"))
    names = ["result", "tools", "try", "download", "link"]
    opened.at("tab.result").click()
    opened.page.keyboard.press("Tab")
    opened.page.keyboard.press("Shift+Tab")
    for key, name in [
        *zip(["ArrowRight"] * 5, [*names[1:], "result"], strict=True),
        ("ArrowLeft", "link"),
        ("Home", "result"),
        ("End", "link"),
    ]:
        opened.page.keyboard.press(key)
        focused, outline, selected = opened.page.evaluate(FOCUSED)
        assert (focused, selected) == (f"tab.{name}", "true")
        assert outline >= 2, "the focus can be seen"
        assert [one for one in names if opened.at(f"panel.{one}").is_visible()] == [name]
    opened.page.keyboard.press("Tab")
    assert opened.page.evaluate(FOCUSED)[0] == "panel.link"
    opened.at("tab.result").click()


def test_the_first_tab_has_a_link_that_shares_the_scene(opened: ScenePage, page: Page) -> None:
    text = shows(opened, example("valve_seat")) and opened.text
    opened.page.evaluate(
        "() => Object.defineProperty(navigator, 'clipboard', { value: { writeText: async (text) => (window.copied = text) } })"
    )
    opened.page.wait_for_function("() => document.querySelector('[data-test=link]').value !== ''")
    opened.at("share").click()
    opened.at("toast").get_by_text("Copied").wait_for()
    link = opened.page.evaluate("copied")
    assert ScenePage(page, "#" + link.partition("#")[2]).text == text


SLIDE = """(slider, value) => {
  slider.value = value;
  slider.dispatchEvent(new Event("input", { bubbles: true }));
  slider.dispatchEvent(new Event("change", { bubbles: true }));
}"""


def set_range(opened: ScenePage, name: str, ends: list[str]) -> None:
    """Types the ends of a slider's range, and leaves them."""
    for end, value in zip(("from", "to"), ends, strict=True):
        opened.at(f"slider.{name}.{end}").fill(value)
    opened.page.keyboard.press("Enter")


def test_the_range_of_a_slider_can_be_set(opened: ScenePage) -> None:
    shows(opened, example("drop_test"))
    set_range(opened, "radius", ["2", "8"])
    for place, value in (("1", 8.0), ("-1", 2.0), ("0", 4.0)):
        before = opened.text
        opened.at("slider.radius").evaluate(SLIDE, place)
        radius = tomllib.loads(opened.changes_from(before))["impactor"]["radius"]
        assert float(radius.removesuffix(" mm")) == pytest.approx(value)
    # a range is no limit of the scene
    opened.type("impactor.radius", "20")
    wait_until(lambda: tomllib.loads(opened.text)["impactor"]["radius"], "20 mm")
    assert opened.at("slider.radius.to").input_value() == "8"
    # without ends it is a decade to each side again
    set_range(opened, "radius", ["", ""])
    wait_until(lambda: opened.at("slider.radius.to").input_value(), "200")


@pytest.mark.parametrize("ends", [["8", "2"], ["0", "2"], ["x", "2"], ["2", ""]])
def test_what_is_no_range_of_a_slider_is_said(opened: ScenePage, ends: list[str]) -> None:
    text = shows(opened, example("drop_test")) and opened.text
    set_range(opened, "speed", ends)
    opened.at("slider.speed.wrong").get_by_text("A range is from a number above 0 to a larger one.").wait_for()
    assert opened.text == text
    set_range(opened, "speed", ["", ""])
    opened.at("slider.speed.wrong").get_by_text("A range").wait_for(state="detached")


# The cells of the rows of a table.
CELLS = """(test) => [...document.querySelectorAll(`[data-test="${test}"] tbody tr`)]
  .map((row) => [...row.children].map((cell) => cell.textContent.trim()))"""


@pytest.mark.parametrize("tool", ["mujoco", "lammps", "exudyn"])
def test_how_far_a_tool_is_off_is_a_table_and_a_picture(opened: ScenePage, tool: str, tmp_path: Path) -> None:
    text = example("drop_test")
    (tmp_path / "scene.toml").write_text(text)
    said = json.loads(brinell(tmp_path, "translate", "scene.toml", "--for", tool, "--json").stdout)
    shows(opened, text)
    opened.at("tab.tools").click()
    opened.at("tools.tool").select_option(value=tool)
    for way in said["ways"]:
        opened.at(f"tools.block.{way['name']}").get_by_text(way["block"].splitlines()[0]).wait_for()
        rows = opened.page.evaluate(CELLS, f"tools.errors.{way['name']}")
        assert len(rows) == len(said["speeds"])
        for row, law, of_tool in zip(rows, said["wanted"], way["promised"], strict=True):
            assert float(row[1]) == pytest.approx(law["restitution"], rel=1e-3)
            assert float(row[2].split()[0]) == pytest.approx(of_tool["restitution"], rel=1e-3)
            change = round(100 * (of_tool["restitution"] / law["restitution"] - 1))
            assert row[2].split(maxsplit=1)[1] == f"{'+' if change > 0 else '−' if change < 0 else '±'}{abs(change)} %"
        opened.at(f"tools.chart.{way['name']}").locator(".u-wrap").wait_for()
    assert all(float(a) < float(b) for a, b in pairwise(said["speeds"]))
    opened.at("tab.result").click()
