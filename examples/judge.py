"""What the examples with multibody engines share: the unit, the judgement, the picture."""

import sys
import tempfile
from pathlib import Path

import brinell
import matplotlib
import numpy as np

matplotlib.use("svg")
from matplotlib import pyplot

FOLDER = Path(__file__).parent
UNITS = tempfile.TemporaryDirectory()
BALANCE = (
    1e-6  # largest error of the energy of an impact, over the kinetic energy that it begins with
)


def unit(name):
    """The unit of the scene `name` beside the examples."""
    return brinell.export(FOLDER / f"{name}.toml", Path(UNITS.name) / f"{name}.fmu")


class Balance:
    """Whether the kinetic energy that the impulse of a contact takes from the bodies of an engine
    is what its elastic and dissipated energy change by, in every step in which there is a force.

    During an impact the other forces work, too: `acceleration` times the mass over the way that the
    contact has gone.
    """

    def __init__(self, contact, name=""):
        self.contact, self.prefix = contact, name + "." if name else ""
        self.before, self.impacts, self.worst = self._now(), 0, 0.0

    def _now(self):
        names = ("elastic_energy", "dissipated_energy", "indentation")
        elastic, dissipated, indentation = (self.contact[self.prefix + name] for name in names)
        return np.array([elastic + dissipated, indentation])

    def step(self, h, mass, force, speed, after, acceleration=0.0):
        """To be called after each step of the contact, with its force [N] and the closing speed in
        the engine before and after the impulse [m/s]."""
        stored, way = (now := self._now()) - self.before
        self.before = now
        if force == 0.0:
            return
        end = after + acceleration * h
        taken = 0.5 * mass * (speed - end) * (speed + end) + mass * acceleration * way
        kinetic = 0.5 * mass * max(abs(speed), abs(end), abs(acceleration) * h) ** 2
        self.impacts += 1
        self.worst = max(self.worst, abs(taken - stored) / kinetic)

    def told(self, *others):
        """Prints the result, the worst of this and others; ends the example if it isn't right."""
        worst = max(it.worst for it in (self, *others))
        impacts = sum(it.impacts for it in (self, *others))
        print(
            f"balance of energy: {worst:.1e} of the kinetic energy "
            f"in the worst of {impacts} steps with a force"
        )
        if not (impacts and worst <= BALANCE):
            sys.exit(f"the balance errs by more than {BALANCE}")


def alone(path, height, gravity, mass, end, h):
    """The dropped ball by the unit alone, in steps of `h` [s]: times [s], heights [m] and speeds
    upwards [m/s]."""
    rows, speed = [(0.0, height, 0.0)], 0.0
    with brinell.Contact(path, initial_gap=height) as contact:
        for step in range(1, round(end / h) + 1):
            force = contact.step(h, speed, gravity)
            speed += h * (gravity - force / mass)
            rows.append((step * h, -contact["indentation"], -speed))
    return np.array(rows).T


def ball(engine, motion, reference, own, error):
    """Judges the dropped ball and draws it: times [s], heights [m] and speeds [m/s] in the engine and
    by the unit alone, and times and heights by the engine's own contact. Heights may differ by
    `error` [m]."""
    time, height, speed = motion
    agree("speed, engine against the unit alone [m/s]", speed, reference[2], 1e-9)
    agree("height, engine against the unit alone [m]", height, reference[1], error)
    second_flight(height, own[1])
    picture(
        f"{engine}: a steel ball bounces, 1 ms steps",
        [
            (time, 1e3 * height, "engine with the unit", "-"),
            (reference[0][::25], 1e3 * reference[1][::25], "the unit alone", "."),
            (own[0], 1e3 * own[1], "the engine's own contact", "--"),
        ],
    )


def second_flight(height, own):
    """Prints the largest height [m] between first and second impact, by the unit and by an engine's
    own contact; rows are milliseconds apart."""
    unit, engine = (1e3 * rows[150:190].max() for rows in (height, own))
    print(f"second flight: {unit:.2f} mm; by the engine's own contact {engine:.2f} mm")


def agree(name, found, expected, limit):
    """Prints how far two results are apart; ends the example if it is more than `limit`."""
    error = np.max(np.abs(np.asarray(found) - np.asarray(expected)))
    print(f"{name}: {error:.1e} (allowed {limit:g})")
    if not error <= limit:
        sys.exit(f"{name} differs by more than {limit}")


def picture(title, lines, x="time [s]", y="height [mm]"):
    """Draws `lines`, a list of (x, y, label, style), into the file that the command line names, if
    it names one."""
    if len(sys.argv) < 2:
        return
    matplotlib.rcParams.update({"svg.hashsalt": "brinell", "svg.fonttype": "none", "font.size": 9})
    figure, axes = pyplot.subplots(figsize=(7.2, 3.6), layout="constrained")
    for abscissa, ordinate, label, style in lines:
        # as many points as can be seen
        every = max(1, len(abscissa) // 700)
        axes.plot(
            abscissa[::every], ordinate[::every], style, label=label, linewidth=1.1, markersize=3
        )
    axes.set(title=title, xlabel=x, ylabel=y)
    axes.legend(frameon=False)
    axes.grid(alpha=0.3)
    figure.savefig(sys.argv[1], metadata={"Date": None})
