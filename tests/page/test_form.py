"""Form and text are two views of one scene: what one changes the other shows, and nothing else changes."""

import random
import tomllib
from typing import Any

import pytest
from scene_page import ScenePage, right_scenes, scene, wait_until

SCENES = 16
# Changes closer to each other are undone together [ms].
GROUP = 600
# The units in which the form shows what a scene says without one.
UNITS = {
    "": 1, "m": 1, "mm": 1e-3, "um": 1e-6, "nm": 1e-9, "m/s": 1, "mm/s": 1e-3, "kg": 1, "g": 1e-3, "mg": 1e-6,
    "Pa": 1, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "s": 1, "us": 1e-6, "kg/m^3": 1, "1/s": 1, "/s": 1,
}  # fmt: skip


def noted(text: str) -> str:
    """A scene with a comment in each line."""
    return "".join(f"{line}  # note {number}\n" for number, line in enumerate(text.splitlines()))


def entries(table: Any, path: str = "") -> dict[str, Any]:
    """The values of a scene by their paths, without tables and lists."""
    if isinstance(table, list):
        table = {str(index): value for index, value in enumerate(table)}
    if not isinstance(table, dict):
        return {path: table}
    found: dict[str, Any] = {}
    for name, part in table.items():
        found |= entries(part, f"{path}.{name}" if path else name)
    return found


def si(form: dict[str, str | bool], path: str) -> float:
    """The number that a field shows, without its unit."""
    return float(form[path]) * UNITS[str(form.get(f"{path}.unit", ""))]


def check_form(form: dict[str, str | bool], text: str) -> list[str]:
    """Compares all fields with the scene; returns the paths of the numbers."""
    numbers = []
    for path, value in entries(tomllib.loads(text)).items():
        if path not in form:
            continue
        if isinstance(value, bool):
            assert form[path] == str(value).lower(), path
        elif isinstance(value, int | float):
            assert si(form, path) == pytest.approx(value, rel=1e-9), path
            numbers.append(path)
        else:
            assert form[path] == value, path
    return numbers


def test_random_scenes_go_through_the_form_unchanged_but_for_what_is_typed(opened: ScenePage) -> None:
    chooser = random.Random(48)
    fields = 0
    for text in map(noted, right_scenes(SCENES)):
        opened.write(text)
        before = opened.form()
        numbers = check_form(before, text)
        fields += len(numbers)
        path = chooser.choice([number for number in numbers if number in before and f"{number}.unit" in before])
        opened.type(path, f"{float(before[path]) * 1.1:.6g}")
        changed = opened.changes_from(text)

        old, new = entries(tomllib.loads(text)), entries(tomllib.loads(changed))
        assert {key for key in old | new if old.get(key) != new.get(key)} == {path}
        assert new[path] == pytest.approx(1.1 * old[path], rel=1e-5)
        lines = list(zip(text.splitlines(), changed.splitlines(), strict=True))
        different = [(one, other) for one, other in lines if one != other]
        assert len(different) == 1, "only the line of the key changes"
        assert different[0][0].partition("#")[2] == different[0][1].partition("#")[2], "it keeps its comment"
        check_form(opened.form(), changed)

        if fields % 3 == 0:
            opened.write(text)
            assert opened.form() == before, "the form is of the text alone"
    assert fields > 5 * SCENES


def test_a_key_is_made_and_removed_and_the_text_is_as_before(opened: ScenePage) -> None:
    text = noted(scene("steel_ball"))
    opened.write(text)
    opened.type("target.density", "7.7 g/cm3")
    made = opened.changes_from(text)
    assert tomllib.loads(made)["target"]["density"] == "7.7 g/cm3"
    opened.type("target.density", "")
    opened.changes_from(made)
    assert opened.text == text


def units_of(opened: ScenePage) -> list[str]:
    """The fields with a unit."""
    paths = opened.page.evaluate(
        "() => [...document.querySelectorAll('[data-test$=\".unit\"]')].map((one) => one.dataset.test)"
    )
    return [path.removesuffix(".unit") for path in paths]


SCALED = """name = "a"
[impactor]
radius = "5 mm"
material = "bearing steel 52100, hardened"
length = "1 m"
area = "2 cm^2"
[target]
material = "mild steel"
hardness = "180 HBW 10/3000"
[fmu]
step_size = "2 us"
[impact]
mass = "4 g"
speed = "1 m/s"
"""


