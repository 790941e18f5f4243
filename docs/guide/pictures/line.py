"""Draws line.svg beside this file: the law of line contacts beside the finite elements of data/truth/line.

    pip install matplotlib ./python
    python docs/guide/pictures/line.py path/to/brinell
"""

import csv
import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("svg")
from brinell.pictures import save
from matplotlib import pyplot
from style import STYLE

FOLDER = Path(__file__).parent
TRUTH = FOLDER.parents[2] / "data/truth/line"
BLUE, RED, GREY = "#0072b2", "#d55e00", "#777777"
APART, UNLOADED = 0, 5
RADIUS, LENGTH, STRENGTH, MODULUS, CONSTANT = 1.0, 1.0, 1e5, 200e9, 10.0
# a rigid cylinder on a plane so weak that the strain stays small
SCENE = f"""
name = "line"
impactor = {{ shape = "cylinder", radius = {RADIUS}, length = {LENGTH} }}
target = {{ youngs_modulus = {MODULUS * (1 - 0.3**2)}, poissons_ratio = 0.3, yield_strength = {STRENGTH} }}
law = {{ size_constant = {CONSTANT} }}
impact = {{ mass = 1, speed = 1e-6 }}
"""
PRESSURE = 1.7937 * STRENGTH
HALF_WIDTH = 2 * RADIUS * PRESSURE / MODULUS
DEPTH = HALF_WIDTH**2 / RADIUS
FORCE = np.pi * RADIUS * PRESSURE**2 / MODULUS * LENGTH


def table(path):
    """The rows of a table, by heading."""
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def column(rows, *starts):
    """The first column whose heading begins so."""
    name = next(name for name in rows[0] if any(name.startswith(start) for start in starts))
    return np.array([float(row[name]) for row in rows])


def curve(program, largest):
    """Depth, force and half-width in units of first yield: up to this depth, and the way back."""
    with tempfile.TemporaryDirectory() as folder:
        scene, out = Path(folder) / "line.toml", Path(folder) / "line.csv"
        scene.write_text(SCENE)
        command = [program, "curve", scene, "--to", repr(float(largest * DEPTH)), "-o", out]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        rows = table(out)
    units = [("indentation", DEPTH), ("force", FORCE), ("contact", HALF_WIDTH)]
    all_rows = np.array([column(rows, name) / unit for name, unit in units])
    # the program turns back on the way, too
    turn, regime = int(np.argmax(all_rows[0])), column(rows, "regime")
    is_loading = (regime > APART) & (regime < UNLOADED)
    return all_rows[:, : turn + 1][:, is_loading[: turn + 1]], all_rows[:, turn:]


def main(program):
    """Draws the picture."""
    matplotlib.rcParams.update(STYLE)
    loading = table(TRUTH / "loading.csv")
    force, width = column(loading, "F_over"), column(loading, "a_over")
    depth = column(loading, "depth") + CONSTANT * force / 4
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(6.4, 3.2), layout="constrained")
    shown = np.flatnonzero(force <= 32)[::6]
    left.plot(depth[shown], force[shown], ".", color=GREY, markersize=3, label="finite elements")
    for peak in (5, 12, 30):
        rows = [row for row in table(TRUTH / f"unloading_from_{peak}.csv") if row["branch"] == "unload"]
        back = column(rows, "F_over")
        top = np.interp(back[0], force, depth)
        left.plot((top - column(rows, "depth_recovered"))[::6], back[::6], ".", color=GREY, markersize=3)
        there, back = curve(program, top)
        label = "law `line`" if peak == 5 else None
        left.plot(there[0], there[1], color=BLUE, linewidth=1, label=label)
        left.plot(back[0], back[1], color=BLUE, linewidth=1)
    left.set(xlabel="depth / depth at first yield (C = 10)", ylabel="force / force at first yield")
    left.legend(frameon=False)
    up, _ = curve(program, depth[-1])
    seen = force >= 1.0
    right.axhline(0, color=GREY, linewidth=0.5)
    for values, expected, name, color in [(up[1], force, "force", BLUE), (up[2], width, "half-width", RED)]:
        error = 100 * (np.interp(depth, up[0], values) / expected - 1)
        right.plot(depth[seen], error[seen], color=color, linewidth=1, label=f"{name} at the same depth")
    right.set(xlabel="depth / depth at first yield", ylabel="law over finite elements [%]", xscale="log", ylim=(-1.5, 1.5))
    right.legend(frameon=False)
    save(figure, FOLDER / "line.svg")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "brinell")
