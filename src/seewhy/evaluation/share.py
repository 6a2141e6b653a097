"""A share of pictures, and how uncertain it is for being one of few."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

__all__ = ["Share"]

LEVEL = 0.95
"""Of the intervals beside shares."""


@dataclass(frozen=True)
class Share:
    """So many of so many pictures.

    Attributes
    ----------
    right, of : int
        ``right`` of ``of`` pictures; 0 of 0 is a share of nothing, which is 0.

    Examples
    --------
    >>> share = Share(right=18, of=20)
    >>> share.value, [round(end, 3) for end in share.interval]
    (0.9, [0.699, 0.972])
    """

    right: int
    of: int

    @property
    def value(self) -> float:
        """The share, 0 to 1."""
        return self.right / self.of if self.of else 0.0

    @cached_property
    def interval(self) -> tuple[float, float]:
        """The ends of the 95 % interval (Wilson 1927), as if pictures were independent."""
        if not self.of:
            return 0.0, 1.0
        from scipy.stats import binomtest  # slow to import, and answering needs none of it

        found = binomtest(self.right, self.of).proportion_ci(LEVEL, method="wilson")
        return float(found.low), float(found.high)
