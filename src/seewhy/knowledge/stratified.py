"""Whether knowledge is stratified: no literal depends on its own absence."""

from __future__ import annotations

from collections.abc import Iterator

from seewhy.knowledge.axiom import Axiom, AxiomKind, predicates_in
from seewhy.knowledge.language import Knowledge

_Kind = tuple[str, bool]  # a predicate, affirmed or denied


def is_stratified(knowledge: Knowledge) -> bool:
    """Whether no predicate depends, through ``not`` or an aggregate, on itself.

    Such knowledge has one answer set for every scene, contradictory or not (Apt, Blair and Walker,
    "Towards a theory of declarative knowledge", 1988). An affirmed predicate and the same denied
    count as two.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> declared = "#sort scene. #static p(scene). #static q(scene)."
    >>> is_stratified(read_knowledge(f"{declared} p(S) if scene(S), not q(S)."))
    True
    >>> is_stratified(read_knowledge(f"{declared} default p(S) if scene(S). -p(S) if p(S)."))
    False
    """
    rests_on: dict[_Kind, set[_Kind]] = {}
    denies: list[tuple[_Kind, _Kind]] = []
    for axiom in knowledge.axioms:
        head = (axiom.head.predicate, axiom.head.positive)
        for kind, weakly in _asked(axiom):
            rests_on.setdefault(head, set()).add(kind)
            if weakly:
                denies.append((head, kind))
    return not any(head in _reached(rests_on, kind) for head, kind in denies)


def _asked(axiom: Axiom) -> Iterator[tuple[_Kind, bool]]:
    """What an axiom depends on, and whether not simply on that it is believed."""
    for condition in axiom.body:
        literal = condition.literal
        if literal is not None:
            yield (literal.predicate, literal.positive), condition.absent
            continue
        for name in predicates_in(condition.text):
            yield (name, True), True
            yield (name, False), True
    if axiom.kind is AxiomKind.DEFAULT:
        yield (axiom.head.predicate, not axiom.head.positive), True


def _reached(rests_on: dict[_Kind, set[_Kind]], start: _Kind) -> set[_Kind]:
    found: set[_Kind] = set()
    waiting = [start]
    while waiting:
        kind = waiting.pop()
        if kind not in found:
            found.add(kind)
            waiting += rests_on.get(kind, ())
    return found
