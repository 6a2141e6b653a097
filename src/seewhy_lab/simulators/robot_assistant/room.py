"""A room as plain data: which things are in it and where they stand.

The world frame has its origin on the floor in the middle of the room: ``x`` to the right as seen
from the door, ``y`` away from the door, ``z`` up. Lengths are in metres and angles in radians.
"""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from seewhy.text.nearest import did_you_mean
from seewhy_lab.simulators.robot_assistant.furniture import BUILDERS, ON_TOP, sideboard
from seewhy_lab.simulators.robot_assistant.people import PEOPLE, person
from seewhy_lab.simulators.robot_assistant.solid import Solid, Thing

__all__ = ["OBJECTS", "Placed", "Room", "furnished"]

OBJECTS = tuple(BUILDERS)
"""The objects that can be in a room."""

_GAP = 0.04  # Free floor around each thing.
_ALONG_WALL = ("sofa", "desk", "")
_ATTEMPTS = 60


@dataclass(frozen=True, kw_only=True)
class Placed:
    """A thing at its place, with its back turned by `yaw` from the y axis."""

    thing: Thing
    x: float
    y: float
    z: float = 0.0
    yaw: float = 0.0

    @property
    def solids(self) -> tuple[Solid, ...]:
        """The solids of the thing in the frame of the room."""
        return tuple(solid.moved(self.x, self.y, self.z, self.yaw) for solid in self.thing.solids)

    @property
    def reach(self) -> tuple[float, float]:
        """How far the thing reaches from its middle along x and along y."""
        cos, sin = abs(math.cos(self.yaw)), abs(math.sin(self.yaw))
        width, depth = self.thing.half
        return width * cos + depth * sin, width * sin + depth * cos

    def overlaps(self, other: Placed) -> bool:
        """Whether the two take up the same ground, a little space around them included."""
        (wide, deep), (other_wide, other_deep) = self.reach, other.reach
        return (
            abs(self.x - other.x) < wide + other_wide + _GAP
            and abs(self.y - other.y) < deep + other_deep + _GAP
        )


@dataclass(frozen=True, kw_only=True)
class Room:
    """The things in a room of the given width and depth.

    A thing without a name is a fixture: it is there to put others on, and nobody asks for it.
    """

    width: float
    depth: float
    placed: tuple[Placed, ...]

    @property
    def names(self) -> frozenset[str]:
        """The objects and people in the room."""
        return frozenset(placed.thing.name for placed in self.placed) - {""}


def furnished(objects: Collection[str], people: Collection[str], rng: np.random.Generator) -> Room:
    """A room that holds exactly the given objects and people, none in the place of another.

    A desk and a sofa stand along the walls and people and tall objects rather at the back. What is
    small stands on the desk; without one on a sideboard or, cups and books, on the floor.

    Raises
    ------
    ValueError
        A name is not that of an object, or not that of a person.

    Examples
    --------
    >>> room = furnished({"desk", "cup"}, {"bob"}, np.random.default_rng(0))
    >>> sorted(room.names)
    ['bob', 'cup', 'desk']
    >>> room = furnished({"dsk"}, set(), np.random.default_rng(0))
    Traceback (most recent call last):
    ...
    ValueError: there is no object 'dsk': did you mean 'desk'?
    """
    _known(objects, OBJECTS, kind="object")
    _known(people, PEOPLE, kind="person")
    while True:
        room = _attempt(objects, people, rng)
        if room is not None:
            return room


def _attempt(
    objects: Collection[str], people: Collection[str], rng: np.random.Generator
) -> Room | None:
    """A room with things of random proportions; None where these do not fit into it."""
    # In the order of the lists, whatever order a set has: the same things make the same room.
    built = [BUILDERS[name](rng) for name in OBJECTS if name in objects]
    built += [person(name, rng) for name in PEOPLE if name in people]
    small = [thing for thing in built if thing.name in ON_TOP]
    standing = [thing for thing in built if thing.name not in ON_TOP]
    if small and "desk" not in objects:
        raised = [thing for thing in small if thing.name == "computer" or rng.uniform() < 0.7]
        standing += [thing for thing in small if thing not in raised]
        small = raised
        if raised:
            standing.append(sideboard(rng))
    crowd = len(standing) / 10.0
    width = rng.uniform(2.7, 3.3) + 0.6 * crowd
    depth = rng.uniform(2.3, 2.8) + 0.6 * crowd
    placed = _laid_out(standing, width, depth, rng)
    if placed is None:
        return None
    on_top = _on_top(small, placed, rng)
    return None if on_top is None else Room(width=width, depth=depth, placed=(*placed, *on_top))


