"""What is seen of each thing on a table, and whether that is enough to speak of it."""

from __future__ import annotations

import numpy as np

from seewhy_lab.rendering.rays import Scene
from seewhy_lab.rendering.vectors import Array
from seewhy_lab.simulators.tabletop.view import View, camera_of

__all__ = ["LEAST_PIXELS", "LEAST_SHARE", "seen_things", "well_seen"]

LEAST_PIXELS = 60
"""So many pixels of a thing are seen at least, in a picture of 320 by 240, ..."""
LEAST_SHARE = 0.25
"""... and so much of what there would be to see of it if it stood alone."""

_CHECKED = 160  # Width of the pictures in which that is counted.
_WHOLE = 320


def seen_things(scene: Scene, view: View, *, size: int) -> Array:
    """For each pixel the number of the thing seen there; -1 none. Shape (3/4 size, size)."""
    camera = camera_of(view, size=size)
    geom, _, _ = scene.cast(camera.eye, _rays(view, size))
    seen: Array = np.maximum(geom - 1, -1).reshape(camera.shape)
    return seen


def _rays(view: View, size: int) -> Array:
    camera = camera_of(view, size=size)
    rows, columns = np.divmod(np.arange(camera.shape[0] * camera.shape[1]), camera.shape[1])
    rays: Array = camera.rays(rows + 0.5, columns + 0.5)
    return rays


def well_seen(scene: Scene, view: View, count: int) -> bool:
    """Whether enough is seen of each of `count` things, and none reaches out of the picture."""
    seen = seen_things(scene, view, size=_CHECKED)
    shown = np.bincount(seen.ravel() + 1, minlength=count + 1)[1:]
    if (shown * (_WHOLE / _CHECKED) ** 2 < LEAST_PIXELS).any():
        return False
    camera = camera_of(view, size=_CHECKED)
    rays = _rays(view, _CHECKED)
    for number in range(count):
        geom, _, _ = scene.cast(camera.eye, rays, group=number)
        alone = (geom >= 0).reshape(camera.shape)
        if alone[[0, -1]].any() or alone[:, [0, -1]].any():
            return False
        if shown[number] < LEAST_SHARE * alone.sum():
            return False
    return True
