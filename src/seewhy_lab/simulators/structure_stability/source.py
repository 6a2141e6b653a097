"""The image source of the domain: annotated pictures of simulated structures."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seewhy_lab.simulators.structure_stability.annotation import annotate
from seewhy_lab.simulators.structure_stability.generation import random_structure
from seewhy_lab.simulators.structure_stability.physics import release
from seewhy_lab.simulators.structure_stability.rendering import render
from seewhy_lab.simulators.structure_stability.structure import Structure
from seewhy_lab.simulators.structure_stability.view import random_view

__all__ = ["draw", "draw_structure"]


def draw(
    *, seed: int, index: int, size: int = 112
) -> tuple[NDArray[np.uint8], dict[str, str], str]:
    """Draws picture number `index` of the set that `seed` stands for.

    A picture depends on `seed`, `index` and `size` only: any number of workers in any order makes
    the same bytes. Another `size` shows the same scene at another resolution.

    Returns:
        The picture before the structure is let go, shape (size, size, 3); its features; and its
        class, ``"stable"`` or ``"unstable"``.
    """
    rng = np.random.default_rng([seed, index])
    structure = random_structure(rng)
    stable = release(structure, rng)
    picture = render(structure, random_view(structure, rng), size=size)
    return picture, annotate(structure), "stable" if stable else "unstable"


def draw_structure(structure: Structure, *, seed: int = 0, size: int = 112) -> NDArray[np.uint8]:
    """Draws a given structure in a random room, seen by a random camera."""
    rng = np.random.default_rng(seed)
    return render(structure, random_view(structure, rng), size=size)
