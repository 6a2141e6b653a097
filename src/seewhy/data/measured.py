"""Relations between two things that are measured from their boxes.

Which of two things is nearer is told by where they touch the ground: on a picture from above at a
slant, what is nearer reaches further down. A domain that says ``nearer``, ``in_front`` or
``behind`` says that its pictures are such.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from seewhy.data.thing import BoundingBox

__all__ = ["MEASURES", "TOUCHING"]

TOUCHING = 0.05
"""The gap between two things that touch, at most, as a share of the shortest side of both."""

Measure = Callable[[BoundingBox, BoundingBox], bool]
"""Whether a relation holds of the first box to the second."""


def left(first: BoundingBox, second: BoundingBox) -> bool:
    """Whether the middle of one is further left.

    Examples
    --------
    >>> left(BoundingBox(0, 0, 4, 4), BoundingBox(2, 9, 6, 12))
    True
    """
    return first.middle[0] < second.middle[0]


def right(first: BoundingBox, second: BoundingBox) -> bool:
    """Whether the middle of one is further right."""
    return left(second, first)


def above(first: BoundingBox, second: BoundingBox) -> bool:
    """Whether the middle of one is further up in the picture."""
    return first.middle[1] < second.middle[1]


def below(first: BoundingBox, second: BoundingBox) -> bool:
    """Whether the middle of one is further down in the picture."""
    return above(second, first)


def inside(first: BoundingBox, second: BoundingBox) -> bool:
    """Whether one lies within the other, which is larger.

    Examples
    --------
    >>> inside(BoundingBox(1, 1, 2, 2), BoundingBox(0, 0, 4, 2))
    True
    >>> inside(BoundingBox(0, 0, 4, 2), BoundingBox(0, 0, 4, 2))
    False
    """
    within = (
        second.left <= first.left
        and second.top <= first.top
        and first.right <= second.right
        and first.bottom <= second.bottom
    )
    return within and larger(second, first)


def touching(first: BoundingBox, second: BoundingBox) -> bool:
    """Whether two overlap, or are so near that no gap is to be seen.

    Examples
    --------
    >>> touching(BoundingBox(0, 0, 20, 20), BoundingBox(21, 0, 41, 20))
    True
    >>> touching(BoundingBox(0, 0, 20, 20), BoundingBox(22, 0, 42, 20))
    False
    """
    across = max(first.left, second.left) - min(first.right, second.right)
    down = max(first.top, second.top) - min(first.bottom, second.bottom)
    sides = [
        side for box in (first, second) for side in (box.right - box.left, box.bottom - box.top)
    ]
    return max(across, down) <= TOUCHING * min(sides)


def nearer(first: BoundingBox, second: BoundingBox) -> bool:
    """Whether one reaches further down in the picture: there it stands on the ground."""
    return first.bottom > second.bottom


def behind(first: BoundingBox, second: BoundingBox) -> bool:
    """Whether the other is nearer."""
    return nearer(second, first)


def larger(first: BoundingBox, second: BoundingBox) -> bool:
    """Whether one covers more of the picture."""
    return first.area > second.area


MEASURES: Mapping[str, Measure] = MappingProxyType(
    {
        "left": left,
        "right": right,
        "above": above,
        "below": below,
        "inside": inside,
        "touching": touching,
        "nearer": nearer,
        "in_front": nearer,
        "behind": behind,
        "larger": larger,
    }
)
"""What domain.toml calls a measure → the measure."""
