"""What is fixed about the things that a fluent speaks of: the features that are learned from."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass
from itertools import product

import clingo

from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.dynamics import fixed_rules
from seewhy.knowledge.grounding_size import grounding_size
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.signature import PredicateKind, Signature


@dataclass(frozen=True)
class Relation:
    """A static, or a sort, over arguments of a fluent.

    Attributes
    ----------
    predicate : str
    places : tuple of (int or None)
        For each argument of the static, which argument of the fluent it is; None for anything.
    sorts : tuple of str
        The sorts of its arguments.
    is_sort : bool

    Examples
    --------
    >>> str(Relation("work_place", (0, 1), ("person", "place")))
    'work_place(0, 1)'
    >>> str(Relation("work_place", (None, 1), ("person", "place")))
    'work_place(_, 1)'
    """

    predicate: str
    places: tuple[int | None, ...]
    sorts: tuple[str, ...]
    is_sort: bool = False

    def __str__(self) -> str:
        shown = ", ".join("_" if place is None else str(place) for place in self.places)
        return f"{self.predicate}({shown})"

    def of(self, terms: Collection[str]) -> str:
        """Return it over terms, one for each argument of the fluent."""
        every = list(terms)
        shown = ", ".join("_" if place is None else every[place] for place in self.places)
        return f"{self.predicate}({shown})"


def relations(signature: Signature, fluent: str) -> list[Relation]:
    """Return the relations that a fluent's arguments could stand in: those with all of them first.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> office = load_planning_domain("robot_assistant").knowledge.signature
    >>> [str(relation) for relation in relations(office, "loc")][:4]
    ['work_place(0, 1)', 'printer(1)', 'robot(0)', 'person(0)']
    """
    found = sorted(_relations(signature, fluent), key=lambda relation: relation.places.count(None))
    return [relation for relation in found if any(place is not None for place in relation.places)]


def _relations(signature: Signature, fluent: str) -> Iterator[Relation]:
    sorts = signature.predicates[fluent].sorts
    members = [set(signature.members(sort)) for sort in sorts]
    for name, predicate in signature.predicates.items():
        if predicate.kind is not PredicateKind.STATIC or not predicate.sorts:
            continue
        fitting: list[list[int | None]] = [
            [n for n, theirs in enumerate(members) if theirs & set(signature.members(sort))]
            for sort in predicate.sorts
        ]
        if len(predicate.sorts) > 1:
            fitting = [[*places, None] for places in fitting]
        for places in product(*fitting):
            used = [place for place in places if place is not None]
            if len(used) == len(set(used)):
                yield Relation(name, places, predicate.sorts)
    for place, sort in enumerate(sorts):
        for name in signature.sorts:
            if set(signature.members(name)) < set(signature.members(sort)):
                yield Relation(name, (place,), (name,), is_sort=True)


class Facts:
    """What is fixed, as it follows from the knowledge.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> facts = Facts(load_planning_domain("robot_assistant").knowledge)
    >>> at_work = Relation("work_place", (0, 1), ("person", "place"))
    >>> in_kitchen = clingo.parse_term("loc(sally,kitchen)")
    >>> facts.hold(at_work, in_kitchen)
    False
    >>> facts.hold(Relation("work_place", (0, None), ("person", "place")), in_kitchen)
    True
    """

    def __init__(self, knowledge: Knowledge) -> None:
        control = BoundedControl("\n".join(fixed_rules(knowledge)), size=grounding_size(knowledge))
        self._known: dict[str, set[tuple[str, ...]]] = {}
        for atom in control.by_signature("holds", 1):
            literal = atom.symbol.arguments[0]
            if literal.positive:
                tuples = self._known.setdefault(literal.name, set())
                tuples.add(tuple(map(str, literal.arguments)))
        for atom in control.by_signature("sort", 2):
            sort, member = map(str, atom.symbol.arguments)
            self._known.setdefault(sort, set()).add((member,))
        self._parts: dict[tuple[str, tuple[int, ...]], set[tuple[str, ...]]] = {}

    def hold(self, relation: Relation, fluent: clingo.Symbol) -> bool:
        """Whether the arguments of a fluent stand in a relation."""
        terms = list(map(str, fluent.arguments))
        asked = tuple(n for n, place in enumerate(relation.places) if place is not None)
        values = tuple(terms[place] for place in relation.places if place is not None)
        key = relation.predicate, asked
        if key not in self._parts:
            known = self._known.get(relation.predicate, set())
            self._parts[key] = {tuple(arguments[n] for n in asked) for arguments in known}
        return values in self._parts[key]
