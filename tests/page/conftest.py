"""The browser of the tests, started once, without the network, and the page in it.

`BRINELL_TEST_BROWSER` is `firefox` or `webkit` for those of the system, by webdriver.py; otherwise it is the pinned Chromium.
"""

import os
from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest
import webdriver
from playwright.sync_api import Browser, Page, sync_playwright

if TYPE_CHECKING:
    from scene_page import ScenePage


pytest.register_assert_rewrite("scene_page")


KIND = os.environ.get("BRINELL_TEST_BROWSER", "chromium")


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line(
        "markers", "chromium: what is asked of a browser beside its page, which needs Chromium's protocol"
    )


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leaves out what needs Chromium."""
    left = [item for item in items if KIND != "chromium" and item.get_closest_marker("chromium")]
    config.hook.pytest_deselected(items=left)
    items[:] = [item for item in items if item not in left]


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser | webdriver.Browser]:
    if KIND != "chromium":
        with webdriver.started(KIND) as other:
            yield other
        return
    with sync_playwright() as driver:
        # a container allows no other sandbox inside
        started = driver.chromium.launch(executable_path=os.environ["BRINELL_TEST_CHROMIUM"], args=["--no-sandbox"])
        yield started
        started.close()


@pytest.fixture
def page(browser: Browser) -> Iterator[Page]:
    """An empty tab."""
    context = browser.new_context(offline=True)
    yield context.new_page()
    context.close()


@pytest.fixture(scope="session")
def opened(browser: Browser) -> Iterator["ScenePage"]:
    """The page, opened once: a test begins with its own scene."""
    from scene_page import ScenePage  # reads what other tests aren't given

    context = browser.new_context(offline=True, viewport={"width": 1440, "height": 900})
    yield ScenePage(context.new_page())
    context.close()


@pytest.fixture(autouse=True)
def no_error(request: pytest.FixtureRequest) -> Iterator[None]:
    """No test may leave an error behind in the page that all share."""
    yield
    if "opened" in request.fixturenames:
        shared: ScenePage = request.getfixturevalue("opened")
        errors, shared.errors = shared.errors, []
        assert errors == []
