"""Answer what would be done if something were so, or had happened."""

from __future__ import annotations

from typing import Any

import clingo

from seewhy.knowledge.ground import literal_of
from seewhy.knowledge.history import History
from seewhy.knowledge.signature import PredicateKind
from seewhy.planning.dialogue.action_words import (
    count_actions,
    say_actions,
    say_obstacle,
    say_supposed,
)
from seewhy.planning.dialogue.hypothetical_history import known_at, supposed_history
from seewhy.planning.dialogue.query import Query, Told
from seewhy.planning.dialogue.run_view import RunView
from seewhy.planning.dialogue.surface_realisation import sentences, subjunctive
from seewhy.planning.execution.execution import Decision, Run
from seewhy.planning.execution.plan_monitoring import state_after


def what_if(view: RunView, query: Query) -> Told:
    """What would be done if a fluent held, or after an action or event that was not."""
    literal = query.symbol()
    if not view.domain.knowledge.signature.kind(literal.name).is_fluent:
        return _if_it_happened(view, query, literal)
    history = known_at(view.run.history, query.step)
    clause = view.speech.say(literal)
    supposing = supposed_history(
        view.domain.knowledge, history, literal, sensors_err=view.domain.sensors_err
    )
    if supposing is None:
        said = f"nothing that I know of could bring it about that {clause}"
        return sentences([said]), {"literal": str(literal)}
    supposed = f"if {subjunctive(clause)}"
    text, reasons = _would(view, supposing, supposed, present=history, literal=literal)
    return text, {"literal": str(literal), **reasons}


def _if_it_happened(view: RunView, query: Query, event: clingo.Symbol) -> Told:
    history = known_at(view.run.history, query.step)
    state = view.at(history.last_step).believed
    happened = view.speech.happened(event)
    reasons: dict[str, Any] = {"action": str(event)}
    if state_after(view.domain.knowledge, [event], start=state) is None:
        now = history.last_step == view.run.history.last_step and view.run.outcome is None
        obstacles = view.intentions.obstacles(event, state)
        obstacle = say_obstacle(obstacles, view.speech, past=not now)
        cannot = f"it cannot be that {happened}"
        signature = view.domain.knowledge.signature
        if now and signature.kind(event.name) is PredicateKind.ACTION:
            cannot = f"{view.speech.subject(event)} cannot {view.speech.act(event)} now"
        return sentences([": ".join(filter(None, [cannot, obstacle]))]), reasons
    supposing = history.with_occurrence(literal_of(str(event)), step=history.last_step)
    text, decided = _would(view, supposing, f"if {happened}", present=history)
    return text, reasons | decided


def _would(
    view: RunView,
    supposing: History,
    supposed: str,
    *,
    present: History,
    literal: clingo.Symbol | None = None,
) -> Told:
    """What would be done after a supposed history."""
    step = view.decided(supposing)
    reasons = {
        "decision": step.decision.value,
        "actions": [str(action) for action in step.plan],
        "because": [str(hindrance) for hindrance in step.because],
    }
    if step.decision is Decision.STOP:
        return sentences([f"{supposed}, I would do nothing: the goal is reached"]), reasons
    if step.decision is Decision.GIVE_UP:
        since = view.speech.every(hindrance for hindrance in step.because if hindrance != literal)
        also = f", since {since} as well" if since else ""
        said = f"{supposed}, I would give up: the goal could not be reached{also}"
        return sentences([said]), reasons
    would = f"{supposed}, I would {say_actions(step.plan, view.speech)}"
    if step.doubted:
        hoped = say_supposed(RunView(view.domain, Run(view.run.goal, supposing, [step])), step)
        hoped = hoped or "something changes that I saw before"
        return sentences([f"{would}, hoping that {hoped}", "no plan would be sure"]), reasons
    otherwise = view.at(present.last_step).plan
    if step.plan == otherwise:
        would += ", just as otherwise"
    elif otherwise and len(step.plan) != len(otherwise):
        would += f": {count_actions(len(step.plan))} instead of {len(otherwise)}"
    return sentences([would]), reasons
