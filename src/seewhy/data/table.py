"""A table that somebody saved as CSV, read as lines of cells.

Which character separates the cells is told by the header: of the usual separators, the one that
splits it into the most columns that are known. The guessers that look at all characters of a file
(csv.Sniffer, clevercsv, pandas with ``sep=None``) were tried on 648 tables of scenes: the first
two found what the header says, too, clevercsv in 4 s where there are 100,000 rows; pandas split
tables of one column. None of them sees that two lines are separated differently, which is what a
person wants to be told. So the header decides, and needs no library.
"""

from __future__ import annotations

import codecs
import csv
import io
import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from seewhy.errors import DatasetError

__all__ = ["Row", "Table", "optional_end", "read_table"]

SEPARATORS = {",": ",", ";": ";", "\t": "tabs", "|": "|"}
"""What may separate cells, and how it is called."""

_SEPARATOR_LINE = re.compile(r'"?sep=([,;\t|])\1*"?[\s,;|]*', re.IGNORECASE)
"""A first line that spreadsheets write and read: it names the separator."""

_CONTAINERS = {b"PK\x03\x04": "a workbook or an archive", b"\xd0\xcf\x11\xe0": "a workbook"}

_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig", "UTF-8"),
    (codecs.BOM_UTF32_LE, "utf-32", "UTF-32"),
    (codecs.BOM_UTF32_BE, "utf-32", "UTF-32"),
    (codecs.BOM_UTF16_LE, "utf-16", "UTF-16"),
    (codecs.BOM_UTF16_BE, "utf-16", "UTF-16"),
)
"""How a file begins that says its encoding; UTF-32 first, because UTF-16 begins it alike."""


@dataclass(frozen=True)
class Row:
    """A row of a table: the line where it begins, counted as an editor does, and its cells."""

    line: int
    cells: tuple[str, ...]


@dataclass(frozen=True)
class Table:
    """The cells of a table, without the blanks around them.

    Attributes
    ----------
    file : Path
    line : int
        Where the header stands.
    columns : tuple of str
        As the header names them; empty ones at its end are left out.
    separator : str
    rows : tuple of Row
        Those that are not empty, each with at least one cell and at most as many as there are
        columns.
    """

    file: Path
    line: int
    columns: tuple[str, ...]
    separator: str
    rows: tuple[Row, ...]


def read_table(
    file: Path | str, *, known: Collection[str], optional: Collection[str] = ()
) -> Table:
    """Read a table as people save it.

    Cells are separated by commas, semicolons, tabs or bars, whichever the header shows; a first
    line such as ``sep=;`` is heeded. Quotes, UTF-8 with or without a byte order mark, UTF-16 with
    one, any line ends, blanks around cells, and empty columns and rows at the end are read.

    Parameters
    ----------
    file : Path or str
    known : collection of str
        The columns that the table may have; they tell the separator.
    optional : collection of str
        Columns that a row may lack at its end.

    Raises
    ------
    DatasetError
        If the file is no such table; the text names the line and the remedy.

    Examples
    --------
    >>> import tempfile
    >>> file = Path(tempfile.mkdtemp()) / "scenes.csv"
    >>> _ = file.write_text("image; class;\\na, b.png; good;\\n")
    >>> table = read_table(file, known=["image", "class"])
    >>> table.columns, table.separator, table.rows
    (('image', 'class'), ';', (Row(line=2, cells=('a, b.png', 'good')),))
    """
    file = Path(file)
    text = _decoded(file)
    first, named, skipped = _separator_line(text)
    lines = _physical_lines(text[skipped:], first)
    header = next((found for found in lines if found[1].strip(" \t\r\n,;|")), None)
    if header is None:
        raise DatasetError(
            f"{file}:1: the table is empty; its first line names the columns {', '.join(known)}"
        )
    line, columns_text = header
    separator = _separator_of(columns_text, known, file=file, line=line, named=named)
    start = skipped + _offset_of_line(text[skipped:], line - first)
    first_row, *found = _logical_rows(text[start:], separator, file=file, first=line)
    columns = _without_empty_end(first_row.cells)
    rows = tuple(
        _fitting(row, columns, separator, optional, file=file, header=line) for row in found
    )
    return Table(file, line, columns, separator, tuple(row for row in rows if any(row.cells)))


