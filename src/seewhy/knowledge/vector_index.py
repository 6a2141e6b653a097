"""Find the feature vectors that show some values."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from seewhy.knowledge.scene import FeatureVector

__all__ = ["Part", "VectorIndex"]

Part = tuple[int, str]
"""The place of a feature in the vectors, and a value."""


class VectorIndex:
    """Feature vectors by the values that they show.

    Examples
    --------
    >>> index = VectorIndex([("one", "whole"), ("two", "whole"), ("two", "broken")])
    >>> index.showing([(0, "two"), (1, "whole")]).tolist()
    [False, True, False]
    """

    def __init__(self, vectors: Sequence[FeatureVector]) -> None:
        self._length = len(vectors)
        self._columns: dict[Part, NDArray[np.bool_]] = {
            (place, value): np.array([vector[place] == value for vector in vectors])
            for place in range(len(vectors[0]) if vectors else 0)
            for value in {vector[place] for vector in vectors}
            if value is not None
        }

    def showing(self, parts: Iterable[Part]) -> NDArray[np.bool_]:
        """Which of the vectors show all of some values."""
        shown = np.ones(self._length, dtype=np.bool_)
        for part in parts:
            shown &= self._columns.get(part, False)
        return shown
