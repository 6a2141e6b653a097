"""Ground the laws where they may apply and may help: instances of axioms, without variables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import clingo

from seewhy.knowledge.axiom import AxiomKind, Literal
from seewhy.knowledge.dynamics import rule
from seewhy.knowledge.language import Knowledge
from seewhy.planning.diagnosis.belief_state import State, facts
from seewhy.planning.goal import REACHED
from seewhy.planning.planner.axiom_conditions import (
    asks_more,
    atom_of,
    fluent_conditions,
    static_body,
)
from seewhy.planning.planner.mutex import mutexes
from seewhy.planning.planner.relaxed_reachability import relaxed_atoms

__all__ = ["instances"]

_INSTANCES = """
initial(F) :- believed(F).
initial(-F) :- fluent(_, F), not believed(F), not unknown(F).
wanted(F) :- in_group(G, F), wanted_group(G).
wanted_group(G) :- in_group(G, F), wanted(F).
changing(F) :- may(F), may(-F), not rigid(F), not rigid(-F).
member(G, F) :- in_group(G, F), changing(F).
exact_member(G, F) :- member(G, F), exact(G).
choice(A, G, F) :- allowed(A, G, F), can(A), may(F).
need(A, L) :- needs(A, L), can(A).
#show changing/1. #show can/1. #show choice/3. #show need/2. #show member/2.
#show exact_member/2. #show law/3. #show conclusion/3. #show forbidden/2.
#defined wanted/1.
"""


def instances(knowledge: Knowledge, state: State) -> Mapping[str, Sequence[clingo.Symbol]]:
    """Return the laws without variables, where they may apply and may help.

    By predicate: ``changing(fluent)``, ``can(action)``, ``law(action, effect, conditions)``,
    ``conclusion(axiom, head, conditions)``, ``need(action, literal)``, ``choice(action, group,
    fluent)`` (an action needs one of these), ``forbidden(action, conditions)`` (not all of
    these), ``member(group, fluent)`` and ``exact_member`` where one of the group always holds.
    Conditions on what does not change are left out.
    """
    # What is not believed true, and not unknown, is believed false: that need not be told.
    positive = (literal for literal in state.holds if literal.positive)
    given = [facts("believed", positive), facts("unknown", state.unknown)]
    return relaxed_atoms(knowledge, [*_instance_rules(knowledge), *given, _INSTANCES])


def _instance_rules(knowledge: Knowledge) -> Iterator[str]:
    signature = knowledge.signature
    yield from _wanted(knowledge)
    excluded = {mutex.axiom.identifier for mutex in mutexes(knowledge)}
    for axiom in knowledge.axioms:
        if not signature.changes(axiom.head.predicate) or asks_more(axiom, signature):
            continue
        static = static_body(axiom, signature)
        terms = [
            condition.literal.complement if condition.absent else condition.literal
            for condition in fluent_conditions(axiom, signature)
            if condition.literal
        ]
        possible = [f"may({literal})" for literal in terms]
        conditions = f"({', '.join(map(str, terms))}{',' * (len(terms) == 1)})"
        if axiom.kind is AxiomKind.CAUSAL_LAW:
            body = [f"can({axiom.action})", *static, *possible]
            yield rule(f"law({axiom.action}, {axiom.head}, {conditions})", body)
        elif axiom.kind is AxiomKind.STATE_CONSTRAINT and axiom.identifier not in excluded:
            head = f"conclusion({axiom.identifier}, {axiom.head}, {conditions})"
            yield rule(head, [*static, *possible])
        elif axiom.kind is AxiomKind.EXECUTABILITY_CONDITION and len(terms) > 1:
            # One condition that changes, beside others that do not, is in `needs` and `allowed`.
            changing = (
                [f"touched({atom_of(literal)})" for literal in terms] if len(terms) == 2 else []
            )
            body = [f"can({axiom.action})", *static, *possible, *changing]
            yield rule(f"forbidden({axiom.action}, {conditions})", body)


def _wanted(knowledge: Knowledge) -> Iterator[str]:
    """What the goal asks about, instance by instance, and what an axiom does, whichever it is."""
    signature = knowledge.signature
    excluded = {mutex.axiom.identifier for mutex in mutexes(knowledge)}
    asked: set[str] = set()
    for axiom in knowledge.axioms:
        if axiom.kind is AxiomKind.DEFAULT or axiom.identifier in excluded:
            continue
        literals = [
            condition.literal
            for condition in fluent_conditions(axiom, signature)
            if condition.literal
        ]
        static = static_body(axiom, signature) if signature.changes(axiom.head.predicate) else []
        if axiom.head.predicate == REACHED:
            for literal in literals:
                yield rule(f"wanted({atom_of(literal)})", static)
            continue
        asked |= {literal.predicate for literal in literals}
        if axiom.kind is AxiomKind.CAUSAL_LAW:
            body = [f"action({axiom.action})", f"wanted({atom_of(axiom.head)})", *static]
            yield rule(f"useful({axiom.action})", body)
        elif axiom.kind is AxiomKind.STATE_CONSTRAINT:
            asked.add(axiom.head.predicate)
    for name in sorted(asked):
        if signature.kind(name).is_fluent:
            terms = tuple(f"X{place}" for place in range(len(signature.predicates[name].sorts)))
            yield f"wanted({Literal(name, terms)}) :- fluent(_, {Literal(name, terms)})."
