"""One thing in a picture: where it is, what is annotated of it, and what holds between two."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

__all__ = ["CORNERS", "RELATIONS", "THINGS", "BoundingBox", "Related", "Thing"]

THINGS = "things.csv"
"""The table of things beside that of the pictures."""

RELATIONS = "relations.csv"
"""The table of what holds between two of them."""

CORNERS = ("left", "top", "right", "bottom")
"""Its columns of a box."""


@dataclass(frozen=True, slots=True)
class BoundingBox:
    """The upright box around a thing, in pixels of the upright picture.

    Left and top count from the picture's top left corner; right and bottom are the first that lie
    outside.

    Examples
    --------
    >>> BoundingBox(10, 0, 30, 5).area
    100
    """

    left: float
    top: float
    right: float
    bottom: float

    @property
    def area(self) -> float:
        """How many pixels it covers."""
        return (self.right - self.left) * (self.bottom - self.top)

    @property
    def middle(self) -> tuple[float, float]:
        """Column and row of its middle."""
        return (self.left + self.right) / 2, (self.top + self.bottom) / 2


@dataclass(frozen=True, slots=True)
class Thing:
    """A thing in a picture.

    ``name`` tells it from the picture's other things. ``values`` are those of its features that
    somebody knows. ``line`` is where its row stands, 0 where it has none.
    """

    name: str
    values: Mapping[str, str] = field(default_factory=dict)
    box: BoundingBox | None = None
    line: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class Related:
    """What somebody says of a relation between two things, which are named.

    ``holds`` is None where it is said that nobody knows.
    """

    relation: str
    thing: str
    other: str
    holds: bool | None = True
    line: int = field(default=0, compare=False)
