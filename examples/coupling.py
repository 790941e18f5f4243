"""Ways to couple a contact with a mass that the importer moves: the error of each over the steps per contact.

    pip install fmpy numpy
    brinell export scenes/coupled.toml
    brinell export scenes/mass_known.toml
    brinell predict scenes/coupled.toml --json > impact.json
    python examples/coupling.py coupled.fmu mass_known.fmu impact.json

One impact of a sphere, in every way. The error of the restitution against the energy balance depends on where in a step the
bodies meet. It is the root mean square over several such positions, all in the second step: a prediction needs a step before.
"""
import json
import math
import shutil
import sys
import time
from ctypes import c_double, c_int
from dataclasses import dataclass

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave, fmi2ValueReference

STEPS_PER_CONTACT = [2**power for power in range(1, 13)]
PLACES = 8


@dataclass
class Impact:
    """The prediction of the energy balance; `brinell predict SCENE --json` prints it."""

    mass: float  # kg
    speed: float  # m/s
    restitution: float
    contact_time: float  # s

    @staticmethod
    def read(path):
        with open(path, encoding="utf-8") as file:
            prediction = json.load(file)
        law = prediction["laws"][0]
        contact_time = law["loading_time"] + law["unloading_time"]
        return Impact(prediction["mass"], prediction["speed"], law["restitution"], contact_time)


class Unit:
    """One instance, with a counter of calls."""

    def __init__(self, path):
        description = read_model_description(path)
        self.folder = extract(path)
        self.reference = {variable.name: variable.valueReference for variable in description.modelVariables}
        self.slave = FMU2Slave(guid=description.guid, unzipDirectory=self.folder, instanceName="contact",
                               modelIdentifier=description.coSimulation.modelIdentifier)
        self.slave.instantiate()
        self.calls, self.time = 0, 0.0
        # arrays are created once, so that they do not count in the time of a call
        self._vr = {name: (fmi2ValueReference * 1)(reference) for name, reference in self.reference.items()}
        self._rates = (fmi2ValueReference * 2)(*[self.reference["indentation_rate"]] * 2)
        self._forces = (fmi2ValueReference * 2)(*[self.reference["force"]] * 2)
        self._orders = (c_int * 2)(1, 2)
        self._value, self._values = (c_double * 1)(), (c_double * 2)()

    def start(self, **parameters):
        """Return to the start, with these parameters."""
        self.slave.reset()
        self.slave.setupExperiment(startTime=0.0)
        self.slave.enterInitializationMode()
        for name, value in parameters.items():
            self.slave.setReal([self.reference[name]], [value])
        self.slave.exitInitializationMode()
        self.calls, self.time = 0, 0.0

    def set_rate(self, rate, *derivatives):
        """The closing speed [m/s] at the start of the next step, and its derivatives in it."""
        self._value[0] = rate
        self.slave.fmi2SetReal(self.slave.component, self._vr["indentation_rate"], 1, self._value)
        self.calls += 1
        if derivatives:
            count = len(derivatives)
            self._values[:count] = derivatives
            self.slave.fmi2SetRealInputDerivatives(self.slave.component, self._rates, count, self._orders, self._values)
            self.calls += 1

    def get(self, name):
        self.slave.fmi2GetReal(self.slave.component, self._vr[name], 1, self._value)
        self.calls += 1
        return self._value[0]

    def force_derivatives(self):
        """dF/dt and d2F/dt2 at the end of the last step."""
        self.slave.fmi2GetRealOutputDerivatives(self.slave.component, self._forces, 2, self._orders, self._values)
        self.calls += 1
        return self._values[0], self._values[1]

    def step(self, step):
        self.slave.fmi2DoStep(self.slave.component, self.time, step, True)
        self.calls += 1
        self.time += step

    def close(self):
        self.slave.terminate()
        self.slave.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)


# Each way takes an FMU whose sphere is just above the surface, and returns the speed of the rebound [m/s]. `speed` is the
# closing speed; at the end it is negative, and the force is zero.

def parallel(unit, mass, speed, step):
    """All FMUs step at once: the force on the bodies is that at the start of the step."""
    force = 0.0
    while force > 0.0 or speed > 0.0:
        unit.set_rate(speed)
        unit.step(step)
        speed -= step * force / mass
        force = unit.get("force")
    return -speed


