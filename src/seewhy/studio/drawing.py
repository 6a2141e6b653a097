"""What is done to the things of a picture: drawn, moved, removed, said; each an entry."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any

from seewhy.data.importers.picture_files import read_header
from seewhy.data.thing import BoundingBox
from seewhy.domain.things import SEEN, Things
from seewhy.errors import PictureError, SeeWhyError
from seewhy.studio.drawn_things import (
    BOXES,
    PictureThings,
    corners_of,
    fold_boxes,
    require_possible,
)
from seewhy.studio.project import Project
from seewhy.studio.record import Entry
from seewhy.studio.thing_writing import said_first
from seewhy.text.nearest import did_you_mean

__all__ = [
    "draw",
    "move",
    "note_things",
    "picture_size",
    "relate",
    "relate_to_no_other",
    "remove",
    "say_none",
    "say_of_thing",
    "things_of",
]

_MIDDLE = 3
"""A box that is added by a key takes one part of so many of each side."""
_APART = 20
"""Where one is already, the next lies a part of so many of each side further."""


def things_of(project: Project) -> Things:
    """What the domain says of things.

    Raises
    ------
    SeeWhyError
        If it has none.
    """
    things = project.domain().things
    if things is None:
        raise SeeWhyError(
            "the domain has no things; what they are stands under [things] in its domain.toml"
        )
    return things


def picture_size(file: Path) -> tuple[int, int]:
    """Width and height of the upright picture, in its own pixels.

    Raises
    ------
    PictureError
        If it cannot be read.
    """
    try:
        return _size(file, file.stat().st_mtime_ns)
    except OSError:
        raise PictureError(f"{file.name} cannot be read; look whether it is still there") from None


def draw(project: Project, picture: str, corners: Sequence[float] | None, *, who: str) -> str:
    """Draw a box around a thing, in the middle where no corners are given; return its name.

    Raises
    ------
    SeeWhyError
        If there are no such corners in the picture, or no more things are allowed.
    """
    here = project.labels().drawn_in(picture)
    size = picture_size(project.picture_file(picture))
    box = _middle(here, size) if corners is None else _box(corners, size, picture)
    name = next(str(n) for n in range(1, len(here.things) + 2) if str(n) not in here.things)
    change = {"new": True, "box": corners_of(box)}
    note_things(project, picture, {"boxes": {picture: {name: change}}}, who=who, how="drawn")
    return name


def move(project: Project, picture: str, thing: str, corners: Sequence[float], *, who: str) -> None:
    """Give a thing another box.

    Raises
    ------
    SeeWhyError
        If there is no such thing, or no such box in the picture.
    """
    here = _here(project, picture, thing)
    box = _box(corners, picture_size(project.picture_file(picture)), picture)
    if box != here.things[thing].box:
        change = {"box": corners_of(box)}
        note_things(project, picture, {"boxes": {picture: {thing: change}}}, who=who, how="moved")


def remove(project: Project, picture: str, thing: str, *, who: str) -> None:
    """Remove a thing, with what is said of it and others."""
    _here(project, picture, thing)
    note_things(project, picture, {"boxes": {picture: {thing: None}}}, who=who, how="removed")


def say_none(project: Project, picture: str, none: bool, *, who: str) -> None:
    """Say that nothing is in a picture, or leave open again whether there is.

    Raises
    ------
    SeeWhyError
        If things are drawn in it.
    """
    things = things_of(project)
    here = project.labels().drawn_in(picture)
    if none and here.things:
        count = len(here.things)
        raise SeeWhyError(
            f"'{picture}' has {count} {things.one if count == 1 else things.many}; remove "
            f"{'it' if count == 1 else 'them'} before saying that there are none"
        )
    if none != here.none:
        note_things(project, picture, {"none": {picture: none}}, who=who, how="typed")


def say_of_thing(
    project: Project, picture: str, thing: str, feature: str, value: str | None, *, who: str
) -> None:
    """Say the value of a thing's feature; None for nobody knows.

    Raises
    ------
    SeeWhyError
        If there is no such thing, feature or value.
    """
    features = things_of(project).features
    _here(project, picture, thing)
    if feature not in features:
        raise SeeWhyError(f"'{feature}' is no feature of things; {did_you_mean(feature, features)}")
    known = features[feature].values
    if value is not None and value not in known:
        raise SeeWhyError(f"'{value}' is no value of '{feature}'; {did_you_mean(value, known)}")
    change = {"values": {feature: value}}
    note_things(project, picture, {"boxes": {picture: {thing: change}}}, who=who, how="typed")


def relate(
    project: Project,
    picture: str,
    relation: str,
    thing: str,
    other: str,
    holds: bool | None,
    *,
    who: str,
) -> None:
    """Say whether a relation holds of two things; None for nobody knows.

    Raises
    ------
    SeeWhyError
        If there is no such relation that is seen, or no such thing.
    """
    things = things_of(project)
    _here(project, picture, thing)
    _here(project, picture, other)
    _require_seen(things, relation)
    if thing == other:
        raise SeeWhyError(f"'{relation}' is said of two things; '{thing}' is one")
    said = [*said_first((relation, thing, other), things), holds]
    note_things(project, picture, {"related": {picture: [said]}}, who=who, how="typed")


def relate_to_no_other(
    project: Project, picture: str, relation: str, thing: str, *, who: str
) -> None:
    """Say that a relation holds of a thing to none of those of which nothing is said yet."""
    things = things_of(project)
    here = _here(project, picture, thing)
    _require_seen(things, relation)
    pairs = [
        said_first((relation, thing, other), things) for other in here.things if other != thing
    ]
    said = [[*pair, False] for pair in pairs if pair not in here.related]
    if said:
        note_things(project, picture, {"related": {picture: said}}, who=who, how="typed")


def note_things(
    project: Project, picture: str, said: Mapping[str, Any], *, who: str, how: str
) -> Entry:
    """Add to the record what became of the things in a picture.

    Raises
    ------
    SeeWhyError
        If they could not stand in a table: too many, or two that nothing tells apart.
    """
    body = {**said, "how": how}
    after = fold_boxes(project.labels().drawn, Entry(0, "", who, BOXES, body))
    require_possible(picture, after[picture], things_of(project))
    return project.note(BOXES, body, who=who)


def _here(project: Project, picture: str, thing: str) -> PictureThings:
    """What is drawn in a picture, with this thing."""
    here = project.labels().drawn_in(picture)
    if thing not in here.things:
        known = did_you_mean(thing, here.things) if here.things else "nothing is drawn in it yet"
        raise SeeWhyError(f"'{thing}' is no thing of '{picture}'; {known}")
    return here


def _require_seen(things: Things, relation: str) -> None:
    seen = [key for key, one in things.relations.items() if one.measure == SEEN]
    if relation in seen:
        return
    if relation in things.relations:
        measure = things.relations[relation].measure
        raise SeeWhyError(f"'{relation}' comes from '{measure}', and nobody has to say it")
    remedy = did_you_mean(relation, seen) if seen else "the domain has none that somebody says"
    raise SeeWhyError(f"'{relation}' is no relation of things; {remedy}")


def _box(corners: Sequence[float], size: tuple[int, int], picture: str) -> BoundingBox:
    """The box of corners, in whole pixels."""
    if not all(math.isfinite(corner) for corner in corners):
        raise SeeWhyError("left, top, right and bottom of a box are numbers; draw it again")
    box = BoundingBox(*(round(corner) for corner in corners))
    shown = ", ".join(f"{corner:g}" for corner in corners_of(box))
    if box.right <= box.left or box.bottom <= box.top:
        raise SeeWhyError(
            f"the box ({shown}) is empty: right must be more than left, and bottom more than top; "
            "draw it larger"
        )
    width, height = size
    if min(box.left, box.top) < 0 or box.right > width or box.bottom > height:
        raise SeeWhyError(
            f"the box ({shown}) reaches out of '{picture}', which is {width} × {height} pixels; "
            "draw it inside"
        )
    return box


def _middle(here: PictureThings, size: tuple[int, int]) -> BoundingBox:
    """A box in the middle, beside those that lie there already."""
    width, height = size
    across, down = max(1, width // _MIDDLE), max(1, height // _MIDDLE)
    taken = {thing.box for thing in here.things.values()}
    for step in range(len(taken) + 1):
        left = ((width - across) // 2 + step * max(1, width // _APART)) % (width - across + 1)
        top = ((height - down) // 2 + step * max(1, height // _APART)) % (height - down + 1)
        box = BoundingBox(left, top, left + across, top + down)
        if box not in taken:
            return box
    return box


@lru_cache(maxsize=2000)
def _size(file: Path, changed: int) -> tuple[int, int]:  # noqa: ARG001
    with file.open("rb") as stream:
        return read_header(stream).size
