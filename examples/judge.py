"""Common code of the examples with multibody engines: the FMU, the checks, the picture."""

import re
import sys
import tempfile
from pathlib import Path

import brinell
import matplotlib
import numpy as np

matplotlib.use("svg")
from brinell.pictures import save
from matplotlib import animation as movie
from matplotlib import pyplot

FOLDER = Path(__file__).parent
UNITS = tempfile.TemporaryDirectory()
BALANCE = (
    1e-6  # largest error of the energy of an impact, relative to its initial kinetic energy
)


def unit(name, **changes):
    """The FMU of the scene `name` in the folder of the examples, with `changes` of its values."""
    if not changes:
        return brinell.export(FOLDER / f"{name}.toml", Path(UNITS.name) / f"{name}.fmu")
    text = (FOLDER / f"{name}.toml").read_text(encoding="utf-8")
    for key, value in changes.items():
        text, found = re.subn(rf"^{key} = .*$", f"{key} = {value}", text, flags=re.MULTILINE)
        assert found == 1, f"{name}.toml has {found} lines with {key}"
    changed = Path(UNITS.name) / f"{name}.toml"
    changed.write_text(text, encoding="utf-8")
    return brinell.export(changed, changed.with_suffix(".fmu"))


class Balance:
    """Checks that the kinetic energy which the impulse of a contact takes from the bodies of an engine
    equals the change of its elastic and dissipated energy, in every step with a force.

    During an impact the other forces also do work: `acceleration` times the mass over the distance
    that the contact has moved.
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
        """Prints the result, the worst of this and others; ends the example if it is wrong."""
        worst = max(it.worst for it in (self, *others))
        impacts = sum(it.impacts for it in (self, *others))
        print(
            f"balance of energy: {worst:.1e} of the kinetic energy "
            f"in the worst of {impacts} steps with a force"
        )
        if not (impacts and worst <= BALANCE):
            sys.exit(f"the balance errs by more than {BALANCE}")


def total(model, data):
    """Kinetic and potential energy [J] in a model of MuJoCo."""
    import mujoco  # other engines' examples do without it

    mujoco.mj_forward(model, data)
    mujoco.mj_energyPos(model, data)
    mujoco.mj_energyVel(model, data)
    return data.energy.sum()


class Energy:
    """Checks that the kinetic and potential energy in an engine, which `energy()` gives [J], and the
    elastic and dissipated energies of all contacts of an FMU, with friction also its own, have the
    same sum after every step."""

    def __init__(self, energy, contact):
        self.energy, self.contact = energy, contact
        self.start, self.worst = self._now(), 0.0

    def _now(self):
        names = ["elastic_energy", "dissipated_energy"]
        names += ["tangential_energy", "friction_work"] * (self.contact.directions > 0)
        return self.energy() + sum(np.sum(self.contact[name]) for name in names)

    def step(self):
        """To be called after each step."""
        self.worst = max(self.worst, abs(self._now() - self.start))

    def told(self, of, scale, allowed=2e-4):
        """Prints the result over `scale` [J], which `of` names; ends the example if it is wrong."""
        error = self.worst / scale
        print(f"balance of energy: {error:.1e} of the {of} (allowed {allowed:g})")
        if not error <= allowed:
            sys.exit(f"the balance errs by more than {allowed}")


class Total(Energy):
    """The same in a model of MuJoCo."""

    def __init__(self, model, data, contact):
        super().__init__(lambda: total(model, data), contact)


def flight(model, data, seconds, scale):
    """Prints how the energy changes in a free flight by the engine alone, over `scale` [J]: with its
    gravity, and without."""
    import mujoco

    place, spin = data.qpos.copy(), data.qvel.copy()
    for gravity in (model.opt.gravity.copy(), np.zeros(3)):
        model.opt.gravity = gravity
        data.qpos, data.qvel = place, spin
        start, steps = total(model, data), round(seconds / model.opt.timestep)
        for _ in range(steps):
            mujoco.mj_step(model, data)
        error = abs(total(model, data) - start) / scale
        shown = "with" if gravity.any() else "without"
        print(f"the engine's own flight of {seconds} s {shown} gravity: {error:.1e} of that energy")


def alone_in_mujoco(model, data, end, values):
    """Times [s] and the `values()` in steps of MuJoCo alone, with its own contact."""
    import mujoco

    rows = []
    while data.time < end:
        rows.append((data.time, *np.atleast_1d(values())))
        mujoco.mj_step(model, data)
    return np.array(rows).T


def alone(path, height, gravity, mass, end, h):
    """The dropped ball with the FMU alone, in steps of `h` [s]: times [s], heights [m] and speeds
    upwards [m/s]."""
    rows, speed = [(0.0, height, 0.0)], 0.0
    with brinell.Contact(path, initial_gap=height) as contact:
        for step in range(1, round(end / h) + 1):
            force = contact.step(h, speed, gravity)
            speed += h * (gravity - force / mass)
            rows.append((step * h, -contact["indentation"], -speed))
    return np.array(rows).T


def ball(engine, motion, reference, own, error, body="ball"):
    """Judges the dropped `body` and draws it: times [s], heights [m] and speeds [m/s] in the engine and
    with the FMU alone, and times and heights with the engine's own contact. Heights may differ by
    `error` [m]."""
    time, height, speed = motion
    agree("speed, engine against the unit alone [m/s]", speed, reference[2], 1e-9)
    agree("height, engine against the unit alone [m]", height, reference[1], error)
    second_flight(height, own[1])
    picture(
        f"{engine}: a steel {body} bounces, 1 ms steps",
        [
            (time, 1e3 * height, "engine with the unit", "-"),
            (reference[0][::25], 1e3 * reference[1][::25], "the unit alone", "."),
            (own[0], 1e3 * own[1], "the engine's own contact", "--"),
        ],
    )


def second_flight(height, own):
    """Prints the largest height [m] between first and second impact, with the FMU and with an engine's
    own contact; rows are milliseconds apart."""
    unit, engine = (1e3 * rows[150:190].max() for rows in (height, own))
    print(f"second flight: {unit:.2f} mm; by the engine's own contact {engine:.2f} mm")


def agree(name, found, expected, limit):
    """Prints the difference of two results; ends the example if it exceeds `limit`."""
    error = np.max(np.abs(np.asarray(found) - np.asarray(expected)))
    print(f"{name}: {error:.1e} (allowed {limit:g})")
    if not error <= limit:
        sys.exit(f"{name} differs by more than {limit}")


def picture(title, lines, x="time [s]", y="height [mm]"):
    """Draws `lines`, a list of (x, y, label, style), to the file on the command line, if
    there is one."""
    if len(sys.argv) < 2:
        return
    matplotlib.rcParams.update({"font.size": 9, "xtick.bottom": False, "ytick.left": False})
    figure, axes = pyplot.subplots(figsize=(7.2, 3.6), layout="constrained")
    for abscissa, ordinate, label, style in lines:
        # no more points than can be told apart
        every = max(1, len(abscissa) // (700 if "-" in style else 25))
        axes.plot(
            abscissa[::every], ordinate[::every], style, label=label, linewidth=1.1, markersize=3
        )
    axes.set(title=title, xlabel=x, ylabel=y)
    axes.legend(frameon=False)
    axes.grid(alpha=0.3)
    save(figure, sys.argv[1])


def row(path, start, gap, mass, pull, h):
    """Places [m] and speeds [m/s] of a row of balls, 2 ms after those of `start`.

    All contacts move together in steps of `h` [s], with FMUs that do not know the mass."""
    scene = (FOLDER / f"{path.stem}.toml").read_text(encoding="utf-8").split("[coupling]")[0]
    loose = path.with_name("loose.toml")
    loose.write_text(scene, encoding="utf-8")
    unit = brinell.export(loose, path.with_name("loose.fmu"))
    place, speed = np.split(np.array(start), 2)
    contacts = [brinell.Contact(unit, initial_gap=distance) for distance in gap + np.diff(place)]
    # no external forces
    force, mean = np.zeros((2, len(place) + 1))
    for _ in range(round(2e-3 / h)):
        rates, others = -np.diff(speed), np.diff(np.diff(force)) / mass
        for index, contact in enumerate(contacts, start=1):
            mean[index] = contact.step(h, rates[index - 1], others[index - 1])
            force[index] = contact["force"]
        change = h * (pull(place) - np.diff(mean) / mass)
        place += h * (speed + 0.5 * change)
        speed += change
    return place, speed


def blow(name, masses, speeds, end, h):
    """Speeds [m/s] of masses in a row after `end` [s], and the dent [m] of the last contact.

    All contacts of the scene `name` move in steps of `h` [s], with an FMU that does not know the
    masses."""
    tables = (FOLDER / f"{name}.toml").read_text(encoding="utf-8").split("\n\n")
    lines = "\n\n".join(it for it in tables if not it.startswith("[[body]]")).splitlines()
    lines = [line.replace('"closing_speed"', '"mean_force"') for line in lines]
    scene = Path(UNITS.name) / f"loose_{name}.toml"
    loose = "\n".join(line for line in lines if not line.startswith("between"))
    scene.write_text(loose, encoding="utf-8")
    speeds, force = np.array(speeds), np.zeros(len(masses) - 1)
    with brinell.Contact(brinell.export(scene, scene.with_suffix(".fmu"))) as contacts:
        for _ in range(round(end / h)):
            # with the present forces as acceleration
            pull = np.diff(np.diff([0.0, *force, 0.0]) / masses)
            mean = contacts.step(h, -np.diff(speeds), pull)
            speeds -= h * np.diff([0.0, *mean, 0.0]) / masses
            force = contacts["force"]
        return speeds, contacts["residual_indentation"][-1]


def animation(panels, seconds, slower=1.0, still=None, size=9, rate=20):
    """Draws `panels`, a list of (title, strokes), to the second file on the command line,
    if there is one.

    `strokes` contains the points of each stroke at each millisecond: time, stroke, point, (x, y). A
    stroke ends in a ball of `size` [points]; `still` is a line that does not move."""
    if len(sys.argv) < 3:
        return
    ends = np.concatenate([strokes.reshape(-1, 2) for _, strokes in panels])
    (left, low), (right, high) = ends.min(axis=0) - 0.02, ends.max(axis=0) + 0.005
    figure, every = pyplot.subplots(1, len(panels), figsize=(5.6, 2.4), layout="constrained")
    drawn = []
    for axes, (title, strokes) in zip(every, panels, strict=True):
        axes.set(title=title, xlim=(left, right + 0.015), ylim=(low, high))
        axes.set_aspect("equal")
        axes.set_axis_off()
        if still is not None:
            axes.plot(*still.T, color="0.5", linewidth=3)
        lines = [axes.plot([], [], "o-", markevery=[-1], markersize=size)[0] for _ in strokes[0]]
        drawn += [(line, strokes[:, index]) for index, line in enumerate(lines)]

    def draw(frame):
        for line, points in drawn:
            line.set_data(*points[min(round(1e3 * frame / rate / slower), len(points) - 1)].T)

    frames = round(seconds * slower * rate)
    writer = movie.PillowWriter(fps=rate)
    movie.FuncAnimation(figure, draw, frames).save(sys.argv[2], writer, dpi=72)


class Friction:
    """Checks that the kinetic energy which a contact with friction takes from the bodies is what it
    dissipates along the normal and by friction, and what it stores. A subclass gives the kinetic
    energy of the bodies."""

    def __init__(self, contact):
        self.contact, self.start = contact, self.kinetic()
        self.before = self._held()

    def kinetic(self):
        """Kinetic energy of the bodies [J]."""
        raise NotImplementedError

    def _held(self):
        names = ("elastic_energy", "dissipated_energy", "tangential_energy", "friction_work")
        return sum(self.contact[name] for name in names)

    def error(self, work=0.0):
        """Difference of the two, with the `work` of all other forces [J], relative to the kinetic energy at
        the start, or at the end if that is larger."""
        taken = self.start + work - self.kinetic()
        return abs(taken - (self._held() - self.before)) / max(self.start, self.kinetic())

    def told(self, work=0.0, allowed=BALANCE):
        """Prints the result; ends the example if it is wrong."""
        error = self.error(work)
        print(f"balance of energy: {error:.1e} of the kinetic energy")
        if not error <= allowed:
            sys.exit(f"the balance errs by more than {allowed}")


def sunk(path, weight):
    """Indentation [m] under a weight [N], by bisection."""
    low, high = 0.0, 1e-4
    while high - low > 1e-18:
        middle = 0.5 * (low + high)
        with brinell.Contact(path, initial_gap=-middle) as contact:
            low, high = (middle, high) if contact["force"] < weight else (low, middle)
    return low


def footfall(spin, half, slope, length, foot, mass, inertia):
    """The spin [rad/s] of a rigid wheel without a rim above its next foot, if it is `spin` above the
    present one and no foot bounces or slips: it keeps its angular momentum about the foot that hits.

    Spokes of this `length` [m] are 2 `half` [rad] apart, and end in balls of the radius `foot` [m].
    """
    height, side = length * np.cos(half) + foot, length * np.sin(half)
    upright, oblique = inertia + mass * (length + foot) ** 2, inertia + mass * (height**2 + side**2)
    kept = (inertia + mass * (height**2 - side**2)) / oblique
    along = 2.0 * mass * 9.81 * np.sin(slope) * (foot * half + side)
    down = 2.0 * mass * 9.81 * np.cos(slope) * (length + foot - height)
    return np.sqrt(kept**2 * (spin**2 + (along + down) / upright) + (along - down) / upright)
