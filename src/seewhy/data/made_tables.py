"""The tables of pictures that a source has made: written, and read again where a call goes on."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from pathlib import Path

from seewhy.data.dataset import TABLE
from seewhy.data.made_picture import Annotation
from seewhy.data.thing import CORNERS, RELATIONS, THINGS
from seewhy.domain.domain import Domain
from seewhy.errors import DatasetError
from seewhy.files.csv_text import csv_text
from seewhy.files.whole_files import write_whole

__all__ = ["made_annotations", "write_made_tables"]

_RELATION_COLUMNS = ("image", "relation", "thing", "other")


def _picture(index: int) -> str:
    return f"images/{index:06d}.png"


def write_made_tables(
    folder: Path, domain: Domain, made: Sequence[Annotation], test_share: float
) -> None:
    """Write scenes.csv, and things.csv and relations.csv where the domain has things."""
    if domain.things is not None:
        columns = ["thing", *CORNERS, *domain.things.features]
        rows = [
            [_picture(index), *(row.get(column, "") for column in columns)]
            for index, one in enumerate(made)
            for row in one.things
        ]
        write_whole(folder / THINGS, csv_text(["image", *columns], rows))
        said = [
            [_picture(index), *one_said]
            for index, one in enumerate(made)
            for one_said in one.related
        ]
        write_whole(folder / RELATIONS, csv_text(_RELATION_COLUMNS, said))
    lines = []
    for index, one in enumerate(made):
        # Spread evenly: every third for a third, whatever the count.
        is_test = int((index + 1) * test_share) > int(index * test_share)
        lines.append(
            [
                _picture(index),
                *([one.label or ""] if domain.classes else []),
                *(one.features[key] for key in domain.features),
                "test" if is_test else "train",
            ]
        )
    has_class = ["class"] if domain.classes else []
    # That of the pictures comes last: where it stands, the others do.
    write_whole(folder / TABLE, csv_text(["image", *has_class, *domain.features, "split"], lines))


def made_annotations(folder: Path, domain: Domain) -> dict[int, Annotation]:
    """Return the annotation of pictures that an earlier call with the same settings finished.

    Raises
    ------
    DatasetError
        If a table was edited.
    """
    if not (folder / TABLE).is_file():
        return {}
    file = folder / TABLE
    try:
        found = {
            _index(row): Annotation(
                {key: row[key] for key in domain.features},
                row["class"] or None if domain.classes else None,
                [],
                [],
            )
            for row in _rows(file)
        }
        if domain.things is not None:
            file = folder / THINGS
            for row in _rows(file):
                found[_index(row)].things.append({k: v for k, v in row.items() if k != "image"})
            file = folder / RELATIONS
            for row in _rows(file):
                found[_index(row)].related.append((row["relation"], row["thing"], row["other"]))
    except (OSError, csv.Error, KeyError, TypeError, ValueError):
        raise DatasetError(
            f"{file}: is not as it was made; delete it and the pictures are annotated again, or "
            "choose another folder"
        ) from None
    return found


def _rows(file: Path) -> list[dict[str, str]]:
    with file.open(newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def _index(row: dict[str, str]) -> int:
    return int(Path(row["image"]).stem)
