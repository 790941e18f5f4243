"""Ecos, with `ecospy`: all FMUs step at once."""

import ctypes
import sys

# Ecos links it, but neither includes it nor lists it as a requirement
ctypes.CDLL(f"{sys.prefix}/lib/libtbb.so.12", ctypes.RTLD_GLOBAL)

from driver import BALL_STEPS, STEP, body, package, rates, run, unit, weightless
from ecospy import EcosSimulation, EcosSimulationStructure


def history(watch):
    with EcosSimulationStructure() as structure:
        structure.add_model("contact", unit("contact"))
        with EcosSimulation(structure=structure, step_size=STEP) as simulation:
            simulation.init()
            forces = []
            with watch.running():
                for rate in rates:
                    simulation.set_real("contact::indentation_rate", rate)
                    simulation.step()
                    forces.append(simulation.get_real("contact::force"))
            simulation.terminate()
            return forces


def ball(path, step, watch):
    with EcosSimulationStructure() as structure:
        structure.add_model("contact", path)
        structure.add_model("mass", body())
        structure.make_real_connection("mass::rate", "contact::indentation_rate")
        structure.make_real_connection("contact::mean_force", "mass::force")
        structure.make_real_connection("mass::acceleration", "contact::external_acceleration")
        return rebound(EcosSimulation(structure=structure, step_size=step), watch)


@weightless
def system(_path, step, watch):
    return rebound(EcosSimulation(ssp_path=package, step_size=step), watch)


def rebound(ball, watch):
    with ball as simulation:
        simulation.init()
        with watch.running():
            simulation.step(BALL_STEPS)
        rate = simulation.get_real("mass::rate")
        simulation.terminate()
        return rate


if __name__ == "__main__":
    run("ecospy", [("Ecos", "parallel", history, ball), ("Ecos, SSP 1.0", "parallel", None, system)])
