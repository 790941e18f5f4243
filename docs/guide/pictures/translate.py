"""Draws translate.svg beside this file: restitution over speed of a scene's law, and of other tools with the numbers of
`brinell translate`.

    pip install matplotlib ./python
    python docs/guide/pictures/translate.py
"""

from pathlib import Path

import brinell
import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot

FOLDER = Path(__file__).parent
SCENE = FOLDER.parents[2] / "scenes/mass_known.toml"
WAYS = (
    ("mujoco", "pair", "a spring and a damper: MuJoCo, Bullet, ODE, Simscape ...", "#0072b2"),
    ("drake", "point", "Drake (lagged), RecurDyn", "#d55e00"),
    ("adams", "impact", "Adams, MotionSolve", "#009e73"),
    ("modelica", "elastogap", "Modelica", "#cc79a7"),
    ("mercurydpm", "plastic", "MercuryDPM, LIGGGHTS, Yade: Luding's law", "#e69f00"),
)
RANGE = "0.1:3"


def main():
    matplotlib.rcParams.update({"svg.hashsalt": "brinell", "svg.fonttype": "none", "font.size": 9, "axes.grid": True, "grid.alpha": 0.3})
    figure, axes = pyplot.subplots(figsize=(6.4, 4.2), layout="constrained")
    law = brinell.sweep(SCENE, {"speed": f"{RANGE}:41"})
    axes.plot(law["speed"], law["restitution"], color="black", linewidth=2.5, label="the scene's law")
    for tool, name, label, colour in WAYS:
        promised = brinell.translate(SCENE, tool, speed=RANGE)[name].promised
        axes.plot(promised["speed"], promised["restitution"], "o-", color=colour, markersize=3, linewidth=1, label=label)
    axes.set(xscale="log", xlabel="closing speed [m/s]", ylabel="restitution", ylim=(0, 1))
    axes.set_xticks([0.1, 0.3, 1, 3], ["0.1", "0.3", "1", "3"])
    axes.minorticks_off()
    axes.legend(loc="lower left", fontsize=7.5)
    figure.savefig(FOLDER / "translate.svg", metadata={"Date": None})


if __name__ == "__main__":
    main()
