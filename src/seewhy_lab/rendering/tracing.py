"""The light that reaches each pixel of a camera.

One ray a pixel finds what is seen; pixels on an edge get more, so that edges are smooth.
`lighting` then asks what light arrives at each point; which colour that makes, the caller says.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from seewhy_lab.rendering import lighting
from seewhy_lab.rendering.camera import Camera
from seewhy_lab.rendering.rays import Hits, Scene
from seewhy_lab.rendering.vectors import Array

__all__ = ["Background", "Shade", "trace"]

Shade = Callable[[Hits, list[Array]], Array]
"""The light that leaves points, shape (n, 3), given what share of each kind of light they see."""

Background = Callable[[Array, Array], Array]
"""The light, shape (n, 3), that comes along rays which meet nothing.

Given are their directions, shape (n, 3), and their places in the frame, shape (n, 2), from -1 to 1
towards the right and downwards.
"""

# Where the rays through a pixel on an edge go: no two share a row or a column, so that nearly
# upright and nearly level edges come out smooth as well.
_ROTATED_GRID = np.array([(1, 5), (3, 1), (5, 7), (7, 3)]) / 8.0
_SUBSAMPLES = len(_ROTATED_GRID)
# Up to this size in pixels one light a point is enough; in larger pictures the steps would show.
_SMALL = 160


def _on_edge(label: Array) -> Array:
    """Numbers of the pixels beside which another face is seen."""
    edge = np.zeros(label.shape, bool)
    down, across = label[1:] != label[:-1], label[:, 1:] != label[:, :-1]
    edge[1:] |= down
    edge[:-1] |= down
    edge[:, 1:] |= across
    edge[:, :-1] |= across
    return np.flatnonzero(edge)


def trace(
    scene: Scene,
    camera: Camera,
    lights: Array,
    *,
    shade: Shade,
    background: Background,
    asks: int | None = None,
) -> Array:
    """The light that reaches each pixel, linear, shape (height, width, 3).

    `lights` has shape (kinds, 16, 3): for each kind the points that its light comes from. `asks`
    is how many of them a pixel asks; more where the picture is large, if it is left out.
    """
    shape = camera.shape
    pixels = shape[0] * shape[1]
    if asks is None:
        asks = 1 if max(shape) <= _SMALL else 4
    rows, columns = np.divmod(np.arange(pixels), shape[1])
    coarse_rays = camera.rays(rows + 0.5, columns + 0.5)
    coarse = scene.look(camera.eye, coarse_rays)
    on_edge = _on_edge(coarse.label.reshape(shape))
    pixel = np.repeat(on_edge, _SUBSAMPLES)
    within = np.tile(_ROTATED_GRID, (len(on_edge), 1))
    fine_rays = camera.rays(rows[pixel] + within[:, 0], columns[pixel] + within[:, 1])
    fine = scene.look(camera.eye, fine_rays)

    # A ray on an edge takes its light from a pixel nearby that shows the same face; only those
    # that find none ask the lights themselves.
    alike = lighting.nearest_alike(coarse.label, fine.label, pixel, shape)
    alone = np.flatnonzero(alike < 0)
    seen = lighting.visible(
        scene,
        coarse.followed_by(fine.take(alone)),
        lights,
        lighting.ask_order(
            np.concatenate([rows, rows[pixel[alone]]]),
            np.concatenate([columns, columns[pixel[alone]]]),
        ),
        asks=asks,
    )
    shared = lighting.share([values[:pixels] for values in seen], coarse.label, shape)

    hits = coarse.followed_by(fine)
    hit = hits.geom >= 0
    hit[on_edge] = False  # The rays through the pixel replace the one through its middle.
    arrived = []
    for new, old in zip(shared, seen, strict=True):
        on_fine = new[alike]
        on_fine[alone] = old[pixels:]
        arrived.append(np.concatenate([new, on_fine])[hit])
    shares = [
        actual / np.maximum(possible, 1e-6)
        for actual, possible in zip(arrived[::2], arrived[1::2], strict=True)
    ]
    colour = np.zeros((len(hits.geom), 3), np.float32)
    colour[hit] = shade(hits.take(np.flatnonzero(hit)), shares)
    empty = hits.geom < 0
    place = np.stack([columns, rows], axis=1) * (2.0 / shape[1], 2.0 / shape[0]) - 1.0
    colour[empty] = background(
        np.concatenate([coarse_rays, fine_rays])[empty],
        np.concatenate([place, place[pixel]])[empty],
    )
    picture = colour[:pixels]
    picture[on_edge] = colour[pixels:].reshape(-1, _SUBSAMPLES, 3).mean(axis=1)
    return picture.reshape(*shape, 3)
