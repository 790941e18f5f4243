"""Every mistake that the command line finds in a scene is found by the page, with the same message at the same place."""

import json
import re
from pathlib import Path

import pytest
from scene_page import GIVEN, ScenePage, scene, words

REFUSED = [json.loads(path.read_text()) for path in sorted(Path(GIVEN["refused"]).glob("*.json"))]
# Those that are shown in the page; the order of the files is that of their hashes, so any of them are as good.
SHOWN = 40


def test_every_message_is_that_of_the_command_line(opened: ScenePage) -> None:
    answers = opened.ask(*({"method": "check", "text": refused["scene"]} for refused in REFUSED))
    for refused, answer in zip(REFUSED, answers, strict=True):
        [mistake] = answer["ok"]["mistakes"]
        place = f"brinell: scene.toml:{mistake['line']}:{mistake['column']}: "
        # a terminal shows no control characters
        shown = re.sub(r"[\x00-\x08\x0b-\x1f\x7f]", "\ufffd", mistake["message"])
        assert words(refused["message"]).startswith(words(place + shown)), refused["scene"]
        # the same place, in the units of JavaScript
        lines = refused["scene"].split("\n")
        before = "\n".join([*lines[: mistake["line"] - 1], lines[mistake["line"] - 1][: mistake["column"] - 1]])
        assert mistake["from"] == len(before.encode("utf-16-le")) // 2, refused["scene"]


def test_messages_are_shown_at_their_places(opened: ScenePage) -> None:
    at_fields = 0
    for refused in REFUSED[:SHOWN]:
        text = refused["scene"].replace("\r\n", "\n")
        [answer] = opened.ask({"method": "check", "text": text})
        [mistake] = answer["ok"]["mistakes"]
        opened.write(text)
        banner = opened.at("mistake")
        banner.wait_for()
        assert words(mistake["message"]) in words(banner.text_content() or "")
        assert opened.page.locator(".cm-lintRange-error, .cm-lintPoint-error").count() > 0, text
        opened.at("mistake.show").click()
        utf16 = text.encode("utf-16-le")
        marked = utf16[2 * mistake["from"] : 2 * mistake["to"]].decode("utf-16-le")
        assert opened.page.evaluate("getSelection().toString()").rstrip("\n") == marked.rstrip("\n"), text
        wrong = opened.page.locator('[data-test$=".wrong"]:not(:empty)')
        at_fields += wrong.count() > 0
        for message in wrong.all_text_contents():
            assert words(message) in words(mistake["message"])
    assert at_fields > SHOWN // 10


def test_a_mistake_is_at_its_field_until_it_is_mended(opened: ScenePage) -> None:
    opened.write(scene("steel_ball"))
    opened.type("impactor.radius", "-3 mm")
    wrong = opened.at("impactor.radius.wrong")
    wrong.get_by_text("radius").wait_for()
    assert opened.at("impactor.radius").get_attribute("aria-invalid") == "true"
    opened.type("impactor.radius", "3 mm")
    wrong.get_by_text("radius").wait_for(state="hidden")
    assert opened.at("mistake").is_hidden()


@pytest.mark.parametrize("text", ["name = ", "[impactor\n", "", "\x00", "name = 'a'\nname = 'b'\n"])
def test_what_is_no_scene_at_all_has_a_message(opened: ScenePage, text: str) -> None:
    [answer] = opened.ask({"method": "check", "text": text})
    assert len(answer["ok"]["mistakes"]) == 1
