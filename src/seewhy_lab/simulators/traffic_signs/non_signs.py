"""Pictures that show none of the known signs, but what could be taken for one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seewhy_lab.simulators.traffic_signs.backgrounds import background
from seewhy_lab.simulators.traffic_signs.photograph import photograph, photograph_scene
from seewhy_lab.simulators.traffic_signs.sign import Face, Patch, ellipse, face, paint, rectangle
from seewhy_lab.simulators.traffic_signs.source import signs
from seewhy_lab.simulators.traffic_signs.surroundings import lettering

__all__ = ["draw_non_sign"]

_SHAPES = (
    "triangle",
    "inverted_triangle",
    "circle",
    "octagon",
    "diamond",
    "square",
    "tall_rectangle",
    "wide_rectangle",
)
_PAINTS = ("white", "red", "blue", "yellow", "green", "black", "orange", "brown", "grey")
_BLANK = {
    "background_image": "none",
    "primary_symbol": "blank",
    "secondary_symbol": "none",
    "cross": "none",
}


def draw_non_sign(*, seed: int, index: int, size: int = 48) -> NDArray[np.uint8]:
    """Draw picture number ``index`` of the pictures without a sign that ``seed`` stands for.

    They show what is beside a road, the back of a sign, a number plate, a shop sign, a lamp or a
    wheel, a plate whose colours no known sign of its shape has, and signs that are not known. A
    picture depends on ``seed``, ``index`` and ``size`` only.

    Returns
    -------
    ndarray of uint8, shape (height, width, 3), the longer side ``size``

    Examples
    --------
    >>> max(draw_non_sign(seed=0, index=0, size=32).shape)
    32
    """
    rng = np.random.default_rng([seed, index, 2])
    if rng.random() < 0.3:
        return _nothing(rng, size)
    draw = (_number_plate, _shop_sign, _round_thing, _strange_plate, _unknown_sign)
    made = draw[int(rng.choice(len(draw), p=(0.12, 0.2, 0.13, 0.3, 0.25)))](rng)
    return photograph(made, rng, size=size)


def _nothing(rng: np.random.Generator, size: int) -> NDArray[np.uint8]:
    wide, high = rng.uniform(0.6, 1.0), 1.0
    if rng.random() < 0.5:
        wide, high = high, wide
    longer = rng.uniform(30, 2 * size)
    scene = background(rng, max(12, round(longer * wide)), max(12, round(longer * high)))
    return photograph_scene(scene, rng, size=size)


def _number_plate(rng: np.random.Generator) -> Face:
    half = rng.uniform(0.1, 0.17)
    ground = str(rng.choice(["white", "yellow", "red"], p=[0.6, 0.3, 0.1]))
    ink = str(rng.choice(["red", "black"])) if ground == "white" else "black"
    return _lettered(0.5, half, ground=ground, edge=ink, ink=ink, lines=1, rng=rng)


def _shop_sign(rng: np.random.Generator) -> Face:
    width, height = (0.5, rng.uniform(0.15, 0.5))
    if rng.random() < 0.3:
        width, height = height, width
    ground, ink = rng.choice(_PAINTS, size=2, replace=False)
    edge = str(rng.choice([ground, ink, "white"]))
    lines = max(1, round(height * rng.uniform(3, 9)))
    return _lettered(
        width, height, ground=str(ground), edge=edge, ink=str(ink), lines=lines, rng=rng
    )


def _lettered(
    width: float,
    height: float,
    *,
    ground: str,
    edge: str,
    ink: str,
    lines: int,
    rng: np.random.Generator,
) -> Face:
    outline = rectangle(-width, -height, width, height)
    rim = rng.uniform(0.01, 0.04)
    inside = rectangle(-width + rim, -height + rim, width - rim, height - rim)
    patches = [Patch(outline, paint(edge, rng)), Patch(inside, paint(ground, rng))]
    tone = paint(ink, rng)
    step = 2 * (height - rim) / lines
    for line in range(lines):
        top = -height + rim + (line + 0.2) * step
        half = (width - rim) * rng.uniform(0.5, 0.9)
        box = (-half, top, half, top + 0.6 * step)
        patches += lettering(box, _count(half, step, rng), tone, rng)
    return Face(outline, tuple(patches))


def _count(half: float, step: float, rng: np.random.Generator) -> int:
    """How many letters of usual proportions fill a line."""
    return int(np.clip(round(2 * half / (0.45 * step) * rng.uniform(0.8, 1.2)), 1, 14))


def _round_thing(rng: np.random.Generator) -> Face:
    """Rings and discs one in another: a lamp, a wheel, a mirror, a clock."""
    outline = ellipse((0.0, 0.0), (0.5, 0.5))
    patches: list[Patch] = []
    radius = 0.5
    while radius > 0.05 and len(patches) < 5:
        grey = rng.uniform(0.03, 0.9)
        color = (grey, grey, grey)
        if rng.random() < 0.3:
            color = paint(str(rng.choice(["yellow", "green", "orange", "brown"])), rng)
        patches.append(Patch(ellipse((0.0, 0.0), (radius, radius)), color))
        radius *= rng.uniform(0.4, 0.95)
    return Face(outline, tuple(patches))


def _strange_plate(rng: np.random.Generator) -> Face:
    """A plate whose colours no known sign of this shape has, or the grey back of a sign."""
    known = {(sign["shape"], sign["main_color"], sign["border_color"]) for sign in signs().values()}
    shape = str(rng.choice(_SHAPES))
    if rng.random() < 0.25:
        back = {"shape": shape, "main_color": "grey", "border_color": "grey"}
        return face({**_BLANK, **back}, rng=rng)
    while True:
        main, border = (str(color) for color in rng.choice(_PAINTS, size=2))
        # A diamond is painted orange where the table says red.
        warm = {"orange": "red", "yellow": "red"} if shape == "diamond" else {}
        if (shape, warm.get(main, main), warm.get(border, border)) not in known:
            break
    features = {**_BLANK, "shape": shape, "main_color": main, "border_color": border}
    if rng.random() < 0.5:
        features["primary_symbol"] = _any_symbol(rng)
    return face(features, rng=rng)


def _unknown_sign(rng: np.random.Generator) -> Face:
    """The plate of a known sign with a symbol that no known sign of these colours has."""
    table = list(signs().values())
    features = dict(table[int(rng.integers(len(table)))])
    plate = [key for key in features if not key.endswith("symbol") and key != "cross"]
    taken = {
        row["primary_symbol"] for row in table if all(row[key] == features[key] for key in plate)
    }
    features |= {"secondary_symbol": "none", "cross": "none", "primary_symbol": "blank"}
    if rng.random() < 0.6 or "blank" in taken:
        while (name := _any_symbol(rng)) in taken:
            pass
        return face(features | {"primary_symbol": name}, rng=rng)
    bare = face(features, rng=rng)
    ink = "black" if "white" in (features["main_color"], features["background_image"]) else "white"
    return Face(bare.outline, (*bare.patches, *_scribble(paint(ink, rng), rng)))


def _any_symbol(rng: np.random.Generator) -> str:
    names = sorted({row["primary_symbol"] for row in signs().values()} - {"blank"})
    return str(rng.choice(names))


def _scribble(ink: tuple[float, float, float], rng: np.random.Generator) -> list[Patch]:
    """A symbol that stands for nothing: some letters, or a few blots."""
    if rng.random() < 0.4:
        box = (-0.22, -0.02, 0.22, 0.2)
        return lettering(box, int(rng.integers(2, 5)), ink, rng)
    patches = []
    for _ in range(int(rng.integers(2, 5))):
        middle = rng.normal((0.0, 0.06), 0.08)
        angles = np.sort(rng.uniform(0.0, 2 * np.pi, int(rng.integers(4, 9))))
        reach = rng.uniform(0.03, 0.16, len(angles))
        blot = middle + np.stack([reach * np.cos(angles), reach * np.sin(angles)], axis=1)
        patches.append(Patch(blot, ink))
    return patches
