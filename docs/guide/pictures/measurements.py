"""Draws measurements.svg beside this file: what was measured, and what the law brinell and others say of it.

    pip install matplotlib ./python
    python docs/guide/pictures/measurements.py
"""

import csv
import tempfile
import warnings
from pathlib import Path

import brinell
import matplotlib
import numpy as np

matplotlib.use("svg")
from brinell.pictures import save
from matplotlib import pyplot
from style import STYLE

FOLDER = Path(__file__).parent
EXPERIMENT = FOLDER.parents[2] / "data/experiment"
BLUE, RED, GREEN, GREY = "#0072b2", "#d55e00", "#009e73", "#777777"
KGF_PER_MM2 = 9.80665e6
LAWS = ["brinell", "big-alabo", "stronge", "ma-liu", "johnson", "kogut-etsion", "jackson-green", "thornton"]
DEVICE = """
name = "device"
impactor = {{ radius = "1.5 mm", youngs_modulus = "620 GPa", poissons_ratio = 0.22 }}
impact = {{ mass = "5.45 g", speed = 2.05 }}
target = {{ youngs_modulus = "210 GPa", poissons_ratio = 0.3, {} }}
"""
# radius [mm], mass [g], speed [m/s]
DENTED = """
name = "device"
impactor = {{ radius = "%s mm", youngs_modulus = "620 GPa", poissons_ratio = 0.22 }}
impact = {{ mass = "%s g", speed = %s }}
target = {{ youngs_modulus = "210 GPa", poissons_ratio = 0.3, {} }}
"""
RECORD = """
name = "record"
impactor = {{ radius = "0.5 mm", youngs_modulus = "630 GPa", poissons_ratio = 0.21 }}
target = {{ youngs_modulus = "210 GPa", poissons_ratio = 0.3, yield_strength = {} }}
"""
GLASS = """
name = "glass"
impactor = { radius = "2 mm", youngs_modulus = "208 GPa", poissons_ratio = 0.3 }
target = { youngs_modulus = "96 GPa", poissons_ratio = 0.36, density = 6100, yield_strength = "1.9 GPa" }
law = { loading = "brinell", elastic_restitution = "waves" }
impact = { mass = 2.6e-4, speed = 1.0 }
"""


def table(name):
    """The columns of a table of numbers."""
    lines = (EXPERIMENT / name).read_text().splitlines()
    lines = [line for line in lines if not line.startswith("#")]
    return np.loadtxt(lines[1:], delimiter=",").T


class Scenes:
    """Writes scenes to a folder and predicts their impacts."""

    def __init__(self, folder):
        self.path = Path(folder) / "scene.toml"

    def __call__(self, text):
        self.path.write_text(text)
        return self.path


def slow(vickers):
    return f'hardness = "{vickers} HV10", rate = {{ model = "johnson-cook", c = 0.0 }}'


def third(vickers):
    return f"yield_strength = {vickers * KGF_PER_MM2 / 3.0}"


def at_rate(vickers):
    return f'hardness = "{vickers} HV10"'


WAYS = (("HV/3", ":", third), ("from HV, slow", "--", slow), ("from HV, at its rate", "-", at_rate))


def rebounds(axes, scenes):
    """Restitution over hardness, measured and by three strengths."""
    restitution, vickers = table("leeb_restitution.csv")
    axes.fill_between(vickers, restitution - 0.012, restitution + 0.012, color=GREY, alpha=0.35, label="measured, +-0.012")
    for label, style, strength in WAYS:
        said = [brinell.predict(scenes(DEVICE.format(strength(number)))).restitution for number in vickers]
        axes.plot(vickers, said, style, color=BLUE, label=label)
    axes.set(xlabel="Vickers hardness [HV]", ylabel="restitution", title="rebounds of device D, law brinell")
    axes.legend(frameon=False, fontsize=7)


def other_laws(axes, scenes):
    """Errors of other laws with the same strength."""
    restitution, vickers = table("leeb_restitution.csv")
    axes.fill_between(vickers, -1.2 / restitution, 1.2 / restitution, color=GREY, alpha=0.35, label="measured, +-0.012")
    predictions = [brinell.predict(scenes(DEVICE.format(at_rate(number))), laws=LAWS) for number in vickers]
    for index, law in enumerate(LAWS):
        said = np.array([laws[index].restitution for laws in predictions])
        style = {"linewidth": 2.5, "color": BLUE} if law == "brinell" else {"linewidth": 1.0}
        axes.plot(vickers, 100.0 * (said / restitution - 1.0), label=law, **style)
    axes.set(xlabel="Vickers hardness [HV]", ylabel="error of the restitution [%]", title="other laws, same strength", ylim=(-45, 85))
    axes.legend(frameon=False, fontsize=7, ncols=2, columnspacing=1, handlelength=1.5, loc="upper right")


