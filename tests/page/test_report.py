"""Reports: nothing overflows on a desktop or a phone, no text of a picture is cut off, and they print on a few pages."""

import os
from pathlib import Path

import pytest
from playwright.sync_api import Page

REPORTS = sorted(Path(os.environ["BRINELL_TEST_REPORTS"]).glob("*/index.html"))

CUT = """[...document.querySelectorAll("figure svg text")].filter((text) => {
  const [inner, outer] = [text.getBoundingClientRect(), text.ownerSVGElement.getBoundingClientRect()];
  return inner.width > 0 && (inner.left < outer.left - 1 || inner.right > outer.right + 1);
}).map((text) => text.textContent)"""


@pytest.mark.chromium
@pytest.mark.parametrize("report", REPORTS, ids=lambda path: path.parent.name)
def test_fits_a_desktop_a_phone_and_six_printed_pages(page: Page, report: Path) -> None:
    page.goto(report.as_uri())
    assert page.locator("figure svg text").count() > 10
    for width in (1440, 1024, 390):
        page.set_viewport_size({"width": width, "height": 900})
        root = "document.documentElement"
        assert page.evaluate(f"{root}.scrollWidth - {root}.clientWidth") == 0, f"it overflows at {width} pixels"
        assert page.evaluate(CUT) == [], f"text is cut off at {width} pixels"
    pages = page.pdf().count(b"/Type /Page\n")
    assert 1 <= pages <= 6
