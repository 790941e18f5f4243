"""Tables on disk: the parts of an unfinished study, and its result as Parquet or CSV."""

from __future__ import annotations

import hashlib
import json
import shutil
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pyarrow
from pyarrow import csv, parquet

from .impacts import Table


class Parts:
    """The finished chunks, in a folder beside the future result: an interrupted study continues
    from them.

    They belong to one plan. Parts of another study are not overwritten, since they may have taken
    long to compute.
    """

    def __init__(self, output: Path, plan: bytes, size: int) -> None:
        """`size` is the number of runs of a chunk if the study is new."""
        self.folder = output.with_name(output.name + ".parts")
        key, note = hashlib.sha256(plan).hexdigest(), self.folder / "plan.json"
        self.size = size
        """Number of runs in a chunk of these parts."""
        if note.is_file():
            known = json.loads(note.read_text())
            if known["plan"] != key:
                raise ValueError(
                    f"{self.folder} has parts of another study: finish that one, "
                    "or delete the folder"
                )
            self.size = known["chunk"]
        else:
            self.folder.mkdir(parents=True, exist_ok=True)
            draft = note.with_suffix(".draft")
            draft.write_text(json.dumps({"plan": key, "chunk": size}))
            draft.replace(note)

    def load(self, chunk: int) -> Table | None:
        """A chunk, or None if it is not finished."""
        path = self.folder / f"{chunk:06}.parquet"
        return read(path) if path.is_file() else None

    def save(self, chunk: int, table: Table) -> None:
        """Save a chunk; its file is complete, or does not exist."""
        path = self.folder / f"{chunk:06}.parquet"
        draft = path.with_suffix(".draft")
        parquet.write_table(pyarrow.table(table), draft)
        draft.replace(path)

    def remove(self) -> None:
        """Remove the parts, after the result is written."""
        shutil.rmtree(self.folder)


def write(path: Path, table: Table) -> None:
    """Write a table; the extension selects .parquet or .csv."""
    arrow = pyarrow.table(table)
    if path.suffix == ".parquet":
        parquet.write_table(arrow, path)
    else:
        csv.write_csv(arrow, path)


def read(path: Path) -> Table:
    """Read the table of a .parquet file."""
    columns = parquet.read_table(path)
    return {name: columns[name].to_numpy() for name in columns.column_names}


def joined(tables: Sequence[Table]) -> Table:
    """The chunks, in their order, as one table."""
    return {name: np.concatenate([table[name] for table in tables]) for name in tables[0]}
