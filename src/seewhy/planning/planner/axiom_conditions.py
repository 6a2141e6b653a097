"""The conditions of an axiom, divided: those on fluents, and those that never change."""

from __future__ import annotations

import re

from seewhy.knowledge.axiom import Axiom, Condition, Literal, predicates_in
from seewhy.knowledge.program import held
from seewhy.knowledge.signature import Signature

__all__ = ["asks_more", "atom_of", "fluent_conditions", "simplified", "static_body"]

_ANYTHING = re.compile(r"(?<!\w)_(?!\w)")


def fluent_conditions(axiom: Axiom, signature: Signature) -> list[Condition]:
    return [
        condition
        for condition in axiom.body
        if condition.literal is not None and signature.kind(condition.literal.predicate).is_fluent
    ]


def static_body(axiom: Axiom, signature: Signature) -> list[str]:
    """The conditions that do not change, with the sorts that variables range over."""
    body = []
    for condition in axiom.body:
        literal = condition.literal
        if literal is None:
            if not _mentions_fluent(condition, signature):
                body.append(held(condition.text, signature))
        elif not signature.kind(literal.predicate).is_fluent:
            body.append(held(condition.text, signature))
        else:
            body += _sorts(literal, signature)
    for literal in filter(None, (axiom.action, axiom.head)):
        body += _sorts(literal, signature)
    return list(dict.fromkeys(body))


def asks_more(axiom: Axiom, signature: Signature) -> bool:
    """Whether a condition asks about several fluents at once: in an aggregate, or with ``_``."""
    return any(
        _mentions_fluent(condition, signature)
        and (condition.literal is None or any(map(_ANYTHING.search, condition.literal.arguments)))
        for condition in axiom.body
    )


def simplified(axiom: Axiom, signature: Signature) -> bool:
    """Whether the planner needs an executability condition only where two fluents may change."""
    return len(fluent_conditions(axiom, signature)) <= 2 and not asks_more(axiom, signature)


def atom_of(literal: Literal) -> str:
    return str(Literal(literal.predicate, literal.arguments))


def _sorts(literal: Literal, signature: Signature) -> list[str]:
    sorts = signature.predicates[literal.predicate].sorts
    return [
        f"sort({sort}, {argument})" for argument, sort in zip(literal.arguments, sorts, strict=True)
    ]


def _mentions_fluent(condition: Condition, signature: Signature) -> bool:
    return any(signature.kind(name).is_fluent for name in predicates_in(condition.text))
