"""Answer what was planned, done and wanted in a run, and how it ended."""

from __future__ import annotations

from itertools import groupby
from typing import Any

import clingo

from seewhy.domain.wording import join_words
from seewhy.planning.diagnosis.diagnosis import SurpriseKind
from seewhy.planning.dialogue.action_words import (
    say_actions,
    say_end,
    say_gave_up,
    say_hoped,
    say_no_way,
    say_not_done,
    say_supposed,
)
from seewhy.planning.dialogue.goal_words import say_goal
from seewhy.planning.dialogue.intended_answers import not_begun
from seewhy.planning.dialogue.query import Query, Told
from seewhy.planning.dialogue.run_view import RunView
from seewhy.planning.dialogue.surface_realisation import sentences
from seewhy.planning.execution.execution import Decision, Outcome
from seewhy.text.predicate_words import past


def goal(view: RunView, query: Query) -> Told:
    """What the goal is, or was."""
    wish = say_goal(view.run.goal, view.domain, view.speech)
    said = f"My goal {'was' if query.past else 'is'} that {wish}."
    return said, {"goal": view.run.goal.text}


def plan(view: RunView, query: Query) -> Told:
    """What is planned, or was at a step."""
    run, speech = view.run, view.speech
    if query.step is not None:
        then = view.at(query.step)
        had = f"to {say_actions(then.plan, speech)}" if then.plan else "to do nothing more"
        was = f"at step {query.step} my plan was {had}"
        return sentences([was, say_hoped(view, then) if then.plan else ""]), {
            "actions": [str(action) for action in then.plan]
        }
    if query.past and run.plans:
        made = [
            said
            for step in run.plans
            for said in (
                f"at step {step.number} I planned to {say_actions(step.plan, speech)}",
                say_hoped(view, step),
            )
        ]
        return sentences(made), {
            "plans": [
                {"step": step.number, "actions": [str(action) for action in step.plan]}
                for step in run.plans
            ]
        }
    if run.outcome is Outcome.ACHIEVED:
        return "I have no plan any more: the goal is reached.", {"actions": []}
    if run.outcome is Outcome.IMPOSSIBLE:
        return sentences([say_gave_up(run.steps[-1], speech)]), {"actions": []}
    step = view.present
    if step.decision is Decision.GIVE_UP:
        return sentences([f"I have no plan: {say_no_way(step, speech)}"]), {"actions": []}
    if not step.plan:
        return "I have nothing to do: the goal is reached.", {"actions": []}
    supposed = say_supposed(view, step)
    said = [
        f"my plan is to {say_actions(step.plan, speech)}",
        supposed and f"I suppose that {supposed}",
    ]
    return sentences(said), {"actions": [str(action) for action in step.plan]}


def done(view: RunView, query: Query) -> Told:
    """What was done, and what was found on the way."""
    run, speech = view.run, view.speech
    said: list[str] = []
    events: list[dict[str, Any]] = []
    did: list[tuple[str, str]] = []
    asked = [step for step in run.steps if query.step in (None, step.number)]
    whose = query.arguments[0] if query.arguments else None
    for step in asked:
        noticed = [
            past(speech.surprise(surprise))
            for surprise in step.surprises
            if surprise.kind is not SurpriseKind.FAILURE
        ]
        if noticed:
            said += _did(did)
            did = []
            said.append(f"at step {step.number} I found that {join_words(noticed)}")
        if step.action is not None and whose in (None, _actor(view, step.action)):
            failed = (step.number, step.action) in view.failures
            events.append({"step": step.number, "action": str(step.action), "failed": failed})
            tried = f"tried to {speech.act(step.action)} and failed"
            done_so = tried if failed else speech.did(step.action)
            did.append((speech.subject(step.action), done_so))
    said += _did(did)
    if query.step is not None and asked and not asked[-1].action:
        return sentences([*said, say_end(run, speech)]), {"actions": events}
    if query.step is not None and asked:
        return sentences(said), {"actions": events}
    if not events:
        who = "I" if whose in (None, view.domain.robot) else speech.name(whose)
        have = "have" if who == "I" else "has"
        yet = run.outcome is None
        said.append(f"{who} {have} not done anything yet" if yet else f"{who} did not do anything")
    said.append(say_end(run, speech))
    return sentences(said), {"actions": events}


