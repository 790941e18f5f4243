"""Firefox and WebKit of the system, by WebDriver, as the tests use Playwright's pages: the part of its interface that they need.

Firefox answers the commands on a socket of its own (Marionette), WebKit through WebKitWebDriver. Nothing is fetched.
"""

from __future__ import annotations

import base64
import contextlib
import http.client
import json
import os
import shutil
import socket
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import TracebackType
from typing import Any, ClassVar, Self
from urllib.request import url2pathname

# Seconds until something that is waited for counts as missing.
PATIENCE = 180.0
ELEMENT = "element-6066-11e4-a52e-4f735466cecf"

# Before the page's own scripts: mistakes, and the files that it saves.
BEFORE = """
window.mistaken = [];
addEventListener("error", ({ message }) => mistaken.push(message));
addEventListener("unhandledrejection", ({ reason }) => mistaken.push(String(reason)));
for (const own of [console.error.bind(console)]) console.error = (...said) => (mistaken.push(said.join(" ")), own(...said));
window.blobs = new Map();
for (const own of [URL.createObjectURL]) URL.createObjectURL = (blob) => { const url = own(blob); blobs.set(url, blob); return url; };
for (const own of [HTMLAnchorElement.prototype.click]) HTMLAnchorElement.prototype.click = function () {
  if (this.download) window.saved = { name: this.download, blob: blobs.get(this.href) };
  else own.call(this);
};
"""

# What a chain of selectors finds.
FIND = """const find = (chain) => chain.reduce((found, [kind, what]) => {
  if (kind === "css") return [...new Set(found.flatMap((one) => [...one.querySelectorAll(what)]))];
  if (kind === "at") return found.slice(what, what + 1 || undefined);
  const has = (one) => one.textContent.includes(what);
  return found.flatMap((one) => [one, ...one.querySelectorAll("*")]).filter((one) => has(one) && ![...one.children].some(has));
}, [document]);
const seen = (one) => one.checkVisibility({ visibilityProperty: true }) && one.getClientRects().length > 0;
const told = (one) => ["input", "change"].forEach((kind) => one.dispatchEvent(new Event(kind, { bubbles: true })));
"""

SAVED = """async () => {
  if (!window.saved) return null;
  const { name, blob } = saved;
  window.saved = null;
  const bytes = new Uint8Array(await blob.arrayBuffer());
  let text = "";
  for (let at = 0; at < bytes.length; at += 32768) text += String.fromCharCode(...bytes.subarray(at, at + 32768));
  return [name, btoa(text)];
}"""

KEYS = {
    "Control": "\ue009",
    "Shift": "\ue008",
    "Tab": "\ue004",
    "Enter": "\ue007",
    "ArrowDown": "\ue015",
    "ArrowRight": "\ue014",
}


