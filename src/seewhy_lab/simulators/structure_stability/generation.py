"""Random structures, such that every feature varies and none is a matter of opinion."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from seewhy_lab.simulators.structure_stability.annotation import annotate, is_clear
from seewhy_lab.simulators.structure_stability.structure import Block, FloatArray, Structure

__all__ = ["PALETTE", "random_structure"]

PALETTE: tuple[tuple[float, float, float], ...] = (
    (0.76, 0.13, 0.11),
    (0.13, 0.30, 0.66),
    (0.93, 0.74, 0.13),
    (0.17, 0.52, 0.23),
    (0.90, 0.45, 0.12),
    (0.44, 0.22, 0.56),
    (0.88, 0.85, 0.78),
    (0.12, 0.57, 0.60),
    (0.86, 0.45, 0.55),
)
"""Paints of toy blocks, in sRGB."""

SHARE_DISPLACED = 0.35
"""Of the structures with two blocks or more."""
SHARE_LEANING = 0.38
"""Of the structures without a displaced block."""
SHARE_DISPLACED_UPRIGHT = 0.5
"""Of the structures of three blocks or more with a displaced block: those that do not lean."""

SHARE_PUSHED_OUT = 0.25
"""Of those again: a block in the middle is displaced alone."""

_UNLIKE = 0.42  # Distance in sRGB from which two paints are told apart at a glance.


def _colours(rng: np.random.Generator, count: int) -> list[tuple[float, float, float]]:
    """Paints for `count` blocks: neighbours are clearly different."""
    while True:
        picked = [PALETTE[i] for i in rng.permutation(len(PALETTE))[:count]]
        if all(math.dist(one, other) >= _UNLIKE for one, other in pairwise(picked)):
            jitter = rng.uniform(-0.03, 0.03, (count, 3))
            return [
                (float(r), float(g), float(b))
                for r, g, b in np.clip(np.array(picked) + jitter, 0.02, 0.98)
            ]


def _offsets(
    rng: np.random.Generator,
    widths: FloatArray,
    heights: FloatArray,
    *,
    lean: bool,
    displaced: bool,
) -> FloatArray:
    """Where the centres of the blocks lie from left to right, shape (n,), in metres."""
    count = len(widths)
    half = widths / 2.0
    levels = np.concatenate([[0.0], np.cumsum(heights)])[:-1] + heights / 2.0
    rise = levels - levels[0]
    side = rng.choice([-1.0, 1.0])
    if lean and not displaced:
        # Uneven steps to one side that add up to the angle of the whole.
        steps = np.diff(rise) * rng.uniform(0.8, 1.2, count - 1)
        leaning: FloatArray = np.concatenate([[0.0], np.cumsum(steps)])
        leaning *= side * rise[-1] * math.tan(math.radians(rng.uniform(13.5, 18.0))) / leaning[-1]
        return leaning
    x: FloatArray = rise * math.tan(math.radians(rng.uniform(-5.0, 5.0))) + rng.uniform(
        -0.003, 0.003, count
    )
    if not displaced:
        return x
    beyond = side * rng.uniform(1.24, 1.5)
    if lean:
        # One block is set beyond the edge of the one below, and those above it follow.
        at = int(rng.integers(1, count))
        x[at:] += beyond * half[at - 1]
    elif rng.random() < SHARE_PUSHED_OUT:
        # One block is pushed out from between the others; what is on top may hold it down.
        at = int(rng.integers(1, count - 1))
        x[at] += beyond * half[at - 1]
    else:
        # The structure steps to one side, and its highest block lies over the base again.
        x[:-1] += beyond * half[-2] * np.linspace(0.0, 1.0, count - 1)
    return x


def random_structure(rng: np.random.Generator) -> Structure:
    """Draws a structure whose every measure lies outside the gaps of the annotation.

    The number of blocks is uniform over 1 to 5 and the base wide or narrow with equal chance.
    The other two features are decided next and the sizes and positions drawn until they agree
    with them, so that the shares do not depend on how often a draw has to be repeated.
    """
    count = int(rng.integers(1, 6))
    wide = bool(rng.random() < 0.5)
    displaced = count > 1 and bool(rng.random() < SHARE_DISPLACED)
    if not displaced:
        lean = bool(rng.random() < SHARE_LEANING)
    else:
        lean = count == 2 or bool(rng.random() >= SHARE_DISPLACED_UPRIGHT)
    wanted = {"lean": "yes" if lean else "no", "block_displaced": "yes" if displaced else "no"}
    colours = _colours(rng, count)
    while True:
        base = rng.uniform(0.056, 0.070) if wide else rng.uniform(0.032, 0.039)
        above = rng.uniform(0.048, 0.070, count) if wide else rng.uniform(0.032, 0.043, count)
        widths = np.concatenate([[base], above[1:]])
        heights = rng.uniform(0.033, 0.043, count)
        depths = rng.uniform(0.043, 0.050, count)
        yaws = np.radians(rng.uniform(-6.0, 6.0, count))
        y = rng.uniform(-0.002, 0.002, count)
        tilt = 0.0
        if count == 1:
            x = np.zeros(1)
            if lean:
                tilt = math.radians(rng.choice([-1.0, 1.0]) * rng.uniform(14.0, 22.0))
        else:
            x = _offsets(rng, widths, heights, lean=lean, displaced=displaced)
        structure = Structure(
            tuple(
                Block(
                    width=float(widths[i]),
                    depth=float(depths[i]),
                    height=float(heights[i]),
                    x=float(x[i]),
                    y=float(y[i]),
                    yaw=float(yaws[i]),
                    tilt=tilt,
                    colour=colours[i],
                )
                for i in range(count)
            )
        )
        found = annotate(structure)
        if is_clear(structure) and all(found[name] == value for name, value in wanted.items()):
            return structure
