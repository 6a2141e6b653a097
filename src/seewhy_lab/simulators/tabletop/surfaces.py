"""What wood, rubber and metal make of the light: the colour of every point that is seen."""

from __future__ import annotations

import numpy as np

from seewhy_lab.rendering.edges import rounded
from seewhy_lab.rendering.rays import Hits, Scene
from seewhy_lab.rendering.texture import waves
from seewhy_lab.rendering.vectors import Array, along, column, unit
from seewhy_lab.simulators.tabletop.table import Table
from seewhy_lab.simulators.tabletop.view import View

__all__ = ["shade"]

_EDGE = 0.0022  # Radius of the rounded edges of things, in metres.
_SKY_COLOUR = np.array([[0.95], [1.0], [1.07]], np.float32)
_PAINT = {
    "gray": (0.40, 0.40, 0.40),
    "red": (0.72, 0.11, 0.12),
    "blue": (0.16, 0.29, 0.80),
    "green": (0.13, 0.46, 0.12),
    "brown": (0.42, 0.27, 0.15),
    "purple": (0.50, 0.16, 0.70),
    "cyan": (0.16, 0.75, 0.75),
    "yellow": (0.92, 0.83, 0.18),
}
"""Colour → red, green and blue in sRGB."""


def shade(
    hits: Hits,
    scene: Scene,
    table: Table,
    view: View,
    *,
    eye: Array,
    lit: Array,
    open_sky: Array,
) -> Array:
    """The light that leaves each point towards `eye`, linear, shape (n, 3).

    `lit` and `open_sky` say which part of the lamp and of the sky a point sees, shape (n,).
    """
    colour = np.empty((3, len(hits.geom)), np.float32)
    for is_thing in (False, True):  # Few points are on things, and these take more to work out.
        rows = np.flatnonzero((hits.geom > 0) == is_thing)
        here = hits.take(rows)
        seen = _Seen(
            normal=rounded(here, scene, radius=_EDGE),
            point=np.ascontiguousarray(here.point.T, dtype=np.float32),
            lit=lit[rows].astype(np.float32),
            open_sky=open_sky[rows].astype(np.float32),
            eye=eye,
        )
        colour[:, rows] = _of_things(here, seen, table, view) if is_thing else _of_wood(seen, view)
    return colour.T


class _Seen:
    """Points with what a surface makes its light of; all in columns."""

    def __init__(
        self, *, normal: Array, point: Array, lit: Array, open_sky: Array, eye: Array
    ) -> None:
        self.normal, self.point, self.lit, self.open_sky = normal, point, lit, open_sky
        self.back: Array = unit(column(eye) - point)
        self.grazing: Array = (1.0 - np.maximum(along(normal, self.back), 0.0)) ** 4

    def halfway(self, view: View) -> Array:
        """How near the lamp is to being mirrored into the eye, from 0 to 1."""
        towards = unit(column(view.lamp) - self.point)
        return np.maximum(along(self.normal, unit(self.back + towards)), 0.0)

    def light(self, view: View) -> Array:
        """What arrives from lamp and sky, shape (3, n)."""
        lamp = column(view.lamp)
        towards = lamp - self.point
        weaker = (lamp * lamp).sum() / along(towards, towards)
        direct = np.maximum(along(self.normal, unit(towards)), 0.0) * self.lit * weaker
        sky = view.sky * self.open_sky * (0.62 + 0.38 * self.normal[2])
        return np.asarray(direct * column(view.lamp_colour) + sky * _SKY_COLOUR)


def _of_wood(seen: _Seen, view: View) -> Array:
    shine = 0.10 * seen.grazing * seen.open_sky * column(view.room)
    return np.asarray(np.clip(_wood(seen.point, view), 0.004, 0.95) * seen.light(view) + shine)


def _of_things(hits: Hits, seen: _Seen, table: Table, view: View) -> Array:
    is_metal = [False, *(thing.material == "metal" for thing in table.things)]
    metal = np.array(is_metal, np.float32)[hits.geom]
    albedo = _paint(hits, table, view)
    # What the lit table throws back at the sides of the things that stand on it.
    near = np.exp(np.minimum(-seen.point[2], 0.0) / 0.06) * (1.0 - np.abs(seen.normal[2]))
    light = seen.light(view) + 0.3 * near * column(view.table)
    matte = albedo * light * (1.0 - 0.75 * metal)

    halfway, lamp_colour = seen.halfway(view), column(view.lamp_colour)
    dull = 0.04 * halfway**10 * seen.lit * (1.0 - metal) * lamp_colour
    mirrored = 2.0 * along(seen.normal, seen.back) * seen.normal - seen.back
    room = _mirrored(seen.point, mirrored, view) * (0.35 + 0.65 * seen.open_sky)
    tint = 0.20 + 0.80 * albedo / albedo.max(axis=0)
    bright = metal * seen.lit * (2.2 * halfway**260 + 0.5 * halfway**40)
    shine = metal * (0.55 + 0.40 * seen.grazing) * tint * room
    return np.asarray(matte + dull + shine + bright * lamp_colour * (0.4 + 0.6 * tint))


def _mirrored(point: Array, ray: Array, view: View) -> Array:
    """What comes from the table and the room along rays that a thing mirrors, shape (3, n)."""
    down = ray[2] < -0.02
    away = np.where(down, point[2] / np.maximum(-ray[2], 0.02), 0.0)
    # The table darkens where it is near: what stands on it takes the light away.
    table = column(view.table) * (0.85 - 0.5 * np.exp(-away / 0.02))
    up = np.clip(ray[2], 0.0, 1.0)
    room = column(view.room) * (0.45 + 0.75 * up)
    lamp = unit(column(view.lamp))
    room = room + 1.1 * np.maximum(along(ray, lamp), 0.0) ** 24 * column(view.lamp_colour)
    return np.asarray(np.where(down, table, room))


def _paint(hits: Hits, table: Table, view: View) -> Array:
    """The colour of the things at each point, linear, shape (3, n)."""
    colour = np.zeros((3, len(hits.geom)), np.float32)
    for number, thing in enumerate(table.things, start=1):
        rng = np.random.default_rng([view.texture, number])
        rows = np.flatnonzero(hits.geom == number)
        paint = column(_PAINT[thing.colour]) ** 2.2 * rng.uniform(0.88, 1.12)
        cloud = waves(hits.local.take(rows, 0).T, rng, wavelength=0.03, count=3)
        colour[:, rows] = paint * (1.0 + 0.05 * cloud) + 0.006
    return np.asarray(np.clip(colour, 0.004, 0.95))


def _wood(at: Array, view: View) -> Array:
    rng = np.random.default_rng(view.texture)
    grain_at = np.stack([0.05 * at[0], at[1] + 0.004 * np.sin(9.0 * at[0]), at[2]])
    shade = 1.0 + 0.05 * waves(at, rng, wavelength=0.09)
    if view.grain:
        shade += 0.15 * view.grain * waves(grain_at, rng, wavelength=0.011, count=5)
    if view.planks:
        across = at[1] / view.planks + rng.uniform()
        board = np.floor(across)
        shade *= 1.0 + 0.08 * np.sin(board * 12.9898 + view.texture % 7)
        seam = np.abs(across - board - 0.5) * 2.0
        shade *= 1.0 - 0.3 * np.clip((seam - 1.0) * view.planks / 0.004 + 1.0, 0.0, 1.0)
    return np.asarray(column(view.table) * shade)
