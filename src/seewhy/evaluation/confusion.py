"""Which value was taken for which: counts, and the accuracies that follow from them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from seewhy.evaluation.share import Share

__all__ = ["Confusion", "confusion_of"]


@dataclass(frozen=True)
class Confusion:
    """How often each annotated value was recognised as each value.

    Attributes
    ----------
    values : tuple of str
        Those that were annotated or said, in the domain's order.
    counts : tuple of tuple of int
        A row for each annotated value, a column for each value said.
    undecided : tuple of int
        For each annotated value, the pictures of which nothing was said; never any of a feature.

    Examples
    --------
    >>> pairs = [("red", "red"), ("red", "blue"), ("blue", "blue"), ("blue", None)]
    >>> found = confusion_of(pairs, order=["red", "green", "blue"])
    >>> found.values, found.counts, found.undecided
    (('red', 'blue'), ((1, 1), (0, 1)), (0, 1))
    >>> found.share.value, found.majority, found.majority_share.value
    (0.5, 'red', 0.5)
    """

    values: tuple[str, ...]
    counts: tuple[tuple[int, ...], ...]
    undecided: tuple[int, ...]

    @cached_property
    def pictures(self) -> dict[str, int]:
        """Annotated value → the number of its pictures."""
        rows = zip(self.values, self.counts, self.undecided, strict=True)
        return {value: sum(row) + left for value, row, left in rows if sum(row) + left}

    @cached_property
    def recall(self) -> dict[str, Share]:
        """Annotated value → how many of its pictures were recognised."""
        return {
            value: Share(self.counts[n][n], self.pictures[value])
            for n, value in enumerate(self.values)
            if value in self.pictures
        }

    @property
    def share(self) -> Share:
        """How many pictures were recognised: the accuracy."""
        right = sum(row[n] for n, row in enumerate(self.counts))
        return Share(right, sum(self.pictures.values()))

    @property
    def majority(self) -> str:
        """The value that most pictures are annotated with, the domain's first of equals."""
        return max(self.pictures, key=lambda value: self.pictures[value])

    @property
    def majority_share(self) -> Share:
        """The accuracy of always saying the most frequent value."""
        return Share(self.pictures[self.majority], self.share.of)

    @property
    def balanced_accuracy(self) -> float:
        """The mean over the annotated values of the share that was recognised."""
        return sum(share.value for share in self.recall.values()) / max(1, len(self.recall))

    @cached_property
    def confused(self) -> tuple[tuple[str, str | None, int], ...]:
        """Annotated value, value said instead (None: undecided), how often; most often first."""
        found: list[tuple[str, str | None, int]] = [
            (true, said, count)
            for true, row in zip(self.values, self.counts, strict=True)
            for said, count in zip(self.values, row, strict=True)
            if true != said and count
        ]
        left = zip(self.values, self.undecided, strict=True)
        found += [(true, None, count) for true, count in left if count]
        return tuple(sorted(found, key=lambda case: -case[2]))

    def to_dict(self) -> dict[str, Any]:
        """Return the counts as values that JSON can hold."""
        return {
            "values": list(self.values),
            "counts": [list(row) for row in self.counts],
            "undecided": list(self.undecided),
        }


def confusion_of(pairs: Sequence[tuple[str, str | None]], *, order: Sequence[str]) -> Confusion:
    """Count pairs of an annotated value and what was said, None where nothing was.

    ``order`` has all values that there may be.
    """
    counted = Counter(pairs)
    occur = {value for pair in pairs for value in pair}
    values = tuple(value for value in order if value in occur)
    return Confusion(
        values,
        tuple(tuple(counted[true, said] for said in values) for true in values),
        tuple(counted[true, None] for true in values),
    )
