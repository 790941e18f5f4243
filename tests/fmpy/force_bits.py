"""The forces of a unit over a history, as the 16 hexadecimal digits of their bits: force_bits.py UNIT HISTORY.

Each line of HISTORY holds an indentation rate [m/s] and a step [s]. The program in tests/importers/ does the same with
the `fmi` crate.
"""

import struct
import sys

from unit import Unit

instance = Unit(sys.argv[1]).ready()
with open(sys.argv[2]) as history:
    for line in history:
        rate, step = map(float, line.split())
        instance.step(step, rate)
        print(struct.pack(">d", instance.get("force")).hex())
