"""Pictures of things on a table, drawn plainly: where each thing is, is known."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PIL import Image, ImageDraw

__all__ = ["DrawnBody", "drawn_table", "some_bodies"]

WIDTH, HEIGHT = 960, 640
_TABLE, _WALL = (196, 170, 138), (222, 226, 230)
_COLOURS = {"red": (186, 44, 40), "blue": (44, 88, 176), "green": (52, 138, 74)}
_SIDES = {"small": 90, "large": 150}
_LIGHTER = 1.25


@dataclass(frozen=True)
class DrawnBody:
    """One thing: what it is, and its box in pixels (left, top, right, bottom)."""

    size: str
    colour: str
    material: str
    shape: str
    box: tuple[int, int, int, int]


def some_bodies(count: int, *, seed: int) -> list[DrawnBody]:
    """Return things beside each other, each of which says by chance what it is.

    Examples
    --------
    >>> bodies = some_bodies(3, seed=0)
    >>> len(bodies), all(body.box[2] <= WIDTH for body in bodies)
    (3, True)
    """
    random = np.random.default_rng(seed)
    found = []
    for place in range(count):
        size = str(random.choice(list(_SIDES)))
        side = _SIDES[size]
        left = int((place + 0.5) * WIDTH / count - side / 2 + random.integers(-20, 21))
        bottom = int(random.integers(420, 600))
        found.append(
            DrawnBody(
                size=size,
                colour=str(random.choice(list(_COLOURS))),
                material=str(random.choice(["rubber", "metal"])),
                shape=str(random.choice(["cube", "sphere", "cylinder"])),
                box=(left, bottom - side, left + side, bottom),
            )
        )
    return found


def drawn_table(bodies: Sequence[DrawnBody]) -> Image.Image:
    """Draw the things on a table before a wall, those that are nearer in front.

    Examples
    --------
    >>> drawn_table(some_bodies(2, seed=1)).size
    (960, 640)
    """
    image = Image.new("RGB", (WIDTH, HEIGHT), _WALL)
    draw = ImageDraw.Draw(image)
    draw.rectangle((0, HEIGHT * 0.45, WIDTH, HEIGHT), fill=_TABLE)
    for body in sorted(bodies, key=lambda one: one.box[3]):
        _draw(draw, body)
    return image


def _draw(draw: ImageDraw.ImageDraw, body: DrawnBody) -> None:
    left, top, right, bottom = body.box
    dark = _COLOURS[body.colour]
    light = tuple(min(255, int(part * _LIGHTER) + 20) for part in dark)
    rim = (right - left) // 5
    if body.shape == "sphere":
        draw.ellipse(body.box, fill=dark)
    elif body.shape == "cube":
        draw.rectangle((left, top + rim, right - rim, bottom), fill=dark)
        ahead = [(left, top + rim), (left + rim, top), (right, top), (right - rim, top + rim)]
        draw.polygon(ahead, fill=light)
        side = [
            (right - rim, top + rim),
            (right, top),
            (right, bottom - rim),
            (right - rim, bottom),
        ]
        draw.polygon(side, fill=tuple(int(part * 0.7) for part in dark))
    else:
        draw.ellipse((left, bottom - rim, right, bottom), fill=dark)
        draw.rectangle((left, top + rim // 2, right, bottom - rim // 2), fill=dark)
        draw.ellipse((left, top, right, top + rim), fill=light)
    if body.material == "metal":
        shine = (left + 2 * rim, top + 2 * rim, left + 2 * rim + rim, top + 2 * rim + rim // 2)
        draw.ellipse(shine, fill=(250, 250, 250))
