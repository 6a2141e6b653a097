"""The order in which derivations settle what others deny."""

from __future__ import annotations

from collections.abc import Sequence

from seewhy.knowledge.dynamics import constraints
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.signature import PredicateKind
from seewhy.planning.goal import REACHED
from seewhy.planning.planner.ground_problem import Literals
from seewhy.planning.planner.unsayable import unsayable


def stratified(
    derived: Sequence[tuple[int, Literals]], knowledge: Knowledge
) -> tuple[tuple[tuple[int, Literals], ...], ...]:
    """Order derivations so that what is denied in a condition is settled before.

    Parameters
    ----------
    derived : pairs of a fluent and a condition from which it follows
    knowledge : Knowledge
        Of which they are the axioms of defined fluents.

    Raises
    ------
    PlanningError
        If a fluent depends on its own denial.
    """
    level = {head: 0 for head, _ in derived}
    changed = True
    while changed:
        changed = False
        for head, body in derived:
            least = max(
                [0, *(level.get(abs(literal), -(literal > 0)) + (literal < 0) for literal in body)]
            )
            if least > level[head]:
                level[head], changed = least, True
        if max(level.values(), default=0) > len(level):
            axiom = next(
                axiom
                for axiom in constraints(knowledge)
                if knowledge.signature.kind(axiom.head.predicate) is PredicateKind.FLUENT_DEFINED
                and axiom.head.predicate != REACHED
            )
            raise unsayable(axiom, "depends on its own denial")
    strata: list[list[tuple[int, Literals]]] = [[] for _ in range(len(level) + 1)]
    for head, body in sorted(
        derived, key=lambda derivation: (derivation[0], sorted(derivation[1]))
    ):
        strata[level[head]].append((head, body))
    return tuple(tuple(stratum) for stratum in strata if stratum)
