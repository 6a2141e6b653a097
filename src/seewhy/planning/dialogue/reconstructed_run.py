"""The steps of a run of which only the history was kept."""

from __future__ import annotations

from dataclasses import replace

import clingo

from seewhy.errors import PlanningError
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.ground import key_of
from seewhy.knowledge.history import History
from seewhy.knowledge.signature import PredicateKind
from seewhy.planning.diagnosis.diagnosis import Surprise, diagnose
from seewhy.planning.dialogue.hypothetical_history import known_at
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.execution.execution import Decision, Outcome, Run, Step, execute
from seewhy.planning.goal import Goal
from seewhy.planning.planner.goal_test import goal_holds


def recalled(domain: PlanningDomain, run: Run) -> Run:
    """Return the run with the steps that its history tells of, where it has none of its own.

    A robot decides again as it did with the same knowledge and goal: if it would do what the record
    says, the run is as it was, with its plans and surprises. Otherwise what was intended is taken
    to be what was done.

    Examples
    --------
    >>> from seewhy.knowledge.history import read_history
    >>> from seewhy.planning.domain import load_planning_domain
    >>> from seewhy.planning.goal import read_goal
    >>> domain = load_planning_domain("robot_assistant")
    >>> goal = read_goal("loc(rob1, kitchen)", domain.knowledge)
    >>> record = "observed loc(rob1, library) at 0. attempted move(rob1, kitchen) at 0. "
    >>> record += "observed loc(rob1, kitchen) at 1."
    >>> known = read_history(record, domain.knowledge.signature)
    >>> [step.decision.value for step in recalled(domain, Run(goal, known)).steps]
    ['plan', 'stop']
    """
    done = _actions(domain, run.history)
    if run.steps or not done:
        return run
    again = _decided_again(domain, run.goal, run.history, done)
    if again is not None:
        return replace(again, history=run.history, sensors_err=run.sensors_err)
    return _as_intended(domain, run, done)


def _actions(domain: PlanningDomain, history: History) -> list[tuple[int, clingo.Symbol]]:
    signature = domain.knowledge.signature
    return sorted(
        (
            (occurrence.step, clingo.parse_term(key_of(occurrence.action)))
            for occurrence in history.occurrences
            if signature.kind(occurrence.action.predicate) is PredicateKind.ACTION
        ),
        key=lambda pair: pair[0],
    )


class _DepartureError(Exception):
    """The robot would do something else than what the record says."""


def _decided_again(
    domain: PlanningDomain, goal: Goal, history: History, done: list[tuple[int, clingo.Symbol]]
) -> Run | None:
    """The run of a robot that sees what the record says, if it also does what that says."""
    first = done[0][0]
    left = list(done)

    def act(action: clingo.Symbol) -> list[Literal]:
        if not left or left[0][1] != action:
            raise _DepartureError
        step, _ = left.pop(0)
        if left and left[0][0] != step + 1:
            raise _DepartureError
        return _seen(history, step + 1)

    before = replace(domain, history=known_at(history, first))
    run: Run | None = None
    try:
        for latest in execute(before, goal, sensed=_seen(history, first), act=act):
            run = latest
    except _DepartureError:
        if left or run is None:
            return None
        # The record ends here; what would be done next was not.
        return replace(run, steps=run.steps[:-1])
    except PlanningError:
        return None
    return None if left else run


def _seen(history: History, step: int) -> list[Literal]:
    return [entry.literal for entry in history.observations if entry.step == step]


def _as_intended(domain: PlanningDomain, run: Run, done: list[tuple[int, clingo.Symbol]]) -> Run:
    knowledge, history = domain.knowledge, run.history
    known: tuple[Surprise, ...] = ()
    steps = []
    for place, (number, action) in enumerate(done):
        found = diagnose(knowledge, known_at(history, number), sensors_err=domain.sensors_err)
        new = tuple(surprise for surprise in found.surprises if surprise not in known)
        known = found.surprises
        sensed = tuple(_seen(history, number))
        plan = tuple(later for _, later in done[place:])
        decision = Decision.PERSIST if place else Decision.PLAN
        steps.append(Step(number, sensed, found.now, new, decision, plan, action=action))
    now = diagnose(knowledge, history, sensors_err=domain.sensors_err).now
    achieved = goal_holds(knowledge, run.goal, now.holds)
    return replace(run, steps=steps, outcome=Outcome.ACHIEVED if achieved else None)
