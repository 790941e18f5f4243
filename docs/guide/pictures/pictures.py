"""Draws the pictures of README and guide: overview.svg and force.svg beside this file, and docs/laws.svg.

    pip install matplotlib ./python
    python docs/guide/pictures/pictures.py
"""

import tempfile
import warnings
from pathlib import Path

import brinell
import matplotlib
import numpy as np

matplotlib.use("svg")
from brinell.pictures import save
from matplotlib import pyplot
from matplotlib.patches import Circle, Polygon
from style import STYLE

FOLDER = Path(__file__).parent
BLUE, RED, GREY = "#0072b2", "#d55e00", "#777777"
MASS, GRAVITY, RADIUS = 4e-3, 9.81, 5e-3  # kg, m/s^2, m
SCENE = """
name = "ball"
impactor = { radius = 5e-3 }
target = { material = "mild steel", surface = "fresh" }
law = { loading = "brinell", unloading = "brinell" }
fmu = { outputs = ["indentation", "residual_indentation", "mean_force"] }
impact = { mass = 4e-3, speed = 1.0 }
"""


def unit(folder, name, more=""):
    """The FMU of the ball."""
    scene = Path(folder) / f"{name}.toml"
    scene.write_text(SCENE + more)
    return brinell.export(scene, Path(folder) / f"{name}.fmu")


def cycle(path):
    """Indentation [um] and force [N]: 12 um in, out, and in again to 16 um."""
    rows = [(0.0, 0.0)]
    with brinell.Contact(path, force="end") as contact:
        for rate, steps in ((0.1, 120), (-0.1, 60), (0.1, 100), (-0.1, 80)):
            for _ in range(steps):
                force = contact.step(1e-6, rate)
                if force > 0.0:
                    rows.append((1e6 * contact["indentation"], force))
        dent = 1e6 * contact["residual_indentation"]
    return np.array([*rows, (dent, 0.0)]).T, dent


def fall(path, h=1e-3):
    """Times [ms] and heights [mm] of a ball that falls 50 mm, in steps of 1 ms."""
    rows, speed = [(0.0, 50.0)], 0.0
    with brinell.Contact(path, initial_gap=0.05) as contact:
        for step in range(1, 500):
            force = contact.step(h, speed, GRAVITY)
            speed += h * (GRAVITY - force / MASS)
            rows.append((1e3 * h * step, -1e3 * contact["indentation"]))
    return np.array(rows).T


def sketch(axes):
    """A sphere in its dent, much too deep."""
    angle = np.linspace(-0.62, 0.62, 60)
    dent = np.column_stack([np.sin(angle), 1.0 - np.cos(angle)])
    edge = dent[-1, 1]
    block = [(-1.6, edge), *dent, (1.6, edge), (1.6, -0.9), (-1.6, -0.9)]
    axes.add_patch(Polygon(block, facecolor="#d9d9d9", edgecolor="#444444"))
    axes.add_patch(Circle((0.0, 1.0), 1.0, facecolor="#9ecae1", edgecolor="#444444"))
    arrow = {"arrowstyle": "-|>", "linewidth": 1.6}
    axes.annotate("", (0.0, 1.05), (0.0, 1.75), arrowprops={**arrow, "color": BLUE})
    axes.text(1.1, 1.4, "speed in", color=BLUE)
    axes.annotate("", (0.0, 0.72), (0.0, 0.05), arrowprops={**arrow, "color": RED})
    axes.text(1.1, 0.85, "force out", color=RED)
    axes.text(0.0, -0.5, "the dent remains", ha="center", color="#444444")
    axes.set(xlim=(-1.7, 2.1), ylim=(-1.0, 2.1), aspect="equal")
    axes.axis("off")


