"""Pictures of an earlier training that a later one goes over again, lest they be forgotten."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

__all__ = ["Rehearsal"]


@dataclass(frozen=True)
class Rehearsal:
    """Pictures that networks to start from were trained on, with their labels.

    Use it where a few new pictures show some values only: trained on these alone, a network would
    forget the others. Every pass over the new pictures goes over as many of these, at most
    :data:`seewhy.perception.epochs.REHEARSED`, chosen anew each time.

    Parameters
    ----------
    pictures : ndarray of uint8, shape (n, size, size, 3)
    labels : mapping of str to sequence of str, length n
        Each feature's value in each picture.
    """

    pictures: npt.NDArray[np.uint8]
    labels: Mapping[str, Sequence[str]]
