"""From where a robot looks into a room, by which light, and what the walls and the floor are."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seewhy_lab.rendering.vectors import Array
from seewhy_lab.simulators.robot_assistant.room import Room
from seewhy_lab.simulators.robot_assistant.solid import Colour, Point, shade_of

__all__ = ["Decor", "View", "random_decor", "random_view"]

_ATTEMPTS = 24
_MAY_BE_BEHIND = ("sofa", "desk")  # So large that what stands before them does not hide them.
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

    def frames(self, places: Array) -> Array:
        """Which places, shape (n, 3), lie in the frame and not at its very edge, shape (n,)."""
        forward_x, forward_y, forward_z = self.forward
        right = np.array([math.cos(self.azimuth), math.sin(self.azimuth), 0.0])
        # The product of right and forward, both of length 1 and at a right angle.
        up = np.array(
            [
                math.sin(self.azimuth) * forward_z,
                -math.cos(self.azimuth) * forward_z,
                math.cos(self.azimuth) * forward_y - math.sin(self.azimuth) * forward_x,
            ]
        )
        away = places - np.array(self.eye)
        limit = (
            _WITHIN
            * math.tan(self.lens / 2.0)
            * (away @ np.array([forward_x, forward_y, forward_z]))
        )
        return np.asarray((np.abs(away @ right) < limit) & (np.abs(away @ up) < limit))


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


class _Landmarks:
    """What should be seen of a room, and what may stand before it."""

    def __init__(self, room: Room) -> None:
        reach = np.array([placed.reach for placed in room.placed]).reshape(-1, 2)
        at = np.array([(placed.x, placed.y, placed.z) for placed in room.placed]).reshape(-1, 3)
        high = np.array([placed.thing.height for placed in room.placed])
        # Few things fill the cuboid around them.
        self.low = np.column_stack([at[:, :2] - 0.75 * reach, at[:, 2] + 0.02])
        self.high = np.column_stack([at[:, :2] + 0.75 * reach, at[:, 2] + 0.95 * high])
        self.framed = np.concatenate(
            [at + share * high[:, None] * (0.0, 0.0, 1.0) for share in (0.3, 0.92)]
        )[np.tile(np.array([bool(placed.thing.name) for placed in room.placed], bool), 2)]
        targets, owners = [], []
        for number, placed in enumerate(room.placed):
            if placed.thing.name and placed.thing.name not in _MAY_BE_BEHIND:
                middle = at[number] + (0.0, 0.0, 0.55 * high[number])
                aside = (0.6 * reach[number, 0], 0.0, 0.0)
                targets += [middle - aside, middle, middle + aside]
                owners += [number] * 3
        self.targets = np.array(targets).reshape(-1, 3)
        self.belongs = np.array(owners, int)[:, None] == np.arange(len(room.placed))

    def lacking(self, view: View) -> int:
        """How many places are out of the frame or have a thing before them."""
        outside = int(np.sum(~view.frames(self.framed)))
        if not len(self.targets):
            return outside
        eye = np.array(view.eye)
        way = (self.targets - eye)[:, None]
        way = np.where(np.abs(way) < 1e-9, 1e-9, way)
        # Where the way to each place enters and leaves each cuboid: 0 the eye, 1 the place.
        enters, leaves = (self.low - eye) / way, (self.high - eye) / way
        enters, leaves = np.minimum(enters, leaves), np.maximum(enters, leaves)
        first, last = enters.max(axis=2), leaves.min(axis=2)
        before = (first < last) & (last > 0.0) & (first < 0.99) & ~self.belongs
        return outside + int(before.any(axis=1).sum())


def random_view(room: Room, rng: np.random.Generator) -> View:
    """A camera at the height of a robot's head, at the door, that looks at what is in the room.

    Of a few that are drawn it is the first in whose frame all things lie, none before another; or
    the one that comes nearest to this.
    """
    landmarks = _Landmarks(room)
    best, fewest = _any_view(room, rng), math.inf
    for _ in range(_ATTEMPTS):
        view = _any_view(room, rng)
        lacking = landmarks.lacking(view)
        if lacking < fewest:
            best, fewest = view, lacking
        if not lacking:
            break
    return best


def _any_view(room: Room, rng: np.random.Generator) -> View:
    eye = (
        rng.uniform(-0.38, 0.38) * room.width,
        -room.depth / 2.0 - rng.uniform(0.2, 0.6),
        rng.uniform(1.05, 1.5),
    )
    bearings = [math.atan2(eye[0] - placed.x, placed.y - eye[1]) for placed in room.placed] or [0.0]
    middle = (min(bearings) + max(bearings)) / 2.0
    # Also by what stands in the room, but not only: a robot has not seen it yet.
    azimuth = rng.uniform(0.4, 1.0) * middle + rng.normal(0.0, math.radians(5.0))
    return View(
        eye=eye,
        azimuth=azimuth,
        elevation=rng.uniform(math.radians(6.0), math.radians(24.0)),
        lens=rng.uniform(math.radians(60.0), math.radians(72.0)),
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
