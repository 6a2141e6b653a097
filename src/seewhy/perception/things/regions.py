"""The region around a thing, as a picture of its own."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
from PIL import Image

from seewhy.perception.things.boxes import Boxes

__all__ = ["LONGEST", "MARGIN", "region_side", "regions_of"]

LONGEST = 1024
"""Pixels of a picture's longer side at most when things are looked for in it."""

MARGIN = 0.15
"""Of the longer side of a box, at each side: some of its surroundings are seen, too."""


_REDUCED = 1.25
"""By so much regions may be reduced: by more, lines of two pixels are lost."""


def region_side(boxes: Boxes, sides: Sequence[int]) -> int:
    """The smallest of some sides at which half of the regions are hardly reduced; else the largest.

    Parameters
    ----------
    boxes : ndarray of float, shape (n, 4)
        In pixels of their pictures, as they are looked at.
    sides : sequence of int
        In rising order.

    Examples
    --------
    >>> region_side(np.array([[0.0, 0, 60, 90]]), (112, 160))
    112
    >>> region_side(np.array([[0.0, 0, 130, 190]]), (112, 160))
    160
    """
    longer = (boxes[:, 2:] - boxes[:, :2]).max(axis=1)
    shown = float(np.median(longer)) * (1.0 + 2.0 * MARGIN)
    return next((side for side in sides if shown <= side * _REDUCED), sides[-1])


def regions_of(image: Image.Image, boxes: Boxes, *, side: int) -> npt.NDArray[np.uint8]:
    """The square around the middle of each box, of ``side`` by ``side`` pixels.

    What lies beyond the picture has the mean colour of the region's border.

    Parameters
    ----------
    image : Image
        In red, green and blue.
    boxes : ndarray of float, shape (n, 4)
        In its pixels.
    side : int

    Returns
    -------
    ndarray of uint8, shape (n, side, side, 3)

    Examples
    --------
    >>> image = Image.new("RGB", (40, 20), "red")
    >>> regions_of(image, np.array([[0.0, 0, 10, 10]]), side=16).shape
    (1, 16, 16, 3)
    """
    found = np.empty((len(boxes), side, side, 3), dtype=np.uint8)
    for number, box in enumerate(boxes):
        found[number] = _region(image, box, side)
    return found


def _region(image: Image.Image, box: npt.NDArray[np.float64], side: int) -> npt.NDArray[np.uint8]:
    width, height = float(box[2] - box[0]), float(box[3] - box[1])
    half = max(max(width, height) * (0.5 + MARGIN), 1.0)
    across, down = float(box[0] + box[2]) / 2, float(box[1] + box[3]) / 2
    # A box outside of its picture, as far as rounding goes, still shows a pixel of it.
    left = min(max(across - half, 0.0), image.width - 1.0)
    top = min(max(down - half, 0.0), image.height - 1.0)
    right = max(min(across + half, float(image.width)), left + 1.0)
    bottom = max(min(down + half, float(image.height)), top + 1.0)
    scale = side / (2 * half)
    columns = min(side, max(1, round((right - left) * scale)))
    rows = min(side, max(1, round((bottom - top) * scale)))
    seen = np.asarray(
        image.resize((columns, rows), Image.Resampling.BILINEAR, box=(left, top, right, bottom))
    )
    if (rows, columns) == (side, side):
        return seen
    border = np.concatenate([seen[0], seen[-1], seen[:, 0], seen[:, -1]])
    canvas = np.empty((side, side, 3), dtype=np.uint8)
    canvas[:] = np.rint(border.mean(axis=0)).astype(np.uint8)
    first_column = min(side - columns, max(0, round((left - (across - half)) * scale)))
    first_row = min(side - rows, max(0, round((top - (down - half)) * scale)))
    canvas[first_row : first_row + rows, first_column : first_column + columns] = seen
    return canvas
