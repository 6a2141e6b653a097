"""Blocks and the structures that are built from them, as plain data.

The world frame has its origin on the table top: ``x`` to the right of the picture, ``y`` away
from the camera, ``z`` up. Lengths are in metres and angles in radians.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["Block", "FloatArray", "Structure"]

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Block:
    """One wooden block, a cuboid.

    `x` and `y` are the horizontal position of its centre; how high it lies follows from the
    blocks below it. `yaw` turns it about the vertical. `tilt` raises one of its lower edges from
    what it lies on, turning it in the plane of the picture (positive: towards the right).
    `colour` is red, green and blue in sRGB, each from 0 to 1.
    """

    width: float
    depth: float
    height: float
    x: float = 0.0
    y: float = 0.0
    yaw: float = 0.0
    tilt: float = 0.0
    colour: tuple[float, float, float] = (0.78, 0.12, 0.10)

    def __post_init__(self) -> None:
        for name in ("width", "depth", "height"):
            value = getattr(self, name)
            if not value > 0.0:
                raise ValueError(f"{name} of a block must be above 0 m, got {value}")

    @property
    def half(self) -> FloatArray:
        """Half of width, depth and height, shape (3,), in metres."""
        return np.array([self.width, self.depth, self.height]) / 2.0

    @property
    def rotation(self) -> FloatArray:
        """The rotation from the frame of the block to the world's, shape (3, 3)."""
        cy, sy = math.cos(self.yaw), math.sin(self.yaw)
        ct, st = math.cos(self.tilt), math.sin(self.tilt)
        turn = np.array([[cy, -sy, 0.0], [sy, cy, 0.0], [0.0, 0.0, 1.0]])
        lean = np.array([[ct, 0.0, st], [0.0, 1.0, 0.0], [-st, 0.0, ct]])
        return np.asarray(turn @ lean)

    @property
    def half_rise(self) -> float:
        """How far the block reaches above and below its centre, in metres."""
        return float(np.abs(self.rotation[2]) @ self.half)


@dataclass(frozen=True)
class Structure:
    """One to five blocks from the lowest to the highest, each on the one before it."""

    blocks: tuple[Block, ...]

    def __post_init__(self) -> None:
        if not 1 <= len(self.blocks) <= 5:
            raise ValueError(f"a structure must have 1 to 5 blocks, got {len(self.blocks)}")

    @property
    def centres(self) -> FloatArray:
        """The centres of the blocks, shape (n, 3), in metres."""
        rows, level = [], 0.0
        for block in self.blocks:
            rows.append((block.x, block.y, level + block.half_rise))
            level += 2.0 * block.half_rise
        return np.array(rows)

    @property
    def height(self) -> float:
        """From the table to the highest point, in metres."""
        return sum(2.0 * block.half_rise for block in self.blocks)