def dents(depths, diameters, scenes):
    """Printed dents over hardness, and those by two strengths."""
    with (EXPERIMENT / "leeb_dents.csv").open() as file:
        rows = [row for row in csv.DictReader(file) if row["device"] in ("D", "G")]
    for device, color in (("D", BLUE), ("G", GREEN)):
        own = [row for row in rows if row["device"] == device]
        row = own[0]
        text = DENTED % (0.5 * float(row["ball_diameter_mm"]), row["mass_g"], row["speed_m_s"])
        printed = np.array([[float(row[name]) for row in own] for name in ("vickers_hardness", "dent_depth_um", "dent_diameter_mm")])
        depths.plot(printed[0], printed[1], "o", color=color, label=f"{device}, printed")
        diameters.plot(printed[0], 1e3 * printed[2], "o", color=color, label=f"{device}, printed")
        hardness = np.linspace(printed[0, 0], printed[0, -1], 15)
        for label, style, strength in (WAYS[0], WAYS[2]):
            said = [brinell.predict(scenes(text.format(strength(number)))) for number in hardness]
            depths.plot(hardness, [1e6 * one.dent for one in said], style, color=color, label=f"{device}, {label}")
            diameters.plot(hardness, [2e6 * one.largest_contact_radius for one in said], style, color=color)
    depths.set(xlabel="Vickers hardness [HV]", ylabel="depth of the dent [um]", title="dents: depth", ylim=(0, 85))
    diameters.set(xlabel="Vickers hardness [HV]", ylabel="diameter [um]", title="dents: diameter", ylim=0)
    depths.legend(frameon=False, fontsize=7)


def branches(columns):
    """Force and depth [um] of the loading and of the unloading that a curve begins with."""
    depth, force = 1e6 * np.asarray(columns["indentation"]), np.asarray(columns["force"])
    top = np.argmax(np.diff(depth) < 0.0)
    bottom = top + np.argmax(np.diff(depth[top:]) > 0.0)
    return (force[: top + 1], depth[: top + 1]), (force[top : bottom + 1][::-1], depth[top : bottom + 1][::-1])


def record(axes, scenes):
    """What the best fit of each law leaves of the record of an indentation: strength, zero point and compliance are free."""
    # to the end of the first unloading
    depth, force = table("indentation_record.csv")[:, :44]
    last = np.argmax(force)

    def left_over(law, strength):
        scene = scenes(RECORD.format(strength))
        loading, _ = branches(brinell.curve(scene, laws=[law], to=75e-6))
        # a curve first loads to two thirds of its end
        largest = np.interp(force[last], *loading)
        loading, unloading = branches(brinell.curve(scene, laws=[law], to=1.5e-6 * largest))
        said = np.concatenate([np.interp(force[: last + 1], *loading), np.interp(force[last + 1 :], *unloading)])
        rest = depth - said
        return rest - np.polyval(np.polyfit(force, rest, 1), force)

    for law in ("brinell", "big-alabo", "ma-liu", "jackson-green", "kogut-etsion"):
        fits = [left_over(law, strength) for strength in np.geomspace(600e6, 1500e6, 50)]
        best = min(fits, key=lambda rest: np.sum(rest**2))
        style = {"linewidth": 2.5, "color": BLUE} if law == "brinell" else {"linewidth": 1.0}
        (line,) = axes.plot(force[: last + 1], best[: last + 1], label=law, **style)
        axes.plot(force[last:], best[last:], ":", color=line.get_color())
    axes.set(xlabel="force [N] (dotted: unloading)", ylabel="recorded depth - fit [um]", title="start of an indentation", ylim=(-0.6, 0.9))
    axes.legend(frameon=False, fontsize=7, ncols=2)


def metallic_glass(axes, scenes):
    """Restitution over speed, and what elastic waves take."""
    speed, restitution = table("rebounds_on_metallic_glass.csv")
    axes.plot(speed, restitution, "o", color=RED, label="measured")
    speeds = np.linspace(0.1, 1.2, 12)
    axes.plot(speeds, [brinell.predict(scenes(GLASS), speed=value).restitution for value in speeds], color=BLUE, label="elastic waves")
    axes.set(xlabel="speed [m/s]", ylabel="restitution", title="steel on metallic glass", ylim=(0.992, 1.0))
    axes.legend(frameon=False, fontsize=7)


def main():
    pyplot.rcParams.update(STYLE)
    figure, axes = pyplot.subplots(3, 2, figsize=(6.4, 8.4), layout="constrained")
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        # the ends of some curves are beyond every law
        warnings.simplefilter("ignore", brinell.ProgramWarning)
        scenes = Scenes(folder)
        rebounds(axes[0, 0], scenes)
        other_laws(axes[0, 1], scenes)
        record(axes[2, 0], scenes)
        dents(axes[1, 0], axes[1, 1], scenes)
        metallic_glass(axes[2, 1], scenes)
    save(figure, FOLDER / "measurements.svg")


main()
