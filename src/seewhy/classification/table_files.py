"""Tables on disk, as CSV, JSON or parquet by their ending, written row by row."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import islice
from pathlib import Path
from typing import Any

from seewhy.classification.rows import Cell, Column
from seewhy.errors import DatasetError
from seewhy.files.whole_files import whole_file

__all__ = ["check_table", "write_table"]

Rows = Iterable[Sequence[Cell]]

_AT_ONCE = 4096


def check_table(table: Path) -> None:
    """Raise a DatasetError if a table of this name cannot be written.

    Its ending must be one that is known, and the library installed that writes it.

    Examples
    --------
    >>> check_table(Path("table.xls"))
    Traceback (most recent call last):
    ...
    seewhy.errors.DatasetError: table.xls: must end in .csv, .json or .parquet; name it otherwise
    """
    ending = table.suffix.casefold()
    if ending not in _WRITERS:
        *others, last = _WRITERS
        raise DatasetError(f"{table}: must end in {', '.join(others)} or {last}; name it otherwise")
    if table.is_dir():
        raise DatasetError(f"{table}: is a folder; name a file for the table")
    if ending == ".parquet":
        _pyarrow(table)


def write_table(table: Path, columns: Sequence[Column], rows: Rows) -> None:
    """Write a table, whole or not at all.

    Examples
    --------
    >>> import tempfile
    >>> table = Path(tempfile.mkdtemp()) / "table.json"
    >>> columns = [Column("image"), Column("probability", "number")]
    >>> write_table(table, columns, [["a.png", 0.5], ["b.png", None]])
    >>> json.loads(table.read_text())[1]
    {'image': 'b.png', 'probability': None}
    """
    check_table(table)
    with whole_file(table) as temporary:
        _WRITERS[table.suffix.casefold()](temporary, columns, rows)


def _write_csv(file: Path, columns: Sequence[Column], rows: Rows) -> None:
    with file.open("w", newline="", encoding="utf-8") as stream:
        lines = csv.writer(stream, lineterminator="\n")
        lines.writerow([column.name for column in columns])
        lines.writerows(rows)


def _write_json(file: Path, columns: Sequence[Column], rows: Rows) -> None:
    """A list of objects, one a line, so that it can be read by lines as well."""
    names = [column.name for column in columns]
    with file.open("w", encoding="utf-8") as stream:
        before = "[\n"
        for row in rows:
            stream.write(before)
            stream.write(json.dumps(dict(zip(names, row, strict=True)), ensure_ascii=False))
            before = ",\n"
        stream.write("\n]\n" if before == ",\n" else "[]\n")


def _write_parquet(file: Path, columns: Sequence[Column], rows: Rows) -> None:
    arrow, parquet = _pyarrow(file)
    kinds = {"text": arrow.string(), "number": arrow.float64()}
    schema = arrow.schema([(column.name, kinds[column.kind]) for column in columns])
    with parquet.ParquetWriter(file, schema) as writer:
        for some in _in_parts(rows):
            cells = [list(column) for column in zip(*some, strict=True)]
            writer.write_table(arrow.table(cells, schema=schema))


def _in_parts(rows: Rows) -> Iterator[list[Sequence[Cell]]]:
    remaining = iter(rows)
    while some := list(islice(remaining, _AT_ONCE)):
        yield some


def _pyarrow(table: Path) -> tuple[Any, Any]:
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError:
        raise DatasetError(
            f"{table}: parquet tables need the package pyarrow; install it with "
            "pip install 'seewhy[tables]', or end the name in .csv"
        ) from None
    return pyarrow, parquet


_WRITERS: dict[str, Callable[[Path, Sequence[Column], Rows], None]] = {
    ".csv": _write_csv,
    ".json": _write_json,
    ".parquet": _write_parquet,
}
