"""Temporary folders."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def folder() -> Iterator[Path]:
    """A folder of the user alone, which is removed at the end."""
    with tempfile.TemporaryDirectory(prefix="brinell-", ignore_cleanup_errors=True) as made:
        yield Path(made)
