"""The page `brinell.html` as its tests use it, and the program beside it."""

import base64
import json
import os
import subprocess
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path
from typing import Any

from playwright.sync_api import Locator, Page

# What the test in Rust gives: the page, the program, the libraries of both, and scenes.
GIVEN = json.loads(Path(os.environ["BRINELL_TEST_PAGE"]).read_text())
ROOT = Path(__file__).parents[2]

# Keeps a worker for the tests beside the page's first one: what it answers is what the page is answered.
WORKER = """window.Worker = class extends Worker {
  constructor(url, options) {
    super(url, options);
    window.ours ??= new (Object.getPrototypeOf(Worker))(url, options);
  }
  postMessage(message, ...more) {
    if (message.module && !window.given) ours.postMessage(message, ...more);
    window.given ||= Boolean(message.module);
    super.postMessage(message, ...more);
  }
}"""

# The answers are texts, because numbers are compared by their digits.
ASK = """async (questions) => {
  const answers = [];
  for (const question of questions) {
    const answer = new Promise((settle) => (ours.onmessage = ({ data }) => settle(data.json)));
    ours.postMessage({ question });
    answers.push(await answer);
  }
  return answers;
}"""

PASTE = """(editor, text) => {
  const given = new DataTransfer();
  given.setData("text/plain", text);
  editor.dispatchEvent(new ClipboardEvent("paste", { clipboardData: given, bubbles: true, cancelable: true }));
}"""

DROP = """([name, bytes]) => {
  const given = new DataTransfer();
  given.items.add(new File([Uint8Array.from(atob(bytes), (character) => character.charCodeAt(0))], name));
  document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: given, bubbles: true, cancelable: true }));
}"""

# Every control that shows a key of the scene, also one in a folded part.
FORM = """() => Object.fromEntries([...document.querySelectorAll("form [data-test]")]
  .filter((one) => one.matches("input, select"))
  .map((one) => [one.dataset.test, one.type === "checkbox" || one.type === "radio" ? one.checked : one.value]).reverse())"""


class ScenePage:
    """The page in a tab, with what it does wrong and what it asks of the network."""

    def __init__(self, page: Page, fragment: str = "") -> None:
        self.page = page
        self.errors: list[str] = []
        self.requests: list[str] = []
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.on("console", lambda line: self.errors.append(line.text) if line.type == "error" else None)
        page.on("request", lambda request: self.requests.append(request.url))
        page.add_init_script(WORKER)
        page.goto(Path(GIVEN["page"]).as_uri() + fragment)
        started = page.locator('[data-test="card.force"], body > [role=alert]').first
        started.wait_for()
        assert started.get_attribute("role") is None, started.text_content()

    def at(self, *tests: str) -> Locator:
        """The element with the last of these names."""
        return self.page.locator(f'[data-test="{tests[-1]}"]').first

    @property
    def text(self) -> str:
        """The scene that the page has understood last."""
        return self.page.locator(".printed").text_content() or ""

    def write(self, text: str) -> None:
        """Puts `text` in the editor, and waits until the page has read it."""
        if isinstance(self.page, Page):
            self.at("editor").focus()
            self.page.keyboard.press("Control+a")
            self.at("editor").evaluate(PASTE, text)
        elif text != self.text:
            # others give a paste of a script no text
            self.at("file").set_input_files({"name": "scene.toml", "mimeType": "text/plain", "buffer": text.encode()})
        self.has_read(text)

    def drop(self, name: str, content: bytes) -> None:
        """Drops a file on the page."""
        self.page.evaluate(DROP, [name, base64.b64encode(content).decode()])

    def has_read(self, text: str) -> None:
        self.page.wait_for_function("(text) => document.querySelector('.printed').textContent === text", arg=text)

    def changes_from(self, text: str) -> str:
        """The scene after it isn't `text` any more."""
        self.page.wait_for_function("(text) => document.querySelector('.printed').textContent !== text", arg=text)
        return self.text

    def type(self, test: str, value: str) -> None:
        """Types in a field, also in one that is folded away."""
        typed = "(field, value) => { field.value = value; field.dispatchEvent(new Event('input', { bubbles: true })); }"
        self.at(test).evaluate(typed, value)

    def choose(self, test: str, label: str) -> str:
        """Chooses between keys; returns the scene with what the choice begins with."""
        before = self.text
        self.at(test).select_option(label=label)
        return self.changes_from(before)

    def form(self) -> dict[str, str | bool]:
        """What the form shows, by the names of its fields."""
        shown: dict[str, str | bool] = self.page.evaluate(FORM)
        return shown

    def ask(self, *questions: dict[str, Any]) -> list[Any]:
        """What the page's exporter answers, twenty questions at a time: a browser ends a script that takes long."""
        rounds = [list(questions[start : start + 20]) for start in range(0, len(questions), 20)]
        return [json.loads(answer) for some in rounds for answer in self.page.evaluate(ASK, some)]


def wait_until(found: Callable[[], Any], expected: Any) -> None:
    """Waits for what the page shows or holds."""
    end = time.monotonic() + 10
    while (last := found()) != expected and time.monotonic() < end:
        time.sleep(0.02)
    assert last == expected


def scene(name: str) -> str:
    """A scene of the project."""
    return (ROOT / f"scenes/{name}.toml").read_text()


def brinell(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """The program, run in `folder`."""
    environment = os.environ | {"BRINELL_PREBUILT": GIVEN["libraries"]}
    command = [GIVEN["program"], *arguments]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)


def export(folder: Path, text: str) -> bytes:
    """The FMU for 64-bit Linux that the command line makes of a scene."""
    (folder / "scene.toml").write_text(text)
    ran = brinell(folder, "export", "scene.toml", "-o", "unit.fmu", "--prebuilt", "--platforms", "linux64")
    assert ran.returncode == 0, ran.stderr
    return (folder / "unit.fmu").read_bytes()


def words(text: str) -> str:
    """A text without the ends of its lines."""
    return " ".join(text.split())


@cache
def random_scenes() -> list[tuple[str, subprocess.CompletedProcess[str]]]:
    """Scenes of random features, not all of which are right, each with what the command line predicts."""

    def predicted(text: str) -> subprocess.CompletedProcess[str]:
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "scene.toml").write_text(text)
            return brinell(Path(folder), "predict", "scene.toml", "--json")

    with ThreadPoolExecutor(2) as pool:
        return list(zip(GIVEN["random"], pool.map(predicted, GIVEN["random"]), strict=True))


def right_scenes(count: int) -> list[str]:
    """Random scenes without a mistake."""
    right = [text for text, ran in random_scenes() if ran.returncode == 0]
    assert len(right) >= count
    return right[:count]
