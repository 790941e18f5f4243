"""PathSim, with the blocks of `pathsim-fmi`: a step of an FMU is an event. Simultaneous events are in the order of the blocks,
each with the results of those before it."""

from driver import BALL_STEPS, STEP, body, rates, run, unit
from pathsim import Connection, Simulation
from pathsim.blocks import Source
from pathsim_fmi import CoSimulationFMU


def block(path, step):
    fmu = CoSimulationFMU(path, dt=step)
    # inputs and outputs in the order of the model description
    variables = fmu.fmu_wrapper.model_description.modelVariables
    ports = {kind: [v.name for v in variables if v.causality == kind] for kind in ("input", "output")}
    return fmu, lambda name: fmu[ports["input" if name in ports["input"] else "output"].index(name)]


def history(watch):
    contact, port = block(unit("contact"), STEP)
    source = Source(lambda time: rates[min(round(time / STEP), len(rates) - 1)])
    forces = []
    step = contact._step_fmu

    def recorded(time):
        step(time)
        forces.append(contact.fmu_wrapper.get_outputs_as_array()[0])

    contact.events[0].func_act = recorded
    simulation = Simulation([source, contact], [Connection(source, port("indentation_rate"))], dt=STEP, log=False)
    with watch.running():
        simulation.run((len(rates) - 1) * STEP)
    return forces[:len(rates)]


def ball(path, step, watch):
    (contact, contact_port), (mass, mass_port) = block(path, step), block(body(), step)
    simulation = Simulation([contact, mass], [
        Connection(contact_port("mean_force"), mass_port("force")),
        Connection(mass_port("rate"), contact_port("indentation_rate")),
        Connection(mass_port("acceleration"), contact_port("external_acceleration")),
    ], dt=step, log=False)
    with watch.running():
        # the units step at the beginning and at the end
        simulation.run((BALL_STEPS - 1) * step)
    return mass.fmu_wrapper.get_outputs_as_array()[0]


if __name__ == "__main__":
    run("pathsim-fmi", [("PathSim", "serial", history, ball)])
