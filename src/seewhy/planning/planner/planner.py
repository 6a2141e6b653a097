"""Shortest plans.

Where what matters follows from the actions, the states of the problem without variables are
searched forwards (:mod:`seewhy.planning.planner.a_star`;
:mod:`seewhy.planning.planner.search_with_unknowns` where some of it is unknown). The rest is left
to answer sets, by incremental multi-shot solving: one step more until the goal is reached, from
the least number of actions that the search leaves possible. Either way no plan is shorter."""

from __future__ import annotations

import itertools
import time
from contextlib import suppress
from dataclasses import replace

from seewhy.errors import PlanningError
from seewhy.knowledge.ground import complement_of
from seewhy.knowledge.language import Knowledge
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.goal import Goal, with_goal
from seewhy.planning.planner.a_star import a_star
from seewhy.planning.planner.answer_set_planning import AnswerSetSearch, plan_by_answer_sets
from seewhy.planning.planner.compilation import ground_problem
from seewhy.planning.planner.ground_problem import GroundProblem
from seewhy.planning.planner.plan import Plan, PlanStatus
from seewhy.planning.planner.relaxed_reachability import reachable
from seewhy.planning.planner.relevance import relevant
from seewhy.planning.planner.search_with_unknowns import search_with_unknowns

__all__ = ["HORIZON", "Plan", "PlanStatus", "plan"]

HORIZON = 50
_EXPANSIONS = 20_000
"""The states that are looked at before answer sets take over: a second or two."""
_OPEN_EXPANSIONS = 2_000
"""The same where not all is known, and no bound says which states are near to the goal."""


def plan(
    knowledge: Knowledge,
    goal: Goal,
    *,
    start: State,
    horizon: int = HORIZON,
    seconds: float | None = None,
    answer_sets: bool = False,
) -> Plan:
    """Return a shortest plan from a state to a goal.

    Fluents that are unknown at the start are taken to be as the plan needs them: execution
    looks, and plans anew where they are not.

    Parameters
    ----------
    knowledge : Knowledge
    goal : Goal
    start : State
        As :func:`seewhy.planning.diagnosis.diagnosis.diagnose` returns it.
    horizon : int
        The greatest number of actions to try.
    seconds : float, optional
        Give up after this time.
    answer_sets : bool, default False
        Ask answer sets alone, one step more each time, as the paper does: plans are as short, and
        take longer to find.

    Examples
    --------
    >>> from seewhy.knowledge.history import read_history
    >>> from seewhy.knowledge.language import read_knowledge
    >>> from seewhy.planning.diagnosis.diagnosis import diagnose
    >>> from seewhy.planning.goal import read_goal
    >>> known = read_knowledge('''
    ... #sort place = {library, kitchen, office}. #static next_to(place, place).
    ... #fluent basic robot_in(place). #action move(place).
    ... next_to(library, kitchen). next_to(kitchen, office).
    ... move(L) causes robot_in(L).
    ... -robot_in(L2) if robot_in(L1), L1 != L2.
    ... impossible move(L) if robot_in(L1), not next_to(L1, L).
    ... ''')
    >>> start = diagnose(known, read_history("observed robot_in(library) at 0.", known.signature))
    >>> found = plan(known, read_goal("robot_in(office)", known), start=start.now)
    >>> [str(action) for action in found.actions]
    ['move(kitchen)', 'move(office)']
    """
    begun = time.perf_counter()
    until = None if seconds is None else begun + seconds
    aimed = with_goal(knowledge, goal)
    problem = None
    if not answer_sets:
        with suppress(PlanningError):
            problem = ground_problem(relevant(aimed), start, whole=aimed)
    if problem is None:
        found = plan_by_answer_sets(aimed, start, horizon=horizon, until=until)
    else:
        found = _forwards(aimed, start, problem, horizon=horizon, until=until)
    return replace(found, seconds=time.perf_counter() - begun)


def _forwards(
    knowledge: Knowledge, start: State, problem: GroundProblem, *, horizon: int, until: float | None
) -> Plan:
    """Search the states of a ground problem; what it does not settle soon, answer sets do."""
    if problem.open:
        found = search_with_unknowns(
            problem, horizon=horizon, expansions=_OPEN_EXPANSIONS, until=until
        )
    else:
        found = a_star(problem, horizon=horizon, expansions=_EXPANSIONS, until=until)
    if found.operators is None:
        if found.exhausted:
            return Plan(PlanStatus.UNREACHABLE, horizon=horizon)
        if found.bound > horizon:
            return Plan(PlanStatus.NOT_WITHIN_HORIZON, horizon=horizon)
        return plan_by_answer_sets(
            knowledge, start, horizon=horizon, until=until, least=found.bound
        )
    status = PlanStatus.FOUND if found.operators else PlanStatus.ALREADY_TRUE
    actions = tuple(operator.action for operator in found.operators)
    more = len(relevant(knowledge, consequences=True).axioms) > len(relevant(knowledge).axioms)
    if more or problem.untold:
        # What else follows in the states on the way, the problem does not say.
        followed = AnswerSetSearch(knowledge, start, reachable(knowledge, start)).follow(actions)
        return Plan(status, *followed, horizon=horizon)
    numbered = list(enumerate(problem.fluents, start=1))
    told = {fluent: complement_of(fluent) for fluent in problem.fluents}
    constant = start.holds.difference(told, told.values())
    states = []
    for true, open_ in itertools.zip_longest(found.states, found.open, fillvalue=frozenset[int]()):
        holds = constant.union(
            fluent if number in true else told[fluent]
            for number, fluent in numbered
            if number not in open_
        )
        settled = {fluent for number, fluent in numbered if number not in open_}
        states.append(State(holds, start.unknown - settled if problem.open else start.unknown))
    return Plan(status, actions, tuple(states), horizon=horizon)