def _decoded(file: Path) -> str:
    data = file.read_bytes()
    for beginning, what in _CONTAINERS.items():
        if data.startswith(beginning):
            raise DatasetError(f"{file}: is {what}, no text; save the table as CSV in UTF-8")
    marked = next((mark for mark in _MARKS if data.startswith(mark[0])), None)
    encoding, name = (marked[1], marked[2]) if marked is not None else ("utf-8", "UTF-8")
    if marked is None and len(data) > 1 and _every_other_is_nul(data[:2000]):
        raise DatasetError(
            f"{file}: is UTF-16 without the mark of its byte order; save the table as CSV in UTF-8"
        )
    try:
        text = data.decode(encoding)
    except UnicodeDecodeError as problem:
        if encoding != "utf-8" and encoding != "utf-8-sig":
            raise DatasetError(
                f"{file}: is damaged or cut short: not all of it is {name}; save the table as "
                "CSV in UTF-8"
            ) from None
        before = data[: problem.start]
        line = before.count(b"\n") + 1 if b"\n" in data else before.count(b"\r") + 1
        raise DatasetError(
            f"{file}:{line}: is not UTF-8 text (byte {data[problem.start]:#04x}); save the table "
            "as CSV in UTF-8"
        ) from None
    if "\0" in text:
        line = sum(1 for _ in _physical_lines(text[: text.index("\0") + 1], 1))
        raise DatasetError(
            f"{file}:{line}: has a NUL byte, which no text has; the file is damaged, save the "
            "table as CSV again"
        )
    return text


def _every_other_is_nul(data: bytes) -> bool:
    return any(half.count(0) > 0.4 * len(half) > 0 for half in (data[::2], data[1::2]))


def _physical_lines(text: str, first: int) -> Iterator[tuple[int, str]]:
    """Lines with their numbers; they end as in a text editor, at CR, LF or both, nowhere else."""
    yield from enumerate(io.StringIO(text, newline=""), start=first)


def _offset_of_line(text: str, number: int) -> int:
    return sum(len(line) for count, line in _physical_lines(text, 0) if count < number)


def _separator_line(text: str) -> tuple[int, str | None, int]:
    """The number of the first line after ``sep=…``, what that names, and where it ends."""
    line = next((line for _, line in _physical_lines(text, 1)), "")
    found = _SEPARATOR_LINE.fullmatch(line.rstrip("\r\n"))
    return (1, None, 0) if found is None else (2, found[1], len(line))


def _separator_of(
    header: str, known: Collection[str], *, file: Path, line: int, named: str | None
) -> str:
    """Return what separates the columns of the header."""
    names = set(known)
    scores = {
        separator: sum(name in names for name in _split(header, separator))
        for separator in SEPARATORS
    }
    best = max(scores, key=lambda separator: (scores[separator], header.count(separator)))
    if scores[best] and _split_again(header, best, names):
        others = [
            separator for separator in SEPARATORS if separator != best and separator in header
        ]
        raise DatasetError(
            f"{file}:{line}: the columns are separated by {SEPARATORS[best]} and by "
            f"{SEPARATORS[others[0]]}; use one of them in the whole table"
        )
    if named is not None and named != best and scores[best] > scores[named]:
        raise DatasetError(
            f"{file}:{line}: line {line - 1} says that cells are separated by "
            f"{SEPARATORS[named]}, and those of line {line} are separated by {SEPARATORS[best]}; "
            f"remove line {line - 1}"
        )
    return best if named is None else named


def _split_again(header: str, separator: str, names: set[str]) -> bool:
    """Whether a column that is none would be several if it were split otherwise."""
    return any(
        name not in names and any(part in names for part in _split(name, other))
        for name in _split(header, separator)
        for other in SEPARATORS
        if other != separator and other in name
    )


def _split(line: str, separator: str) -> list[str]:
    return [cell.strip().strip('"').strip() for cell in line.split(separator)]


