"""What stands at the boxes of a picture: names where they have room, else numbers."""

from __future__ import annotations

from collections.abc import Sequence

from seewhy.data.thing import BoundingBox

__all__ = ["box_labels", "letter_size"]

_LETTER = 0.62
"""How wide a letter is, in heights of letters."""

_LATE = 0.55
"""A name ends at the right side of a box that begins behind this share of the picture."""


def letter_size(size: tuple[int, int]) -> float:
    """How high letters are in a picture of so many pixels."""
    return max(size) * 0.04


def box_labels(
    boxes: Sequence[BoundingBox], names: Sequence[str], size: tuple[int, int]
) -> list[str]:
    """Return "1: the name" for each box, or "1" where that would lie over another or be cut off.

    Examples
    --------
    >>> boxes = [BoundingBox(0, 0, 40, 40), BoundingBox(30, 2, 60, 40)]
    >>> box_labels(boxes, ["red cube", "blue ball"], (400, 300))
    ['1: red cube', '2']
    """
    high = letter_size(size)
    taken: list[tuple[float, float, float, float]] = []
    labels = []
    for number, (box, name) in enumerate(zip(boxes, names, strict=True), start=1):
        for label in (f"{number}: {name}", f"{number}"):
            wide = _LETTER * high * len(label)
            left = box.right - wide if box.left > _LATE * size[0] else box.left
            place = (left, box.top, left + wide, box.top + 1.2 * high)
            outside = place[0] < 0 or place[2] > size[0]
            if not outside and not any(_overlap(place, other) for other in taken):
                break
        taken.append(place)
        labels.append(label)
    return labels


def _overlap(
    one: tuple[float, float, float, float], other: tuple[float, float, float, float]
) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]
