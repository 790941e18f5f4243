"""An unpacked FMU: its functions and variables, shared by all contacts that use it."""

from __future__ import annotations

import hashlib
import itertools
import os
import threading
import weakref
from contextlib import ExitStack
from ctypes import byref, c_void_p
from pathlib import Path
from typing import Any

import fmpy
from fmpy import fmi2, freeLibrary

from . import temporary
from .errors import ContactError, missing
from .program import export, unpack

WARNING = 1


_open: weakref.WeakValueDictionary[tuple[Any, ...], Library] = weakref.WeakValueDictionary()
_opening = threading.Lock()


class Library:
    """The library of an FMU, in memory. `Library.of` returns the one that is already loaded, if
    there is one."""

    def __init__(self, path: Path) -> None:
        self.path = path
        with ExitStack() as stack:
            folder = stack.enter_context(temporary.folder())
            # by the rules of the program: what it refuses isn't loaded here either
            found = unpack(path, folder)
            try:
                description = fmpy.read_model_description(str(folder), validate=False)
                slave = fmi2.FMU2Slave(
                    guid=description.guid,
                    unzipDirectory=str(folder),
                    modelIdentifier=found["identifier"],
                    libraryPath=str(folder / found["library"]),
                )
            except Exception as error:
                raise ContactError(f"{path} cannot be loaded on {fmpy.platform}: {error}") from error
            # a loaded library needs no file but on Windows
            kept = ExitStack() if os.name == "posix" else stack.pop_all()
        self.description = description
        self.variables = {variable.name: variable for variable in description.modelVariables}
        # not through fmpy's own methods: their exceptions lack the text of the FMU
        self.functions = slave._functions
        weakref.finalize(self, _close, slave.dll._handle, kept)

    @staticmethod
    def of(path: str | Path | Library) -> Library:
        """The library of the FMU at `path`: unpacked and loaded once, for as long as it is in
        use."""
        if isinstance(path, Library):
            return path
        path = Path(path)
        if not path.is_file():
            raise missing("scene" if path.suffix == ".toml" else "FMU", path)
        if path.suffix == ".toml":
            return _of_scene(path)
        path = path.resolve()
        status = path.stat()
        # an FMU that is exported again is a different one
        key = (path, status.st_mtime_ns, status.st_size, status.st_ino)
        return _opened(key, path)


def _opened(key: tuple[Any, ...], path: Path) -> Library:
    with _opening:
        library = _open.get(key)
        if library is None:
            library = _open[key] = Library(path)
        return library


def _of_scene(scene: Path) -> Library:
    """The library of the FMU of a scene, under the name of the scene. FMUs of equal bytes are loaded
    once."""
    with temporary.folder() as folder:
        path = export(scene, folder / f"{scene.stem}.fmu")
        library = _opened((hashlib.sha256(path.read_bytes()).digest(),), path)
    # the FMU is gone; what it was made from tells people more
    library.path = scene.resolve()
    return library


def _close(handle: int, kept: ExitStack) -> None:
    freeLibrary(handle)
    kept.close()


# The log. One function serves all instances and tells them apart by a number, since fmpy's own
# proxy keeps a single logger for the whole process. It needs no printf: an FMU sends complete
# texts, in which the characters that printf and importers interpret are doubled.

_numbers = itertools.count(1)
_logs: dict[int, list[tuple[int, str]]] = {}


def _logger(number: int, _name: bytes, status: int, _category: bytes, message: bytes) -> None:
    log = _logs.get(number)
    if log is not None:
        text = message.decode("utf-8", "replace").replace("%%", "%").replace("##", "#")
        log.append((status, text))


_LOGGER = fmi2.fmi2CallbackLoggerTYPE(_logger)


class Instance:
    """One instance of an FMU: its calls by name, with the text of the FMU if one is rejected."""

    def __init__(self, library: Library, name: str) -> None:
        self.library = library
        self.functions = library.functions
        number = next(_numbers)
        self.log: list[tuple[int, str]] = []
        self.advice = ""
        """What can be done after a refusal; it follows the FMU's text."""
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
            raise ContactError(f"{library.path}: the FMU creates no instance: {self.text()}")
        self._kept = c_void_p()
        # the library stays loaded until the instance is freed
        self._finalizer = weakref.finalize(self, _free, library, component, number, self._kept)

    def call(self, function: str, *arguments: Any) -> None:
        """Call `fmi2<function>`; raise `ContactError` with the FMU's text if it is rejected."""
        status = self.functions["fmi2" + function](self.component, *arguments)
        if status > WARNING:
            raise self.refusal(function)

    def keep(self) -> None:
        """Keep the state in the FMU's own memory, for `back`."""
        self.call("GetFMUstate", byref(self._kept))

    def back(self) -> None:
        """Return to the state that was kept last."""
        self.call("SetFMUstate", self._kept)

    def refusal(self, function: str) -> ContactError:
        """The error for a call that was just rejected."""
        text = self.text() or f"fmi2{function} was rejected without a message"
        return ContactError(text + self.advice)

    def text(self) -> str:
        """The error messages since the last call of this function."""
        text = "; ".join(text for status, text in self.log if status > WARNING)
        self.log[:] = [entry for entry in self.log if entry[0] <= WARNING]
        return text

    def warnings(self) -> list[str]:
        """The other messages since the last call of this function."""
        texts = [text for status, text in self.log if status <= WARNING]
        self.log.clear()
        return texts

    def close(self) -> None:
        """Free the instance; a second call does nothing."""
        self.component = None
        self._finalizer()


def _free(library: Library, component: Any, number: int, kept: c_void_p) -> None:
    library.functions["fmi2FreeFMUstate"](component, byref(kept))
    library.functions["fmi2FreeInstance"](component)
    _logs.pop(number, None)
