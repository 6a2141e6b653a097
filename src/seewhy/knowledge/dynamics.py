"""Translate axioms about change into clingo's rules over steps.

``holds(L, T)`` says that the literal L about a fluent holds at step T; statics are ``holds(L)``
as in :mod:`seewhy.knowledge.program`. ``occurs(A, T)`` says that A happens between T and T+1.
A literal that holds at every step may be ``holds(L, always)`` instead, so that it is grounded
once: ``at(T, T)`` and ``at(T, always)`` join the two.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

from clingo import ast

from seewhy.knowledge.axiom import (
    Axiom,
    AxiomKind,
    Condition,
    Literal,
    predicates_in,
    variables_in,
)
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.program import axiom_rules, variable_tuple
from seewhy.knowledge.signature import PredicateKind, Signature


def fixed_rules(knowledge: Knowledge) -> Iterator[str]:
    """Yield what does not change: sorts, statics, and the fluents and actions that there are."""
    signature = knowledge.signature
    for sort in signature.sorts.values():
        yield " ".join(f"sort({sort.name}, {member})." for member in sort.members or ())
    for axiom in knowledge.without_change.axioms:
        yield from axiom_rules(axiom, signature)
    yield ":- holds(L), holds(-L)."
    for predicate in signature.predicates.values():
        terms = [f"X{number}" for number in range(len(predicate.sorts))]
        body = ", ".join(
            f"sort({sort}, {term})" for sort, term in zip(predicate.sorts, terms, strict=True)
        )
        atom = str(Literal(predicate.name, tuple(terms)))
        kind = {
            PredicateKind.FLUENT_BASIC: f"fluent(basic, {atom})",
            PredicateKind.FLUENT_DEFINED: f"fluent(defined, {atom})",
            PredicateKind.ACTION: f"action({atom})",
            PredicateKind.EXOGENOUS_ACTION: f"exogenous({atom})",
        }.get(predicate.kind)
        if kind:
            yield f"{kind}{' :- ' if body else ''}{body}."


def at_step(
    condition: Condition, signature: Signature, step: str, *, number: int = 0, always: bool = True
) -> list[str]:
    """Return an axiom's condition as it is asked at a step.

    ``number`` keeps its variables apart from those of others; without ``always`` it does not
    hold by literals that hold at every step.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> knowledge = read_knowledge("#sort place = {a, b}. #fluent basic dark(place). "
    ...     "#fluent basic lit(place). lit(P) if not dark(P).")
    >>> at_step(knowledge.axioms[0].body[0], knowledge.signature, "t", number=1)
    ['not holds(dark(P), t)', 'not holds(dark(P), always)']
    """
    literal = condition.literal
    if literal is None or not signature.kind(literal.predicate).is_fluent:
        return [_timed(condition.text, step, frozenset(signature.sorts), signature.fluents)]
    if condition.absent:
        return [f"not holds({literal}, {step})", f"not holds({literal}, always)"]
    if not always:
        return [f"holds({literal}, {step})"]
    when = f"At{number}__"
    return [f"holds({literal}, {when})", f"at({step}, {when})"]


def body_at(axiom: Axiom, signature: Signature, step: str, *, always: bool = True) -> list[str]:
    """Return an axiom's conditions at a step, with the sorts that its variables range over."""
    body = [
        part
        for number, condition in enumerate(axiom.body)
        for part in at_step(condition, signature, step, number=number, always=always)
    ]
    for literal in filter(None, (axiom.action, axiom.head)):
        predicate = signature.predicates[literal.predicate]
        body += [
            f"sort({sort}, {argument})"
            for argument, sort in zip(literal.arguments, predicate.sorts, strict=True)
            if variables_in(argument)
        ]
    return list(dict.fromkeys(body))


def untimed_predicates(knowledge: Knowledge) -> frozenset[str]:
    """The fluents whose literals may be ``always``: no aggregate or double negation asks them."""
    signature = knowledge.signature
    asked: set[str] = set()
    for axiom in knowledge.axioms:
        for condition in axiom.body:
            if condition.literal is None:
                asked |= predicates_in(condition.text)
    return signature.fluents - asked


STEP = "Step__"
"""The variable for a step; no author would give a variable this name."""
_INERTIA = """at(T, T) :- step(T).
holds(-F, T) :- fluent(defined, F), step(T), not holds(F, T).
holds(F, T+1) :- fluent(basic, F), holds(F, T), not holds(-F, T+1), step(T+1).
holds(-F, T+1) :- fluent(basic, F), holds(-F, T), not holds(F, T+1), step(T+1).
:- holds(F, T), holds(-F, T).
#defined step/1. #defined occurs/2. #defined holds/1. #defined exogenous/1. #defined action/1."""


