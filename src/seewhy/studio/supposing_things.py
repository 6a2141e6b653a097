"""What somebody supposes of the things in a picture: read from an address, and written into one."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from seewhy.dialogue.things.edits import Add, Edit, Move, Recolour, Relate, Remove, is_in_order
from seewhy.domain.things import CONCLUDED, Things
from seewhy.errors import SeeWhyError
from seewhy.text.nearest import did_you_mean

if TYPE_CHECKING:
    from seewhy.agent.things.thing_reply import ReadScene

__all__ = ["Supposition", "edits_of", "fields_of", "loose_relations", "orders", "read_supposition"]

_SAYS = {"yes": True, "no": False}


@dataclass(frozen=True)
class Supposition:
    """What is otherwise than it was read; things are counted from 0, new ones behind the others.

    Attributes
    ----------
    values : mapping of (int, str) to str
        Thing and feature → value.
    gone : frozenset of int
        Things that are not there.
    added : int
        How many more things there are.
    places : mapping of (str, int) to int
        Relation and thing → how many others stand in the relation to it.
    related : mapping of (str, int, int) to bool
        Whether a relation holds of a thing to another.
    at : int or None
        The thing at hand.
    """

    values: Mapping[tuple[int, str], str] = field(default_factory=dict)
    gone: frozenset[int] = frozenset()
    added: int = 0
    places: Mapping[tuple[str, int], int] = field(default_factory=dict)
    related: Mapping[tuple[str, int, int], bool] = field(default_factory=dict)
    at: int | None = None


def orders(read: ReadScene) -> list[str]:
    """Relations that put the things of a picture in one order, of two converses the first."""
    return [key for key in _seen_once(read.things) if is_in_order(read.scene, key)]


def loose_relations(read: ReadScene) -> list[str]:
    """The other relations that are seen or measured, of two converses the first."""
    return [key for key in _seen_once(read.things) if not is_in_order(read.scene, key)]


def _seen_once(things: Things) -> list[str]:
    kept: list[str] = []
    for key, relation in things.relations.items():
        if relation.measure != CONCLUDED and relation.converse not in kept:
            kept.append(key)
    return kept


def read_supposition(fields: Sequence[tuple[str, str]], read: ReadScene) -> Supposition:
    """Return what the fields of an address suppose; what is so anyway is left out.

    ``shows.1.colour=red`` (the first thing is red), ``gone=1``, ``added=2``, ``place.left.1=0``
    (nothing is left of it), ``holds.on.1.2=yes``, ``at=1``. ``go`` is like ``at`` and overrules it;
    ``more`` adds one, which is at hand then. Of a field that comes twice the last is taken; others
    are passed over.

    Raises
    ------
    SeeWhyError
        If one speaks of what there is not.
    """
    said = dict(fields)
    added = _number(said.get("added", "0"), "added", read.things.most) + ("more" in said)
    count = read.scene.count + added
    if count > read.things.most:
        raise SeeWhyError(
            f"there would be {count} {read.things.many}, and the domain allows "
            f"{read.things.most}; take one away first"
        )
    found = Supposition(added=added, gone=frozenset(_gone(fields, count)))
    values: dict[tuple[int, str], str] = {}
    places: dict[tuple[str, int], int] = {}
    related: dict[tuple[str, int, int], bool] = {}
    for name, value in said.items():
        kind, *of = name.split(".")
        if kind == "shows" and len(of) == 2:
            thing, key = _thing(of[0], count), of[1]
            values[thing, key] = _value(read.things, key, value)
        elif kind == "place" and len(of) == 2:
            key, thing = _relation(of[0], orders(read)), _thing(of[1], count)
            places[key, thing] = _number(value, name, count - 1)
        elif kind == "holds" and len(of) == 3:
            key, thing, other = (
                _relation(of[0], loose_relations(read)),
                _thing(of[1], count),
                _thing(of[2], count),
            )
            if value not in _SAYS:
                raise SeeWhyError(f"'{name}' is 'yes' or 'no', got '{value}'")
            related[key, thing, other] = _SAYS[value]
    at = str(count) if "more" in said else said.get("go") or said.get("at")
    found = replace(
        found,
        values=values,
        places=places,
        related=related,
        at=_thing(at, count) if at else None,
    )
    return _otherwise(found, read)


def _otherwise(said: Supposition, read: ReadScene) -> Supposition:
    """Without what is so anyway."""
    scene = read.scene
    here = range(scene.count)
    return replace(
        said,
        values={
            (thing, key): value
            for (thing, key), value in said.values.items()
            if thing not in here or scene.values[key][thing] != value
        },
        places={
            (key, thing): place
            for (key, thing), place in said.places.items()
            if thing not in here or scene.related[key][thing].bit_count() != place
        },
        related={
            (key, thing, other): holds
            for (key, thing, other), holds in said.related.items()
            if thing != other
            and holds
            != (other in here and thing in here and bool(scene.related[key][other] >> thing & 1))
        },
    )


def edits_of(said: Supposition, read: ReadScene) -> tuple[Edit, ...]:
    """Return the changes of the scene: what is added first, what is taken away last."""
    count = read.scene.count
    added = [_added(said, number, read) for number in range(count, count + said.added)]
    related = [
        Relate(thing, key, other, holds)
        for (key, thing, other), holds in said.related.items()
        if thing < count or other > thing
    ]
    return (
        *added,
        *(Recolour(n, key, value) for (n, key), value in said.values.items() if n < count),
        *(Move(n, key, place) for (key, n), place in said.places.items() if n < count),
        *related,
        *(Remove(number) for number in sorted(said.gone)),
    )


def _added(said: Supposition, number: int, read: ReadScene) -> Add:
    """A new thing: like the first value of each feature, behind all others, unless it is said."""
    features = read.things.features
    return Add(
        tuple(
            (key, said.values.get((number, key), feature.values[0]))
            for key, feature in features.items()
        ),
        tuple((key, min(number, said.places.get((key, number), number))) for key in orders(read)),
        tuple(
            (key, other)
            for (key, thing, other), holds in said.related.items()
            if thing == number and other < number and holds
        ),
    )


def fields_of(said: Supposition, *, but: int | None = None) -> Iterator[tuple[str, str]]:
    """Yield the fields that say it, but for what they say of the thing ``but``."""
    for (thing, key), value in said.values.items():
        if thing != but:
            yield f"shows.{thing + 1}.{key}", value
    for (key, thing), place in said.places.items():
        if thing != but:
            yield f"place.{key}.{thing + 1}", str(place)
    for (key, thing, other), holds in said.related.items():
        if thing != but:
            yield f"holds.{key}.{thing + 1}.{other + 1}", "yes" if holds else "no"
    for thing in sorted(said.gone):
        if thing != but:
            yield "gone", str(thing + 1)
    if said.added:
        yield "added", str(said.added)


def _gone(fields: Iterable[tuple[str, str]], count: int) -> Iterator[int]:
    for name, value in fields:
        if name == "gone" and value:
            yield _thing(value, count)


def _thing(said: str, count: int) -> int:
    number = _number(said, "a thing", count)
    if not number:
        raise SeeWhyError("things are counted from 1; choose one in the picture")
    return number - 1


def _number(said: str, what: str, most: int) -> int:
    if not (said.isascii() and said.isdecimal() and len(said) < 4 and int(said) <= most):
        raise SeeWhyError(f"{what} is a number up to {most}, got '{said[:40]}'")
    return int(said)


def _value(things: Things, key: str, value: str) -> str:
    if key not in things.features:
        raise SeeWhyError(f"'{key}' is no feature of things; {did_you_mean(key, things.features)}")
    known = things.features[key].values
    if value not in known:
        raise SeeWhyError(f"'{value}' is no value of '{key}'; {did_you_mean(value, known)}")
    return value


def _relation(key: str, known: Iterable[str]) -> str:
    known = list(known)
    if key not in known:
        remedy = did_you_mean(key, known) if known else "there is none that can be moved"
        raise SeeWhyError(f"'{key}' is no relation that can be said so; {remedy}")
    return key
