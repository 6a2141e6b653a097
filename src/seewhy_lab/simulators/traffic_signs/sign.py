"""The face of a sign, from its seven features: coloured polygons in the plane of the sign."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from seewhy_lab.simulators.traffic_signs.symbols import symbol

__all__ = ["Color", "Face", "Patch", "ellipse", "face", "paint", "rectangle"]

Points = NDArray[np.float64]
Color = tuple[float, float, float]

_PAINTS: dict[str, Color] = {
    "white": (0.89, 0.91, 0.88),
    "red": (0.70, 0.15, 0.11),
    "blue": (0.09, 0.27, 0.58),
    "yellow": (0.85, 0.72, 0.20),
    "green": (0.08, 0.42, 0.25),
    "black": (0.07, 0.07, 0.07),
    "orange": (0.74, 0.37, 0.20),
    "brown": (0.38, 0.23, 0.13),
    "grey": (0.52, 0.53, 0.54),
}


@dataclass(frozen=True)
class Patch:
    """A polygon of one colour.

    Attributes
    ----------
    points : ndarray of shape (n, 2)
        Corners in the plane of the sign: x to the right, y down, the origin in the middle of the
        sign, whose taller or wider side is 1.
    color : tuple of three floats in 0..1
        Red, green, blue.
    """

    points: Points
    color: Color


@dataclass(frozen=True)
class Face:
    """A sign seen from the front.

    Attributes
    ----------
    outline : ndarray of shape (n, 2)
        The edge of the plate.
    patches : tuple of Patch
        From the lowest to the uppermost.
    """

    outline: Points
    patches: tuple[Patch, ...]


def face(features: Mapping[str, str], *, rng: np.random.Generator, variant: str = "") -> Face:
    """Draw the face of a sign that has the given features.

    Parameters
    ----------
    features : mapping of str to str
        Values of ``shape``, ``main_color``, ``border_color``, ``background_image``,
        ``primary_symbol``, ``secondary_symbol`` and ``cross``. The colours may be any paint.
    rng : numpy.random.Generator
        Chooses what differs between signs of one kind: widths, tones, the way of drawing.
    variant : str
        The class, where a symbol is drawn in several ways.

    Examples
    --------
    >>> stop = dict(shape="octagon", main_color="red", border_color="white",
    ...     background_image="none", primary_symbol="stop", secondary_symbol="none", cross="none")
    >>> float(face(stop, rng=np.random.default_rng(0)).outline.max())
    0.5
    """
    shape, main, border = (features[key] for key in ("shape", "main_color", "border_color"))
    # The priority signs count as red; their paint is a strong orange.
    tones = {name: paint(name, rng) for name in _PAINTS}
    if shape == "diamond":
        warm = "yellow" if rng.random() < 0.06 else "orange"
        tones["red"] = tones[warm]
    background = features["background_image"]
    plate = _Plate(shape, rng)
    patches = list(_ground(plate, tones, main=main, border=border, rng=rng))
    ground = main
    if background != "none" and shape != "diamond":
        inner, ground = _background(plate, background, rng), "white"
        patches.append(Patch(inner, tones[ground]))
    places = _places(features, rng)
    for key, place in places.items():
        below = main if key == "secondary_symbol" and background == "square" else ground
        drawn = _symbol(features[key], place, below, tones, rng=rng, variant=variant)
        if drawn and background == "triangle":
            drawn = _lowered(drawn, place)
        patches += drawn
    if features["primary_symbol"] == "p" and features["secondary_symbol"] == "none":
        patches += _ticket(tones, rng)
    patches += _cross(features["cross"], plate, tones, rng)
    return Face(plate.edge(0.0), tuple(patches))


def paint(name: str, rng: np.random.Generator) -> Color:
    """Return a tone of a paint: no two signs have quite the same."""
    base = np.array(_PAINTS[name])
    tone = base * rng.uniform(0.85, 1.1) + rng.normal(0.0, 0.02, 3)
    if name == "blue":
        tone[1] += rng.uniform(-0.06, 0.06)
    if name == "red":
        tone[1:] += rng.uniform(-0.03, 0.06)
    red, green, blue = np.clip(tone, 0.01, 0.98)
    return float(red), float(green), float(blue)


def rectangle(left: float, top: float, right: float, bottom: float) -> Points:
    """Return the corners of an upright rectangle."""
    return np.array([[left, top], [right, top], [right, bottom], [left, bottom]])


def ellipse(center: tuple[float, float], radii: tuple[float, float], steps: int = 40) -> Points:
    """Return the corners of a polygon that looks like an ellipse."""
    angles = np.linspace(0.0, 2.0 * math.pi, steps, endpoint=False)
    return np.stack(
        [center[0] + radii[0] * np.cos(angles), center[1] + radii[1] * np.sin(angles)], axis=1
    )


class _Plate:
    """The plate of a sign: its outline, and that outline moved inwards."""

    def __init__(self, shape: str, rng: np.random.Generator) -> None:
        self.shape = shape
        self.corners = _corners(shape, rng)
        lowest, highest = {
            "triangle": (0.03, 0.06),
            "inverted_triangle": (0.03, 0.06),
            "octagon": (0.0, 0.015),
            "diamond": (0.05, 0.1),
        }.get(shape, (0.03, 0.075))
        self.radius = rng.uniform(lowest, highest)
        # Rounded corners draw the outline in; the sides are to have their full length.
        outline = self._rounded(0.0)
        low, high = outline.min(axis=0), outline.max(axis=0)
        self.shift, self.scale = (low + high) / 2.0, 1.0 / float((high - low).max())

    def edge(self, inset: float) -> Points:
        """The outline moved inwards by ``inset``."""
        edge: Points = (self._rounded(inset) - self.shift) * self.scale
        return edge

    def _rounded(self, inset: float) -> Points:
        if self.shape == "circle":
            return ellipse((0.0, 0.0), (0.5 - inset, 0.5 - inset), 48)
        return _round_corners(_moved_in(self.corners, inset), max(self.radius - inset / 2.0, 0.004))


def _corners(shape: str, rng: np.random.Generator) -> Points:
    if shape in ("triangle", "inverted_triangle"):
        height = math.sqrt(3.0) / 2.0
        corners = np.array([[0.0, -height / 2], [0.5, height / 2], [-0.5, height / 2]])
        return corners if shape == "triangle" else -corners
    if shape == "octagon":
        angles = (np.arange(8) + 0.5) * math.pi / 4
        return np.stack([np.cos(angles), np.sin(angles)], axis=1) * 0.5 / math.cos(math.pi / 8)
    if shape == "diamond":
        return np.array([[0.0, -0.5], [0.5, 0.0], [0.0, 0.5], [-0.5, 0.0]])
    long = {"tall_rectangle": 1.5, "wide_rectangle": 1 / 1.5, "square": 1.0}.get(shape, 1.0)
    long *= rng.uniform(0.97, 1.03)
    height = min(1.0, long)
    width = height / long
    return rectangle(-width / 2, -height / 2, width / 2, height / 2)


def _moved_in(corners: Points, distance: float) -> Points:
    """A convex polygon, in clockwise order on the screen, with each side moved inwards."""
    before, after = np.roll(corners, 1, axis=0), np.roll(corners, -1, axis=0)
    into = (corners - before) / np.linalg.norm(corners - before, axis=1, keepdims=True)
    out = (after - corners) / np.linalg.norm(after - corners, axis=1, keepdims=True)
    sine = (into[:, 0] * out[:, 1] - into[:, 1] * out[:, 0])[:, None]
    moved: Points = corners + (out - into) * distance / sine
    return moved


def _round_corners(corners: Points, radius: float) -> Points:
    before, after = np.roll(corners, 1, axis=0), np.roll(corners, -1, axis=0)
    into = (corners - before) / np.linalg.norm(corners - before, axis=1, keepdims=True)
    out = (after - corners) / np.linalg.norm(after - corners, axis=1, keepdims=True)
    reach = radius * np.tan(np.arccos(np.clip((into * out).sum(axis=1), -1, 1)) / 2)[:, None]
    start, end = corners - into * reach, corners + out * reach
    times = np.linspace(0.0, 1.0, 5)[:, None, None]
    curve = (1 - times) ** 2 * start + 2 * times * (1 - times) * corners + times**2 * end
    points: Points = curve.transpose(1, 0, 2).reshape(-1, 2)
    return points


def _ground(
    plate: _Plate, tones: Mapping[str, Color], *, main: str, border: str, rng: np.random.Generator
) -> Sequence[Patch]:
    """The border and the ground inside it."""
    rim = rng.uniform(0.008, 0.022)
    if plate.shape == "diamond":
        white, inner = rng.uniform(0.1, 0.135), rng.uniform(0.006, 0.02)
        patches = [Patch(plate.edge(0.0), tones["black"])]
        patches += [Patch(plate.edge(rng.uniform(0.0, 0.03)), tones[border])]
        patches += [Patch(plate.edge(white), tones["black"])]
        return [*patches, Patch(plate.edge(white + inner), tones[main])]
    if border == main:
        patches = [Patch(plate.edge(0.0), tones[main])]
        if rng.random() < (0.7 if main == "red" else 0.2):
            patches = [Patch(plate.edge(0.0), tones["white"]), Patch(plate.edge(rim), tones[main])]
        return patches
    if border == "white":
        start = rng.choice([0.0, rng.uniform(0.008, 0.03)])
        width = rng.uniform(0.018, 0.045) * (1.4 if plate.shape == "wide_rectangle" else 1.0)
        patches = [Patch(plate.edge(0.0), tones[main])] if start else []
        patches += [Patch(plate.edge(start), tones[border])]
        return [*patches, Patch(plate.edge(start + width), tones[main])]
    width = rng.uniform(0.09, 0.12) if "triangle" in plate.shape else rng.uniform(0.1, 0.135)
    patches = [Patch(plate.edge(0.0), tones[border])]
    if rng.random() < 0.3:
        patches = [Patch(plate.edge(0.0), tones["white"]), Patch(plate.edge(rim), tones[border])]
    return [*patches, Patch(plate.edge(width), tones[main])]


def _background(plate: _Plate, image: str, rng: np.random.Generator) -> Points:
    """The white field of a blue sign on which the symbol stands."""
    half = np.abs(plate.edge(0.0)).max(axis=0)
    if image == "triangle":
        width, height = half * rng.uniform(1.45, 1.65)
        foot = half[1] * rng.uniform(0.68, 0.76)
        return np.array([[0.0, foot - height * 0.92], [width / 2, foot], [-width / 2, foot]])
    inset = rng.uniform(0.03, 0.06)
    bottom = half[1] * rng.uniform(0.18, 0.32)
    return rectangle(-half[0] + inset, -half[1] + inset, half[0] - inset, bottom)


Place = tuple[float, float, float]
"""Middle (x, y) and side of the square that a symbol fills."""


@cache
def _table() -> dict[str, dict[str, list[float]]]:
    path = Path(__file__).with_name("places.toml")
    table: dict[str, dict[str, list[float]]] = tomllib.loads(path.read_text(encoding="utf-8"))
    return table


def _places(features: Mapping[str, str], rng: np.random.Generator) -> dict[str, Place]:
    """Where the symbols stand: a matter of the shape, the background and how many there are."""
    shape, primary = features["shape"], features["primary_symbol"]
    secondary = features["secondary_symbol"]
    if secondary == "none":
        kind = shape
        if features["background_image"] == "triangle":
            kind = "white_triangle"
        elif shape == "circle" and features["border_color"] != "red":
            kind = "ringless_circle"
        by_symbol = _table()[kind]
        # What a circle without a ring does not place has the place of any circle's symbol.
        by_symbol = {**_table()[shape], **by_symbol} if kind == "ringless_circle" else by_symbol
        places = {"primary_symbol": by_symbol.get(primary, by_symbol["any"])}
    else:
        kind = "two_on_tall_rectangle" if shape == "tall_rectangle" else "two_on_circle"
        by_symbol = _table()["numbers_on_circle" if primary == "numbers" else kind]
        places = {
            "primary_symbol": by_symbol["primary"],
            "secondary_symbol": by_symbol.get(secondary, by_symbol["any"]),
        }
    scale = rng.uniform(0.92, 1.08)
    dx, dy = rng.normal(0.0, 0.012, 2)
    return {key: (x + dx, y + dy, side * scale) for key, (x, y, side) in places.items()}


def _symbol(
    name: str,
    place: Place,
    ground: str,
    tones: Mapping[str, Color],
    *,
    rng: np.random.Generator,
    variant: str,
) -> list[Patch]:
    if name in ("none", "blank"):
        return []
    roles = {"ink": "black" if ground in ("white", "yellow") else "white", "paper": ground}
    x, y, side = place
    return [
        Patch(
            np.array([x, y]) + (np.asarray(fill.points) - 0.5) * side,
            tones[roles.get(fill.role, fill.role)],
        )
        for fill in symbol(name, rng=rng, variant=variant)
    ]


def _lowered(patches: Sequence[Patch], place: Place) -> list[Patch]:
    """Move a flat symbol towards the foot of a triangle, where there is room for it."""
    spare = place[1] + place[2] / 2.0 - max(float(patch.points[:, 1].max()) for patch in patches)
    down = np.array([0.0, 0.75 * spare])
    return [Patch(patch.points + down, patch.color) for patch in patches]


def _ticket(tones: Mapping[str, Color], rng: np.random.Generator) -> list[Patch]:
    """The small mark of parking that is paid for, which many parking signs have."""
    if rng.random() >= 0.25:
        return []
    x, y = rng.uniform(0.1, 0.22), rng.uniform(0.22, 0.32)
    color = tones["white" if rng.random() < 0.7 else "yellow"]
    hand = rectangle(x - rng.uniform(0.03, 0.07), y, x + rng.uniform(0.0, 0.03), y + 0.02)
    coin = ellipse((x, y - rng.uniform(0.02, 0.05)), (0.02, 0.02), 12)
    slip = rectangle(x - 0.012, y - 0.01, x + 0.012, y + rng.uniform(0.03, 0.08))
    return [Patch(points, color) for points in (hand, coin, slip)]


def _cross(
    color: str, plate: _Plate, tones: Mapping[str, Color], rng: np.random.Generator
) -> list[Patch]:
    """The bar that ends or forbids what the sign says."""
    if color == "none":
        return []
    half = np.abs(plate.edge(0.0)).max(axis=0)
    if plate.shape == "circle":
        start, end = np.array([-0.29, -0.29]), np.array([0.29, 0.29])
        width = rng.uniform(0.075, 0.11)
    elif plate.shape == "diamond":
        start, end = np.array([-0.24, 0.24]), np.array([0.24, -0.24])
        width = rng.uniform(0.12, 0.17)
    else:
        start, end = half * [-0.9, 0.9], half * [0.9, -0.9]
        width = rng.uniform(0.05, 0.09)
    along = (end - start) / np.linalg.norm(end - start)
    aside = np.array([-along[1], along[0]]) * width / 2
    bar = np.array([start - aside, end - aside, end + aside, start + aside])
    return [Patch(bar, tones[color])]
