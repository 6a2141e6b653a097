"""Changes of a scene of things, one at a time: another value, another place, one more, one less."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from seewhy.data.thing_scene import ThingScene
from seewhy.domain.things import Things

__all__ = [
    "Add",
    "Edit",
    "Move",
    "Recolour",
    "Relate",
    "Remove",
    "edited",
    "is_in_order",
    "scene_after",
    "values_to_try",
]


@dataclass(frozen=True)
class Recolour:
    """A thing has another value of a feature."""

    number: int
    feature: str
    value: str


@dataclass(frozen=True)
class Move:
    """A thing comes to have another place in an order, such as that from left to right.

    ``place`` is how many other things then stand in the relation to it.
    """

    number: int
    relation: str
    place: int


@dataclass(frozen=True)
class Relate:
    """A relation that is no order comes to hold between two things, or not to."""

    number: int
    relation: str
    to: int
    holds: bool


@dataclass(frozen=True)
class Remove:
    """A thing is not there."""

    number: int


@dataclass(frozen=True)
class Add:
    """There is one more thing, with some values and places in orders; other relations to none."""

    values: tuple[tuple[str, str], ...]
    places: tuple[tuple[str, int], ...] = ()
    related: tuple[tuple[str, int], ...] = ()


Edit = Recolour | Move | Relate | Remove | Add


def is_in_order(scene: ThingScene, relation: str) -> bool:
    """Whether a relation puts all things in one order: one is the first, one the second, …"""
    rows = scene.related[relation]
    if any(scene.unknown.get(relation, ())):
        return False
    before = sorted(row.bit_count() for row in rows)
    return before == list(range(scene.count)) and all(
        rows[number] >> number & 1 == 0 for number in range(scene.count)
    )


def edited(scene: ThingScene, things: Things, edits: Sequence[Edit]) -> tuple[ThingScene, int]:
    """Return a scene with some changes made, and the set of things that are then not there."""
    without = 0
    for edit in edits:
        match edit:
            case Remove(number=number):
                without |= 1 << number
            case Recolour(number=number, feature=feature, value=value):
                column = list(scene.values[feature])
                column[number] = value
                scene = replace(scene, values={**scene.values, feature: tuple(column)})
            case Move(number=number, relation=relation, place=place):
                order = [other for other in _order(scene, relation) if other != number]
                order.insert(place, number)
                scene = _in_order(scene, things, relation, order)
            case Relate(number=number, relation=relation, to=to, holds=holds):
                scene = _related(scene, things, relation, (number, to), holds=holds)
            case Add():
                scene = _added(scene, things, edit)
    return scene, without


def scene_after(
    scene: ThingScene, things: Things, edits: Sequence[Edit], *, without: int = 0
) -> tuple[ThingScene, int]:
    """Return a scene with changes made and what then follows, and the things that are not there.

    ``without`` are those that were taken away before.
    """
    changed, gone = edited(scene, things, edits)
    gone |= without
    if scene.conclusions is None:
        return changed, gone
    return scene.conclusions.when_taken_away(changed, gone), gone


def _order(scene: ThingScene, relation: str) -> list[int]:
    return sorted(
        range(scene.count), key=lambda number: scene.related[relation][number].bit_count()
    )


def _in_order(scene: ThingScene, things: Things, relation: str, order: Sequence[int]) -> ThingScene:
    before = 0
    rows, back = [0] * scene.count, [0] * scene.count
    for number in order:
        rows[number] = before
        before |= 1 << number
    for number in order:
        back[number] = before & ~rows[number] & ~(1 << number)
    return _with_rows(scene, things, relation, rows, back)


def _with_rows(
    scene: ThingScene, things: Things, relation: str, rows: list[int], back: list[int]
) -> ThingScene:
    changed: dict[str, tuple[int, ...]] = {relation: tuple(rows)}
    converse = things.relations[relation].converse
    if converse is not None and converse != relation:
        changed[converse] = tuple(back)
    # Where things would then be is not said, so that what is between two is told by relations.
    return replace(scene, related={**scene.related, **changed}, positions=())


def _related(
    scene: ThingScene, things: Things, relation: str, pair: tuple[int, int], *, holds: bool
) -> ThingScene:
    related: dict[str, tuple[int, ...]] = dict(scene.related)
    converse = things.relations[relation].converse
    for key, (one, to) in ((relation, pair), (converse, pair[::-1])):
        if key is not None:
            row = related[key][to]
            changed = row | 1 << one if holds else row & ~(1 << one)
            related[key] = (*related[key][:to], changed, *related[key][to + 1 :])
    return replace(scene, related=related)


def _added(scene: ThingScene, things: Things, edit: Add) -> ThingScene:
    number = scene.count
    values: Mapping[str, str] = dict(edit.values)
    places = dict(edit.places)
    orders = {relation: _order(scene, relation) for relation in places}
    scene = replace(
        scene,
        count=number + 1,
        values={key: (*column, values.get(key)) for key, column in scene.values.items()},
        related={key: (*rows, 0) for key, rows in scene.related.items()},
        unknown={key: (*rows, 0) for key, rows in scene.unknown.items()},
        positions=(),
    )
    for relation, place in places.items():
        order = list(orders[relation])
        order.insert(place, number)
        scene = _in_order(scene, things, relation, order)
    for relation, to in edit.related:
        scene = _related(scene, things, relation, (number, to), holds=True)
    return scene


def values_to_try(
    things: Things, mentioned: Mapping[str, set[str]], compared: set[str]
) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Yield the features that matter to a question, with the values that are worth trying.

    Values of which a question does not speak are as good as each other, and one of them is enough;
    of a feature in which things are compared all are tried.
    """
    for feature, described in things.features.items():
        if feature in compared:
            yield feature, described.values
        elif feature in mentioned:
            others = [value for value in described.values if value not in mentioned[feature]]
            named = [value for value in described.values if value in mentioned[feature]]
            yield feature, (*named, *others[:1])
