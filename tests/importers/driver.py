"""The task of every importer, and the format of its results.

A driver `with_TOOL.py FOLDER RESULT` finds in FOLDER `contact.fmu`, `serial.fmu`, `parallel.fmu`, `mass.fmu`, `ball.ssp` and
`history.txt`, and writes its results to RESULT as JSON; `tests/importers.rs` evaluates them. A driver has several methods, each
with a name, the order of execution, and its functions.
"""

import importlib.metadata
import json
import os
import shutil
import sys
import tempfile
import time
import traceback
from contextlib import contextmanager
from pathlib import Path

# each line of the history is a rate [m/s] and a step [s], all of this length
STEP = 1e-6
# the ball touches the block within the first of them or soon after, and has left it long before the last
BALL_STEPS = 100
BALL_SIZES = [1e-6, 1e-4, 2e-3]

folder, result_file = (Path(argument).resolve() for argument in sys.argv[1:3])
rates = [float(line.split()[0]) for line in (folder / "history.txt").read_text().splitlines()]


# the ball for a parallel importer, as a system
package = str(folder / "ball.ssp")


def unit(name):
    return str(folder / f"{name}.fmu")


class Watch:
    """Duration of the steps [s], without the tool's work before and after them where that can be separated."""

    def __init__(self):
        self.seconds = 0.0

    @contextmanager
    def running(self):
        start = time.perf_counter()
        yield
        self.seconds += time.perf_counter() - start


def answer(make, steps):
    """The result of `make(watch)` with the steps per second, or its error."""
    watch = Watch()
    try:
        value = make(watch)
    except Exception as error:
        traceback.print_exc()
        return {"error": f"{type(error).__name__}: {error}"}
    return {"value": value, "steps_per_second": steps / watch.seconds if watch.seconds else None}


def run(package, ways, version=None):
    """Runs all `ways`: a list of (name, order, history, ball), where order is "serial", "parallel" or "-".

    `history(watch)` returns the force after each step of the history, `ball(contact, step, watch)` the final rate of the ball.
    A tool that cannot do one of the two has None there.
    """
    os.chdir(tempfile.mkdtemp(prefix="brinell-"))
    result = {"version": version or importlib.metadata.version(package), "ways": []}
    for name, order, history, ball in ways:
        way = {"name": name, "order": order}
        if history:
            way["history"] = answer(history, len(rates))
        if ball:
            way["ball"] = [
                {"step": step} | answer(lambda watch: ball(unit(order), step, watch), BALL_STEPS) for step in BALL_SIZES
            ]
        result["ways"].append(way)
        # written after each method, in case the tool crashes in the next one
        result_file.write_text(json.dumps(result))
    here = os.getcwd()
    os.chdir("/")
    shutil.rmtree(here, ignore_errors=True)
