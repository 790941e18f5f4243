"""An unpacked unit: its functions and its variables, shared by all contacts that are made of it."""

from __future__ import annotations

import itertools
import os
import shutil
import threading
import weakref
from ctypes import byref, c_void_p
from pathlib import Path
from typing import Any

import fmpy
from fmpy import fmi2, freeLibrary

from .errors import ContactError

WARNING = 1


_open: weakref.WeakValueDictionary[tuple[Any, ...], Library] = weakref.WeakValueDictionary()
_opening = threading.Lock()


class Library:
    """The library of a unit, in memory. `Library.of` gives the one that is there already, if there
    is one."""

    def __init__(self, path: Path) -> None:
        try:
            description = fmpy.read_model_description(str(path), validate=False)
        except Exception as error:
            raise ContactError(f"{path} isn't a unit: {error}") from error
        if description.fmiVersion != "2.0" or description.coSimulation is None:
            raise ContactError(f"{path} isn't a unit of FMI 2.0 for co-simulation")
        self.path = path
        self.description = description
        self.variables = {variable.name: variable for variable in description.modelVariables}
        folder = str(fmpy.extract(str(path)))
        try:
            identifier = description.coSimulation.modelIdentifier
            slave = fmi2.FMU2Slave(
                guid=description.guid, unzipDirectory=folder, modelIdentifier=identifier
            )
        except Exception as error:
            shutil.rmtree(folder, ignore_errors=True)
            raise ContactError(f"{path} can't be loaded on {fmpy.platform}: {error}") from error
        # not through fmpy's own methods: their exceptions don't have the unit's text
        self.functions = slave._functions
        if os.name == "posix":
            # what is loaded needs no file; processes that end without a word would leave theirs
            shutil.rmtree(folder, ignore_errors=True)
        weakref.finalize(self, _close, slave.dll._handle, folder)

    @staticmethod
    def of(path: str | Path | Library) -> Library:
        """The library of the unit at `path`: unpacked and loaded once, as long as somebody uses
        it."""
        if isinstance(path, Library):
            return path
        path = Path(path)
        if not path.is_file():
            raise FileNotFoundError(f"there is no unit {path}")
        path = path.resolve()
        status = path.stat()
        # a unit that is exported again is another one
        key = (path, status.st_mtime_ns, status.st_size, status.st_ino)
        with _opening:
            library = _open.get(key)
            if library is None:
                library = _open[key] = Library(path)
            return library


def _close(handle: int, folder: str) -> None:
    freeLibrary(handle)
    shutil.rmtree(folder, ignore_errors=True)


# The log. One function serves all instances and is told apart by a number, since fmpy's own proxy
# keeps a single logger for the whole process. It needs no printf: a unit sends whole texts, in
# which the signs that printf and importers take for commands are doubled.

_numbers = itertools.count(1)
_logs: dict[int, list[tuple[int, str]]] = {}


def _logger(number: int, _name: bytes, status: int, _category: bytes, message: bytes) -> None:
    log = _logs.get(number)
    if log is not None:
        text = message.decode("utf-8", "replace").replace("%%", "%").replace("##", "#")
        log.append((status, text))


_LOGGER = fmi2.fmi2CallbackLoggerTYPE(_logger)


class Instance:
    """One instance of a unit: its calls by name, with the unit's own text where one is refused."""

    def __init__(self, library: Library, name: str) -> None:
        self.library = library
        self.functions = library.functions
        number = next(_numbers)
        self.log: list[tuple[int, str]] = []
        _logs[number] = self.log
        self._callbacks = fmi2.fmi2CallbackFunctions()
        self._callbacks.logger = _LOGGER
        self._callbacks.allocateMemory = fmi2.defaultCallbacks.allocateMemory
        self._callbacks.freeMemory = fmi2.defaultCallbacks.freeMemory
        self._callbacks.componentEnvironment = number
        component = self.functions["fmi2Instantiate"](
            name.encode(),
            fmi2.fmi2CoSimulation,
            library.description.guid.encode(),
            b"",
            byref(self._callbacks),
            False,
            True,
        )
        self.component: c_void_p | None = component
        if component is None:
            del _logs[number]
            raise ContactError(f"{library.path}: the unit makes no instance: {self.text()}")
        # the library, too, stays until the instance is gone
        self._finalizer = weakref.finalize(self, _free, library, component, number)

    def call(self, function: str, *arguments: Any) -> None:
        """Calls `fmi2<function>`; raises `ContactError` with the unit's text if it is refused."""
        status = self.functions["fmi2" + function](self.component, *arguments)
        if status > WARNING:
            raise self.refusal(function)

    def refusal(self, function: str) -> ContactError:
        """The error of a call that was refused just now."""
        return ContactError(self.text() or f"fmi2{function} is refused without a word")

    def text(self) -> str:
        """What the unit has said that is an error, once."""
        text = "; ".join(text for status, text in self.log if status > WARNING)
        self.log[:] = [entry for entry in self.log if entry[0] <= WARNING]
        return text

    def warnings(self) -> list[str]:
        """What the unit has said that is no error, once."""
        texts = [text for status, text in self.log if status <= WARNING]
        self.log.clear()
        return texts

    def close(self) -> None:
        """Frees the instance; a second time does nothing."""
        self.component = None
        self._finalizer()


def _free(library: Library, component: Any, number: int) -> None:
    library.functions["fmi2FreeInstance"](component)
    _logs.pop(number, None)
