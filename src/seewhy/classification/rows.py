"""What stands in a row of the table of classified pictures."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from seewhy.classification.pictures import ClassifiedPicture
from seewhy.domain.domain import Domain

__all__ = ["Cell", "Column", "columns_of", "row_of"]

Cell = str | float | None

_FIRST = ("image", "class", "probability", "method", "verdict")
_LAST = ("reasons", "problem")
_NUMBERS = frozenset({"probability"})


@dataclass(frozen=True)
class Column:
    """A column: its name, and what its cells are where they are not empty."""

    name: str
    kind: Literal["text", "number"] = "text"


def columns_of(domain: Domain) -> tuple[Column, ...]:
    """Return the columns for a domain: those of every table, and two for each feature.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> [column.name for column in columns_of(load_domain("structure_stability"))][4:8]
    ['verdict', 'num_blocks', 'num_blocks_probability', 'base']
    """
    taken = {*_FIRST, *_LAST}
    features: list[Column] = []
    for feature in domain.features:
        name = feature
        while {name, f"{name}_probability"} & taken:
            name = f"feature_{name}"
        taken |= {name, f"{name}_probability"}
        features += [Column(name), Column(f"{name}_probability", "number")]
    first, last = (
        [Column(name, "number" if name in _NUMBERS else "text") for name in names]
        for names in (_FIRST, _LAST)
    )
    return (*first, *features, *last)


def row_of(classified: ClassifiedPicture, domain: Domain) -> list[Cell]:
    """Return the cells of a picture, one a column of :func:`columns_of`."""
    # A file's name may hold bytes that are no text, which no table can.
    image = os.fsencode(classified.picture.as_posix()).decode("utf-8", "backslashreplace")
    scene = classified.classification
    if scene is None:
        empty: Sequence[Cell] = [None] * (len(_FIRST) - 1 + 2 * len(domain.features))
        return [image, *empty, None, classified.problem]
    features: list[Cell] = []
    for feature in domain.features:
        reading = scene.features[feature]
        features += [reading.value, round(reading.probability, 4)]
    probability = None if scene.probability is None else round(scene.probability, 4)
    first = [image, scene.label, probability, scene.method, scene.verdict]
    return [*first, *features, classified.reasons, None]
