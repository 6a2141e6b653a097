"""Random tables: things side by side and stacked, as hands leave them."""

from __future__ import annotations

import math
from itertools import combinations

import numpy as np

from seewhy_lab.simulators.tabletop.table import (
    COLOURS,
    MATERIALS,
    SHAPES,
    SIZES,
    Table,
    TableThing,
    half_extent,
)

__all__ = ["MOST", "random_table", "told_apart"]

MOST = 6
"""The most things on a table."""

_HALF_LENGTH, _HALF_DEPTH = 0.150, 0.105  # Of the part of the table on which things are put.
_GAP = 0.007  # Between two things side by side, at least, in metres.
_APART = 0.010  # How much nearer, and how much further left, one of two stacks is, at least.
_STACKED = 0.45  # How often a thing is put on another, where it can be.
_HIGHEST = 3  # Things in a stack, at most.
_OFF = 0.30  # How far off the middle of its support a thing is put, in half widths of the support.
_ATTEMPTS = 40


def random_table(rng: np.random.Generator, *, count: int) -> Table:
    """So many things, at most six, in the order in which they were put down.

    Nothing is put on a ball, no large thing on a small one, and no two on the same.

    Examples
    --------
    >>> len(random_table(np.random.default_rng(0), count=MOST).things)
    6
    """
    while True:
        things: list[TableThing] = []
        while len(things) < count:
            thing = _next_thing(things, rng)
            if thing is None:
                break
            things.append(thing)
        else:
            return Table(tuple(things))


def _next_thing(things: list[TableThing], rng: np.random.Generator) -> TableThing | None:
    """One more thing; None where there is no room for it."""
    shape, size = str(rng.choice(SHAPES)), str(rng.choice(SIZES))
    colour, material = str(rng.choice(COLOURS)), str(rng.choice(MATERIALS))
    scale, yaw = float(rng.uniform(0.95, 1.05)), float(rng.uniform(0.0, 2.0 * math.pi))
    supports = [number for number in range(len(things)) if _carries(things, number, size)]
    on_top = bool(supports) and rng.uniform() < _STACKED

    def placed(x: float, y: float, level: float, support: int | None) -> TableThing:
        return TableThing(
            shape=shape,
            size=size,
            colour=colour,
            material=material,
            x=x,
            y=y,
            z=level + half_extent(shape, size)[1] * scale,
            yaw=yaw,
            support=support,
            scale=scale,
        )

    if on_top:
        number = int(rng.choice(supports))
        below = things[number]
        off, towards = _OFF * below.half[0] * rng.uniform(), rng.uniform(0.0, 2.0 * math.pi)
        return placed(
            below.x + off * math.cos(towards), below.y + off * math.sin(towards), below.top, number
        )
    for _ in range(_ATTEMPTS):
        x = float(rng.uniform(-_HALF_LENGTH, _HALF_LENGTH))
        y = float(rng.uniform(-_HALF_DEPTH, _HALF_DEPTH))
        thing = placed(x, y, 0.0, None)
        if all(_has_room(thing, other) for other in things):
            return thing
    return None


def _carries(things: list[TableThing], number: int, size: str) -> bool:
    """Whether a thing of a size can be put on one of those that are there."""
    below = things[number]
    if below.shape == "sphere" or (below.size == "small" and size == "large"):
        return False
    if any(thing.support == number for thing in things):
        return False
    height = 1
    while below.support is not None:
        below, height = things[below.support], height + 1
    return height < _HIGHEST


def _has_room(thing: TableThing, other: TableThing) -> bool:
    apart = math.hypot(thing.x - other.x, thing.y - other.y)
    return apart >= thing.reach + other.reach + _GAP


def told_apart(table: Table, azimuth: float) -> bool:
    """Whether one can tell from there of any two stacks which is nearer, and which further left."""
    places = table.places(azimuth)
    feet = [places[number] for number in range(len(places)) if table.foot(number) == number]
    return all(
        abs(one[0] - other[0]) > _APART and abs(one[1] - other[1]) > _APART
        for one, other in combinations(feet, 2)
    )