class Firefox:
    """Its commands, on the socket that `--marionette` opens."""

    PATHS = ("firefox-esr",)

    def __init__(self, program: str, folder: Path) -> None:
        preferences = {
            "marionette.port": 0,
            "browser.shell.checkDefaultBrowser": False,
            "datareporting.policy.dataSubmissionEnabled": False,
        }
        lines = (f"user_pref({json.dumps(name)}, {json.dumps(value)});\n" for name, value in preferences.items())
        (folder / "user.js").write_text("".join(lines))
        command = [program, "--headless", "--no-remote", "--marionette", "--profile", str(folder)]
        self.process = subprocess.Popen(
            command, env=os.environ | {"HOME": str(folder)}, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        port = folder / "MarionetteActivePort"
        wait(lambda: port.is_file() and port.read_text().strip(), "Firefox starts")
        self.socket = socket.create_connection(("127.0.0.1", int(port.read_text())), timeout=2 * PATIENCE)
        self.number = 0
        self._read()

    def send(self, command: str, **parameters: Any) -> Any:
        self.number += 1
        message = json.dumps([0, self.number, f"WebDriver:{command}", parameters]).encode()
        self.socket.sendall(b"%d:%s" % (len(message), message))
        _, _, error, result = self._read()
        if error:
            raise AssertionError(f"{command}: {error['message']}")
        return result["value"] if isinstance(result, dict) and set(result) == {"value"} else result

    def _read(self) -> Any:
        length = b""
        while not length.endswith(b":"):
            length += self.socket.recv(1)
        data = b""
        while len(data) < int(length[:-1]):
            data += self.socket.recv(1 << 20)
        return json.loads(data)

    def end(self) -> None:
        self.socket.close()
        self.process.terminate()
        self.process.wait()


class WebKit:
    """Its commands by HTTP, on a screen of its own where there is none."""

    PATHS = ("WebKitWebDriver",)
    BROWSERS = "/usr/lib/*/webkit2gtk-4.*/MiniBrowser", "/usr/libexec/webkit2gtk-4.*/MiniBrowser"
    COMMANDS: ClassVar = {
        "Navigate": "url", "ExecuteAsyncScript": "execute/async", "PerformActions": "actions", "SetWindowRect": "window/rect",
        "SetTimeouts": "timeouts", "ElementClick": "element/{id}/click", "ElementSendKeys": "element/{id}/value",
    }  # fmt: skip

    def __init__(self, program: str, folder: Path) -> None:
        self.processes: list[subprocess.Popen[bytes]] = []
        variables = os.environ | {
            "HOME": str(folder),
            "XDG_RUNTIME_DIR": str(folder),
            "NO_AT_BRIDGE": "1",
            "WEBKIT_DISABLE_COMPOSITING_MODE": "1",
        }
        if "DISPLAY" not in os.environ:
            read, write = os.pipe()
            screen = ["Xvfb", "-displayfd", str(write), "-screen", "0", "1600x1200x24", "-nolisten", "tcp"]
            self.processes.append(
                subprocess.Popen(screen, pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            )
            os.close(write)
            with os.fdopen(read) as number:
                variables["DISPLAY"] = f":{number.readline().strip()}"
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        command = [program, f"--port={self.port}"]
        self.processes.append(
            subprocess.Popen(command, env=variables, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        )
        wait(self._listens, "WebKitWebDriver starts")
        self.session = ""

    def _listens(self) -> bool:
        with contextlib.suppress(OSError):
            socket.create_connection(("127.0.0.1", self.port), timeout=1).close()
            return True
        return False

    def send(self, command: str, **parameters: Any) -> Any:
        if command == "NewSession":
            browser = next(path for place in self.BROWSERS for path in Path("/").glob(place[1:]))
            options = {"binary": str(browser), "args": ["--automation"]}
            parameters = {"capabilities": {"alwaysMatch": {"webkitgtk:browserOptions": options}}}
            answer = self._ask("POST", "/session", parameters)
            self.session = f"/session/{answer['sessionId']}"
            return answer
        if command == "DeleteSession":
            return self._ask("DELETE", self.session)
        return self._ask("POST", f"{self.session}/{self.COMMANDS[command].format(**parameters)}", parameters)

    def _ask(self, method: str, path: str, parameters: Any = None) -> Any:
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=2 * PATIENCE)
        connection.request(method, path, json.dumps(parameters) if parameters is not None else None)
        answer = json.loads(connection.getresponse().read())["value"]
        connection.close()
        if isinstance(answer, dict) and "error" in answer and "message" in answer:
            raise AssertionError(f"{path}: {answer['error']}: {answer['message']}")
        return answer

    def end(self) -> None:
        for process in reversed(self.processes):
            process.terminate()
            process.wait()


KINDS = {"firefox": Firefox, "webkit": WebKit}


def wait(found: Callable[[], Any], what: str) -> Any:
    end = time.monotonic() + PATIENCE
    while not (last := found()):
        assert time.monotonic() < end, f"this doesn't happen: {what}"
        time.sleep(0.02)
    return last


class Browser:
    """A kind of browser; each context is one of its own."""

    def __init__(self, kind: str, program: str) -> None:
        self.kind, self.program = kind, program

    def new_context(self, *, offline: bool = True, viewport: dict[str, int] | None = None, **_: Any) -> Context:
        # what the page may ask of the network, its policy refuses
        del offline
        return Context(self, viewport)

    def close(self) -> None:
        pass


class Context:
    def __init__(self, browser: Browser, viewport: dict[str, int] | None) -> None:
        self.folder = tempfile.TemporaryDirectory(prefix="brinell-page-", ignore_cleanup_errors=True)
        self.driver = KINDS[browser.kind](browser.program, Path(self.folder.name))
        self.driver.send("NewSession", capabilities={"alwaysMatch": {}})
        self.driver.send("SetTimeouts", script=int(1000 * PATIENCE))
        self.viewport = viewport

    def new_page(self) -> Tab:
        return Tab(self.driver, Path(self.folder.name), self.viewport)

    def close(self) -> None:
        with contextlib.suppress(AssertionError, OSError):
            self.driver.send("DeleteSession")
        self.driver.end()
        self.folder.cleanup()


class Tab:
    """A page."""

    def __init__(self, driver: Any, folder: Path, viewport: dict[str, int] | None) -> None:
        self.driver, self.folder = driver, folder
        self.scripts = [BEFORE]
        self.listeners: list[Callable[[Any], None]] = []
        self.keyboard = self
        if viewport:
            self.set_viewport_size(viewport)

    def on(self, kind: str, listener: Callable[[Any], None]) -> None:
        if kind == "pageerror":
            self.listeners.append(listener)

    def add_init_script(self, script: str) -> None:
        self.scripts.append(script)

    def goto(self, address: str) -> None:
        """Opens a copy of the file with the scripts before its own."""
        place, _, fragment = address.partition("#")
        path = Path(url2pathname(place.removeprefix("file://")))
        text = path.read_text(encoding="utf-8")
        scripts = "".join(f"<script>{script}</script>" for script in self.scripts)
        copy = self.folder / path.name
        copy.write_text(text.replace("<head>", f"<head>{scripts}", 1), encoding="utf-8")
        self.driver.send("Navigate", url=copy.as_uri() + (f"#{fragment}" if fragment else ""))

    def run(self, body: str, *given: Any) -> Any:
        """What a body of an asynchronous function returns in the page."""
        script = f"""const [given, done] = arguments;
          const run = async (given) => {{ {FIND} {body} }};
          const mistakes = () => (window.mistaken ?? []).splice(0);
          run(given).then((value) => done({{ value, mistakes: mistakes() }}), (error) => done({{ error: String(error), mistakes: mistakes() }}));"""
        answer = self.driver.send("ExecuteAsyncScript", script=script, args=[list(given)])
        for mistake in answer["mistakes"]:
            for listener in self.listeners:
                listener(mistake)
        assert not answer.get("error"), answer["error"]
        return answer.get("value")

    def evaluate(self, script: str, arg: Any = None) -> Any:
        return self.run(f"const what = ({script}); return typeof what === 'function' ? what(given[0]) : what;", arg)

    def wait_for_function(self, script: str, *, arg: Any = None) -> None:
        wait(lambda: self.run(f"return Boolean(({script})(given[0]));", arg), script)

    def wait_for_timeout(self, milliseconds: float) -> None:
        time.sleep(milliseconds / 1000)

    def set_viewport_size(self, size: dict[str, int]) -> None:
        # the window is larger by its frame
        frame = self.evaluate("[outerWidth - innerWidth, outerHeight - innerHeight]")
        wanted = [size["width"], size["height"]]
        self.driver.send("SetWindowRect", x=0, y=0, width=wanted[0] + frame[0], height=wanted[1] + frame[1])
        wait(lambda: self.evaluate("[innerWidth, innerHeight]") == wanted, f"a page of {wanted} pixels")

    def locator(self, css: str) -> Locator:
        return Locator(self, [["css", css]])

    def press(self, keys: str) -> None:
        codes = [KEYS.get(key, key) for key in keys.split("+")]
        actions = [{"type": "keyDown", "value": code} for code in codes] + [
            {"type": "keyUp", "value": code} for code in reversed(codes)
        ]
        self.driver.send("PerformActions", actions=[{"type": "key", "id": "keyboard", "actions": actions}])

    def expect_download(self) -> Download:
        return Download(self)


class Download:
    """A file that the page saves within the block."""

    def __init__(self, tab: Tab) -> None:
        self.tab = tab
        self.suggested_filename, self.content = "", b""

    def __enter__(self) -> Self:
        self.tab.evaluate("() => { window.saved = null; }")
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if kind is None:
            self.suggested_filename, text = wait(lambda: self.tab.evaluate(SAVED), "a file is saved")
            self.content = base64.b64decode(text)

    @property
    def value(self) -> Download:
        return self

    def path(self) -> Download:
        return self

    def read_bytes(self) -> bytes:
        return self.content


class Locator:
    """Elements, found anew for each use."""

    def __init__(self, tab: Tab, chain: list[list[Any]]) -> None:
        self.tab, self.chain = tab, chain

    def _then(self, kind: str, what: Any) -> Locator:
        return Locator(self.tab, [*self.chain, [kind, what]])

    @property
    def first(self) -> Locator:
        return self._then("at", 0)

    @property
    def last(self) -> Locator:
        return self._then("at", -1)

    def locator(self, css: str) -> Locator:
        return self._then("css", css)

    def get_by_text(self, text: str) -> Locator:
        return self._then("text", text)

    def count(self) -> int:
        return int(self.tab.run("return find(given[0]).length;", self.chain))

    def all(self) -> list[Locator]:
        return [self._then("at", index) for index in range(self.count())]

    def _of(self, what: str, *given: Any) -> Any:
        """What an expression about `one`, the only element, is."""
        wait(self.count, f"{self.chain} is there")
        return self.tab.run(f"const [one] = find(given[0]); {what}", self.chain, *given)

    def _element(self) -> dict[str, str]:
        reference = self._of("one.scrollIntoView({ block: 'nearest' }); return one;")
        return {"id": reference[ELEMENT]}

    def evaluate(self, script: str, arg: Any = None) -> Any:
        return self._of(f"return ({script})(one, given[1]);", arg)

    def text_content(self) -> str:
        return str(self._of("return one.textContent;"))

    def inner_text(self) -> str:
        return str(self._of("return one.innerText;"))

    def all_text_contents(self) -> list[str]:
        return list(self.tab.run("return find(given[0]).map((one) => one.textContent);", self.chain))

    def input_value(self) -> str:
        return str(self._of("return one.value;"))

    def get_attribute(self, name: str) -> str | None:
        found: str | None = self._of("return one.getAttribute(given[1]);", name)
        return found

    def is_visible(self) -> bool:
        return bool(self.tab.run("return find(given[0]).some(seen);", self.chain))

    def is_hidden(self) -> bool:
        return not self.is_visible()

    def wait_for(self, *, state: str = "visible") -> None:
        wait(lambda: self.is_visible() == (state == "visible"), f"{self.chain} is {state}")

    def focus(self) -> None:
        self._of("one.focus();")

    def click(self) -> None:
        ready = "const [one] = find(given[0]); return one !== undefined && seen(one) && !one.disabled;"
        wait(lambda: self.tab.run(ready, self.chain), f"{self.chain} can be clicked")
        self.tab.driver.send("ElementClick", **self._element())

    def press_sequentially(self, text: str) -> None:
        self.tab.driver.send("ElementSendKeys", **self._element(), text=text, value=list(text))

    def fill(self, text: str) -> None:
        self._of("one.focus(); one.value = given[1]; told(one);", text)

    def select_option(self, value: str | None = None, *, label: str | None = None) -> None:
        script = """const option = [...one.options].find((option) => option.value === given[1] || option.label === given[2]);
          one.value = option.value; told(one);"""
        self._of(script, value, label)

    def set_checked(self, checked: bool) -> None:
        self._of("if (one.checked !== given[1]) one.click();", checked)

    def set_input_files(self, file: dict[str, Any]) -> None:
        script = """const given_files = new DataTransfer();
          given_files.items.add(new File([given[2]], given[1]));
          one.files = given_files.files; told(one);"""
        self._of(script, file["name"], file["buffer"].decode())


@contextlib.contextmanager
def started(kind: str) -> Iterator[Browser]:
    program = next(filter(None, map(shutil.which, KINDS[kind].PATHS)), None)
    assert program, f"there is no {kind}"
    yield Browser(kind, program)
