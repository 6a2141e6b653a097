"""Relations between two things that are measured from their boxes.

Which of two things is nearer is told by where they touch the ground: on a picture from above at a
slant, what is nearer reaches further down. A domain that says ``nearer``, ``in_front`` or
``behind`` says that its pictures are such.

Corners may be arrays: so many boxes are measured at once (:func:`how_probable`).
What stands on another thing touches no ground. Where a domain says which relation that is
(``support``), where a thing stands is measured from the box of what is at the foot of its stack:
things of one stack are neither left of nor in front of each other.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import reduce
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seewhy.data.thing import BoundingBox

__all__ = ["MEASURES", "STANDING", "TOUCHING", "feet", "how_probable"]

TOUCHING = 0.05
"""The gap between two things that touch, at most, as a share of the shortest side of both."""

Holds = Any
"""Yes or no; an array of them where corners are arrays."""

Measure = Callable[[BoundingBox, BoundingBox], Holds]
"""Whether a relation holds of the first box to the second."""


def left(first: BoundingBox, second: BoundingBox) -> Holds:
    """Whether the middle of one is further left.

    Examples
    --------
    >>> left(BoundingBox(0, 0, 4, 4), BoundingBox(2, 9, 6, 12))
    True
    """
    return first.middle[0] < second.middle[0]


def right(first: BoundingBox, second: BoundingBox) -> Holds:
    """Whether the middle of one is further right."""
    return left(second, first)


def above(first: BoundingBox, second: BoundingBox) -> Holds:
    """Whether the middle of one is further up in the picture."""
    return first.middle[1] < second.middle[1]


def below(first: BoundingBox, second: BoundingBox) -> Holds:
    """Whether the middle of one is further down in the picture."""
    return above(second, first)


def inside(first: BoundingBox, second: BoundingBox) -> Holds:
    """Whether one lies within the other, which is larger.

    Examples
    --------
    >>> inside(BoundingBox(1, 1, 2, 2), BoundingBox(0, 0, 4, 2))
    True
    >>> inside(BoundingBox(0, 0, 4, 2), BoundingBox(0, 0, 4, 2))
    False
    """
    within = (
        (second.left <= first.left)
        & (second.top <= first.top)
        & (first.right <= second.right)
        & (first.bottom <= second.bottom)
    )
    return within & larger(second, first)


def touching(first: BoundingBox, second: BoundingBox) -> Holds:
    """Whether two overlap, or are so near that no gap is to be seen.

    Examples
    --------
    >>> bool(touching(BoundingBox(0, 0, 20, 20), BoundingBox(21, 0, 41, 20)))
    True
    >>> bool(touching(BoundingBox(0, 0, 20, 20), BoundingBox(22, 0, 42, 20)))
    False
    """
    across = np.maximum(first.left, second.left) - np.minimum(first.right, second.right)
    down = np.maximum(first.top, second.top) - np.minimum(first.bottom, second.bottom)
    sides = [
        side for box in (first, second) for side in (box.right - box.left, box.bottom - box.top)
    ]
    shortest = reduce(np.minimum, sides)
    holds: Holds = np.maximum(across, down) <= TOUCHING * shortest
    return holds


def nearer(first: BoundingBox, second: BoundingBox) -> Holds:
    """Whether one reaches further down in the picture: there it stands on the ground."""
    return first.bottom > second.bottom


def behind(first: BoundingBox, second: BoundingBox) -> Holds:
    """Whether the other is nearer."""
    return nearer(second, first)


def larger(first: BoundingBox, second: BoundingBox) -> Holds:
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

_DRAWS = 128


def how_probable(
    measure: Measure, boxes: NDArray[np.float64], spread: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return how probable it is that a relation holds of each box to each other one.

    Where two boxes are nearly alike, a detector that is a little off decides: the share is taken
    of boxes whose corners are drawn around those given. The same boxes give the same shares.

    Parameters
    ----------
    measure : callable
        One of :data:`MEASURES`.
    boxes : ndarray of float, shape (n, 4)
        Left, top, right and bottom.
    spread : ndarray of float, shape (n, 4)
        The standard deviation of each.

    Returns
    -------
    ndarray of float, shape (n, n)
        Of the box of the row to the box of the column.

    Examples
    --------
    >>> boxes = np.array([[0.0, 0, 10, 10], [1.0, 0, 11, 10], [50.0, 0, 60, 10]])
    >>> how_probable(left, boxes, np.ones((3, 4)))[0].round(1).tolist()
    [0.0, 0.9, 1.0]
    """
    drawn = np.random.default_rng(0).normal(size=(_DRAWS, len(boxes), 4))
    # Each draw and its mirror image, so that nothing leans to one side by chance.
    corners = boxes + np.concatenate([drawn, -drawn]) * spread
    first = BoundingBox(*np.moveaxis(corners[:, :, None, :], -1, 0))
    second = BoundingBox(*np.moveaxis(corners[:, None, :, :], -1, 0))
    shares: NDArray[np.float64] = np.broadcast_to(
        measure(first, second), (len(corners), len(boxes), len(boxes))
    ).mean(axis=0)
    np.fill_diagonal(shares, 0.0)
    return shares


STANDING = frozenset({"left", "right", "nearer", "in_front", "behind"})
"""Measures of where things stand, not of how they are seen."""


def feet(names: Iterable[str], stands_on: Iterable[tuple[str, str]]) -> dict[str, str]:
    """Return for each thing the one at the foot of its stack; itself, where it stands on none.

    ``stands_on`` has each thing that stands on another, with that other. What would stand on
    itself, by way of others, is at its own foot.

    Examples
    --------
    >>> feet(["ball", "block", "cup"], [("ball", "block"), ("block", "cup")])
    {'ball': 'cup', 'block': 'cup', 'cup': 'cup'}
    """
    below: dict[str, str] = {}
    for thing, other in stands_on:
        below.setdefault(thing, other)
    found = {}
    for name in names:
        foot, passed = name, {name}
        while foot in below and below[foot] not in passed:
            foot = below[foot]
            passed.add(foot)
        found[name] = foot if foot not in below else name
    return found
