"""Tools other than fmpy with a contact that has friction in two directions: `friction.py TOOL UNIT HISTORY RESULT`.

Each line of HISTORY has the rate along the normal and the two tangential rates [m/s] of a step. RESULT gets the forces
after each step.
"""

import ctypes
import json
import os
import sys
import tempfile
from pathlib import Path

STEP = 1e-6
RATES = ["indentation_rate", "tangential_rate[1]", "tangential_rate[2]"]
FORCES = ["force", "tangential_force[1]", "tangential_force[2]"]


def libcosim(unit, history):
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimManipulator import CosimManipulator
    from libcosimpy.CosimObserver import CosimObserver
    from libcosimpy.CosimSlave import CosimLocalSlave

    execution = CosimExecution.from_step_size(round(STEP * 1e9))
    observer, override = CosimObserver.create_last_value(), CosimManipulator.create_override()
    slave = execution.add_local_slave(CosimLocalSlave(fmu_path=unit, instance_name="contact"))
    references = {it.name.decode(): it.reference for it in execution.slave_variables(slave)}
    execution.add_observer(observer)
    execution.add_manipulator(override)
    for rates in history:
        override.slave_real_values(slave, [references[name] for name in RATES], rates)
        assert execution.step()
        yield list(observer.last_real_values(slave, [references[name] for name in FORCES]))


def ecos(unit, history):
    # Ecos links it, but neither includes it nor lists it as a requirement
    ctypes.CDLL(f"{sys.prefix}/lib/libtbb.so.12", ctypes.RTLD_GLOBAL)
    from ecospy import EcosSimulation, EcosSimulationStructure

    with EcosSimulationStructure() as structure:
        structure.add_model("contact", unit)
        with EcosSimulation(structure=structure, step_size=STEP) as simulation:
            simulation.init()
            for rates in history:
                for name, rate in zip(RATES, rates, strict=True):
                    simulation.set_real(f"contact::{name}", rate)
                simulation.step()
                yield [simulation.get_real(f"contact::{name}") for name in FORCES]
            simulation.terminate()


if __name__ == "__main__":
    tool, *files = sys.argv[1:]
    unit, history, result = (str(Path(file).resolve()) for file in files)
    os.chdir(tempfile.mkdtemp(prefix="brinell-"))
    rates = [[float(word) for word in line.split()] for line in Path(history).read_text().splitlines()]
    forces = list({"libcosim": libcosim, "ecos": ecos}[tool](unit, rates))
    Path(result).write_text(json.dumps(forces))
