"""Temporary folders, and files that appear whole."""

from __future__ import annotations

import tempfile
import uuid
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def folder() -> Iterator[Path]:
    """A folder of the user alone, which is removed at the end."""
    with tempfile.TemporaryDirectory(prefix="brinell-", ignore_cleanup_errors=True) as made:
        yield Path(made)


@contextmanager
def draft(path: Path) -> Iterator[Path]:
    """A file beside `path`, of the same kind, that takes its place at the end. After an error the file
    that was there is as it was."""
    # a link keeps leading to the file
    path = path.resolve()
    made = path.with_name(f".{uuid.uuid4().hex}-{path.name}")
    try:
        yield made
        made.replace(path)
    finally:
        made.unlink(missing_ok=True)
