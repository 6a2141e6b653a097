"""Tables as people save them: CSV, TSV, Excel, JSON, JSON lines and parquet, as rows of text."""

from __future__ import annotations

import io
import json
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from seewhy.data.importers.column_words import CLASS_WORDS, IMAGE_WORDS
from seewhy.data.importers.json_reading import json_items
from seewhy.data.importers.source_files import DamagedFileError, SourceFiles, decoded, read_bytes
from seewhy.data.importers.zip_files import explodes
from seewhy.data.table import read_table
from seewhy.errors import DatasetError
from seewhy.files.folders import scratch_folder

TEXT_TABLES = (".csv", ".tsv", ".tab", ".txt")
TABLES = (*TEXT_TABLES, ".xlsx", ".xlsm", ".jsonl", ".ndjson", ".json", ".parquet", ".pq")
"""How the names of tables end."""

UNKNOWN = frozenset({"", "nan", "null", "n/a", "na", "?", "nat", "<na>"})
"""Cells, in small letters, that are values which nobody knows."""

_MOST_COLUMNS = 2_000


@dataclass(frozen=True)
class Row:
    """One row: column → cell, without blanks around, empty where nobody knows; and its place."""

    cells: Mapping[str, str]
    place: str


@dataclass(frozen=True)
class Table:
    """A table's columns, in order, and its rows, which are read while one goes through them."""

    columns: tuple[str, ...]
    rows: Iterator[Row]
    said: str


@contextmanager
def open_table(files: SourceFiles, name: str) -> Iterator[Table]:
    """Yield a table of any kind.

    Raises
    ------
    DatasetError
        If it is none, has no columns, or has one without a name or twice; or if the library
        that reads it is not installed.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> from seewhy.data.importers.folder_files import FolderFiles
    >>> home = pathlib.Path(tempfile.mkdtemp())
    >>> _ = (home / "a.csv").write_text("class;colour\\ngood; red\\n\\nbad;n/a\\n")
    >>> with open_table(FolderFiles(home), "a.csv") as table:
    ...     [(dict(row.cells), row.place.rpartition(":")[2]) for row in table.rows]
    [({'class': 'good', 'colour': 'red'}, '2'), ({'class': 'bad', 'colour': ''}, '4')]
    """
    ending = "." + name.casefold().rpartition(".")[2]
    said = files.said(name)
    if ending in (".xlsx", ".xlsm"):
        yield _checked(_excel_rows(files, name), said)
    elif ending in (".parquet", ".pq"):
        with _parquet(files, name) as table:
            yield table
    elif ending in (".jsonl", ".ndjson"):
        yield _record_table(_json_lines(files, name), said)
    elif ending == ".json":
        yield _record_table(_json_records(files, name), said)
    elif ending in TEXT_TABLES:
        yield _checked(_text_rows(files, name), said)
    else:
        raise DatasetError(
            f"{said}: is no table of a kind that is read; save it as one of {', '.join(TABLES)}"
        )


def known(cell: object) -> str:
    """Return a cell as text without blanks around; empty for a value that nobody knows.

    Examples
    --------
    >>> [known(cell) for cell in (" red ", None, 3.0, True, float("nan"), "N/A", 0.5)]
    ['red', '', '3', 'yes', '', '', '0.5']
    """
    if cell is None:
        return ""
    if isinstance(cell, bool):
        return "yes" if cell else "no"
    if isinstance(cell, float) and cell.is_integer():
        cell = int(cell)
    text = " ".join(str(cell).split()) if "\n" in str(cell) else str(cell).strip()
    return "" if text.casefold() in UNKNOWN else text


def _checked(rows: Iterator[tuple[int, Sequence[object]]], said: str) -> Table:
    """A table of rows of which the first names the columns."""
    first = next(rows, None)
    if first is None:
        raise DatasetError(f"{said}: the table is empty; its first line names the columns")
    line, heading = first
    columns = ["" if cell is None else " ".join(str(cell).split()) for cell in heading]
    while columns and not columns[-1]:
        columns.pop()
    if not columns or len(columns) > _MOST_COLUMNS:
        raise DatasetError(
            f"{said}:{line}: the first line must name 1 to {_MOST_COLUMNS} columns, got "
            f"{len(columns)}"
        )
    if "" in columns:
        raise DatasetError(
            f"{said}:{line}: column {columns.index('') + 1} has no name; name it or remove it"
        )
    for column in columns:
        if columns.count(column) > 1:
            raise DatasetError(f"{said}:{line}: the column '{column}' stands twice; remove one")

    def cells() -> Iterator[Row]:
        for number, row in rows:
            texts = [known(cell) for cell in row]
            if not any(texts):
                continue
            place = f"{said}:{number}"
            if any(texts[len(columns) :]):
                raise DatasetError(
                    f"{place}: the row has {len(texts)} cells, there are {len(columns)} columns; "
                    "a text with the separator in it must stand between double quotes"
                )
            texts += [""] * (len(columns) - len(texts))
            yield Row(dict(zip(columns, texts, strict=False)), place)

    return Table(tuple(columns), cells(), said)


