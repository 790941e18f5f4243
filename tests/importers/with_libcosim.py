"""libcosim of the Open Simulation Platform, with `libcosimpy`: all FMUs step at once, with a clock of nanoseconds."""

import zipfile

from driver import BALL_STEPS, STEP, body, package, rates, run, unit, weightless
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimManipulator import CosimManipulator
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave


class Execution:
    def __init__(self, step, **units):
        self.execution = CosimExecution.from_step_size(round(step * 1e9))
        self.observer, self.override = CosimObserver.create_last_value(), CosimManipulator.create_override()
        self.slaves, self.references = {}, {}
        for name, path in units.items():
            self.slaves[name] = self.execution.add_local_slave(CosimLocalSlave(fmu_path=path, instance_name=name))
            for variable in self.execution.slave_variables(self.slaves[name]):
                self.references[name, variable.name.decode()] = variable.reference
        self.execution.add_observer(self.observer)
        self.execution.add_manipulator(self.override)

    def connect(self, source, target):
        (source_unit, _), (target_unit, _) = source, target
        self.execution.connect_real_variables(self.slaves[source_unit], self.references[source],
                                              self.slaves[target_unit], self.references[target])

    def get(self, unit, name):
        return self.observer.last_real_values(self.slaves[unit], [self.references[unit, name]])[0]

    def set(self, unit, name, value):
        self.override.slave_real_values(self.slaves[unit], [self.references[unit, name]], [value])


def history(watch):
    execution = Execution(STEP, contact=unit("contact"))
    forces = []
    with watch.running():
        for rate in rates:
            execution.set("contact", "indentation_rate", rate)
            assert execution.execution.step()
            forces.append(execution.get("contact", "force"))
    return forces


def ball(path, step, watch):
    execution = Execution(step, contact=path, mass=body())
    execution.connect(("mass", "rate"), ("contact", "indentation_rate"))
    execution.connect(("contact", "mean_force"), ("mass", "force"))
    execution.connect(("mass", "acceleration"), ("contact", "external_acceleration"))
    with watch.running():
        assert execution.execution.step(BALL_STEPS)
    return execution.get("mass", "rate")


@weightless
def system(_path, step, watch):
    # it requires the folder, and finds the parts of the package there
    zipfile.ZipFile(package).extractall("system")
    execution, observer = CosimExecution.from_ssp_file("system", round(step * 1e9)), CosimObserver.create_last_value()
    execution.add_observer(observer)
    mass = execution.slave_index_from_instance_name("mass")
    rate = next(v.reference for v in execution.slave_variables(mass) if v.name == b"rate")
    with watch.running():
        assert execution.step(BALL_STEPS)
    return observer.last_real_values(mass, [rate])[0]


if __name__ == "__main__":
    run("libcosimpy", [("libcosim", "parallel", history, ball), ("libcosim, SSP 1.0", "parallel", None, system)])
