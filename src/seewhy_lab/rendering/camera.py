"""A camera: the rays through its frame, and what lens, sensor and tone curve make of the light."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from seewhy_lab.rendering.vectors import Array

__all__ = ["Camera", "develop"]


class Camera:
    """Rays through places of the frame, which are counted in pixels from its upper left corner.

    `shape` is its height and its width.

    Parameters
    ----------
    aim : sequence of float, length 3
        The place in the middle of the frame, in metres.
    away : float
        How far the eye is from there.
    azimuth, elevation : float
        Where it stands, in radians: 0, 0 is a level look along y; a positive azimuth takes it to
        the right, a positive elevation up.
    lens : float
        Vertical angle of view, in radians.
    size : int
        Height of the frame in pixels.
    width : int, optional
        Its width; as its height where left out.

    Examples
    --------
    >>> camera = Camera((0, 0, 1), 2.0, azimuth=0.0, elevation=0.0, lens=1.0, size=8)
    >>> camera.eye.tolist()
    [0.0, -2.0, 1.0]
    >>> camera.rays(np.array([4.0]), np.array([4.0])).tolist()
    [[0.0, 1.0, 0.0]]
    """

    def __init__(
        self,
        aim: tuple[float, float, float],
        away: float,
        *,
        azimuth: float,
        elevation: float,
        lens: float,
        size: int,
        width: int | None = None,
    ) -> None:
        level = math.cos(elevation)
        self.shape: tuple[int, int] = (size, size if width is None else width)
        self._half = math.tan(lens / 2.0)
        self._right = np.array([math.cos(azimuth), math.sin(azimuth), 0.0])
        self._back = np.array(
            [level * math.sin(azimuth), -level * math.cos(azimuth), math.sin(elevation)]
        )
        self._up = np.cross(self._back, self._right)
        self.eye: Array = np.array(aim) + self._back * away

    def rays(self, rows: Array, columns: Array) -> Array:
        """Directions, shape (n, 3), through the given places."""
        height, width = self.shape
        right = (2.0 * columns / height - width / height)[:, None]
        up = (1.0 - 2.0 * rows / height)[:, None]
        rays: Array = self._half * (right * self._right + up * self._up) - self._back
        return rays


def develop(
    light: Array, rng: np.random.Generator, *, exposure: float, vignette: float, noise: float
) -> NDArray[np.uint8]:
    """From linear light, shape (height, width, 3), to the picture.

    `vignette` is what the corners lose of their light, as a share; `noise` is the spread of the
    grain, as a share of white.

    Examples
    --------
    >>> grey = np.full((8, 8, 3), 0.2)
    >>> rng = np.random.default_rng(0)
    >>> develop(grey, rng, exposure=1.0, vignette=0.0, noise=0.0)[0, 0].tolist()
    [136, 136, 136]
    """
    down, across = (
        (np.arange(size, dtype=np.float32) + 0.5) / size * 2.0 - 1.0 for size in light.shape[:2]
    )
    radius = down[:, None] ** 2 + across[None, :] ** 2
    light = light * (exposure * (1.0 - vignette * radius / 2.0))[..., None]
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
    picture = picture + noise * grain * (1.2 - 0.6 * picture)
    return np.asarray(np.clip(picture * 255.0 + 0.5, 0.0, 255.0), dtype=np.uint8)
