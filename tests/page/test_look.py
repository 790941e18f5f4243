"""The page on a phone, in the dark, on paper, for who can't see it; and that it asks the network for nothing."""

import tomllib
from pathlib import Path
from typing import Literal

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Page
from scene_page import ScenePage, export, scene

TABS = ["result", "try", "download", "tools", "link"]
OPEN_ALL = "() => document.querySelectorAll('details').forEach((folded) => (folded.open = true))"
# of the page, and of each part of it that is shown
OVERFLOW = """() => Math.max(...[document.documentElement, ...document.querySelectorAll(".panel")].filter((one) => one.checkVisibility())
  .map((one) => one.scrollWidth - one.clientWidth))"""


@pytest.mark.chromium
def test_no_width_from_a_phone_to_a_desk_needs_horizontal_scroll(browser: Browser) -> None:
    context = browser.new_context(offline=True, viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True)
    opened = ScenePage(context.new_page())
    opened.page.evaluate(OPEN_ALL)
    for width in (1700, 1440, 1180, 921, 920, 768, 761, 390, 320):
        opened.page.set_viewport_size({"width": width, "height": 844})
        # form and text are beside the others where there is room
        for name in ("form", "text", *TABS) if width <= 760 else TABS:
            opened.at(f"tab.{name}").click()
            assert opened.page.evaluate(OVERFLOW) == 0, f"{name} is too wide for {width} pixels"
    assert opened.errors == []
    context.close()


@pytest.mark.chromium
def test_a_browser_that_was_started_without_a_language_shows_the_page(browser: Browser) -> None:
    """With LANG=C the browser has a language that it refuses itself."""
    context = browser.new_context(offline=True)
    tab = context.new_page()
    tab.add_init_script("Object.defineProperty(navigator, 'language', { value: 'en-US@posix', configurable: true })")
    assert ScenePage(tab).errors == []
    context.close()


CUT = """() => [...document.querySelectorAll("select, input, button")]
  .filter((one) => one.checkVisibility() && one.type !== "range" && (one.scrollHeight > one.clientHeight + 1))
  .map((one) => [one.dataset.test, one.scrollHeight, one.clientHeight])"""


def test_menus_fields_and_buttons_show_all_of_their_text(opened: ScenePage) -> None:
    opened.write(scene("two_contacts"))
    opened.page.evaluate(OPEN_ALL)
    for name in TABS:
        opened.at(f"tab.{name}").click()
        assert opened.page.evaluate(CUT) == [], name
        assert opened.page.evaluate(OVERFLOW) == 0, name


# What is right takes long to tell. In the dark only colours differ.
LIGHT = {"resultTypes": ["violations"]}
RULES = {"light": LIGHT, "dark": LIGHT | {"runOnly": ["color-contrast"]}}


@pytest.mark.chromium
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_that_axe_knows_is_in_the_way_of_anyone(opened: ScenePage, scheme: Literal["light", "dark"]) -> None:
    opened.page.emulate_media(color_scheme=scheme)
    opened.at(f"tab.{TABS[0]}").click()
    opened.write(scene("two_contacts"))
    opened.page.evaluate(OPEN_ALL)
    opened.at("chart.curve.plot").locator(".u-wrap").wait_for()
    for name in TABS:
        opened.at(f"tab.{name}").click()
        # form and text are beside each of them: once is enough
        found = Axe().run(opened.page, None if name == TABS[0] else f"#panel-{name}", RULES[scheme])
        assert found.violations_count == 0, f"{name}: {found.generate_report()}"
    opened.write(scene("two_contacts").replace("[impactor]", "[impacter]"))
    found = Axe().run(opened.page, "form", RULES[scheme])
    assert found.violations_count == 0, found.generate_report()
    opened.page.emulate_media(color_scheme="light")


