"""fmpy: `simulate_fmu`, its classes individually, and its simulation of SSP packages."""

from concurrent.futures import ProcessPoolExecutor

import fmpy
import numpy
from driver import BALL_STEPS, STEP, body, package, rates, run, unit, weightless
from fmpy.fmi2 import FMU2Slave
from fmpy.ssp.simulation import simulate_ssp


class Slave:
    """An instance ready for steps, with its variables by name."""

    def __init__(self, path):
        description = fmpy.read_model_description(path)
        self.references = {variable.name: variable.valueReference for variable in description.modelVariables}
        self.fmu = FMU2Slave(guid=description.guid, unzipDirectory=fmpy.extract(path),
                             modelIdentifier=description.coSimulation.modelIdentifier)
        self.fmu.instantiate()
        self.fmu.setupExperiment()
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def get(self, name):
        return self.fmu.getReal([self.references[name]])[0]

    def set(self, name, value):
        self.fmu.setReal([self.references[name]], [value])


def history(watch):
    contact = Slave(unit("contact"))
    forces = []
    with watch.running():
        for index, rate in enumerate(rates):
            contact.set("indentation_rate", rate)
            contact.fmu.doStep(index * STEP, STEP)
            forces.append(contact.get("force"))
    return forces


def serial(path, step, watch):
    contact, mass = Slave(path), Slave(body())
    with watch.running():
        for index in range(BALL_STEPS):
            contact.set("indentation_rate", mass.get("rate"))
            contact.set("external_acceleration", mass.get("acceleration"))
            contact.fmu.doStep(index * step, step)
            mass.set("force", contact.get("mean_force"))
            mass.fmu.doStep(index * step, step)
    return mass.get("rate")


def parallel(path, step, watch):
    contact, mass = Slave(path), Slave(body())
    with watch.running():
        for index in range(BALL_STEPS):
            contact.set("indentation_rate", mass.get("rate"))
            contact.set("external_acceleration", mass.get("acceleration"))
            mass.set("force", contact.get("mean_force"))
            contact.fmu.doStep(index * step, step)
            mass.fmu.doStep(index * step, step)
    return mass.get("rate")


def simulated(watch):
    dtype = [("time", float), ("indentation_rate", float)]
    # a constant rate: each value twice, the second time where the next one begins
    points = [(end * STEP, rate) for index, rate in enumerate(rates) for end in (index, index + 1)]
    with watch.running():
        result = fmpy.simulate_fmu(unit("contact"), stop_time=len(rates) * STEP, step_size=STEP, output_interval=STEP,
                                   input=numpy.array(points, dtype), output=["force"])
    return list(result["force"][1:])


def eight_at_once(watch):
    """The forces of the process with the largest difference from the first one."""
    with watch.running(), ProcessPoolExecutor(8) as pool:
        first, *others = pool.map(simulated_alone, range(8))
    watch.seconds /= 8
    return max(others, key=lambda forces: max(abs(a - b) for a, b in zip(first, forces)))


def simulated_alone(_index):
    from driver import Watch

    return simulated(Watch())


@weightless
def system(_path, step, watch):
    with watch.running():
        result = simulate_ssp(package, stop_time=(BALL_STEPS - 0.5) * step, step_size=step)
    return result["mass.rate"][-1]


if __name__ == "__main__":
    run("fmpy", [
        ("fmpy, `FMU2Slave`", "serial", history, serial),
        ("fmpy, `FMU2Slave`", "parallel", None, parallel),
        ("fmpy, `simulate_fmu`", "-", simulated, None),
        ("fmpy, `simulate_fmu` in eight processes", "-", eight_at_once, None),
        ("fmpy, SSP 1.0", "parallel", None, system),
    ])
