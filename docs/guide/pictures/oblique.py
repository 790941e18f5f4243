"""Draws oblique.svg beside this file: measured oblique rebounds, and computed ones.

    pip install matplotlib
    python docs/guide/pictures/oblique.py
"""

import csv
import io
import subprocess
from pathlib import Path

import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot

FOLDER = Path(__file__).parent
PROJECT = FOLDER.parents[2]
BLUE, RED = "#0072b2", "#d55e00"
QUANTITIES = (
    ("e_t", "tangential restitution"),
    ("omega", "spin [rad/s]"),
    ("rebound_angle_centre", "rebound angle [degrees]"),
)


def computed():
    """The columns of the table that the example prints."""
    command = ["cargo", "run", "--quiet", "--release", "--example", "oblique", "--no-default-features"]
    text = subprocess.run(command, cwd=PROJECT, check=True, capture_output=True, text=True).stdout
    rows = list(csv.DictReader(io.StringIO(text)))
    return {name: [float(row[name]) for row in rows] for name in rows[0]}


def measured(quantity):
    """Angles and values of all digitisations."""
    with (PROJECT / "experiment/oblique_elastic.csv").open() as file:
        rows = [row for row in csv.DictReader(file) if row["quantity"] == quantity]
    return [float(row["angle_deg"]) for row in rows], [float(row["value"]) for row in rows]


def main():
    pyplot.rcParams.update({"svg.hashsalt": "brinell", "svg.fonttype": "none", "font.size": 9})
    curves = computed()
    figure, axes = pyplot.subplots(1, 3, figsize=(9, 3), layout="constrained")
    for axis, (quantity, label) in zip(axes, QUANTITIES):
        axis.plot(curves["angle_deg"], curves[quantity], color=BLUE, label="computed")
        axis.plot(*measured(quantity), "o", markersize=3.5, color=RED, fillstyle="none", label="measured")
        axis.set(xlabel="angle of incidence [degrees]", ylabel=label, xlim=(0, 90))
        axis.grid(alpha=0.3)
    axes[0].legend(frameon=False)
    figure.savefig(FOLDER / "oblique.svg", metadata={"Date": None})


main()
