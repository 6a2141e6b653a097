"""What a run leaves to learn from: its history, and what the things are like that it is about.

What was found to be seen wrongly is left out.
"""

from __future__ import annotations

from dataclasses import replace

from seewhy.knowledge.ground import key_of
from seewhy.knowledge.history import History
from seewhy.planning.diagnosis.diagnosis import SurpriseKind, diagnose
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.execution.execution import Run
from seewhy.planning.things.recorded_scene import seen_statics


def record_of(domain: PlanningDomain, run: Run) -> History:
    """Return the history of a run, with what the things of a picture are like.

    Observations that its diagnosis takes to be wrong are left out.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> from seewhy.planning.goal import read_goal
    >>> domain = load_planning_domain("robot_assistant")
    >>> run = Run(read_goal("loc(rob1, kitchen)", domain.knowledge), domain.history)
    >>> print(record_of(domain, run))
    observed loc(rob1, library) at 0.
    """
    history = replace(run.history, statics=seen_statics(domain))
    if not run.sensors_err:
        return history
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
    return replace(history, observations=tuple(kept))
