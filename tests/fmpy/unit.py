"""An FMU for the tests: every C function by its name, with its status instead of an exception, and its log as a list."""

import atexit
import ctypes
import json
import os
import shutil
from ctypes import byref, c_char, c_double, c_int, c_size_t, c_void_p, create_string_buffer
from functools import cache
from weakref import WeakValueDictionary

import fmpy
from fmpy import fmi2
from fmpy.logging import addLoggerProxy

OK, WARNING, DISCARD, ERROR = 0, 1, 2, 3
CO_SIMULATION = fmi2.fmi2CoSimulation


def paths():
    """Path of each exported FMU, by the name of its scene."""
    return json.loads(os.environ["BRINELL_TEST_UNITS"])


@cache
def unit(name):
    return Unit(paths()[name])


class Unit:
    """An unpacked FMU with its library."""

    def __init__(self, path):
        self.path = path
        self.folder = fmpy.extract(path)
        atexit.register(shutil.rmtree, self.folder, ignore_errors=True)
        self.description = fmpy.read_model_description(path)
        self.variables = {variable.name: variable for variable in self.description.modelVariables}
        self.reference = {name: variable.valueReference for name, variable in self.variables.items()}
        self.slave = fmi2.FMU2Slave(
            guid=self.description.guid,
            unzipDirectory=self.folder,
            modelIdentifier=self.description.coSimulation.modelIdentifier,
        )
        self.parameters = [name for name, v in self.variables.items() if v.causality == "parameter"]
        self.outputs = [name for name, v in self.variables.items() if v.causality == "output"]

    def moves_bodies(self):
        """Whether it moves the bodies itself within a step; it then reports the force to apply."""
        names = {name.split(".")[-1] for name in self.variables}
        return {"effective_mass", "mean_force"} <= names and "restitution" not in names

    def knows_mass(self):
        """Whether it moves the bodies itself within a step, so that the rate is not constant over it."""
        return "effective_mass" in self.variables and self.moves_bodies()

    def instance(self, **arguments):
        return Instance(self, **arguments)

    def ready(self, start=0.0, stop=None, **parameters):
        """An instance that has left Initialization Mode."""
        instance = self.instance()
        instance.initialize(start, stop, **parameters)
        return instance


class Refused(Exception):
    """A call did not return fmi2OK."""

    def __init__(self, function, status, log):
        super().__init__(f"{function} returned {status}: {log}")
        self.status = status


# fmpy has one logger for the process, the last one, and lets it be freed: this one serves all instances, by a number
_instances = WeakValueDictionary()


def _logged(number, name, status, category, message):
    if number in _instances:
        _instances[number].log.append((name.decode(), status, category.decode(), message.decode()))


_callbacks = fmi2.fmi2CallbackFunctions()
_callbacks.logger = fmi2.fmi2CallbackLoggerTYPE(_logged)
addLoggerProxy(byref(_callbacks))


