"""Answer why the plan changed: what was seen, what follows from it, and what no longer worked."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import clingo

from seewhy.domain.wording import join_words
from seewhy.knowledge.ground import complement_of, fluent_of, key_of
from seewhy.planning.dialogue.action_reason import Failing
from seewhy.planning.dialogue.action_words import (
    needs_values,
    say_actions,
    say_gave_up,
    say_obstacle,
)
from seewhy.planning.dialogue.intended_answers import not_begun
from seewhy.planning.dialogue.query import Query, Told
from seewhy.planning.dialogue.run_view import RunView
from seewhy.planning.dialogue.surface_realisation import sentences
from seewhy.planning.execution.execution import Decision, Step
from seewhy.planning.execution.plan_monitoring import state_after
from seewhy.text.predicate_words import past

_CHANGING = (Decision.REPLAN, Decision.SKIP, Decision.GIVE_UP)


def why_changed(view: RunView, query: Query) -> Told:
    """Why the plan changed, at a step or at all steps at which it did."""
    steps = view.run.steps
    told = [
        _change(view, before, step)
        for before, step in pairwise(steps)
        if step.decision in _CHANGING and query.step in (None, step.number)
    ]
    if not told and not_begun(view):
        return sentences(["I have not done anything yet, and my plan has not changed"]), {
            "changes": []
        }
    if not told:
        when = "" if query.step is None else f" at step {query.step}"
        return sentences([f"the plan did not change{when}"]), {"changes": []}
    return " ".join(text for text, _ in told), {"changes": [reasons for _, reasons in told]}


def _change(view: RunView, before: Step, step: Step) -> Told:
    speech = view.speech
    hoped_for = _disappointed(view, step)
    seen = hoped_for or unexpected(view, before, step)
    noticed = [
        past(speech.surprise(surprise))
        for surprise in step.surprises
        if complement_of(surprise.what) not in seen
    ]
    begin = f"at step {step.number} "
    said = []
    if seen:
        said.append(f"{begin}I saw that {speech.every_past(seen)}")
        begin = ""
    if noticed:
        said.append(f"{begin or 'so '}I concluded that {join_words(noticed)}")
        begin = ""
    reasons: dict[str, Any] = {
        "step": step.number,
        "decision": step.decision.value,
        "seen": [str(literal) for literal in seen],
        "surprises": [
            {"step": surprise.step, "kind": surprise.kind.value, "what": str(surprise.what)}
            for surprise in step.surprises
        ],
    }
    if step.decision is Decision.SKIP:
        said.append(f"{begin}it was no longer needed to {say_actions(step.skipped, speech)}")
        return sentences(said), reasons | {"skipped": [str(action) for action in step.skipped]}
    failing = view.intentions.failing(before.plan[1:], step.believed)
    if failing is not None:
        reasons["failing"] = needs_values([failing], view.run)[0]
    if failing is not None and not hoped_for:
        said.append(begin + _no_longer(view, failing))
    if step.decision is Decision.GIVE_UP:
        said.append(say_gave_up(step, speech))
    else:
        said.append(f"so I decided to {say_actions(step.plan, speech)}")
        reasons["actions"] = [str(action) for action in step.plan]
    return sentences(said), reasons


def _no_longer(view: RunView, failing: Failing) -> str:
    if failing.action is None:
        return "what was left of my plan would no longer have reached the goal"
    obstacle = say_obstacle(failing.obstacles, view.speech)
    said = f"I could no longer {view.speech.do(failing.action)} as planned"
    return f"{said}: {obstacle}" if obstacle else said


def _disappointed(view: RunView, step: Step) -> list[clingo.Symbol]:
    """What is seen at a step instead of what the plan before it supposed."""
    made = [earlier for earlier in view.run.plans if earlier.number < step.number]
    supposed = made[-1].supposed if made else ()
    sensed = {clingo.parse_term(key_of(literal)) for literal in step.sensed}
    return [complement_of(hope) for hope in supposed if complement_of(hope) in sensed]


def unexpected(view: RunView, before: Step, step: Step) -> list[clingo.Symbol]:
    """Return what is seen at a step that is not as the action before it should have left it."""
    assert before.action is not None
    expected = state_after(view.domain.knowledge, [before.action], start=before.believed)
    if expected is None:
        return []
    sensed = [clingo.parse_term(key_of(literal)) for literal in step.sensed]
    against = [literal for literal in sensed if complement_of(literal) in expected.holds]
    open_before = [literal for literal in sensed if fluent_of(literal) in expected.unknown]
    found = against or [literal for literal in open_before if _in_plan(literal, before)]
    return [literal for literal in found if literal.positive] or found


def _in_plan(literal: clingo.Symbol, step: Step) -> bool:
    named = {str(term) for action in step.plan for term in action.arguments}
    return all(str(term) in named for term in literal.arguments)
