"""Fluents of which at most one holds: ``-p(X, V2) if p(X, V1), V1 != V2``."""

from __future__ import annotations

import re
from dataclasses import dataclass

from seewhy.knowledge.axiom import Axiom, AxiomKind
from seewhy.knowledge.language import Knowledge

_DIFFER = re.compile(r"\s*(\w+)\s*!=\s*(\w+)\s*$")


@dataclass(frozen=True)
class Mutex:
    """A predicate that holds of at most one value of one argument.

    ``stays_exact`` says that no axiom but ``axiom`` makes it false: where one value held at
    first, one holds in every state.
    """

    predicate: str
    position: int
    axiom: Axiom
    stays_exact: bool


def mutexes(knowledge: Knowledge) -> list[Mutex]:
    """Return the groups of fluents that exclude one another, as constraints say so.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> (mutex,) = mutexes(read_knowledge("#sort place = {a, b}. #fluent basic at(place). "
    ...     "-at(P2) if at(P1), P1 != P2."))
    >>> mutex.predicate, mutex.position, mutex.stays_exact
    ('at', 0, True)
    """
    found: dict[str, Mutex] = {}
    for axiom in knowledge.axioms:
        position = _excluded_position(axiom)
        if position is not None:
            name = axiom.head.predicate
            others = [
                other
                for other in knowledge.axioms
                if other is not axiom
                and other.head.predicate == name
                and not other.head.positive
                and other.kind in (AxiomKind.CAUSAL_LAW, AxiomKind.STATE_CONSTRAINT)
            ]
            found[name] = Mutex(name, position, axiom, stays_exact=not others)
    return list(found.values())


def _excluded_position(axiom: Axiom) -> int | None:
    if axiom.kind is not AxiomKind.STATE_CONSTRAINT or len(axiom.body) != 2:
        return None
    head = axiom.head
    literals = [
        condition.literal for condition in axiom.body if condition.literal and not condition.absent
    ]
    compared = [match for condition in axiom.body if (match := _DIFFER.match(condition.text))]
    if len(literals) != 1 or len(compared) != 1 or head.positive:
        return None
    (body,) = literals
    if body is None or body.predicate != head.predicate or not body.positive:
        return None
    differing = [
        place
        for place, (one, other) in enumerate(zip(head.arguments, body.arguments, strict=True))
        if one != other
    ]
    named = [*head.arguments, *(body.arguments[place] for place in differing)]
    if len(differing) != 1 or len(set(named)) != len(named):
        return None
    if not all(name[0].isupper() for name in named):
        return None
    (place,) = differing
    return (
        place if {*compared[0].groups()} == {head.arguments[place], body.arguments[place]} else None
    )
