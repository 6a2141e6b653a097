"""Where boxes lie and how large they are, as numbers that heads look at."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from seewhy.perception.things.boxes import Boxes

__all__ = ["of_boxes", "of_pairs"]

Floats = npt.NDArray[np.float32]


def of_boxes(boxes: Boxes, size: tuple[int, int]) -> Floats:
    """Numbers of each box in a picture of some width and height.

    Its place, its lengths in logarithms, and products of two of them: on a picture taken at a
    slant, how large a thing looks depends on how near it is.

    Examples
    --------
    >>> of_boxes(np.array([[0.0, 0, 10, 20]]), (100, 50)).shape
    (1, 20)
    """
    longest = float(max(size))
    shares = boxes / longest
    wide = np.maximum(shares[:, 2] - shares[:, 0], 1e-4)
    high = np.maximum(shares[:, 3] - shares[:, 1], 1e-4)
    plain = np.stack(
        [
            (shares[:, 0] + shares[:, 2]) / 2 - size[0] / longest / 2,
            (shares[:, 1] + shares[:, 3]) / 2 - size[1] / longest / 2,
            shares[:, 3],
            np.log(wide),
            np.log(high),
        ],
        axis=1,
    )
    return _with_products(plain)


def of_pairs(boxes: Boxes, pairs: npt.NDArray[np.int64]) -> Floats:
    """Numbers of each pair of boxes: how the second lies to the first, in lengths of both.

    Parameters
    ----------
    boxes : ndarray of float, shape (n, 4)
    pairs : ndarray of int, shape (pairs, 2)

    Examples
    --------
    >>> boxes = np.array([[0.0, 0, 10, 10], [0, 10, 10, 20]])
    >>> of_pairs(boxes, np.array([[0, 1]])).shape
    (1, 54)
    """
    first, second = boxes[pairs[:, 0]], boxes[pairs[:, 1]]
    lengths = [np.maximum(one[:, 2:] - one[:, :2], 1e-6) for one in (first, second)]
    unit = np.sqrt(lengths[0] * lengths[1])
    between = ((second[:, :2] + second[:, 2:]) - (first[:, :2] + first[:, 2:])) / 2 / unit
    # Where one ends and the other begins tells whether they touch.
    below = (second[:, 1] - first[:, 3]) / unit[:, 1]
    above = (first[:, 1] - second[:, 3]) / unit[:, 1]
    bottoms = (second[:, 3] - first[:, 3]) / unit[:, 1]
    common = np.minimum(first[:, 2], second[:, 2]) - np.maximum(first[:, 0], second[:, 0])
    across = common / np.minimum(lengths[0][:, 0], lengths[1][:, 0])
    high = np.minimum(first[:, 3], second[:, 3]) - np.maximum(first[:, 1], second[:, 1])
    shared = np.maximum(common, 0.0) * np.maximum(high, 0.0)
    together = shared / (lengths[0].prod(axis=1) + lengths[1].prod(axis=1) - shared)
    ratios = np.log(lengths[1] / lengths[0])
    plain = np.stack([*between.T, below, above, bottoms, across, together, *ratios.T], axis=1)
    return _with_products(np.clip(plain, -4.0, 4.0))


def _with_products(plain: npt.NDArray[np.float64]) -> Floats:
    """Numbers, and the product of every two of them."""
    first, second = np.triu_indices(plain.shape[1])
    return np.concatenate([plain, plain[:, first] * plain[:, second]], axis=1).astype(np.float32)
