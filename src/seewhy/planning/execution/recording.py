"""What a run leaves to learn from: its history, without what was found to be seen wrongly."""

from __future__ import annotations

from dataclasses import replace

from seewhy.knowledge.ground import key_of
from seewhy.knowledge.history import History
from seewhy.planning.diagnosis.diagnosis import SurpriseKind, diagnose
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.execution.execution import Run


def record_of(domain: PlanningDomain, run: Run) -> History:
    """Return the history of a run; observations that its diagnosis takes to be wrong are left out.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> from seewhy.planning.goal import read_goal
    >>> domain = load_planning_domain("robot_assistant")
    >>> run = Run(read_goal("loc(rob1, kitchen)", domain.knowledge), domain.history)
    >>> print(record_of(domain, run))
    observed loc(rob1, library) at 0.
    """
    if not run.sensors_err:
        return run.history
    found = diagnose(domain.knowledge, run.history, sensors_err=True).surprises
    wrong = {
        (surprise.step, str(surprise.what))
        for surprise in found
        if surprise.kind is SurpriseKind.MISREADING
    }
    kept = (
        observation
        for observation in run.history.observations
        if (observation.step, key_of(observation.literal)) not in wrong
    )
    return replace(run.history, observations=tuple(kept))
