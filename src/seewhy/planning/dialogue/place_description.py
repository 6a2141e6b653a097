"""Describe a place: what was detected in it, and what that amounts to."""

from __future__ import annotations

import re

import clingo

from seewhy.domain.wording import join_words
from seewhy.planning.dialogue.belief_reason import Beliefs
from seewhy.planning.dialogue.location_fluents import Place, places
from seewhy.text.nouns import plural


def describe_place(beliefs: Beliefs, place: str, step: int, *, named: bool) -> list[str]:
    """Return clauses that list what is at a place: "objects detected are a cup and a sofa".

    What was never seen is listed as expected. ``named`` says that the place is known already.
    """
    domain, speech = beliefs.domain, beliefs.speech
    seen = {literal for literal, at in beliefs.observations if at <= step}
    said = []
    for fluent in places(domain):
        if fluent.single:
            continue
        signature = domain.knowledge.signature
        kind = plural(signature.predicates[fluent.predicate].sorts[fluent.thing].replace("_", " "))
        there = [
            literal
            for literal in beliefs.diagnosis.states[step].positive(fluent.predicate)
            if str(literal.arguments[fluent.place]) == place
        ]
        where = "" if named else f" {fluent.preposition} {speech.name(place)}"
        for how, listed in (
            ("detected", [literal for literal in there if literal in seen]),
            ("expected", [literal for literal in there if literal not in seen]),
        ):
            if listed:
                things = join_words([_noun_phrase(beliefs, fluent, literal) for literal in listed])
                verb = "are" if len(listed) > 1 else "is"
                subject = kind if len(listed) > 1 else f"the only {_singular(beliefs, fluent)}"
                said.append(f"{subject} {how}{where} {verb} {things}")
    return said


def say_counted(beliefs: Beliefs, literal: clingo.Symbol, step: int) -> str | None:
    """Return a fluent with what is counted for it; None where nothing is."""
    speech = beliefs.speech
    for axiom, counted in beliefs.counted(literal, step):
        clauses = speech.every(counted)
        for fluent in places(beliefs.domain):
            for term in literal.arguments:
                where = f" {fluent.preposition} {speech.name(term)}"
                clauses = re.sub(rf"{re.escape(where)}(?=$| and |, )", " there", clauses)
        rule = f'"{axiom.text}"' if axiom.has_sentence else ""
        if literal.positive:
            return f"{speech.say(literal)} because {clauses}"
        but = f"only {clauses}" if clauses else "I know of nothing that would make it otherwise"
        return ", and ".join(filter(None, [f"{speech.say(literal)}: {but}", rule]))
    return None


def _singular(beliefs: Beliefs, fluent: Place) -> str:
    predicate = beliefs.domain.knowledge.signature.predicates[fluent.predicate]
    return predicate.sorts[fluent.thing].replace("_", " ")


def _noun_phrase(beliefs: Beliefs, fluent: Place, literal: clingo.Symbol) -> str:
    """The thing with the article that it is said with."""
    say = beliefs.domain.words.fluents[fluent.predicate].say
    article = "a " if re.search(rf"\ban? \{{{fluent.thing}\}}", say) else ""
    phrase = article + beliefs.speech.name(literal.arguments[fluent.thing])
    return re.sub(r"\ba (?=[aeiou])", "an ", phrase)