def _text_rows(files: SourceFiles, name: str) -> Iterator[tuple[int, Sequence[str]]]:
    path = files.on_disk(name)
    if path is not None:
        yield from _rows_of_text(path)
        return
    with scratch_folder() as folder:
        copy = folder / Path(name).name
        copy.write_bytes(read_bytes(files, name))
        try:
            yield from _rows_of_text(copy)
        except DatasetError as problem:
            raise DatasetError(str(problem).replace(str(copy), files.said(name))) from None


def _rows_of_text(path: Path) -> Iterator[tuple[int, Sequence[str]]]:
    table = read_table(path, known=(*IMAGE_WORDS, *CLASS_WORDS))
    yield table.line, table.columns
    yield from ((row.line, row.cells) for row in table.rows)


def _excel_rows(files: SourceFiles, name: str) -> Iterator[tuple[int, Sequence[object]]]:
    from openpyxl import load_workbook

    said = files.said(name)
    content = io.BytesIO(read_bytes(files, name))
    try:
        with zipfile.ZipFile(content) as archive:
            exploding = next(
                (member.filename for member in archive.infolist() if explodes(member)), None
            )
        if exploding is not None:
            raise DamagedFileError(
                f"{said}: '{exploding}' in it would unpack to what no table holds; save it as CSV"
            )
        book = load_workbook(content, read_only=True, data_only=True)
        sheet = book.worksheets[0]
        for number, row in enumerate(sheet.iter_rows(values_only=True), start=1):
            if any(cell not in (None, "") for cell in row):
                yield number, row
    except DatasetError:
        raise
    except Exception as problem:
        # The library raises whatever damaged XML or a damaged archive leads it to.
        raise DamagedFileError(
            f"{said}: is no Excel table that can be read ({problem}); save it as CSV"
        ) from None


def _json_lines(files: SourceFiles, name: str) -> Iterator[tuple[str, dict[str, Any]]]:
    said = files.said(name)
    with files.open(name) as stream:
        for number, line in enumerate(stream, start=1):
            place = f"{said}:{number}"
            if not line.strip():
                continue
            try:
                record = json.loads(decoded(line, place))
            except (ValueError, RecursionError) as problem:
                raise DamagedFileError(
                    f"{place}: is no valid JSON ({problem}); each line is one object"
                ) from None
            yield place, _record(record, place)


def _json_records(files: SourceFiles, name: str) -> Iterator[tuple[str, dict[str, Any]]]:
    said = files.said(name)
    for key, position, item in json_items(files, name):
        place = f"{said}: {key}[{position}]"
        if key or position < 0:
            raise DamagedFileError(
                f"{said}: is no table; as JSON it is a list of objects, one a picture"
            )
        yield place, _record(item, place)


def _record(record: object, place: str) -> dict[str, Any]:
    if not isinstance(record, dict):
        raise DamagedFileError(
            f'{place}: must be an object such as {{"image": "a.jpg"}}, got {type(record).__name__}'
        )
    return {" ".join(str(key).split()): value for key, value in record.items()}


def _record_table(records: Iterator[tuple[str, dict[str, Any]]], said: str) -> Table:
    """A table of records that need not have the same keys; all are kept until all are known."""
    kept: list[tuple[str, dict[str, str]]] = []
    columns: dict[str, None] = {}
    for place, record in records:
        cells: dict[str, str] = {}
        for key, value in record.items():
            if isinstance(value, list | dict):
                continue  # what is no cell is no feature
            cells[key] = known(value)
        columns.update(dict.fromkeys(cells))
        kept.append((place, cells))
    if not columns or len(columns) > _MOST_COLUMNS or "" in columns:
        raise DatasetError(
            f"{said}: its objects must name 1 to {_MOST_COLUMNS} columns, got {len(columns)}"
        )
    names = tuple(columns)
    rows = (
        Row({name: cells.get(name, "") for name in names}, place)
        for place, cells in kept
        if any(cells.values())
    )
    return Table(names, rows, said)


@contextmanager
def _parquet(files: SourceFiles, name: str) -> Iterator[Table]:
    said = files.said(name)
    try:
        from pyarrow import ArrowException, parquet
    except ImportError:
        raise DatasetError(
            f"{said}: parquet tables need the package pyarrow; install seewhy[tables], or save "
            "the table as CSV"
        ) from None
    path = files.on_disk(name)
    source: Any = path if path is not None else io.BytesIO(read_bytes(files, name))
    try:
        with parquet.ParquetFile(source) as file:
            columns = tuple(
                field.name
                for field in file.schema_arrow
                if not str(field.type).startswith(("list", "struct", "map", "binary"))
            )

            def rows() -> Iterator[tuple[int, Sequence[object]]]:
                yield 0, columns
                number = 0
                for batch in file.iter_batches(batch_size=4096, columns=list(columns)):
                    for record in batch.to_pylist():
                        number += 1
                        yield number, [record[column] for column in columns]

            yield _checked(rows(), said)
    except (ArrowException, OSError, ValueError) as problem:
        if isinstance(problem, DatasetError):
            raise
        raise DamagedFileError(
            f"{said}: is no parquet table that can be read ({problem}); save it as CSV"
        ) from None