def how_many_done(view: RunView, query: Query) -> Told:
    """How many actions were done so far, or before a step, and how many of them in vain."""
    until = len(view.run.steps) if query.step is None else query.step
    done_so = [step for step in view.run.steps if step.action is not None and step.number < until]
    failed = [step for step in done_so if (step.number, step.action) in view.failures]
    reasons = {"steps": [step.number for step in done_so], "failed": len(failed)}
    if not done_so:
        return "I have not done anything yet.", reasons
    actions = "one action" if len(done_so) == 1 else f"{len(done_so)} actions"
    vain = [f"{len(failed)} of them failed"] if failed else []
    return sentences([f"I did {actions}", *vain]), reasons


def did_so(view: RunView, query: Query) -> Told:
    """Whether an action was done."""
    tried = [step for step in view.done(query) if query.step in (None, step.number)]
    worked = [step for step in tried if (step.number, step.action) not in view.failures]
    reasons = {"steps": [step.number for step in worked]}
    if not tried and not_begun(view):
        return sentences(["no, I have not done anything yet"]), reasons
    if not tried:
        when = "" if query.step is None else f" at step {query.step}"
        have = query.text.startswith(("have ", "has "))
        return sentences([f"no, {say_not_done(view, query, have=have)}{when}"]), reasons
    steps = worked or tried
    numbers = join_words([str(step.number) for step in steps])
    when = f"at step{'s' * (len(steps) > 1)} {numbers}"
    action = steps[-1].action
    assert action is not None
    who = view.speech.subject(action)
    if not worked:
        failed = f"no, {who} tried to {view.speech.act(action)} {when} and failed"
        return sentences([failed]), reasons
    return sentences([f"yes, {who} {view.speech.did(action)} {when}"]), reasons


def has_ended(view: RunView, _: Query) -> Told:
    """Whether the goal is reached."""
    outcome = view.run.outcome
    reached = outcome is Outcome.ACHIEVED
    said = say_end(view.run, view.speech)
    if outcome is None:
        reached, said = _stands(view)
    yes = "yes" if reached else "no"
    return sentences([f"{yes}, {said}"]), {"outcome": outcome.value if outcome else None}


def _stands(view: RunView) -> tuple[bool, str]:
    """Whether the goal of a run that has not ended is reached, and how things stand."""
    step = view.present
    if step.decision is Decision.STOP:
        return True, "the goal is reached"
    if step.decision is Decision.GIVE_UP:
        return False, say_no_way(step, view.speech)
    return False, "I have not done anything yet" if not_begun(view) else "I am still on my way"


def why_ended(view: RunView, query: Query) -> Told:
    """Why the robot stopped, or gave up."""
    outcome = view.run.outcome
    reasons: dict[str, Any] = {"outcome": outcome.value if outcome else None}
    if outcome is Outcome.IMPOSSIBLE:
        last = view.run.steps[-1]
        reasons["because"] = [str(literal) for literal in last.because]
        said = [say_gave_up(last, view.speech)]
        if not last.because:
            said.append(
                "nothing that I saw there, had it alone been otherwise, would have left a plan"
            )
        return sentences(said), reasons
    if outcome is None:
        return sentences(["I did not", _stands(view)[1]]), reasons
    gave_up = "give up" in query.text or "fail" in query.text
    return sentences(["I did not" if gave_up else "", say_end(view.run, view.speech)]), reasons


def _did(did: list[tuple[str, str]]) -> list[str]:
    """What was done as clauses, one for what the same robot did one after the other."""
    return [
        f"{who} {join_words([done_so for _, done_so in same])}"
        for who, same in groupby(did, key=lambda pair: pair[0])
    ]


def _actor(view: RunView, action: clingo.Symbol) -> str | None:
    return view.speech.words.actor(action) or view.domain.robot
