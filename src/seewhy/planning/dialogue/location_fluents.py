"""Which fluents of a domain say where things are, and what is somewhere."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

import clingo

from seewhy.knowledge.signature import PredicateKind
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.planner.mutex import mutexes

_AT = "in|at|on|under|behind|near|inside|beside|on top of|next to"


@dataclass(frozen=True)
class Place:
    """A fluent that says of one argument (``thing``) that it is at another (``place``).

    ``preposition`` is the word before the place; ``single`` says that a thing is at one place
    at most.
    """

    predicate: str
    thing: int
    place: int
    preposition: str
    single: bool


def places(domain: PlanningDomain) -> list[Place]:
    """Return the fluents of two arguments that are said with a preposition before one of them.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> for fluent in places(load_planning_domain("robot_assistant")):
    ...     print(fluent.predicate, fluent.preposition, fluent.single)
    loc in True
    present in False
    """
    return list(_places(domain))


def _places(domain: PlanningDomain) -> Iterator[Place]:
    signature = domain.knowledge.signature
    single = {mutex.predicate: mutex.position for mutex in mutexes(domain.knowledge)}
    for name, table in domain.words.fluents.items():
        predicate = signature.predicates[name]
        found = re.search(rf"\b({_AT}) \{{(\d)\}}", table.say)
        if found and len(predicate.sorts) == 2 and predicate.kind is PredicateKind.FLUENT_BASIC:
            place = int(found.group(2))
            yield Place(name, 1 - place, place, found.group(1), single.get(name) == place)


def whereabouts(domain: PlanningDomain, state: State, thing: str) -> clingo.Symbol | None:
    """Return the literal that says where a thing is, where it is believed to be somewhere."""
    for fluent in places(domain):
        if fluent.single:
            for literal in state.positive(fluent.predicate):
                if str(literal.arguments[fluent.thing]) == thing:
                    return literal
    return None


def place_of(domain: PlanningDomain, state: State, thing: str) -> str | None:
    """Return the place where a thing is, where it is believed to be somewhere."""
    literal = whereabouts(domain, state, thing)
    for place in places(domain):
        if literal is not None and place.predicate == literal.name:
            return str(literal.arguments[place.place])
    return None


def contents(domain: PlanningDomain, state: State, place: str) -> list[clingo.Symbol]:
    """Return the literals that say what is at a place."""
    return [
        literal
        for fluent in places(domain)
        for literal in state.positive(fluent.predicate)
        if str(literal.arguments[fluent.place]) == place
    ]