def predicted(unit, mass, speed, step):
    """All FMUs step at once, with the force that the contact predicts for the end of the step, read after its rate is set."""
    force = 0.0
    while force > 0.0 or speed > 0.0:
        unit.set_rate(speed)
        expected = unit.get("predicted_force")
        unit.step(step)
        force = unit.get("force")
        speed -= step * expected / mass
    return -speed


def predicted_early(unit, mass, speed, step):
    """The same by an importer that reads all outputs before it sets any input: the prediction uses the old rate."""
    force = expected = 0.0
    while force > 0.0 or speed > 0.0:
        unit.set_rate(speed)
        unit.step(step)
        speed -= step * expected / mass
        expected, force = unit.get("predicted_force"), unit.get("force")
    return -speed


def serial(unit, mass, speed, step):
    """First the contact, then the bodies with its new force: the leap-frog method."""
    force = 0.0
    while force > 0.0 or speed > 0.0:
        unit.set_rate(speed)
        unit.step(step)
        force = unit.get("force")
        speed -= step * force / mass
    return -speed


def verlet(unit, mass, speed, step):
    """Velocity Verlet: the speed at the middle of the step goes in; half of each force acts before and after."""
    force = 0.0
    while force > 0.0 or speed > 0.0:
        middle = speed - 0.5 * step * force / mass
        unit.set_rate(middle)
        unit.step(step)
        force = unit.get("force")
        speed = middle - 0.5 * step * force / mass
    return -speed


def derivatives(unit, mass, speed, step):
    """Acceleration and jerk go in as input derivatives; the mean force over the step comes out."""
    force = slope = 0.0
    while force > 0.0 or speed > 0.0:
        unit.set_rate(speed, -force / mass, -slope / mass)
        unit.step(step)
        speed -= step * unit.get("mean_force") / mass
        force = unit.get("force")
        slope, _ = unit.force_derivatives()
    return -speed


def derivatives_of_both(unit, mass, speed, step):
    """As before, with the second derivative of the force included in the jerk: the step ends where a polynomial of one
    degree more would."""
    force = slope = curvature = 0.0
    while force > 0.0 or speed > 0.0:
        unit.set_rate(speed, -force / mass, -(slope + 0.25 * step * curvature) / mass)
        unit.step(step)
        speed -= step * unit.get("mean_force") / mass
        force = unit.get("force")
        slope, curvature = unit.force_derivatives()
    return -speed


def rollback(unit, mass, speed, step):
    """With acceleration and jerk, but the step is repeated until the polynomial of the speed ends at the speed that the force gives."""
    force = slope = 0.0
    state = unit.slave.getFMUstate()
    while force > 0.0 or speed > 0.0:
        unit.slave.fmi2GetFMUstate(unit.slave.component, state)
        start, jerk = unit.time, -slope / mass
        unit.calls += 1
        for trial in range(30):
            if trial > 0:
                unit.slave.setFMUstate(state)
                unit.time = start
                unit.calls += 1
            unit.set_rate(speed, -force / mass, jerk)
            unit.step(step)
            end = speed - step * unit.get("mean_force") / mass
            change = 2.0 * (end - speed + step * force / mass) / step**2 - jerk
            if abs(change) * step**2 < 1e-13 * abs(speed):
                break
            jerk += change
        speed = end
        force = unit.get("force")
        slope, _ = unit.force_derivatives()
    unit.slave.freeFMUstate(state)
    return -speed


def mass_known(unit, mass, speed, step):
    """The FMU moves the mass itself within the step."""
    force = 0.0
    while force > 0.0 or speed > 0.0:
        unit.set_rate(speed)
        unit.step(step)
        speed -= step * unit.get("mean_force") / mass
        force = unit.get("force")
    return -speed


WAYS = {
    "parallel, force one step late": parallel,
    "parallel, `predicted_force` read before the rate is set": predicted_early,
    "parallel, `predicted_force`": predicted,
    "serial (leap-frog)": serial,
    "velocity Verlet": verlet,
    "input derivatives, `mean_force`": derivatives,
    "the same, and the second derivative of `force`": derivatives_of_both,
    "input derivatives with rollback": rollback,
    "mass known": mass_known,
}


