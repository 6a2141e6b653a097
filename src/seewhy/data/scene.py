"""One annotated picture, and the place of its row for whoever has to mend it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from seewhy.data.thing import Related, Thing
from seewhy.knowledge.scene import FeatureVector

__all__ = ["Scene", "TablePlace"]


@dataclass(frozen=True, slots=True)
class Scene:
    """One picture with what is annotated of it.

    ``label`` is its class, None where nobody said it: such a picture is to be labelled, or
    classified. ``split`` is "train", "test" or empty; pictures of one ``group`` show one physical
    thing and are never split apart for validation. ``reasons`` are the features that somebody
    named as why it is of its class. ``things`` are those in the picture, ``related`` what is said
    of two of them; ``no_things`` is true where somebody said that it shows none. ``line`` is where
    its row stands, 0 where it has none.
    """

    picture: Path
    vector: FeatureVector
    label: str | None = None
    split: str = ""
    group: str = ""
    reasons: tuple[str, ...] = ()
    things: tuple[Thing, ...] = ()
    related: tuple[Related, ...] = ()
    no_things: bool = False
    line: int = field(default=0, compare=False)


@dataclass(frozen=True)
class TablePlace:
    """How errors name a table and its rows: a file has lines, a data frame has rows.

    Examples
    --------
    >>> TablePlace("scenes.csv").at(3), TablePlace("the frame", row="row").at(3)
    ('scenes.csv:3', 'the frame, row 3')
    >>> TablePlace("scenes.csv").rows([3, 7, 9])
    'lines 3, 7 and 9'
    """

    name: str
    row: str = "line"

    def at(self, number: int) -> str:
        """Name a row, as the beginning of a sentence about it."""
        return f"{self.name}:{number}" if self.row == "line" else f"{self.name}, row {number}"

    def rows(self, numbers: Sequence[int]) -> str:
        """Name several rows of the table."""
        said = [str(number) for number in numbers]
        if len(said) == 1:
            return f"{self.row} {said[0]}"
        return f"{self.row}s {', '.join(said[:-1])} and {said[-1]}"
