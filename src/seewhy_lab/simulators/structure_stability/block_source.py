"""The image source of structure_blocks: pictures of structures, and each block in them."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from seewhy_lab.rendering.rays import Scene
from seewhy_lab.simulators.structure_stability.annotation import displaced_blocks
from seewhy_lab.simulators.structure_stability.generation import PALETTE, random_structure
from seewhy_lab.simulators.structure_stability.physics import build_model
from seewhy_lab.simulators.structure_stability.rendering import render
from seewhy_lab.simulators.structure_stability.structure import Block
from seewhy_lab.simulators.structure_stability.view import camera_of, random_view
from seewhy_lab.simulators.thing_rows import boxes, thing_rows

__all__ = ["COLOURS", "colour_of", "draw", "width_of"]

COLOURS = ("red", "blue", "yellow", "green", "orange", "purple", "white", "teal", "pink")
"""What the paints of the palette are called, in its order."""

NARROW, WIDE = 0.043, 0.048
"""Narrow up to the first width, wide from the second on, in metres; no block lies between."""


def colour_of(block: Block) -> str:
    """The name of the paint that is most like a block's.

    >>> colour_of(Block(width=0.05, depth=0.05, height=0.04, colour=(0.75, 0.15, 0.1)))
    'red'
    """
    return min(
        zip(PALETTE, COLOURS, strict=True), key=lambda paint: math.dist(paint[0], block.colour)
    )[1]


def width_of(block: Block) -> str:
    """Whether a block is wide or narrow.

    >>> width_of(Block(width=0.06, depth=0.05, height=0.04))
    'wide'
    """
    return "wide" if block.width >= WIDE else "narrow"


def draw(
    *, seed: int, index: int, size: int = 224
) -> tuple[
    NDArray[np.uint8],
    dict[str, str],
    None,
    list[dict[str, str | int]],
    list[tuple[str, str, str]],
]:
    """Draws picture number `index` of the set that `seed` stands for.

    A picture depends on `seed`, `index` and `size` only.

    Returns:
        The picture, shape (size, size, 3); no features of the whole, and no class; a row of
        things.csv for each block from left to right; and the related pairs: what lies `on` what,
        and `beyond` the edge of what.
    """
    rng = np.random.default_rng([seed, index])
    structure = random_structure(rng)
    view = random_view(structure, rng)
    picture = render(structure, view, size=size)
    scene, camera = Scene(*build_model(structure)), camera_of(view, size=size)
    rows, columns = np.divmod(np.arange(size * size), size)
    geom, _, _ = scene.cast(camera.eye, camera.rays(rows + 0.5, columns + 0.5))
    seen = np.maximum(geom - 1, -1).reshape(size, size)  # geom 0 is the table
    found = boxes(seen, len(structure.blocks))
    things, names = thing_rows(
        found,
        [{"colour": colour_of(block), "width": width_of(block)} for block in structure.blocks],
    )
    related = [("on", names[number], names[number - 1]) for number in range(1, len(found))]
    related += [
        ("beyond", names[number], names[number - 1]) for number in displaced_blocks(structure)
    ]
    return picture, {}, None, things, sorted(related)
