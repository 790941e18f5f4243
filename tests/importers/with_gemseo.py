"""gemseo-fmu: a time-stepping system of two disciplines, all at once (`MDAJacobi`) or one after the other (`MDAGaussSeidel`)."""

from driver import BALL_STEPS, STEP, acceleration, body, rates, run, unit
from gemseo_fmu.disciplines.do_step_fmu_discipline import DoStepFMUDiscipline
from gemseo_fmu.disciplines.time_stepping_system import TimeSteppingSystem
from numpy import array


def history(watch):
    contact = DoStepFMUDiscipline(unit("contact"), ["indentation_rate"], ["force"], final_time=1.0, time_step=STEP)
    forces = []
    with watch.running():
        for rate in rates:
            forces.append(float(contact.execute({"indentation_rate": array([rate])})["force"][0]))
    return forces


def ball(mda):
    def rate(path, step, watch):
        end = 2 * BALL_STEPS * step
        inputs = ["indentation_rate", "external_acceleration"]
        contact = DoStepFMUDiscipline(path, inputs, ["mean_force"], final_time=end, time_step=step)
        names = {"force": "mean_force", "rate": "indentation_rate", "acceleration": "external_acceleration"}
        mass = DoStepFMUDiscipline(body(), ["force"], ["rate", "acceleration"], final_time=end, time_step=step,
                                   variable_names=names)
        system = TimeSteppingSystem([contact, mass], end, step, do_step=True, restart=False, mda_name=mda,
                                    # what accelerates the convergence of an iteration makes a step wrong
                                    mda_options={"acceleration_method": "NoTransformation"})
        # equal inputs in the next step do not mean that it is the same step
        system.set_cache(system.CacheType.NONE)
        begin = {"indentation_rate": 1.0, "external_acceleration": acceleration(), "mean_force": 0.0}
        state = {name: array([value]) for name, value in begin.items()}
        # who is stepped first decides what the system takes
        state = {name: value for name, value in state.items() if name in system.input_grammar}
        with watch.running():
            for _ in range(BALL_STEPS):
                result = system.execute(state)
                state = {name: result[name] for name in state}
        return float(result["indentation_rate"][0])

    return rate


if __name__ == "__main__":
    run("gemseo-fmu", [
        ("gemseo-fmu, Jacobi", "parallel", history, ball("MDAJacobi")),
        ("gemseo-fmu, Gauss-Seidel", "serial", history, ball("MDAGaussSeidel")),
    ])
