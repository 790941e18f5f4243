"""Impacts by the laws of other tools, written here from their documentation and independent of the program."""

import json
import os
import re
import subprocess
from collections import namedtuple

import numpy as np
from pytest import approx
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq
from units import SCENES

SCENE = SCENES / "mass_known.toml"
PHASES = (np.arange(20) + 0.5) / 20


class Stays(AssertionError):
    """A ball that is damped so much that it doesn't leave the flat."""


Ball = namedtuple("Ball", "scene radius mass speed")
STEEL = "bearing steel 52100, hardened"
# the usual ball, one that loses little, a small one, and one that loses hardly anything: materials, radius, mass, speed
BALLS = {
    "mild": None,
    "aluminium": (STEEL, "aluminium 6061-T6", 8e-3, 16.8e-3, 1.5),
    "bronze": ("bearing bronze C932", "mild steel", 1e-3, 37e-6, 0.5),
    "hard": (STEEL, "steel AISI 4340, tempered at 205 C", 5e-3, 4.1e-3, 2.0),
}
# a ball, with a step of the tool
BALLS_AND_STEPS = [*((name, None) for name in BALLS), ("mild", "1e-4")]


def ball_of(folder, name):
    """A ball on a flat, with its scene."""
    if BALLS[name] is None:
        return Ball(SCENE, 5e-3, 4e-3, 1.0)
    impactor, target, radius, mass, speed = BALLS[name]
    scene = folder / f"{name}.toml"
    scene.write_text(
        f'name = "{name}"\nimpactor = {{ radius = {radius}, material = "{impactor}" }}\n'
        f'target = {{ material = "{target}" }}\nimpact = {{ mass = {mass}, speed = {speed} }}\n',
        encoding="utf-8",
    )
    return Ball(scene, radius, mass, speed)


def two_spheres(folder):
    """Two equal free spheres that meet, with their scene; the mass is that of each."""
    scene = folder / "spheres.toml"
    scene.write_text(
        f'name = "spheres"\nimpactor = {{ radius = 1.5e-3, material = "{STEEL}" }}\n'
        'target = { material = "stainless steel 304", radius = 1.5e-3 }\n'
        "impact = { mass = 55.35e-6, speed = 1.0 }\n",
        encoding="utf-8",
    )
    return Ball(scene, 1.5e-3, 110.7e-6, 1.0)


def promised_at(way, speed):
    """What a way promises at a speed of its table."""
    at = int(np.argmin(np.abs(way.promised["speed"] - speed)))
    assert abs(way.promised["speed"][at] / speed - 1) < 1e-9
    return {name: column[at] for name, column in way.promised.items()}


def compare(way, speed, rebounds, tolerance):
    """That rebounds at the phases have mean, least and largest value as a way promises."""
    promise = promised_at(way, speed)
    assert np.mean(rebounds) == approx(promise["restitution"], abs=tolerance)
    assert np.min(rebounds) == approx(promise["least_restitution"], abs=2 * tolerance)
    assert np.max(rebounds) == approx(promise["most_restitution"], abs=2 * tolerance)


def step_function(x, width):
    y = min(max(x / width, 0.0), 1.0)
    return y * y * (3 - 2 * y)


def reduced(young, poisson=0.3):
    """E* of two equal bodies."""
    return young / (2 * (1 - poisson**2))


def beta(restitution):
    """The damping ratio that DEM codes derive from a typed restitution."""
    return -np.log(restitution) / np.hypot(np.pi, np.log(restitution))


def hertz(stiffness, restitution, mass):
    """4/3 E* sqrt(R) x^1.5 with the damping 2 sqrt(5/6) beta sqrt(m S), S = 3/2 F/x."""

    def force(x, w):
        slope = 1.5 * stiffness * np.sqrt(x)
        return stiffness * x**1.5 + 2 * np.sqrt(5 / 6) * beta(restitution) * np.sqrt(mass * slope) * w

    return force


