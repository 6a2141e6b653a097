"""What stands with a sign or before it: its pole, plates below it, stickers, leaves, branches."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seewhy_lab.simulators.traffic_signs.sign import Color, Patch, ellipse, paint, rectangle

__all__ = ["in_front", "lettering", "supports"]

Points = NDArray[np.float64]


def supports(outline: Points, rng: np.random.Generator) -> list[Patch]:
    """Return the pole of a sign and the signs above and below it, in the plane of the sign."""
    low, high = outline.min(axis=0), outline.max(axis=0)
    patches: list[Patch] = []
    if rng.random() < 0.8:
        grey = rng.uniform(0.15, 0.7)
        tone = (grey, grey, grey) if rng.random() < 0.9 else paint("orange", rng)
        middle, half = rng.normal(0.0, 0.03), rng.uniform(0.025, 0.055)
        top = low[1] - rng.uniform(-0.2, 0.12)
        patches.append(Patch(rectangle(middle - half, top, middle + half, 3.0), tone))
        shade = (tone[0] * 0.6, tone[1] * 0.6, tone[2] * 0.6)
        patches.append(Patch(rectangle(middle + half * 0.3, top, middle + half, 3.0), shade))
    if rng.random() < 0.4:
        top = high[1] + rng.uniform(0.005, 0.07)
        patches += _plate(top, rng)
    if rng.random() < 0.06:
        red = paint(str(rng.choice(["red", "blue", "white"])), rng)
        rise = rng.uniform(0.02, 0.1)
        patches.append(Patch(ellipse((0.0, low[1] - rise - 0.5), (0.5, 0.5)), red))
    return patches


def _plate(top: float, rng: np.random.Generator) -> list[Patch]:
    """A plate below a sign, blue or white, that says how far, when or for whom; or another sign."""
    pick = rng.random()
    if pick < 0.2:
        color = paint(str(rng.choice(["red", "blue", "white"])), rng)
        return [Patch(ellipse((0.0, top + 0.5), (0.5, 0.5)), color)]
    ground, ink = ("blue", "white") if pick < 0.75 else ("white", "black")
    half, height = rng.uniform(0.3, 0.55), rng.uniform(0.2, 0.4)
    edge = rectangle(-half, top, half, top + height)
    inside = rectangle(-half + 0.02, top + 0.02, half - 0.02, top + height - 0.02)
    patches = [Patch(edge, paint("white", rng)), Patch(inside, paint(ground, rng))]
    box = (-half * 0.8, top + height * 0.25, half * 0.8, top + height * 0.75)
    return patches + lettering(box, int(rng.integers(2, 10)), paint(ink, rng), rng)


def lettering(
    box: tuple[float, float, float, float], count: int, color: Color, rng: np.random.Generator
) -> list[Patch]:
    """Return strokes that look like a line of ``count`` letters from further off."""
    left, top, right, bottom = box
    wide = (right - left) / count
    stroke = min(wide * 0.24, (bottom - top) * 0.22)
    patches = []
    for number in range(count):
        west, east = left + number * wide, left + (number + 0.78) * wide
        middle = (top + bottom) / 2
        strokes = [
            rectangle(west, top, west + stroke, bottom),
            rectangle(east - stroke, top, east, bottom),
            rectangle(west, top, east, top + stroke),
            rectangle(west, bottom - stroke, east, bottom),
            rectangle(west, middle - stroke / 2, east, middle + stroke / 2),
        ]
        for shape in rng.choice(5, size=int(rng.integers(2, 5)), replace=False):
            patches.append(Patch(strokes[shape], color))
    return patches


def in_front(outline: Points, rng: np.random.Generator) -> list[Patch]:
    """Return what hides a little of a sign; mostly nothing."""
    low, high = outline.min(axis=0), outline.max(axis=0)
    pick = rng.random()
    if pick < 0.03:  # a sticker or graffiti
        center = rng.uniform(low * 0.6, high * 0.6)
        half = rng.uniform(0.02, 0.09, 2)
        color = paint(str(rng.choice(["white", "yellow", "green", "black", "grey"])), rng)
        return [Patch(rectangle(*(center - half), *(center + half)), color)]
    if pick < 0.07:  # leaves from one side
        angle = rng.uniform(0, 2 * np.pi)
        side = np.array([np.cos(angle), np.sin(angle)]) * rng.uniform(0.4, 0.6)
        green = np.array([0.2, 0.26, 0.12]) * rng.uniform(0.3, 1.8)
        patches = []
        for _ in range(int(rng.integers(6, 40))):
            middle = side + rng.normal(0.0, 0.13, 2)
            red, mid, blue = np.clip(green * rng.uniform(0.5, 1.6), 0.01, 1)
            radii = rng.uniform(0.015, 0.06, 2)
            leaf = ellipse((middle[0], middle[1]), (radii[0], radii[1]), 8)
            patches.append(Patch(leaf, (float(red), float(mid), float(blue))))
        return patches
    if pick < 0.10:  # a branch or a cable
        start, end = rng.uniform(-0.7, 0.7, (2, 2))
        aside = np.array([end[1] - start[1], start[0] - end[0]])
        aside *= rng.uniform(0.006, 0.025) / max(float(np.linalg.norm(aside)), 1e-6)
        along = (end - start) * 1.5
        bar = np.array([start - along - aside, end + along - aside, end + along + aside])
        grey = rng.uniform(0.03, 0.4)
        return [Patch(np.vstack([bar, start - along + aside]), (grey, grey, grey))]
    return []
