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

    def __init__(self, output: Path, plan: bytes) -> None:
        self.folder = output.with_name(output.name + ".parts")
        key, note = hashlib.sha256(plan).hexdigest(), self.folder / "plan.json"
        if note.is_file():
            if json.loads(note.read_text())["plan"] != key:
                raise ValueError(
                    f"{self.folder} has parts of another study: finish that one, "
                    "or delete the folder"
                )
        else:
            self.folder.mkdir(parents=True, exist_ok=True)
            note.write_text(json.dumps({"plan": key}))

    def load(self, chunk: int) -> Table | None:
        """A chunk, if it is finished."""
        path = self.folder / f"{chunk:06}.parquet"
        return read(path) if path.is_file() else None

    def save(self, chunk: int, table: Table) -> None:
        """Save a chunk; its file is complete, or does not exist."""
        path = self.folder / f"{chunk:06}.parquet"
        draft = path.with_suffix(".draft")
        parquet.write_table(pyarrow.table(_plain(table)), draft)
        draft.replace(path)

    def remove(self) -> None:
        """Remove the parts, after the result is written."""
        shutil.rmtree(self.folder)


def write(path: Path, table: Table) -> None:
    """Write a table; the extension selects .parquet or .csv."""
    arrow = pyarrow.table(_plain(table))
    if path.suffix == ".parquet":
        parquet.write_table(arrow, path)
    else:
        csv.write_csv(arrow, path)


def read(path: Path) -> Table:
    """Read the table of a .parquet file."""
    columns = parquet.read_table(path).to_pydict()
    texts = ("error", "warning")
    return {
        name: np.array(values, dtype=object if name in texts else float)
        for name, values in columns.items()
    }


def joined(tables: Sequence[Table]) -> Table:
    """The chunks, in their order, as one table."""
    return {name: np.concatenate([table[name] for table in tables]) for name in tables[0]}


def _plain(table: Table) -> dict[str, list[float | str]]:
    return {name: column.tolist() for name, column in table.items()}
