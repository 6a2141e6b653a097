"""Outlines as point sequences: paths flattened and strokes widened.

Every function answers arrays of shape (n, 2), one row per point, in the units it was given.
"""

from __future__ import annotations

import math
import re

import numpy as np
from numpy.typing import NDArray

__all__ = ["Points", "arc", "flatten", "stroke", "turned"]

Points = NDArray[np.float64]

_TOKEN = re.compile(r"[MLQCZ]|-?\d*\.?\d+")
_ARGUMENTS = {"M": 1, "L": 1, "Q": 2, "C": 3}
_SHARPEST_MITRE = 0.35  # Below this 1 + cosine of the turn a corner is cut off, not pointed.


def flatten(path: str, *, steps: int = 6) -> list[tuple[Points, bool]]:
    """The lines of a path in the notation of SVG, and whether each is closed.

    The commands are M, L, Q, C and Z, all in absolute coordinates; points after a command repeat
    it, those after M as L. A curve becomes `steps` straight pieces.

    Raises:
        ValueError: The path does not start with M or holds anything else.

    Examples:
        >>> [(line.tolist(), closed) for line, closed in flatten("M0 0 L2 0 2 1 Z")]
        [([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0]], True)]
    """
    tokens = _TOKEN.findall(path)
    if not tokens or tokens[0] != "M" or _TOKEN.sub("", path).strip(" ,\n"):
        raise ValueError(f"the path {path!r} is no sequence of M, L, Q, C, Z and numbers")
    lines: list[tuple[list[Points], bool]] = []
    command, at = "M", 0
    while at < len(tokens):
        if tokens[at].isalpha():
            command = tokens[at]
            at += 1
            if command == "Z":
                lines[-1] = (lines[-1][0], True)
                continue
        count = 2 * _ARGUMENTS[command]
        numbers = [float(token) for token in tokens[at : at + count]]
        if len(numbers) < count:
            raise ValueError(f"the path {path!r} ends in the middle of a {command}")
        at += count
        points = np.array(numbers).reshape(-1, 2)
        if command == "M":
            lines.append(([points], False))
            command = "L"
        else:
            line = lines[-1][0]
            line.append(_curve(np.vstack([line[-1][-1:], points]), steps=steps))
    return [(np.vstack(line), closed) for line, closed in lines]


def _curve(control: Points, *, steps: int) -> Points:
    """Points on a Bezier curve without its start, by repeated interpolation."""
    if len(control) == 2:
        return control[1:]
    share = np.linspace(0.0, 1.0, steps + 1)[1:, None, None]
    level = np.broadcast_to(control, (steps, *control.shape))
    while level.shape[1] > 1:
        level = level[:, :-1] * (1.0 - share) + level[:, 1:] * share
    return np.asarray(level[:, 0])


def arc(
    centre: tuple[float, float], radius: float, *, start: float = 0.0, stop: float = 360.0
) -> Points:
    """Points on an arc from angle `start` to `stop`, in degrees from the x axis towards y.

    Examples:
        >>> arc((0.0, 0.0), 1.0, stop=90.0).round(3).tolist()[-1]
        [0.0, 1.0]
    """
    count = max(3, math.ceil(abs(stop - start) / 18.0) + 1)
    angles = np.radians(np.linspace(start, stop, count))
    points: Points = np.stack([np.cos(angles), np.sin(angles)], axis=1) * radius + centre
    return points


def stroke(line: Points, *, width: float, closed: bool = False) -> list[Points]:
    """The outline of a line drawn with a pen of `width`, with mitred corners and cut ends.

    A closed line becomes two outlines that overlap a little, so that no outline has a hole.

    Examples:
        >>> [outline.tolist() for outline in stroke(np.array([[0, 0], [4, 0]]), width=2.0)]
        [[[0.0, 1.0], [4.0, 1.0], [4.0, -1.0], [0.0, -1.0]]]
        >>> len(stroke(arc((0.0, 0.0), 3.0), width=1.0, closed=True))
        2
    """
    line = line[np.append(True, np.abs(np.diff(line, axis=0)).sum(axis=1) > 1e-9)].astype(float)
    if closed and np.allclose(line[0], line[-1]):
        line = line[:-1]
    one = _beside(line, width / 2.0, closed=closed)
    other = _beside(line, -width / 2.0, closed=closed)
    if not closed:
        return [np.vstack([one, other[::-1]])]
    half = len(one) // 2
    first, second = np.arange(half + 2), np.arange(half, len(one) + 2)
    return [
        np.vstack([one.take(part, 0, mode="wrap"), other.take(part[::-1], 0, mode="wrap")])
        for part in (first, second)
    ]


def _beside(line: Points, distance: float, *, closed: bool) -> Points:
    """The line `distance` to the side of another; sharp corners are cut off."""
    ends = np.roll(line, -1, axis=0) if closed else line[1:]
    along = ends - line[: len(ends)]
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    normals = np.stack([-along[:, 1], along[:, 0]], axis=1)
    count = len(normals)
    points: list[Points] = []
    for number, point in enumerate(line):
        before = normals[(number - 1) % count if closed else max(number - 1, 0)]
        after = normals[number % count if closed else min(number, count - 1)]
        turn = 1.0 + float(before @ after)
        if turn < _SHARPEST_MITRE:
            points += [point + distance * before, point + distance * after]
        else:
            points.append(point + distance * (before + after) / turn)
    return np.array(points)


def turned(points: Points, degrees: float, *, centre: Points) -> Points:
    """The points turned about `centre`, from the x axis towards y."""
    angle = math.radians(degrees)
    turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    about: Points = (points - centre) @ turn + centre
    return about
