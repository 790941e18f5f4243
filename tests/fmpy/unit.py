"""The FMUs of these tests in fmpy: variables by their names, and a log as a list."""

import atexit
import json
import os
import shutil
from ctypes import byref
from functools import cache
from weakref import WeakValueDictionary

import fmpy
from fmpy import fmi2
from fmpy.logging import addLoggerProxy

WARNING = 1


@cache
def paths():
    """Path of each exported FMU, by the name of its scene."""
    return json.loads(os.environ["BRINELL_TEST_UNITS"])


@cache
def unit(name):
    return Unit(paths()[name])


class Unit:
    """An unpacked FMU."""

    def __init__(self, path):
        self.path = path
        self.folder = fmpy.extract(path)
        atexit.register(shutil.rmtree, self.folder, ignore_errors=True)
        self.description = fmpy.read_model_description(path)
        self.variables = {variable.name: variable for variable in self.description.modelVariables}
        self.inputs, self.parameters, self.outputs = (
            [name for name, v in self.variables.items() if v.causality == kind] for kind in ("input", "parameter", "output")
        )

    def moves_bodies(self):
        """Whether it moves the bodies itself within a step; it then reports the force to apply."""
        names = {name.split(".")[-1] for name in self.variables}
        return {"effective_mass", "mean_force"} <= names and "restitution" not in names

    def knows_mass(self):
        """Whether it moves the bodies itself within a step, so that the rate is not constant over it."""
        return "effective_mass" in self.variables and self.moves_bodies()

    def ready(self, **parameters):
        """An instance that has left Initialization Mode."""
        instance = FMU2Instance(self)
        instance.initialize(**parameters)
        return instance


# fmpy has one logger for the process, the last one, and lets it be freed: this one serves all instances, by a number
_instances = WeakValueDictionary()


def _logged(number, name, status, category, message):
    if number in _instances:
        _instances[number].log.append((status, category.decode(), message.decode()))


_callbacks = fmi2.fmi2CallbackFunctions()
_callbacks.logger = fmi2.fmi2CallbackLoggerTYPE(_logged)
addLoggerProxy(byref(_callbacks))


class FMU2Instance(fmi2.FMU2Slave):
    """One instance; fmpy chooses the functions by the beginning of this name."""

    def __init__(self, unit):
        description = unit.description
        super().__init__("instance", guid=description.guid, unzipDirectory=unit.folder,
                         modelIdentifier=description.coSimulation.modelIdentifier)  # fmt: skip
        self.unit, self.time = unit, 0.0
        # status, category and message, as the importer sees them
        self.log = []
        callbacks = fmi2.fmi2CallbackFunctions(logger=_callbacks.logger, componentEnvironment=id(self))
        _instances[id(self)] = self
        self.instantiate(callbacks=callbacks, loggingOn=True)

    def __del__(self):
        self.freeInstance()

    def initialize(self, **parameters):
        self.setupExperiment()
        self.enterInitializationMode()
        self.set(**parameters)
        self.exitInitializationMode()
        self.time = 0.0

    def references(self, names):
        return [self.unit.variables[name].valueReference for name in names]

    def set(self, **values):
        self.setReal(self.references(values), list(values.values()))

    def get(self, name):
        return self.getReal(self.references([name]))[0]

    def outputs(self):
        """The values of all outputs that are no enumerations."""
        names = [name for name in self.unit.outputs if self.unit.variables[name].type == "Real"]
        return dict(zip(names, self.getReal(self.references(names)), strict=True))

    def set_derivatives(self, *values, orders=None, name="indentation_rate"):
        """First, second ... derivative of the rate, or those of these orders."""
        orders = orders or range(1, len(values) + 1)
        self.setRealInputDerivatives(self.references([name] * len(values)), orders, values)

    def derivative(self, order, name="force"):
        return self.getRealOutputDerivatives(self.references([name]), [order])[0]

    def step(self, step, rate=None):
        """One step from the end of the last one."""
        if rate is not None:
            self.set(indentation_rate=rate)
        self.doStep(self.time, step)
        self.time += step

    def state(self):
        """The state as bytes."""
        state = self.getFMUstate()
        data = self.serializeFMUstate(state)
        self.freeFMUstate(state)
        return data

    def restore(self, data):
        state = self.deSerializeFMUstate(data)
        self.setFMUstate(state)
        self.freeFMUstate(state)
