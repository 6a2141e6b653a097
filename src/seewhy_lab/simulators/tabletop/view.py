"""From where a table is seen, by which light, and what it is made of."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seewhy_lab.rendering.camera import Camera

__all__ = ["View", "camera_of", "random_view"]

Triple = tuple[float, float, float]

_TABLES: tuple[Triple, ...] = (
    (0.48, 0.33, 0.21),
    (0.56, 0.43, 0.29),
    (0.36, 0.24, 0.16),
    (0.55, 0.52, 0.47),
    (0.42, 0.42, 0.43),
    (0.62, 0.61, 0.59),
    (0.30, 0.36, 0.40),
)
_ROOMS: tuple[Triple, ...] = (
    (0.62, 0.61, 0.58),
    (0.52, 0.50, 0.46),
    (0.45, 0.48, 0.52),
)


@dataclass(frozen=True, kw_only=True)
class View:
    """Angles are in radians, lengths in metres, colours linear.

    `azimuth` and `elevation` turn the camera to the right and up, `lens` is its vertical angle of
    view, `away` its distance from `aim`. The lamp stands at `lamp` and has radius `lamp_size`.
    `grain` is how much the table shows its wood, from 0 (a plain board) to 1; `planks` the width
    of its boards, 0 for a single one. `room` is what metal things mirror beside the table.
    """

    azimuth: float
    elevation: float
    lens: float
    away: float
    aim: Triple
    lamp: Triple
    lamp_size: float
    lamp_colour: Triple
    sky: float
    table: Triple
    grain: float
    planks: float
    room: Triple
    texture: int
    exposure: float
    vignette: float
    noise: float


def random_view(rng: np.random.Generator) -> View:
    """A camera that looks down at a table from roughly in front, and some light."""
    bearing = rng.uniform(-math.pi * 0.8, math.pi * 0.8)
    rise = rng.uniform(math.radians(40.0), math.radians(68.0))
    away = rng.uniform(0.8, 1.1)
    lamp = (
        away * math.cos(rise) * math.sin(bearing),
        -away * math.cos(rise) * math.cos(bearing),
        away * math.sin(rise),
    )
    warmth = rng.uniform(-0.06, 0.12)
    return View(
        azimuth=float(rng.uniform(-1.0, 1.0)) * math.radians(12.0),
        elevation=float(rng.uniform(math.radians(24.0), math.radians(38.0))),
        lens=math.radians(float(rng.uniform(22.0, 27.0))),
        away=float(rng.uniform(0.76, 0.90)),
        aim=(
            float(rng.uniform(-0.015, 0.015)),
            float(rng.uniform(-0.015, 0.015)),
            float(rng.uniform(0.015, 0.045)),
        ),
        lamp=lamp,
        lamp_size=float(rng.uniform(0.06, 0.18)),
        lamp_colour=(1.0 + warmth, 1.0, 1.0 - 1.4 * warmth),
        sky=float(rng.uniform(0.32, 0.55)),
        table=_pick(_TABLES, rng),
        grain=float(rng.choice([0.0, rng.uniform(0.4, 1.0)])),
        planks=float(rng.choice([0.0, rng.uniform(0.06, 0.11)])),
        room=_pick(_ROOMS, rng),
        texture=int(rng.integers(2**31)),
        exposure=float(rng.uniform(0.95, 1.15)),
        vignette=float(rng.uniform(0.05, 0.22)),
        noise=float(rng.uniform(0.004, 0.012)),
    )


def _pick(colours: tuple[Triple, ...], rng: np.random.Generator) -> Triple:
    chosen = np.array(colours[int(rng.integers(len(colours)))])
    red, green, blue = np.clip(chosen * rng.uniform(0.85, 1.15) * rng.uniform(0.97, 1.03, 3), 0, 1)
    return float(red), float(green), float(blue)


def camera_of(view: View, *, size: int) -> Camera:
    """The camera of a view, for pictures `size` pixels wide and three quarters of that high."""
    return Camera(
        view.aim,
        view.away,
        azimuth=view.azimuth,
        elevation=view.elevation,
        lens=view.lens,
        size=round(size * 3 / 4),
        width=size,
    )
