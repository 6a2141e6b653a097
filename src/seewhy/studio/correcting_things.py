"""An answer about things is doubted: a value was misread, a thing imagined, or missed.

What is said is one more label, an entry of the record with :data:`CORRECTED` that can be taken
back. Pictures in which all things have boxes teach where things are; so where none is drawn in a
picture yet, the boxes of all that was found are kept with the correction: what has no box would be
taught to be background.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from seewhy.data.thing import BoundingBox
from seewhy.errors import SeeWhyError
from seewhy.perception.things.boxes import matched
from seewhy.studio.answering_agent import CORRECTED
from seewhy.studio.drawing import note_things, picture_size, things_of
from seewhy.studio.drawn_things import corners_of
from seewhy.studio.project import Project
from seewhy.studio.record import Entry
from seewhy.text.nearest import did_you_mean

if TYPE_CHECKING:
    from seewhy.agent.things.thing_reply import ReadScene

__all__ = ["Correcting"]


class Correcting:
    """Corrects what was read of a picture.

    Parameters
    ----------
    project : Project
    picture : str
    read : ReadScene
        What it was taken to show; its things are counted from 0.
    """

    def __init__(self, project: Project, picture: str, read: ReadScene) -> None:
        self.project, self.picture, self.read = project, picture, read
        self._size = picture_size(project.picture_file(picture))
        self._here = project.labels().drawn_in(picture)

    @property
    def keeps_all(self) -> bool:
        """Whether the boxes of all that was found are kept with a correction."""
        return not self._here.things and not self._here.none

    def value(self, number: int, feature: str, value: str, *, who: str) -> Entry:
        """Say what a thing is in truth.

        Raises
        ------
        SeeWhyError
            If there is no such thing, feature or value.
        """
        features = things_of(self.project).features
        if feature not in features:
            raise SeeWhyError(
                f"'{feature}' is no feature of things; {did_you_mean(feature, features)}"
            )
        known = features[feature].values
        if value not in known:
            raise SeeWhyError(f"'{value}' is no value of '{feature}'; {did_you_mean(value, known)}")
        self._require(number)
        changes, names = self._standing()
        name = names[number]
        if name is None:
            name = self._new_name()
            box = self.read.reading.things[number].box
            changes[name] = {"new": True, "box": self._corners(box)}
        changes.setdefault(name, {})["values"] = {feature: value}
        return self._note(changes, who=who)

    def not_there(self, number: int, *, who: str) -> Entry:
        """Say that nothing is where a thing was seen.

        Raises
        ------
        SeeWhyError
            If there is no such thing, or the boxes that are drawn have none there anyway.
        """
        self._require(number)
        changes, names = self._standing()
        name = names[number]
        if name is None:
            raise SeeWhyError(
                f"no box is drawn around {self.read.things.one} {number + 1}: it is said to be "
                "imagined already, and the model learns that when it is trained again"
            )
        if self.keeps_all:
            del changes[name]
        else:
            changes[name] = None
        left = changes if self.keeps_all else {*self._here.things} - {name}
        return self._note(changes, who=who, none=not left)

    def there(self, number: int, *, who: str) -> Entry:
        """Say that what may be a thing is one; of the doubtful ones, counted from 0.

        Raises
        ------
        SeeWhyError
            If there is no such.
        """
        doubtful = self.read.reading.doubtful
        if number >= len(doubtful):
            raise SeeWhyError("what was doubtful is not any more; look at the picture again")
        changes, _ = self._standing()
        name = self._new_name(beside=len(changes))
        changes[name] = {"new": True, "box": self._corners(doubtful[number].box)}
        return self._note(changes, who=who)

    def as_found(self, *, who: str) -> Entry | None:
        """Keep the boxes of all that was found, so that the missing one is drawn beside them.

        None where some are drawn already.
        """
        changes, _ = self._standing()
        return self._note(changes, who=who) if self.keeps_all and changes else None

    def _standing(self) -> tuple[dict[str, Any], list[str | None]]:
        """What is kept with any correction, and what each thing is called; None: it is not drawn.

        Only where nothing is said of the picture yet is anything kept.
        """
        seen = [thing.box for thing in self.read.reading.things]
        if self.keeps_all:
            changes: dict[str, Any] = {
                str(number): {"new": True, "box": self._corners(box)}
                for number, box in enumerate(seen, start=1)
            }
            return changes, list(changes)
        drawn = [thing for thing in self._here.things.values() if thing.box is not None]
        places = matched(_rows(seen), _rows([thing.box for thing in drawn if thing.box]))
        return {}, [drawn[place].name if place >= 0 else None for place in places]

    def _note(self, changes: dict[str, Any], *, who: str, none: bool = False) -> Entry:
        said: dict[str, Any] = {"boxes": {self.picture: changes}}
        if none:
            said["none"] = {self.picture: True}
        return note_things(self.project, self.picture, said, who=who, how=CORRECTED)

    def _require(self, number: int) -> None:
        if number >= len(self.read.reading.things):
            raise SeeWhyError(
                f"there is no {self.read.things.one} {number + 1} in what was read; look at the "
                "picture again"
            )

    def _new_name(self, *, beside: int = 0) -> str:
        taken = {*self._here.things, *map(str, range(1, beside + 1))}
        return next(str(n) for n in range(1, len(taken) + 2) if str(n) not in taken)

    def _corners(self, box: BoundingBox) -> list[float]:
        """The corners of a box in whole pixels, inside of the picture."""
        wide, high = self._size
        left, top = min(max(0, round(box.left)), wide - 1), min(max(0, round(box.top)), high - 1)
        right = min(max(left + 1, round(box.right)), wide)
        bottom = min(max(top + 1, round(box.bottom)), high)
        return corners_of(BoundingBox(left, top, right, bottom))


def _rows(boxes: list[BoundingBox]) -> np.ndarray[Any, np.dtype[np.float64]]:
    return np.array([corners_of(box) for box in boxes], dtype=np.float64).reshape(-1, 4)
