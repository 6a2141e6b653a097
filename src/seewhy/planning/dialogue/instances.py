"""The instances of an axiom that apply in a state, with the literals that make them apply."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import clingo
from clingo import ast

from seewhy.knowledge.axiom import Axiom, Condition, Literal, substitute, variables_in
from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.dynamics import at_step, body_at, fixed_rules, rule
from seewhy.knowledge.ground import key_of, literal_of
from seewhy.knowledge.grounding_size import axioms_size, grounding_size
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.program import variable_tuple


@dataclass(frozen=True)
class Applied:
    """An instance of an axiom whose conditions all hold.

    Attributes
    ----------
    axiom : Axiom
        With the terms of the instance for its variables.
    holds : tuple of clingo.Symbol
        The literals about fluents among its conditions.
    counted : tuple of clingo.Symbol
        Those that an aggregate counts.
    absent : tuple of clingo.Symbol
        Those that are not believed (``not …``).
    statics, absent_statics : tuple of clingo.Symbol
        The literals about what never changes among its conditions, and those that are not so.
    """

    axiom: Axiom
    holds: tuple[clingo.Symbol, ...] = ()
    counted: tuple[clingo.Symbol, ...] = ()
    absent: tuple[clingo.Symbol, ...] = ()
    statics: tuple[clingo.Symbol, ...] = ()
    absent_statics: tuple[clingo.Symbol, ...] = ()


class Instances:
    """Looks up which axioms apply; what does not change is worked out once.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge('''
    ... #sort place = {hall, attic}. #fluent basic dark(place). #action read(place).
    ... impossible read(P) if dark(P).
    ... ''')
    >>> state = [clingo.parse_term("dark(attic)")]
    >>> read = clingo.parse_term("read(attic)")
    >>> (applied,) = Instances(known).of(known.axioms[0], state, action=read)
    >>> [str(literal) for literal in applied.holds]
    ['dark(attic)']
    """

    def __init__(self, knowledge: Knowledge) -> None:
        self.knowledge = knowledge
        control = BoundedControl("\n".join(fixed_rules(knowledge)), size=grounding_size(knowledge))
        sorts = [str(atom.symbol) for atom in control.by_signature("sort", 2)]
        self.statics = frozenset(
            atom.symbol.arguments[0] for atom in control.by_signature("holds", 1)
        )
        """What is so in every state."""
        held = [f"holds({literal})" for literal in sorted(self.statics)]
        self._fixed = " ".join(f"{fact}." for fact in [*sorts, *held])

    def of(
        self,
        axiom: Axiom,
        state: Iterable[clingo.Symbol],
        *,
        head: clingo.Symbol | None = None,
        action: clingo.Symbol | None = None,
    ) -> list[Applied]:
        """Return the instances that apply in a state, with this head and action where given."""
        narrowed: Axiom | None = axiom
        if head is not None:
            narrowed = unified(axiom, axiom.head, head)
        if action is not None and narrowed is not None:
            narrowed = unified(narrowed, narrowed.action, action)
        if narrowed is None:
            return []
        facts = self._facts(state)
        signature = self.knowledge.signature
        body = body_at(narrowed, signature, "0")
        found = BoundedControl(
            f"{facts}\n{rule(f'applies({variable_tuple(narrowed)})', body)}",
            size=axioms_size([narrowed], signature),
        )
        bindings = sorted(
            atom.symbol.arguments[0] for atom in found.by_signature("applies", 1) if atom.is_fact
        )
        instances = [self._applied(narrowed, binding, facts) for binding in bindings]
        if axiom.has_sentence:
            return instances
        return [
            replace(instance, axiom=replace(instance.axiom, text=str(instance.axiom)))
            for instance in instances
        ]

    def counted(self, axiom: Axiom, state: Iterable[clingo.Symbol]) -> list[clingo.Symbol]:
        """Return the literals that the aggregates of an axiom without variables count."""
        return list(self._counted(axiom, self._facts(state)))

    def _facts(self, state: Iterable[clingo.Symbol]) -> str:
        held = " ".join(f"holds({literal}, 0)." for literal in sorted(state))
        return (
            f"{self._fixed} {held} at(0, 0). #defined holds/1. #defined holds/2. #defined sort/2."
        )

    def _applied(self, axiom: Axiom, binding: clingo.Symbol, facts: str) -> Applied:
        instance = _substituted(
            axiom, dict(zip(axiom.variables, map(str, binding.arguments), strict=True))
        )
        counted = tuple(self._counted(instance, facts))
        return Applied(
            instance,
            holds=self._named(instance, fluent=True, absent=False),
            counted=counted,
            absent=self._named(instance, fluent=True, absent=True),
            statics=self._named(instance, fluent=False, absent=False),
            absent_statics=self._named(instance, fluent=False, absent=True),
        )

    def _named(self, axiom: Axiom, *, fluent: bool, absent: bool) -> tuple[clingo.Symbol, ...]:
        """The literals of conditions of one kind."""
        predicates = self.knowledge.signature.predicates
        return tuple(
            clingo.parse_term(key_of(condition.literal))
            for condition in axiom.body
            if condition.literal is not None
            and condition.absent == absent
            and condition.literal.predicate in predicates
            and predicates[condition.literal.predicate].kind.is_fluent == fluent
            and "_" not in condition.literal.arguments
        )

    def _counted(self, axiom: Axiom, facts: str) -> Iterator[clingo.Symbol]:
        signature = self.knowledge.signature
        rules = []
        for condition in axiom.body:
            for parts in _elements(condition) if condition.is_local else ():
                body = [
                    timed
                    for number, part in enumerate(parts)
                    for timed in at_step(Condition(part), signature, "0", number=number)
                ]
                fluents = [part for part in parts if signature.kind(_predicate(part)).is_fluent]
                if fluents and not fluents[0].startswith("not "):
                    rules.append(rule(f"counted({fluents[0]})", body))
        if rules:
            found = BoundedControl("\n".join([facts, *rules]), size=axioms_size([axiom], signature))
            yield from sorted(atom.symbol.arguments[0] for atom in found.by_signature("counted", 1))


def unified(axiom: Axiom, literal: Literal | None, symbol: clingo.Symbol) -> Axiom | None:
    """Return the axiom where its head or action is this one; None where it cannot be."""
    if literal is None or (literal.predicate, literal.positive) != (symbol.name, symbol.positive):
        return None
    binding: dict[str, str] = {}
    compared: list[Condition] = []
    for argument, term in zip(literal.arguments, map(str, symbol.arguments), strict=True):
        if variables_in(argument) != (argument,):
            compared.append(Condition(f"{argument} = {term}"))
        elif binding.setdefault(argument, term) != term:
            return None
    instance = _substituted(replace(axiom, body=(*axiom.body, *compared)), binding)
    same = literal_of(str(symbol))
    is_head = literal == axiom.head
    return replace(instance, head=same) if is_head else replace(instance, action=same)


def _substituted(axiom: Axiom, binding: dict[str, str]) -> Axiom:
    return replace(
        axiom,
        head=axiom.head.substitute(binding),
        action=axiom.action and axiom.action.substitute(binding),
        body=tuple(
            Condition(
                substitute(condition.text, binding),
                condition.literal and condition.literal.substitute(binding),
                condition.absent,
            )
            for condition in axiom.body
        ),
    )


def _elements(condition: Condition) -> Iterator[list[str]]:
    """The conditions of each element of an aggregate."""
    found: list[ast.AST] = []
    ast.parse_string(f":- {condition.text}.", found.append)
    (body,) = found[1].body
    if body.ast_type is ast.ASTType.Literal and hasattr(body.atom, "elements"):
        for element in body.atom.elements:
            yield [str(part) for part in element.condition]


def _predicate(text: str) -> str:
    return text.removeprefix("not ").lstrip("-").split("(")[0]
