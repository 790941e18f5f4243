"""fmuloader: one FMU step by step. It asks for every symbol of the standard; the body is moved here, since its FMU has fewer."""

import re
import zipfile

from driver import BALL_STEPS, STEP, acceleration, rates, run, unit
from fmuloader.fmi2 import Fmi2Slave, Fmi2Type

MASS = 4e-3


class Slave:
    def __init__(self, path):
        text = zipfile.ZipFile(path).read("modelDescription.xml").decode()
        variables = re.findall(r'<ScalarVariable name="(.*?)" valueReference="(.*?)"', text)
        self.references = {name: int(reference) for name, reference in variables}
        identifier, guid = (re.search(f' {name}="(.*?)"', text).group(1) for name in ("modelIdentifier", "guid"))
        self.fmu = Fmi2Slave(path, model_identifier=identifier)
        self.fmu.instantiate("contact", Fmi2Type.CO_SIMULATION, guid=guid)
        self.fmu.setup_experiment(start_time=0.0)
        self.fmu.enter_initialization_mode()
        self.fmu.exit_initialization_mode()

    def get(self, name):
        return self.fmu.get_real([self.references[name]])[0]

    def set(self, name, value):
        self.fmu.set_real([self.references[name]], [value])


def history(watch):
    contact, forces = Slave(unit("contact")), []
    with watch.running():
        for index, rate in enumerate(rates):
            contact.set("indentation_rate", rate)
            contact.fmu.do_step(index * STEP, STEP)
            forces.append(contact.get("force"))
    return forces


def ball(serial):
    def end(path, step, watch):
        contact, rate, gravity = Slave(path), 1.0, acceleration()
        with watch.running():
            for index in range(BALL_STEPS):
                force = contact.get("mean_force")
                contact.set("indentation_rate", rate)
                contact.set("external_acceleration", gravity)
                contact.fmu.do_step(index * step, step)
                rate += step * (gravity - (contact.get("mean_force") if serial else force) / MASS)
        return rate

    return end


if __name__ == "__main__":
    run("fmuloader", [("fmuloader", "serial", history, ball(True)), ("fmuloader", "parallel", None, ball(False))])
