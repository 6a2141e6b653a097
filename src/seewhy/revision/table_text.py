"""One more label in scenes.csv: a cell of a picture's row, or a row; all else stays as it is."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Mapping, Sequence
from pathlib import Path

from seewhy.data.dataset import Dataset
from seewhy.data.scene import Scene
from seewhy.data.scene_rows import IMAGE, OPTIONAL, columns_of
from seewhy.data.table import Table, read_table
from seewhy.errors import DatasetError, RevisionError
from seewhy.files.whole_files import lies_in
from seewhy.revision.edit import TABLE, Edit, newline_of

__all__ = ["label_edits", "read_text", "rows_of"]


def label_edits(
    dataset: Dataset, picture: Path, cells: Mapping[str, str], *, text: str
) -> tuple[Edit, ...]:
    """Return the edits by which a picture has these cells in a dataset's table.

    Parameters
    ----------
    dataset : Dataset
        As it was read from the table.
    picture : Path
    cells : mapping of str to str
        Column → what is known of the picture: values of features, "class".
    text : str
        The table, as :func:`read_text` reads it.

    Returns
    -------
    tuple of Edit
        In the order in which they are made; none where the table says so already.

    Raises
    ------
    DatasetError, RevisionError
        If the picture lies outside of the dataset's folder; if the table lacks a column.

    Examples
    --------
    >>> import seewhy, tempfile
    >>> from seewhy.data.making import make_dataset
    >>> domain = seewhy.load_domain("structure_stability")
    >>> folder = Path(tempfile.mkdtemp())
    >>> _ = make_dataset(domain, folder, count=2, seed=0)
    >>> data = Dataset.load(folder, domain)
    >>> edits = label_edits(
    ...     data, data.scenes[0].picture, {"lean": "no"}, text=read_text(folder / "scenes.csv")
    ... )
    >>> len(edits) <= 1
    True
    """
    file = dataset.folder / TABLE
    table = read_table(file, known=columns_of(dataset.domain), optional=OPTIONAL)
    for column in cells:
        if column not in table.columns:
            raise RevisionError(
                f"{file}:{table.line}: the table has no column '{column}' for the label; add the "
                "column, then say it again"
            )
    rows = rows_of(dataset, picture)
    if not rows:
        return (_row_added(table, dataset, picture, cells, text),)
    edits = [_cells_set(table, scene.line, cells, text) for scene in reversed(rows)]
    return tuple(edit for edit in edits if edit.before != edit.after)


def rows_of(dataset: Dataset, picture: Path) -> tuple[Scene, ...]:
    """Return the scenes of a dataset that are of a picture file.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> rows_of(Dataset((), load_domain("structure_stability"), Path("data")), Path("a.png"))
    ()
    """
    real = os.path.realpath(picture)
    return tuple(scene for scene in dataset.scenes if os.path.realpath(scene.picture) == real)


def read_text(file: Path) -> str:
    """Return a file's text with its mark and its line ends.

    Raises
    ------
    RevisionError
        If it is not UTF-8.
    """
    try:
        return file.read_bytes().decode("utf-8")
    except UnicodeDecodeError:
        raise RevisionError(
            f"{file}: is not UTF-8, and only such a file is changed cell by cell; save it as UTF-8"
        ) from None


def _row_added(
    table: Table, dataset: Dataset, picture: Path, cells: Mapping[str, str], text: str
) -> Edit:
    if not lies_in(picture, dataset.folder):
        raise DatasetError(
            f"{picture}: lies outside of {dataset.folder}; copy the picture into that folder, so "
            "that its label can stand in the table"
        )
    name = Path(os.path.relpath(os.path.realpath(picture), os.path.realpath(dataset.folder)))
    known = {IMAGE: name.as_posix(), **cells}
    newline = newline_of(text)
    between = "" if text.endswith(("\n", "\r")) else newline
    row = _written([known.get(column, "") for column in table.columns], table.separator)
    return Edit(TABLE, len(text), "", f"{between}{row}{newline}")


def _cells_set(table: Table, line: int, cells: Mapping[str, str], text: str) -> Edit:
    begin, end = _span(table, line, text)
    before = text[begin:end]
    (row,) = (
        csv.reader([before], delimiter=table.separator)
        if "\n" not in before
        else csv.reader(io.StringIO(before, newline=""), delimiter=table.separator)
    )
    row += [""] * (len(table.columns) - len(row))
    changed = list(row)
    for column, value in cells.items():
        place = table.columns.index(column)
        if changed[place].strip() != value:
            changed[place] = value
    return Edit(
        TABLE, begin, before, before if changed == row else _written(changed, table.separator)
    )


def _span(table: Table, line: int, text: str) -> tuple[int, int]:
    """Where a row begins and ends in the text, without its line end."""
    lines = list(io.StringIO(text, newline=""))
    following = [row.line for row in table.rows if row.line > line]
    last = min(following) - 1 if following else len(lines)
    begin = sum(map(len, lines[: line - 1]))
    row = "".join(lines[line - 1 : last])
    return begin, begin + len(row.rstrip("\r\n"))


def _written(row: Sequence[str], separator: str) -> str:
    out = io.StringIO()
    csv.writer(out, delimiter=separator, lineterminator="").writerow(row)
    return out.getvalue()
