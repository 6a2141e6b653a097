"""Rows that say different things of one picture."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from seewhy.domain.tables import CLASS
from seewhy.errors import DatasetError

if TYPE_CHECKING:
    from seewhy.data.dataset import Dataset

__all__ = ["Contradiction", "contradictions", "require_agreement"]


class Contradiction(NamedTuple):
    """Two scenes by their positions, and what they say differently."""

    first: int
    second: int
    column: str
    said_first: str
    said_second: str


def contradictions(dataset: Dataset, same: Iterable[Sequence[int]]) -> Iterator[Contradiction]:
    """Yield what scenes say differently that show the same, the first for every later scene.

    A value that is not known contradicts none.

    Parameters
    ----------
    dataset : Dataset
    same : iterable of sequence of int
        Positions of scenes that show the same.
    """
    columns = (CLASS, *dataset.domain.features)
    for positions in same:
        known: dict[str, tuple[int, str]] = {}
        for position in positions:
            scene = dataset.scenes[position]
            for column, value in zip(columns, (scene.label, *scene.vector), strict=True):
                if value is None:
                    continue
                first, said = known.setdefault(column, (position, value))
                if said != value:
                    yield Contradiction(first, position, column, said, value)
                    break


def require_agreement(dataset: Dataset, same: Iterable[Sequence[int]]) -> None:
    """Raise a DatasetError if rows contradict each other that show the same picture.

    Parameters
    ----------
    dataset : Dataset
    same : iterable of sequence of int
        Positions of scenes that show the same picture.
    """
    found = contradictions(dataset, same)
    worst = next(found, None)
    if worst is None:
        return
    more = sum(1 for _ in found)
    first, second = dataset.scenes[worst.first], dataset.scenes[worst.second]
    place = dataset.table
    where, name = place.rows([first.line]), dataset.name_of(second)
    picture, there = f"'{name}'", f"in {where}"
    if first.picture != second.picture:
        picture = f"'{name}', which is '{dataset.name_of(first)}' of {where} once more,"
        there = "there"
    others = f" ({more} more such row{'s' * (more > 1)})" if more else ""
    raise DatasetError(
        f"{place.at(second.line)}: the picture {picture} has {worst.column} "
        f"'{worst.said_second}' here and '{worst.said_first}' {there}; correct or remove one of "
        f"the two rows{others}"
    )
