"""The forces of FMUs over a history, as the 16 hexadecimal digits of their bits: force_bits.py HISTORY UNIT...

Each line of HISTORY contains an indentation rate [m/s] and a step [s]. The program in tests/importers/ does the same with
the `fmi` crate.
"""

import struct
import sys
from pathlib import Path

from unit import Unit

history = [tuple(map(float, line.split())) for line in Path(sys.argv[1]).read_text().splitlines()]
for path in sys.argv[2:]:
    unit = Unit(path)
    # of the first contact, if there are several
    rate_name, force_name = (
        next(name for name in unit.variables if name.split(".")[-1] == wanted) for wanted in ("indentation_rate", "force")
    )
    instance = unit.ready()
    for rate, step in history:
        instance.set(**{rate_name: rate})
        instance.step(step)
        print(struct.pack(">d", instance.get(force_name)).hex())