def transition_rules(knowledge: Knowledge, *, last: int) -> Iterator[str]:
    """Yield what holds within steps 0 to ``last`` and from each to the next.

    Constraints, causal laws, executability conditions, inertia for basic fluents and the closed
    world for defined ones; ``occurs(A, T)`` and what holds at 0 come from elsewhere.
    """
    signature = knowledge.signature
    yield from fixed_rules(knowledge)
    yield f"step(0..{last}). last({last})."
    for axiom in constraints(knowledge):
        step = "0" if gives_way(axiom, signature) else STEP
        body = [*body_at(axiom, signature, step), f"step({step})"]
        yield rule(f"holds({axiom.head}, {step})", body)
    for axiom in of_kind(knowledge, AxiomKind.CAUSAL_LAW):
        body = [f"occurs({axiom.action}, {STEP})", *body_at(axiom, signature, STEP)]
        yield rule(f"holds({axiom.head}, {STEP}+1)", [*body, f"step({STEP}+1)"])
    for axiom in of_kind(knowledge, AxiomKind.EXECUTABILITY_CONDITION):
        yield rule("", [f"occurs({axiom.action}, {STEP})", *body_at(axiom, signature, STEP)])
    yield _INERTIA


def constraints(knowledge: Knowledge) -> Iterator[Axiom]:
    """The axioms about fluents that hold within every state."""
    for axiom in knowledge.axioms:
        if axiom.kind is AxiomKind.STATE_CONSTRAINT and knowledge.signature.changes(
            axiom.head.predicate
        ):
            yield axiom


def of_kind(knowledge: Knowledge, kind: AxiomKind) -> Iterator[Axiom]:
    """The axioms about change of one kind."""
    for axiom in knowledge.axioms:
        if axiom.kind is kind and knowledge.signature.changes(axiom.head.predicate):
            yield axiom


def gives_way(axiom: Axiom, signature: Signature) -> bool:
    """Whether a constraint about a basic fluent gives way to its opposite: ``l if …, not -l``.

    It then says what is usual at first. In later states inertia decides: were the constraint to
    hold there too, whoever left a place could be back there for no reason.
    """
    return signature.kind(axiom.head.predicate) is PredicateKind.FLUENT_BASIC and any(
        condition.absent and condition.literal == axiom.head.complement for condition in axiom.body
    )


def instance(axiom: Axiom) -> str:
    """The axiom with its variables, as arguments of an atom."""
    return f"{axiom.identifier}, {variable_tuple(axiom)}"


def rule(head: str, body: list[str]) -> str:
    """Return a rule, or a fact where there is no condition."""
    return f"{head}{' :- ' if body else ''}{'; '.join(body)}."


@lru_cache(maxsize=4096)
def _timed(text: str, step: str, sorts: frozenset[str], fluents: frozenset[str]) -> str:
    found: list[ast.AST] = []
    ast.parse_string(f":- {text}.", found.append)
    (element,) = _AtStep(sorts, fluents, step).visit(found[1]).body
    return str(element)


class _AtStep(ast.Transformer):
    """Wraps sorts, statics and fluents; fluents get a step."""

    def __init__(self, sorts: frozenset[str], fluents: frozenset[str], step: str) -> None:
        self.sorts = sorts
        self.fluents = fluents
        self.step = _term(step)

    def visit_SymbolicAtom(self, atom: ast.AST) -> ast.AST:  # noqa: N802
        symbol = atom.symbol
        function = symbol
        while function.ast_type is ast.ASTType.UnaryOperation:
            function = function.argument
        location = symbol.location
        if function.name in self.sorts:
            arguments = [ast.Function(location, function.name, [], False), *function.arguments]
            wrapped = ast.Function(location, "sort", arguments, False)
        elif function.name in self.fluents:
            wrapped = ast.Function(location, "holds", [symbol, self.step], False)
        else:
            wrapped = ast.Function(location, "holds", [symbol], False)
        return atom.update(symbol=wrapped)


def _term(text: str) -> ast.AST:
    found: list[ast.AST] = []
    ast.parse_string(f"p({text}).", found.append)
    term: ast.AST = found[1].head.atom.symbol.arguments[0]
    return term