def first_root(polynomial, step):
    """The first time within `step` [s] at which the `polynomial` of the time is 0."""
    roots = np.roots(polynomial)
    real = roots[abs(roots.imag) <= 1e-9 * step].real
    return min(root for root in real if 0.0 <= root <= step * (1.0 + 1e-9))


def contact_time(unit, impact, step, place):
    """The duration of the contact [s] by input derivatives: the times at which the polynomials of the importer pass the
    surface and the dent."""
    unit.start(initial_gap=place * impact.speed * step)
    speed, began = impact.speed, None
    force = slope = curvature = 0.0
    while True:
        before, start = unit.get("indentation"), unit.time
        acceleration, jerk = -force / impact.mass, -(slope + 0.25 * step * curvature) / impact.mass
        unit.set_rate(speed, acceleration, jerk)
        unit.step(step)
        after, dent = unit.get("indentation"), unit.get("residual_indentation")
        motion = [jerk / 6.0, acceleration / 2.0, speed]
        if began is None and after > 0.0:
            began = start + first_root([*motion, before], step)
        elif began is not None and after <= dent:
            return start + first_root([*motion, before - dent], step) - began
        speed -= step * unit.get("mean_force") / impact.mass
        force = unit.get("force")
        slope, curvature = unit.force_derivatives()


def error(way, unit, impact, steps_per_contact, places=PLACES):
    """Relative error of the restitution (root mean square over the positions of first contact within a step), and calls
    and time [s] of one impact."""
    step = impact.contact_time / steps_per_contact
    errors, calls, began = [], 0, time.perf_counter()
    for place in range(places):
        unit.start(initial_gap=(1.0 + (place + 0.5) / places) * impact.speed * step)
        rebound = way(unit, impact.mass, impact.speed, step)
        errors.append(rebound / impact.speed / impact.restitution - 1.0)
        calls += unit.calls
    rms = math.sqrt(sum(error * error for error in errors) / places)
    return rms, calls / places, (time.perf_counter() - began) / places


def error_of_contact_time(unit, impact, steps_per_contact, places=PLACES):
    """Relative, like the error of the restitution."""
    step = impact.contact_time / steps_per_contact
    found = [contact_time(unit, impact, step, (place + 0.5) / places) for place in range(places)]
    return math.sqrt(sum((time / impact.contact_time - 1.0) ** 2 for time in found) / places)


def order(errors, first=16, last=512):
    """Slope of the error over the step, fitted where neither large steps nor rounding dominate."""
    counts = [count for count in errors if first <= count <= last and errors[count] > 1e-11]
    if len(counts) < 3:
        return math.nan
    return -np.polyfit(np.log(counts), np.log([errors[count] for count in counts]), 1)[0]


def main(plain, knowing, impact):
    impact = Impact.read(impact)
    units = {way: Unit(knowing if way is mass_known else plain) for way in WAYS.values()}
    for unit in units.values():
        if "effective_mass" in unit.reference:
            unit.start(effective_mass=impact.mass)
    results = {name: {count: error(way, units[way], impact, count) for count in STEPS_PER_CONTACT}
               for name, way in WAYS.items()}
    columns = [2, 8, 32, 128, 512, 4096]
    print(f"restitution {impact.restitution:.6f}, contact time {1e6 * impact.contact_time:.3f} us; "
          "relative error of the restitution at so many steps per contact\n")
    print("| way | " + " | ".join(map(str, columns)) + " | order | calls at 32 | us at 32 |")
    print("|---" * (len(columns) + 4) + "|")
    for name, result in results.items():
        errors = {count: row[0] for count, row in result.items()}
        fitted = order(errors)
        cells = [f"{errors[count]:.1e}" for count in columns] + ["-" if math.isnan(fitted) else f"{fitted:.1f}"]
        print(f"| {name} | " + " | ".join(cells) + f" | {result[32][1]:.0f} | {1e6 * result[32][2]:.0f} |")
    single, calls, _ = error(mass_known, units[mass_known], impact, 0.5)
    print(f"\nmass known, a single step over the whole impact: {single:.1e}, {calls:.0f} calls")
    spread = error_of_contact_time(units[derivatives_of_both], impact, 32)
    print(f"contact time by input derivatives, 32 steps per contact: {spread:.1e}")
    for unit in units.values():
        unit.close()


if __name__ == "__main__":
    main(*sys.argv[1:])
