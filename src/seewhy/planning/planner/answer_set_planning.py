"""Plan by answer sets: one step more at a time, by incremental multi-shot solving."""

from __future__ import annotations

import itertools
import time
from collections.abc import Iterator, Sequence

import clingo

from seewhy.knowledge.axiom import AxiomKind
from seewhy.knowledge.bounded_control import BoundedControl, OutOfTimeError
from seewhy.knowledge.dynamics import (
    body_at,
    constraints,
    fixed_rules,
    gives_way,
    of_kind,
    rule,
    untimed_predicates,
)
from seewhy.knowledge.ground import fluent_of
from seewhy.knowledge.grounding_size import grounding_size
from seewhy.knowledge.language import Knowledge
from seewhy.planning.diagnosis.belief_state import State, facts
from seewhy.planning.goal import REACHED
from seewhy.planning.planner.axiom_conditions import simplified
from seewhy.planning.planner.mutex import mutexes
from seewhy.planning.planner.plan import Plan, PlanStatus
from seewhy.planning.planner.relaxed_reachability import Reachability, reachable

__all__ = ["AnswerSetSearch", "plan_by_answer_sets"]

_NOW = "now__"
"""The parameter that stands for a step: clingo puts the step for every constant of its name."""
_STEP_RULES = """
#program state(now__).
at(now__, now__). at(now__, always).
holds(-F, now__) :- fluent(defined, F), changes(F), not holds(F, now__).
:- holds(F, now__), holds(-F, now__), changes(F).
above(F, now__) :- next(E, F), holds(E, now__).
above(F, now__) :- next(E, F), above(E, now__).
below(E, now__) :- next(E, F), holds(F, now__).
below(E, now__) :- next(E, F), below(F, now__).
holds(-F, now__) :- above(F, now__).
holds(-F, now__) :- below(F, now__).
#program step(now__).
1 { occurs(A, now__-1) : can(A) } 1.
holds(F, now__) :- holds(F, now__-1), inert(F), not holds(-F, now__).
holds(-F, now__) :- holds(-F, now__-1), inert(F), not holds(F, now__).
:- occurs(A, now__-1), restricted(A, G), not holds(F, now__-1) : allowed(A, G, F).
:- occurs(A, now__-1), needs(A, L), not holds(L, now__-1).
#program check(now__).
#external query(now__).
"""


def plan_by_answer_sets(
    knowledge: Knowledge, start: State, *, horizon: int, until: float | None, least: int = 0
) -> Plan:
    """Ground one step more until there is an answer set; no plan is shorter than ``least``."""
    possible = reachable(knowledge, start)
    if clingo.Function(REACHED, []) not in possible.may:
        return Plan(PlanStatus.UNREACHABLE, horizon=horizon)
    search = AnswerSetSearch(knowledge, start, possible)
    for steps in range(horizon + 1):
        if until is not None and time.perf_counter() >= until:
            return Plan(PlanStatus.OUT_OF_TIME, horizon=max(0, steps - 1))
        search.extend(steps)
        if steps < least:
            continue
        found = search.solve(steps, until=until)
        if found is not None:
            status = PlanStatus.FOUND if steps else PlanStatus.ALREADY_TRUE
            return Plan(status, *found, horizon=horizon)
        if not possible.can:
            break
    if until is not None and time.perf_counter() >= until:
        return Plan(PlanStatus.OUT_OF_TIME, horizon=horizon)
    return Plan(
        PlanStatus.NOT_WITHIN_HORIZON if possible.can else PlanStatus.UNREACHABLE, horizon=horizon
    )


