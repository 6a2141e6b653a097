"""Which feature vectors can occur, judged by the scenes that did."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from itertools import combinations

import numpy as np

from seewhy.knowledge.scene import FeatureVector
from seewhy.knowledge.vector_index import Part, VectorIndex

__all__ = ["Occurrence"]

EXPECTED = 5.0
"""So many scenes of a combination must be missing before it counts as one that does not occur.

Were the parts independent, none in place of five would be seen once in 150 times.
"""

_REMEMBERED = 20_000


class Occurrence:
    """Tells feature vectors that can occur from those that hold what never goes together.

    Two or three values never go together where no scene has them all, though at least five
    should if the values were independent of each other (of three values: if any one were
    independent of the other two). With few scenes nothing is expected that often, and everything
    can be.

    Knowledge seldom says all that cannot be: a change that it proposes may be one that nobody can
    make. Source: none in the paper; counterfactual explanations are asked to be plausible, see
    Karimi et al. (2022), "A Survey of Algorithmic Recourse".

    Parameters
    ----------
    scenes : mapping of FeatureVector to int
        How often each feature vector was annotated.

    Examples
    --------
    >>> seen = Occurrence({("one", "whole"): 40, ("two", "whole"): 30, ("two", "broken"): 30})
    >>> seen.never_together(("two", "broken"))
    >>> seen.never_together(("one", "broken"))
    ((0, 'one'), (1, 'broken'))
    >>> Occurrence({("one", "whole"): 4, ("two", "broken"): 3}).never_together(("one", "broken"))
    """

    def __init__(self, scenes: Mapping[FeatureVector, int]) -> None:
        self._index = VectorIndex(list(scenes))
        self._counts = np.array(list(scenes.values()), dtype=np.int64)
        self._total = int(self._counts.sum())
        self._number = lru_cache(maxsize=_REMEMBERED)(self._counted)

    def never_together(self, vector: FeatureVector) -> tuple[Part, ...] | None:
        """The first two or three values of a vector that never go together, if there are any."""
        known = [(place, value) for place, value in enumerate(vector) if value is not None]
        every = (parts for size in (2, 3) for parts in combinations(known, size))
        return next((parts for parts in every if self._is_missing(parts)), None)

    def _is_missing(self, parts: tuple[Part, ...]) -> bool:
        if not self._total or self._number(*parts):
            return False
        expected = min(
            self._number(part) * self._number(*(other for other in parts if other != part))
            for part in parts
        )
        return expected / self._total >= EXPECTED

    def _counted(self, *parts: Part) -> int:
        """How many scenes show some values."""
        return int(self._counts[self._index.showing(parts)].sum())
