"""Pictures of a table, ray-cast with MuJoCo: no OpenGL, no display."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from seewhy_lab.rendering.camera import develop
from seewhy_lab.rendering.lighting import disc_points, sky_points
from seewhy_lab.rendering.rays import Hits, Scene
from seewhy_lab.rendering.tracing import trace
from seewhy_lab.rendering.vectors import Array
from seewhy_lab.simulators.tabletop.surfaces import shade
from seewhy_lab.simulators.tabletop.table import Table
from seewhy_lab.simulators.tabletop.view import View, camera_of

__all__ = ["render"]


def render(scene: Scene, table: Table, view: View, *, size: int) -> NDArray[np.uint8]:
    """The picture of a table, shape (3/4 size, size, 3); `scene` is its model.

    A larger `size` shows the same table in more detail.
    """
    camera = camera_of(view, size=size)
    rng = np.random.default_rng([view.texture, 1])
    lamp = disc_points(view.lamp, view.lamp_size, rng.uniform(0.0, 2.0 * math.pi))
    sky = sky_points(rng.uniform(0.0, 2.0 * math.pi))

    def colour(hits: Hits, shares: list[Array]) -> Array:
        lit, open_sky = shares
        return shade(hits, scene, table, view, eye=camera.eye, lit=lit, open_sky=open_sky)

    light = trace(
        scene,
        camera,
        np.stack([lamp, sky]),
        shade=colour,
        # The table has no end, and the camera looks down.
        background=lambda rays, _: np.tile(view.room, (len(rays), 1)),
        asks=1,
    )
    return develop(light, rng, exposure=view.exposure, vignette=view.vignette, noise=view.noise)
