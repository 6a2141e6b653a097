"""The things that somebody drew in a project's pictures: a fold over its record."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations
from typing import Any

from seewhy.data.thing import CORNERS, BoundingBox, Thing
from seewhy.domain.things import Things
from seewhy.errors import SeeWhyError
from seewhy.studio.label import Label
from seewhy.studio.record import Entry

__all__ = [
    "BOXES",
    "DrawnThing",
    "Pair",
    "PictureThings",
    "corners_of",
    "counted",
    "fold_boxes",
    "require_possible",
]

BOXES = "boxes"
"""Body: ``boxes``, picture → the name of a thing → what became of it, and ``how``.

None: it was removed. Else a mapping with any of ``new`` (true: it came), ``box`` (four numbers, or
None) and ``values`` (feature → value, None: nobody knows). ``related`` has picture → what is said
of two things: relation, thing, other, and whether it holds (None: nobody knows). ``none`` has
picture → whether somebody said that nothing is in it.
"""

Pair = tuple[str, str, str]
"""A relation, a thing and the other."""


@dataclass(frozen=True)
class DrawnThing:
    """A thing in a picture.

    Attributes
    ----------
    name : str
        Tells it from the picture's others.
    box : BoundingBox or None
        In pixels of the upright picture.
    values : mapping of str to Label
        Feature → what somebody said.
    times : int
        How often it came without being removed: more than once only where what removed it was
        taken back later.
    """

    name: str
    box: BoundingBox | None = None
    values: Mapping[str, Label] = field(default_factory=dict)
    times: int = 1

    def as_thing(self) -> Thing:
        """The same as datasets have it."""
        return Thing(self.name, {key: label.value for key, label in self.values.items()}, self.box)


@dataclass(frozen=True)
class PictureThings:
    """What is drawn in one picture.

    Attributes
    ----------
    things : mapping of str to DrawnThing
        By their names, in the order in which they came.
    related : mapping of Pair to bool
        What somebody said of two of them.
    none : bool
        Whether somebody said that there are none.
    """

    things: Mapping[str, DrawnThing] = field(default_factory=dict)
    related: Mapping[Pair, bool] = field(default_factory=dict)
    none: bool = False


def fold_boxes(found: Mapping[str, PictureThings], entry: Entry) -> dict[str, PictureThings]:
    """Return picture → its things after an entry of the kind :data:`BOXES`.

    What is said of a thing that is not there is passed over: what drew it was taken back.

    Examples
    --------
    >>> cup = {"new": True, "box": [1, 2, 5, 8], "values": {"colour": "red"}}
    >>> drawn = Entry(1, "", "Ada", BOXES, {"boxes": {"a.png": {"1": cup}}, "how": "drawn"})
    >>> fold_boxes({}, drawn)["a.png"].things["1"].box
    BoundingBox(left=1, top=2, right=5, bottom=8)
    """
    after = dict(found)
    for picture, changes in entry.body.get("boxes", {}).items():
        here = after.get(picture, PictureThings())
        things, related = dict(here.things), dict(here.related)
        for name, change in changes.items():
            if change is None:
                things.pop(name, None)
                related = {pair: so for pair, so in related.items() if name not in pair[1:]}
            elif change.get("new") or name in things:
                things[name] = _changed(things.get(name), name, change, entry)
        after[picture] = PictureThings(things, related, none=here.none and not things)
    for picture, none in entry.body.get("none", {}).items():
        here = after.get(picture, PictureThings())
        after[picture] = replace(here, none=none and not here.things)
    for picture, said in entry.body.get("related", {}).items():
        here = after.get(picture, PictureThings())
        related = dict(here.related)
        for relation, thing, other, holds in said:
            related.pop((relation, thing, other), None)
            if holds is not None and {thing, other} <= here.things.keys():
                related[relation, thing, other] = holds
        after[picture] = replace(here, related=related)
    return after


def require_possible(picture: str, here: PictureThings, things: Things) -> None:
    """Refuse things of a picture that its table could not have.

    Raises
    ------
    SeeWhyError
        If they are more than the domain allows, or one of them is there twice.
    """
    if len(here.things) > things.most:
        raise SeeWhyError(
            f"'{picture}' would have {len(here.things)} {things.many}, and the domain allows "
            f"{things.most}; remove one, or raise most under [things] of domain.toml"
        )
    for thing in here.things.values():
        if thing.times > 1:
            raise SeeWhyError(
                f"'{picture}' would have two {things.many} called '{thing.name}'; remove the one "
                "that is there"
            )
    drawn = [thing.as_thing() for thing in here.things.values() if thing.box is not None]
    for one, other in combinations(drawn, 2):
        if (one.box, one.values) == (other.box, other.values):
            raise SeeWhyError(
                f"'{other.name}' would have the box of '{one.name}' in '{picture}', and nothing "
                "else would tell them apart; draw it otherwise, or say what differs first"
            )


def _changed(
    before: DrawnThing | None, name: str, change: Mapping[str, Any], entry: Entry
) -> DrawnThing:
    if before is None:
        thing = DrawnThing(name)
    elif change.get("new"):
        thing = replace(before, times=before.times + 1)
    else:
        thing = before
    if "box" in change:
        corners: Sequence[float] | None = change["box"]
        thing = replace(thing, box=None if corners is None else BoundingBox(*corners))
    values = dict(thing.values)
    for key, value in change.get("values", {}).items():
        values.pop(key, None)
        if value is not None:
            values[key] = Label(value, entry.who, entry.at, entry.body["how"], entry.number)
    return replace(thing, values=values)


def corners_of(box: BoundingBox) -> list[float]:
    """Left, top, right and bottom, as the record has them."""
    return [getattr(box, corner) for corner in CORNERS]


def counted(drawn: Iterable[PictureThings], key: str) -> Counter[str]:
    """How many things show each value of a feature."""
    return Counter(
        thing.values[key].value
        for here in drawn
        for thing in here.things.values()
        if key in thing.values
    )
