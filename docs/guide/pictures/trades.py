"""Draws trades/NAME.svg beside this file, for each scene of scenes/trades/: force over depth of its impact and restitution over the
speed, by the law and by a spring and a damper that have the same restitution and contact time at the scene's speed.

    pip install matplotlib ./python
    python docs/guide/pictures/trades.py
"""

from pathlib import Path

import brinell
import matplotlib
import numpy as np

matplotlib.use("svg")
from brinell.pictures import save
from matplotlib import pyplot
from style import STYLE

FOLDER = Path(__file__).parent / "trades"
SCENES = FOLDER.parents[3] / "scenes/trades"
BLACK, BLUE = "black", "#0072b2"


def law(scene):
    """Depth and force of the impact."""
    cycle = brinell.curve(scene)
    depth, force = (np.asarray(cycle[name]) for name in ("indentation", "force"))
    turn = int(np.argmax(depth))
    # the curve leaves and comes back on its way in
    into = np.flatnonzero(depth[: turn + 1] >= np.maximum.accumulate(depth[: turn + 1]))
    back = np.arange(turn + 1, len(depth))
    ends = np.flatnonzero((force[back] <= 0.0) | (np.diff(depth)[turn:] > 0.0))
    back = back[: ends[0] + 1] if len(ends) else back
    return tuple(np.concatenate([[0.0], values[into], values[back]]) for values in (depth, force))


def spring(numbers, mass, speed, contact_time):
    """Depth and force of an impact on a spring with a damper that doesn't pull."""
    k, c = numbers["stiffness"], numbers["damping"]
    step = contact_time / 20_000
    depth, rows = 0.0, []
    while True:
        force = k * depth + c * speed
        if force <= 0.0:
            return np.array(rows).T
        rows.append((depth, force))
        speed -= step * force / mass
        depth += step * speed


def scaled(values, units):
    """A factor to a unit in which the largest value is between 1 and 1000, and the unit."""
    largest = max(np.max(value) for value in values)
    return next((factor, name) for factor, name in units if largest * factor >= 1.0)


def draw(scene, path):
    predicted = brinell.predict(scene)
    speed = predicted.speed
    translation = brinell.translate(scene, "simscape", speed=f"{0.1 * speed!r}:{3 * speed!r}")
    way = translation.ways[0]
    loops = (law(scene), spring(way.numbers, predicted.mass, speed, predicted.contact_time))
    long, metre = scaled([loop[0] for loop in loops], ((1e3, "mm"), (1e6, "um"), (1e9, "nm")))
    strong, newton = scaled([loop[1] for loop in loops], ((1e-3, "kN"), (1.0, "N"), (1e3, "mN")))
    figure, (first, second) = pyplot.subplots(1, 2, figsize=(6.4, 2.3), layout="constrained")
    for (depth, force), colour in zip(loops, (BLACK, BLUE), strict=True):
        first.plot(long * depth, strong * force, color=colour, linewidth=1.5)
    if predicted.dent > 0.0:
        first.plot(long * predicted.dent, 0.0, "o", color=BLACK, markersize=5, clip_on=False)
        second.plot([], [], "o", color=BLACK, markersize=5, label="what remains as a dent")
    first.set(xlabel=f"depth [{metre}]", ylabel=f"force [{newton}]", ylim=(0, None), xlim=(0, None))
    speeds = translation.wanted["speed"]
    second.plot(speeds, translation.wanted["restitution"], color=BLACK, linewidth=1.5, label="Brinell")
    second.plot(speeds, way.promised["restitution"], color=BLUE, linewidth=1.5, label="a spring and a damper")
    second.set(xscale="log", xlabel="speed [m/s]", ylabel="restitution", ylim=(0, 1.05))
    second.set_xticks([0.1 * speed, speed, 3 * speed], [f"{value:.3g}" for value in (0.1 * speed, speed, 3 * speed)])
    second.minorticks_off()
    second.legend(fontsize=7.5, loc="lower left")
    save(figure, path)
    pyplot.close(figure)


def main():
    FOLDER.mkdir(exist_ok=True)
    matplotlib.rcParams.update(STYLE)
    for scene in sorted(SCENES.glob("*.toml")):
        draw(scene, FOLDER / f"{scene.stem}.svg")


if __name__ == "__main__":
    main()
