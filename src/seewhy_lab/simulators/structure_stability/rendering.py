"""Pictures of a structure, ray-cast with MuJoCo: no OpenGL, no display.

`seewhy_lab.rendering` finds what is seen and what light arrives at each point, `surfaces` gives the
colour, and the camera makes a picture of it: lens, sensor and tone curve.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from seewhy_lab.rendering.camera import develop
from seewhy_lab.rendering.lighting import disc_points, sky_points
from seewhy_lab.rendering.rays import Hits, Scene
from seewhy_lab.rendering.tracing import trace
from seewhy_lab.rendering.vectors import Array
from seewhy_lab.simulators.structure_stability.physics import build_model
from seewhy_lab.simulators.structure_stability.structure import Structure
from seewhy_lab.simulators.structure_stability.surfaces import background, shade
from seewhy_lab.simulators.structure_stability.view import View, camera_of

__all__ = ["render"]


def render(structure: Structure, view: View, *, size: int = 112) -> NDArray[np.uint8]:
    """The picture of a structure, shape (size, size, 3).

    A larger `size` shows the same scene in more detail.
    """
    scene = Scene(*build_model(structure))
    camera = camera_of(view, size=size)
    rng = np.random.default_rng([view.texture, 1])
    lamp = disc_points(view.lamp, view.lamp_size, rng.uniform(0.0, 2.0 * math.pi))
    sky = sky_points(rng.uniform(0.0, 2.0 * math.pi))

    def colour(hits: Hits, shares: list[Array]) -> Array:
        lit, open_sky = shares
        return shade(hits, scene, structure, view, eye=camera.eye, lit=lit, open_sky=open_sky)

    light = trace(
        scene,
        camera,
        np.stack([lamp, sky]),
        shade=colour,
        background=lambda rays, across: background(rays, across, view),
    )
    return develop(light, rng, exposure=view.exposure, vignette=view.vignette, noise=view.noise)