def law_of_tool(tool, name, numbers, radius, mass, speed):
    """The force of a tool's law over overlap and closing speed with the numbers as typed, and whether it may pull."""
    get = numbers.get
    match (tool, name):
        case ("modelica", _):

            def force(x, w):
                # below zero the contact is over: the force of the tool is zero from there on
                spring = get("stiffness") * x ** get("exponent")
                return spring + min(get("damping") * w, spring)

            return force, False
        case ("adams" | "motionsolve", _):

            def force(x, w):
                damping = get("damping") * step_function(x, get("ramp"))
                return get("stiffness") * x ** get("exponent") + damping * w

            return force, False
        case ("simscape", _) | ("lammps", "hooke"):
            return lambda x, w: get("stiffness") * x + get("damping") * w, False
        case ("mercurydpm", "linear"):
            return lambda x, w: get("stiffness") * x + get("damping") * w, True
        case ("exudyn", "damping"):
            return lambda x, w: get("stiffness") * x + get("damping") * w, True
        case ("exudyn", "hunt-crossley"):
            factor = 1.5 * (1 - get("hunt_crossley_restitution")) / speed
            return lambda x, w: get("stiffness") * x ** get("exponent") * (1 + factor * w), False
        case ("chrono", "flores"):
            stiffness = 4 / 3 * reduced(get("youngs_modulus")) * np.sqrt(radius)
            e = get("flores_restitution")
            return lambda x, w: stiffness * x**1.5 * (1 + 8 * (1 - e) / (5 * e * speed) * w), False
        case ("exudyn", _):
            e = get("impact_model_restitution")
            chi = 1.5 * (1 - e) * (11 - e) / (1 + 9 * e) if e > 1 / 3 else (1 - e * e) / e
            return (lambda x, w: get("stiffness") * x ** get("exponent") * (1 + chi * w / speed), False)
        case ("recurdyn", _):

            def force(x, w):
                n = get("exponent")
                return get("stiffness") * x**n + get("indentation_damping") * np.sign(w) * abs(w) * x**n

            return force, False
        case ("chrono", "hooke"):
            return lambda x, w: get("stiffness") * x + mass * get("damping_per_mass") * w, False
        case ("newton", "semi-implicit"):
            return lambda x, w: get("stiffness") * x + get("damping") * max(w, 0.0), False
        case ("newton", "mujoco-solver"):
            # solref = (2/kd, kd/(2 sqrt(ke)))
            time, ratio = (
                2 / get("damping_per_mass"),
                get("damping_per_mass") / (2 * np.sqrt(get("stiffness_per_mass"))),
            )
            return lambda x, w: mass * (2 / time * w + x / (time * ratio) ** 2), False
        case ("mujoco", _):
            time, ratio = get("time_constant"), get("damping_ratio")
            return lambda x, w: mass * (2 / time * w + x / (time * ratio) ** 2), False
        case ("chrono" | "lammps", "hertz"):
            stiffness = 4 / 3 * reduced(get("youngs_modulus")) * np.sqrt(radius)
            return hertz(stiffness, get("typed_restitution"), mass), False
        case ("liggghts", "hooke"):
            # from a modulus and the velocity 1 m/s
            product = np.sqrt(radius) * reduced(get("hooke_modulus"))
            stiffness = 16 / 15 * product * (15 * mass / (16 * product)) ** 0.2
            ratio = beta(get("pulling_restitution"))
            return lambda x, w: stiffness * x + 2 * ratio * np.sqrt(mass * stiffness) * w, True
        case ("liggghts", _):
            stiffness = 4 / 3 * reduced(get("youngs_modulus")) * np.sqrt(radius)
            return hertz(stiffness, get("pulling_restitution"), mass), True
        case ("yade", _):
            stiffness = 4 / 3 * reduced(get("sphere_youngs_modulus")) * np.sqrt(radius / 2)

            def force(x, w):
                return (
                    stiffness * x**1.5 + 2 * get("damping_fraction") * np.sqrt(mass * 1.5 * stiffness * np.sqrt(x)) * w
                )

            return force, False
    raise AssertionError((tool, name))


