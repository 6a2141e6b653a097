"""Pictures of a structure, ray-cast with MuJoCo: no OpenGL, no display.

One ray a pixel finds what is seen; pixels on an edge get more, so that edges are smooth.
`lighting` then asks what light arrives at each point, `surfaces` gives the colour, and the
camera makes a picture of it: lens, sensor and tone curve.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from seewhy.domains.structure_stability import lighting
from seewhy.domains.structure_stability.rays import Array, Scene
from seewhy.domains.structure_stability.structure import Structure
from seewhy.domains.structure_stability.surfaces import background, shade
from seewhy.domains.structure_stability.view import View

__all__ = ["render"]

# Where the rays through a pixel on an edge go: no two share a row or a column, so that nearly
# upright and nearly level edges come out smooth as well.
_ROTATED_GRID = np.array([(1, 5), (3, 1), (5, 7), (7, 3)]) / 8.0
_SUBSAMPLES = len(_ROTATED_GRID)
# Up to this size in pixels one light a point is enough; in larger pictures the steps would show.
_SMALL = 160


def _develop(light: Array, view: View, rng: np.random.Generator) -> NDArray[np.uint8]:
    """From linear light to the picture: lens, sensor and tone curve."""
    size = light.shape[0]
    axis = (np.arange(size, dtype=np.float32) + 0.5) / size * 2.0 - 1.0
    radius = axis[:, None] ** 2 + axis[None, :] ** 2
    light = light * (view.exposure * (1.0 - view.vignette * radius / 2.0))[..., None]
    # A lens is never quite sharp.
    padded = np.pad(light, ((1, 1), (0, 0), (0, 0)), mode="edge")
    light = 0.12 * padded[:-2] + 0.76 * padded[1:-1] + 0.12 * padded[2:]
    padded = np.pad(light, ((0, 0), (1, 1), (0, 0)), mode="edge")
    light = 0.12 * padded[:, :-2] + 0.76 * padded[:, 1:-1] + 0.12 * padded[:, 2:]
    # Filmic curve of Narkowicz (2016), which rolls highlights off as film does.
    light = np.maximum(light, 0.0) * 0.85
    light = light * (2.51 * light + 0.03) / (light * (2.43 * light + 0.59) + 0.14)
    picture = np.clip(light, 0.0, 1.0) ** (1.0 / 2.2)
    grain = rng.standard_normal(picture.shape, dtype=np.float32) * 0.6
    grain += rng.standard_normal(picture.shape[:2], dtype=np.float32)[..., None] * 0.8
    picture = picture + view.noise * grain * (1.2 - 0.6 * picture)
    return np.asarray(np.clip(picture * 255.0 + 0.5, 0.0, 255.0), dtype=np.uint8)


class _Camera:
    """Rays through places of the frame, which are counted in pixels from its upper left corner."""

    def __init__(self, view: View, size: int) -> None:
        level = math.cos(view.elevation)
        self._size = size
        self._half = math.tan(view.lens / 2.0)
        self._right = np.array([math.cos(view.azimuth), math.sin(view.azimuth), 0.0])
        self._back = np.array(
            [
                level * math.sin(view.azimuth),
                -level * math.cos(view.azimuth),
                math.sin(view.elevation),
            ]
        )
        self._up = np.cross(self._back, self._right)
        self.eye: Array = np.array(view.aim) + self._back * (view.frame / 2.0 / self._half)

    def rays(self, rows: Array, columns: Array) -> Array:
        """Directions, shape (n, 3), through the given places."""
        right = (2.0 * columns / self._size - 1.0)[:, None]
        up = (1.0 - 2.0 * rows / self._size)[:, None]
        rays: Array = self._half * (right * self._right + up * self._up) - self._back
        return rays


def _on_edge(label: Array) -> Array:
    """Numbers of the pixels beside which another face is seen."""
    edge = np.zeros(label.shape, bool)
    down, across = label[1:] != label[:-1], label[:, 1:] != label[:, :-1]
    edge[1:] |= down
    edge[:-1] |= down
    edge[:, 1:] |= across
    edge[:, :-1] |= across
    return np.flatnonzero(edge)


def render(structure: Structure, view: View, *, size: int = 112) -> NDArray[np.uint8]:
    """The picture of a structure, shape (size, size, 3).

    A larger `size` shows the same scene in more detail.
    """
    scene, camera = Scene(structure), _Camera(view, size)
    rng = np.random.default_rng([view.texture, 1])
    lights = np.stack(
        [
            lighting.lamp_points(view, rng.uniform(0.0, 2.0 * math.pi)),
            lighting.sky_points(rng.uniform(0.0, 2.0 * math.pi)),
        ]
    )
    pixels = size * size
    rows, columns = np.divmod(np.arange(pixels), size)
    coarse_rays = camera.rays(rows + 0.5, columns + 0.5)
    coarse = scene.look(camera.eye, coarse_rays)
    on_edge = _on_edge(coarse.label.reshape(size, size))
    pixel = np.repeat(on_edge, _SUBSAMPLES)
    within = np.tile(_ROTATED_GRID, (len(on_edge), 1))
    fine_rays = camera.rays(rows[pixel] + within[:, 0], columns[pixel] + within[:, 1])
    fine = scene.look(camera.eye, fine_rays)

    # A ray on an edge takes its light from a pixel nearby that shows the same face; only those
    # that find none ask the lights themselves.
    alike = lighting.nearest_alike(coarse.label, fine.label, pixel, size)
    alone = np.flatnonzero(alike < 0)
    seen = lighting.visible(
        scene,
        coarse.followed_by(fine.take(alone)),
        lights,
        lighting.ask_order(
            np.concatenate([rows, rows[pixel[alone]]]),
            np.concatenate([columns, columns[pixel[alone]]]),
        ),
        asks=1 if size <= _SMALL else 4,
    )
    shared = lighting.share([values[:pixels] for values in seen], coarse.label, size)

    hits = coarse.followed_by(fine)
    hit = hits.geom >= 0
    hit[on_edge] = False  # The rays through the pixel replace the one through its middle.
    arrived = []
    for new, old in zip(shared, seen, strict=True):
        on_fine = new[alike]
        on_fine[alone] = old[pixels:]
        arrived.append(np.concatenate([new, on_fine])[hit])
    lamp, lamp_possible, sky, sky_possible = arrived
    colour = np.zeros((len(hits.geom), 3), np.float32)
    colour[hit] = shade(
        hits.take(np.flatnonzero(hit)),
        scene,
        structure,
        view,
        eye=camera.eye,
        lit=lamp / np.maximum(lamp_possible, 1e-6),
        open_sky=sky / np.maximum(sky_possible, 1e-6),
    )
    empty = hits.geom < 0
    place = np.stack([columns, rows], axis=1) * (2.0 / size) - 1.0
    colour[empty] = background(
        np.concatenate([coarse_rays, fine_rays])[empty],
        np.concatenate([place, place[pixel]])[empty],
        view,
    )
    picture = colour[:pixels]
    picture[on_edge] = colour[pixels:].reshape(-1, _SUBSAMPLES, 3).mean(axis=1)
    return _develop(picture.reshape(size, size, 3), view, rng)
