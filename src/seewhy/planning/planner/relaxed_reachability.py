"""Relaxed reachability: what never changes, what can never be done, without a search.

A relaxation in which whatever was once true stays available (as in graph plans), except that of
fluents of which exactly one holds (a robot is at one place) an action is possible only where one
of the values that it allows has been reached. What it cannot reach, no plan can.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import clingo

from seewhy.knowledge.axiom import Axiom, AxiomKind, Condition, Literal
from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.dynamics import constraints, fixed_rules, of_kind, rule
from seewhy.knowledge.grounding_size import grounding_size
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.signature import Signature
from seewhy.planning.diagnosis.belief_state import State, facts
from seewhy.planning.planner.axiom_conditions import (
    asks_more,
    atom_of,
    fluent_conditions,
    static_body,
)
from seewhy.planning.planner.mutex import Mutex, mutexes

__all__ = ["Reachability", "reachable", "relaxed_atoms"]

_PROGRAM = """
fluent(F) :- fluent(_, F).
touched(F) :- unknown(F).
rigid(F) :- initial(F), fluent(F), not touched(F).
rigid(-F) :- initial(-F), fluent(F), not touched(F).
exact_fluent(F) :- in_group(G, F), exact(G).
exact(G) :- in_group(G, F), initial(F), stays_exact(F).
restricted(A, G) :- forbids(A, F), in_group(G, F).
allowed(A, G, F) :- restricted(A, G), in_group(G, F), not forbids(A, F).
may(L) :- initial(L).
may(F) :- unknown(F).
may(-F) :- unknown(F).
may(-F) :- fluent(defined, F), not rigid(F).
may(-F) :- in_group(_, F), touched(F).
reached(A, G) :- allowed(A, G, F), may(F).
can(A) :- useful(A), not never(A), reached(A, G) : restricted(A, G); may(C) : needs(A, C).
"""
_RELAXATION = """
initial(L) :- believed(L).
useful(A) :- action(A).
#show rigid/1. #show may/1. #show can/1. #show allowed/3. #show restricted/2. #show needs/2.
#show in_group/2.
"""


@dataclass(frozen=True)
class Reachability:
    """What the relaxation finds, as sets of clingo's symbols.

    Attributes
    ----------
    rigid : literals that hold in every state
    may : literals that may hold in some state
    can : actions that may be possible in some state
    rules : facts for the planner: ``restricted(A, G)``, ``allowed(A, G, F)``, ``needs(A, L)``
    groups : for each group of fluents that exclude one another, those that may change
    """

    rigid: frozenset[clingo.Symbol]
    may: frozenset[clingo.Symbol]
    can: frozenset[clingo.Symbol]
    rules: str
    groups: tuple[tuple[clingo.Symbol, ...], ...]


def reachable(knowledge: Knowledge, state: State) -> Reachability:
    """Return what may hold and be done from a state on."""
    believed = facts("believed", state.holds)
    sets = relaxed_atoms(knowledge, [believed, facts("unknown", state.unknown), _RELAXATION])
    can = frozenset(atom.arguments[0] for atom in sets.get("can", ()))
    rigid = frozenset(atom.arguments[0] for atom in sets.get("rigid", ()))
    kept = [
        atom
        for name in ("restricted", "allowed", "needs")
        for atom in sets.get(name, ())
        if atom.arguments[0] in can
    ]
    groups: dict[clingo.Symbol, list[clingo.Symbol]] = {}
    for atom in sets.get("in_group", ()):
        if atom.arguments[1] not in rigid:
            groups.setdefault(atom.arguments[0], []).append(atom.arguments[1])
    return Reachability(
        rigid=rigid,
        may=frozenset(atom.arguments[0] for atom in sets.get("may", ())),
        can=can,
        rules=" ".join(f"{atom}." for atom in sorted(kept)),
        groups=tuple(tuple(sorted(fluents)) for _, fluents in sorted(groups.items())),
    )


def relaxed_atoms(knowledge: Knowledge, program: list[str]) -> dict[str, list[clingo.Symbol]]:
    """The atoms shown of the one answer set, by predicate; none where there is no answer set."""
    control = BoundedControl(
        "\n".join([*_relaxation_rules(knowledge), *program, _PROGRAM]),
        size=grounding_size(knowledge),
    )
    found = control.models()
    sets: dict[str, list[clingo.Symbol]] = {}
    for atom in found[0] if found else ():
        sets.setdefault(atom.name, []).append(atom)
    return sets


def _relaxation_rules(knowledge: Knowledge) -> Iterator[str]:
    signature = knowledge.signature
    yield from fixed_rules(knowledge)
    for group in mutexes(knowledge):
        yield from _group(group, signature)
    excluded = {mutex.axiom.identifier for mutex in mutexes(knowledge)}
    for axiom in of_kind(knowledge, AxiomKind.CAUSAL_LAW):
        static = static_body(axiom, signature)
        yield rule(f"touched({atom_of(axiom.head)})", [f"useful({axiom.action})", *static])
        possible = _possible_body(axiom, signature)
        yield rule(f"may({axiom.head})", [f"can({axiom.action})", *static, *possible])
    for axiom in constraints(knowledge):
        if axiom.identifier in excluded:
            continue
        static = static_body(axiom, signature)
        if asks_more(axiom, signature):
            yield rule(f"touched({atom_of(axiom.head)})", static)
        for condition in fluent_conditions(axiom, signature):
            assert condition.literal is not None
            yield rule(
                f"touched({atom_of(axiom.head)})",
                [*static, f"touched({atom_of(condition.literal)})"],
            )
        yield rule(f"may({axiom.head})", [*static, *_possible_body(axiom, signature)])
    for axiom in of_kind(knowledge, AxiomKind.EXECUTABILITY_CONDITION):
        if not asks_more(axiom, signature):
            yield from _executability(axiom, knowledge)
    # Nothing may be said of some of these in a domain; then they have no rule.
    yield "#defined useful/1. #defined law/3. #defined conclusion/3. #defined forbidden/2."
    yield "#defined touched/1. #defined in_group/2. #defined stays_exact/1. #defined forbids/2."
    yield "#defined needs/2. #defined never/1. #defined unknown/1. #defined believed/1."
    yield "#defined action/1. #defined fluent/2."


def _group(group: Mutex, signature: Signature) -> Iterator[str]:
    """The fluents that exclude one another; one that changes changes the others."""
    sorts = signature.predicates[group.predicate].sorts
    terms = [f"X{place}" for place in range(len(sorts))]
    atom = str(Literal(group.predicate, tuple(terms)))
    others = [term for place, term in enumerate(terms) if place != group.position]
    name = f"group({', '.join([group.predicate, *others])})"
    yield f"in_group({name}, {atom}) :- fluent(basic, {atom})."
    yield f"touched({atom}) :- in_group({name}, {atom}), group_touched({name})."
    yield f"group_touched({name}) :- in_group({name}, {atom}), touched({atom})."
    if group.stays_exact:
        yield f"stays_exact({atom}) :- fluent(basic, {atom})."


def _executability(axiom: Axiom, knowledge: Knowledge) -> Iterator[str]:
    """What an action needs, forbids, or that it never is: one fluent that may change at a time."""
    signature = knowledge.signature
    static = [f"useful({axiom.action})", *static_body(axiom, signature)]
    conditions = fluent_conditions(axiom, signature)
    certain = [_certain(condition) for condition in conditions]
    yield rule(f"never({axiom.action})", [*static, *certain])
    for place, condition in enumerate(conditions):
        literal = condition.literal
        assert literal is not None
        others = [other for number, other in enumerate(certain) if number != place]
        body = [*static, *others, f"touched({atom_of(literal)})"]
        if condition.absent:
            yield rule(f"needs({axiom.action}, {literal})", body)
            continue
        if literal.positive:
            grouped = [f"in_group(G__, {literal})", "exact(G__)"]
            yield rule(f"forbids({axiom.action}, {literal})", [*body, *grouped])
            body = [*body, f"not exact_fluent({literal})"]
        yield rule(f"needs({axiom.action}, {literal.complement})", body)


def _certain(condition: Condition) -> str:
    """The condition as it holds in every state."""
    assert condition.literal is not None
    literal = condition.literal.complement if condition.absent else condition.literal
    return f"rigid({literal})"


def _possible_body(axiom: Axiom, signature: Signature) -> list[str]:
    """The conditions about fluents as they may hold in some state."""
    body = []
    for condition in fluent_conditions(axiom, signature):
        literal = condition.literal
        body.append(f"not rigid({literal})" if condition.absent else f"may({literal})")
    return body