def unloaded_steeper(numbers, mass, speed):
    """An impact by Exudyn's plasticity ratio, from energies: loading k x^n, unloading k/(1 - p) (x^n - p xm^n)."""
    k, n, p = (numbers[name] for name in ("stiffness", "exponent", "plasticity_ratio"))
    depth = (0.5 * (n + 1) * mass * speed**2 / k) ** (1 / (n + 1))

    def energy(x):
        """What the way back from the depth to x has set free."""
        free = (depth ** (n + 1) - x ** (n + 1)) / (n + 1) - p * depth**n * (depth - x)
        return k / (1 - p) * free

    def time(energy, end):
        # x = depth (1 - s^2): the speed is in proportion to s at the turning point
        def one(s):
            return 2 * depth * s / np.sqrt(2 / mass * energy(depth * (1 - s * s)))

        return quad(one, 0, np.sqrt(1 - end), epsabs=0, epsrel=1e-10)[0]

    end = p ** (1 / n)
    loading = time(lambda x: k / (n + 1) * (depth ** (n + 1) - x ** (n + 1)), 0.0)
    return {
        "restitution": np.sqrt(2 / mass * energy(end * depth)) / speed,
        "contact_time": loading + time(energy, end),
        "depth": depth,
        "largest_force": k * depth**n,
    }


def outcome_of(tool, name, numbers, radius, mass, speed, patience=1000):
    """An impact by the law of a tool, without errors of a step. `patience` is how many times as long as its way in a ball may take."""
    if (tool, name) == ("exudyn", "plastic"):
        return unloaded_steeper(numbers, mass, speed)
    force, pulls = law_of_tool(tool, name, numbers, radius, mass, speed)
    if name == "impact":
        # its damping falls faster than its spring, so that the surface lets go and grips again
        return touched(lambda x, w: max(force(x, w), 0.0), True, mass, speed, patience)
    return touched(force, pulls, mass, speed, patience)


def touched(force, pulls, mass, speed, patience=1000):
    """An impact without errors of a step."""
    times = []

    def slope(_, y):
        return [y[1], -force(max(y[0], 0.0), y[1]) / mass]

    def over(_, y):
        # a moment after the touch
        return y[0] if pulls or y[0] <= 0 else force(y[0], y[1]) if y[1] < 0 else 1.0

    over.terminal, over.direction = True, -1

    def turns(_, y):
        return y[1]

    guess = solve_ivp(slope, (0, 1), [0.0, speed], events=turn_only(turns), rtol=1e-9, atol=1e-16)
    half = guess.t_events[0][0]
    run = solve_ivp(
        slope,
        (0, patience * half),
        [0.0, speed],
        events=[over, turns],
        rtol=1e-11,
        atol=[1e-18, 1e-12],
        max_step=half / 100,
    )
    if not run.t_events[0].size:
        raise Stays("the contact does not end")
    forces = np.array([force(max(x, 0.0), w) for x, w in run.y.T])
    times = run.t
    at = int(np.argmax(forces))
    peak = forces[at]
    if 0 < at < len(forces) - 1:
        # on the parabola through the three largest
        bend = np.polyfit(times[at - 1 : at + 2] - times[at], forces[at - 1 : at + 2], 2)
        peak = max(peak, bend[2] - bend[1] ** 2 / (4 * bend[0]) if bend[0] < 0 else peak)
    return {
        "restitution": -run.y_events[0][0][1] / speed,
        "contact_time": run.t_events[0][0],
        "depth": run.y_events[1][0][0],
        "largest_force": peak,
    }


def turn_only(turns):
    def event(t, y):
        return turns(t, y)

    event.terminal, event.direction = True, -1
    return event


