"""A run as questions ask about it: its steps, and those that would be decided elsewhere."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property

import clingo

from seewhy.knowledge.history import History
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.diagnosis.diagnosis import SurpriseKind, diagnose
from seewhy.planning.dialogue.action_reason import Intentions
from seewhy.planning.dialogue.hypothetical_history import known_at
from seewhy.planning.dialogue.query import Query
from seewhy.planning.dialogue.surface_realisation import Speech
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.execution.execution import Run, Step, execute

_OF_NOW = ("why do ", "why does ", "why will ", "why would ", "why can ", "why not ")
"""How a question begins that asks why not now, not why not when something else was done."""


class RunView:
    """A run with the words and the intentions of whoever is asked about it.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> from seewhy.planning.goal import read_goal
    >>> domain = load_planning_domain("robot_assistant")
    >>> goal = read_goal("loc(rob1, kitchen)", domain.knowledge)
    >>> [str(action) for action in RunView(domain, Run(goal, domain.history)).present.plan]
    ['move(rob1,kitchen)']
    """

    def __init__(self, domain: PlanningDomain, run: Run) -> None:
        self.domain = domain
        self.run = run
        self.speech = Speech(domain.words)
        self.intentions = Intentions(domain, run)

    @cached_property
    def present(self) -> Step:
        """The step that the run has come to, or what would be decided there."""
        last = self.run.steps[-1] if self.run.steps else None
        return last if last and last.action is None else self.decided(self.run.history)

    def at(self, number: int) -> Step:
        """The run's step where it has one of this number, else what would be decided there."""
        found = next((step for step in self.run.steps if step.number == number), None)
        return found or self.decided(known_at(self.run.history, number))

    def believed(self, number: int) -> State:
        """What was believed at a step, as of then."""
        found = next((step for step in self.run.steps if step.number == number), None)
        if found is not None:
            return found.believed
        history = known_at(self.run.history, number)
        errors = self.domain.sensors_err
        return diagnose(self.domain.knowledge, history, last=number, sensors_err=errors).now

    def asked(self, query: Query) -> Step:
        """The step that a question about an action is about."""
        if query.step is not None:
            return self.at(query.step)
        if query.text.startswith(_OF_NOW):
            return self.present
        acting = [step for step in self.run.steps if step.action is not None]
        same = [step for step in acting if step.action and step.action.name == query.predicate]
        return (same or acting)[-1] if acting else self.present

    def done(self, query: Query) -> list[Step]:
        """The steps at which an action that is asked about was done."""
        return [
            step for step in self.run.steps if step.action is not None and fits(query, step.action)
        ]

    def done_by_others(self, query: Query) -> list[Step]:
        """The steps at which another robot did what is asked of one."""
        actor = self.domain.words.actors.get(query.predicate or "")
        if actor is None:
            return []
        anybody = [None if place == actor else one for place, one in enumerate(query.arguments)]
        return self.done(replace(query, arguments=tuple(anybody)))

    def decided(self, history: History) -> Step:
        """What would be decided after a history."""
        domain = replace(self.domain, history=history)
        last = history.last_step
        seen = [entry.literal for entry in history.observations if entry.step == last]
        run = next(execute(domain, self.run.goal, sensed=seen, act=lambda _: []))
        return run.steps[0]

    @cached_property
    def failures(self) -> set[tuple[int, clingo.Symbol]]:
        """The steps and actions of attempts that failed."""
        errors = self.domain.sensors_err
        found = diagnose(self.domain.knowledge, self.run.history, sensors_err=errors).surprises
        return {
            (surprise.step, surprise.what)
            for surprise in found
            if surprise.kind is SurpriseKind.FAILURE
        }


def fits(query: Query, action: clingo.Symbol) -> bool:
    """Whether an action is one that a question is about."""
    return action.name == query.predicate and all(
        asked in (None, str(term))
        for asked, term in zip(query.arguments, action.arguments, strict=True)
    )
