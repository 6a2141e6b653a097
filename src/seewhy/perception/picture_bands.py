"""A picture from the top down, so that a large one takes little memory."""

from __future__ import annotations

from collections.abc import Iterator

from PIL import Image

_BAND = 1_000_000
"""Pixels that are converted at a time."""


def bands_of(image: Image.Image, *, factor: int = 1) -> Iterator[Image.Image]:
    """A picture from the top down, some rows at a time, their number divisible by ``factor``."""
    rows = max(1, _BAND // (image.width * factor)) * factor
    for top in range(0, image.height, rows):
        yield image.crop((0, top, image.width, min(image.height, top + rows)))
