"""The objects of a room, each built anew with its own proportions and colours.

What tells one object from another is its form and a range of colours that no other object has.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise

import numpy as np

from seewhy_lab.simulators.robot_assistant.solid import (
    Colour,
    Point,
    Solid,
    Thing,
    ball,
    box,
    cylinder,
    rod,
    shade_of,
)

__all__ = ["BUILDERS", "ON_TOP", "sideboard"]

_BLACK: Colour = (0.07, 0.07, 0.08)
_STEEL: Colour = (0.58, 0.59, 0.61)
_PAPER: Colour = (0.93, 0.91, 0.85)
_WHITE: Colour = (0.94, 0.94, 0.94)


def _desk(rng: np.random.Generator) -> Thing:
    width, depth = rng.uniform(1.30, 1.60), rng.uniform(0.62, 0.75)
    height, thick = rng.uniform(0.68, 0.76), rng.uniform(0.045, 0.07)
    wood = shade_of(rng, hue=(15, 21), saturation=(0.62, 0.76), value=(0.40, 0.54))
    darker: Colour = tuple(0.72 * c for c in wood)  # type: ignore[assignment]
    left, right, below = -width / 2.0 + 0.04, width / 2.0 - 0.04, height - thick
    solids = [
        box((width, depth, thick), (0.0, 0.0, height - thick / 2.0), wood, gloss=0.25),
        box((width - 0.1, 0.03, 0.34), (0.0, 0.6 * depth / 2.0, below - 0.17), darker),
    ]
    drawers = rng.choice([-1.0, 1.0])
    for side, x in ((-1.0, left), (1.0, right)):
        if side == drawers:
            chest = 0.38
            middle = x - side * (chest / 2.0 - 0.03)
            solids.append(
                box((chest, 0.9 * depth, below), (middle, 0.0, below / 2.0), darker, gloss=0.1)
            )
            for row in range(3):
                at = (middle, -0.45 * depth - 0.008, (row + 0.5) * below / 3.0)
                solids.append(box((chest - 0.04, 0.02, below / 3.0 - 0.03), at, wood))
                solids.append(box((0.12, 0.03, 0.02), (at[0], at[1] - 0.02, at[2]), _STEEL))
        else:
            solids.append(box((0.05, 0.9 * depth, below), (x, 0.0, below / 2.0), darker))
    return Thing(name="desk", solids=tuple(solids), half=(width / 2, depth / 2), top=height)


def _chair(rng: np.random.Generator) -> Thing:
    cloth = shade_of(rng, hue=(68, 78), saturation=(0.78, 0.92), value=(0.68, 0.85))
    seat, wide = rng.uniform(0.44, 0.52), rng.uniform(0.46, 0.54)
    tall, lean = rng.uniform(0.46, 0.62), rng.uniform(0.05, 0.22)
    solids = [
        box((wide, wide, 0.09), (0.0, 0.0, seat), cloth),
        rod(0.045, (-wide / 2, -wide / 2, seat), (wide / 2, -wide / 2, seat), cloth),
        box(
            (0.92 * wide, 0.08, tall),
            (0.0, wide / 2.0 + math.sin(lean) * tall / 2.0, seat + 0.12 + tall / 2.0),
            cloth,
            pitch=lean,
        ),
        box((0.08, 0.03, 0.3), (0.0, wide / 2.0 + 0.04, seat + 0.08), _BLACK),
        cylinder(0.035, seat - 0.1, (0.0, 0.0, 0.08), _STEEL, gloss=0.5),
    ]
    turn = rng.uniform(0.0, 2.0 * math.pi)
    for foot in range(5):
        angle = turn + foot * 2.0 * math.pi / 5.0
        end = (0.3 * math.cos(angle), 0.3 * math.sin(angle), 0.07)
        solids.append(rod(0.028, (0.0, 0.0, 0.11), end, _BLACK))
        solids.append(ball((0.08, 0.08, 0.08), (end[0], end[1], 0.04), _BLACK))
    if rng.uniform() < 0.6:
        for x in (-wide / 2.0 - 0.03, wide / 2.0 + 0.03):
            solids.append(box((0.05, 0.3, 0.04), (x, 0.03, seat + 0.22), _BLACK))
            solids.append(rod(0.018, (x, 0.06, seat), (x, 0.06, seat + 0.22), _BLACK))
    return Thing(name="chair", solids=tuple(solids), half=(0.34, 0.34))


def _computer(rng: np.random.Generator) -> Thing:
    width, height = rng.uniform(0.58, 0.68), rng.uniform(0.37, 0.44)
    middle = 0.13 + height / 2.0
    desktop = shade_of(rng, hue=(208, 213), saturation=(0.70, 0.82), value=(0.88, 0.96))
    solids = [
        box((width, 0.05, height), (0.0, 0.05, middle), _BLACK, gloss=0.2),
        box((width - 0.06, 0.01, height - 0.06), (0.0, 0.022, middle), desktop, glow=0.5),
        box((0.07, 0.05, 0.2), (0.0, 0.09, 0.11), _BLACK),
        box((0.28, 0.2, 0.02), (0.0, 0.07, 0.01), _BLACK),
        box((0.46, 0.15, 0.03), (-0.02, -0.2, 0.015), (0.85, 0.86, 0.88)),
        box((0.42, 0.11, 0.012), (-0.02, -0.2, 0.032), (0.25, 0.26, 0.28)),
        ball((0.07, 0.11, 0.05), (0.29, -0.19, 0.02), (0.85, 0.86, 0.88)),
    ]
    for _ in range(int(rng.integers(1, 3))):
        # Windows on the screen: a page with its title bar.
        wide, tall = rng.uniform(0.2, 0.32), rng.uniform(0.14, 0.22)
        x = rng.uniform(-1.0, 1.0) * (width - 0.1 - wide) / 2.0
        z = middle + rng.uniform(-1.0, 1.0) * (height - 0.1 - tall) / 2.0
        solids.append(box((wide, 0.004, tall), (x, 0.015, z), _WHITE, glow=0.85))
        bar = (x, 0.012, z + tall / 2.0 - 0.02)
        solids.append(box((wide, 0.004, 0.04), bar, (0.1, 0.2, 0.45), glow=0.5))
    return Thing(name="computer", solids=tuple(solids), half=(width / 2, 0.28))


def _cup(rng: np.random.Generator) -> Thing:
    radius, height = rng.uniform(0.095, 0.115), rng.uniform(0.20, 0.25)
    glaze = shade_of(rng, hue=(176, 183), saturation=(0.88, 1.0), value=(0.84, 0.97))
    side = rng.choice([-1.0, 1.0])
    reach, turn = 0.085, rng.uniform(-0.5, 0.5)
    solids = [
        cylinder(radius, height, (0.0, 0.0, 0.0), glaze, gloss=0.6),
        cylinder(radius * 0.86, 0.004, (0.0, 0.0, height), (0.20, 0.11, 0.06)),
    ]
    arc = [
        (
            side * math.cos(turn) * (radius - 0.01 + reach * math.sin(angle)),
            side * math.sin(turn) * (radius - 0.01 + reach * math.sin(angle)),
            height / 2.0 + 0.36 * height * math.cos(angle),
        )
        for angle in np.linspace(0.0, math.pi, 6)
    ]
    solids += [rod(0.018, a, b, glaze, gloss=0.6) for a, b in pairwise(arc)]
    if rng.uniform() < 0.5:
        at = (0.0, 0.0, height * rng.uniform(0.35, 0.6))
        solids.append(cylinder(radius * 1.01, 0.03, at, _WHITE, gloss=0.6))
    return Thing(name="cup", solids=tuple(solids), half=(radius + 0.03, radius))


def _parcel(name: str, size: Point, card: Colour, tape: Colour, width: float) -> list[Solid]:
    """A closed box with tape over its middle in both directions."""
    wide, deep, high = size
    return [
        box(size, (0.0, 0.0, high / 2.0), card),
        box((width, deep + 0.008, high + 0.004), (0.0, 0.0, high / 2.0), tape),
        *(
            [box((wide + 0.008, width, high + 0.004), (0.0, 0.0, high / 2.0), tape)]
            if name == "small_box"
            else []
        ),
    ]


def _small_box(rng: np.random.Generator) -> Thing:
    size = (rng.uniform(0.28, 0.36), rng.uniform(0.26, 0.34), rng.uniform(0.22, 0.3))
    card = shade_of(rng, hue=(-5, 5), saturation=(0.84, 0.95), value=(0.68, 0.85))
    solids = _parcel("small_box", size, card, _WHITE, rng.uniform(0.035, 0.055))
    return Thing(name="small_box", solids=tuple(solids), half=(size[0] / 2, size[1] / 2))


def _large_box(rng: np.random.Generator) -> Thing:
    wide, deep, high = rng.uniform(0.6, 0.76), rng.uniform(0.5, 0.62), rng.uniform(0.5, 0.68)
    card = shade_of(rng, hue=(34, 39), saturation=(0.42, 0.52), value=(0.78, 0.90))
    dark: Colour = tuple(0.62 * c for c in card)  # type: ignore[assignment]
    solids = _parcel("large_box", (wide, deep, high), card, dark, 0.075)
    label = (rng.uniform(-0.3, 0.3) * wide, -deep / 2.0 - 0.003, rng.uniform(0.3, 0.7) * high)
    solids.append(box((0.18, 0.006, 0.12), label, _WHITE))
    if rng.uniform() < 0.6:
        # The flaps stand open.
        for side in (-1.0, 1.0):
            tilt = side * rng.uniform(0.6, 1.0)
            at = (0.0, side * (deep / 2.0 + 0.1 * math.sin(abs(tilt))), high + 0.09)
            solids.append(box((wide, 0.012, 0.24), at, card, pitch=tilt))
        inside = (0.0, 0.0, high + 0.003)
        solids.append(box((wide - 0.04, deep - 0.04, 0.006), inside, (0.24, 0.17, 0.1)))
    return Thing(name="large_box", solids=tuple(solids), half=(wide / 2, deep / 2))


def _sofa(rng: np.random.Generator) -> Thing:
    width, depth = rng.uniform(1.35, 1.65), rng.uniform(0.72, 0.85)
    seat, back, arm = rng.uniform(0.38, 0.44), rng.uniform(0.74, 0.88), rng.uniform(0.14, 0.2)
    cloth = shade_of(rng, hue=(150, 159), saturation=(0.72, 0.88), value=(0.44, 0.58))
    lighter: Colour = tuple(min(1.0, 1.18 * c) for c in cloth)  # type: ignore[assignment]
    elbow = seat + rng.uniform(0.14, 0.2)
    inner = width - 2.0 * arm
    solids = [
        box((width, depth, seat - 0.16), (0.0, 0.0, seat / 2.0 - 0.02), cloth),
        box((width, 0.2, back - 0.08), (0.0, depth / 2.0 - 0.1, 0.04 + back / 2.0), cloth),
        rod(
            0.1,
            (-width / 2 + 0.1, depth / 2 - 0.1, back),
            (width / 2 - 0.1, depth / 2 - 0.1, back),
            cloth,
        ),
    ]
    for side in (-1.0, 1.0):
        x = side * (width - arm) / 2.0
        solids.append(box((arm, depth, elbow - 0.06), (x, 0.0, 0.06 + elbow / 2.0), cloth))
        solids.append(
            rod(arm / 2, (x, -depth / 2 + 0.05, elbow), (x, depth / 2 - 0.1, elbow), cloth)
        )
        for y in (-depth / 2.0 + 0.06, depth / 2.0 - 0.06):
            solids.append(cylinder(0.03, 0.08, (side * (width / 2 - 0.07), y, 0.0), _BLACK))
    cushions = int(rng.integers(2, 4))
    each = inner / cushions
    for number in range(cushions):
        x = -inner / 2.0 + (number + 0.5) * each
        solids.append(box((each - 0.02, depth - 0.22, 0.14), (x, -0.1, seat - 0.03), lighter))
        solids.append(
            ball(
                (each, 0.22, back - seat + 0.06), (x, depth / 2 - 0.22, (seat + back) / 2), lighter
            )
        )
    return Thing(name="sofa", solids=tuple(solids), half=(width / 2, depth / 2))


def _books(rng: np.random.Generator) -> Thing:
    covers = [
        shade_of(rng, hue=(262, 284), saturation=(0.62, 0.85), value=value)
        # Of one series, light and dark in turn, so that one sees where each ends.
        for value in [(0.42, 0.54), (0.72, 0.9)] * 3
    ][: int(rng.integers(5, 7))]
    solids = []
    if rng.uniform() < 0.5:  # A pile, with the pages to the front.
        level = 0.0
        for cover in covers:
            wide, deep, thick = rng.uniform(0.3, 0.38), rng.uniform(0.22, 0.27), 0.052
            yaw, x = rng.normal(0.0, 0.18), rng.normal(0.0, 0.012)
            for z in (level + 0.007, level + thick - 0.007):
                solids.append(box((wide, deep, 0.014), (x, 0.0, z), cover, yaw=yaw))
            middle = (x, 0.0, level + thick / 2.0)
            solids.append(box((wide - 0.01, deep - 0.01, thick - 0.028), middle, _PAPER, yaw=yaw))
            level += thick
        half = (0.19, 0.15)
    else:  # A row, with the backs to the front.
        x = -0.036 * len(covers)
        for cover in covers:
            thick, deep, tall = rng.uniform(0.055, 0.07), 0.22, rng.uniform(0.30, 0.38)
            x += thick / 2.0
            solids.append(box((thick, deep, tall), (x, 0.0, tall / 2.0), cover))
            for z in (0.22 * tall, 0.78 * tall):
                solids.append(box((thick + 0.002, deep + 0.006, 0.03), (x, 0.0, z), _PAPER))
            x += thick / 2.0 + 0.004
        half = (0.036 * len(covers), 0.11)
    return Thing(name="books", solids=tuple(solids), half=half)


def _plant(rng: np.random.Generator) -> Thing:
    green = shade_of(rng, hue=(102, 116), saturation=(0.68, 0.85), value=(0.38, 0.52))
    pot = shade_of(rng, hue=(14, 20), saturation=(0.55, 0.7), value=(0.55, 0.7))
    deep, wide = rng.uniform(0.24, 0.34), rng.uniform(0.15, 0.19)
    solids = [
        cylinder(0.85 * wide, deep, (0.0, 0.0, 0.0), pot),
        cylinder(wide, 0.07, (0.0, 0.0, deep - 0.05), pot),
        cylinder(0.86 * wide, 0.01, (0.0, 0.0, deep + 0.015), (0.16, 0.11, 0.07)),
    ]
    tall = rng.uniform(0.55, 0.9)
    leaves = int(rng.integers(13, 19))
    spread = rng.uniform(0.26, 0.36)
    for number in range(leaves):
        # A golden angle apart, leaves never hide each other.
        angle = number * math.pi * (3.0 - math.sqrt(5.0)) + rng.normal(0.0, 0.15)
        rise = (number + 0.6) / leaves
        out = spread * math.sin(math.pi * (0.25 + 0.72 * rise)) * rng.uniform(0.8, 1.1)
        foot = deep + tall * (0.15 + 0.55 * rise)
        begin = (0.12 * out * math.cos(angle), 0.12 * out * math.sin(angle), foot)
        end = (out * math.cos(angle), out * math.sin(angle), foot + rng.uniform(0.12, 0.34))
        leaf: Colour = tuple(c * rng.uniform(0.8, 1.2) for c in green)  # type: ignore[assignment]
        solids.append(rod(rng.uniform(0.06, 0.085), begin, end, leaf, flat=0.05, gloss=0.15))
    solids.append(rod(0.02, (0.0, 0.0, deep), (0.0, 0.0, deep + 0.75 * tall), (0.25, 0.2, 0.1)))
    return Thing(name="plant", solids=tuple(solids), half=(0.26, 0.26))


def sideboard(rng: np.random.Generator) -> Thing:
    """A low white cupboard, for what would stand on a desk if there were one."""
    width, depth, height = rng.uniform(1.2, 1.45), rng.uniform(0.42, 0.5), rng.uniform(0.45, 0.6)
    tone = rng.uniform(0.78, 0.92)
    paint: Colour = (tone, tone, 0.98 * tone)
    door: Colour = (0.92 * tone, 0.92 * tone, 0.9 * tone)
    solids = [box((width, depth, height - 0.06), (0.0, 0.0, 0.03 + height / 2.0), paint, gloss=0.2)]
    for side in (-1.0, 1.0):
        at = (side * width / 4.0, -depth / 2.0 - 0.008, 0.03 + height / 2.0)
        solids.append(box((width / 2.0 - 0.05, 0.016, height - 0.14), at, door, gloss=0.2))
        knob = (side * 0.05, -depth / 2.0 - 0.03, height * 0.6)
        solids.append(ball((0.03, 0.03, 0.03), knob, _STEEL))
    return Thing(name="", solids=tuple(solids), half=(width / 2, depth / 2), top=height)


BUILDERS: dict[str, Callable[[np.random.Generator], Thing]] = {
    "desk": _desk,
    "chair": _chair,
    "computer": _computer,
    "cup": _cup,
    "small_box": _small_box,
    "large_box": _large_box,
    "sofa": _sofa,
    "books": _books,
    "plant": _plant,
}
"""What builds each object."""

ON_TOP = ("computer", "books", "cup")
"""The objects that stand on another, from the widest to the narrowest."""