def stepped(tool, name, numbers, radius, mass, speed, step, phase):
    """An impact by the recursion of a tool."""
    move = mover(tool, name, numbers, radius, mass, speed, step)
    x, w = -phase * step * speed, speed
    count, depth, most = 0, 0.0, 0.0
    for _ in range(100_000):
        x, w, force = move(x, w, depth)
        if force != 0.0:
            count, most = count + 1, max(most, force)
        elif count and w <= 0.0:
            break
        depth = max(depth, x)
    return {"restitution": -w / speed, "contact_time": count * step, "depth": depth, "largest_force": most}


def mover(tool, name, numbers, radius, mass, speed, step):
    """One step of a tool: overlap and closing speed before -> after, and the force."""
    k, c = numbers.get("stiffness"), numbers.get("damping")
    if tool == "gazebo":
        # two equal surfaces: in series, and summed
        k, c = 1 / (2 / numbers["twice_stiffness"]), 2 * numbers["half_damping"]
    if tool in ("ode", "gazebo"):
        erp, cfm = step * k / (step * k + c), 1 / (step * k + c)
        if tool == "ode":
            erp, cfm = numbers["erp"], numbers["cfm"]

        def move(x, w, _):
            force = max((erp * x / step + w) / (cfm + step / mass), 0.0) if x > 0 else 0.0
            w -= step * force / mass
            return x + step * w, w, force

        return move
    if tool == "physx" or name == "sap":
        c = k * numbers["relaxation_time"] if name == "sap" else c

        def move(x, w, _):
            # the force of the step's end; PhysX begins in the step that would end in overlap
            touches = x > 0 or (tool == "physx" and x + step * w > 0)
            hard = step * k + c
            force = max((k * x + hard * w) / (1 + step * hard / mass), 0.0) if touches else 0.0
            w -= step * force / mass
            return x + step * w, w, force

        return move
    if tool == "bullet":
        erp, cfm = step * k / (step * k + c), 1 / (step * k + c)

        def move(x, w, _):
            # the impulse; a gap that is not yet closed counts in full
            wanted = w + (erp * x / step if x > 0 else x / step)
            impulse = max(wanted / (1 / mass + cfm / step), 0.0)
            w -= impulse / mass
            return x + step * w, w, impulse / step

        return move
    if tool == "drake":
        d = numbers["dissipation"]

        def move(x, w, _):
            if x <= 0:
                return x + step * w, w, 0.0

            def law(end):
                return k * max(x + step * end, 0.0) * max(1 + d * end, 0.0)

            end = brentq(
                lambda end: end - w + step * law(end) / mass,
                # a force that has almost gone is less than their rounding
                w - step * law(w) / mass - 1e-14,
                w + 1e-14,
                xtol=1e-15,
                rtol=1e-14,
            )
            return x + step * end, end, law(end)

        return move
    if (tool, name) == ("yade", "luding"):
        return late_mover(numbers, radius, mass, step)
    if name in ("plastic", "luding"):
        k1 = numbers["loading_stiffness"]
        k2 = numbers["unloading_stiffness"] if name == "plastic" else k1 * numbers["stiffness_ratio"]
        limit = k2 / (k2 - k1) * numbers["penetration_depth"] * 2 * radius

        def move(x, w, deepest):
            deepest = max(deepest, x)
            slope = k1 + (k2 - k1) * min(deepest / limit, 1.0)
            if deepest >= limit:
                line = k2 * (x - limit) + k1 * limit
            else:
                line = min(k1 * x, slope * (x - deepest) + k1 * deepest)
            force = 0.0 if x <= 0 else max(line, 0.0)
            w -= step * force / mass
            return x + step * w, w, force

        return move
    if name == "thornton-ning":
        return summing_mover(numbers, radius, mass, step)
    if name == "mdr":
        return plastic_mover(numbers, radius, mass, step)
    force_of, pulls = law_of_tool(tool, name, numbers, radius, mass, speed)

    def move(x, w, _):
        force = force_of(x, w) if x > 0 else 0.0
        force = force if pulls else max(force, 0.0)
        w -= step * force / mass
        return x + step * w, w, force

    return move


