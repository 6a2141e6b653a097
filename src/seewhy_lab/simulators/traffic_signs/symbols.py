"""The symbols on traffic signs as polygons: what symbols.toml says, flattened to the unit square.

A drawing is a list of parts in coordinates of its own (x to the right, y down): filled paths,
strokes, circles, arcs, texts of stroke glyphs and other drawings put into a box. A symbol names
the drawings that it may look like, by class of sign where the classes differ. A new symbol, or
another look of one, is an entry in symbols.toml.
"""

from __future__ import annotations

import functools
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources import files
from typing import Any

import numpy as np

from seewhy.errors import DomainError
from seewhy_lab.simulators.traffic_signs.outlines import (
    Points,
    arc,
    flatten,
    stroke,
    turned,
)

__all__ = ["ROLES", "Fill", "looks", "symbol", "symbol_names"]

ROLES = ("ink", "paper", "red", "black", "white", "blue", "yellow", "green")

# How much wider strokes are drawn, and how much wider the whole, than symbols.toml says.
_PENS = (0.85, 1.0, 1.2)
_STRETCHES = (0.93, 1.0, 1.07)

_Area = tuple[Points, str]


@dataclass(frozen=True)
class Fill:
    """One area of a symbol in one colour.

    Attributes:
        points: The corners (x, y) of the outline, in the unit square, y down. No area has a
            hole: a ring comes as two areas.
        role: What gives it its colour: ``"ink"`` is the sign's symbol colour, ``"paper"`` the
            ground it stands on, everything else a colour of its own.
    """

    points: tuple[tuple[float, float], ...]
    role: str


def symbol(name: str, *, rng: np.random.Generator, variant: str = "") -> tuple[Fill, ...]:
    """The areas of one drawing of a symbol, to be painted in this order.

    What really varies is drawn from `rng`: the number on a limit, the model of a lorry, the
    direction of an arrow to the side, the thickness of lines and the width by a few per cent.

    Args:
        name: A primary or secondary symbol of classes.csv; ``"blank"`` and ``"none"`` show
            nothing.
        rng: One number is taken from it, whatever the symbol.
        variant: The class of the sign, for symbols that look different on some signs.

    Returns:
        The areas, in a unit square that the symbol fills: it is centred, keeps its proportions
        and touches two opposite sides. A symbol that belongs to the whole field of the sign (a
        limit of width with its wedges, the numbers of alternate parking, the paths side by side)
        is placed in the square as it is in the square around that field.

    Raises:
        DomainError: There is no such symbol.

    Examples:
        >>> lights = symbol("traffic_lights", rng=np.random.default_rng(0))
        >>> [fill.role for fill in lights]
        ['red', 'yellow', 'green']
        >>> symbol("blank", rng=np.random.default_rng(0))
        ()
    """
    choices = looks(name, variant=variant)
    number = int(rng.integers(max(1, len(choices)) * len(_PENS) * len(_STRETCHES)))
    if not choices:
        return ()
    number, pen = divmod(number, len(_PENS))
    number, stretch = divmod(number, len(_STRETCHES))
    drawing, values = choices[number]
    return _fills(drawing, values, _PENS[pen], _STRETCHES[stretch])


@functools.cache
def looks(name: str, *, variant: str = "") -> tuple[tuple[str, tuple[str, ...]], ...]:
    """The equally frequent looks of a symbol: a drawing and the values written into it.

    Raises:
        DomainError: There is no such symbol.

    Examples:
        >>> looks("danger")
        (('danger', ()),)
    """
    entry = _file()["symbol"].get(name)
    if entry is None:
        raise DomainError(
            f"There is no traffic sign symbol {name!r}; draw one in symbols.toml or use one of: "
            + ", ".join(symbol_names())
        )
    drawings = entry.get(variant, entry["usual"])
    return tuple(
        (drawing, tuple(values))
        for drawing in drawings
        for values in _file()["drawing"][drawing].get("values", [[]])
    )


def symbol_names() -> tuple[str, ...]:
    """The symbols that can be drawn, in alphabetical order."""
    return tuple(sorted(_file()["symbol"]))


@functools.cache
def _file() -> dict[str, Any]:
    return tomllib.loads((files(__package__) / "symbols.toml").read_text(encoding="utf-8"))


