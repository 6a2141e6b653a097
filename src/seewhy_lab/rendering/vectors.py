"""Vectors in rows, shape (n, 3), as MuJoCo has them, or in columns, (3, n), which are faster."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["Array", "along", "column", "dot", "unit"]

Array = NDArray[Any]


def dot(one: Array, other: Array) -> Array:
    """The scalar products of the rows of two arrays of shape (n, 3), shape (n,)."""
    return np.asarray(np.einsum("ij,ij->i", one, other))


def along(one: Array, other: Array) -> Array:
    """The scalar products of vectors, from (3, n) to (n,)."""
    return np.asarray(one[0] * other[0] + one[1] * other[1] + one[2] * other[2])


def unit(vectors: Array) -> Array:
    """Vectors of length 1, shape (3, n).

    Examples
    --------
    >>> unit(column((0, 3, 4))).ravel().tolist()
    [0.0, 0.6000000238418579, 0.800000011920929]
    """
    return np.asarray(vectors / np.sqrt(along(vectors, vectors)))


def column(values: Any) -> Array:
    """Three numbers, shape (3, 1)."""
    return np.array(values, np.float32)[:, None]
