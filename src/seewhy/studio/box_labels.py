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
    ['1', '2: blue ball']
    """
    labels = [str(number) for number in range(1, len(boxes) + 1)]
    places = [_place(box, label, size) for box, label in zip(boxes, labels, strict=True)]
    for number, (box, name) in enumerate(zip(boxes, names, strict=True)):
        whole = f"{labels[number]}: {name}"
        place = _place(box, whole, size)
        others = (other for at, other in enumerate(places) if at != number)
        if (
            place[0] >= 0
            and place[2] <= size[0]
            and not any(_overlap(place, other) for other in others)
        ):
            labels[number], places[number] = whole, place
    return labels


def _place(
    box: BoundingBox, label: str, size: tuple[int, int]
) -> tuple[float, float, float, float]:
    """Where a label lies: left, top, right and bottom."""
    high = letter_size(size)
    wide = _LETTER * high * len(label)
    left = box.right - wide if box.left > _LATE * size[0] else box.left
    return left, box.top, left + wide, box.top + 1.2 * high


def _overlap(
    one: tuple[float, float, float, float], other: tuple[float, float, float, float]
) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]
