"""Photographs of whole tables of the game SET: where their nine cards lie, and what each shows.

The photographs of github.com/tomwhite/set-game show nine cards of one colour and number on a dark
table, in three rows (solid, striped, empty) and three columns (oval, diamond, squiggle). A card is
bright, the table is dark; so each is found as one bright region.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from scipy import ndimage

from seewhy.data.thing import BoundingBox, Thing
from seewhy.errors import DatasetError
from seewhy.perception.picture_file import open_picture

__all__ = ["cards_on", "photographed_table"]

NUMBERS = {"1": "one", "2": "two", "3": "three"}
COLOURS = ("red", "green", "purple")
SHADINGS, SHAPES = ("solid", "striped", "empty"), ("oval", "diamond", "squiggle")
_FEWEST = 0.01
"""Of the picture: a bright region that is smaller is no card."""
_GAP = 5
"""Pixels by which cards lie apart at least: what is thinner joins none."""


def photographed_table(file: Path) -> tuple[Image.Image, tuple[Thing, ...]]:
    """Return a photograph whose name begins with COLOUR-NUMBER, and its cards row by row.

    Raises
    ------
    DatasetError
        If it is called otherwise, or not nine cards are found.
    """
    colour, number, *_ = [*file.stem.split("-"), "", ""]
    if number not in NUMBERS or colour not in COLOURS:
        raise DatasetError(f"{file}: must be called COLOUR-NUMBER-CAPTURE, as in red-2-2017_1.jpg")
    with open_picture(file) as opened:
        picture = opened.convert("RGB")
    boxes = cards_on(picture)
    count = len(SHADINGS) * len(SHAPES)
    if len(boxes) != count:
        raise DatasetError(f"{file}: {count} cards were expected, {len(boxes)} found")
    kinds = [(shading, shape) for shading in SHADINGS for shape in SHAPES]
    things = tuple(
        Thing(
            str(place),
            {"number": NUMBERS[number], "colour": colour, "shading": shading, "shape": shape},
            box,
        )
        for place, (box, (shading, shape)) in enumerate(zip(boxes, kinds, strict=True), start=1)
    )
    return picture, things


def cards_on(picture: Image.Image) -> list[BoundingBox]:
    """Return where bright cards lie on a dark table, row by row of three, from the left.

    Examples
    --------
    >>> table = Image.new("RGB", (300, 300), (20, 20, 20))
    >>> table.paste((230, 230, 230), (100, 40, 160, 120))
    >>> cards_on(table)
    [BoundingBox(left=100.0, top=40.0, right=160.0, bottom=120.0)]
    """
    grey = np.asarray(picture.convert("L"))
    filled = ndimage.binary_fill_holes(grey > _threshold(grey))
    regions, _ = ndimage.label(ndimage.binary_opening(filled, np.ones((_GAP, _GAP), bool)))
    found = []
    for number, place in enumerate(ndimage.find_objects(regions), start=1):
        if (regions[place] == number).sum() >= _FEWEST * grey.size:
            down, across = place
            corners = (across.start, down.start, across.stop, down.stop)
            found.append(BoundingBox(*map(float, corners)))
    found.sort(key=lambda box: box.top + box.bottom)
    rows = [found[start : start + 3] for start in range(0, len(found), 3)]
    return [box for row in rows for box in sorted(row, key=lambda box: box.left)]


def _threshold(grey: NDArray[np.uint8]) -> int:
    """The level that parts dark from bright best (Otsu 1979)."""
    counts = np.bincount(grey.ravel(), minlength=256).astype(float)
    below = np.cumsum(counts)
    above = below[-1] - below
    sums = np.cumsum(counts * np.arange(256))
    with np.errstate(divide="ignore", invalid="ignore"):
        apart = below * above * (sums / below - (sums[-1] - sums) / above) ** 2
    return int(np.nanargmax(apart))