def test_a_comma_is_a_decimal_sign_and_what_is_no_unit_never_becomes_one(opened: ScenePage) -> None:
    fields = ["impactor.radius", "impactor.length", "impactor.area", "fmu.step_size", "impact.mass", "impact.speed"]
    assert set(fields) <= set(units_of(opened))
    opened.write(SCALED)
    for path in fields:
        unit, menu = opened.form()[f"{path}.unit"], opened.at(f"{path}.unit").text_content()
        for typed, written in (
            ("x", None),
            ("6,5 furlong", None),
            ("6,5", "6.5"),
            ("0,125", "0.125"),
            ("7,25e1", "7.25e1"),
        ):
            before = opened.text
            opened.type(path, typed)
            text = opened.changes_from(before)
            value = tomllib.loads(text)[path.partition(".")[0]][path.partition(".")[2]]
            assert value == (f"{written} {unit}" if written else typed), typed
            assert opened.at("mistake").is_hidden() == (written is not None), (
                typed,
                opened.at("mistake").text_content(),
            )
            assert opened.form()[f"{path}.unit"] == unit, typed
        assert opened.at(f"{path}.unit").text_content() == menu, "the menu has units alone"
        opened.write(SCALED)
    # three digits may be thousands: the message has both, and what it asks for is taken
    opened.type("impactor.radius", "1,234")
    opened.at("impactor.radius.wrong").get_by_text("write 1.234 if this is a decimal comma, or 1234").wait_for()
    opened.type("impactor.radius", "1.234")
    wait_until(lambda: tomllib.loads(opened.text)["impactor"]["radius"], "1.234 mm")
    # a hardness has a scale
    for typed, written in (("182,5", "182.5 HBW 10/3000"), ("58,5 HRC", "58.5 HRC"), ("60,5", "60.5 HRC")):
        opened.type("target.hardness", typed)
        wait_until(lambda: tomllib.loads(opened.text)["target"]["hardness"], written)
        wait_until(lambda: opened.form()["target.hardness.scale"], written.partition(" ")[2])


def test_what_is_typed_key_by_key_stays_until_the_field_is_left(opened: ScenePage) -> None:
    opened.write(SCALED)
    opened.at("impactor.radius").fill("")
    opened.at("impactor.radius").press_sequentially("6,50")
    wait_until(lambda: tomllib.loads(opened.text)["impactor"].get("radius"), "6.50 mm")
    assert opened.at("impactor.radius").input_value() == "6,50"
    opened.page.keyboard.press("Tab")
    wait_until(lambda: opened.at("impactor.radius").input_value(), "6.50")


def test_ranges_are_in_the_unit_of_the_field(opened: ScenePage) -> None:
    opened.write(SCALED)
    for unit, range_ in (("mm", "1e-9 to 1e12 mm"), ("um", "1e-6 to 1e15 µm"), ("in", "3.937e-11 to 3.937e10 in")):
        before = opened.text
        opened.at("impactor.radius.unit").select_option(unit)
        if unit != "mm":
            opened.changes_from(before)
        opened.at("impactor.radius").focus()
        wait_until(lambda: f"Range: from {range_}." in (opened.at("help").text_content() or ""), True)
    opened.type("impactor.radius", "-3 mm")
    opened.at("impactor.radius.wrong").get_by_text(
        "impactor.radius = -3 mm is out of range: allowed is 1e-9 to"
    ).wait_for()


def test_the_keyboard_goes_from_a_material_to_the_next_field(opened: ScenePage) -> None:
    opened.write(scene("steel_ball").replace("[impactor]", '[impactor]\nmaterial = "mild steel"'))
    for leave in ("Tab", "Enter"):
        opened.at("impactor.material").focus()
        opened.at("impactor.material.list").wait_for()
        opened.page.keyboard.press(leave)
        if leave == "Enter":
            assert opened.page.evaluate("document.activeElement.dataset.test") == "impactor.material"
            opened.page.keyboard.press("Tab")
        assert opened.page.evaluate("document.activeElement.dataset.test") == "impactor.strength"


DRAG = """(slider, value) => {
  slider.value = value;
  slider.dispatchEvent(new Event("input", { bubbles: true }));
}"""


def test_a_drag_of_a_slider_is_one_step_of_undo(opened: ScenePage) -> None:
    text = scene("steel_ball")
    opened.write(text)
    for name in ("speed", "radius", "strength"):
        slider = opened.at(f"slider.{name}")
        opened.page.wait_for_timeout(GROUP)
        for place in ("0.2", "0.55", "-0.3"):
            before = opened.text
            slider.evaluate(DRAG, place)
            opened.changes_from(before)
            opened.page.wait_for_timeout(GROUP if place == "0.2" else 0)
        slider.evaluate("(slider) => slider.dispatchEvent(new Event('change', { bubbles: true }))")
        opened.at("undo").click()
        opened.has_read(text)


def test_choices_replace_the_keys_of_others(opened: ScenePage) -> None:
    opened.write(
        'name = "a"\n[impactor]\nradius = "5 mm"\n[target]\nmaterial = "mild steel"\n[impact]\nmass = "4 g"\nspeed = 2.0\n'
    )
    kinds = {
        "hardness": {"hardness"},
        "tensile strength": {"tensile_strength"},
        "tensile test": {"tensile_test"},
        "yield strength": {"yield_strength"},
        "as the material": set(),
    }
    for label, keys in kinds.items():
        target = tomllib.loads(opened.choose("target.strength", label))["target"]
        assert set(target) == keys | {"material"}
        assert opened.at("mistake").is_hidden(), opened.at("mistake").text_content()


def test_undo_and_redo_go_through_form_and_text_alike(opened: ScenePage) -> None:
    first, second = scene("steel_ball"), scene("elastic")
    opened.write(first)
    opened.write(second)
    opened.page.wait_for_timeout(GROUP)
    opened.type("impactor.radius", "7 mm")
    third = opened.changes_from(second)
    for text, button in ((second, "undo"), (first, "undo"), (second, "redo"), (third, "redo")):
        opened.at(button).click()
        opened.has_read(text)