def _known(names: Collection[str], known: tuple[str, ...], *, kind: str) -> None:
    for name in sorted(names):
        if name not in known:
            raise ValueError(f"there is no {kind} '{name}': {did_you_mean(name, known)}")


def _laid_out(
    things: list[Thing], width: float, depth: float, rng: np.random.Generator
) -> list[Placed] | None:
    """The things on the floor, the largest first; None where one finds no place."""
    placed: list[Placed] = []
    for thing in sorted(things, key=lambda floor_thing: -floor_thing.half[0] * floor_thing.half[1]):
        for _ in range(_ATTEMPTS):
            if thing.name in _ALONG_WALL:
                candidate = _at_wall(thing, width, depth, rng)
            else:
                candidate = _anywhere(thing, width, depth, rng)
            if not any(candidate.overlaps(other) for other in placed):
                placed.append(candidate)
                break
        else:
            return None
    return placed


def _at_wall(thing: Thing, width: float, depth: float, rng: np.random.Generator) -> Placed:
    wall = rng.choice(3, p=[0.6, 0.2, 0.2])
    off = thing.half[1] + rng.uniform(0.02, 0.12)
    if wall == 0:
        free = max(0.0, width / 2.0 - thing.half[0])
        return Placed(thing=thing, x=rng.uniform(-free, free), y=depth / 2.0 - off)
    side = -1.0 if wall == 1 else 1.0
    free = max(0.0, depth / 2.0 - thing.half[0])
    return Placed(
        thing=thing,
        x=side * (width / 2.0 - off),
        # Seen from the door a thing beside it would fill the picture or not be in it.
        y=rng.uniform(-0.1 * free, free),
        yaw=-side * math.pi / 2.0,
    )


_HOW_FAR = {"small_box": (0.25, 0.75), "large_box": (0.2, 1.0), "cup": (0.25, 0.5)}
"""Between which shares of the depth, from the door, a thing stands: what is low not behind all."""


def _anywhere(thing: Thing, width: float, depth: float, rng: np.random.Generator) -> Placed:
    near, far = _HOW_FAR.get(thing.name, (0.2, 1.0))
    turn = {"books": 0.3, "cup": 3.0, "small_box": 0.7, "large_box": 0.6, "chair": 1.6}
    yaw = rng.uniform(-1.0, 1.0) * turn.get(thing.name, 0.9)
    reach = Placed(thing=thing, x=0.0, y=0.0, yaw=yaw).reach
    free = width / 2.0 - reach[0] - 0.03
    first, last = -depth / 2.0 + reach[1], depth / 2.0 - reach[1] - 0.03
    return Placed(
        thing=thing,
        x=rng.uniform(-free, free),
        y=first + rng.uniform(near, far) * (last - first),
        yaw=yaw,
    )


def _on_top(
    small: list[Thing], placed: list[Placed], rng: np.random.Generator
) -> list[Placed] | None:
    """The small things side by side on the desk or the sideboard; None where one is too narrow."""
    if not small:
        return []
    below = next(standing for standing in placed if standing.thing.top is not None)
    order = [small[number] for number in rng.permutation(len(small))]
    spare = 2.0 * below.thing.half[0] - sum(2.0 * thing.half[0] for thing in order)
    gaps = rng.dirichlet(np.ones(len(order) + 1)) * (spare - 0.03 * len(order))
    if spare < 0.03 * len(order):
        return None
    found = []
    left = -below.thing.half[0]
    for thing, gap in zip(order, gaps, strict=False):
        left += gap + 0.03
        x = left + thing.half[0]
        left += 2.0 * thing.half[0]
        deep = max(0.0, below.thing.half[1] - thing.half[1])
        y = rng.uniform(-1.0, 0.2) * deep
        cos, sin = math.cos(below.yaw), math.sin(below.yaw)
        found.append(
            Placed(
                thing=thing,
                x=below.x + cos * x - sin * y,
                y=below.y + sin * x + cos * y,
                z=below.thing.top or 0.0,
                # What stands at a wall to the side is turned to the door by a part.
                yaw=rng.normal(0.0, 0.12) + rng.uniform(0.4, 0.8) * below.yaw,
            )
        )
    return found
