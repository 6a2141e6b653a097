"""Irregularities of surfaces."""

from __future__ import annotations

import math

import numpy as np

from seewhy_lab.rendering.vectors import Array

__all__ = ["waves"]


def waves(at: Array, rng: np.random.Generator, *, wavelength: float, count: int = 4) -> Array:
    """Smooth noise of a wavelength in metres, from -1 to 1, at places of shape (3, n).

    Examples
    --------
    >>> waves(np.zeros((3, 2), np.float32), np.random.default_rng(0), wavelength=0.1).shape
    (2,)
    """
    directions = rng.normal(size=(count, 3)) * (2.0 * math.pi / wavelength / math.sqrt(2.0))
    phases = rng.uniform(0.0, 2.0 * math.pi, (count, 1))
    angles = directions.astype(np.float32) @ at + phases.astype(np.float32)
    return np.asarray(np.sin(angles).mean(axis=0))
