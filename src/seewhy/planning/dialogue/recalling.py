"""The steps of a run of which only the history was kept."""

from __future__ import annotations

from dataclasses import replace

import clingo

from seewhy.knowledge.ground import key_of
from seewhy.knowledge.signature import PredicateKind
from seewhy.planning.diagnosis.diagnosis import Surprise, diagnose
from seewhy.planning.dialogue.supposing import known_at
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.execution.execution import Decision, Outcome, Run, Step
from seewhy.planning.planner.goal_test import holds_in


def recalled(domain: PlanningDomain, run: Run) -> Run:
    """Return the run with the steps that its history tells of, where it has none of its own.

    What was intended is taken to be what was done.
    """
    knowledge, history = domain.knowledge, run.history
    done = sorted(
        (
            (occurrence.step, clingo.parse_term(key_of(occurrence.action)))
            for occurrence in history.occurrences
            if knowledge.signature.kind(occurrence.action.predicate) is PredicateKind.ACTION
        ),
        key=lambda own: own[0],
    )
    if run.steps or not done:
        return run
    known: tuple[Surprise, ...] = ()
    steps = []
    for place, (number, action) in enumerate(done):
        found = diagnose(knowledge, known_at(history, number), sensors_err=domain.sensors_err)
        new = tuple(surprise for surprise in found.surprises if surprise not in known)
        known = found.surprises
        sensed = tuple(
            observation.literal
            for observation in history.observations
            if observation.step == number
        )
        plan = tuple(later for _, later in done[place:])
        steps.append(Step(number, sensed, found.now, new, Decision.PERSIST, plan, action=action))
    now = diagnose(knowledge, history, sensors_err=domain.sensors_err).now
    achieved = holds_in(knowledge, run.goal, now.holds)
    return replace(run, steps=steps, outcome=Outcome.ACHIEVED if achieved else None)
