"""Products of matrices, on a thread that waits for no other."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
import numpy.typing as npt
import torch

from seewhy.perception.one_thread import one_thread

__all__ = ["matrix_product"]

Number = TypeVar("Number", np.float32, np.float64)


def matrix_product(left: npt.NDArray[Number], right: npt.NDArray[Number]) -> npt.NDArray[Number]:
    """``left @ right``, by PyTorch.

    NumPy's threads watch for the next product for a while, on cores that others could use: with few
    pictures at a time that takes the processor longer than all the networks.

    Parameters
    ----------
    left : ndarray of float, shape (n, k)
    right : ndarray of float, shape (k, m)

    Examples
    --------
    >>> row = np.ones((1, 2), dtype=np.float32)
    >>> matrix_product(row, row.T)
    array([[2.]], dtype=float32)
    """
    with one_thread():
        found: npt.NDArray[Number] = (torch.from_numpy(left) @ torch.from_numpy(right)).numpy()
    return found