def _logical_rows(text: str, separator: str, *, file: Path, first: int) -> list[Row]:
    """Rows, each of which may go over several lines where its cells are quoted."""
    try:
        return list(_strict_rows(text, separator, file=file, first=first))
    except DatasetError:
        # Blanks between a closing quote and the separator are the one slip that is plain.
        tidy = re.sub(rf'" +(?=[{separator}\r\n]|$)', '"', text)
        if tidy == text:
            raise
        return list(_strict_rows(tidy, separator, file=file, first=first))


def _strict_rows(text: str, separator: str, *, file: Path, first: int) -> Iterator[Row]:
    reader = csv.reader(
        io.StringIO(text, newline=""), delimiter=separator, strict=True, skipinitialspace=True
    )
    while True:
        line = first + reader.line_num
        try:
            cells = next(reader)
        except StopIteration:
            return
        except csv.Error as problem:
            raise _quotes_wrong(file, line, first + reader.line_num - 1, str(problem)) from None
        yield Row(line, tuple(cell.strip() for cell in cells))


def _quotes_wrong(file: Path, line: int, last: int, problem: str) -> DatasetError:
    if "field limit" in problem and last == line:
        return DatasetError(
            f"{file}:{line}: has a cell of more than {csv.field_size_limit():,} characters; "
            "shorten it"
        )
    if last > line or "unexpected end" in problem:
        return DatasetError(
            f"{file}:{line}: a quote is opened in line {line} and not closed there; close it, or "
            'write "" for a quote that belongs to the cell'
        )
    return DatasetError(
        f'{file}:{line}: a quote is closed in the midst of a cell; write "" for a quote that '
        "belongs to the cell"
    )


def _without_empty_end(cells: Sequence[str]) -> tuple[str, ...]:
    number = len(cells)
    while number and not cells[number - 1]:
        number -= 1
    return tuple(cells[:number])


def _fitting(
    row: Row,
    columns: Sequence[str],
    separator: str,
    optional: Collection[str],
    *,
    file: Path,
    header: int,
) -> Row:
    """Return a row with one cell a column, or fewer where only optional ones are missing."""
    number = len(row.cells)
    if number == len(columns):
        return row
    cells = _without_empty_end(row.cells)
    if not cells:
        return Row(row.line, cells)
    if number > len(columns) >= len(cells):
        return Row(row.line, row.cells[: len(columns)])
    missing = columns[number:]
    needed = len(columns) - len(optional_end(columns, optional))
    other = _other_separator(row, separator, needed, len(columns))
    if other is not None:
        raise DatasetError(
            f"{file}:{row.line}: the cells of line {row.line} are separated by "
            f"{SEPARATORS[other]} and those of line {header} by {SEPARATORS[separator]}; use one "
            "of them in the whole table"
        )
    if needed <= number < len(columns):
        return row
    if number < len(columns):
        raise DatasetError(
            f"{file}:{row.line}: the row has {number} of {len(columns)} cells; add what is missing "
            f"up to '{missing[-1]}', an empty cell where nothing is known"
        )
    raise DatasetError(
        f"{file}:{row.line}: the row has more cells than there are columns; remove some, or put a "
        f'cell that has {_said(separator)} in it in "quotes"'
    )


def optional_end(columns: Sequence[str], optional: Collection[str]) -> tuple[str, ...]:
    """Return the columns at the end that a row may lack.

    Examples
    --------
    >>> optional_end(["image", "split", "class", "group"], ["split", "group"])
    ('group',)
    """
    number = len(columns)
    while number and columns[number - 1] in optional:
        number -= 1
    return tuple(columns[number:])


def _other_separator(row: Row, separator: str, needed: int, columns: int) -> str | None:
    """Return what separates the cells of a row if it is something else than the header's."""
    joined = separator.join(row.cells)
    return next(
        (
            other
            for other in SEPARATORS
            if other != separator
            and max(2, needed) <= joined.count(other) + 1 <= columns
            and joined.count(other) >= len(row.cells)
        ),
        None,
    )


def _said(separator: str) -> str:
    return "a tab" if separator == "\t" else f"a {separator}"
