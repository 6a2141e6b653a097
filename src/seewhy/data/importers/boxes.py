"""Boxes in the pixels of their upright picture, and the class that they give it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from math import cos, radians, sin
from typing import Literal

from seewhy.data.importers.annotation import AnnotatedPicture, Box, Notes
from seewhy.data.importers.picture_files import PictureHeader

ClassRule = Literal["only", "largest", "none"]
"""Which class boxes give their picture; see :func:`class_of_boxes`."""

CLASS_RULES: tuple[ClassRule, ...] = ("only", "largest", "none")

TURNED = "boxes that are turned, kept as the upright box around them"

_SAME_SHAPE = 0.02
_ROUNDING = 1.0


def class_of_boxes(boxes: Sequence[Box], rule: ClassRule) -> str:
    """Return the class that a picture has by its boxes; empty for none.

    ``only``: the kind that all boxes are of, if there is one; ``largest``: the kind of the box
    that covers most; ``none``: boxes give no class.

    Examples
    --------
    >>> cat, dog = Box(0, 0, 9, 9, "cat"), Box(0, 0, 5, 5, "dog")
    >>> [class_of_boxes([cat, dog], rule) for rule in CLASS_RULES]
    ['', 'cat', '']
    >>> class_of_boxes([cat, cat], "only")
    'cat'
    """
    kinds = {box.kind for box in boxes}
    if rule == "none" or not boxes:
        return ""
    if rule == "only":
        return kinds.pop() if len(kinds) == 1 else ""
    return max(boxes, key=lambda box: box.area).kind


def boxes_in_pixels(
    picture: AnnotatedPicture, header: PictureHeader, notes: Notes
) -> tuple[Box, ...]:
    """Return the boxes of a picture in pixels of the upright picture, cut off at its edges.

    What lies outside, is empty, or was measured on a picture of another shape is left out and
    noted.

    Examples
    --------
    >>> notes = Notes()
    >>> found = AnnotatedPicture("a.jpg", boxes=(Box(0.5, 0.5, 1.2, 1, "cat"),), measured_in=(1, 1))
    >>> boxes_in_pixels(found, PictureHeader((40, 20), (40, 20)), notes)
    (Box(left=20.0, top=10.0, right=40, bottom=20, kind='cat', attributes={}),)
    >>> [note.text for note in notes.all()]
    ['boxes that reach out of their picture, cut off at its edge']
    """
    boxes = []
    for box in picture.boxes:
        measured = _measured(box, picture, header, notes)
        cut = None if measured is None else _cut(measured, picture.file, header.size, notes)
        if cut is not None:
            boxes.append(cut)
    return tuple(boxes)


def around_turned(
    corners: tuple[float, float, float, float],
    degrees: float,
    *,
    pivot: tuple[float, float] | None = None,
) -> tuple[float, float, float, float]:
    """Return the upright box around one that is turned clockwise, around its centre or a point.

    Examples
    --------
    >>> [round(edge, 6) for edge in around_turned((0, 0, 4, 2), 90)]
    [1.0, -1.0, 3.0, 3.0]
    """
    left, top, right, bottom = corners
    if degrees % 360 == 0:
        return corners
    middle = pivot or ((left + right) / 2, (top + bottom) / 2)
    angle = radians(degrees)
    turned = [
        (
            middle[0] + (across - middle[0]) * cos(angle) - (down - middle[1]) * sin(angle),
            middle[1] + (across - middle[0]) * sin(angle) + (down - middle[1]) * cos(angle),
        )
        for across, down in ((left, top), (right, top), (left, bottom), (right, bottom))
    ]
    columns = [point[0] for point in turned]
    rows = [point[1] for point in turned]
    return (min(columns), min(rows), max(columns), max(rows))


def _measured(
    box: Box, picture: AnnotatedPicture, header: PictureHeader, notes: Notes
) -> Box | None:
    corners = (box.left, box.top, box.right, box.bottom)
    if not all(map(math.isfinite, corners)):
        notes.add("boxes without a size, left out", _say(picture.file, box))
        return None
    width, height = header.size
    seen = picture.measured_in
    if seen is None or seen == (width, height):
        return box
    if seen == (1, 1):
        return _scaled(box, width, height)
    if seen == header.stored:
        return _upright(box, header)
    if _same_shape(seen, header.size):
        notes.add("pictures of another size than they were annotated in, boxes scaled", None)
        return _scaled(box, width / seen[0], height / seen[1])
    if _same_shape(seen, header.stored):
        notes.add("pictures of another size than they were annotated in, boxes scaled", None)
        stored_width, stored_height = header.stored
        return _upright(_scaled(box, stored_width / seen[0], stored_height / seen[1]), header)
    notes.add(
        "boxes measured on a picture of another shape, left out",
        f"{picture.file} is {width}×{height}, was {seen[0]:g}×{seen[1]:g}",
    )
    return None


def _same_shape(first: tuple[float, float], second: tuple[float, float]) -> bool:
    if min(*first, *second) <= 0:
        return False
    ratio = (first[0] / first[1]) / (second[0] / second[1])
    return abs(math.log(ratio)) <= _SAME_SHAPE


def _scaled(box: Box, across: float, down: float) -> Box:
    return replace(
        box,
        left=box.left * across,
        right=box.right * across,
        top=box.top * down,
        bottom=box.bottom * down,
    )


def _upright(box: Box, header: PictureHeader) -> Box:
    """A box on the picture as it is stored, on the picture as a person sees it."""
    width, height = header.stored
    left, top, right, bottom = box.left, box.top, box.right, box.bottom
    if header.orientation in (2, 3, 7, 8):  # mirrored or turned: columns run the other way
        left, right = width - right, width - left
    if header.orientation in (3, 4, 6, 7):  # rows run the other way
        top, bottom = height - bottom, height - top
    if header.orientation in (5, 6, 7, 8):  # rows become columns
        left, top, right, bottom = top, left, bottom, right
    return replace(box, left=left, top=top, right=right, bottom=bottom)


def _cut(box: Box, file: str, size: tuple[int, int], notes: Notes) -> Box | None:
    width, height = size
    if box.right <= box.left or box.bottom <= box.top:
        notes.add("boxes without a size, left out", _say(file, box))
        return None
    if box.right <= 0 or box.bottom <= 0 or box.left >= width or box.top >= height:
        notes.add("boxes outside of their picture, left out", _say(file, box))
        return None
    if min(box.left, box.top) < -_ROUNDING or (
        box.right > width + _ROUNDING or box.bottom > height + _ROUNDING
    ):
        notes.add("boxes that reach out of their picture, cut off at its edge", _say(file, box))
    return replace(
        box,
        left=max(box.left, 0),
        top=max(box.top, 0),
        right=min(box.right, width),
        bottom=min(box.bottom, height),
    )


def _say(file: str, box: Box) -> str:
    corners = ", ".join(f"{corner:g}" for corner in (box.left, box.top, box.right, box.bottom))
    return f"{file} {box.kind} ({corners})"
