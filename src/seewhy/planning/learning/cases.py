"""What was seen in earlier runs of how things are at first, apart from the robot's own doing."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import clingo

from seewhy.knowledge.axiom import Axiom, AxiomKind, Literal
from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.dynamics import at_step, constraints, fixed_rules, gives_way, of_kind, rule
from seewhy.knowledge.ground import fluent_of
from seewhy.knowledge.grounding_size import grounding_size
from seewhy.knowledge.history import History, Occurrence
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.signature import PredicateKind, Signature

Run = int
"""The place of a run in the record."""


@dataclass(frozen=True)
class Case:
    """A basic fluent as it was first seen in a run.

    Attributes
    ----------
    fluent : clingo.Symbol
    holds : bool
        Whether it was seen to hold.
    run : int
        The place of the run in the record.
    """

    fluent: clingo.Symbol
    holds: bool
    run: Run


def cases_of(knowledge: Knowledge, record: Sequence[History]) -> list[Case]:
    """Return what the runs of a record show of the basic fluents, each once a run.

    Counted is the first observation of a fluent in a run: to have looked fifty times at who stays
    at one place is to have looked once. What an action may have brought about that the record
    names is not counted: that the robot is where it went says nothing of where robots are.

    Examples
    --------
    >>> from seewhy.knowledge.history import read_history
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge('''
    ... #sort place = {hall, attic}. #fluent basic at(place). #fluent basic dark(place).
    ... #action go(place). go(P) causes at(P). -at(P2) if at(P1), P1 != P2.
    ... ''')
    >>> run = read_history('''
    ... observed at(hall) at 0. observed dark(hall) at 0. attempted go(attic) at 0.
    ... observed -at(hall) at 1. observed at(attic) at 1. observed -dark(attic) at 1.
    ... observed dark(attic) at 2.
    ... ''', known.signature)
    >>> [(str(case.fluent), case.holds) for case in cases_of(known, [run])]
    [('at(hall)', True), ('dark(hall)', True), ('dark(attic)', False)]
    """
    effects = _effects(knowledge, {occurrence for run in record for occurrence in run.occurrences})
    return [
        Case(fluent, holds, number)
        for number, run in enumerate(record)
        for fluent, holds in _first_seen(knowledge.signature, run, effects)
    ]


def _first_seen(
    signature: Signature, run: History, effects: dict[str, frozenset[clingo.Symbol]]
) -> Iterator[tuple[clingo.Symbol, bool]]:
    doings = sorted(run.occurrences, key=lambda occurrence: occurrence.step)
    done: set[clingo.Symbol] = set()
    seen: set[clingo.Symbol] = set()
    for observation in sorted(run.observations, key=lambda observation: observation.step):
        while doings and doings[0].step < observation.step:
            done |= effects[_term(doings.pop(0))]
        symbol = clingo.parse_term(str(observation.literal))
        fluent = fluent_of(symbol)
        if fluent in seen or signature.kind(fluent.name) is not PredicateKind.FLUENT_BASIC:
            continue
        seen.add(fluent)
        if fluent not in done:
            yield fluent, symbol.positive


def _term(occurrence: Occurrence) -> str:
    return str(clingo.parse_term(str(occurrence.action)))


def _effects(knowledge: Knowledge, doings: set[Occurrence]) -> dict[str, frozenset[clingo.Symbol]]:
    """Action → the fluents that it may change, whatever else is so."""
    signature = knowledge.signature
    actions = sorted(map(_term, doings))
    lines = [*fixed_rules(knowledge), *(f"done({action})." for action in actions)]
    for axiom in of_kind(knowledge, AxiomKind.CAUSAL_LAW):
        lines.append(
            rule(
                f"brings({axiom.action}, {axiom.head})",
                [f"done({axiom.action})", *_apart_from_fluents(axiom, signature)],
            )
        )
    for axiom in constraints(knowledge):
        if gives_way(axiom, signature):
            continue
        for condition in axiom.body:
            literal = condition.literal
            if literal and not condition.absent and signature.kind(literal.predicate).is_fluent:
                body = [f"brings(A__, {literal})", *_apart_from_fluents(axiom, signature)]
                lines.append(rule(f"brings(A__, {axiom.head})", body))
    lines.append("#defined brings/2. #defined done/1.")
    control = BoundedControl("\n".join(lines), size=grounding_size(knowledge))
    found: dict[str, set[clingo.Symbol]] = {action: set() for action in actions}
    for atom in control.by_signature("brings", 2):
        action, effect = atom.symbol.arguments
        found[str(action)].add(fluent_of(effect))
    return {action: frozenset(fluents) for action, fluents in found.items()}


def _apart_from_fluents(axiom: Axiom, signature: Signature) -> list[str]:
    """An axiom's conditions about what never changes, and the sorts of all its variables."""
    literals: list[Literal] = [literal for literal in (axiom.action, axiom.head) if literal]
    body: list[str] = []
    for condition in axiom.body:
        literal = condition.literal
        if literal is not None and signature.kind(literal.predicate).is_fluent:
            literals.append(literal)
        elif not condition.is_local:
            body += at_step(condition, signature, "0")
    for literal in literals:
        sorts = signature.predicates[literal.predicate].sorts
        body += [
            f"sort({sort}, {argument})"
            for sort, argument in zip(sorts, literal.arguments, strict=True)
            if argument != "_"
        ]
    return list(dict.fromkeys(body))
