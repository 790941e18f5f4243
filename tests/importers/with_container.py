"""fmu-manipulation-toolbox: its checker reads each FMU; its containers are FMUs made of FMUs, run by fmpy."""

import logging
from pathlib import Path

import numpy
from driver import BALL_STEPS, STEP, body, folder, rates, run, unit
from fmpy import simulate_fmu
from fmu_manipulation_toolbox.assembly import Assembly
from fmu_manipulation_toolbox.checker import OperationGenericCheck
from fmu_manipulation_toolbox.operations import FMU


def container(name, lines, step, sequential):
    Path(f"{name}.csv").write_text("\n".join(["rule;from_fmu;from_port;to_fmu;to_port", *lines]) + "\n")
    # auto_link would connect variables of equal names
    Assembly(f"{name}.csv", default_step_size=step, default_sequential=sequential, default_auto_link=False,
             default_auto_input=False, default_auto_output=False, fmu_directory=Path.cwd()).make_fmu(fmi_version=2)
    return f"{name}.fmu"


def bring(path, name):
    Path(f"{name}.fmu").write_bytes(Path(path).read_bytes())


def history(sequential):
    def forces(watch):
        bring(unit("contact"), "contact")
        path = container("alone", [
            "FMU;contact.fmu;;;",
            "INPUT;;indentation_rate;contact.fmu;indentation_rate",
            "OUTPUT;contact.fmu;force;;force",
        ], STEP, sequential)
        points = [(end * STEP, rate) for index, rate in enumerate(rates) for end in (index, index + 1)]
        table = numpy.array(points, [("time", float), ("indentation_rate", float)])
        with watch.running():
            result = simulate_fmu(path, stop_time=len(rates) * STEP, step_size=STEP, output_interval=STEP, input=table,
                                  output=["force"])
        return list(result["force"][1:])

    return forces


def ball(sequential):
    def rate(path, step, watch):
        bring(path, "contact")
        bring(body(), "mass")
        path = container("ball", [
            "FMU;contact.fmu;;;",
            "FMU;mass.fmu;;;",
            "LINK;contact.fmu;mean_force;mass.fmu;force",
            "LINK;mass.fmu;rate;contact.fmu;indentation_rate",
            "LINK;mass.fmu;acceleration;contact.fmu;external_acceleration",
            "OUTPUT;mass.fmu;rate;;rate",
        ], step, sequential)
        with watch.running():
            result = simulate_fmu(path, stop_time=BALL_STEPS * step, step_size=step, output_interval=step, output=["rate"])
        return result["rate"][-1]

    return rate


def check():
    for path in sorted(folder.glob("*.fmu")):
        checker = OperationGenericCheck()
        FMU(path).apply_operation(checker)
        assert checker.compliant_with_version == "2.0", path


if __name__ == "__main__":
    logging.getLogger("fmu_manipulation_toolbox").setLevel(logging.WARNING)
    check()
    run("fmu-manipulation-toolbox", [
        ("FMU container, sequential", "serial", history(True), ball(True)),
        ("FMU container, parallel", "parallel", history(False), ball(False)),
    ])