@pytest.mark.chromium
def test_it_prints_with_its_scene_on_few_pages(opened: ScenePage) -> None:
    opened.at(f"tab.{TABS[0]}").click()
    opened.write(scene("steel_ball"))
    opened.page.emulate_media(media="print")
    assert opened.page.locator(".printed").is_visible()
    assert opened.at("headline").is_visible()
    assert opened.page.evaluate(OVERFLOW) == 0
    opened.page.emulate_media(media="screen")
    assert 1 <= opened.page.pdf().count(b"/Type /Page\n") <= 4


@pytest.mark.chromium
def test_every_connection_is_refused_and_none_is_tried(page: Page) -> None:
    page.context.set_offline(False)
    opened = ScenePage(page)
    opened.at("tab.try").click()
    opened.write(scene("damped"))
    assert [url for url in opened.requests if not url.startswith(("file:", "blob:", "data:"))] == []
    assert sum(url.startswith("file:") for url in opened.requests) == 1, "the page is one file"
    refused = page.evaluate("""async () => {
      const refused = [];
      addEventListener("securitypolicyviolation", (event) => refused.push(event.effectiveDirective));
      const tries = [
        () => fetch("https://example.org"),
        () => new WebSocket("wss://example.org"),
        () => navigator.sendBeacon("https://example.org", "x"),
        () => (new Image().src = "https://example.org/x.png"),
        () => document.body.append(Object.assign(document.createElement("script"), { src: "https://example.org/x.js" })),
        () => document.body.append(Object.assign(document.createElement("iframe"), { src: "https://example.org" })),
      ];
      for (const one of tries) try { await one(); } catch { /* refused */ }
      for (let wait = 0; wait < 100 && refused.length < tries.length; wait++) {
        await new Promise((settle) => setTimeout(settle, 50));
      }
      return refused.sort();
    }""")
    assert refused == ["connect-src", "connect-src", "connect-src", "frame-src", "img-src", "script-src-elem"]


def test_a_scene_or_an_fmu_dropped_on_it_is_opened(opened: ScenePage, tmp_path: Path) -> None:
    first, second = scene("steel_ball"), scene("two_contacts")
    opened.write(first)
    for name, content, text in (
        ("scene.toml", second.encode(), second),
        ("unit.fmu", export(tmp_path, first), first),
    ):
        opened.drop(name, content)
        opened.has_read(text)
    # each is a step of undo of its own, however soon the next one comes
    opened.at("undo").click()
    opened.has_read(second)
    opened.at("redo").click()
    opened.has_read(first)
    # a file that is none changes nothing, and says so
    opened.drop("broken.fmu", b"no archive")
    opened.at("toast").get_by_text("broken.fmu").wait_for()
    assert opened.text == first
    opened.at("file").set_input_files({"name": "chosen.toml", "mimeType": "text/plain", "buffer": second.encode()})
    opened.has_read(second)


def test_a_tensile_test_dropped_on_it_is_that_of_the_target(opened: ScenePage) -> None:
    text = scene("steel_ball")
    opened.write(text)
    rows = "".join(f"{strain:g};{10 * strain**0.2:.6g}\n" for strain in (0.5, 1, 2, 4, 8))
    table = f"# plastic strain [%];true stress [kgf/mm2]\n{rows}".replace(".", ",").encode()
    opened.drop("curve.csv", table)
    target = tomllib.loads(opened.changes_from(text))["target"]
    assert target["tensile_test"]["plastic_strain"] == [0.005, 0.01, 0.02, 0.04, 0.08]
    assert "yield_strength" not in target


def test_a_link_opens_the_same_scene(opened: ScenePage, page: Page) -> None:
    text = scene("everything") + "# k\u00fcrzer \u2192 \U0001f3b1\n"
    opened.at("link").evaluate("(link) => (link.value = '')")
    opened.write(text)
    opened.page.wait_for_function("() => document.querySelector('[data-test=link]').value !== ''")
    link = opened.at("link").input_value()
    assert ScenePage(page, "#" + link.partition("#")[2]).text == text


def test_the_page_names_whose_code_it_has(opened: ScenePage) -> None:
    opened.at("tab.link").click()
    licenses = opened.at("fold.licenses").text_content() or ""
    assert all(name in licenses for name in ["- brotli ", "@codemirror/view", "Permission is hereby granted"])
