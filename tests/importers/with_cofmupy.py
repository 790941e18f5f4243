"""CoFMUpy: its two methods to step a loop of FMUs, Jacobi (all at once) and Gauss-Seidel (one after the other)."""

import csv

from cofmupy import Coordinator
from driver import BALL_STEPS, STEP, acceleration, body, rates, run, unit


def end(of, variable):
    return {"id": of, "variable": variable, "unit": "", "type": "fmu"}


def started(units, connections, method):
    """`connections` by source and target, in a run that has begun. FMUs step in the order of `units`."""
    coordinator = Coordinator()
    coordinator.start({
        "fmus": [{"id": name, "path": path, "initialization": values} for name, (path, values) in units.items()],
        "connections": [{"source": source, "target": target} for source, target in connections],
        "cosim_method": method,
        "iterative": False,
        "root": "",
        "edge_sep": " -> ",
        "data_storages": [],
    })
    return coordinator


def history(method):
    def forces(watch):
        with open("rates.csv", "w", newline="") as file:
            table = csv.writer(file)
            table.writerow(["t", "rate"])
            # each value begins half a step early, because the coordinator sums steps to get its time
            table.writerows([(index - 0.5) * STEP, rate] for index, rate in enumerate([*rates, 0.0]))
        source = {"type": "csv", "path": "rates.csv", "variable": "rate", "interpolation": "previous"}
        coordinator = started({"contact": (unit("contact"), {})}, [(source, end("contact", "indentation_rate"))], method)
        with watch.running():
            for _ in rates:
                coordinator.do_step(STEP)
        return list(coordinator.get_results()["contact", "force"])

    return forces


def ball(method):
    def rate(path, step, watch):
        # what the ball begins with is no output of a step before
        begin = {"indentation_rate": 1.0, "external_acceleration": acceleration()}
        units = {"contact": (path, begin), "mass": (body(), {})}
        coordinator = started(units, [
            (end("contact", "mean_force"), end("mass", "force")),
            (end("mass", "rate"), end("contact", "indentation_rate")),
            (end("mass", "acceleration"), end("contact", "external_acceleration")),
        ], method)
        # otherwise the order depends on the hashes of the names, which differ from process to process
        coordinator.master.sequence_order = [["contact", "mass"]]
        with watch.running():
            for _ in range(BALL_STEPS):
                coordinator.do_step(step)
        return coordinator.get_results()["mass", "rate"][-1]

    return rate


if __name__ == "__main__":
    run("cofmupy", [
        ("CoFMUpy, Jacobi", "parallel", history("jacobi"), ball("jacobi")),
        ("CoFMUpy, Gauss-Seidel", "serial", history("gauss_seidel"), ball("gauss_seidel")),
    ])
