"""Knowledge of what is seen, read as knowledge of what changes: some of its statics are fluents."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

from clingo import ast

from seewhy.errors import KnowledgeError
from seewhy.knowledge.declarations import Declarations
from seewhy.knowledge.language import Knowledge, knowledge_of, knowledge_text
from seewhy.knowledge.rule_nodes import body_atoms, function_of, head_of
from seewhy.knowledge.rule_syntax import parse_rule
from seewhy.knowledge.signature import Predicate, PredicateKind
from seewhy.knowledge.statements import Statement, statements

__all__ = ["read_changeable", "read_changeable_files"]


def read_changeable_files(given: Path, change: Path, *, without: str = "") -> Knowledge:
    """Read two ``.al`` files as :func:`read_changeable` does; errors as there."""
    return read_changeable(
        knowledge_text(given),
        knowledge_text(change),
        files=(str(given), str(change)),
        without=without,
    )


@lru_cache(maxsize=16)
def read_changeable(
    given: str,
    change: str,
    *,
    files: tuple[str, str] = ("knowledge.al", "planning.al"),
    without: str = "",
) -> Knowledge:
    """Return what two texts say together, where the second says what may change.

    What it declares as a fluent takes the place of the static of that name in the first, and what
    axioms conclude from fluents is a defined fluent. So axioms about what is seen in a picture are
    axioms about every state of the world. ``without`` is a sort of which nothing is said: that of
    the picture, which is nothing that there is in the world.

    Raises
    ------
    KnowledgeError
        As :func:`~seewhy.knowledge.language.read_knowledge`; also where a fluent is declared with
        other sorts than the static of its name.

    Examples
    --------
    >>> known = read_changeable(
    ...     "#sort box = {b1, b2}. #static on(box, box). #static high(box). "
    ...     "high(X) if on(X, Y).",
    ...     "#fluent basic on(box, box). #action lift(box). lift(X) causes -on(X, Y).")
    >>> [str(known.signature.kind(name)) for name in ("on", "high", "lift")]
    ['fluent basic', 'fluent defined', 'action']
    """
    seen, rules = _divided(Declarations(), given, files[0])
    gone = {without, *(name for name, found in seen.predicates.items() if without in found.sorts)}
    seen.predicates = {name: p for name, p in seen.predicates.items() if name not in gone}
    rules = [statement for statement in rules if not gone & _predicates(statement)]
    changing = Declarations()
    changing.sorts = dict(seen.sorts)
    changing, more = _divided(changing, change, files[1])
    for name, predicate in changing.predicates.items():
        _check_same_sorts(seen.predicates.get(name), predicate)
    changing.predicates = {**seen.predicates, **changing.predicates}
    fluents = {name for name, found in changing.predicates.items() if found.kind.is_fluent}
    for name in _following(fluents, rules):
        if changing.predicates[name].kind is PredicateKind.STATIC:
            changing.predicates[name] = replace(
                changing.predicates[name], kind=PredicateKind.FLUENT_DEFINED
            )
    return knowledge_of(changing, [*rules, *more], file=files[1])


def _divided(
    declared: Declarations, source: str, file: str
) -> tuple[Declarations, list[Statement]]:
    """The declarations of a text, added to those that there are, and its axioms."""
    rules: list[Statement] = []
    for statement in statements(source, file=file):
        if statement.text.startswith("#"):
            declared.add(statement)
        else:
            rules.append(statement)
    return declared, rules


def _check_same_sorts(seen: Predicate | None, changing: Predicate) -> None:
    if seen is None or (seen.sorts == changing.sorts and changing.kind.is_fluent):
        return
    raise KnowledgeError(
        f"{changing.location}: '{changing}' is declared at {seen.location} as '#static {seen}'; "
        f"declare it as '#fluent basic {seen}' or '#fluent defined {seen}', or call it otherwise"
    )


def _following(fluents: Iterable[str], rules: Iterable[Statement]) -> Iterator[str]:
    """The predicates that axioms conclude from fluents, or from what is concluded from them."""
    rests_on: Mapping[str, set[str]] = _conditions(rules)
    reached = set(fluents)
    while True:
        more = {head for head, names in rests_on.items() if names & reached} - reached
        if not more:
            return
        reached |= more
        yield from sorted(more)


def _conditions(rules: Iterable[Statement]) -> dict[str, set[str]]:
    """What stands at the head of an axiom → the predicates of its conditions."""
    found: dict[str, set[str]] = {}
    for statement in rules:
        _, rule = parse_rule(statement)
        head = head_of(rule)
        if head is not None:
            found.setdefault(head.predicate, set()).update(_asked(rule))
    return found


def _asked(rule: ast.AST) -> set[str]:
    return {function_of(atom).name for atom in body_atoms(rule)}


def _predicates(statement: Statement) -> set[str]:
    _, rule = parse_rule(statement)
    head = head_of(rule)
    return _asked(rule) | ({head.predicate} if head is not None else set())
