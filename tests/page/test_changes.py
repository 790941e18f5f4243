"""Two hundred changes in a row: each shows its result, and none leaves memory behind."""

import pytest
from scene_page import ScenePage, scene

COUNT = 200

# Types each value, and waits for the cards with its results.
CHANGE = """async (values) => {
  const field = document.querySelector('[data-test="impactor.radius"]');
  const cards = document.querySelector(".cards");
  for (const value of values) {
    const before = cards.textContent;
    field.value = value;
    field.dispatchEvent(new Event("input", { bubbles: true }));
    await new Promise((shown) => {
      const observer = new MutationObserver(() => {
        if (cards.textContent === before) return;
        observer.disconnect();
        shown();
      });
      observer.observe(cards, { childList: true, subtree: true });
    });
  }
}"""


@pytest.mark.chromium
def test_two_hundred_changes_are_shown_and_leave_nothing_behind(opened: ScenePage) -> None:
    opened.write(scene("steel_ball"))
    protocol = opened.page.context.new_cdp_session(opened.page)

    def after(first: int, count: int) -> tuple[int, int]:
        """Bytes and nodes in use after these changes."""
        opened.page.evaluate(CHANGE, [f"{5 + 0.01 * (first + number):.2f} mm" for number in range(count)])
        protocol.send("HeapProfiler.collectGarbage")
        return protocol.send("Runtime.getHeapUsage")["usedSize"], protocol.send("Memory.getDOMCounters")["nodes"]

    # the first ones fill caches
    heap, nodes = after(1, 20)
    heap_after, nodes_after = after(21, COUNT)
    print(f"heap {heap / 1e6:.1f} -> {heap_after / 1e6:.1f} MB, nodes {nodes} -> {nodes_after}")
    assert heap_after - heap < 2e6
    assert nodes_after - nodes < COUNT
