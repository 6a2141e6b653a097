"""What a centre map is to tell of annotated boxes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import torch

from seewhy.perception.things.boxes import Boxes

__all__ = ["Targets", "targets_of"]

_WIDTH = 0.13  # the deviation around a middle, in lengths of the box
_NARROWEST = 0.7  # cells
_NEAR = 0.5  # cells where the bell is higher learn the box


class Targets(NamedTuple):
    """What is to be told of each cell.

    Attributes
    ----------
    centres : tensor of float, shape (n, rows, columns)
        1 where the middle of a box lies, falling like a bell around it.
    boxes : tensor of float, shape (n, 4, rows, columns)
        The box of the nearest middle.
    weights : tensor of float, shape (n, rows, columns)
        How much a cell's box counts: those of a thing together 1.
    """

    centres: torch.Tensor
    boxes: torch.Tensor
    weights: torch.Tensor


def targets_of(boxes: Sequence[Boxes], shape: tuple[int, ...]) -> Targets:
    """The targets of pictures.

    Parameters
    ----------
    boxes : sequence of ndarray of float, shape (things, 4)
        Of each picture, in cells.
    shape : (int, int)
        Rows and columns.

    Examples
    --------
    >>> found = targets_of([np.array([[0.0, 0, 4, 4]])], (8, 8))
    >>> float(found.centres[0, 2, 2]), round(float(found.weights.sum()), 4)
    (1.0, 1.0)
    """
    rows, columns = shape
    centres = np.zeros((len(boxes), rows, columns), dtype=np.float32)
    sides = np.zeros((len(boxes), 4, rows, columns), dtype=np.float32)
    sides[:, 2:] = 1.0  # a box that is none has a length, too
    weights = np.zeros((len(boxes), rows, columns), dtype=np.float32)
    down, across = np.arange(rows)[:, None] + 0.5, np.arange(columns)[None, :] + 0.5
    for number, of_picture in enumerate(boxes):
        for box in of_picture:
            middle = ((box[0] + box[2]) / 2, (box[1] + box[3]) / 2)
            wide, high = (max(_NARROWEST, _WIDTH * (box[n + 2] - box[n])) for n in (0, 1))
            at = (min(rows - 1, int(middle[1])), min(columns - 1, int(middle[0])))
            # Around the cell in which the middle lies, so that its own value is 1.
            bell = np.exp(
                -((across - at[1] - 0.5) ** 2) / (2 * wide**2)
                - (down - at[0] - 0.5) ** 2 / (2 * high**2)
            )
            near = (bell >= _NEAR) & (bell > centres[number])
            sides[number][:, near] = box[:, None]
            weights[number][near] = (bell / bell[bell >= _NEAR].sum())[near]
            np.maximum(centres[number], bell, out=centres[number])
            centres[number][at] = 1.0
    return Targets(*(torch.from_numpy(array) for array in (centres, sides, weights)))
