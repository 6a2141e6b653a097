"""What an action usually does not achieve, as a sentence in the words of planning.toml."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from seewhy.induction.candidate import Candidate
from seewhy.planning.learning.default_sentence import (
    ArgumentNouns,
    condition_clauses,
    exception_clauses,
)
from seewhy.planning.learning.features import ArgumentFeatures
from seewhy.planning.words import PlanningWords, in_sequence
from seewhy.text.predicate_words import past_form

__all__ = ["Effect", "impossible_sentence"]


@dataclass(frozen=True)
class Effect:
    """What should come of an action, in its arguments.

    Attributes
    ----------
    predicate : str
        A fluent.
    places : tuple of int
        For each argument of the fluent, which argument of the action it is.
    holds : bool
        Whether the fluent should then hold.
    """

    predicate: str
    places: tuple[int, ...]
    holds: bool


def impossible_sentence(
    candidate: Candidate,
    features: ArgumentFeatures,
    words: PlanningWords,
    missed: Effect | None,
    *,
    unless: Collection[str] = (),
) -> str:
    """Return what usually does not come of an action, as "if the hand put a thing on another …".

    Examples
    --------
    >>> from seewhy.induction.tree import PathCondition
    >>> from seewhy.planning.domain import load_planning_domain
    >>> from seewhy.planning.learning.relations import Attribute
    >>> table = load_planning_domain("tabletop")
    >>> shape, values = Attribute("shape", (2, None)), {"shape(2, ?)": ("cube", "sphere")}
    >>> features = ArgumentFeatures(signature=table.knowledge.signature, predicate="put_on",
    ...     relations={}, places={}, values=values, same={0: "hand"},
    ...     attributes={"shape(2, ?)": shape})
    >>> onto_ball = Candidate("yes", (PathCondition("shape(2, ?)", ("sphere",)),))
    >>> impossible_sentence(onto_ball, features, table.words, Effect("on", (1, 2), True))
    ... # doctest: +NORMALIZE_WHITESPACE
    'if the hand put a thing on another thing and the other thing is a sphere, then usually the
     thing is not on the other thing'
    """
    things = ArgumentNouns(candidate, features, words)
    clauses = [_done(features, things), *condition_clauses(candidate, things, unless=unless)]
    effect = "this does not do what it should"
    if missed is not None:
        table = words.table(missed.predicate)
        effect = things.filled(table, missed.predicate, missed.places, not missed.holds)
    said = f"if {in_sequence(clauses)}, then usually {effect}"
    otherwise = exception_clauses(candidate, things, unless=unless)
    return f"{said}, unless {' or '.join(otherwise)}" if otherwise else said


def _done(features: ArgumentFeatures, things: ArgumentNouns) -> str:
    """That somebody did the action, as a clause."""
    words, name = things.words, features.predicate
    places = tuple(range(len(features.sorts)))
    table = words.actions.get(name)
    actor = words.actors.get(name)
    subject = words.name(words.robot) if words.robot else "the robot"
    if actor is not None:
        subject = things.say(actor)
    if table is None:
        verb, *rest = name.split("_")
        others = ", ".join(things.say(place) for place in places if place != actor)
        return " ".join(filter(None, [subject, past_form(verb), *rest, others]))
    done = things.slots(table.did, places)
    return done if table.do is None else f"{subject} {done}"
