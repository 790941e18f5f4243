"""The forces of an FMU over a history, as the 16 hexadecimal digits of their bits: force_bits.py UNIT HISTORY.

Each line of HISTORY contains an indentation rate [m/s] and a step [s]. The program in tests/importers/ does the same with
the `fmi` crate.
"""

import struct
import sys

from unit import Unit

unit = Unit(sys.argv[1])
# of the first contact, if there are several
rate_name, force_name = (
    next(name for name in unit.variables if name.split(".")[-1] == wanted) for wanted in ("indentation_rate", "force")
)
instance = unit.ready()
with open(sys.argv[2]) as history:
    for line in history:
        rate, step = map(float, line.split())
        instance.set(**{rate_name: rate})
        instance.step(step)
        print(struct.pack(">d", instance.get(force_name)).hex())
