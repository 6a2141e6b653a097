"""Where the camera and the lamp of a picture are, and what the room looks like."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from seewhy_lab.rendering.camera import Camera
from seewhy_lab.simulators.structure_stability.structure import Structure

__all__ = ["View", "camera_of", "random_view"]


@dataclass(frozen=True, kw_only=True)
class View:
    """Where the camera and the lamp are and what the room looks like.

    Angles are in radians, lengths in metres, colours linear. `azimuth` turns the camera to the
    right of the structure, `lens` is its vertical angle of view, `frame` the height of what it
    sees at the distance of the structure. The lamp stands at `lamp` and has radius `lamp_size`.
    """

    azimuth: float
    elevation: float
    lens: float
    frame: float
    aim: tuple[float, float, float]
    lamp: tuple[float, float, float]
    lamp_size: float
    lamp_colour: tuple[float, float, float]
    sky: float
    table: tuple[float, float, float]
    planks: float
    wall: tuple[float, float, float]
    floor: tuple[float, float, float]
    glow: tuple[float, float]
    texture: int
    exposure: float
    vignette: float
    noise: float


_TABLES = (
    (0.48, 0.30, 0.17),
    (0.54, 0.38, 0.23),
    (0.34, 0.20, 0.12),
    (0.55, 0.45, 0.33),
    (0.45, 0.43, 0.41),
    (0.55, 0.51, 0.45),
)
_WALLS = (
    (0.40, 0.43, 0.46),
    (0.55, 0.52, 0.47),
    (0.34, 0.40, 0.38),
    (0.48, 0.42, 0.40),
    (0.30, 0.33, 0.40),
    (0.62, 0.61, 0.58),
)


def random_view(structure: Structure, rng: np.random.Generator) -> View:
    """A camera that looks at the structure from roughly in front, and some light and room."""
    left = min(block.x - block.width / 2.0 for block in structure.blocks)
    right = max(block.x + block.width / 2.0 for block in structure.blocks)
    high = structure.height
    frame = max(0.100 + 0.73 * high, 1.30 * (right - left) + 0.02) * rng.uniform(0.98, 1.10)
    aim = (
        (left + right) / 2.0 + rng.uniform(-0.035, 0.035) * frame,
        0.0,
        0.5 * high + rng.uniform(-0.03, 0.03) * frame,
    )
    side = rng.choice([-1.0, 1.0])
    bearing = side * rng.uniform(math.radians(25.0), math.radians(80.0))
    rise = rng.uniform(math.radians(35.0), math.radians(62.0))
    away = rng.uniform(0.8, 1.1)
    lamp = (
        away * math.cos(rise) * math.sin(bearing),
        -away * math.cos(rise) * math.cos(bearing),
        away * math.sin(rise),
    )
    warmth = rng.uniform(-0.06, 0.14)
    tint = rng.uniform(0.85, 1.15, 3)

    def pick(colours: tuple[tuple[float, float, float], ...], spread: float) -> Any:
        chosen = np.array(colours[int(rng.integers(len(colours)))])
        return tuple(float(c) for c in np.clip(chosen * rng.uniform(1 - spread, 1 + spread), 0, 1))

    return View(
        azimuth=float(rng.uniform(-1.0, 1.0)) * math.radians(16.0),
        elevation=float(rng.uniform(math.radians(9.0), math.radians(21.0))),
        lens=float(rng.uniform(math.radians(20.0), math.radians(34.0))),
        frame=float(frame),
        aim=aim,
        lamp=lamp,
        lamp_size=float(rng.uniform(0.07, 0.19)),
        lamp_colour=(1.0 + warmth, 1.0, 1.0 - 1.4 * warmth),
        sky=float(rng.uniform(0.30, 0.50)),
        table=pick(_TABLES, 0.15),
        planks=float(rng.choice([0.0, rng.uniform(0.06, 0.11)])),
        wall=pick(_WALLS, 0.2),
        floor=tuple(float(0.10 * t) for t in tint),  # type: ignore[arg-type]
        glow=(float(rng.uniform(-0.6, 0.6)), float(rng.uniform(-0.2, 0.8))),
        texture=int(rng.integers(2**31)),
        exposure=float(rng.uniform(0.92, 1.15)),
        vignette=float(rng.uniform(0.10, 0.28)),
        noise=float(rng.uniform(0.006, 0.014)),
    )


def camera_of(view: View, *, size: int) -> Camera:
    """The camera of a view, for pictures of `size` by `size` pixels."""
    return Camera(
        view.aim,
        view.frame / 2.0 / math.tan(view.lens / 2.0),
        azimuth=view.azimuth,
        elevation=view.elevation,
        lens=view.lens,
        size=size,
    )
