"""How probable so many of so many are, where each is so with one probability."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["at_least"]


def at_least(successes: ArrayLike, trials: ArrayLike, share: float) -> NDArray[np.float64]:
    """Return the probability of at least so many successes.

    Parameters
    ----------
    successes, trials : array_like of int
    share : float
        Of a success, 0 to 1.

    Examples
    --------
    >>> at_least([0, 1, 2], 2, 0.5).tolist()
    [1.0, 0.75, 0.25]
    """
    from scipy.special import bdtrc  # answering needs none of it

    found: Any = bdtrc(np.asarray(successes) - 1, np.asarray(trials), share)
    return np.asarray(found, dtype=np.float64)
