"""Soft light: how much of a lamp with a real size, and of the sky, each point sees.

Every point asks a few of sixteen points of the lamp and of the sky; its neighbours ask the
others, and neighbours on the same face of a geom share what they found (interleaved sampling:
Keller and Heidrich, 2001).
"""

from __future__ import annotations

import math

import numpy as np

from seewhy_lab.rendering.rays import Hits, Scene
from seewhy_lab.rendering.vectors import Array, dot

__all__ = [
    "LIGHTS",
    "TILE",
    "ask_order",
    "disc_points",
    "nearest_alike",
    "share",
    "sky_points",
    "visible",
]

TILE = 4
"""Side of the square of pixels that shares its light samples."""
LIGHTS = TILE * TILE
"""Number of points of the lamp, and of the sky."""

_LIFT = 2e-4  # Light rays end this far in front of a surface, in metres, so as not to hit it.
_SKY_AWAY = 2.0  # Far enough that all points see a point of the sky in the same direction.
_EVENLY = (np.arange(LIGHTS) + 0.5) / LIGHTS
# Pixels next to each other ask lights that lie far apart.
_ORDER = np.array([0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5])
_AROUND = ((0, 0), (0, 1), (1, 0), (0, -1), (-1, 0), (1, 1), (1, -1), (-1, 1), (-1, -1))


def disc_points(centre: tuple[float, float, float], radius: float, turn: float) -> Array:
    """Points spread evenly over a round lamp that faces the origin, shape (16, 3).

    `turn` is the first angle.
    """
    lamp = np.array(centre)
    facing = lamp / np.linalg.norm(lamp)
    side = np.cross(facing, [0.0, 0.0, 1.0])
    side /= np.linalg.norm(side)
    other = np.cross(facing, side)
    angle = _spiral(turn)
    out = radius * np.sqrt(_EVENLY)[:, None]
    points: Array = lamp + out * (np.cos(angle)[:, None] * side + np.sin(angle)[:, None] * other)
    return points


def sky_points(turn: float) -> Array:
    """Points spread evenly over the sky down to just above the horizon, shape (16, 3)."""
    height = 0.06 + 0.9 * _EVENLY
    flat = np.sqrt(1.0 - height**2)
    angle = _spiral(turn)
    return _SKY_AWAY * np.stack([flat * np.cos(angle), flat * np.sin(angle), height], axis=1)


def _spiral(turn: float) -> Array:
    """Angles a golden angle apart, so that no direction is favoured."""
    return math.pi * (3.0 - math.sqrt(5.0)) * np.arange(LIGHTS) + turn


def ask_order(rows: Array, columns: Array) -> Array:
    """Which light the pixels in the given rows and columns ask first, 0 to 15."""
    return np.asarray(_ORDER[(rows % TILE) * TILE + columns % TILE])


def visible(scene: Scene, hits: Hits, lights: Array, turn: Array, *, asks: int = 1) -> list[Array]:
    """What each point sees of the lights that it asks.

    `lights` has shape (kinds, 16, 3): the points of each kind of light. Of every kind a point on
    geom 0, the ground, asks number `turn`, and where `asks` is 2, 4 or 8 that many evenly spread
    from there on; a point on another geom asks twice as many, because its face may fill only a
    part of a tile. For every kind the result holds the light that arrives and the light that would
    without anything in between, both weighted by the cosine at the surface and of shape (n,).
    """
    arrives = np.zeros((len(lights), len(hits.geom)), np.float32)
    possible = np.zeros_like(arrives)
    surface = hits.point + _LIFT * hits.normal
    level = dot(hits.normal, surface)
    on_any, on_thing = hits.geom >= 0, hits.geom > 0
    step = np.where(on_thing, LIGHTS // asks // 2, LIGHTS // asks)
    first = np.where(on_any, turn % step, -1)
    for number in range(LIGHTS):
        rows = np.flatnonzero(first == number % step)
        at, normal, height = surface.take(rows, 0), hits.normal.take(rows, 0), level[rows]
        for kind, places in enumerate(lights):
            place = places[number]
            cosine = (normal @ place - height) / np.linalg.norm(place)
            facing = np.flatnonzero(cosine > 0.0)
            if not len(facing):
                continue
            _, distance, _ = scene.cast(place, at.take(facing, 0) - place)
            # Distances are in units of the way from the light to the point: 1 is the point itself.
            free = (distance < 0.0) | (distance > 0.9999)
            asking, weight = rows[facing], cosine[facing]
            possible[kind][asking] += weight
            arrives[kind][asking] += weight * free
    return [result[kind] for kind in range(len(lights)) for result in (arrives, possible)]


def share(values: list[Array], label: Array, shape: tuple[int, int]) -> list[Array]:
    """Sums images over a tile around each pixel, over pixels with the same label only."""
    padded = np.pad(label.reshape(shape), 2, constant_values=-2)
    sources = [np.pad(value.reshape(shape), 2) for value in values]
    labels = label.reshape(shape)
    sums = [np.zeros(shape, np.float32) for _ in values]
    for row in range(TILE):
        for column in range(TILE):
            window = (slice(row, row + shape[0]), slice(column, column + shape[1]))
            same = padded[window] == labels
            for total, source in zip(sums, sources, strict=True):
                total += source[window] * same
    return [total.ravel() for total in sums]


def nearest_alike(label: Array, fine: Array, pixel: Array, shape: tuple[int, int]) -> Array:
    """For each ray on an edge the pixel nearby that shows the same face; -1 where none does."""
    padded = np.pad(label.reshape(shape), 1, constant_values=-2)
    row, column = np.divmod(pixel, shape[1])
    found = np.full(len(fine), -1)
    for down, across in _AROUND:
        same = (found < 0) & (padded[row + 1 + down, column + 1 + across] == fine)
        found[same] = pixel[same] + down * shape[1] + across
    return found
