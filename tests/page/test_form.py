"""Form and text are two views of one scene: what one changes the other shows, and nothing else changes."""

import random
import tomllib
from typing import Any

import pytest
from scene_page import ScenePage, right_scenes, scene

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
