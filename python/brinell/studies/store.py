"""Tables on disk: the parts of an unfinished study, and its result as Parquet or CSV."""

from __future__ import annotations

import hashlib
import json
import os
import re
import shutil
import uuid
from collections.abc import Callable
from pathlib import Path

import pyarrow
from pyarrow import csv, parquet

from .. import temporary
from .impacts import Table

_NOTE = "plan.json"

_ATTEMPTS = 100
"""More than there are equal studies at once."""


class Parts:
    """The finished chunks, in a folder beside the future result: an interrupted study continues
    from them.

    They belong to one plan. Parts of another study are not overwritten, since they may have taken
    long to compute. Two equal studies at once share their parts. A part that is damaged, as after a
    power failure, counts as unfinished.
    """

    def __init__(self, output: Path, plan: bytes, size: int) -> None:
        """`size` is the number of runs of a chunk if the study is new."""
        self.folder = output.with_name(output.name + ".parts")
        self._key = hashlib.sha256(plan).hexdigest()
        self.size = size
        """Number of runs in a chunk of these parts."""
        known = self._known()
        if any(plan != self._key for plan, _ in known):
            raise ValueError(f"{self.folder} has parts of another study: finish that one, or delete the folder")
        if known:
            self.size = known[0][1]
        text = json.dumps({"plan": self._key, "chunk": self.size})
        self._put(_NOTE, lambda draft: draft.write_text(text))

    def _known(self) -> list[tuple[str, int]]:
        """The plans of the folder with the sizes of their chunks: that of its note, or, if the note
        is missing or damaged, those of its parts."""
        try:
            known = json.loads((self.folder / _NOTE).read_text(encoding="utf-8"))
            plan, size = known["plan"], known["chunk"]
            if isinstance(plan, str) and type(size) is int and size > 0:
                return [(plan, size)]
        except (FileNotFoundError, ValueError, KeyError, TypeError):
            pass
        parts = [_part(path) for path in sorted(self.folder.glob("*.parquet"))]
        return [(plan, size) for plan, size, _ in filter(None, parts)]

    def load(self, chunk: int, runs: int) -> Table | None:
        """A chunk of so many runs, or None if it is not finished."""
        part = _part(self.folder / f"{chunk:06}.parquet")
        if part is None or part[0] != self._key or part[2].num_rows != runs:
            return None
        return _columns(part[2])

    def save(self, chunk: int, table: Table) -> None:
        """Save a chunk; its file is complete, or does not exist."""
        arrow = pyarrow.table(table)
        arrow = arrow.replace_schema_metadata({"plan": self._key, "chunk": str(self.size)})
        self._put(f"{chunk:06}.parquet", lambda draft: parquet.write_table(arrow, draft, write_page_checksum=True))

    def _put(self, name: str, write: Callable[[Path], object]) -> None:
        """Write a file of the folder, again if an equal study finishes and removes it meanwhile."""
        for left in reversed(range(_ATTEMPTS)):
            try:
                self.folder.mkdir(parents=True, exist_ok=True)
                _replace(self.folder / name, write)
                return
            except (FileNotFoundError, FileExistsError):
                if left == 0:
                    raise

    def remove(self) -> None:
        """Remove the parts, after the result is written."""
        shutil.rmtree(self.folder, ignore_errors=True)


def _part(path: Path) -> tuple[str, int, pyarrow.Table] | None:
    """The plan of a part, the size of its chunks and its table; None if it is missing or damaged."""
    try:
        table = parquet.read_table(path, page_checksum_verification=True)
        known = table.schema.metadata
        return known[b"plan"].decode(), int(known[b"chunk"]), table
    except (OSError, pyarrow.ArrowException, KeyError, TypeError, ValueError):
        return None


def _replace(path: Path, write: Callable[[Path], object]) -> None:
    """Write a file under a name of its own, then give it its name: whoever reads it finds it whole,
    and whoever else writes it is not in the way."""
    # a link keeps leading to the file
    path = path.resolve()
    draft = path.with_name(f"{path.name}.{uuid.uuid4().hex}.draft")
    left = re.compile(re.escape(path.name) + r"\.[0-9a-f]{32}\.draft")
    try:
        draft.touch()
        with temporary.held(draft):
            temporary.sweep(path.parent, left.fullmatch, draft)
            write(draft)
        draft.replace(path)
    except BaseException:
        draft.unlink(missing_ok=True)
        raise


def write(path: Path, table: Table) -> None:
    """Write a table; the extension selects .parquet or .csv."""
    arrow = pyarrow.table(table)

    def whole(draft: Path) -> None:
        write_table = parquet.write_table if path.suffix == ".parquet" else csv.write_csv
        write_table(arrow, draft)
        # the parts are removed next: the table must be on the disk before
        with draft.open("rb+") as file:
            os.fsync(file.fileno())

    _replace(path, whole)


def read(path: Path) -> Table:
    """Read the table of a .parquet file."""
    return _columns(parquet.read_table(path))


def _columns(table: pyarrow.Table) -> Table:
    return {name: table[name].to_numpy() for name in table.column_names}
