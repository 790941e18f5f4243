"""The bits of a unit's outputs by fmpy, over a history: with_fmpy.py UNIT HISTORY [PLATFORM], the last for fmpy's way to other systems."""

import struct
import sys

import fmpy
import numpy as np

unit, history = sys.argv[1:3]
remote = sys.argv[3] if len(sys.argv) > 3 else None
STEP = 1e-6
with open(history) as file:
    rates = [struct.unpack(">d", bytes.fromhex(line.split()[0]))[0] for line in file][:500]
description = fmpy.read_model_description(unit)
outputs = [variable.name for variable in description.modelVariables if variable.causality == "output" and variable.type == "Real"]
# a rate holds from a point of time on; fmpy interpolates, so that each is given at both ends of its step
times = np.repeat(STEP * np.arange(len(rates) + 1), 2)[1:-1]
signals = np.array(
    list(zip(times, np.repeat(rates, 2), strict=True)), dtype=[("time", float), ("indentation_rate", float)]
)
result = fmpy.simulate_fmu(
    unit, stop_time=STEP * len(rates), output_interval=STEP, input=signals, output=outputs, remote_platform=remote
)
for row in result:
    print(" ".join(struct.pack(">d", row[name]).hex() for name in ("time", *outputs)))
