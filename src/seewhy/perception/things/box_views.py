"""A picture with its boxes in another view: smaller, elsewhere, mirrored, in another light."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from PIL import Image

from seewhy.perception.things.boxes import Boxes

__all__ = ["View", "view_of"]

_SMALLEST, _LARGEST = 0.7, 1.25
_LIGHT = 0.25  # by how much levels are multiplied, more or less
_SEEN = 0.5  # of a box that reaches out of the view, so much must be in it


class View(NamedTuple):
    """A square picture, and the boxes in its pixels."""

    pixels: npt.NDArray[np.uint8]
    boxes: Boxes


def view_of(
    pixels: npt.NDArray[np.uint8],
    boxes: Boxes,
    *,
    side: int,
    generator: np.random.Generator | None = None,
) -> View:
    """Return a view of ``side`` by ``side`` pixels; without a generator, the picture as it is.

    Parameters
    ----------
    pixels : ndarray of uint8, shape (rows, columns, 3)
        With a longer side of ``side``.
    boxes : ndarray of float, shape (n, 4)
    side : int
    generator : Generator, optional
        Settles the view.

    Examples
    --------
    >>> pixels = np.zeros((16, 32, 3), dtype=np.uint8)
    >>> view_of(pixels, np.array([[0.0, 0, 8, 8]]), side=32).pixels.shape
    (32, 32, 3)
    """
    scale, left, top, mirrored, light = 1.0, 0.0, 0.0, False, np.ones(3)
    if generator is not None:
        scale = float(generator.uniform(_SMALLEST, _LARGEST))
        rows, columns = (length * scale for length in pixels.shape[:2])
        left, top = (
            float(generator.uniform(min(0.0, side - length), max(0.0, side - length)))
            for length in (columns, rows)
        )
        mirrored = bool(generator.integers(2))
        light = generator.uniform(1 - _LIGHT, 1 + _LIGHT) * generator.uniform(0.92, 1.08, 3)
    size = (max(1, round(pixels.shape[1] * scale)), max(1, round(pixels.shape[0] * scale)))
    drawn = Image.fromarray(pixels)
    if drawn.size != size:
        drawn = drawn.resize(size, Image.Resampling.BILINEAR)
    mean = tuple(int(level) for level in np.rint(pixels.mean(axis=(0, 1))))
    canvas = Image.new("RGB", (side, side), mean)
    canvas.paste(drawn, (round(left), round(top)))
    shown = np.asarray(canvas)
    if generator is not None:
        shown = np.clip(shown * light, 0, 255).astype(np.uint8)
    found = boxes * scale + np.array([round(left), round(top)] * 2, dtype=np.float64)
    if mirrored:
        shown = shown[:, ::-1]
        found = np.stack([side - found[:, 2], found[:, 1], side - found[:, 0], found[:, 3]], axis=1)
    return View(np.ascontiguousarray(shown), _inside(found, side))


def _inside(boxes: Boxes, side: int) -> Boxes:
    """What is seen of boxes, of those of which enough is."""
    cut = boxes.clip(0.0, float(side))
    areas = [np.prod(one[:, 2:] - one[:, :2], axis=1) for one in (cut, boxes)]
    seen: Boxes = cut[areas[0] >= _SEEN * np.maximum(areas[1], 1e-9)]
    return seen
