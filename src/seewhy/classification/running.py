"""Pictures by the hundred thousand become a table, in a run that can be interrupted."""

from __future__ import annotations

import hashlib
import os
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from seewhy import __version__
from seewhy.classification.pictures import BATCH, classify_pictures
from seewhy.classification.rows import Cell, columns_of, row_of
from seewhy.classification.table_files import check_table, write_table
from seewhy.classification.unfinished import UnfinishedTable
from seewhy.errors import PictureError
from seewhy.files.locks import sole_writer

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent

__all__ = ["Classified", "classify_to_table"]

_PROBLEMS_KEPT = 3
_DIFFERS = {"model": "another model", "pictures": "other pictures"}


@dataclass(frozen=True)
class Classified:
    """What a table of classified pictures holds.

    Attributes
    ----------
    table : Path
    pictures : int
        Rows.
    classes : dict of str to int
        Class → rows of it, in the order of the domain; those that occur.
    undecided : int
        Rows of pictures that were read and have no class: not decided, or not known.
    problems : int
        Rows of files that could not be read.
    first_problems : tuple of str
        What is wrong with the first of these.
    """

    table: Path
    pictures: int
    classes: dict[str, int]
    undecided: int
    problems: int
    first_problems: tuple[str, ...]


def classify_to_table(
    agent: Agent,
    pictures: Sequence[Path],
    table: Path | str,
    *,
    model: str,
    on_notice: Callable[[str], None] | None = None,
    on_progress: Callable[[int], None] | None = None,
) -> Classified:
    """Classify picture files and write a table with a row for each.

    What is finished is kept in a file beside the table (``TABLE.part``): a run that was
    interrupted goes on there when it is given again. With another model or other pictures it
    begins anew.

    Parameters
    ----------
    agent : Agent
        A trained one.
    pictures : sequence of Path
    table : Path or str
        The file to write; ``.csv``, ``.json`` or ``.parquet``. It is written when all pictures
        are classified.
    model : str
        What tells the model from all others, such as the digest of its ``model.json``.
    on_notice : callable, optional
        Called with a sentence where finished rows were found, of this run or of another.
    on_progress : callable, optional
        Called with the number of finished rows.

    Raises
    ------
    DatasetError
        If such a table cannot be written.
    BusyError
        If another process is writing it.
    PictureError
        If none of the pictures could be read; the table is written all the same.
    """
    table = Path(table)
    check_table(table)
    columns = columns_of(agent.domain)
    about = {
        "format": 1,
        "seewhy": __version__,
        "model": model,
        "options": [agent.reading, agent.gate, agent.known_share],
        "pictures": _digest_of(pictures),
        "columns": [column.name for column in columns],
    }
    with sole_writer(table), UnfinishedTable(table, about, width=len(columns)) as rows:
        if on_notice is not None:
            _notify(rows, len(pictures), on_notice)
        if on_progress is not None:
            on_progress(rows.done)
        for some in classify_pictures(agent, pictures[rows.done :], batch=BATCH):
            rows.add([row_of(picture, agent.domain) for picture in some])
            if on_progress is not None:
                on_progress(rows.done)
        write_table(table, columns, rows)
        found = _counted(table, rows, tuple(agent.domain.classes))
        rows.remove()
    if found.problems == found.pictures:
        raise PictureError(
            f"{table}: none of {found.pictures:,} pictures could be read, its column 'problem' "
            f"says why; the first: {found.first_problems[0]}"
        )
    return found


def _digest_of(pictures: Sequence[Path]) -> str:
    """A name for these files as they are now: which, how large, and when they were changed."""
    digest = hashlib.sha256()
    for picture in pictures:
        digest.update(os.fsencode(picture) + b"\0")
        try:
            state = picture.stat()
        except (OSError, ValueError):
            continue  # what cannot be read is said in its row
        digest.update(f"{state.st_size} {state.st_mtime_ns}\n".encode())
    return digest.hexdigest()[:16]


def _notify(rows: UnfinishedTable, total: int, on_notice: Callable[[str], None]) -> None:
    if rows.done:
        on_notice(f"{rows.done:,} of {total:,} pictures are classified already ({rows.file})")
    elif rows.differs:
        known = [said for key, said in _DIFFERS.items() if key in rows.differs]
        what = " and ".join(known) or "other options"
        on_notice(f"{rows.file} held rows of {what}; classifying begins anew")


def _counted(table: Path, rows: UnfinishedTable, labels: Sequence[str]) -> Classified:
    counts: Counter[Cell] = Counter()
    problems: list[str] = []
    for _, label, *_, problem in rows:
        if problem is None:
            counts[label] += 1
        elif len(problems) < _PROBLEMS_KEPT:
            problems.append(str(problem))
    read = counts.total()
    return Classified(
        table=table,
        pictures=rows.done,
        classes={label: counts[label] for label in labels if counts[label]},
        undecided=counts[None],
        problems=rows.done - read,
        first_problems=tuple(problems),
    )
