"""Answer what was believed in the course of a run: at which steps, and since when.

The beliefs are those of the time: what was believed at step 1 is what was known then, whatever came
out later.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import clingo

from seewhy.domain.wording import join_words
from seewhy.knowledge.ground import complement_of
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.dialogue.belief_answers import because, instead_of, none_of
from seewhy.planning.dialogue.belief_reason import Beliefs
from seewhy.planning.dialogue.hypothetical_history import known_at
from seewhy.planning.dialogue.location_fluents import contents, place_of, places, whereabouts
from seewhy.planning.dialogue.query import Asks, Query, Told
from seewhy.planning.dialogue.run_view import RunView
from seewhy.planning.dialogue.surface_realisation import sentences

Literals = tuple[clingo.Symbol, ...]


@dataclass(frozen=True)
class _Span:
    """Steps, the first and the last, at which the same was believed; ``now`` if it still is."""

    first: int
    last: int
    believed: Literals
    now: bool

    def to_dict(self) -> dict[str, Any]:
        return {
            "first": self.first,
            "last": self.last,
            "believed": [str(literal) for literal in self.believed],
        }


def was_so(view: RunView, query: Query) -> Told:
    """Whether something was believed at some step, when, and what is believed since."""
    spans = _spans(view, lambda state: _known(view, query, state))
    asked = [span for span in spans if _as_asked(query, span.believed)]
    if asked:
        shown = asked[-1]
        said = [f"yes, {join_words([_when_believed(view, span) for span in asked])}"]
        beliefs = Beliefs(view.domain, known_at(view.run.history, shown.last))
        present = view.run.history.last_step
        rest = because(beliefs, shown.believed[0], shown.last, now=present)
        if spans[-1] is not shown:
            rest.append(_since(view, query))
        return sentences([*said, *rest]), _reasons(spans, believed=True)
    if not any(span.believed for span in spans):
        return "", _reasons(spans, believed=None)
    literal = query.symbol()
    said = [f"no, at no step did I believe that {view.speech.said(literal)}"]
    if query.whose is not None:
        said = ["no, at no step did I believe that"]
    rest = [_since(view, query)]
    last = spans[-1]
    if last.believed:
        beliefs = Beliefs(view.domain, view.run.history)
        now = instead_of(view.domain, last.believed[0], beliefs.diagnosis.states[last.last])
        rest += because(beliefs, now, last.last, now=last.last)
    return sentences([*said, *rest]), _reasons(spans, believed=False)


def where_was(view: RunView, query: Query) -> Told:
    """Where a thing was, step by step."""
    thing = next(term for term in query.arguments if term is not None)

    def found(state: State) -> Literals:
        literal = whereabouts(view.domain, state, thing)
        return () if literal is None else (literal,)

    name = "I was" if thing == view.domain.robot else f"{view.speech.name(thing)} was"
    return _course(view, found, unknown=f"I did not know where {name}")


def which_were(view: RunView, query: Query) -> Told:
    """Of what something was believed, step by step, or what was at a place."""
    asks_who = query.text.startswith("who ")
    whose = {place.predicate for place in places(view.domain) if place.single}

    def found(state: State) -> Literals:
        if query.asks is Asks.CONTENTS:
            there = contents(view.domain, state, query.arguments[0] or "")
            return tuple(robot for robot in there if robot.name in whose or not asks_who)
        return tuple(
            literal
            for literal in state.positive(query.predicate)
            if all(
                asked in (None, str(term))
                for asked, term in zip(query.arguments, literal.arguments, strict=True)
            )
        )

    none = none_of(query.text)
    knew = "I knew of no such place" if none == "nowhere" else f"I knew of {none}"
    return _course(view, found, unknown=knew, never=f"{none} that I knew of")


def _course(
    view: RunView, found: Callable[[State], Literals], *, unknown: str, never: str = ""
) -> Told:
    spans = _spans(view, found)
    reasons = _reasons(spans)
    if never and not any(span.believed for span in spans):
        return sentences([f"{never}, at any step"]), reasons
    clauses = [
        _when_believed(view, span) if span.believed else f"{_when(span)} {unknown}"
        for span in spans
    ]
    return sentences([join_words(clauses)]), reasons


def _spans(view: RunView, found: Callable[[State], Literals]) -> list[_Span]:
    last = view.run.history.last_step
    spans: list[_Span] = []
    for step in range(last + 1):
        believed = found(view.believed(step))
        if spans and spans[-1].believed == believed:
            spans[-1] = replace(spans[-1], last=step, now=step == last)
        else:
            spans.append(_Span(step, step, believed, step == last))
    return spans


def _known(view: RunView, query: Query, state: State) -> Literals:
    """What was believed of what is asked: it, its opposite, or neither."""
    arguments = list(query.arguments)
    if query.whose is not None:
        place = place_of(view.domain, state, arguments[query.whose] or "")
        if place is None:
            return ()
        arguments[query.whose] = place
    literal = replace(query, arguments=tuple(arguments), whose=None).symbol()
    return tuple(said for said in (literal, complement_of(literal)) if said in state.holds)


def _as_asked(query: Query, believed: Sequence[clingo.Symbol]) -> bool:
    return bool(believed) and believed[0].positive == query.positive


def _since(view: RunView, query: Query) -> str:
    """What is believed now, and since when; what is so instead of what is not."""

    def found(state: State) -> Literals:
        return tuple(
            instead_of(view.domain, literal, state) for literal in _known(view, query, state)
        )

    last = _spans(view, found)[-1]
    return _when_believed(view, last) if last.believed else f"{_when(last)} I do not know"


def _when_believed(view: RunView, span: _Span) -> str:
    if span.now:
        return f"{_when(span)} I have believed that {view.speech.every(span.believed)}"
    return f"{_when(span)} I believed that {view.speech.every_past(span.believed)}"


def _when(span: _Span) -> str:
    if span.now:
        return f"since step {span.first}" if span.first else "all along"
    if span.first == span.last:
        return f"at step {span.first}"
    return f"from step {span.first} to step {span.last}"


def _reasons(spans: Sequence[_Span], **more: object) -> dict[str, Any]:
    return {"steps": [span.to_dict() for span in spans], **more}
