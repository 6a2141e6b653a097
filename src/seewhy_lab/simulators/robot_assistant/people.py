"""The people: each has hair, clothes and a build of their own, and varies a little every day."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seewhy_lab.simulators.robot_assistant.solid import (
    Colour,
    Solid,
    Thing,
    ball,
    box,
    cylinder,
    rod,
    shade_of,
)

__all__ = ["PEOPLE", "person"]

Range = tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class _Look:
    """What one person always has; colours as ranges of hue, saturation and value."""

    height: Range
    girth: Range
    skin: tuple[Range, Range, Range]
    hair: tuple[Range, Range, Range]
    top: tuple[Range, Range, Range]
    bottom: tuple[Range, Range, Range]
    cut: str
    skirt: bool = False


_LOOKS = {
    "bob": _Look(
        height=(1.60, 1.70),
        girth=(1.40, 1.55),
        skin=((20, 24), (0.40, 0.46), (0.80, 0.88)),
        hair=((20, 26), (0.55, 0.65), (0.20, 0.28)),
        top=((20, 27), (0.90, 1.0), (0.88, 1.0)),
        bottom=((30, 40), (0.10, 0.25), (0.18, 0.28)),
        cut="beard",
    ),
    "john": _Look(
        height=(1.82, 1.92),
        girth=(0.94, 1.04),
        skin=((20, 24), (0.42, 0.52), (0.62, 0.74)),
        hair=((0, 30), (0.10, 0.30), (0.05, 0.10)),
        top=((226, 234), (0.80, 0.92), (0.52, 0.72)),
        bottom=((220, 230), (0.30, 0.45), (0.14, 0.22)),
        cut="short",
    ),
    "sarah": _Look(
        height=(1.66, 1.76),
        girth=(0.84, 0.94),
        skin=((22, 27), (0.28, 0.36), (0.90, 0.97)),
        hair=((43, 48), (0.55, 0.68), (0.88, 0.98)),
        top=((48, 55), (0.85, 0.98), (0.90, 1.0)),
        bottom=((48, 55), (0.85, 0.98), (0.86, 0.98)),
        cut="long",
        skirt=True,
    ),
    "sally": _Look(
        height=(1.56, 1.66),
        girth=(0.92, 1.04),
        skin=((20, 25), (0.30, 0.38), (0.88, 0.96)),
        hair=((10, 16), (0.75, 0.85), (0.45, 0.58)),
        top=((318, 332), (0.70, 0.88), (0.85, 0.98)),
        bottom=((0, 360), (0.0, 0.06), (0.84, 0.95)),
        cut="bun",
    ),
}

PEOPLE = tuple(_LOOKS)
"""The people who can be in a room."""


def _hair(cut: str, hair: Colour, head: float, width: float) -> list[Solid]:
    """The hair around a head with its middle at height `head`."""
    if cut == "beard":
        return [
            ball((0.86 * width, 0.16, 0.15), (0.0, -0.035, head - 0.085), hair),
            ball((1.06 * width, 0.2, 0.1), (0.0, 0.03, head + 0.0), hair),
        ]
    crown = ball((1.12 * width, 0.24, 0.17), (0.0, 0.022, head + 0.075), hair)
    if cut == "short":
        return [crown, box((width, 0.08, 0.12), (0.0, 0.085, head + 0.02), hair)]
    if cut == "long":
        locks = [
            rod(
                0.05,
                (side * 0.5 * width, 0.02, head + 0.06),
                (side * 0.62 * width, -0.02, head - 0.34),
                hair,
            )
            for side in (-1.0, 1.0)
        ]
        return [crown, *locks, ball((1.5 * width, 0.14, 0.6), (0.0, 0.1, head - 0.16), hair)]
    return [
        crown,
        ball((0.15, 0.15, 0.15), (0.0, 0.06, head + 0.19), hair),
        ball((1.22 * width, 0.2, 0.24), (0.0, 0.05, head - 0.0), hair),
    ]


def person(name: str, rng: np.random.Generator) -> Thing:
    """One of the people, standing.

    Examples
    --------
    >>> person("bob", np.random.default_rng(0)).name
    'bob'
    """
    look = _LOOKS[name]

    def colour(ranges: tuple[Range, Range, Range]) -> Colour:
        return shade_of(rng, hue=ranges[0], saturation=ranges[1], value=ranges[2])

    skin, hair = colour(look.skin), colour(look.hair)
    top, bottom = colour(look.top), colour(look.bottom)
    tall = rng.uniform(*look.height)
    girth = rng.uniform(*look.girth)
    wide = 0.40 * (0.6 + 0.4 * girth)  # Across the shoulders.
    hip, shoulder, head = 0.50 * tall, 0.81 * tall, 0.925 * tall
    face = 0.165 + 0.012 * girth
    waist = 0.30 * girth
    shoe: Colour = (0.10, 0.09, 0.09)
    solids = [
        ball((face, 0.20, 0.145 * tall), (0.0, 0.0, head), skin),
        cylinder(0.055, 0.08, (0.0, 0.01, shoulder), skin),
        rod(
            0.075,
            (-wide / 2 + 0.08, 0, shoulder - 0.06),
            (wide / 2 - 0.08, 0, shoulder - 0.06),
            top,
        ),
        ball((wide * 0.98, 0.25 * girth, 0.50), (0.0, 0.0, (hip + shoulder) / 2 + 0.03), top),
        ball((waist * 1.06, 0.27 * girth, 0.40), (0.0, -0.02 * girth, hip + 0.14), top),
        ball((0.024, 0.05, 0.03), (0.0, -0.105, head - 0.01), skin),
    ]
    for side in (-1.0, 1.0):
        eye = (side * 0.042, -0.094, head + 0.02)
        solids.append(ball((0.026, 0.016, 0.018), eye, (0.06, 0.05, 0.05)))
    solids += _hair(look.cut, hair, head, face)

    stance = rng.uniform(0.08, 0.12) * (0.7 + 0.3 * girth)
    if look.skirt:
        solids.append(ball((0.46, 0.40, 0.44 * tall), (0.0, 0.0, 0.43 * tall), bottom))
    for side in (-1.0, 1.0):
        foot, x = 0.09, side * stance
        leg = skin if look.skirt else bottom
        thick = 0.055 if look.skirt else 0.075 * (0.6 + 0.4 * girth)
        solids.append(rod(thick, (x, 0.0, hip - 0.02), (x * 1.15, 0.0, foot), leg))
        solids.append(ball((0.1, 0.26, 0.11), (x * 1.15, -0.05, 0.045), shoe))
        # Arms hang, are held forward, or rest on the hips.
        upper = (side * (wide / 2.0 - 0.01), 0.0, shoulder - 0.07)
        out = rng.uniform(0.06, 0.16) * (0.5 + 0.5 * girth)
        elbow = (side * (wide / 2.0 + out), rng.uniform(-0.08, 0.05), shoulder - 0.17 * tall)
        swing = rng.uniform(-0.5, 0.5)
        hand = (
            elbow[0] + side * 0.14 * tall * min(0.0, math.sin(swing)),
            elbow[1] - rng.uniform(0.0, 0.12),
            elbow[2] - 0.14 * tall * math.cos(swing),
        )
        solids.append(rod(0.052, upper, elbow, top))
        solids.append(rod(0.043, elbow, hand, top))
        solids.append(ball((0.085, 0.085, 0.1), (hand[0], hand[1], hand[2] - 0.04), skin))
    return Thing(name=name, solids=tuple(solids), half=(0.27, 0.22))
