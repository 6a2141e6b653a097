"""A lesson: the pictures that eyes are taught by, and what is annotated of them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from seewhy.errors import DatasetError
from seewhy.perception.labels import labelled
from seewhy.perception.validation import folds

__all__ = ["Lesson", "Targets"]

Pictures = npt.NDArray[np.uint8]
Rows = npt.NDArray[np.int64]

Targets = Mapping[str, npt.NDArray[np.int64]]
"""Feature → the index of each picture's value, -1 where nobody knows it."""


@dataclass(frozen=True)
class Lesson:
    """What eyes are taught by.

    Attributes
    ----------
    batches : callable
        Yields the pictures from the first on, each time it is called: arrays of uint8, of shape
        (some, side, side, 3).
    labels : mapping of str to sequence of str or None, length n
        Each feature's value in each picture; None where it is unknown.
    values : mapping of str to sequence of str
        All values that each feature can have.
    strata : sequence, length n
        What pictures kept for validation are to show in the same shares.
    groups : sequence, length n
        Pictures of one group are never divided.
    """

    batches: Callable[[], Iterator[Pictures]]
    labels: Mapping[str, Sequence[str | None]]
    values: Mapping[str, Sequence[str]]
    strata: Sequence[object]
    groups: Sequence[object]

    def __len__(self) -> int:
        return len(self.strata)

    def targets(self) -> dict[str, npt.NDArray[np.int64]]:
        """The index of each picture's value, -1 where nobody knows it, for every feature.

        Raises
        ------
        DatasetError
            There is no picture or no feature, or a feature has no label at all.
        """
        if not len(self):
            raise DatasetError("there is no picture to learn from: add labelled pictures")
        if not self.labels:
            raise DatasetError("there is no feature to learn: name at least one in the domain")
        found = {}
        for name, column in self.labels.items():
            rows, values = labelled(column, feature=name, values=self.values[name])
            found[name] = np.full(len(self), -1, dtype=np.int64)
            found[name][rows] = values
        return found

    def parts(self, count: int, *, seed: int) -> list[Rows]:
        """The places of the pictures in ``count`` parts, groups whole, strata in the same shares.

        Fewer come back where there are fewer groups.
        """
        return folds(self.strata, count=count, seed=seed, groups=self.groups)

    def pictures(self, rows: Rows) -> Pictures:
        """The pictures at some places, in their order; the others pass through the memory."""
        found: dict[int, Pictures] = {}
        wanted = set(rows.tolist())
        start = 0
        for batch in self.batches():
            for place in wanted.intersection(range(start, start + len(batch))):
                found[place] = batch[place - start]
            start += len(batch)
            if len(found) == len(wanted):
                break
        return np.stack([found[place] for place in rows.tolist()])
