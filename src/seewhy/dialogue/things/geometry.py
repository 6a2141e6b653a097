"""Where things are to one another: distances, and what lies between two."""

from __future__ import annotations

from collections.abc import Sequence
from math import dist

from seewhy.data.thing_scene import Position

__all__ = ["between", "distances"]

_BESIDE = 0.5
"""How far from the line between two things a thing may be that is between them, of its length."""


def distances(positions: Sequence[Position], number: int) -> list[float]:
    """Return how far each thing is from one of them.

    Examples
    --------
    >>> distances([(0, 0, 0), (3, 4, 0)], 0)
    [0.0, 5.0]
    """
    return [dist(position, positions[number]) for position in positions]


def between(positions: Sequence[Position], first: int, second: int) -> int:
    """Return the set of things between two: before one, behind the other, near their line.

    Examples
    --------
    >>> between([(0, 0, 0), (4, 0, 0), (2, 1, 0), (2, 9, 0), (5, 0, 0)], 0, 1)
    4
    """
    start, end = positions[first], positions[second]
    length = dist(start, end)
    found = 0
    for number, position in enumerate(positions):
        if number in (first, second) or length == 0:
            continue
        along = sum((p - s) * (e - s) for p, s, e in zip(position, start, end, strict=True)) / (
            length * length
        )
        foot = tuple(s + along * (e - s) for s, e in zip(start, end, strict=True))
        if 0 < along < 1 and dist(position, foot) <= _BESIDE * length:
            found |= 1 << number
    return found
