"""Answer why an action is planned, where nothing has been done yet."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.dialogue.action_words import needs_values, say_obstacle
from seewhy.planning.dialogue.goal_words import say_goal
from seewhy.planning.dialogue.query import Query, Told
from seewhy.planning.dialogue.run_view import RunView, fits
from seewhy.planning.dialogue.surface_realisation import sentences
from seewhy.planning.execution.execution import Decision, Step
from seewhy.planning.execution.plan_monitoring import state_after

__all__ = ["planned_steps", "why_planned"]


def planned_steps(view: RunView, query: Query) -> list[Step]:
    """Return the steps of the plan at which an action is to be done; none once something was done.

    Examples
    --------
    >>> from seewhy.planning.dialogue.query import Asks
    >>> from seewhy.planning.domain import load_planning_domain
    >>> from seewhy.planning.execution.execution import Run
    >>> from seewhy.planning.goal import read_goal
    >>> domain = load_planning_domain("robot_assistant")
    >>> goal = read_goal("loc(rob1, bathroom)", domain.knowledge)
    >>> view = RunView(domain, Run(goal, domain.history))
    >>> asked = Query(Asks.WHY_DID, "why", "move", ("rob1", "bathroom"))
    >>> [step.number for step in planned_steps(view, asked)]
    [1]
    """
    if any(step.action is not None for step in view.run.steps):
        return []
    first = view.present
    state: State | None = first.believed
    found = []
    for place, action in enumerate(first.plan):
        if state is None:
            break
        number = first.number + place
        if fits(query, action) and query.step in (None, number):
            found.append(
                replace(
                    first,
                    number=number,
                    believed=state,
                    plan=first.plan[place:],
                    action=action,
                    decision=Decision.PERSIST,
                )
            )
        state = state_after(view.domain.knowledge, [action], start=state)
    return found


def why_planned(view: RunView, step: Step) -> Told:
    """Return what needs an action that is planned."""
    speech, action = view.speech, step.action
    assert action is not None
    needs = view.intentions.needs(step)
    beginning = f"{speech.subject(action)} will {speech.act(action)} at step {step.number}"
    reasons: dict[str, Any] = {
        "step": step.number,
        "action": str(action),
        "needed_by": needs_values(needs, view.run),
    }
    wanted = [speech.do(need.action) for need in needs if need.action is not None]
    if not needs:
        return sentences([f"{beginning}, although the plan would work without"]), reasons
    if not wanted:
        wish = say_goal(view.run.goal, view.domain, speech, end=needs[0].state)
        return sentences([f"{beginning} because my goal is that {wish}"]), reasons
    then = f", in order to {wanted[-1]}" if len(wanted) > 1 else ""
    said = [f"{beginning} because I want to {wanted[0]}{then}"]
    obstacle = say_obstacle(needs[0].obstacles, speech, past=False)
    if obstacle:
        said.append(f"otherwise I could not do that: {obstacle}")
    return sentences(said), reasons
