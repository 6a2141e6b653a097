"""Boxes around things as arrays: how far they overlap, which are of one thing, in which order.

A box is a row of four numbers: left, top, right and bottom.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

__all__ = ["MATCHES_FROM", "Boxes", "in_order", "matched", "none_twice", "overlaps"]

Boxes = npt.NDArray[np.float64]

MATCHES_FROM = 0.5
"""Two boxes are of one thing from this share on of what both cover together."""


def overlaps(first: Boxes, second: Boxes) -> npt.NDArray[np.float64]:
    """Intersection over union of every box of one kind with every box of another.

    Examples
    --------
    >>> overlaps(np.array([[0.0, 0, 2, 2]]), np.array([[1.0, 0, 3, 2], [5, 5, 6, 6]])).round(3)
    array([[0.333, 0.   ]])
    """
    from_corner = np.maximum(first[:, None, :2], second[None, :, :2])
    to_corner = np.minimum(first[:, None, 2:], second[None, :, 2:])
    common = np.prod(np.maximum(to_corner - from_corner, 0.0), axis=2)
    areas = [
        np.prod(np.maximum(boxes[:, 2:] - boxes[:, :2], 0.0), axis=1) for boxes in (first, second)
    ]
    together = areas[0][:, None] + areas[1][None, :] - common
    found: npt.NDArray[np.float64] = common / np.maximum(together, 1e-9)
    return found


def none_twice(
    boxes: Boxes, scores: npt.NDArray[np.float64], *, above: float
) -> npt.NDArray[np.int64]:
    """Non-maximum suppression: the boxes that overlap no better one by more than ``above``.

    Examples
    --------
    >>> boxes = np.array([[0.0, 0, 10, 10], [0, 1, 10, 11], [20, 0, 30, 10]])
    >>> none_twice(boxes, np.array([0.5, 0.9, 0.4]), above=0.5).tolist()
    [1, 2]
    """
    kept: list[int] = []
    shares = overlaps(boxes, boxes)
    for number in np.argsort(-scores, kind="stable").tolist():
        if not kept or shares[number, kept].max() <= above:
            kept.append(number)
    return np.array(kept, dtype=np.int64)


def matched(found: Boxes, true: Boxes) -> npt.NDArray[np.int64]:
    """For each box that was found, the number of the true one that it is of; -1 where of none.

    Each true box is found once; together they overlap as far as can be.

    Examples
    --------
    >>> true = np.array([[0.0, 0, 10, 10], [20, 0, 30, 10]])
    >>> matched(np.array([[21.0, 0, 31, 10], [50, 0, 60, 10]]), true).tolist()
    [1, -1]
    """
    from scipy.optimize import linear_sum_assignment

    numbers = np.full(len(found), -1, dtype=np.int64)
    shares = overlaps(found, true)
    rows, columns = linear_sum_assignment(-np.where(shares >= MATCHES_FROM, shares, 0.0))
    for row, column in zip(rows, columns, strict=True):
        if shares[row, column] >= MATCHES_FROM:
            numbers[row] = column
    return numbers


def in_order(boxes: Boxes) -> npt.NDArray[np.int64]:
    """The places of boxes from the left to the right, by their middles; then from the top.

    Examples
    --------
    >>> in_order(np.array([[20.0, 0, 30, 10], [0, 5, 10, 15], [0, 0, 10, 10]])).tolist()
    [2, 1, 0]
    """
    across, down = boxes[:, 0] + boxes[:, 2], boxes[:, 1] + boxes[:, 3]
    return np.lexsort((down, across)).astype(np.int64)
