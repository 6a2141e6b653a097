"""What paint, wood and varnish make of the light: the colour of every point that is seen."""

from __future__ import annotations

import math

import numpy as np

from seewhy_lab.rendering.edges import rounded
from seewhy_lab.rendering.rays import Hits, Scene
from seewhy_lab.rendering.texture import waves
from seewhy_lab.rendering.vectors import Array, along, column, unit
from seewhy_lab.simulators.structure_stability.structure import Structure
from seewhy_lab.simulators.structure_stability.view import View

__all__ = ["background", "shade"]

_BEVEL = 0.0022  # Radius of the rounded edges of the blocks, in metres.
_SKY_COLOUR = np.array([[0.95], [1.0], [1.07]], np.float32)


def _albedo(hits: Hits, structure: Structure, view: View) -> Array:
    """The colour of the surface at each point, linear, shape (3, n)."""
    rng = np.random.default_rng(view.texture)
    colour = np.zeros((3, len(hits.geom)), np.float32)
    for number, block in enumerate(structure.blocks, start=1):
        block_rng = np.random.default_rng([view.texture, number])
        rows = np.flatnonzero(hits.geom == number)
        at = hits.local.take(rows, 0).T
        # Under the paint the grain of the wood runs along the width of the block.
        bent = 0.002 * waves(at, block_rng, wavelength=0.05)
        grain_at = np.stack([0.06 * at[0], at[1] + bent, at[2] + bent])
        grain = waves(grain_at, block_rng, wavelength=0.0045, count=5)
        cloud = waves(at, block_rng, wavelength=0.03)
        paint = column(block.colour) ** 2.2
        colour[:, rows] = paint * (1.0 + 0.10 * grain + 0.10 * cloud) + 0.006
    rows = np.flatnonzero(hits.geom == 0)
    at = hits.local.take(rows, 0).T
    grain_at = np.stack([0.05 * at[0], at[1] + 0.004 * np.sin(9.0 * at[0]), at[2]])
    shade = 1.0 + 0.16 * waves(grain_at, rng, wavelength=0.011, count=6)
    shade += 0.10 * waves(at, rng, wavelength=0.09)
    if view.planks:
        across = at[1] / view.planks + rng.uniform()
        board = np.floor(across)
        shade *= 1.0 + 0.13 * np.sin(board * 12.9898 + view.texture % 7)
        seam = np.abs(across - board - 0.5) * 2.0
        shade *= 1.0 - 0.35 * np.clip((seam - 1.0) * view.planks / 0.005 + 1.0, 0.0, 1.0)
    colour[:, rows] = column(view.table) * shade
    return np.asarray(np.clip(colour, 0.004, 0.95))


def shade(
    hits: Hits,
    scene: Scene,
    structure: Structure,
    view: View,
    *,
    eye: Array,
    lit: Array,
    open_sky: Array,
) -> Array:
    """The light that leaves each point towards `eye`, linear, shape (n, 3).

    `lit` and `open_sky` say which part of the lamp and of the sky a point sees, shape (n,).
    """
    normal = rounded(hits, scene, radius=_BEVEL)
    point = np.ascontiguousarray(hits.point.T, dtype=np.float32)
    lamp = column(view.lamp)
    lamp_colour, table = column(view.lamp_colour), column(view.table)
    is_block = hits.geom > 0
    lit, open_sky = lit.astype(np.float32), open_sky.astype(np.float32)
    towards = lamp - point
    weaker = (lamp * lamp).sum() / along(towards, towards)
    towards = unit(towards)
    direct = np.maximum(along(normal, towards), 0.0) * lit * weaker
    sky = view.sky * open_sky * (0.62 + 0.38 * normal[2])
    # What the lit table throws back at the sides of the blocks that stand on it.
    near = np.exp(np.minimum(-point[2], 0.0) / 0.06) * (1.0 - np.abs(normal[2])) * is_block
    light = direct * lamp_colour + sky * _SKY_COLOUR + 0.3 * near * table
    # A thin coat of varnish: a soft highlight of the lamp, and the room at a grazing angle.
    back = unit(column(eye) - point)
    shine = np.maximum(along(normal, unit(back + towards)), 0.0) ** 34 * lit * is_block
    grazing = (1.0 - np.maximum(along(normal, back), 0.0)) ** 2
    mirror = np.where(is_block, np.float32(0.05), np.float32(0.10)) * grazing * grazing * open_sky
    varnish = 0.11 * shine * lamp_colour + mirror * column(view.wall)
    return np.asarray((_albedo(hits, structure, view) * light + varnish).T)


def background(rays: Array, across: Array, view: View) -> Array:
    """A wall out of focus above the table and the dark below it, linear, shape (n, 3).

    `rays` are the directions of sight; `across` is the place in the frame, shape (n, 2), from -1
    to 1 towards the right and downwards.
    """
    up = rays[:, 2] / np.linalg.norm(rays, axis=1)
    horizon = -math.sin(view.elevation)
    wall = np.array(view.wall)
    glow_x, glow_y = view.glow
    bright = np.exp(-((across[:, 0] - glow_x) ** 2 + (across[:, 1] + glow_y) ** 2) / 0.9)
    colour = wall * (0.55 + 0.55 * bright)[:, None] * (1.0 + 0.5 * up)[:, None]
    below = np.clip((horizon - up) / 0.10, 0.0, 1.0)[:, None]
    return np.asarray(colour * (1.0 - below) + np.array(view.floor) * below)
