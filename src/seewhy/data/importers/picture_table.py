"""Tables with a row a picture: its path, its class, its features."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice

from seewhy.data.importers.annotation import AnnotatedPicture, Box
from seewhy.data.importers.column_words import (
    GROUP_WORDS,
    IMAGE_WORDS,
    SPLIT_WORDS,
    class_column,
    column_like,
)
from seewhy.data.importers.picture_files import ENDINGS, PictureFinder, is_picture_name, split_of
from seewhy.data.importers.source import Source, split_in_folders
from seewhy.data.importers.tables import TABLES, Row, Table, open_table
from seewhy.data.importers.xml_reading import as_number
from seewhy.data.thing import CORNERS, THINGS
from seewhy.errors import DatasetError
from seewhy.text.nearest import did_you_mean

_SCENES = "scenes.csv"
_LOOKED_AT = 200


@dataclass(frozen=True)
class _Columns:
    """Which column says what."""

    image: str
    label: str | None
    split: str | None
    group: str | None
    reasons: str | None
    features: tuple[str, ...]


def table_files(source: Source) -> list[str]:
    """The tables of a source: the one that the user named, scenes.csv, or those not in folders."""
    if source.only is not None:
        return [source.only] if source.only.casefold().endswith(TABLES) else []
    names = [name for name in source.named(*TABLES) if not name.casefold().endswith(".txt")]
    scenes = [name for name in names if posixpath.basename(name) == _SCENES]
    depth = min((name.count("/") for name in names), default=0)
    return scenes or [
        name for name in names if name.count("/") == depth and posixpath.basename(name) != THINGS
    ]


def has_pictures(source: Source, name: str) -> bool:
    """Whether a table has a column of pictures: paths that look so, or names of pictures here."""
    try:
        with open_table(source.files, name) as table:
            rows = list(islice(table.rows, 20))
            column = _image_column(table.columns, rows)
    except DatasetError:
        return False
    if column is None:
        return False
    cells = [row.cells[column] for row in rows if row.cells[column]]
    finder = source.finder(beside=(posixpath.dirname(name),))
    return any(is_picture_name(cell) or _find(finder, cell, "") for cell in cells)


def read_picture_table(source: Source) -> Iterator[AnnotatedPicture]:
    """Yield the pictures of a table; boxes from a things.csv beside it.

    Columns are found by what they are called; that of the pictures also by what stands in it.

    Raises
    ------
    DatasetError
        If there is no table, several, or none with a column of pictures.
    """
    names = table_files(source)
    if not names and source.only is not None:
        with open_table(source.files, source.only):
            pass  # says which tables are read
    if not names:
        raise source.nothing(f"no table ({', '.join(TABLES)}); name the table's file")
    if len(names) > 1:
        fitting = [name for name in names if has_pictures(source, name)]
        if len(fitting) != 1:
            raise DatasetError(
                f"{source.said}: holds several tables ({', '.join(names[:5])}); name the one that "
                "lists the pictures"
            )
        names = fitting
    yield from _rows(source, names[0])


def _rows(source: Source, name: str) -> Iterator[AnnotatedPicture]:
    finder = source.finder(beside=(posixpath.dirname(name),))
    boxes = _boxes(source, posixpath.join(posixpath.dirname(name), THINGS))
    with open_table(source.files, name) as table:
        first = list(islice(table.rows, _LOOKED_AT))
        columns = _columns(source, table, first)
        for row in (*first, *table.rows):
            picture = _picture(source, row, columns, finder, boxes)
            if picture is not None:
                yield picture


def _picture(
    source: Source,
    row: Row,
    columns: _Columns,
    finder: PictureFinder,
    boxes: dict[str, tuple[Box, ...]],
) -> AnnotatedPicture | None:
    written = row.cells[columns.image]
    if not written:
        source.notes.add("rows without a picture, left out", row.place)
        return None
    split = split_of(row.cells[columns.split]) if columns.split else ""
    file = _find(finder, written, split)
    if file is None:
        source.miss(written, row.place)
        return None
    return AnnotatedPicture(
        file=file,
        class_name=row.cells[columns.label] if columns.label else "",
        features={key: row.cells[key] for key in columns.features if row.cells[key]},
        boxes=boxes.get(written, ()),
        split=split or ("" if columns.split else split_in_folders(file)),
        group=row.cells[columns.group] if columns.group else "",
        reasons=tuple(row.cells[columns.reasons].split()) if columns.reasons else (),
    )


def _find(finder: PictureFinder, written: str, split: str) -> str | None:
    """The picture of a cell, which may lack the ending."""
    found = finder.find(written, split=split)
    if found is not None or is_picture_name(written):
        return found
    return next(
        (
            file
            for ending in ENDINGS
            if (file := finder.find(f"{written}{ending}", split=split)) is not None
        ),
        None,
    )


def _columns(source: Source, table: Table, rows: Sequence[Row]) -> _Columns:
    names = table.columns
    image = _wanted(source.columns.image, "--image-column", table) or _image_column(names, rows)
    if image is None:
        raise DatasetError(
            f"{table.said}: no column holds paths of pictures (there are: "
            f"{', '.join(names[:12])}); name it with --image-column"
        )
    left = [name for name in names if name != image]
    label = _wanted(source.columns.label, "--class-column", table) or class_column(left)
    split = column_like(left, SPLIT_WORDS)
    if split is not None and not any(split_of(row.cells[split]) for row in rows):
        split = None
    group = column_like([name for name in left if name not in (label, split)], GROUP_WORDS)
    reasons = "reasons" if "reasons" in left else None
    taken = {image, label, split, group, reasons}
    roles = {"pictures": image, "class": label, "split": split, "group": group}
    found = ", ".join(f"{role} '{name}'" for role, name in roles.items() if name is not None)
    if (image, label) != ("image", "class"):
        source.notes.add(f"columns of {table.said}: {found}")
    if label is None:
        source.notes.add("no column says the class; name it with --class-column")
    return _Columns(
        image=image,
        label=label,
        split=split,
        group=group,
        reasons=reasons,
        features=tuple(name for name in names if name not in taken),
    )


def _wanted(name: str | None, option: str, table: Table) -> str | None:
    if name is not None and name not in table.columns:
        raise DatasetError(
            f"{table.said}: {option} {name}: there is no such column; "
            f"{did_you_mean(name, table.columns)}"
        )
    return name


def _image_column(columns: Sequence[str], rows: Sequence[Row]) -> str | None:
    """The column in which paths of pictures stand; by what it is called where none does."""
    shares = {column: sum(is_picture_name(row.cells[column]) for row in rows) for column in columns}
    most = max(shares.values(), default=0)
    if most and 2 * most >= len(rows):
        best = [column for column in columns if shares[column] == most]
        return column_like(best, IMAGE_WORDS) or best[0]
    return column_like(columns, IMAGE_WORDS)


def _boxes(source: Source, name: str) -> dict[str, tuple[Box, ...]]:
    """Picture → its boxes, from the table of things beside that of the pictures."""
    if not source.files.has(name):
        return {}
    found: dict[str, list[Box]] = {}
    with open_table(source.files, name) as table:
        for needed in ("image", *CORNERS, "kind"):
            if needed not in table.columns:
                raise DatasetError(f"{table.said}: the column '{needed}' is missing; add it")
        others = [
            column for column in table.columns if column not in ("image", "thing", "kind", *CORNERS)
        ]
        for row in table.rows:
            left, top, right, bottom = (as_number(row.cells[corner]) for corner in CORNERS)
            if left is None or top is None or right is None or bottom is None:
                raise DatasetError(
                    f"{row.place}: left, top, right and bottom must be numbers (pixels), got "
                    f"{', '.join(repr(row.cells[corner]) for corner in CORNERS)}"
                )
            attributes = {key: row.cells[key] for key in others if row.cells[key]}
            found.setdefault(row.cells["image"], []).append(
                Box(left, top, right, bottom, row.cells["kind"], attributes)
            )
    return {image: tuple(boxes) for image, boxes in found.items()}