@functools.cache
def _fills(drawing: str, values: tuple[str, ...], pen: float, stretch: float) -> tuple[Fill, ...]:
    """A drawing in the unit square; lines are `pen` times as wide, all `stretch` times."""
    areas = _areas(drawing, values, pen)
    low, high = _frame(drawing, areas)
    # What is placed in the field of a sign stays in its place: only its lines vary.
    across = 1.0 if "frame" in _file()["drawing"][drawing] else stretch
    scale = np.array([across, 1.0])
    size = float(((high - low) * scale).max())
    placed = [((points - (low + high) / 2.0) * scale / size + 0.5, role) for points, role in areas]
    return tuple(
        Fill(points=tuple((float(x), float(y)) for x, y in points.round(5)), role=role)
        for points, role in placed
    )


def _frame(drawing: str, areas: list[_Area]) -> tuple[Points, Points]:
    """The corners of what counts as the whole drawing: said in the file, or all that is drawn."""
    said = _file()["drawing"][drawing].get("frame")
    if said is not None:
        return np.array(said[:2], float), np.array(said[2:], float)
    points = np.vstack([outline for outline, _ in areas])
    return points.min(axis=0), points.max(axis=0)


def _areas(drawing: str, values: tuple[str, ...], pen: float) -> list[_Area]:
    entry = _file()["drawing"][drawing]
    areas = [area for part in entry["parts"] for area in _part(part, values, pen)]
    scale = np.array([entry.get("stretch", 1.0), 1.0])
    return [(points * scale, role) for points, role in areas]


def _part(part: Mapping[str, Any], values: tuple[str, ...], pen: float) -> list[_Area]:
    role = part.get("role", "ink")
    width = part.get("width", 0.0) * pen
    if "use" in part:
        return _used(part, values, pen)
    if "text" in part:
        return [(outline, role) for outline in _text(part, values, pen)]
    if "circle" in part:
        x, y, radius = part["circle"]
        disc = arc((x, y), radius)[:-1]
        outlines = stroke(disc, width=width, closed=True) if width else [disc]
        return [(outline, role) for outline in outlines]
    if "arc" in part:
        x, y, radius, start, stop = part["arc"]
        line = arc((x, y), radius, start=start, stop=stop)
        return [(outline, role) for outline in stroke(line, width=width)]
    if "stroke" in part:
        return [
            (outline, role)
            for line, closed in flatten(part["stroke"])
            for outline in stroke(line, width=width, closed=closed)
        ]
    return [(line, role) for line, _ in flatten(part["fill"])]


def _used(part: Mapping[str, Any], values: tuple[str, ...], pen: float) -> list[_Area]:
    """Another drawing, where it is or in a box x, y, width, height; mirrored and turned."""
    areas = _areas(part["use"], values, pen)
    low, high = _frame(part["use"], areas)
    x, y, across, down = part.get("box", (*low, *(high - low)))
    corner, size = np.array([x, y], float), np.array([across, down], float)
    centre = corner + size / 2.0
    placed = []
    for points, role in areas:
        share = (points - low) / (high - low)
        if part.get("mirrored", False):
            share[:, 0] = 1.0 - share[:, 0]
        in_box = turned(corner + share * size, part.get("turned", 0.0), centre=centre)
        placed.append((in_box, part.get("role", role)))
    return placed


def _text(part: Mapping[str, Any], values: tuple[str, ...], pen: float) -> list[Points]:
    """The glyphs of a text of some height, centred on a point, as outlines."""
    text = part["text"].format(*values)
    height = part["height"]
    scale = np.array([part.get("stretch", 1.0), 1.0]) * height / 100.0
    weight = part.get("weight", 0.16) * height * pen
    # The pen runs inside the letter: its outer edges are as far apart as the letter is high.
    inside = 1.0 - weight / height
    gap = part.get("gap", 16.0) * height / 100.0 + weight
    outlines: list[Points] = []
    start = 0.0
    for letter in text:
        for path in _file()["glyph"][letter]["strokes"]:
            for line, closed in flatten(path):
                at = line * scale * inside + [start, weight / 2.0]
                outlines += stroke(at, width=weight, closed=closed)
        start += _file()["glyph"][letter]["across"] * scale[0] * inside + gap
    points = np.vstack(outlines)
    middle = (points.min(axis=0)[0] + points.max(axis=0)[0]) / 2.0
    offset = np.array([part["centre"][0] - middle, part["centre"][1] - height / 2.0])
    return [outline + offset for outline in outlines]
