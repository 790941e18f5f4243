"""The ball of steel_ball.fmu hits the block: an explicit importer that moves the mass (pip install fmpy)."""
import sys

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

path = sys.argv[1] if len(sys.argv) > 1 else "steel_ball.fmu"
description = read_model_description(path)
reference = {variable.name: variable.valueReference for variable in description.modelVariables}
unit = FMU2Slave(guid=description.guid, unzipDirectory=extract(path), instanceName="ball",
                 modelIdentifier=description.coSimulation.modelIdentifier)
unit.instantiate()
unit.setupExperiment(startTime=0.0)
unit.enterInitializationMode()
unit.exitInitializationMode()

mass, speed, time, step = 4.11e-3, 1.0, 0.0, 1e-7  # kg, m/s, s, s
force, largest = 0.0, 0.0
while force > 0.0 or speed > 0.0:
    # the speed at the middle of the step and the force at its ends: the leap-frog method, of second order
    unit.setReal([reference["indentation_rate"]], [speed])
    unit.doStep(time, step)
    time += step
    force = unit.getReal([reference["force"]])[0]
    largest = max(largest, force)
    speed -= step * force / mass

unit.terminate()
unit.freeInstance()
print(f"largest force {largest:.2f} N, contact time {1e6 * time:.2f} us, restitution {-speed:.4f}")
