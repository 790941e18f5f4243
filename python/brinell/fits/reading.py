"""Rows of cells from CSV files of any dialect, Excel, Parquet and tables in memory."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from .quantities import HARDNESS, counted, is_unit, known, nearest, shortened

MOST = 100_000
"""Largest number of rows."""
MOST_BEFORE = 200
"""Largest number of lines before the heading."""
EXCEL = (".xlsx", ".xlsm", ".xls", ".ods")
PARQUET = (".parquet", ".pq")
SEPARATORS: Mapping[str, str] = {
    ";": "semicolons", "\t": "tabs", ",": "commas", "|": "bars", " ": "spaces"
}  # fmt: skip
EXPECTED = (
    "a heading such as `speed [m/s], restitution` or `depth [um], force [N]`, and numbers below it"
)
Decimal = Literal[".", ","]
_GROUPED = {
    ",": re.compile(r"[-+]?[1-9]\d{0,2}(\.\d{3})+(,\d*)?"),
    ".": re.compile(r"[-+]?[1-9]\d{0,2}(,\d{3})+(\.\d*)?"),
}
"""Numbers with separators of thousands, by their decimal sign."""
_GAPS = re.compile(r"(?<=\d)[\u00a0\u2009\u202f' ’](?=\d{3}(\D|$))")
"""Spaces and apostrophes between thousands."""


@dataclass(frozen=True)
class Rows:
    """A heading, and rows of cells below it."""

    name: str
    """The source, in messages."""
    heading: list[str]
    units: list[str] | None
    """The line below the heading, if it has units."""
    rows: list[tuple[str, list[Any]]]
    """The place of each row in messages, and its cells."""
    decimal: Decimal
    notes: list[str]
    place: str = ""
    """The place of the heading."""


def rows_of(source: Any, decimal: Decimal | None = None) -> Rows:
    """The rows of a file or a table."""
    if decimal not in (None, ".", ","):
        raise ValueError(f"decimal = {decimal!r}; allowed are '.' and ','")
    if not isinstance(source, str | Path):
        return _of_table(source)
    path = Path(source)
    ending = path.suffix.lower()
    if ending in EXCEL:
        return _of_excel(path)
    if ending in PARQUET:
        import pandas

        return _of_table(pandas.read_parquet(path), str(path))
    return _of_text(path, _decoded(path), decimal)


def _decoded(path: Path) -> str:
    data = path.read_bytes()
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        encodings = ["utf-16"]
    else:
        # machines write the signs of their country
        encodings = ["utf-8-sig", "cp1252"]
    for encoding in encodings:
        try:
            text = data.decode(encoding)
        except UnicodeDecodeError:
            continue
        if "\0" not in text:
            return text.removeprefix("\ufeff")
    raise ValueError(f"{path}: the file is no text; expected CSV, or {', '.join(EXCEL + PARQUET)}")


def _of_text(path: Path, text: str, decimal: Decimal | None) -> Rows:
    lines = [
        (number, line)
        for number, line in enumerate(re.split(r"\r\n|\n|\r", text), start=1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if not lines:
        raise ValueError(f"{path}: the file is empty; expected {EXPECTED}")
    # Excel says its separator in a line of its own
    said = re.fullmatch(r"sep=(.)", lines[0][1].strip(), re.IGNORECASE)
    lines = lines[1:] if said else lines
    separator, at = _heading(lines, said[1] if said else None)
    cells = _splitter(separator)
    number, line = lines[at]
    heading = _cells(cells, f"{path}:{number}", line)
    notes = []
    if at:
        notes.append(f"Before the heading in line {number}, {counted(at, 'line')} passed over.")
    below = lines[at + 1 :]
    units = None
    if below:
        first = _cells(cells, f"{path}:{below[0][0]}", below[0][1])
        if any(map(is_unit, first)) and all(is_unit(it) or not it for it in first):
            units, below = [it.strip("[]()") for it in first], below[1:]
    rows = list[tuple[str, list[Any]]]()
    for number, line in below:
        place = f"{path}:{number}"
        if len(rows) == MOST:
            raise ValueError(f"{place}: there are more than {MOST} rows")
        row = _cells(cells, place, line)
        if not any(row):
            continue
        while len(row) > len(heading) and not row[-1]:
            row.pop()
        if len(row) != len(heading):
            why = (
                "; a decimal comma needs another separator than commas" if separator == "," else ""
            )
            raise ValueError(
                f"{place}: {len(row)} cells, and the heading has {len(heading)}, separated by "
                f"{SEPARATORS[separator]}{why}"
            )
        rows.append((place, [*row]))
    sign = decimal or _decimal(str(path), [row for _, row in rows], separator)
    if separator != "," or sign == ",":
        words = {".": "point", ",": "comma"}[sign]
        notes.append(f"Cells are separated by {SEPARATORS[separator]}, with a decimal {words}.")
    return Rows(str(path), heading, units, rows, sign, notes, f"{path}:{lines[at][0]}")


def _splitter(separator: str) -> Callable[[str], list[str]]:
    if separator == " ":
        # not within brackets
        return lambda line: re.split(r"\s+(?![\[(]|[^\[(]*[\])])", line.strip())
    return lambda line: next(
        csv.reader([line], delimiter=separator, strict=True, skipinitialspace=True)
    )


def _cells(split: Callable[[str], list[str]], place: str, line: str) -> list[str]:
    try:
        return [cell.strip() for cell in split(line)]
    except csv.Error:
        raise ValueError(f"{place}: a quotation mark is not closed") from None


def _heading(lines: Sequence[tuple[int, str]], said: str | None) -> tuple[str, int]:
    """The separator, and the index of the line that names the most quantities."""
    best, found = 0, (said or "", 0)
    for separator in (said,) if said else SEPARATORS:
        cells = _splitter(separator)
        for index, (_, line) in enumerate(lines[:MOST_BEFORE]):
            try:
                row = cells(line)
            except csv.Error:
                continue
            if separator == " " and HARDNESS.fullmatch(line.strip()):
                continue
            # a heading has no numbers
            is_heading = len(row) > 1 and not any(re.fullmatch(r"[-+\d.,]+", it) for it in row)
            names = sum(map(known, row)) if is_heading else 0
            if names > best:
                best, found = names, (separator, index)
    if best:
        return found
    # a column of hardness stands alone
    for index, (_, line) in enumerate(lines[:MOST_BEFORE]):
        if known(line.strip().strip('"')):
            return said or ("," if ";" not in line else ";"), index
    counts = {it: lines[0][1].count(it) for it in (";", "\t", ",", "|")}
    return max(counts, key=lambda it: counts[it]), 0


def _decimal(name: str, rows: Sequence[Sequence[str]], separator: str) -> Decimal:
    """The decimal sign of all numbers of a file.

    Raises `ValueError` if numbers such as `1.234` may be 1.234 or 1234.
    """
    cells = [
        _GAPS.sub("", cell) for row in rows for cell in row if re.search(r"\d[.,]|[.,]\d", cell)
    ]
    evidence: dict[Decimal, str] = {}
    for cell in cells:
        number = re.fullmatch(r"[-+\u2212]?[\d.,]+([eE][-+]?\d+)?", cell)
        if number is None:
            continue
        for sign, other in ((".", ","), (",", ".")):
            if sign not in cell:
                continue
            is_grouped = bool(_GROUPED[other].fullmatch(cell)) and other not in cell
            both = other in cell and cell.rindex(sign) > cell.rindex(other)
            alone = other not in cell and cell.count(sign) == 1 and not is_grouped
            thousands = cell.count(sign) > 1
            if both or alone:
                evidence.setdefault(sign, cell)  # type: ignore[arg-type]
            elif thousands:
                evidence.setdefault(other, cell)  # type: ignore[arg-type]
    if len(evidence) == 2:
        raise ValueError(
            f"{name}: `{evidence['.']}` has a decimal point, and `{evidence[',']}` a decimal comma; "
            "one sign is allowed in a file"
        )
    if evidence:
        return next(iter(evidence))
    doubt = next((it for it in cells if "," in it or (separator == ";" and "." in it)), None)
    doubt = doubt or _mixed(rows)
    if doubt is not None:
        sign = "," if "," in doubt else "."
        plain = doubt.replace(sign, "")
        raise ValueError(
            f"{name}: `{doubt}` is ambiguous: {doubt.replace(',', '.')} with a decimal sign, or {plain} "
            f"with a separator of thousands. Pass decimal='.' or decimal=','"
        )
    return "."


def _mixed(rows: Sequence[Sequence[str]]) -> str | None:
    """A number such as `1.234` in a column with larger numbers that have no sign, such as `950`:
    thousands are written with a sign, hundreds without."""
    for column in zip(*rows, strict=True):
        grouped = [it for it in column if _GROUPED[","].fullmatch(it)]
        plain = [it for it in column if re.fullmatch(r"\d{1,3}", it)]
        if grouped and plain and len(grouped) + len(plain) == len([it for it in column if it]):
            return str(grouped[0])
    return None


def number(cell: Any, decimal: Decimal) -> float:
    """The number in a cell; NaN for an empty one.

    Raises `ValueError` for what is no number.
    """
    if cell is None or (isinstance(cell, str) and not cell.strip()):
        return math.nan
    if not isinstance(cell, str):
        return float("nope" if isinstance(cell, bool) else cell)
    text = _GAPS.sub("", cell.strip()).replace("\u2212", "-")
    if "_" in text:
        raise ValueError
    other = "," if decimal == "." else "."
    if other in text:
        if not _GROUPED[decimal].fullmatch(text):
            raise ValueError
        text = text.replace(other, "")
    return float(text.replace(decimal, "."))


def _of_table(table: Any, name: str = "the measurement") -> Rows:
    """The rows of a DataFrame or another mapping."""
    if not isinstance(table, Mapping) and not hasattr(table, "columns"):
        raise TypeError(
            f"a measurement is the path of a file, a DataFrame or a mapping from headings to columns, "
            f"not {type(table).__name__}"
        )
    heading = [str(it) for it in (table.columns if hasattr(table, "columns") else table)]
    if hasattr(table, "iloc"):
        columns = [table.iloc[:, index].tolist() for index in range(len(heading))]
    else:
        columns = [list(table[it]) for it in table]
    lengths = [len(it) for it in columns]
    for one, length in zip(heading, lengths, strict=True):
        if length != lengths[0]:
            raise ValueError(f"{name}: {heading[0]} has {lengths[0]} cells, and {one} {length}")
    if not lengths or not 0 < lengths[0] <= MOST:
        count = lengths[0] if lengths else 0
        raise ValueError(f"{name} has {count} rows; allowed is 1 to {MOST}")
    rows = [(f"row {row}", list(cells)) for row, cells in enumerate(zip(*columns, strict=True))]
    texts = [[it if isinstance(it, str) else "" for it in cells] for _, cells in rows]
    return Rows(name, heading, None, rows, _decimal(name, texts, ""), [], name)


def _of_excel(path: Path) -> Rows:
    """The first sheet of a workbook with a heading that names quantities."""
    import pandas

    sheets = pandas.read_excel(path, sheet_name=None, header=None, dtype=object)
    found = None
    for sheet, frame in sheets.items():
        rows = [[None if pandas.isna(it) else it for it in row] for row in frame.values.tolist()]
        counts = [
            sum(isinstance(it, str) and known(it) for it in row) for row in rows[:MOST_BEFORE]
        ]
        if counts and max(counts) > 0:
            found = str(sheet), rows, counts.index(max(counts))
            break
    if found is None:
        firsts = [it for one in sheets.values() for it in one.head(1).to_numpy().ravel()]
        first = shortened(", ".join(map(str, firsts)))
        raise ValueError(f"{path}: no sheet has a heading (`{first}`); {nearest(first)}")
    sheet, rows, at = found
    kept = [index for index, it in enumerate(rows[at]) if it is not None]
    heading = [str(rows[at][index]) for index in kept]
    notes = [f"The sheet {sheet} was read; others: {', '.join(map(str, set(sheets) - {sheet}))}."]
    notes = notes if len(sheets) > 1 else []
    if at:
        notes.append(f"Before the heading in row {at + 1}, {counted(at, 'row')} passed over.")
    below = [
        (f"{path}:{sheet}, row {at + 2 + offset}", [row[index] for index in kept])
        for offset, row in enumerate(rows[at + 1 :])
        if any(row[index] is not None for index in kept)
    ]
    units = None
    if below and all(it is None or is_unit(str(it)) for it in below[0][1]):
        units, below = [str(it or "").strip("[]()") for it in below[0][1]], below[1:]
    if len(below) > MOST:
        raise ValueError(f"{path}: there are more than {MOST} rows")
    texts = [[it if isinstance(it, str) else "" for it in cells] for _, cells in below]
    return Rows(
        str(path), heading, units, below, _decimal(str(path), texts, ""), notes, f"{path}:{sheet}"
    )
