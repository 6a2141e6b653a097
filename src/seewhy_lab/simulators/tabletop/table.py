"""Things and the table that they stand on, as plain data.

The world frame has its origin on the table: ``x`` to the right of a camera that looks straight on,
``y`` away from it, ``z`` up. Lengths are in metres, angles in radians.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

__all__ = ["COLOURS", "MATERIALS", "SHAPES", "SIZES", "Table", "TableThing", "half_extent"]

SHAPES = ("cube", "sphere", "cylinder")
SIZES = ("small", "large")
MATERIALS = ("rubber", "metal")
COLOURS = ("gray", "red", "blue", "green", "brown", "purple", "cyan", "yellow")

_LARGE = {"cube": (0.031, 0.031), "sphere": (0.036, 0.036), "cylinder": (0.031, 0.034)}
"""Shape → half the width and half the height of a large thing."""
_SMALL_SHARE = 0.55


def half_extent(shape: str, size: str) -> tuple[float, float]:
    """Half the width and half the height of a thing, before its `scale`.

    Examples
    --------
    >>> half_extent("cube", "large")
    (0.031, 0.031)
    """
    share = _SMALL_SHARE if size == "small" else 1.0
    width, height = _LARGE[shape]
    return width * share, height * share


@dataclass(frozen=True, kw_only=True)
class TableThing:
    """A cube, a ball or an upright cylinder.

    `x`, `y`, `z` is its middle, `yaw` its turn about the upright. `support` is the number of the
    thing that it stands on, None for the table. `scale` makes it a little larger or smaller than
    others of its size.
    """

    shape: str
    size: str
    colour: str
    material: str
    x: float
    y: float
    z: float
    yaw: float
    support: int | None = None
    scale: float = 1.0

    @property
    def half(self) -> tuple[float, float]:
        """Half its width and half its height."""
        width, height = half_extent(self.shape, self.size)
        return width * self.scale, height * self.scale

    @property
    def reach(self) -> float:
        """How far from its middle it reaches, seen from above."""
        return self.half[0] * (math.sqrt(2.0) if self.shape == "cube" else 1.0)

    @property
    def top(self) -> float:
        """How high above the table it ends."""
        return self.z + self.half[1]


@dataclass(frozen=True)
class Table:
    """The things on a table; what a thing stands on comes before it."""

    things: tuple[TableThing, ...]

    def foot(self, number: int) -> int:
        """The thing at the foot of the stack that a thing belongs to.

        Examples
        --------
        >>> block = TableThing(shape="cube", size="large", colour="red", material="rubber",
        ...                    x=0, y=0, z=0.031, yaw=0)
        >>> ball = TableThing(shape="sphere", size="small", colour="red", material="metal",
        ...                   x=0, y=0, z=0.082, yaw=0, support=0)
        >>> Table((block, ball)).foot(1)
        0
        """
        below = self.things[number].support
        return number if below is None else self.foot(below)

    def places(self, azimuth: float) -> list[tuple[float, float]]:
        """Where each thing stands for who looks at the table: to the right, and how far away.

        In metres from the middle of the table. How far away a thing is is told by the nearest
        point of what it covers of the table, or what is at the foot of its stack does. Things in
        one stack are as far away as each other, and as far to the right.

        Examples
        --------
        >>> ball = TableThing(shape="sphere", size="large", colour="red", material="rubber",
        ...                   x=0.1, y=0.1, z=0.036, yaw=0)
        >>> [tuple(round(value, 3) for value in place) for place in Table((ball,)).places(0.0)]
        [(0.1, 0.064)]
        """
        ahead_x, ahead_y = -math.sin(azimuth), math.cos(azimuth)
        feet = [self.things[self.foot(number)] for number in range(len(self.things))]
        return [
            (
                foot.x * ahead_y - foot.y * ahead_x,
                foot.x * ahead_x + foot.y * ahead_y - foot.reach,
            )
            for foot in feet
        ]

    def stands_on(self) -> Iterator[tuple[int, int]]:
        """Each thing that stands on another, with that other."""
        for number, thing in enumerate(self.things):
            if thing.support is not None:
                yield number, thing.support
