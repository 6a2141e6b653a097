"""What a list of relations leaves out: of a relation that is listed at all, no more is so."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

from seewhy.data.thing import Related, Thing
from seewhy.domain.things import Things

__all__ = ["contradicted", "not_listed"]

_Pair = tuple[str, str, str]


def _pairs(one: Related, things: Things) -> Iterator[_Pair]:
    """What a statement speaks of: its relation of the two, and the converse the other way."""
    yield one.relation, one.thing, one.other
    if (converse := things.relations[one.relation].converse) is not None:
        yield converse, one.other, one.thing


def contradicted(said: Sequence[Related], things: Things) -> tuple[Related, Related] | None:
    """Return two statements of which one says what the other denies, if there are such.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> things = load_domain("tabletop").things
    >>> both = [Related("left", "cup", "book"), Related("right", "book", "cup", holds=False)]
    >>> contradicted(both, things) == tuple(both)
    True
    """
    first: dict[_Pair, Related] = {}
    for relation in said:
        for pair in _pairs(relation, things):
            if first.setdefault(pair, relation).holds is not relation.holds:
                return first[pair], relation
    return None


def not_listed(
    said: Sequence[Related], here: Sequence[Thing], things: Things, listed: Collection[str]
) -> Iterator[Related]:
    """Yield that of the relations that are listed, what is not said of two things is not so.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> things = load_domain("tabletop").things
    >>> cup, book = Thing("cup"), Thing("book")
    >>> [(r.relation, r.thing, r.other, r.holds)
    ...  for r in not_listed([Related("left", "cup", "book")], [cup, book], things, ["left"])]
    [('left', 'book', 'cup', False)]
    """
    told = {pair for relation in said for pair in _pairs(relation, things)}
    for relation in things.relations:
        if relation not in listed:
            continue
        for thing in here:
            for other in here:
                if thing is not other and (relation, thing.name, other.name) not in told:
                    yield Related(relation, thing.name, other.name, holds=False)
