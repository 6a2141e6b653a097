"""Evaluate, where pictures show several things: what is found, and what is read rightly."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from seewhy.domain.domain import Domain
from seewhy.domain.tables import CLASS

__all__ = ["Row", "WrongPicture", "is_of_things_seen", "rows_of_things", "wrong_pictures"]


@dataclass(frozen=True)
class Row:
    """What is read, in words, how often rightly, and the share of the most frequent value."""

    words: str
    accuracy: float
    majority: float
    right: int
    of: int


@dataclass(frozen=True)
class WrongPicture:
    """A picture in which something is read wrongly.

    Attributes
    ----------
    picture : str
    wrong : sequence of (str, float or None)
        What, in words, and how probable the model took it to be.
    changed : bool
        Whether its boxes or labels were changed since.
    """

    picture: str
    wrong: Sequence[tuple[str, float | None]]
    changed: bool


def is_of_things_seen(found: object) -> bool:
    """Whether what an evaluation printed is about several things in each picture."""
    return isinstance(found, dict) and "scenes_wholly_right" in found


def rows_of_things(domain: Domain, found: Mapping[str, Any]) -> Iterator[Row]:
    """What is read of things, of two of them, and of the picture; not what the domain has lost.

    Parameters
    ----------
    domain : Domain
        As it is by now.
    found : mapping
        What ``seewhy evaluate --json`` printed.
    """
    things = domain.things
    if things is None:
        return
    for key, seen in found["features"].items():
        if key in things.features:
            yield _row(f"{things.features[key].name} of a {things.one}", seen)
    for key, seen in found["relations"].items():
        if key in things.relations:
            yield _row(things.relations[key].say.format("one", "another"), seen)
    if found["class"] is not None:
        yield _row(CLASS, found["class"])


def wrong_pictures(
    found: Mapping[str, Any], *, pictures: Collection[str], changed: Collection[str]
) -> list[WrongPicture]:
    """The pictures of a project that are not wholly right."""
    return [
        WrongPicture(scene["image"], _with_sureness(scene), scene["image"] in changed)
        for scene in found["wrong"]
        if scene["image"] in pictures
    ]


def _with_sureness(scene: Mapping[str, Any]) -> list[tuple[str, float | None]]:
    """What is read wrongly; evaluations of earlier versions do not tell how sure it was."""
    sure = scene.get("sure", [None] * len(scene["wrong"]))
    return list(zip(scene["wrong"], sure, strict=True))


def _row(words: str, seen: Mapping[str, Any]) -> Row:
    return Row(words, seen["accuracy"], seen["majority"], seen["right"], seen["of"])
