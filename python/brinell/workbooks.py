"""Workbooks as rows of cells, also for tensile tests that a scene names: the exporter reads text."""

from __future__ import annotations

import json
import os
import tempfile
import tomllib
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

EXCEL = (".xlsx", ".xlsm", ".xls", ".ods")
NAMES = ("tensile_test", "curve")
"""Keys of a scene that may name a file."""
VARIABLE = "BRINELL_WORKBOOKS"
"""Tells the exporter where the texts of workbooks are, by the names that a scene gives them."""


def sheets_of(path: Path) -> dict[str, list[list[Any]]]:
    """The rows of each sheet."""
    try:
        import pandas

        frames = pandas.read_excel(path, sheet_name=None, header=None, dtype=object, keep_default_na=False)
        return {str(name): frame.to_numpy().tolist() for name, frame in frames.items()}
    except ImportError as error:
        needs = f"{path}: a workbook needs {error.name or 'openpyxl'} (pip install 'brinell[fit]')"
        raise ModuleNotFoundError(f"{needs}, or save it as CSV", name=error.name) from None


def _named(value: Any) -> Iterator[str]:
    """The names of workbooks in a part of a scene."""
    if isinstance(value, list):
        value = dict(enumerate(value))
    if isinstance(value, dict):
        for key, it in value.items():
            if key in NAMES and isinstance(it, str) and it.lower().endswith(EXCEL):
                yield it
            yield from _named(it)


@contextmanager
def environment(arguments: Sequence[str | Path]) -> Iterator[dict[str, str] | None]:
    """The environment of the exporter for a command with a scene that names workbooks."""
    scenes = [Path(it) for it in arguments if str(it).endswith(".toml") and Path(it).is_file()]
    found = dict[str, Path]()
    for scene in scenes:
        text = scene.read_text(encoding="utf-8", errors="replace")
        if any(ending in text.lower() for ending in EXCEL):
            try:
                data = tomllib.loads(text)
            except tomllib.TOMLDecodeError:
                continue  # the exporter tells
            names = {name: scene.parent / name for name in _named(data)}
            found |= {name: path for name, path in names.items() if path.is_file()}
    if not found:
        yield None
        return
    from .fits.reading import text_of

    with tempfile.TemporaryDirectory(prefix="brinell-") as folder:
        texts = {}
        for index, (name, path) in enumerate(found.items()):
            sheets = sheets_of(path)
            # the sheet with the most cells has the test
            rows = max(sheets.values(), key=lambda rows: sum(map(len, rows)), default=[])
            texts[name] = str(Path(folder) / f"{index}.csv")
            Path(texts[name]).write_text(text_of(rows), encoding="utf-8")
        yield os.environ | {VARIABLE: json.dumps(texts)}
