"""Errors and warnings, and what their texts have in common."""

from __future__ import annotations

import difflib
import errno
import sys
import warnings
from collections.abc import Iterable
from itertools import islice
from pathlib import Path

COMPARED = 10_000
"""Most names that a wrong one is compared with: an FMU may have many more."""


class ContactError(RuntimeError):
    """An FMU has rejected a call; the text is that of the FMU."""


class UnknownName(ContactError, KeyError):
    """There is no such variable; the text names the nearest and lists those that exist."""

    # KeyError would show the text in quotation marks
    __str__ = RuntimeError.__str__


class ProgramError(RuntimeError):
    """The exporter is missing, or has rejected something; the text is that of the exporter."""


class ProgramWarning(UserWarning):
    """The exporter doubts a number, or warns that the law is not valid; the text is its own."""


class ContactWarning(UserWarning):
    """An FMU warns: its law is not valid where the contact is, its passivity guard acts, or it is
    coupled wrongly."""


def nearest(name: object, names: Iterable[str]) -> str:
    """` (did you mean 'radius'?)`, or nothing if none of `names` is near."""
    near = difflib.get_close_matches(str(name), islice(names, COMPARED), 1)
    return f" (did you mean {near[0]!r}?)" if near else ""


def missing(what: str, path: str | Path) -> FileNotFoundError:
    """The error for a file or a folder that does not exist."""
    return FileNotFoundError(errno.ENOENT, f"there is no {what}", str(path))


def tell(text: str, category: type[Warning]) -> None:
    """Warn at the line outside this package that called it."""
    level, frame = 1, sys._getframe()
    while frame.f_back and frame.f_globals.get("__name__", "").startswith(f"{__package__}."):
        level, frame = level + 1, frame.f_back
    warnings.warn(text, category, stacklevel=level)


def shortened(text: str, most: int = 80) -> str:
    """A text that fits into a message."""
    return text if len(text) <= most else text[:most] + "..."


def one_of(names: Iterable[str]) -> str:
    """`a, b or c`."""
    *first, last = names
    return f"{', '.join(first)} or {last}" if first else last
