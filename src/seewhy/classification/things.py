"""The things that many pictures show become a table, with the columns of things.csv."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from seewhy.agent.things.thing_agent import BATCH, ThingAgent
from seewhy.agent.things.thing_reading import ThingReading
from seewhy.classification.rows import Cell, Column
from seewhy.classification.table_files import check_table, write_table
from seewhy.data.thing import CORNERS
from seewhy.errors import PictureError
from seewhy.files.locks import sole_writer

__all__ = ["ThingTable", "things_to_table"]


@dataclass(frozen=True)
class ThingTable:
    """What a table of things holds.

    Attributes
    ----------
    pictures, things : int
        Pictures that were read, and rows.
    problems : tuple of str
        What is wrong with the files that could not be read.
    """

    pictures: int
    things: int
    problems: tuple[str, ...]


def things_to_table(
    agent: ThingAgent,
    pictures: Sequence[Path],
    table: Path,
    *,
    on_progress: Callable[[int], None] | None = None,
) -> ThingTable:
    """Write a table with a row for each thing that is found.

    Parameters
    ----------
    agent : ThingAgent
        A trained one.
    pictures : sequence of Path
    table : Path
        ``.csv``, ``.json`` or ``.parquet``. Pictures are named by their paths from its folder.
    on_progress : callable, optional
        Called with the number of pictures that were read.

    Raises
    ------
    DatasetError, BusyError
        If such a table cannot be written; if another process is writing it.
    PictureError
        If none of the pictures could be read.
    """
    check_table(table)
    columns = [
        Column("image"),
        Column("thing"),
        *(Column(corner, "number") for corner in CORNERS),
        *(Column(key) for key in agent.things.features),
    ]
    rows: list[list[Cell]] = []
    problems: list[str] = []
    read = 0
    with sole_writer(table):
        for start in range(0, len(pictures), BATCH):
            for picture, reading in _read(agent, pictures[start : start + BATCH], problems):
                name = Path(os.path.relpath(picture, table.parent)).as_posix()
                rows += _rows_of(name, reading)
                read += 1
            if on_progress is not None:
                on_progress(min(start + BATCH, len(pictures)))
        if pictures and not read:
            raise PictureError(f"none of the pictures could be read: {problems[0]}")
        write_table(table, columns, rows)
    return ThingTable(read, len(rows), tuple(problems))


def _read(
    agent: ThingAgent, pictures: Sequence[Path], problems: list[str]
) -> Iterator[tuple[Path, ThingReading]]:
    """The pictures that can be read with what they show; what is wrong with others is kept."""
    try:
        yield from zip(pictures, list(agent.read_all(pictures)), strict=True)
        return
    except PictureError:
        pass  # which one it is shows when each is read by itself
    for picture in pictures:
        try:
            yield picture, agent.read(picture)
        except PictureError as problem:
            problems.append(str(problem))


def _rows_of(name: str, reading: ThingReading) -> Iterator[list[Cell]]:
    for number, thing in enumerate(reading.things, start=1):
        corners = (getattr(thing.box, corner) for corner in CORNERS)
        values = (seen.value for seen in thing.values.values())
        yield [name, str(number), *(round(corner, 1) for corner in corners), *values]
