"""Leave out of a problem what no way to its goal asks about."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass

import clingo

from seewhy.errors import PlanningError
from seewhy.knowledge.dynamics import constraints, gives_way
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.signature import PredicateKind
from seewhy.planning.goal import REACHED
from seewhy.planning.planner.ground_problem import GroundProblem, Literals, Operator
from seewhy.planning.planner.mutex import mutexes
from seewhy.planning.planner.relevance import fluents_in
from seewhy.planning.planner.stratification import stratified

__all__ = ["UnprunedProblem", "pruned"]


@dataclass(frozen=True)
class UnprunedProblem:
    """Everything that may change, whether it matters to the goal or not.

    Attributes
    ----------
    fluents : those that may change; fluent 1 is the first
    start : the fluents that hold at first
    unknown : those of which that is unknown
    group : each fluent of which others exclude one another, with all of these
    exact : the groups of which exactly one holds
    operators : the ways to do actions
    derived : pairs of a defined fluent and a condition from which it follows
    goals : one of these sets of literals must hold
    """

    fluents: Sequence[clingo.Symbol]
    start: frozenset[int]
    unknown: frozenset[int]
    group: Mapping[int, frozenset[int]]
    exact: Collection[frozenset[int]]
    operators: Sequence[Operator]
    derived: Sequence[tuple[int, Literals]]
    goals: Sequence[Literals]


def pruned(
    problem: UnprunedProblem,
    knowledge: Knowledge,
    *,
    whole: Knowledge | None,
    believed: Collection[str],
) -> GroundProblem:
    """Leave out what no way to the goal asks about, and check that the rest is known.

    Parameters
    ----------
    problem : UnprunedProblem
    knowledge : Knowledge
        What is relevant to the goal.
    whole : Knowledge, optional
        All of it; where given, what matters may be unknown, if nothing but that some fluents
        exclude one another is said about it.
    believed : collection of str
        The predicates of the fluents that hold at first.

    Raises
    ------
    PlanningError
        If something that matters is unknown, or a fluent depends on its own denial.
    """
    asked, kept = _what_matters(problem)
    unknown = sorted(problem.fluents[number - 1] for number in asked & problem.unknown)
    names = {fluent.name for fluent in unknown}
    if unknown and (whole is None or _says_more(knowledge, whole, names, believed)):
        raise PlanningError(
            f"whether '{unknown[0]}' holds at the start is unknown, and it matters to the goal; "
            "observe it, or add a default to the knowledge"
        )
    return _renumbered(problem, asked, kept, knowledge)


def _what_matters(problem: UnprunedProblem) -> tuple[set[int], list[Operator]]:
    """The fluents that some way to the goal asks about, and the operators that change them."""
    asked = {abs(literal) for goal in problem.goals for literal in goal}
    kept: list[Operator] = []
    left = list(problem.operators)
    size = -1
    while size != len(asked):
        size = len(asked)
        for head, body in problem.derived:
            if head in asked:
                asked |= {abs(literal) for literal in body}
        useful: list[Operator] = []
        rest: list[Operator] = []
        for operator in left:
            changes = any(abs(effect) in asked for _, effect in operator.effects)
            (useful if changes else rest).append(operator)
        left = rest
        kept += useful
        for operator in useful:
            asked |= {abs(literal) for literal in operator.condition}
            for body, head in operator.effects:
                asked |= {abs(literal) for literal in (*body, head)}
        # Which one of a group holds matters as a whole.
        for group in {problem.group[number] for number in asked if number in problem.group}:
            asked |= group
    return asked, kept


def _renumbered(
    problem: UnprunedProblem, asked: set[int], kept: Sequence[Operator], knowledge: Knowledge
) -> GroundProblem:
    """The problem of the fluents that are asked about, which are counted anew."""
    order = sorted(asked)
    place = {fluent: number for number, fluent in enumerate(order, start=1)}
    place |= {-fluent: -number for fluent, number in place.items()}

    def renamed(literals: Iterable[int]) -> Literals:
        return frozenset(place[literal] for literal in literals)

    def of_groups(chosen: Iterable[Iterable[int]]) -> tuple[Literals, ...]:
        return tuple(sorted((renamed(group) for group in chosen), key=sorted))

    groups = {group for group in map(problem.group.get, order) if group is not None}
    ordered = sorted(kept, key=lambda operator: (operator.action, sorted(operator.condition)))
    derived = [(place[head], renamed(body)) for head, body in problem.derived if head in asked]
    return GroundProblem(
        fluents=tuple(problem.fluents[number - 1] for number in order),
        start=renamed(number for number in problem.start if number in asked),
        operators=tuple(
            Operator(
                operator.action,
                renamed(operator.condition),
                tuple((renamed(body), place[head]) for body, head in operator.effects),
            )
            for operator in ordered
        ),
        derivations=stratified(derived, knowledge),
        goals=tuple(renamed(goal) for goal in problem.goals),
        groups=of_groups(group for group in groups if group in problem.exact and group <= asked),
        open=renamed(asked & problem.unknown),
        exclusive=of_groups(group & asked for group in groups if group & problem.unknown),
        untold=frozenset(
            problem.fluents[head - 1] for head, _ in problem.derived if head not in asked
        ),
    )


def _says_more(
    knowledge: Knowledge, whole: Knowledge, names: set[str], believed: Collection[str]
) -> bool:
    """Whether the knowledge says more of unknown fluents than that they exclude others.

    Then not all that is unknown may be chosen freely, or what follows from it matters.
    """
    signature = whole.signature
    excluded = {mutex.axiom.identifier for mutex in mutexes(whole)}
    said = [
        axiom
        for axiom in constraints(whole)
        if axiom.identifier not in excluded
        and axiom.head.predicate != REACHED
        and not gives_way(axiom, signature)
    ]
    following = set(names)
    size = -1
    while size != len(following):
        size = len(following)
        following |= {
            axiom.head.predicate
            for axiom in said
            if signature.kind(axiom.head.predicate) is PredicateKind.FLUENT_DEFINED
            and following & fluents_in(axiom, whole)
        }
    matter = {*believed, *knowledge.signature.predicates}
    return bool((following - names) & matter) or any(
        following & {axiom.head.predicate, *fluents_in(axiom, whole)}
        for axiom in said
        if signature.kind(axiom.head.predicate) is not PredicateKind.FLUENT_DEFINED
    )
