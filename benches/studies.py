"""Speed of studies: the processor time of an impact in a table, and in one FMU of a thousand contacts.

    python benches/studies.py [--runs 4000] [--repeat 5]

It needs the package `brinell` with the packages for studies, and the exporter. Times are the best of several repetitions: other
processes on the machine can make a run longer, but never shorter.
"""

from __future__ import annotations

import argparse
import resource
import tempfile
from pathlib import Path

import brinell
import numpy as np

SCENES = Path(__file__).resolve().parents[1] / "scenes"
CONTACTS = 1000
ROW = """
[[contact]]
name = "bead"
count = {count}
parameters_per_contact = ["target.yield_strength", "effective_mass"]
"""
RATE = '\nrate = { model = "johnson-cook", c = 0.014, reference_rate = 1.0 }\n'


def processor() -> float:
    """Processor time of this process and its finished children [s]."""
    both = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(usage.ru_utime + usage.ru_stime for usage in both)


def tell(name: str, count: int, repeat: int, work) -> None:
    """The best processor time of one of the `count` impacts of `work`."""
    times = []
    for _ in range(repeat):
        began = processor()
        work()
        times.append(processor() - began)
    print(f"{name:<60}{1e6 * min(times) / count:>10.1f} us")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=4000)
    parser.add_argument("--repeat", type=int, default=5)
    given = parser.parse_args()
    text = (SCENES / "mass_known.toml").read_text(encoding="utf-8")
    vary = {"speed": "0.1:10", "target.yield_strength": "200e6:900e6"}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.toml"
        for name, scene in (("an impact of a study", text), ("with a strain rate", text.replace("[target]", f"[target]{RATE}"))):
            path.write_text(scene, encoding="utf-8")
            tell(name, given.runs, given.repeat, lambda: brinell.study(path, vary, sample=f"lhs:{given.runs}", mass=4e-3))
        path.write_text(text + ROW.format(count=CONTACTS), encoding="utf-8")
        mass, (speed, strength) = np.full(CONTACTS, 4e-3), np.linspace([0.1, 200e6], [10.0, 900e6], CONTACTS).T
        with brinell.Contact(brinell.export(path, path.with_suffix(".fmu"))) as row:
            def work():
                row.reset(target_yield_strength=strength, effective_mass=mass)
                row.step(1.0, speed)
                return row["residual_indentation"]

            tell(f"one of {CONTACTS} contacts of an FMU, with its parameters", CONTACTS, 4 * given.repeat, work)


if __name__ == "__main__":
    main()
