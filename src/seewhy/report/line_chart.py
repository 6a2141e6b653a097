"""Draw lines with bands: a measure against a number of pictures, with its intervals."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

from seewhy.report.figure import CHARACTER, Figure, text_lines

__all__ = ["Line", "Point", "draw_lines"]

COLOURS = ("#2f6fb3", "#c8651b", "#3a8f5c", "#8a4fa3", "#8a7a2b", "#b33a5a", "#4f6d7a")
_WIDTH, _HEIGHT = 560, 340
_LEFT, _RIGHT, _TOP, _BOTTOM = 68, 14, 16, 48


@dataclass(frozen=True)
class Point:
    """A value, from 0 to 1, with the ends of its interval, at a labelled place."""

    label: str
    value: float
    low: float
    high: float


@dataclass(frozen=True)
class Line:
    """A named sequence of points; the labels of all lines of a chart are the same places."""

    name: str
    points: tuple[Point, ...]


def draw_lines(lines: Sequence[Line], labels: Sequence[str], *, across: str, up: str) -> Figure:
    """Draw lines with bands over evenly spaced labels; shares are written in per cent.

    A line that covers another is dashed, so that both are seen.

    Parameters
    ----------
    lines : sequence of Line
    labels : sequence of str
        The places from left to right.
    across, up : str
        What the axes show.

    Examples
    --------
    >>> line = Line("one", (Point("100", 0.5, 0.4, 0.6), Point("200", 0.7, 0.6, 0.8)))
    >>> draw_lines([line], ["100", "200"], across="pictures", up="right").width
    560
    """
    height = _HEIGHT + 18 * len(lines)
    wide, tall = _WIDTH - _LEFT - _RIGHT, _HEIGHT - _TOP - _BOTTOM
    low, high, step = _scale(lines)
    place = {
        label: _LEFT + wide * (n + 0.5) / max(1, len(labels)) for n, label in enumerate(labels)
    }

    def y(value: float) -> float:
        return _TOP + tall * (high - value) / (high - low)

    parts = [f"<rect width='{_WIDTH}' height='{height}' fill='white'/>"]
    tick = low
    while tick <= high + 1e-9:
        parts.append(
            f"<line x1='{_LEFT}' x2='{_WIDTH - _RIGHT}' y1='{y(tick):.1f}' y2='{y(tick):.1f}' "
            f"stroke='#ddd'/><text x='{_LEFT - 6}' y='{y(tick) + 4:.1f}' text-anchor='end' "
            f"fill='#555'>{100 * tick:.0f} %</text>"
        )
        tick += step
    for label, x in place.items():
        parts.append(
            f"<text x='{x:.1f}' y='{_HEIGHT - _BOTTOM + 18}' text-anchor='middle' fill='#555'>"
            f"{escape(label)}</text>"
        )
    parts.append(
        f"<text x='{_LEFT + wide / 2:.1f}' y='{_HEIGHT - 10}' text-anchor='middle'>"
        f"{escape(across)}</text>"
    )
    named, _ = text_lines(up, 0.0, 0.0, width=int(tall / CHARACTER), text_anchor="middle")
    parts.append(f"<g transform='translate(12 {_TOP + tall / 2:.1f}) rotate(-90)'>{named}</g>")
    for number, line in enumerate(lines):
        colour = COLOURS[number % len(COLOURS)]
        points = [point for point in line.points if point.label in place]
        band = [f"{place[point.label]:.1f},{y(point.high):.1f}" for point in points]
        band += [f"{place[point.label]:.1f},{y(point.low):.1f}" for point in reversed(points)]
        covers = any(line.points == other.points for other in lines[:number])
        dashes = " stroke-dasharray='8 8'" if covers else ""  # or the other's line is not seen
        path = " ".join(f"{place[point.label]:.1f},{y(point.value):.1f}" for point in points)
        parts.append(
            f"<polygon points='{' '.join(band)}' fill='{colour}' fill-opacity='0.15'/>"
            f"<polyline points='{path}' fill='none' stroke='{colour}' stroke-width='2'"
            f"{dashes}/>"
        )
        parts += [
            f"<circle cx='{place[point.label]:.1f}' cy='{y(point.value):.1f}' r='3' "
            f"fill='{colour}'><title>{escape(line.name)}, {escape(point.label)}: "
            f"{100 * point.value:.1f} % ({100 * point.low:.1f} to {100 * point.high:.1f} %)"
            "</title></circle>"
            for point in points
        ]
        base = _HEIGHT + 18 * number + 8
        parts.append(
            f"<rect x='{_LEFT}' y='{base - 4}' width='16' height='4' fill='{colour}'/>"
            f"<text x='{_LEFT + 22}' y='{base + 2}'>{escape(line.name)}</text>"
        )
    return Figure(_WIDTH, height, "".join(parts))


def _scale(lines: Sequence[Line]) -> tuple[float, float, float]:
    """Least and greatest value of the axis and the distance of its ticks: round shares."""
    values = [share for line in lines for point in line.points for share in (point.low, point.high)]
    least, most = (min(values), max(values)) if values else (0.0, 1.0)
    step = next(
        (distance for distance in (0.01, 0.02, 0.05, 0.1) if (most - least) / distance <= 7.0), 0.2
    )
    low = max(0.0, step * int(least / step + 1e-9))
    high = min(1.0, step * math.ceil(most / step - 1e-9))
    if high - low < step:
        low, high = max(0.0, low - step), min(1.0, high + step)
    return low, high, step