def late_mover(numbers, radius, mass, step):
    """One step of Luding's law between equal spheres in Yade, where the slope k2 is that of the step before."""
    k1, kp = numbers["loading_stiffness"], numbers["unloading_stiffness"]
    plastic = numbers["sphere_penetration_depth"] * radius
    limit = kp / (kp - k1) * plastic
    largest, zero = [0.0], [0.0]

    def move(x, w, _):
        force = 0.0
        if x > 0:
            k2 = k1 + (kp - k1) * min(largest[0] / limit, 1.0)
            if x > largest[0]:
                largest[0] = x
                zero[0] = min((1 - k1 / k2) * x, plastic)
            line = k2 * (x - zero[0])
            force = k1 * x if line >= k1 * x and x < limit else max(line, 0.0)
        w -= step * force / mass
        return x + step * w, w, force

    return move


def plastic_mover(numbers, radius, mass, step, poisson=0.3):
    """One step of an elastoplastic sphere of Zunker and Kamrin (2024) on a rigid flat."""
    young, strength = numbers["youngs_modulus"], numbers["yield_strength"]
    plane, shear = young / (1 - poisson**2), young / (2 * (1 + poisson))
    yielded = []

    def indenter(depth, height, width):
        t = min(max(depth / height, 0.0), 1.0)
        return plane * height * width / 4 * (np.arccos(1 - 2 * t) - (1 - 2 * t) * np.sqrt(4 * t - 4 * t * t))

    def law(x, deepest):
        mean = strength * (1 + 1.75 * np.exp(-4.4 * deepest / radius))
        hertz = 4 * plane * np.sqrt(max(x, 0.0) / radius) / (3 * np.pi)
        if not yielded and x >= deepest and hertz > mean:
            yielded.append(x)
        if not yielded:
            return indenter(x, 4 * radius, 2 * radius)
        first = yielded[0]
        a = np.sqrt(2 * deepest * radius - deepest**2 + first**2 - first * radius)
        height, width = 4 * mean / plane * a, 2 * a
        elastic = height / 2
        z = radius - (deepest - elastic)
        h = np.hypot(a, z)
        largest = np.pi * a**2 * mean
        moved = 2 * a**2 * (poisson - 1) - (2 * poisson - 1) * z * (h - z)
        moved *= largest / (2 * np.pi * a**2 * shear * h)
        return indenter((x - deepest + elastic + moved) / (1 + moved / elastic), height, width)

    def move(x, w, deepest):
        force = law(x, max(deepest, x)) if x > 0 else 0.0
        w -= step * force / mass
        return x + step * w, w, force

    return move


def summing_mover(numbers, radius, mass, step):
    """One step of Thornton's and Ning's sphere without adhesion in LIGGGHTS, which sums up increments of the force."""
    modulus = reduced(numbers["youngs_modulus"])
    at_yield = numbers["yield_ratio"] * radius
    last, yielded = [0.0, 0.0], []

    def move(x, w, deepest):
        force = 0.0
        if x > 0:
            contact = np.sqrt(radius * x)
            if x >= deepest and contact >= at_yield:
                yielded.append(x)
            if x >= deepest and yielded:
                contact = at_yield
            force = max(last[1] + 2 * modulus * contact * (x - last[0]), 0.0)
            last[:] = x, force
        w -= step * force / mass
        return x + step * w, w, force

    return move


def rebounds_in_node(script, asked):
    """What a script says in Node.js, in the folder of its package: the restitution at each phase of the touch."""
    run = subprocess.run(
        ["node", "--input-type=module", "-e", script, json.dumps(asked)],
        cwd=os.environ["BRINELL_TEST_NPM"],
        capture_output=True,
        text=True,
        check=False,
    )
    found = re.search(r"^rebounds (.*)$", run.stdout, re.MULTILINE)
    assert found, run.stdout[-2000:] + run.stderr[-2000:]
    return json.loads(found[1])
