"""How large a program may become without variables, told from the sizes of its sorts."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import prod

from clingo import ast

from seewhy.knowledge.axiom import STRING, Axiom, variables_in
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.signature import Location, Predicate, Signature

__all__ = [
    "GroundingSize",
    "axiom_instances",
    "axioms_size",
    "grounding_size",
    "large_grounding",
    "range_instances",
]

_RANGE = re.compile(r"(-?\d+|[\w)])\s*\.\.\s*(-?\d+|[\w(])")
MANY_INSTANCES = 5_000
"""So many instances of axioms are said: grounding them takes a noticeable time."""
_ANY_RANGE = 2**31  # a range between variables may be as long as numbers go
_LARGEST = 10**18  # nothing depends on how much more it is


@dataclass(frozen=True)
class GroundingSize:
    """A bound of what is grounded.

    Attributes
    ----------
    instances : int
        The instances of all axioms, fluents and actions, and of what is seen of things.
    largest : str
        What has most of them, with its place, as errors begin.
    """

    instances: int = 0
    largest: str = "the program"

    def times(self, steps: int) -> GroundingSize:
        """Return the size where all of it is there for every step, or scene."""
        return GroundingSize(min(_LARGEST, self.instances * steps), self.largest)


def grounding_size(knowledge: Knowledge) -> GroundingSize:
    """Return how many instances the axioms, fluents and actions may have, and what things show.

    What no axiom concludes about things is seen of them: of a relation, every pair is grounded.
    Every variable counts with all members of its smallest sort, whatever else is asked of it:
    there are never more instances, and there may be far fewer.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge('''#sort n = 1..400. #static lt(n, n).
    ... lt(A, B) if n(A), n(B), A < B.''')
    >>> size = grounding_size(known)
    >>> size.instances
    160000
    >>> size.largest
    "knowledge.al:2:1: 'lt(A, B) if n(A), n(B), A < B.' has up to 160,000 instances"
    """
    signature = knowledge.signature
    concluded = {axiom.head.predicate for axiom in knowledge.axioms}
    given = [
        predicate
        for predicate in signature.predicates.values()
        if predicate.kind.is_fluent
        or predicate.kind.is_action
        or (predicate.name not in concluded and _is_about_things(predicate, signature))
    ]
    return _size(
        [
            *(
                (_instances(predicate, signature), predicate.location, predicate)
                for predicate in given
            ),
            *_axioms(knowledge.axioms, signature),
        ]
    )


def _is_about_things(predicate: Predicate, signature: Signature) -> bool:
    return any(signature.sorts[sort].of_things for sort in predicate.sorts)


def large_grounding(knowledge: Knowledge) -> str | None:
    """Return what its author may want to know of knowledge that takes long to ground."""
    size = grounding_size(knowledge)
    if size.instances < MANY_INSTANCES:
        return None
    return f"{size.largest}; every question waits for them"


def axioms_size(axioms: Iterable[Axiom], signature: Signature) -> GroundingSize:
    """Return how many instances some axioms may have."""
    return _size([*_axioms(axioms, signature)])


def _axioms(axioms: Iterable[Axiom], signature: Signature) -> Iterator[tuple[int, Location, Axiom]]:
    for axiom in axioms:
        yield axiom_instances(axiom, signature), axiom.location, axiom


def _size(parts: Sequence[tuple[int, Location, Axiom | Predicate]]) -> GroundingSize:
    if not parts:
        return GroundingSize()
    most, place, what = max(parts, key=lambda part: part[0])
    return GroundingSize(
        min(_LARGEST, sum(count for count, _, _ in parts)),
        f"{place}: '{what}' has up to {min(_LARGEST, most):,} instances",
    )


def _instances(predicate: Predicate, signature: Signature) -> int:
    return prod(_members(sort, signature) for sort in predicate.sorts)


def _members(sort: str, signature: Signature) -> int:
    """The members of a sort; that of the picture has one, or a few in a batch."""
    return len(signature.sorts[sort].members or "1")


def axiom_instances(axiom: Axiom, signature: Signature) -> int:
    """Return how many instances an axiom may have: those of its variables and ranges."""
    domains: dict[str, int] = {}
    texts = [
        str(axiom.action or ""),
        str(axiom.head),
        *(condition.text for condition in axiom.body),
    ]
    for text in filter(None, texts):
        for name, arguments in _atoms(text):
            for argument, sort in zip(arguments, signature.argument_sorts(name), strict=True):
                for variable in variables_in(argument):
                    members = _members(sort, signature)
                    domains[variable] = min(members, domains.get(variable, members))
    return min(_LARGEST, prod([*domains.values(), *map(range_instances, texts)]))


def range_instances(text: str) -> int:
    """Return how many instances a term or condition has for its ranges.

    Examples
    --------
    >>> range_instances("on(1..3, 1..4)")
    12
    """
    instances = 1
    for match in _RANGE.finditer(STRING.sub("", text)):
        first, last = match.groups()
        if all(end.lstrip("-").isdecimal() for end in (first, last)):
            instances *= max(1, int(last) - int(first) + 1)
        else:
            instances *= _ANY_RANGE
    return instances


@lru_cache(maxsize=4096)
def _atoms(text: str) -> tuple[tuple[str, tuple[str, ...]], ...]:
    """The atoms of a head or condition, those inside of aggregates included."""
    found: list[ast.AST] = []
    ast.parse_string(f":- {text}.", found.append)
    atoms: list[tuple[str, tuple[str, ...]]] = []

    class Collect(ast.Transformer):
        def visit_SymbolicAtom(self, atom: ast.AST) -> ast.AST:  # noqa: N802
            symbol = atom.symbol
            while symbol.ast_type is ast.ASTType.UnaryOperation:
                symbol = symbol.argument
            atoms.append((symbol.name, tuple(map(str, symbol.arguments))))
            return atom

    Collect().visit(found[1])
    return tuple(atoms)
