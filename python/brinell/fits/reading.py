"""Tables of measurements. The exporter reads them, in any dialect; workbooks and frames become text here."""

from __future__ import annotations

import csv
import io
import json
import math
import zipfile
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal as Exact
from numbers import Real
from pathlib import Path
from typing import Any, Literal

from ..errors import missing, shortened
from ..program import run
from ..workbooks import EXCEL, sheets_of

MOST = 100_000
"""Largest number of rows of a fit."""
PARQUET = (".parquet", ".pq")
Decimal = Literal[".", ","]


@dataclass(frozen=True)
class Rows:
    """A table, as the exporter read it."""

    name: str
    """The source, in messages."""
    place_of: str
    """What stands between it and the number of a line."""
    before: int
    """The lines before the first row that counts."""
    columns: list[dict[str, Any]]
    """Each with its `heading`, `quantity`, `name`, `unit`, `size` and `cells`."""
    unknown: list[str]
    lines: list[int]
    heading: int
    notes: list[str]
    readings: list[str] | None
    wrong_reading: dict[str, Any] | None
    examples: str

    def place(self, row: int | None = None, column: Mapping[str, Any] | None = None) -> str:
        """The place of a cell, a row, or the heading."""
        line = self.heading if row is None else self.lines[row]
        at = None if column is None else int(column["index"]) + 1
        return _place(self.name, self.place_of, self.before, line, at)


def _place(name: str, of: str, before: int, line: int | None, column: int | None) -> str:
    heading = line is not None and line <= before
    where = name if line is None or heading else f"{name}{of}{line - before}"
    return where if column is None else f"{where}, column {column}"


def rows_of(source: Any, decimal: Decimal | None = None, renamed: Mapping[str, str] | None = None) -> Rows:
    """The rows of a file or a table."""
    if decimal not in (None, ".", ","):
        raise ValueError(f"decimal = {decimal!r}; allowed are '.' and ','")
    options = [f"--columns={json.dumps(dict(renamed or {}))}"]
    options += [] if decimal is None else [f"--decimal={decimal}"]
    if not isinstance(source, str | Path):
        return _of_table(source, options)
    path = Path(source)
    if not path.exists():
        raise missing("file", path)
    ending = path.suffix.lower()
    _check_size(path, ending)
    if ending in EXCEL:
        return _of_excel(path, options)
    if ending in PARQUET:
        import pandas

        return _of_table(pandas.read_parquet(path), options, str(path))
    return _read((str(path), ":", 0), [path.absolute(), *options])


LARGEST = 40_000_000
"""Largest size of a file, and of one that is unpacked, in bytes: that of the program."""


def _check_size(path: Path, ending: str) -> None:
    """Refuse a file that is too large before it is read, and one that isn't when it is packed."""

    def check(size: int, what: str) -> None:
        if size > LARGEST:
            raise ValueError(f"{path}: {what} {size / 1e6:.0f} MB; allowed for a measurement is {LARGEST / 1e6:.0f} MB")

    check(path.stat().st_size, "the file has")
    if ending in (".xlsx", ".xlsm", ".ods") and zipfile.is_zipfile(path):
        with zipfile.ZipFile(path) as archive:
            for part in archive.infolist():
                check(part.file_size, f"{shortened(part.filename)} in it has")
            check(sum(part.file_size for part in archive.infolist()), "its parts together have")
    if ending in PARQUET:
        from pyarrow import parquet

        rows = parquet.read_metadata(path).num_rows
        if rows > MOST:
            raise ValueError(f"{path}: it has {rows} rows; allowed is 1 to {MOST}")


def _read(place: tuple[str, str, int], arguments: Sequence[str | Path], text: str | None = None) -> Rows:
    found = json.loads(run("table", *arguments, text=text)[0])
    if wrong := found.get("wrong"):
        where = _place(*place, wrong["line"], wrong["column"])
        hint = ". Pass decimal='.' or decimal=','" if " is ambiguous: " in wrong["why"] else ""
        raise ValueError(f"{where}: {wrong['why'].split('. Write one')[0]}{hint}")
    rows = Rows(*place, **found)
    if len(rows.lines) > MOST:
        raise ValueError(f"{rows.place(MOST)}: there are more than {MOST} rows")
    return rows


def text_of(rows: Iterable[Iterable[Any]]) -> str:
    """Rows of cells as a text with tabs. A number has an exponent, and so no decimal sign."""
    text = io.StringIO()
    csv.writer(text, delimiter="\t", quoting=csv.QUOTE_ALL, lineterminator="\n").writerows(
        map(_written, row) for row in rows
    )
    return text.getvalue()


def _written(cell: Any) -> str:
    if cell is None:
        return ""
    if not isinstance(cell, Real) or cell is True or cell is False:
        return " ".join(str(cell).split())
    number = float(cell)
    if not math.isfinite(number):
        return "" if math.isnan(number) else str(number)
    sign, digits, exponent = Exact(repr(number)).as_tuple()
    return f"{'-' * sign}{''.join(map(str, digits))}e{exponent}"


TAB = "--separator=\t"


def _of_table(table: Any, options: list[str], name: str = "the measurement") -> Rows:
    """The rows of a DataFrame or another mapping."""
    if not isinstance(table, Mapping) and not hasattr(table, "columns"):
        raise TypeError(
            f"a measurement is the path of a file, a DataFrame or a mapping from headings to columns, "
            f"not {type(table).__name__}"
        )
    import pandas

    try:
        frame = pandas.DataFrame(table)
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from error
    if not 0 < len(frame) <= MOST:
        raise ValueError(f"{name} has {len(frame)} rows; allowed is 1 to {MOST}")
    text = text_of([frame.columns, *frame.astype(object).to_numpy().tolist()])
    # rows count from 0, below the heading
    return _read((name, ", row ", 2), [TAB, *options], text)


def _of_excel(path: Path, options: list[str]) -> Rows:
    """The first sheet of a workbook that is a table."""
    sheets = sheets_of(path)
    wrong = []
    for sheet, rows in sheets.items():
        try:
            found = _read((f"{path}, sheet {sheet}", ", row ", 0), [TAB, *options], text_of(rows))
        except ValueError as error:
            wrong.append(str(error))
            continue
        others = ", ".join(it for it in sheets if it != sheet)
        if others:
            found.notes.insert(0, f"The sheet {sheet} was read; others: {others}.")
        return found
    raise ValueError("; ".join(wrong) or f"{path}: the workbook is empty")
