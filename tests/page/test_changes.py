"""Two hundred changes in a row: how long each takes until its result is shown, and that none leaves memory behind."""

import statistics

import pytest
from scene_page import ScenePage, scene

COUNT = 200
# Ten times the longest that is aimed at, and for the quicker quarter only: the tests run beside others.
LONGEST = 1.0

# Types each value, and waits for the cards with its results; returns the seconds that each took.
CHANGE = """async (values) => {
  const field = document.querySelector('[data-test="impactor.radius"]');
  const cards = document.querySelector(".cards");
  const times = [];
  for (const value of values) {
    const before = cards.textContent;
    const began = performance.now();
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
    times.push((performance.now() - began) / 1000);
  }
  return times;
}"""


@pytest.mark.chromium
def test_two_hundred_changes_are_quick_and_leave_nothing_behind(opened: ScenePage) -> None:
    opened.write(scene("steel_ball"))
    protocol = opened.page.context.new_cdp_session(opened.page)

    def changed(first: int, count: int) -> tuple[list[float], int, int]:
        times = opened.page.evaluate(CHANGE, [f"{5 + 0.01 * (first + number):.2f} mm" for number in range(count)])
        protocol.send("HeapProfiler.collectGarbage")
        heap = protocol.send("Runtime.getHeapUsage")["usedSize"]
        return times, heap, protocol.send("Memory.getDOMCounters")["nodes"]

    # the first ones fill caches
    _, heap, nodes = changed(1, 20)
    times, heap_after, nodes_after = changed(21, COUNT)
    print(
        f"median {1e3 * statistics.median(times):.0f} ms, longest {1e3 * max(times):.0f} ms, "
        f"heap {heap / 1e6:.1f} -> {heap_after / 1e6:.1f} MB, nodes {nodes} -> {nodes_after}"
    )
    assert statistics.quantiles(times)[0] < LONGEST
    assert heap_after - heap < 2e6
    assert nodes_after - nodes < COUNT
