"""The features of a structure, read off its geometry before it is let go.

Each feature is one measure against one threshold. The generator leaves a gap around every
threshold (`GAPS`), because a picture in which a person could not tell either is no use as an
annotated example.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from seewhy_lab.simulators.structure_stability.structure import Block, Structure

__all__ = ["GAPS", "THRESHOLDS", "Measures", "annotate", "displaced_blocks", "is_clear", "measure"]


@dataclass(frozen=True, kw_only=True)
class Measures:
    """What the annotation looks at.

    - `inclination`: the angle between the vertical and the axis of the structure, in degrees.
      The axis runs from the centre of the lowest block to the centre of the highest; for a single
      block it is the upright axis of the block.
    - `base_width`: the width of the lowest block, in metres.
    - `overhang`: how far the centre of mass of a block lies from the middle of the block below,
      in units of half the size of the latter, so that 1 is the edge. The largest over all blocks
      that lie on another; 0 for a single block, which has the whole table below it.
    """

    inclination: float
    base_width: float
    overhang: float


THRESHOLDS = Measures(inclination=10.0, base_width=0.047, overhang=1.0)
"""Lean, wide and displaced from these values on."""

GAPS: dict[str, tuple[float, float]] = {
    "inclination": (6.0, 13.5),
    "base_width": (0.039, 0.056),
    "overhang": (0.78, 1.22),
}
"""Between these two values of a measure no structure is generated."""


def _overhang(upper: Block, lower: Block) -> float:
    """Where the centre of `upper` lies on `lower`: 0 in its middle, 1 on its edge."""
    cos, sin = math.cos(lower.yaw), math.sin(lower.yaw)
    dx, dy = upper.x - lower.x, upper.y - lower.y
    along, across = cos * dx + sin * dy, -sin * dx + cos * dy
    return max(abs(along) / (lower.width / 2.0), abs(across) / (lower.depth / 2.0))


def _overhangs(structure: Structure) -> list[float]:
    """Those of all blocks but the lowest, upwards."""
    return [_overhang(upper, lower) for lower, upper in pairwise(structure.blocks)]


def measure(structure: Structure) -> Measures:
    """The measures of a structure."""
    blocks = structure.blocks
    if len(blocks) == 1:
        rise = float(np.clip(blocks[0].rotation[2, 2], -1.0, 1.0))
        inclination = math.acos(rise)
    else:
        centres = structure.centres
        dx, dy, dz = centres[-1] - centres[0]
        inclination = math.atan2(math.hypot(dx, dy), dz)
    overhangs = _overhangs(structure)
    return Measures(
        inclination=math.degrees(inclination),
        base_width=blocks[0].width,
        overhang=max(overhangs, default=0.0),
    )


def displaced_blocks(structure: Structure) -> tuple[int, ...]:
    """The numbers, 0 for the lowest, of the blocks that lie beyond the edge of the one below."""
    return tuple(
        number
        for number, overhang in enumerate(_overhangs(structure), start=1)
        if overhang >= THRESHOLDS.overhang
    )


def annotate(structure: Structure) -> dict[str, str]:
    """The four features of a structure, as the names and values of the domain."""
    found = measure(structure)
    return {
        "num_blocks": str(len(structure.blocks)),
        "lean": "yes" if found.inclination >= THRESHOLDS.inclination else "no",
        "base": "wide" if found.base_width >= THRESHOLDS.base_width else "narrow",
        "block_displaced": "yes" if found.overhang >= THRESHOLDS.overhang else "no",
    }


def is_clear(structure: Structure) -> bool:
    """Whether every measure lies outside the gap around its threshold."""
    found = measure(structure)
    return all(not low < getattr(found, name) < high for name, (low, high) in GAPS.items())
