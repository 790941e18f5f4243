"""OMSimulator, through its C interface in Python: a weakly coupled system, whose algorithm `oms_ma` steps all FMUs at once."""

from driver import BALL_STEPS, STEP, body, rates, run, unit
from OMSimulator.capi import Capi

WEAKLY_COUPLED = 2


class Model:
    def __init__(self, step, **units):
        self.interface = Capi()
        # the name of a model stays in use until the model is deleted
        self.call("setTempDirectory", ".")
        self.call("newModel", "model")
        self.call("addSystem", "model.root", WEAKLY_COUPLED)
        for name, path in units.items():
            self.call("addSubModel", f"model.root.{name}", path)
        self.step = step

    def call(self, function, *arguments):
        status = getattr(self.interface, function)(*arguments)
        assert status.value == 0, f"{function}{arguments}: {status}"

    def connect(self, source, target):
        self.call("addConnection", f"model.root.{source}", f"model.root.{target}")

    def start(self):
        self.call("setResultFile", "model", "")
        self.call("setFixedStepSize", "model.root", self.step)
        self.call("setStopTime", "model", 1.0)
        self.call("instantiate", "model")
        self.call("initialize", "model")

    def get(self, name):
        value, status = self.interface.getReal(f"model.root.{name}")
        assert status.value == 0, status
        return value

    def close(self):
        self.call("terminate", "model")
        self.call("delete", "model")


def history(watch):
    model, forces = Model(STEP, contact=unit("contact")), []
    model.start()
    with watch.running():
        for index, rate in enumerate(rates):
            model.call("setReal", "model.root.contact.indentation_rate", rate)
            model.call("stepUntil", "model", (index + 1) * STEP)
            forces.append(model.get("contact.force"))
    model.close()
    return forces


def ball(path, step, watch):
    model = Model(step, contact=path, mass=body())
    model.connect("contact.mean_force", "mass.force")
    model.connect("mass.rate", "contact.indentation_rate")
    model.connect("mass.acceleration", "contact.external_acceleration")
    model.start()
    with watch.running():
        model.call("stepUntil", "model", BALL_STEPS * step)
    rate = model.get("mass.rate")
    model.close()
    return rate


if __name__ == "__main__":
    run("OMSimulator", [("OMSimulator", "parallel", history, ball)], Capi().getVersion())
