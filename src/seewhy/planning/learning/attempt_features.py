"""What is told of the arguments of an action that was tried: the features to learn from."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence

import clingo

from seewhy.knowledge.scene import FeatureVector
from seewhy.knowledge.signature import PredicateKind, Signature
from seewhy.planning.learning.attempts import Attempt
from seewhy.planning.learning.features import NO, YES, ArgumentFeatures, identities
from seewhy.planning.learning.relations import (
    Attribute,
    Facts,
    Kinds,
    Relation,
    attributes,
    relations,
)

__all__ = ["attempt_features"]

_FIXED: Kinds = (PredicateKind.STATIC,)
_CHANGING: Kinds = (PredicateKind.FLUENT_BASIC, PredicateKind.FLUENT_DEFINED)


def attempt_features(
    signature: Signature,
    attempts: Sequence[Attempt],
    facts: Mapping[int, Facts],
    *,
    things: str | None = None,
) -> tuple[ArgumentFeatures, list[FeatureVector]]:
    """Return the features of one action's arguments, and what they are in each attempt.

    Parameters
    ----------
    signature : Signature
    attempts : sequence of Attempt
        Of one action.
    facts : mapping of int to Facts
        Run → what is fixed in it.
    things : str, optional
        The sort of the things of pictures, where there are any.

    Notes
    -----
    First comes what the arguments are like, and how they are related, by what never changes; then
    how they stood when the action was tried; then which they are. Things of pictures have no
    identity: the first thing of one picture is another than that of the next. What is alike in all
    attempts says nothing and is left out, and so is what divides them as what comes before it.
    """
    name = attempts[0].action.name
    told = list(_columns(signature, attempts, facts))
    sorts = signature.predicates[name].sorts
    named = [place for place, sort in enumerate(sorts) if sort != things]
    places, same = identities([attempt.action for attempt in attempts], named)
    columns = {str(source): column for source, column in told}
    columns |= {
        feature: [str(attempt.action.arguments[place]) for attempt in attempts]
        for feature, place in places.items()
    }
    relating = {str(source): source for source, _ in told if isinstance(source, Relation)}
    features = ArgumentFeatures(
        signature=signature,
        predicate=name,
        relations=relating,
        places=places,
        values={
            feature: (YES, NO) if feature in relating else _values(column)
            for feature, column in columns.items()
        },
        same=same,
        attributes={str(source): source for source, _ in told if isinstance(source, Attribute)},
    )
    return features, list(zip(*columns.values(), strict=True)) or [()] * len(attempts)


def _columns(
    signature: Signature, attempts: Sequence[Attempt], facts: Mapping[int, Facts]
) -> Iterator[tuple[Attribute | Relation, list[str | None]]]:
    """What can be told of the arguments, with what it is in each attempt."""
    circumstances = [
        (facts[attempt.run].in_state(attempt.before), attempt.action) for attempt in attempts
    ]
    divided: set[tuple[int, ...]] = set()
    for source in _sources(signature, attempts[0].action.name):
        column: list[str | None]
        if isinstance(source, Attribute):
            column = list(_told(source, circumstances))
        else:
            column = [YES if known.hold(source, action) else NO for known, action in circumstances]
        division = _division(column)
        if len(_values(column)) > 1 and division not in divided:
            divided.add(division)
            yield source, column


def _values(column: Sequence[str | None]) -> tuple[str, ...]:
    return tuple(sorted({value for value in column if value is not None}))


def _sources(signature: Signature, action: str) -> Iterator[Attribute | Relation]:
    """What could be told of an action's arguments, what never changes first."""
    for kinds in (_FIXED, _CHANGING):
        yield from attributes(signature, action, kinds=kinds)
        yield from relations(signature, action, kinds=kinds)


def _told(
    attribute: Attribute, circumstances: Iterable[tuple[Facts, clingo.Symbol]]
) -> Iterator[str | None]:
    """What an attribute is in each attempt; None where nothing, or not one value, is known."""
    for known, action in circumstances:
        found = known.value(attribute, action)
        yield next(iter(found)) if len(found) == 1 else None


def _division(column: Sequence[Hashable]) -> tuple[int, ...]:
    """How values divide cases, whatever they are called: equal ones have equal numbers."""
    numbers: dict[Hashable, int] = {}
    return tuple(numbers.setdefault(value, len(numbers)) for value in column)
