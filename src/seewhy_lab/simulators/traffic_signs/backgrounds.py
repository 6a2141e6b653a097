"""What is behind a sign beside a road: leaves, grass, bricks, walls, windows, asphalt, sky."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

__all__ = ["background", "mottled"]

Picture = NDArray[np.float32]


def background(rng: np.random.Generator, width: int, height: int) -> Picture:
    """Return a background: floats in 0..1, about, of shape (height, width, 3).

    Examples
    --------
    >>> background(np.random.default_rng(0), 40, 30).shape
    (30, 40, 3)
    """
    names = list(_KINDS)
    weights = np.array([_KINDS[name][1] for name in names])
    picks = rng.choice(len(names), size=2, p=weights / weights.sum())
    first = _KINDS[names[picks[0]]][0](rng, width, height)
    if rng.random() < 0.5:
        return first
    return _divided(first, _KINDS[names[picks[1]]][0](rng, width, height), rng)


def mottled(
    rng: np.random.Generator, width: int, height: int, *, cells: float, rough: float = 0.5
) -> Picture:
    """Return noise about 0 of standard deviation about 1, shape (height, width).

    ``cells`` is how many of the largest blotches lie along the longer side; each finer layer is
    ``rough`` times as strong.
    """
    total = np.zeros((height, width), np.float32)
    strength, power, longer = 1.0, 0.0, max(width, height)
    while cells < longer and strength > 0.05:
        columns = max(2, round(cells * width / longer))
        rows = max(2, round(cells * height / longer))
        grid = rng.standard_normal((rows, columns), dtype=np.float32)
        layer = Image.fromarray(grid).resize((width, height), Image.Resampling.BILINEAR)
        total += strength * np.asarray(layer)
        power += strength**2
        strength *= rough
        cells *= 2.2
    return total / np.float32(max(power, 1e-6) ** 0.5)


def _divided(first: Picture, second: Picture, rng: np.random.Generator) -> Picture:
    """Two backgrounds with a straight line between them."""
    height, width = first.shape[:2]
    angle = rng.choice([0.0, np.pi / 2]) + rng.normal(0.0, 0.15)
    rows, columns = np.mgrid[0:height, 0:width]
    along = np.cos(angle) * columns / width + np.sin(angle) * rows / height
    mask = along > rng.uniform(0.15, 0.85)
    return np.where(mask[..., None], first, second)


def _colored(base: NDArray[np.float64], light: Picture) -> Picture:
    picture: Picture = base.astype(np.float32) * np.maximum(light, 0.0)[..., None]
    return picture


def _leaves(rng: np.random.Generator, width: int, height: int) -> Picture:
    tone = np.array([0.24, 0.27, 0.17]) * rng.uniform(0.3, 1.6) + rng.normal(0, 0.02, 3)
    if rng.random() < 0.3:
        tone = np.array([0.30, 0.24, 0.17]) * rng.uniform(0.3, 1.3)
    noise = mottled(rng, width, height, cells=rng.uniform(3, 12), rough=rng.uniform(0.6, 1.0))
    light = np.exp(noise * rng.uniform(0.4, 1.0) - 0.25)
    picture = _colored(np.clip(tone, 0.02, 1), light)
    if rng.random() < 0.25:  # the sky between the leaves
        gaps = mottled(rng, width, height, cells=rng.uniform(3, 8), rough=0.8)
        picture[gaps > rng.uniform(0.5, 1.5)] = rng.uniform(0.7, 1.1)
    return picture


def _grass(rng: np.random.Generator, width: int, height: int) -> Picture:
    tone = np.array([0.36, 0.42, 0.20]) * rng.uniform(0.5, 1.5) + rng.normal(0, 0.03, 3)
    if rng.random() < 0.3:
        tone = np.array([0.45, 0.40, 0.27]) * rng.uniform(0.5, 1.4)
    noise = mottled(rng, width, height, cells=rng.uniform(4, 25), rough=0.8)
    return _colored(np.clip(tone, 0.02, 1), 1 + noise * rng.uniform(0.08, 0.35))


def _darkness(rng: np.random.Generator, width: int, height: int) -> Picture:
    tone = rng.uniform(0.02, 0.16) + rng.normal(0, 0.012, 3)
    noise = mottled(rng, width, height, cells=rng.uniform(2, 6), rough=0.6)
    return _colored(np.clip(tone, 0.005, 1), 1 + noise * rng.uniform(0.1, 0.5))


def _wall(rng: np.random.Generator, width: int, height: int) -> Picture:
    tone = rng.uniform(0.2, 0.95) * (np.array([1.0, 0.98, 0.94]) + rng.normal(0, 0.05, 3))
    noise = mottled(rng, width, height, cells=rng.uniform(1.5, 5), rough=0.5)
    picture = _colored(tone, 1 + noise * rng.uniform(0.01, 0.12))
    if rng.random() < 0.3:  # boards or ribs
        lines = np.sin(np.arange(width) * rng.uniform(0.4, 1.8) + rng.uniform(0, 6))
        picture *= (1 + 0.15 * np.sign(lines)).astype(np.float32)[None, :, None]
    return picture


def _sky(rng: np.random.Generator, width: int, height: int) -> Picture:
    tone = np.array([0.85, 0.95, 1.05]) * rng.uniform(0.55, 1.3)
    if rng.random() < 0.5:
        tone = np.full(3, rng.uniform(0.8, 1.3))
    noise = mottled(rng, width, height, cells=rng.uniform(1.5, 3), rough=0.5)
    return _colored(tone, 1 + noise * rng.uniform(0.0, 0.08))


def _asphalt(rng: np.random.Generator, width: int, height: int) -> Picture:
    tone = rng.uniform(0.2, 0.65) + rng.normal(0, 0.025, 3)
    noise = mottled(rng, width, height, cells=rng.uniform(2, 8), rough=0.8)
    picture = _colored(tone, 1 + noise * rng.uniform(0.02, 0.12))
    if rng.random() < 0.3:  # a line on the road, or the kerb
        picture = _divided(picture, picture * rng.uniform(1.2, 2.0), rng)
    return picture


def _bricks(rng: np.random.Generator, width: int, height: int) -> Picture:
    tone = np.array([0.46, 0.27, 0.21]) * rng.uniform(0.5, 1.5) + rng.normal(0, 0.03, 3)
    if rng.random() < 0.25:
        tone = np.full(3, rng.uniform(0.3, 0.8)) + rng.normal(0, 0.03, 3)
    rows = int(rng.integers(8, 30))
    course = height / rows
    columns = max(2, round(width / (course * rng.uniform(2.4, 3.4))))
    grid = 1 + rng.normal(0, rng.uniform(0.05, 0.2), (rows, columns * 2))
    ys = np.linspace(0, rows, height, endpoint=False)
    xs = np.linspace(0, columns, width, endpoint=False)
    row = ys.astype(int)
    shifted = xs[None, :] + 0.5 * (row % 2)[:, None] + rng.uniform(0, 1)
    light = grid[row[:, None], shifted.astype(int) % (columns * 2)]
    joint = ((ys % 1) < 0.16)[:, None] | ((shifted % 1) < 0.06)
    picture = _colored(np.clip(tone, 0.03, 1), light.astype(np.float32))
    mortar = np.clip(tone.mean() * rng.uniform(0.6, 1.9), 0, 1)
    picture[joint] = picture[joint] * 0.3 + np.float32(0.7 * mortar)
    return picture


def _house(rng: np.random.Generator, width: int, height: int) -> Picture:
    """A front with windows, doors, roofs, cars: upright rectangles of any colour."""
    base = (_wall, _bricks, _asphalt)[int(rng.integers(3))](rng, width, height)
    image = Image.fromarray((np.clip(base, 0, 1) * 255).astype(np.uint8))
    pen = ImageDraw.Draw(image)
    for _ in range(int(rng.integers(2, 9))):
        left, top = rng.uniform(-0.2, 0.9, 2) * (width, height)
        wide, high = rng.uniform(0.08, 0.6, 2) * (width, height)
        grey = rng.uniform(0.02, 1.0)
        spread = 0.03 if rng.random() < 0.8 else 0.2
        color = np.clip(grey + rng.normal(0, spread, 3), 0, 1) * 255
        pen.rectangle((left, top, left + wide, top + high), fill=tuple(color.astype(int).tolist()))
    return np.asarray(image, dtype=np.float32) / np.float32(255)


_KINDS = {
    "leaves": (_leaves, 0.30),
    "grass": (_grass, 0.09),
    "darkness": (_darkness, 0.12),
    "wall": (_wall, 0.12),
    "sky": (_sky, 0.07),
    "asphalt": (_asphalt, 0.08),
    "bricks": (_bricks, 0.10),
    "house": (_house, 0.16),
}
