"""Solids, and things that are put together from them.

Every thing has its own frame: the origin on the ground below its middle, ``x`` to its left as it
looks at the camera (the right of the picture), ``y`` to its back, ``z`` up. Lengths are in metres,
angles in radians, colours red, green and blue in sRGB, each from 0 to 1.
"""

from __future__ import annotations

import colorsys
import math
from dataclasses import dataclass, replace

import numpy as np

__all__ = [
    "Colour",
    "Point",
    "Solid",
    "Thing",
    "ball",
    "box",
    "cylinder",
    "rod",
    "shade_of",
]

Point = tuple[float, float, float]
Colour = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]


@dataclass(frozen=True, kw_only=True)
class Solid:
    """One geom of MuJoCo.

    `kind` is MuJoCo's name of its form and `size` half its extents as MuJoCo takes them. `glow` is
    the light that it gives off itself, in proportion to its colour; `gloss` the strength of its
    highlights.
    """

    kind: str
    size: Point
    at: Point
    colour: Colour
    quat: Quaternion = (1.0, 0.0, 0.0, 0.0)
    glow: float = 0.0
    gloss: float = 0.0

    def moved(self, x: float, y: float, z: float, yaw: float) -> Solid:
        """The solid turned by `yaw` about the upright through the origin, then displaced."""
        cos, sin = math.cos(yaw), math.sin(yaw)
        here_x, here_y, here_z = self.at
        return replace(
            self,
            at=(x + cos * here_x - sin * here_y, y + sin * here_x + cos * here_y, z + here_z),
            quat=_product((math.cos(yaw / 2.0), 0.0, 0.0, math.sin(yaw / 2.0)), self.quat),
        )


@dataclass(frozen=True, kw_only=True)
class Thing:
    """An object, a person or a fixture, put together from solids.

    `half` is half the width and half the depth of the ground that it takes up. `top` is the height
    on which smaller things can be put; None where they cannot.
    """

    name: str
    solids: tuple[Solid, ...]
    half: tuple[float, float]
    top: float | None = None

    @property
    def height(self) -> float:
        """From the ground to the middle of the highest solid."""
        return max(solid.at[2] for solid in self.solids)


def _product(one: Quaternion, other: Quaternion) -> Quaternion:
    a, b, c, d = one
    e, f, g, h = other
    return (
        a * e - b * f - c * g - d * h,
        a * f + b * e + c * h - d * g,
        a * g - b * h + c * e + d * f,
        a * h + b * g - c * f + d * e,
    )


def box(
    size: Point,
    at: Point,
    colour: Colour,
    *,
    pitch: float = 0.0,
    yaw: float = 0.0,
    glow: float = 0.0,
    gloss: float = 0.0,
) -> Solid:
    """A cuboid of the given width, depth and height with its middle at `at`.

    A positive `pitch` lets its top lean back; `yaw` turns it about the upright after that.

    Examples
    --------
    >>> box((0.2, 0.4, 0.6), (0, 0, 0.3), (1, 0, 0)).size
    (0.1, 0.2, 0.3)
    """
    turn = _product(
        (math.cos(yaw / 2.0), 0.0, 0.0, math.sin(yaw / 2.0)),
        (math.cos(pitch / 2.0), -math.sin(pitch / 2.0), 0.0, 0.0),
    )
    width, depth, height = size
    return Solid(
        kind="box",
        size=(width / 2.0, depth / 2.0, height / 2.0),
        at=at,
        colour=colour,
        quat=turn,
        glow=glow,
        gloss=gloss,
    )


def ball(size: Point, at: Point, colour: Colour) -> Solid:
    """An ellipsoid of the given width, depth and height with its middle at `at`."""
    width, depth, height = size
    return Solid(
        kind="ellipsoid",
        size=(width / 2.0, depth / 2.0, height / 2.0),
        at=at,
        colour=colour,
    )


def cylinder(
    radius: float, height: float, at: Point, colour: Colour, *, gloss: float = 0.0
) -> Solid:
    """An upright cylinder whose lower end has its middle at `at`."""
    x, y, z = at
    return Solid(
        kind="cylinder",
        size=(radius, height / 2.0, 0.0),
        at=(x, y, z + height / 2.0),
        colour=colour,
        gloss=gloss,
    )


def rod(
    radius: float,
    begin: Point,
    end: Point,
    colour: Colour,
    *,
    flat: float | None = None,
    gloss: float = 0.0,
) -> Solid:
    """A rod with round ends from `begin` to `end`; with `flat`, a spindle of that thickness.

    Examples
    --------
    >>> rod(0.1, (0, 0, 0), (0, 0, 1), (0, 0, 0)).at
    (0.0, 0.0, 0.5)
    """
    start, stop = np.array(begin, float), np.array(end, float)
    way = stop - start
    length = float(np.linalg.norm(way))
    # The vector half-way between the upright and the way gives the turn from one to the other.
    halfway = way / length + (0.0, 0.0, 1.0)
    reach = float(np.linalg.norm(halfway))
    if reach < 1e-6:
        quat: Quaternion = (0.0, 1.0, 0.0, 0.0)
    else:
        x, y, z = (float(value) for value in halfway / reach)
        quat = (z, -y, x, 0.0)
    middle = (start + stop) / 2.0
    return Solid(
        kind="capsule" if flat is None else "ellipsoid",
        size=(radius, length / 2.0, 0.0) if flat is None else (radius, flat / 2.0, length / 2.0),
        at=(float(middle[0]), float(middle[1]), float(middle[2])),
        colour=colour,
        quat=quat,
        gloss=gloss,
    )


def shade_of(
    rng: np.random.Generator,
    *,
    hue: tuple[float, float],
    saturation: tuple[float, float],
    value: tuple[float, float],
) -> Colour:
    """A random colour; `hue` in degrees, `saturation` and `value` from 0 to 1, each (low, high).

    Examples
    --------
    >>> shade_of(np.random.default_rng(0), hue=(0, 0), saturation=(1, 1), value=(1, 1))
    (1.0, 0.0, 0.0)
    """
    red, green, blue = colorsys.hsv_to_rgb(
        (rng.uniform(*hue) / 360.0) % 1.0, rng.uniform(*saturation), rng.uniform(*value)
    )
    return float(red), float(green), float(blue)
