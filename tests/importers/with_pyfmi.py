"""PyFMI: one FMU step by step, and its `Master`, which steps all FMUs at once."""

from driver import BALL_STEPS, STEP, body, rates, run, unit
from pyfmi import load_fmu
from pyfmi.master import Master


def loaded(path):
    return load_fmu(path, kind="CS", log_level=2)


def history(watch):
    contact, forces = loaded(unit("contact")), []
    contact.setup_experiment()
    contact.initialize()
    with watch.running():
        for index, rate in enumerate(rates):
            contact.set("indentation_rate", rate)
            assert contact.do_step(index * STEP, STEP) == 0
            forces.append(float(contact.get("force")[0]))
    return forces


def ball(path, step, watch):
    contact, mass = loaded(path), loaded(body())
    master = Master([contact, mass], [
        (contact, "mean_force", mass, "force"),
        (mass, "rate", contact, "indentation_rate"),
        (mass, "acceleration", contact, "external_acceleration"),
    ])
    options = master.simulate_options()
    options.update(step_size=step, extrapolation_order=0, result_handling="memory")
    with watch.running():
        master.simulate(start_time=0.0, final_time=BALL_STEPS * step, options=options)
    return float(mass.get("rate")[0])


if __name__ == "__main__":
    run("pyfmi", [("PyFMI", "parallel", history, ball)])
