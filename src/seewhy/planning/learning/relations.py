"""What is so of the things that a fluent or an action speaks of: the features to learn from."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from copy import copy
from dataclasses import dataclass
from itertools import product

import clingo

from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.dynamics import fixed_rules
from seewhy.knowledge.grounding_size import grounding_size
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.signature import PredicateKind, Signature
from seewhy.planning.diagnosis.belief_state import State

Kinds = tuple[PredicateKind, ...]


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


@dataclass(frozen=True)
class Attribute:
    """What something about arguments is: the value that stands for the argument left open.

    Attributes
    ----------
    predicate : str
    places : tuple of (int or None)
        For each of its arguments, which argument of the action it is; None for the value.

    Examples
    --------
    >>> colour = Attribute("colour", (1, None))
    >>> str(colour), colour.of(["R", "X"], "red")
    ('colour(1, ?)', 'colour(X, red)')
    """

    predicate: str
    places: tuple[int | None, ...]

    def __str__(self) -> str:
        shown = ", ".join("?" if place is None else str(place) for place in self.places)
        return f"{self.predicate}({shown})"

    def of(self, terms: Sequence[str], value: str) -> str:
        """Return it over terms, one for each argument of the action, with a value."""
        shown = ", ".join(value if place is None else terms[place] for place in self.places)
        return f"{self.predicate}({shown})"


def attributes(signature: Signature, action: str, *, kinds: Kinds) -> list[Attribute]:
    """Return what could be told of an action's arguments: their colour, how high they are.

    The argument that is left open is of another sort than all that the action is about, and not
    the only one.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> table = load_planning_domain("tabletop").knowledge.signature
    >>> list(map(str, attributes(table, "pick_up", kinds=(PredicateKind.STATIC,))))
    ['size(1, ?)', 'colour(1, ?)', 'material(1, ?)', 'shape(1, ?)']
    """
    about = [set(signature.members(sort)) for sort in signature.predicates[action].sorts]
    found = []
    for relation in _relations(signature, action, kinds):
        left = [
            set(signature.members(sort))
            for sort, place in zip(relation.sorts, relation.places, strict=True)
            if place is None
        ]
        some = len(left) < len(relation.places)
        if some and len(left) == 1 and not any(left[0] & members for members in about):
            found.append(Attribute(relation.predicate, relation.places))
    return found


def relations(
    signature: Signature, fluent: str, *, kinds: Kinds = (PredicateKind.STATIC,)
) -> list[Relation]:
    """Return the relations that a fluent's arguments could stand in: those with all of them first.

    They are of some kinds of predicates; sorts are among them where statics are.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> office = load_planning_domain("robot_assistant").knowledge.signature
    >>> [str(relation) for relation in relations(office, "loc")][:4]
    ['work_place(0, 1)', 'printer(1)', 'robot(0)', 'person(0)']
    """
    found = sorted(
        _relations(signature, fluent, kinds), key=lambda relation: relation.places.count(None)
    )
    return [relation for relation in found if any(place is not None for place in relation.places)]


def _relations(signature: Signature, fluent: str, kinds: Kinds) -> Iterator[Relation]:
    sorts = signature.predicates[fluent].sorts
    members = [set(signature.members(sort)) for sort in sorts]
    for name, predicate in signature.predicates.items():
        if predicate.kind not in kinds or not predicate.sorts:
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
    for place, sort in enumerate(sorts) if PredicateKind.STATIC in kinds else ():
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
        self._known = _tuples(atom.symbol.arguments[0] for atom in control.by_signature("holds", 1))
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

    def in_state(self, state: State) -> Facts:
        """Return what is so in a state, too: what is believed of the fluents."""
        found = copy(self)
        found._known = {**self._known, **_tuples(state.holds)}
        found._parts = {}
        return found

    def value(self, attribute: Attribute, action: clingo.Symbol) -> frozenset[str]:
        """What an attribute of an action's arguments is; empty where nothing is known of it."""
        terms = list(map(str, action.arguments))
        asked = [None if place is None else terms[place] for place in attribute.places]
        return frozenset(
            arguments[asked.index(None)]
            for arguments in self._known.get(attribute.predicate, set())
            if all(term in (None, told) for term, told in zip(asked, arguments, strict=True))
        )


def _tuples(literals: Iterable[clingo.Symbol]) -> dict[str, set[tuple[str, ...]]]:
    """Predicate → the arguments of which it holds."""
    found: dict[str, set[tuple[str, ...]]] = {}
    for literal in literals:
        if literal.positive:
            found.setdefault(literal.name, set()).add(tuple(map(str, literal.arguments)))
    return found
