"""Objects that knowledge does not tell apart, so that what is asked of one is asked of all.

Two members of the same sorts are interchangeable where the axioms stay the same when the two change
places. What follows a state follows then from the state in which they have changed places, too. So
of all that may differ in what follows, it is enough to look at one of those that such an exchange
makes of each other: at the one in which interchangeable objects come in their order.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from seewhy.knowledge.axiom import Axiom, Literal, predicates_in, variables_in
from seewhy.knowledge.language import Knowledge

__all__ = ["first_of_each", "interchangeable"]

_MOST_TOGETHER = 20_000
"""Choices of members that are listed: of more it would take longer than it saves."""
_ORDER = re.compile(r"[<>]")
_BOUND = re.compile(r"\}\s*[<>]=?\s*\w+|\w+\s*[<>]=?\s*#count\b")
"""How many there are, compared with a number."""


def interchangeable(knowledge: Knowledge) -> tuple[tuple[str, ...], ...]:
    """Return the groups of two members or more that knowledge does not tell apart.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge('''
    ... #sort box = {b1, b2, b3}. #static heavy(box). #static red(box). #fluent basic on(box, box).
    ... heavy(b3). red(b1). -on(X, Y) if heavy(X), box(Y).
    ... ''')
    >>> interchangeable(known)
    (('b1', 'b2'),)
    """
    if _compares_objects(knowledge):
        return ()
    told = _texts(knowledge)
    sorts = knowledge.signature.sorts.values()
    of_sorts: dict[tuple[str, ...], list[str]] = {}
    members = dict.fromkeys(member for sort in sorts for member in sort.members or ())
    for member in members:
        if not member.lstrip("-").isdigit():
            mine = tuple(sort.name for sort in sorts if member in (sort.members or ()))
            of_sorts.setdefault(mine, []).append(member)
    found: list[tuple[str, ...]] = []
    for alike in of_sorts.values():
        groups: list[list[str]] = []
        for member in alike:
            same = next((g for g in groups if _swapped(told, g[0], member) == told), None)
            if same is None:
                groups.append([member])
            else:
                same.append(member)
        found += [tuple(group) for group in groups if len(group) > 1]
    return tuple(found)


def first_of_each(
    groups: Sequence[Sequence[str]], places: Sequence[Sequence[str]]
) -> list[tuple[str, ...]] | None:
    """Return one of each choice of members that an exchange makes of another.

    ``places`` are the members for each place. None where there are too many to list.

    Examples
    --------
    >>> first_of_each([("b1", "b2", "b3")], [("b1", "b2", "b3"), ("b1", "b2", "b3")])
    [('b1', 'b1'), ('b1', 'b2')]
    """
    group_of = {member: tuple(group) for group in groups for member in group}
    chosen: list[tuple[str, ...]] = [()]
    for members in places:
        chosen = [
            (*before, member)
            for before in chosen
            for member in members
            if _in_order((*before, member), group_of.get(member, (member,)))
        ]
        if len(chosen) > _MOST_TOGETHER:
            return None
    return chosen


def _in_order(chosen: Sequence[str], group: tuple[str, ...]) -> bool:
    """Whether the members of a group come in its order, each for the first time."""
    seen = tuple(dict.fromkeys(member for member in chosen if member in group))
    return seen == group[: len(seen)]


def _compares_objects(knowledge: Knowledge) -> bool:
    """Whether an axiom asks which of two comes first by name, or reckons with what is no number."""
    return any(
        _orders(condition.text, axiom, knowledge)
        for axiom in knowledge.axioms
        for condition in axiom.body
        if condition.literal is None
    )


def _orders(text: str, axiom: Axiom, knowledge: Knowledge) -> bool:
    if "#" in text:
        counted = "#count" in text and text.count("#") == 1
        return not counted or bool(_ORDER.search(_BOUND.sub("", text)))
    if not _ORDER.search(text):
        return False
    numbers = set(_variables_of_numbers(axiom, knowledge))
    return not set(variables_in(text)) <= numbers


def _variables_of_numbers(axiom: Axiom, knowledge: Knowledge) -> Iterator[str]:
    signature = knowledge.signature
    literals = [axiom.head, *(part.literal for part in axiom.body)]
    for literal in filter(None, literals):
        if literal.predicate not in signature.predicates:
            continue
        sorts = signature.predicates[literal.predicate].sorts
        for argument, sort in zip(literal.arguments, sorts, strict=True):
            members = signature.members(sort)
            if members and all(member.lstrip("-").isdigit() for member in members):
                yield from variables_in(argument)


def _texts(knowledge: Knowledge) -> frozenset[str]:
    """The axioms, without facts for which no axiom asks."""
    asked = [
        part.literal
        for axiom in knowledge.axioms
        for part in axiom.body
        if part.literal is not None
    ]
    within = {
        name
        for axiom in knowledge.axioms
        for part in axiom.body
        if part.literal is None
        for name in predicates_in(part.text)
    }
    changes = knowledge.signature.changes
    return frozenset(
        f"{axiom.kind}: {axiom}"
        for axiom in knowledge.axioms
        if axiom.body
        or changes(axiom.head.predicate)
        or axiom.head.predicate in within
        or any(_may_be(literal, axiom.head) for literal in asked)
    )


def _may_be(asked: Literal, fact: Literal) -> bool:
    """Whether a fact may be what a condition asks for."""
    if (asked.predicate, asked.positive) != (fact.predicate, fact.positive):
        return False
    return all(
        one == other or not re.fullmatch(r"[a-z]\w*|\d+", one)
        for one, other in zip(asked.arguments, fact.arguments, strict=True)
    )


def _swapped(texts: Iterable[str], one: str, other: str) -> frozenset[str]:
    """The axioms, where two members have changed places."""
    exchange = {one: other, other: one}
    names = "|".join(re.escape(name) for name in exchange)
    pattern = re.compile(rf"(?<!\w)(?:{names})(?!\w)")
    return frozenset(pattern.sub(lambda name: exchange[name.group()], text) for text in texts)
