"""FMI++, with its class for one FMU of FMI 2.0: the driver connects the FMUs, one after the other or all at once."""

import functools
import os

from driver import BALL_STEPS, STEP, body, rates, run, unit
from fmipp import FMUCoSimulationV2, extractFMU


@functools.cache
def extracted(path):
    """Once only: a loaded library must not be overwritten."""
    return extractFMU(path, os.getcwd())


class Slave:
    def __init__(self, path):
        name = os.path.splitext(os.path.basename(path))[0]
        # it wants the model identifier
        identifier = {"contact": "steel_ball", "heavy": "mass"}.get(name, name)
        self.fmu = FMUCoSimulationV2(extracted(path), identifier, False, 1e-12)
        self.checked(self.fmu.instantiate(name, 0.0, False, False))
        self.checked(self.fmu.initialize(0.0, False, 0.0))

    def checked(self, status):
        assert status == 0, status

    def get(self, name):
        return self.fmu.getRealValue(name)

    def set(self, name, value):
        self.checked(self.fmu.setRealValue(name, value))

    def step(self, time, step):
        self.checked(self.fmu.doStep(time, step, True))


def history(watch):
    contact, forces = Slave(unit("contact")), []
    with watch.running():
        for index, rate in enumerate(rates):
            contact.set("indentation_rate", rate)
            contact.step(index * STEP, STEP)
            forces.append(contact.get("force"))
    return forces


def ball(serial):
    def rate(path, step, watch):
        contact, mass = Slave(path), Slave(body())
        with watch.running():
            for index in range(BALL_STEPS):
                contact.set("indentation_rate", mass.get("rate"))
                contact.set("external_acceleration", mass.get("acceleration"))
                if serial:
                    contact.step(index * step, step)
                mass.set("force", contact.get("mean_force"))
                if not serial:
                    contact.step(index * step, step)
                mass.step(index * step, step)
        return mass.get("rate")

    return rate


if __name__ == "__main__":
    run("fmipp", [("FMI++", "serial", history, ball(True)), ("FMI++", "parallel", None, ball(False))])
