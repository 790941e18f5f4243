"""Temporary folders. A process that is killed leaves its own; the next one that makes one removes them."""

from __future__ import annotations

import os
import re
import shutil
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from importlib import import_module
from pathlib import Path
from typing import Any

fcntl: Any
try:
    fcntl = import_module("fcntl")
except ImportError:  # Windows: only the age decides
    fcntl = None

_PREFIX, _SUFFIX = "brinell-", ".tmp"
_NAME = re.compile(r"brinell-[a-z0-9_]{8}\.tmp")
_LOCKED = 10.0
"""From this age [s] on it has its lock: it is locked after it is made."""
_ABANDONED = 24 * 3600.0
"""From this age [s] on it is left over where there are no locks."""


@contextmanager
def folder() -> Iterator[Path]:
    """A folder of the user alone, which is removed at the end."""
    made = Path(tempfile.mkdtemp(prefix=_PREFIX, suffix=_SUFFIX))
    try:
        with held(made):
            sweep(made.parent, _NAME.fullmatch, made)
            yield made
    finally:
        shutil.rmtree(made, ignore_errors=True)


@contextmanager
def held(path: Path) -> Iterator[None]:
    """Lock a file or a folder, as long as this process lives, so that nobody sweeps it."""
    handle = _locked(path)
    try:
        yield
    finally:
        if handle is not None and handle >= 0:
            os.close(handle)


def sweep(place: Path, is_named: Callable[[str], object], own: Path) -> None:
    """Remove what killed processes have left in `place`: of the kind and the owner of `own`. What
    can't be removed only takes space."""
    with suppress(OSError):
        ours = own.lstat()
        for path in [Path(it) for it in os.scandir(place) if is_named(it.name)]:
            with suppress(OSError):
                found = path.lstat()
                same = (found.st_mode & 0o170000, found.st_uid) == (ours.st_mode & 0o170000, ours.st_uid)
                if path == own or not same or not _is_left(path, time.time() - found.st_mtime):
                    continue
                if path.is_dir():
                    shutil.rmtree(path, ignore_errors=True)
                else:
                    path.unlink()


def _is_left(path: Path, age: float) -> bool:
    """Whether nobody uses it any more."""
    if age < _LOCKED:
        return False
    handle = _locked(path)
    if handle is None:
        return age > _ABANDONED
    if handle < 0:
        return False
    os.close(handle)
    return True


def _locked(path: Path) -> int | None:
    """A handle that holds the lock; -1 if another one has it, None where there are no locks."""
    if fcntl is None:
        return None
    try:
        handle = os.open(path, os.O_RDONLY)
    except OSError:
        return None
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        os.close(handle)
        return -1 if isinstance(error, BlockingIOError) else None
    return handle
