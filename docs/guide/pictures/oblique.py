"""Draws oblique.svg beside this file: measured oblique rebounds, those of finite elements, and computed ones.

    pip install matplotlib ./python
    python docs/guide/pictures/oblique.py
"""

import csv
import io
import math
import subprocess
from pathlib import Path

import matplotlib

matplotlib.use("svg")
from brinell.pictures import save
from matplotlib import pyplot
from style import STYLE

FOLDER = Path(__file__).parent
PROJECT = FOLDER.parents[2]
BLUE, RED, GREEN = "#0072b2", "#d55e00", "#009e73"
# radius of the ball [m], coefficient of friction and speed [m/s], as in the example
RADIUS, FRICTION, SPEED = 2.5e-3, 0.092, 3.9
QUANTITIES = (
    ("e_t", "tangential restitution", "{:.4f}"),
    ("omega", "spin [rad/s]", "{:.0f} rad/s"),
    ("rebound_angle_centre", "rebound angle [degrees]", "{:.2f} degrees"),
)


def computed():
    """The columns of the two tables that the example prints."""
    command = ["cargo", "run", "--quiet", "--release", "--example", "oblique", "--no-default-features"]
    text = subprocess.run(command, cwd=PROJECT, check=True, capture_output=True, text=True).stdout
    tables = [list(csv.DictReader(io.StringIO(table))) for table in text.split("\n\n")]
    return [{name: [float(row[name]) for row in rows] for name in rows[0]} for rows in tables]


def rows(quantity):
    """The digitisation, angle and value of each measured point."""
    with (PROJECT / "data/experiment/oblique_elastic.csv").open() as file:
        found = [row for row in csv.DictReader(file) if row["quantity"] == quantity]
    return [(row["digitisation"], float(row["angle_deg"]), float(row["value"])) for row in found]


def slip(angle, restitution, spin):
    """Maw's numbers: tan(angle)/mu, and the slip speed after the impact over mu times the normal speed."""
    normal, tangential = SPEED * math.cos(math.radians(angle)), SPEED * math.sin(math.radians(angle))
    return tangential / (FRICTION * normal), (tangential * restitution - RADIUS * spin) / (FRICTION * normal)


def measured_slips():
    """Those of the measured points, with the spin between its measured angles in each digitisation."""
    found = []
    for source, angle, restitution in rows("e_t"):
        spins = [(at, value) for other, at, value in rows("omega") if other == source]
        if spins[0][0] <= angle <= spins[-1][0]:
            found.append(slip(angle, restitution, interpolated(angle, *zip(*spins))))
    return zip(*found)


def slips_by_finite_elements():
    """Maw's numbers of Chung and Ooi's finite elements."""
    with (PROJECT / "data/experiment/oblique_elastic_finite_elements.csv").open() as file:
        found = [row for row in csv.DictReader(file) if row["quantity"] == "psi2"]
    return [[float(row[name]) for row in found] for name in ("psi1", "value")]


def interpolated(at, arguments, values):
    """The value between those at the neighbouring arguments, or beyond the two at an end, in a straight line."""
    last = max(index for index in range(len(arguments) - 1) if index == 0 or arguments[index] <= at)
    part = (at - arguments[last]) / (arguments[last + 1] - arguments[last])
    return values[last] + part * (values[last + 1] - values[last])


def rms(curve, points):
    """Root-mean-square distance of the points from the curve."""
    squares = [(value - interpolated(at, *curve)) ** 2 for at, value in zip(*points)]
    return math.sqrt(sum(squares) / len(squares))


def draw(axis, curve, points, titles, words):
    """A curve with measured points, and their distance from it."""
    axis.plot(*curve, color=BLUE, label="computed")
    axis.plot(*points, "o", markersize=3.5, color=RED, fillstyle="none", label="measured")
    axis.set(xlabel=titles[0], ylabel=titles[1], title="rms " + words.format(rms(curve, points)))


def main():
    pyplot.rcParams.update(STYLE)
    curves, equal_bodies = computed()
    figure, axes = pyplot.subplots(2, 2, figsize=(6.4, 5.4), layout="constrained")
    axes = axes.flat
    for axis, (quantity, label, words) in zip(axes, QUANTITIES):
        points = [column[1:] for column in rows(quantity)]
        curve = curves["angle_deg"], curves[quantity]
        draw(axis, curve, list(zip(*points)), ("angle of incidence [degrees]", label), words)
        axis.set(xlim=(0, 90))
    triples = zip(curves["angle_deg"], curves["e_t"], curves["omega"])
    # farther on, the ball slides throughout
    near = lambda slips: tuple(zip(*(pair for pair in slips if pair[0] < 20)))
    titles = "psi_1 = tan(angle) / mu", "psi_2 = slip speed / (mu v_n)"
    draw(axes[3], near(slip(*triple) for triple in triples), near(zip(*measured_slips())), titles, "{:.2f}")
    curve, points = (equal_bodies["psi_1"], equal_bodies["psi_2"]), slips_by_finite_elements()
    axes[3].plot(*curve, "--", color=GREEN, label="computed, equal bodies")
    axes[3].plot(*points, "x", markersize=3.5, color=GREEN, label=f"finite elements, rms {rms(curve, points):.2f}")
    axes[3].legend(frameon=False, fontsize=7)
    axes[0].legend(frameon=False)
    save(figure, FOLDER / "oblique.svg")


main()
