"""Rows of things.csv for the things of a drawn picture: their boxes, from left to right."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from seewhy_lab.rendering.vectors import Array

__all__ = ["boxes", "thing_rows"]

Box = tuple[int, int, int, int]
"""Left, top, right and bottom, in pixels; right and bottom are the first that lie outside."""


def boxes(seen: Array, count: int) -> list[Box]:
    """Left, top, right and bottom of what is seen of each thing, in pixels.

    Right and bottom are the first that lie outside.

    Raises
    ------
    ValueError
        Where nothing is seen of a thing.

    Examples
    --------
    >>> boxes(np.array([[-1, 0, 0], [-1, 0, -1]]), 1)
    [(1, 0, 3, 2)]
    """
    found = []
    for number in range(count):
        rows, columns = np.nonzero(seen == number)
        if not len(rows):
            raise ValueError("no pixel shows one of the things; make larger pictures (--size)")
        found.append(
            (
                int(columns.min()),
                int(rows.min()),
                int(columns.max()) + 1,
                int(rows.max()) + 1,
            )
        )
    return found


def thing_rows(
    found: Sequence[Box], values: Sequence[Mapping[str, str]]
) -> tuple[list[dict[str, str | int]], dict[int, str]]:
    """Return a row a thing, from left to right, and what each thing is called in them.

    Examples
    --------
    >>> rows, names = thing_rows([(6, 0, 8, 2), (0, 0, 4, 4)], [{"colour": "red"}, {}])
    >>> names
    {1: '1', 0: '2'}
    >>> rows[1]
    {'thing': '2', 'left': 6, 'top': 0, 'right': 8, 'bottom': 2, 'colour': 'red'}
    """
    order = sorted(range(len(found)), key=lambda number: found[number][0] + found[number][2])
    names = {number: str(place) for place, number in enumerate(order, start=1)}
    sides = ("left", "top", "right", "bottom")
    rows: list[dict[str, str | int]] = [
        {
            "thing": names[number],
            **dict(zip(sides, found[number], strict=True)),
            **values[number],
        }
        for number in order
    ]
    return rows, names
