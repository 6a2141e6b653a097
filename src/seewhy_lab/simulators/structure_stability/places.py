"""Where the blocks of a drawn structure are in its picture, and which of them are displaced."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seewhy_lab.rendering.rays import Scene
from seewhy_lab.simulators.structure_stability.annotation import displaced_blocks
from seewhy_lab.simulators.structure_stability.generation import random_structure
from seewhy_lab.simulators.structure_stability.physics import build_model, release
from seewhy_lab.simulators.structure_stability.view import camera_of, random_view

__all__ = ["Places", "places"]


@dataclass(frozen=True, eq=False)
class Places:
    """Where blocks are in a picture.

    - `blocks`: for each pixel the number of the block that is seen there, 0 the lowest; -1 none.
      Shape (size, size).
    - `displaced`: the numbers of the blocks that lie beyond the edge of the one below.
    """

    blocks: NDArray[np.int32]
    displaced: tuple[int, ...]


def places(*, seed: int, index: int, size: int = 112) -> Places:
    """Finds the blocks in the picture that `draw` makes of the same `seed`, `index` and `size`.

    >>> found = places(seed=5, index=10)
    >>> sorted(set(found.blocks.ravel().tolist())), found.displaced
    ([-1, 0, 1], (1,))
    """
    rng = np.random.default_rng([seed, index])
    structure = random_structure(rng)
    release(structure, rng)  # draws from the same numbers before the view does
    scene = Scene(*build_model(structure))
    camera = camera_of(random_view(structure, rng), size=size)
    rows, columns = np.divmod(np.arange(size * size), size)
    geom, _, _ = scene.cast(camera.eye, camera.rays(rows + 0.5, columns + 0.5))
    blocks = np.maximum(geom - 1, -1)  # geom 0 is the table
    return Places(blocks.reshape(size, size), displaced_blocks(structure))
