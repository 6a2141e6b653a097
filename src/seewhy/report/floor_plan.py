"""Draw places and what is in them: what is believed beside what is true."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape

import numpy as np

from seewhy.report.figure import Figure

_WIDTH, _HEIGHT, _ROOM, _TALL, _EDGE = 620, 380, 128, 62, 78
_LEAST_APART = 1e-9


@dataclass(frozen=True)
class Occupant:
    """A thing in a place; ``believed`` and ``true`` say whether each holds."""

    name: str
    believed: bool
    true: bool
    is_robot: bool = False


def layout(
    places: Sequence[str], links: Sequence[tuple[str, str]]
) -> dict[str, tuple[float, float]]:
    """Return where to draw places, from 0 to 1, so that linked ones are near each other.

    Examples
    --------
    >>> at = layout(["a", "b", "c"], [("a", "b"), ("b", "c")])
    >>> sorted(at)
    ['a', 'b', 'c']
    """
    from scipy.sparse.csgraph import shortest_path
    from sklearn.manifold import MDS

    number = {place: index for index, place in enumerate(places)}
    near = np.zeros((len(places), len(places)))
    for one, other in links:
        near[number[one], number[other]] = near[number[other], number[one]] = 1.0
    apart = shortest_path(near, directed=False, unweighted=True)
    apart[~np.isfinite(apart)] = len(places)
    placed = MDS(
        n_components=2, metric="precomputed", random_state=0, n_init=8, init="random"
    ).fit_transform(apart)
    # The longest extent lies across the page.
    centred = placed - placed.mean(axis=0)
    _, _, axes = np.linalg.svd(centred, full_matrices=False)
    turned = centred @ axes.T
    low, high = turned.min(axis=0), turned.max(axis=0)
    scaled = (turned - low) / np.maximum(high - low, _LEAST_APART)
    return {place: (float(x), float(y)) for place, (x, y) in zip(places, scaled, strict=True)}


def draw_floor_plan(
    at: Mapping[str, tuple[float, float]],
    links: Sequence[tuple[str, str]],
    names: Mapping[str, str],
    occupants: Mapping[str, Sequence[Occupant]],
    *,
    path: Sequence[str] = (),
    shaded: Sequence[str] = (),
) -> Figure:
    """Draw the places with who is there, and the way that was gone.

    Filled: believed and so; hollow: believed and not so; dashed: so and not believed.
    """
    centre = {
        place: (
            _EDGE + x * (_WIDTH - 2 * _EDGE),
            _TALL * 0.75 + y * (_HEIGHT - 1.5 * _TALL),
        )
        for place, (x, y) in at.items()
    }
    parts = [
        "<defs><marker id='tip' viewBox='0 0 8 8' refX='7' refY='4' markerWidth='7' "
        "markerHeight='7' orient='auto'><path d='M0 0L8 4L0 8z' fill='#2f6fb3'/></marker></defs>"
    ]
    for one, other in links:
        (x, y), (u, v) = centre[one], centre[other]
        parts.append(f"<path d='M{x:.0f} {y:.0f}L{u:.0f} {v:.0f}' stroke='#bbb' stroke-width='6'/>")
    for number, (one, other) in enumerate(itertools.pairwise(path)):
        if one != other:
            (x, y), (u, v) = centre[one], centre[other]
            shift = 3 * (number % 5) - 6
            middle = f"{(x + u) / 2 + shift:.0f} {(y + v) / 2 + shift:.0f}"
            parts.append(
                f"<path d='M{x + shift:.0f} {y + shift:.0f}L{middle}L{u + shift:.0f} "
                f"{v + shift:.0f}' stroke='#2f6fb3' stroke-width='1.6' fill='none' "
                "marker-mid='url(#tip)' opacity='0.75'/>"
            )
    for place, (x, y) in centre.items():
        fill = "#f3dede" if place in shaded else "#fafafa"
        parts.append(
            f"<rect x='{x - _ROOM / 2:.0f}' y='{y - _TALL / 2:.0f}' width='{_ROOM}' "
            f"height='{_TALL}' rx='8' fill='{fill}' stroke='#888'/>"
            f"<text x='{x:.0f}' y='{y - _TALL / 2 + 15:.0f}' text-anchor='middle' fill='#444'>"
            f"{escape(names[place])}</text>"
        )
        parts += _occupants(x, y, occupants.get(place, ()))
    return Figure(width=_WIDTH, height=_HEIGHT, content="".join(parts))


def _occupants(x: float, y: float, inside: Sequence[Occupant]) -> list[str]:
    parts = []
    for number, occupant in enumerate(inside):
        across = x + 30 * (number - (len(inside) - 1) / 2)
        down = y + 8
        colour = "#d2691e" if occupant.is_robot else "#2e7d4f"
        fill = colour if occupant.believed and occupant.true else "white"
        dash = " stroke-dasharray='3 2'" if occupant.true and not occupant.believed else ""
        parts.append(
            f"<circle cx='{across:.0f}' cy='{down - 4:.0f}' r='6' fill='{fill}' "
            f"stroke='{colour}' stroke-width='1.5'{dash}/>"
            f"<text x='{across:.0f}' y='{down + 16:.0f}' text-anchor='middle' font-size='10' "
            f"fill='{colour}'>{escape(occupant.name)}</text>"
        )
    return parts
