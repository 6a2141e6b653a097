"""A history as it was at an earlier step, or with something supposed that was not seen."""

from __future__ import annotations

from dataclasses import replace

import clingo

from seewhy.errors import PlanningError
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.ground import complement_of, key_of, literal_of
from seewhy.knowledge.history import History, Observation
from seewhy.knowledge.language import Knowledge
from seewhy.planning.diagnosis.diagnosis import diagnose
from seewhy.planning.planner.mutex import mutexes


def known_at(history: History, step: int | None) -> History:
    """Return what was known at a step: all of the history where it is None.

    Examples
    --------
    >>> from seewhy.knowledge.history import read_history
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge("#fluent basic lit. #action press.")
    >>> past = read_history("happened press at 0. observed lit at 1.", known.signature)
    >>> known_at(past, 0).last_step
    0
    """
    if step is None:
        return history
    return replace(
        history,
        observations=tuple(seen for seen in history.observations if seen.step <= step),
        occurrences=tuple(done for done in history.occurrences if done.step < step),
    )


def supposed_history(
    knowledge: Knowledge, history: History, literal: clingo.Symbol, *, sensors_err: bool = False
) -> History | None:
    """Return the history with a literal seen at its end, without what contradicts that there.

    None where nothing that may be assumed explains it; with ``sensors_err``, also where it would
    sooner be taken to be seen wrongly.

    Examples
    --------
    >>> from seewhy.knowledge.history import read_history
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge("#sort place = {hall, attic}. #fluent basic dark(place). "
    ...     "#fluent basic locked.")
    >>> past = read_history("observed -dark(hall) at 0. observed locked at 0.", known.signature)
    >>> print(supposed_history(known, past, clingo.parse_term("dark(hall)")))
    observed locked at 0.
    observed dark(hall) at 0.
    """

    def explained(whole: History) -> bool:
        try:
            now = diagnose(knowledge, whole, sensors_err=sensors_err).now
        except PlanningError:
            return False
        return not sensors_err or literal in now.holds

    step = history.last_step
    supposed = Observation(literal_of(str(literal)), step)
    before = [observation for observation in history.observations if observation.step < step]
    present = [
        observation
        for observation in history.observations
        if observation.step == step and not _excludes(observation.literal, literal, knowledge)
    ]
    whole = replace(history, observations=(*before, *present, supposed))
    if explained(whole):
        return whole
    kept = replace(history, observations=(*before, supposed))
    if not explained(kept):
        return None
    for seen_now in present:
        more = replace(kept, observations=(*kept.observations, seen_now))
        kept = more if explained(more) else kept
    return kept


def _excludes(seen: Literal, literal: clingo.Symbol, knowledge: Knowledge) -> bool:
    symbol = clingo.parse_term(key_of(seen))
    if symbol == complement_of(literal):
        return True
    if not (symbol.positive and literal.positive) or symbol == literal:
        return False
    return any(
        mutex.predicate == symbol.name == literal.name
        and all(
            one == other or place == mutex.position
            for place, (one, other) in enumerate(
                zip(symbol.arguments, literal.arguments, strict=True)
            )
        )
        for mutex in mutexes(knowledge)
    )