class Instance:
    """One instance. `try_` calls return the status; the others raise `Refused` unless it is fmi2OK."""

    def __init__(self, unit, name="instance", logging=False):
        self.unit = unit
        self.time = 0.0
        # (instance name, status, category, message) as seen by the importer, with the printf format processed
        self.log = []
        self.callbacks = fmi2.fmi2CallbackFunctions()
        self.callbacks.logger = _callbacks.logger
        self.callbacks.componentEnvironment = id(self)
        _instances[id(self)] = self
        guid = unit.description.guid.encode()
        callbacks = byref(self.callbacks)
        self.component = unit.slave.fmi2Instantiate(name.encode(), CO_SIMULATION, guid, b"", callbacks, False, logging)

    def __del__(self):
        self.unit.slave.fmi2FreeInstance(self.component)

    def try_(self, function, *arguments):
        # not through fmpy's own method, which raises an exception for a status other than OK and Warning
        return self.unit.slave._functions["fmi2" + function](self.component, *arguments)

    def call(self, function, *arguments):
        status = self.try_(function, *arguments)
        if status != OK:
            raise Refused(function, status, self.log)

    # experiment and phases

    def try_setup(self, start=0.0, stop=None):
        return self.try_("SetupExperiment", False, 0.0, start, stop is not None, 0.0 if stop is None else stop)

    def setup(self, start=0.0, stop=None):
        assert self.try_setup(start, stop) == OK, self.log
        self.time = start

    def initialize(self, start=0.0, stop=None, **parameters):
        self.setup(start, stop)
        self.call("EnterInitializationMode")
        self.set(**parameters)
        self.call("ExitInitializationMode")

    # variables; a dot in a name is written as two underscores in keyword arguments

    def _reference(self, name):
        return name if isinstance(name, int) else self.unit.reference[name.replace("__", ".")]

    def try_set(self, name, value):
        return self.try_("SetReal", (fmi2.fmi2ValueReference * 1)(self._reference(name)), 1, (c_double * 1)(value))

    def set(self, **values):
        for name, value in values.items():
            if self.try_set(name, value) != OK:
                raise Refused(f"SetReal({name} = {value})", ERROR, self.log)

    def try_get(self, name):
        value = (c_double * 1)()
        return self.try_("GetReal", (fmi2.fmi2ValueReference * 1)(self._reference(name)), 1, value), value[0]

    def get(self, name):
        """The value of a variable of either type."""
        if not isinstance(name, int) and self.unit.variables[name.replace("__", ".")].type == "Enumeration":
            value = (c_int * 1)()
            self.call("GetInteger", (fmi2.fmi2ValueReference * 1)(self._reference(name)), 1, value)
            return value[0]
        status, value = self.try_get(name)
        if status != OK:
            raise Refused(f"GetReal({name})", status, self.log)
        return value

    def outputs(self):
        return {name: self.get(name) for name in self.unit.outputs}

    # derivatives

    def try_set_derivatives(self, name, orders, values):
        count = len(orders)
        references = (fmi2.fmi2ValueReference * count)(*[self._reference(name)] * count)
        return self.try_("SetRealInputDerivatives", references, count, (c_int * count)(*orders), (c_double * count)(*values))

    def set_derivatives(self, *values):
        """First, second ... derivative of the rate."""
        if self.try_set_derivatives("indentation_rate", range(1, len(values) + 1), values) != OK:
            raise Refused(f"SetRealInputDerivatives({values})", ERROR, self.log)

    def derivative(self, order, name="force"):
        value = (c_double * 1)()
        references = (fmi2.fmi2ValueReference * 1)(self._reference(name))
        self.call("GetRealOutputDerivatives", references, 1, (c_int * 1)(order), value)
        return value[0]

    # steps

    def try_step(self, time, step):
        return self.try_("DoStep", time, step, True)

    def step(self, step, rate=None):
        """One step from the end of the last one."""
        if rate is not None:
            self.set(indentation_rate=rate)
        self.call("DoStep", self.time, step, True)
        self.time += step

    # state

    def state(self):
        """The state as bytes."""
        pointer = c_void_p()
        self.call("GetFMUstate", byref(pointer))
        size = c_size_t()
        self.call("SerializedFMUstateSize", pointer, byref(size))
        buffer = create_string_buffer(size.value)
        self.call("SerializeFMUstate", pointer, ctypes.cast(buffer, ctypes.POINTER(c_char)), size.value)
        self.call("FreeFMUstate", byref(pointer))
        assert pointer.value is None, "fmi2FreeFMUstate sets the pointer to null"
        return buffer.raw

    def try_deserialize(self, data):
        """Status and pointer of fmi2DeSerializeFMUstate."""
        pointer = c_void_p()
        # a buffer of exactly this length, so that a read beyond its end is not hidden by a final 0
        buffer = (c_char * len(data)).from_buffer_copy(data)
        return self.try_("DeSerializeFMUstate", buffer, len(data), byref(pointer)), pointer

    def restore(self, data):
        status, pointer = self.try_deserialize(data)
        if status != OK:
            raise Refused("DeSerializeFMUstate", status, self.log)
        self.call("SetFMUstate", pointer)
        self.call("FreeFMUstate", byref(pointer))


def bits(value):
    """The bits of a number: unlike ==, they distinguish 0.0 from -0.0 and are equal for NaN."""
    return value.hex() if isinstance(value, float) else value
