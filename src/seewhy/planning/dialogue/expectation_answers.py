"""Answer what was expected of what was done, and what was seen instead."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Any

from seewhy.domain.wording import join_words
from seewhy.knowledge.ground import complement_of
from seewhy.planning.diagnosis.diagnosis import SurpriseKind
from seewhy.planning.dialogue.change_answers import unexpected
from seewhy.planning.dialogue.query import Query, Told
from seewhy.planning.dialogue.run_view import RunView
from seewhy.planning.dialogue.surface_realisation import sentences
from seewhy.planning.execution.execution import Step
from seewhy.text.predicate_words import past

__all__ = ["expected"]


def expected(view: RunView, query: Query) -> Told:
    """What was expected, and what was seen that was not so: at a step, or in the whole run.

    ``query.step`` is the step at which it was seen.
    """
    steps = [step for step in view.run.steps if query.step in (None, step.number)]
    if not steps:
        return "I have not done anything yet, so nothing came out other than expected.", {
            "unexpected": []
        }
    told = list(_told(view, query))
    if not told:
        when = "" if query.step is None else f" at step {query.step}"
        return sentences([f"all that I saw{when} was as I expected"]), {"unexpected": []}
    return " ".join(text for text, _ in told), {"unexpected": [reasons for _, reasons in told]}


def _told(view: RunView, query: Query) -> Iterator[Told]:
    steps = view.run.steps
    for step in steps[:1]:
        if step.surprises and query.step in (None, step.number):
            yield _at_first(view, step)
    for before, step in pairwise(steps):
        if step.surprises and query.step in (None, step.number):
            yield _after(view, before, step)


def _at_first(view: RunView, step: Step) -> Told:
    """What was other than usual before anything was done."""
    found = join_words([past(view.speech.surprise(surprise)) for surprise in step.surprises])
    return sentences([f"at step {step.number} I saw that {found}"]), _values(step, [])


def _after(view: RunView, before: Step, step: Step) -> Told:
    speech = view.speech
    assert before.action is not None
    seen = unexpected(view, before, step)
    did = f"{speech.subject(before.action)} {speech.did(before.action)} at step {before.number}"
    if (before.number, before.action) in view.failures:
        act = speech.act(before.action)
        did = f"{speech.subject(before.action)} tried to {act} at step {before.number}"
    said = [did]
    if seen:
        hoped = speech.every([complement_of(literal) for literal in seen])
        said = [f"{did} and expected that {hoped}"]
        said.append(f"instead I saw that {speech.every_past(seen)}")
    # What failed, and then what happened instead.
    surprises = sorted(step.surprises, key=lambda found: found.kind is not SurpriseKind.FAILURE)
    concluded = join_words([past(speech.surprise(surprise)) for surprise in surprises])
    said.append(f"so I concluded that {concluded}")
    return sentences(said), _values(step, [str(literal) for literal in seen])


def _values(step: Step, seen: list[str]) -> dict[str, Any]:
    return {
        "step": step.number,
        "seen": seen,
        "surprises": [
            {"step": surprise.step, "kind": surprise.kind.value, "what": str(surprise.what)}
            for surprise in step.surprises
        ],
    }