def loading_curves(scene):
    """The loading curve of each law from 0.3 to 1000 yield indentations: indentation and force, in units of the yield point."""
    modulus = 206e9 / (1.0 - 0.3**2)  # of mild steel under a rigid ball
    indentation = RADIUS * (3.0 * np.pi * 1.1 * 300e6 / (4.0 * modulus)) ** 2
    force = 4.0 / 3.0 * modulus * RADIUS**0.5 * indentation**1.5
    curves, end = {}, 0.3
    for to in (1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0):
        # the first of the branches of a curve loads to two thirds of its depth
        for law, columns in brinell.curve(scene, laws=["all"], to=1.5 * to * indentation).groupby("law", sort=False):
            first = np.argmax(columns["indentation"] >= 0.999999 * to * indentation) + 1
            x, f = columns["indentation"][:first] / indentation, columns["force"][:first] / force
            curves.setdefault(law, []).append(np.column_stack([x, f])[x >= end])
        end = to
    return {law: np.concatenate(parts) for law, parts in curves.items()}


def draw_laws(folder):
    """The loading curves over Hertz's force, and the finite elements of `data/truth/` as dots."""
    scene = Path(folder) / "laws.toml"
    scene.write_text(SCENE)
    figure, axes = pyplot.subplots(figsize=(8.6, 5.0), layout="constrained")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", brinell.ProgramWarning)  # the deepest are wider than any law is valid
        curves = loading_curves(scene)
    for index, (law, curve) in enumerate(curves.items()):
        x, f = curve.T
        style = {"linewidth": 2.5} if law == "brinell/brinell" else {"linewidth": 1.0, "linestyle": "-" if index < 10 else "--"}
        axes.plot(x, f / x**1.5, label=law.split("/")[0], **style)
    truth = np.loadtxt(FOLDER.parents[2] / "data/truth/loading.csv", delimiter=",", skiprows=1, usecols=(0, 2))
    places = np.searchsorted(truth[:, 0], np.geomspace(0.3, 999.0, 25))
    x, f = truth[np.unique(places)].T
    axes.plot(x, f / x**1.5, "k.", label="finite elements")
    axes.set(xlabel="indentation / yield indentation", ylabel="force / Hertz's force", xscale="log", ylim=0)
    axes.legend(fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5))
    save(figure, FOLDER.parents[1] / "laws.svg")


def main():
    matplotlib.rcParams.update(STYLE)
    with tempfile.TemporaryDirectory() as folder:
        (indentation, force), dent = cycle(unit(folder, "plain"))
        time, height = fall(unit(folder, "known", "coupling = { effective_mass = 4e-3 }"))
    figure, (left, middle, right) = pyplot.subplots(
        1, 3, figsize=(7.2, 2.5), layout="constrained", width_ratios=[0.9, 1.1, 1.2]
    )
    sketch(left)
    middle.plot(indentation, force, color=BLUE)
    middle.plot([dent], [0.0], "o", color=RED, clip_on=False)
    middle.text(dent + 0.7, 12.0, "dent", color=RED)
    middle.set(xlabel="indentation [µm]", ylabel="force [N]", title="loading, unloading, reloading", xlim=0, ylim=0)
    right.plot(time, height, color=BLUE)
    right.set(xlabel="time [ms]", ylabel="height [mm]", title="impacts of 30 µs in steps of 1 ms", xlim=(0, 500), ylim=0)
    save(figure, FOLDER / "overview.svg")

    with tempfile.TemporaryDirectory() as folder, brinell.Contact(
        unit(folder, "plain"), force="end", target_yield_strength=400e6
    ) as contact:
        rows = [(0.0, 0.0)]
        for rate in [0.1] * 100 + [-0.1] * 100:
            contact_force = contact.step(1e-6, rate)
            rows.append((1e6 * contact["indentation"], contact_force))
    figure, axes = pyplot.subplots(figsize=(5.2, 3.2), layout="constrained")
    axes.plot(*np.array(rows).T, color=BLUE)
    axes.set(xlabel="indentation [um]", ylabel="force [N]")
    save(figure, FOLDER / "force.svg")

    with tempfile.TemporaryDirectory() as folder:
        draw_laws(folder)


if __name__ == "__main__":
    main()
