"""An order of which the first are a few of everywhere."""

from __future__ import annotations

__all__ = ["spread_order"]


def spread_order(count: int) -> list[int]:
    """Return the numbers below ``count`` so that each halves a gap between those before it.

    Neighbours in a folder are often alike; so the first of this order differ, without chance.

    Examples
    --------
    >>> spread_order(8)
    [0, 4, 2, 6, 1, 5, 3, 7]
    """
    bits = max(1, (count - 1).bit_length())
    return sorted(range(count), key=lambda number: int(f"{number:0{bits}b}"[::-1], 2))
