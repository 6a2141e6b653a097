"""Say why actions would be done, or would not, of what is still to be done of a plan."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import clingo

from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.dialogue.action_reason import Against, WhyNot
from seewhy.planning.dialogue.action_words import (
    count_actions,
    needs_values,
    say_actions,
    say_obstacle,
)
from seewhy.planning.dialogue.goal_words import say_goal
from seewhy.planning.dialogue.query import Query, Told
from seewhy.planning.dialogue.run_view import RunView, fits
from seewhy.planning.dialogue.surface_realisation import sentences
from seewhy.planning.execution.execution import Decision, Step
from seewhy.planning.execution.plan_monitoring import state_after

__all__ = ["is_ahead", "is_still_open", "not_begun", "place_in_plan", "say_against", "why_would"]

_OF_WHAT_CAN_BE = ("why can ", "why could ")
_OF_WHAT_COMES = ("why will ", "why would ", "why are ", "why is ")


def not_begun(view: RunView) -> bool:
    """Whether nothing is done yet, so that actions are spoken of as what would be done."""
    acted = any(step.action is not None for step in view.run.steps)
    return not acted and view.run.outcome is None


def is_ahead(view: RunView, query: Query) -> bool:
    """Whether it is asked why something will be done, not why it was."""
    if not_begun(view):
        return True
    asked_ahead = view.run.outcome is None and query.text.startswith(_OF_WHAT_COMES)
    return asked_ahead and query.step is None and bool(_planned_steps(view, query))


def is_still_open(view: RunView, step: Step) -> bool:
    """Whether a step is the present one of a run that goes on, at which nothing is done yet."""
    acted = {done.number for done in view.run.steps if done.action is not None}
    return view.run.outcome is None and step.number not in acted


def place_in_plan(view: RunView, query: Query) -> int | None:
    """Which action of the plan from here on it is that a question is about."""
    planned = _planned_steps(view, query) if view.run.outcome is None else []
    return planned[0].number - view.present.number + 1 if planned else None


def why_would(view: RunView, query: Query) -> Told:
    """Why the plan has an action that is still to be done."""
    step, speech = view.present, view.speech
    begun = "I have not done anything yet" if not_begun(view) else ""
    planned = _planned_steps(view, query)
    reasons: dict[str, Any] = {"steps": [], "planned": [of_plan.number for of_plan in planned]}
    if not planned:
        terms = [clingo.parse_term(argument or '"anything"') for argument in query.arguments]
        action = clingo.Function(query.predicate or "", terms)
        who = speech.subject(action)
        said = f"{begun}, and {who} would not {speech.act(action)}"
        return sentences([said]), reasons
    of_plan = planned[0]
    assert of_plan.action is not None
    would = f"{speech.subject(of_plan.action)} would {speech.act(of_plan.action)}"
    if of_plan.number > step.number:
        would = f"{would} as action {of_plan.number - step.number + 1} of my plan"
    needs = view.intentions.needs(of_plan)
    reasons |= {"step": of_plan.number, "action": str(of_plan.action)}
    reasons["needed_by"] = needs_values(needs, view.run)
    wanted = [speech.do(need.action) for need in needs if need.action is not None]
    if not needs:
        return sentences([begun, f"{would}, although my plan would work without"]), reasons
    if not wanted:
        wish = say_goal(view.run.goal, view.domain, speech, end=needs[0].state)
        return sentences([begun, f"{would} because my goal is that {wish}"]), reasons
    then = f", in order to {wanted[-1]}" if len(wanted) > 1 else ""
    told = [begun, f"{would} because I want to {wanted[0]}{then}"]
    obstacle = say_obstacle(needs[0].obstacles, speech, past=False)
    if obstacle:
        told.append(f"otherwise I could not do that: {obstacle}")
    return sentences(told), reasons


def _planned_steps(view: RunView, query: Query) -> list[Step]:
    """The steps of the plan at which an action is to be done, as they would then be."""
    first = view.present
    state: State | None = first.believed
    found = []
    for place, action in enumerate(first.plan):
        if state is None:
            break
        number = first.number + place
        if fits(query, action) and query.step in (None, number):
            plan = first.plan[place:]
            found.append(replace(first, number=number, believed=state, plan=plan, action=action))
        state = state_after(view.domain.knowledge, [action], start=state)
    return found


def say_against(view: RunView, query: Query, step: Step, action: clingo.Symbol, why: WhyNot) -> str:
    """What speaks against an action that would be done at a step, as a clause."""
    speech = view.speech
    who, act = speech.subject(action), speech.act(action)
    if step.plan and step.plan[0] == action:
        since = "nothing is done yet, and my plan begins with that"
        since = since if not_begun(view) else "my plan goes on with that"
        return f"but {who} would {act}: {since}"
    obstacle = say_obstacle(why.obstacles, speech, past=False)
    cannot = ": ".join(filter(None, [f"{who} cannot {act} now", obstacle]))
    if action in step.plan:
        place = step.plan.index(action) + 1
        if query.text.startswith(_OF_WHAT_CAN_BE) and why.against is Against.OBSTACLE:
            return f"{cannot}; it is action {place} of my plan"
        return f"but {who} would {act} later: it is action {place} of my plan"
    if why.against is Against.OBSTACLE:
        return cannot
    if step.decision is Decision.STOP:
        return "there is nothing to do: the goal is reached"
    if why.against is Against.NO_PLAN:
        return f"{who} can, but then the goal could not be reached any more"
    many = count_actions(len(why.actions))
    if step.decision is Decision.GIVE_UP:
        return f"{who} can: the goal can be reached by {many}"
    if why.against is Against.AS_GOOD:
        return f"{who} could as well: that plan has {many} too"
    return (
        f"the plan would be longer: {many} ({say_actions(why.actions, speech)}) instead of "
        f"{len(step.plan)}"
    )
