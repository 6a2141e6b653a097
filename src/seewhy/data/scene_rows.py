"""The rows of a table of pictures, checked against the domain that they are of."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from seewhy.data.picture_path import picture_finder
from seewhy.data.scene import Scene, TablePlace
from seewhy.domain.domain import Domain
from seewhy.domain.tables import CLASS, NO_THINGS, RESERVED
from seewhy.errors import DatasetError
from seewhy.knowledge.scene import FeatureVector
from seewhy.text.nearest import did_you_mean

__all__ = [
    "IMAGE",
    "NONE",
    "OPTIONAL",
    "SPLITS",
    "cells_of_scenes",
    "columns_of",
    "scenes_of_rows",
]

IMAGE = "image"
OPTIONAL = ("split", "group", "reasons")
"""Columns that a row may lack at its end."""

SPLITS = ("train", "test")

NONE = "none"
"""The cell of the column ``things`` by which a picture is said to show none."""


def columns_of(domain: Domain) -> tuple[str, ...]:
    """Return the columns that a table of a domain's pictures may have.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> columns_of(load_domain("structure_stability"))[:4]
    ('image', 'class', 'num_blocks', 'base')
    """
    others = (name for name in RESERVED if name not in (IMAGE, CLASS))
    none = (NO_THINGS,) if domain.things is not None else ()
    return (IMAGE, CLASS, *domain.features, *none, *others)


def cells_of_scenes(
    named: Sequence[tuple[str, Scene]], domain: Domain
) -> dict[str, list[str | None]]:
    """Return column → its cells, one a scene with the name of its picture; None where nobody knows.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> scene = Scene(Path("tower.png"), ("2", "wide", None, None), label="stable", split="test")
    >>> cells = cells_of_scenes([("tower.png", scene)], load_domain("structure_stability"))
    >>> cells["class"], cells["lean"], cells["split"]
    (['stable'], [None], ['test'])
    """
    scenes = [scene for _, scene in named]
    cells: dict[str, list[str | None]] = {
        IMAGE: [name for name, _ in named],
        CLASS: [scene.label for scene in scenes],
    }
    for position, key in enumerate(domain.features):
        cells[key] = [scene.vector[position] for scene in scenes]
    if any(scene.no_things for scene in scenes):
        cells[NO_THINGS] = [NONE if scene.no_things else None for scene in scenes]
    cells["split"] = [scene.split or None for scene in scenes]
    cells["group"] = [scene.group or None for scene in scenes]
    cells["reasons"] = [" ".join(scene.reasons) or None for scene in scenes]
    return cells


def scenes_of_rows(
    columns: Sequence[str],
    rows: Iterable[tuple[int, Sequence[str]]],
    domain: Domain,
    *,
    folder: Path,
    place: TablePlace,
    header: int | None = None,
    outside: bool = False,
) -> Iterator[Scene]:
    """Yield the scenes of rows: their number and their cells, in the order of the columns.

    Raises
    ------
    DatasetError
        If a column, a value or a picture is none; the text names the row and the remedy.
    """
    _check_columns(columns, domain, place.name if header is None else place.at(header))
    # A column that is not there is one behind the last, which is empty in every row.
    place_of = {name: number for number, name in enumerate(columns)}
    image_at, class_at, split_at, group_at, reasons_at = (
        place_of.get(name, -1) for name in (IMAGE, CLASS, *OPTIONAL)
    )
    features_at = [place_of.get(key, -1) for key in domain.features]
    none_at = place_of.get(NO_THINGS, -1) if domain.things is not None else -1
    find = picture_finder(folder, outside=outside)
    vectors: dict[FeatureVector, FeatureVector] = {}

    for number, row in rows:
        here = place.at(number)
        cells = (*row, *[""] * (len(columns) + 1 - len(row)))
        image, label, split = cells[image_at], cells[class_at], cells[split_at]
        if cells[none_at] not in ("", NONE):
            raise DatasetError(
                f"{here}: {NO_THINGS} must be '{NONE}' (nothing is there) or empty, got "
                f"'{cells[none_at]}'; what is there stands in things.csv"
            )
        if not image:
            raise DatasetError(f"{here}: the cell 'image' is empty; name the picture's file")
        if label and label not in domain.classes:
            raise DatasetError(
                f"{here}: '{label}' is no class of the domain '{domain.name}'; "
                f"{did_you_mean(label, domain.classes)}"
            )
        vector = tuple([cells[column] or None for column in features_at])
        if vector not in vectors:
            _check_values(vector, domain, here)
        if split and split not in SPLITS:
            raise DatasetError(f"{here}: split must be 'train', 'test' or empty, got '{split}'")
        yield Scene(
            picture=find(image, here),
            vector=vectors.setdefault(vector, vector),
            label=label or None,
            split=split,
            group=cells[group_at],
            no_things=cells[none_at] == NONE,
            reasons=_reasons(cells[reasons_at], vector, label, domain, here),
            line=number,
        )


def _check_columns(columns: Sequence[str], domain: Domain, here: str) -> None:
    known = columns_of(domain)
    if not any(column in known for column in columns):
        raise DatasetError(
            f"{here}: names no column of the domain '{domain.name}', as the first line of a table "
            f"does; put a line above the rows: {', '.join(known[: -len(OPTIONAL)])}"
        )
    if "" in columns:
        raise DatasetError(
            f"{here}: column {list(columns).index('') + 1} has no name; name it or remove it"
        )
    for column in columns:
        if list(columns).count(column) > 1:
            raise DatasetError(f"{here}: the column '{column}' stands twice; remove one")
        if column not in known:
            raise DatasetError(
                f"{here}: '{column}' is no feature of the domain '{domain.name}'; "
                f"{did_you_mean(column, known)}"
            )
    if IMAGE not in columns:
        raise DatasetError(
            f"{here}: the column 'image' is missing; it names the picture of every row"
        )


def _check_values(vector: FeatureVector, domain: Domain, here: str) -> None:
    for value, (key, feature) in zip(vector, domain.features.items(), strict=True):
        if value is not None and value not in feature.values:
            raise DatasetError(
                f"{here}: '{value}' is no value of '{key}'; {did_you_mean(value, feature.values)}"
            )


def _reasons(
    cell: str, vector: Sequence[str | None], label: str, domain: Domain, here: str
) -> tuple[str, ...]:
    if not cell:
        return ()
    reasons = tuple(dict.fromkeys(cell.split()))
    if not label:
        raise DatasetError(
            f"{here}: there are reasons, but the cell 'class' is empty; say of which class they "
            "are the reasons, or take them away"
        )
    values = dict(zip(domain.features, vector, strict=True))
    for name in reasons:
        if name not in domain.features:
            raise DatasetError(
                f"{here}: the reason '{name}' is no feature of the domain '{domain.name}'; "
                f"{did_you_mean(name, domain.features)}"
            )
        if not values[name]:
            raise DatasetError(
                f"{here}: '{name}' is a reason, but its cell is empty; fill it in, or take the "
                "reason away"
            )
    return reasons
