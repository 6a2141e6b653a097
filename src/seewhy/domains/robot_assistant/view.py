"""From where a robot looks into a room, by which light, and what the walls and the floor are."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seewhy.domains.robot_assistant.room import Room
from seewhy.domains.robot_assistant.solid import Colour, Point, shade_of
from seewhy.rendering.vectors import Array

__all__ = ["Decor", "View", "random_decor", "random_view"]

_ATTEMPTS = 40
_WITHIN = 0.93  # Share of the frame in which the middle of a thing must lie.


@dataclass(frozen=True, kw_only=True)
class View:
    """Where the camera of the robot is and where it points.

    `azimuth` is how far it looks to the left, `elevation` how far down, `lens` its vertical angle
    of view, all in radians.
    """

    eye: Point
    azimuth: float
    elevation: float
    lens: float

    @property
    def forward(self) -> Point:
        """The direction of sight, of length 1."""
        level = math.cos(self.elevation)
        return (
            -level * math.sin(self.azimuth),
            level * math.cos(self.azimuth),
            -math.sin(self.elevation),
        )

    def frames(self, places: Array) -> bool:
        """Whether all places, shape (n, 3), lie in the frame, not at its very edge."""
        forward = np.array(self.forward)
        right = np.array([math.cos(self.azimuth), math.sin(self.azimuth), 0.0])
        away = places - np.array(self.eye)
        limit = _WITHIN * math.tan(self.lens / 2.0) * (away @ forward)
        across, up = away @ right, away @ np.cross(right, forward)
        return bool(np.all((np.abs(across) < limit) & (np.abs(up) < limit)))


@dataclass(frozen=True, kw_only=True)
class Decor:
    """The walls, the floor and the light of a room.

    `floor_kind` is "carpet", "tiles" or "boards", `pitch` the width of a tile or board in metres.
    `window` says where along the walls, from the left one over the back to the right, a window is;
    `light` is the middle of the lamp, or of the daylight, and `spread` its half extents along x, y
    and z. `texture` seeds irregularities.
    """

    wall: Colour
    floor: Colour
    floor_kind: str
    pitch: float
    skirting: Colour
    window: float
    picture: float
    picture_colour: Colour
    light: Point
    spread: Point
    light_colour: Colour
    fill: float
    texture: int
    exposure: float
    vignette: float
    noise: float


def random_view(room: Room, rng: np.random.Generator) -> View:
    """A camera at the height of a robot's head, at the door, that looks at what is in the room.

    Of a few that are drawn it is the first in whose frame the middle and the upper end of every
    thing lie, else the last.
    """
    wanted = np.array(
        [
            (own.x, own.y, own.z + share * own.thing.height)
            for own in room.placed
            for share in (0.3, 0.92)
            if own.thing.name
        ]
    ).reshape(-1, 3)
    for _ in range(_ATTEMPTS):
        view = _any_view(room, rng)
        if view.frames(wanted):
            break
    return view


def _any_view(room: Room, rng: np.random.Generator) -> View:
    eye = (
        rng.uniform(-0.38, 0.38) * room.width,
        -room.depth / 2.0 - rng.uniform(0.25, 0.75),
        rng.uniform(1.05, 1.5),
    )
    bearings = [math.atan2(eye[0] - own.x, own.y - eye[1]) for own in room.placed] or [0.0]
    middle = (min(bearings) + max(bearings)) / 2.0
    # Also by what stands in the room, but not only: a robot has not seen it yet.
    azimuth = rng.uniform(0.4, 1.0) * middle + rng.normal(0.0, math.radians(5.0))
    return View(
        eye=eye,
        azimuth=azimuth,
        elevation=rng.uniform(math.radians(6.0), math.radians(24.0)),
        lens=rng.uniform(math.radians(58.0), math.radians(70.0)),
    )


def random_decor(room: Room, rng: np.random.Generator) -> Decor:
    """Some walls, a floor and light, all as in an office: pale walls, a floor of quiet colour."""
    kind = str(rng.choice(["carpet", "tiles", "boards"]))
    # No floor is as brown as a desk or as green as a plant.
    floor = shade_of(
        rng,
        hue=(20, 60) if rng.uniform() < 0.6 else (190, 240),
        saturation=(0.02, 0.16),
        value=(0.34, 0.74),
    )
    daylight = bool(rng.uniform() < 0.4)
    side = rng.choice([-1.0, 1.0])
    if daylight:
        light = (side * (room.width / 2.0 + 0.2), rng.uniform(-0.6, 0.2) * room.depth, 1.8)
        spread = (0.05, 0.7, 0.5)
        warmth = rng.uniform(-0.08, 0.03)
    else:
        light = (rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.3) * room.depth / 2.0, 2.6)
        spread = (rng.uniform(0.15, 0.7), rng.uniform(0.15, 0.7), 0.02)
        warmth = rng.uniform(-0.04, 0.12)
    strength = rng.uniform(0.7, 1.05)
    return Decor(
        wall=shade_of(rng, hue=(0, 360), saturation=(0.0, 0.14), value=(0.70, 0.93)),
        floor=floor,
        floor_kind=kind,
        pitch=rng.uniform(0.3, 0.5) if kind == "tiles" else rng.uniform(0.12, 0.2),
        skirting=(0.86, 0.86, 0.85) if rng.uniform() < 0.6 else (0.35, 0.34, 0.34),
        window=rng.uniform(0.0, 1.0),
        picture=rng.uniform(0.0, 1.0),
        picture_colour=shade_of(rng, hue=(0, 360), saturation=(0.05, 0.25), value=(0.4, 0.8)),
        light=light,
        spread=spread,
        light_colour=(
            strength * (1.0 + warmth),
            strength,
            strength * (1.0 - 1.3 * warmth),
        ),
        fill=rng.uniform(0.42, 0.6),
        texture=int(rng.integers(2**31)),
        exposure=rng.uniform(0.9, 1.12),
        vignette=rng.uniform(0.08, 0.22),
        noise=rng.uniform(0.005, 0.012),
    )
