"""Say why actions would be done, or would not, of a plan of which nothing is done yet."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import clingo

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

__all__ = ["not_begun", "say_against", "why_would"]


def not_begun(view: RunView) -> bool:
    """Whether nothing is done yet, so that actions are spoken of as what would be done."""
    acted = any(step.action is not None for step in view.run.steps)
    return not acted and view.run.outcome is None


def why_would(view: RunView, query: Query) -> Told:
    """Why the plan has an action, of which nothing is done yet."""
    step, speech = view.present, view.speech
    begun = "I have not done anything yet"
    places = [place for place, action in enumerate(step.plan) if fits(query, action)]
    reasons: dict[str, Any] = {"steps": [], "planned": places}
    if not places:
        terms = [clingo.parse_term(argument or '"anything"') for argument in query.arguments]
        action = clingo.Function(query.predicate or "", terms)
        who = speech.subject(action)
        said = f"{begun}, and {who} would not {speech.act(action)}"
        return sentences([said]), reasons
    action = step.plan[places[0]]
    would = f"{speech.subject(action)} would {speech.act(action)}"
    if places[0]:
        return sentences([begun, f"{would} as action {places[0] + 1} of my plan"]), reasons
    needs = view.intentions.needs(replace(step, action=action))
    reasons |= {"step": step.number, "action": str(action)}
    reasons["needed_by"] = needs_values(needs, view.run)
    wanted = [speech.do(need.action) for need in needs if need.action is not None]
    if not needs:
        return sentences([begun, f"{would}, although my plan would work without"]), reasons
    if not wanted:
        wish = say_goal(view.run.goal, view.domain, speech, end=needs[0].state)
        return sentences([begun, f"{would} because my goal is that {wish}"]), reasons
    then = f", in order to {wanted[-1]}" if len(wanted) > 1 else ""
    return sentences([begun, f"{would} because I want to {wanted[0]}{then}"]), reasons


def say_against(view: RunView, step: Step, action: clingo.Symbol, why: WhyNot) -> str:
    """What speaks against an action that would be done at a step, as a clause."""
    speech = view.speech
    who, act = speech.subject(action), speech.act(action)
    if step.plan and step.plan[0] == action:
        return f"but {who} would {act}: nothing is done yet, and my plan begins with that"
    if action in step.plan:
        return f"but {who} would {act} later: it is action {step.plan.index(action) + 1} of my plan"
    if why.against is Against.OBSTACLE:
        obstacle = say_obstacle(why.obstacles, speech, past=False)
        return ": ".join(filter(None, [f"{who} cannot {act} now", obstacle]))
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