class AnswerSetSearch:
    """The planning program, grounded one step further with every call."""

    def __init__(self, knowledge: Knowledge, start: State, possible: Reachability) -> None:
        self.rigid = possible.rigid
        self.fluents = {fluent_of(literal) for literal in (*start.holds, *start.unknown)}
        self.control = BoundedControl(
            "\n".join(_program(knowledge, start, possible)),
            size=grounding_size(knowledge),
            parts=[("base", ()), ("state", [clingo.Number(0)])],
        )

    def extend(self, steps: int) -> None:
        """Ground the next step; to be called with every number of steps, in order."""
        number = [clingo.Number(steps)]
        if steps:
            self.control.ground([("state", number), ("step", number)])

    def solve(
        self,
        steps: int,
        *,
        until: float | None,
        actions: Sequence[clingo.Symbol] = (),
    ) -> tuple[tuple[clingo.Symbol, ...], tuple[State, ...]] | None:
        """Return the actions and states of a plan with so many steps, if there is one.

        ``actions`` are what it begins with.
        """
        number = [clingo.Number(steps)]
        self.control.ground([("check", number)])
        query = clingo.Function("query", number)
        self.control.assign_external(query, True)
        done = [
            (clingo.Function("occurs", [action, clingo.Number(step)]), True)
            for step, action in enumerate(actions)
        ]
        try:
            found = self.control.solve(
                done,
                on_model=lambda model: list(model.symbols(atoms=True)),
                seconds=None if until is None else max(0.0, until - time.perf_counter()),
            )
        except OutOfTimeError:
            if until is None:
                raise
            found = []
        self.control.assign_external(query, None)
        return self._read(found[-1], steps) if found else None

    def follow(
        self, actions: Sequence[clingo.Symbol]
    ) -> tuple[tuple[clingo.Symbol, ...], tuple[State, ...]]:
        """Return a plan's actions with the states before, between and after them."""
        for steps in range(len(actions) + 1):
            self.extend(steps)
        found = self.solve(len(actions), until=None, actions=actions)
        assert found is not None, "the ground problem allows what the knowledge does not"
        return found

    def _read(
        self, model: list[clingo.Symbol], steps: int
    ) -> tuple[tuple[clingo.Symbol, ...], tuple[State, ...]]:
        actions: dict[int, clingo.Symbol] = {}
        holds: list[set[clingo.Symbol]] = [set(self.rigid) for _ in range(steps + 1)]
        for atom in model:
            if len(atom.arguments) == 2 and atom.arguments[1].type is clingo.SymbolType.Number:
                step = atom.arguments[1].number
                if atom.name == "occurs":
                    actions[step] = atom.arguments[0]
                elif atom.name == "holds" and atom.arguments[0].name != REACHED:
                    holds[step].add(atom.arguments[0])
        states = [
            State(
                frozenset(literals),
                frozenset(self.fluents - {fluent_of(other) for other in literals}),
            )
            for literals in holds
        ]
        return tuple(actions[step] for step in range(steps)), tuple(states)


def _program(knowledge: Knowledge, start: State, possible: Reachability) -> Iterator[str]:
    signature = knowledge.signature
    untimed = untimed_predicates(knowledge)
    changing = {fluent_of(literal) for literal in possible.may - possible.rigid}
    basic = {fluent for fluent in changing if signature.kind(fluent.name).value.endswith("basic")}
    always = [literal for literal in possible.rigid if literal.name in untimed]
    copied = [literal for literal in possible.rigid if literal.name not in untimed]
    yield from fixed_rules(knowledge)
    yield facts("changes", changing)
    yield facts("inert", basic)
    yield facts("can", possible.can)
    yield " ".join(f"holds({literal}, always)." for literal in sorted(always))
    yield " ".join(f"holds({literal}, 0)." for literal in sorted(start.holds - possible.rigid))
    yield " ".join(
        f"1 {{ holds({fluent}, 0); holds(-{fluent}, 0) }} 1."
        for fluent in sorted(start.unknown)
        if signature.kind(fluent.name).value.endswith("basic")
    )
    yield possible.rules
    excluded = {mutex.axiom.identifier for mutex in mutexes(knowledge)}
    for group in possible.groups:
        yield " ".join(f"next({a}, {b})." for a, b in itertools.pairwise(group))
    for axiom in constraints(knowledge):
        if gives_way(axiom, signature):
            body = [*body_at(axiom, signature, "0"), f"changes({axiom.head})"]
            yield rule(f"holds({axiom.head}, 0)", body)
    yield "#defined next/2. #defined restricted/2. #defined allowed/3. #defined needs/2."
    yield "#defined can/1. #defined changes/1. #defined inert/1. #defined holds/1."
    yield _STEP_RULES
    yield f":- query({_NOW}), not holds({REACHED}, {_NOW}), not holds({REACHED}, always)."
    yield f"#program state({_NOW})."
    yield " ".join(f"holds({literal}, {_NOW})." for literal in sorted(copied))
    for axiom in constraints(knowledge):
        if axiom.identifier not in excluded and not gives_way(axiom, signature):
            head = axiom.head
            changes = f"changes({head if head.positive else head.complement})"
            yield rule(f"holds({head}, {_NOW})", [*body_at(axiom, signature, _NOW), changes])
    yield f"#program step({_NOW})."
    for axiom in of_kind(knowledge, AxiomKind.CAUSAL_LAW):
        yield rule(
            f"holds({axiom.head}, {_NOW})",
            [
                f"occurs({axiom.action}, {_NOW}-1)",
                *body_at(axiom, signature, f"{_NOW}-1"),
            ],
        )
    for axiom in of_kind(knowledge, AxiomKind.EXECUTABILITY_CONDITION):
        happens = [f"occurs({axiom.action}, {_NOW}-1)"]
        if not simplified(axiom, signature):
            yield rule("", [*happens, *body_at(axiom, signature, f"{_NOW}-1")])
        else:
            fluents = [
                condition
                for condition in axiom.body
                if condition.literal and signature.kind(condition.literal.predicate).is_fluent
            ]
            if len(fluents) == 2:
                yield rule("", [*happens, *body_at(axiom, signature, f"{_NOW}-1", always=False)])
