"""Speed of studies, and where their time is spent.

    python benches/studies.py [--runs 4000] [--repeat 5]

It needs the package `brinell` with the packages for studies, the exporter, and Rust. Times are the best of several repetitions:
other processes on the machine can make a run longer, but never shorter. The table also shows the processor time (user and
system) of a run, including its children, which other processes affect less.
"""

from __future__ import annotations

import argparse
import json
import os
import pickle
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import brinell
import numpy as np
from brinell.studies import impacts, scene

SCENES = Path(__file__).resolve().parents[1] / "scenes"
CONTACTS = 1000
ROW = """
[[contact]]
name = "bead"
count = {count}
parameters_per_contact = ["target.yield_strength", "effective_mass"]
"""


def processor() -> float:
    """Processor time of this process and its finished children [s]."""
    both = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(usage.ru_utime + usage.ru_stime for usage in both)


def best(repeat: int, work) -> tuple[float, float]:
    """The best wall time and the best processor time of `work` [s]."""
    times = []
    for _ in range(repeat):
        began, used = time.perf_counter(), processor()
        work()
        times.append((time.perf_counter() - began, processor() - used))
    return min(wall for wall, _ in times), min(used for _, used in times)


def runs(count: int) -> np.ndarray:
    """Speed [m/s], mass [kg] and yield strength [Pa] of `count` impacts, evenly distributed."""
    part = np.modf(np.outer(np.arange(1, count + 1), [0.7548776662, 0.5698402910]))[0]
    return np.column_stack(
        [10.0 ** (2.0 * part[:, 0] - 1.0), np.full(count, 4e-3), 200e6 + 700e6 * part[:, 1]]
    )


NAMES = ("speed", "mass", "target.yield_strength")


def one_process(unit: Path, rows: np.ndarray, repeat: int) -> None:
    """A chunk in this process: the cost of a run without overhead."""
    impacts.run(unit, NAMES, rows[:10])
    wall, used = best(repeat, lambda: impacts.run(unit, NAMES, rows))
    tell("a run, in one process", wall / len(rows), used / len(rows), 1.0 / used * len(rows))
    wall, used = best(repeat, lambda: impacts.run(unit, NAMES, rows[:1]))
    tell("a chunk of one run: an instance and a run", wall, used)


def loading(unit: Path, repeat: int) -> None:
    """The cost per process: reading, unpacking and loading the FMU."""
    code = (
        "import sys, time; import brinell; from brinell.library import Library; began = time.perf_counter(); "
        "library = Library.of(sys.argv[1]); print(time.perf_counter() - began)"
    )
    call = [sys.executable, "-c", code, str(unit)]
    times = [float(subprocess.run(call, capture_output=True, check=True).stdout) for _ in range(repeat)]
    tell("unpacking and loading the unit, once a process", min(times))
    wall, used = best(repeat, lambda: subprocess.run(call, capture_output=True, check=True))
    tell("a new interpreter that does so", wall, used)


def sizes(unit: Path, rows: np.ndarray) -> None:
    """The data between processes."""
    data = pickle.dumps(impacts.run(unit, NAMES, rows))
    print(f"{'result of a run, pickled':<58}{len(data) / len(rows):>12.1f} bytes")
    print(f"{'the unit':<58}{unit.stat().st_size:>12} bytes")


def studies(unit: Path, rows: np.ndarray, repeat: int) -> None:
    """Complete studies with one and two workers."""
    vary = {"speed": rows[:, 0].tolist(), "target.yield_strength": [300e6]}
    for workers in (1, 2):

        def work(workers=workers):
            brinell.study(unit, vary, mass=4e-3, workers=workers, progress=False)

        wall, used = best(repeat, work)
        name = f"a study of {len(rows)} runs, {workers} worker{'s' if workers > 1 else ''}"
        tell(name, wall / len(rows), used / len(rows), len(rows) / wall)


def vectorised(folder: Path, repeat: int) -> None:
    """The same impacts with one FMU of a thousand contacts, each with its own strength and mass."""
    text = (SCENES / "mass_known.toml").read_text(encoding="utf-8") + ROW.format(count=CONTACTS)
    path = folder / "row.toml"
    path.write_text(text, encoding="utf-8")
    began = time.perf_counter()
    unit = brinell.export(path, folder / "row.fmu")
    tell(f"exporting a unit of {CONTACTS} contacts", time.perf_counter() - began)
    print(f"{'the unit':<58}{unit.stat().st_size:>12} bytes")
    rows = runs(CONTACTS)
    speed, mass, strength = rows.T
    with brinell.Contact(unit) as row:
        def work():
            row.reset(target_yield_strength=strength, effective_mass=mass)
            force = row.step(1.0, speed)
            return -(speed - force / mass) / speed, row["residual_indentation"]

        wall, used = best(4 * repeat, work)
        tell("a run among a thousand, with reset and parameters", wall / CONTACTS, used / CONTACTS, CONTACTS / used)
        restitution, dent = work()

        row.reset()
        state = row.save()

        def step():
            row.restore(state)
            row.step(1.0, speed)

        wall, used = best(4 * repeat, step)
        tell("the step alone", wall / CONTACTS, used / CONTACTS, CONTACTS / used)
    single = scene.unit(SCENES / "mass_known.toml", folder, None)[0]
    table = impacts.run(single, NAMES, rows)
    assert np.array_equal(table["restitution"], restitution), "the two don't agree"
    assert np.array_equal(table["dent"], dent), "the two don't agree"


def tell(name: str, wall: float, used: float = float("nan"), rate: float = float("nan")) -> None:
    """A row of the table: microseconds, and runs per second."""
    def cell(value: float, factor: float = 1e6) -> str:
        return f"{factor * value:>12.1f}" if value == value else " " * 12

    print(f"{name:<58}{cell(wall)}{cell(used)}{cell(rate, 1.0)}", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=4000)
    parser.add_argument("--repeat", type=int, default=5)
    given = parser.parse_args()
    print(json.dumps({"cores": os.cpu_count(), "python": sys.version.split()[0]}))
    print(f"{'':<58}{'wall [us]':>12}{'used [us]':>12}{'runs/s':>12}")
    rows = runs(given.runs)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        unit = scene.unit(SCENES / "mass_known.toml", folder, None)[0]
        one_process(unit, rows, given.repeat)
        loading(unit, given.repeat)
        sizes(unit, rows)
        vectorised(folder, given.repeat)
        studies(unit, rows, given.repeat)


if __name__ == "__main__":
    main()
