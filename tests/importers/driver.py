"""The task of every importer, and the format of its results.

A driver `with_TOOL.py FOLDER RESULT` finds in FOLDER `contact.fmu`, `serial.fmu`, `parallel.fmu`, `mass.fmu`, `heavy.fmu`
(the same body under gravity), `ball.ssp` and `history.txt`, and writes to RESULT what it found as JSON;
`tests/importing/every_importer.rs` judges it. A driver has ways: a name, the order of execution, and what to do.
"""

import ctypes
import importlib.metadata
import json
import os
import re
import shutil
import sys
import tempfile
import time
import traceback
import zipfile
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


_body = "mass"


def body():
    """The FMU of the ball. Its output `acceleration` is that of gravity, and belongs to the input `external_acceleration`."""
    return unit(_body)


def acceleration():
    """Of the ball by gravity [m/s^2], for tools that want to know the first value of a connection."""
    text = zipfile.ZipFile(body()).read("modelDescription.xml").decode()
    return float(re.search(r'name="acceleration".*start="(.*?)"', text).group(1))


def weightless(ball):
    """A ball that is not run under gravity."""
    ball.weightless = True
    return ball


class Watch:
    """Duration of the steps [s], without the tool's work before and after them where that can be separated."""

    def __init__(self):
        self.seconds = 0.0

    @contextmanager
    def running(self):
        start = time.perf_counter()
        yield
        self.seconds += time.perf_counter() - start


# a part of the warning about the wrong order of execution
WARNING = b"the master applies mean_force"


def flush():
    sys.stdout.flush()
    sys.stderr.flush()
    ctypes.CDLL(None).fflush(None)


@contextmanager
def printed():
    """What tool and FMU print, as the bytes of a file; it is printed in the end."""
    flush()
    kept = os.dup(1), os.dup(2)
    with tempfile.TemporaryFile() as file:
        os.dup2(file.fileno(), 1)
        os.dup2(file.fileno(), 2)
        text = bytearray()
        try:
            yield text
        finally:
            flush()
            for copy, place in zip(kept, (1, 2)):
                os.dup2(copy, place)
                os.close(copy)
            file.seek(0)
            text += file.read()
            os.write(1, text)


def answer(make, steps):
    """The result of `make(watch)` with the steps per second and whether the user reads of a wrong order, or its error."""
    watch = Watch()
    with printed() as text:
        try:
            value = make(watch)
        except Exception as error:
            traceback.print_exc()
            return {"error": f"{type(error).__name__}: {error}"}
    speed = steps / watch.seconds if watch.seconds else None
    return {"value": value, "steps_per_second": speed, "told": WARNING in text}


def balls(ball, order, name):
    """The answers of the ball `name` at each step."""
    global _body
    _body = name
    return [{"step": step} | answer(lambda watch: ball(unit(order), step, watch), BALL_STEPS) for step in BALL_SIZES]


def run(package, ways, version=None):
    """Runs all `ways`: a list of (name, order, history, ball), where order is "serial", "parallel" or "-".

    The ball is run without gravity, and with it if it is not `weightless`. `history(watch)` gives the force after each step of the history, `ball(contact, step, watch)` the rate of the ball in the end.
    A tool that can't do one of the two has None there.
    """
    os.chdir(tempfile.mkdtemp(prefix="brinell-"))
    result = {"version": version or importlib.metadata.version(package), "ways": []}
    for name, order, history, ball in ways:
        way = {"name": name, "order": order}
        if history:
            way["history"] = answer(history, len(rates))
        if ball:
            way["ball"] = balls(ball, order, "mass")
            if not getattr(ball, "weightless", False):
                way["heavy"] = balls(ball, order, "heavy")
        result["ways"].append(way)
        # written after each method, in case the tool crashes in the next one
        result_file.write_text(json.dumps(result))
    here = os.getcwd()
    os.chdir("/")
    shutil.rmtree(here, ignore_errors=True)
