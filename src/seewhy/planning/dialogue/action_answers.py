"""Answer why an action was done, why another was not, and why the one rather than the other."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import clingo

from seewhy.domain.wording import join_words, sentence
from seewhy.planning.dialogue.action_reason import Against, Removed
from seewhy.planning.dialogue.action_words import (
    actions_asked,
    count_actions,
    needs_values,
    obstacle_values,
    say_actions,
    say_hoped,
    say_not_done,
    say_obstacle,
)
from seewhy.planning.dialogue.clause_forms import gerund
from seewhy.planning.dialogue.goal_words import say_goal
from seewhy.planning.dialogue.intended_answers import (
    is_ahead,
    is_still_open,
    place_in_plan,
    say_against,
    why_would,
)
from seewhy.planning.dialogue.query import Asks, Query, Told
from seewhy.planning.dialogue.run_view import RunView
from seewhy.planning.dialogue.surface_realisation import Speech, sentences
from seewhy.planning.execution.execution import Decision


def why_did(view: RunView, query: Query) -> Told:
    """Why an action was done: what needed it."""
    if is_ahead(view, query):
        return why_would(view, query)
    done = view.done(query)
    chosen = [step for step in done if query.step in (None, step.number)]
    speech = view.speech
    if not chosen:
        asked = say_not_done(view, query)
        if done:
            when = join_words([str(step.number) for step in done])
            asked = f"{asked} at step {query.step}, but at step {when}"
        place = None if done or query.step is not None else place_in_plan(view, query)
        if place is not None:
            asked = f"{say_not_done(view, query, have=True)} yet: it is action {place} of my plan"
        return sentences([asked]), {"steps": [step.number for step in done]}
    step = chosen[0] if query.first else chosen[-1]
    action = step.action
    assert action is not None
    needs = view.intentions.needs(step)
    tried = (step.number, action) in view.failures
    did = f"tried to {speech.act(action)}" if tried else speech.did(action)
    beginning = f"{speech.subject(action)} {did} at step {step.number}"
    reasons = {
        "step": step.number,
        "action": str(action),
        "needed_by": needs_values(needs, view.run),
    }
    if not needs:
        return sentences([f"{beginning}, although my plan would have worked without"]), reasons
    wanted = [speech.do(need.action) for need in needs if need.action is not None]
    if not wanted:
        wish = say_goal(view.run.goal, view.domain, speech, end=needs[0].state)
        return sentences([f"{beginning} because my goal was that {wish}"]), reasons
    then = f", in order to {wanted[-1]}" if len(wanted) > 1 else ""
    # What lies between is told by the tree of reasons.
    said = [f"{beginning} because I wanted to {wanted[0]}{then}"]
    obstacle = say_obstacle(needs[0].obstacles, speech)
    if obstacle:
        said.append(f"otherwise I could not have done that: {obstacle}")
    removed = view.intentions.removed(step)
    if removed is not None:
        reasons["removed"] = {
            "action": str(removed.action),
            "obstacle": obstacle_values(removed.obstacle),
            "changed": [str(literal) for literal in removed.changed],
        }
        said.append(_say_removed(removed, speech))
    return sentences([*said, say_hoped(view, step)]), reasons


def _say_removed(removed: Removed, speech: Speech) -> str:
    """What was in a later action's way: the axiom, and the things as they lay."""
    axiom = removed.obstacle.axiom
    rule = f'"{axiom.text}"' if axiom.has_sentence else ""
    lay = speech.every_past(removed.changed or removed.obstacle.holds)
    return (
        f"it also removed what stood in the way of {gerund(speech.do(removed.action))}: "
        f"{', and '.join(filter(None, [rule, lay]))}"
    )


def why_not(view: RunView, query: Query) -> Told:
    """Why an action was not done: what failed, or the longer plan."""
    step = view.asked(query)
    when = f"at step {step.number}"
    found = [
        (action, view.intentions.why_not(action, step)) for action in actions_asked(view, query)
    ]
    ranks = list(Against)
    action, why = min(found, key=lambda pair: ranks.index(pair[1].against))
    if any(other.against is not Against.OBSTACLE for _, other in found):
        action, why = next(pair for pair in found if pair[1].against is not Against.OBSTACLE)
    reasons: dict[str, Any] = {
        "step": step.number,
        "action": str(action),
        "against": why.against.value,
        "obstacles": [obstacle_values(applied) for applied in why.obstacles],
        "actions": [str(planned) for planned in why.actions],
    }
    if is_still_open(view, step):
        return sentences([say_against(view, query, step, action, why)]), reasons
    who, act = view.speech.subject(action), view.speech.act(action)
    many = count_actions(len(why.actions))
    if why.against is Against.DONE:
        said = f"but {who} did {act} {when}"
    elif why.against is Against.OBSTACLE:
        obstacle = say_obstacle(why.obstacles, view.speech)
        said = ": ".join(filter(None, [f"{who} could not {act} {when}", obstacle]))
    elif step.decision is Decision.STOP:
        said = "there was nothing left to do: the goal was reached"
    elif why.against is Against.NO_PLAN:
        said = (
            f"{who} could have, but had {who} {view.speech.did(action)} {when}, the goal could "
            "not have been reached any more"
        )
    elif step.decision is Decision.GIVE_UP:
        said = f"{who} could have: the goal can be reached by {many}"
    elif why.against is Against.AS_GOOD:
        said = f"{who} could have as well: that plan has {many} too"
    else:
        said = (
            f"the plan would have been longer: {many} ({say_actions(why.actions, view.speech)}) "
            f"instead of {len(step.plan)}"
        )
    return sentences([said]), reasons


def rather_than(view: RunView, query: Query, foil: Query, reasons: dict[str, Any]) -> Told:
    """What speaks against the other action of a contrast, where the one was done."""
    if "action" not in reasons:
        return "", {}
    if foil.predicate == query.predicate:
        # What the contrast does not name is as it was.
        done = clingo.parse_term(reasons["action"]).arguments
        named = zip(foil.arguments, done, strict=True)
        foil = replace(foil, arguments=tuple(asked or str(term) for asked, term in named))
    still_open = is_ahead(view, query)
    step = view.present.number if still_open else reasons["step"]
    foil = replace(foil, asks=Asks.WHY_NOT, step=step)
    text, against = why_not(view, foil)
    other = clingo.parse_term(against["action"])
    do, who = view.speech.do(other), sentence(view.speech.subject(other)).removesuffix(".")
    if still_open:
        text = text.replace("The plan would", f"If I chose to {do}, the plan would", 1)
        text = text.replace(f"{who} could as well:", f"I could as well choose to {do}:", 1)
    elif against["against"] == Against.LONGER.value:
        text = text.replace("The plan would", f"Had I chosen to {do}, the plan would", 1)
    elif against["against"] == Against.AS_GOOD.value:
        text = text.replace(f"{who} could have as well", f"I could as well have chosen to {do}", 1)
    return text, against
