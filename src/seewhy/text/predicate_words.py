"""Clauses about predicates: what a name makes where a folder has no words, and the past tense."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence

__all__ = [
    "PREPOSITIONS",
    "base_form",
    "named_clause",
    "past",
    "past_clause",
    "past_form",
    "verb_place",
]

_PAST = {"is": "was", "are": "were", "am": "was", "has": "had", "have": "had", "does": "did",
         "do": "did", "can": "could"}  # fmt: skip
_IRREGULAR = {"hold": "held", "stand": "stood", "lie": "lay", "lean": "leant", "carry": "carried",
              "keep": "kept", "know": "knew", "see": "saw", "sit": "sat", "lead": "led",
              "belong": "belonged", "show": "showed", "wear": "wore", "hang": "hung",
              "sleep": "slept", "go": "went", "run": "ran", "come": "came", "give": "gave",
              "take": "took", "get": "got", "bear": "bore", "drive": "drove", "eat": "ate",
              "feel": "felt", "find": "found", "fit": "fit", "shine": "shone",
              "speak": "spoke", "think": "thought", "win": "won"}  # fmt: skip
_VERB = re.compile(r"^((?:an? |the )?\{\d+\}) (\w+s)\b")

_NOUNS_TOO = frozenset({"can", "will"})
_DETERMINERS = frozenset({"a", "an", "the", "my", "your", "his", "her", "its", "our", "their",
                          "this", "that", "no", "every", "each"})  # fmt: skip
PREPOSITIONS = frozenset({"in", "at", "on", "under", "behind", "near", "inside", "beside", "to",
                          "of", "with", "by", "from", "for", "above", "below", "over", "into",
                          "between", "through", "against"})  # fmt: skip
_NO_VERBS = ("ss", "us", "is", "ous")


def named_clause(name: str, arity: int) -> tuple[str, str]:
    """Return the clauses that say that a predicate holds, and that it does not.

    A name is read as a verb where it begins with one of the third person, else as what something
    is, or, of two things, as a relation where it ends with a preposition and as a noun where not.

    Examples
    --------
    >>> named_clause("works_in", 2)
    ('{0} works in {1}', '{0} does not work in {1}')
    >>> named_clause("next_to", 2)[0], named_clause("colour", 2)[0], named_clause("closed", 1)[0]
    ('{0} is next to {1}', 'the colour of {0} is {1}', '{0} is closed')
    """
    words = name.split("_")
    said = " ".join(words)
    rest = [f"{{{number}}}" for number in range(1, arity)]
    if words[0] == "is" and len(words) > 1:
        return _is("{0}" if arity else "it", words[1:] + rest)
    if arity and _is_verb(words[0]):
        verb = " ".join(["{0}", *words, *rest])
        return verb, " ".join(["{0} does not", base_form(words[0]), *words[1:], *rest])
    if arity == 1 and words[-1] in PREPOSITIONS:
        return _is(" ".join(words[:-1]) or "it", [words[-1], "{0}"])
    if arity == 2 and words[-1] not in PREPOSITIONS:
        return _is(f"the {said} of {{0}}", rest)
    return _is("{0}" if arity else "it", [*words, *rest])


def base_form(verb: str) -> str:
    """Return a regular verb of the third person without its ending.

    Examples
    --------
    >>> base_form("holds"), base_form("carries"), base_form("reaches"), base_form("moved")
    ('hold', 'carry', 'reach', 'moved')
    >>> base_form("has")
    'have'
    """
    if verb == "has":
        return "have"
    if verb.endswith("ies"):
        return f"{verb[:-3]}y"
    if verb.endswith(("sses", "ches", "shes", "xes", "oes")):
        return verb[:-2]
    return verb[:-1] if verb.endswith("s") and not verb.endswith("ss") else verb


def past(clause: str) -> str:
    """Put a clause into the past tense, as far as its verb is known.

    Examples
    --------
    >>> past("the kitchen is closed")
    'the kitchen was closed'
    """
    words = clause.split(" ")
    place = verb_place(words, _PAST)
    if place is None:
        return clause
    return " ".join([*words[:place], _PAST[words[place]], *words[place + 1 :]])


def verb_place(words: Sequence[str], verbs: Collection[str]) -> int | None:
    """Return the place of the first of some verbs in a clause; a noun of its spelling is none.

    Examples
    --------
    >>> verb_place("the can of me is empty".split(), {"is", "can"})
    4
    >>> verb_place("the robot can lift it".split(), {"is", "can"})
    2
    """
    for place, word in enumerate(words):
        if word in verbs and not (word in _NOUNS_TOO and _is_noun(words, place)):
            return place
    return None


def _is_noun(words: Sequence[str], place: int) -> bool:
    """Whether a word stands where nouns do: behind an article, or in front of a verb."""
    after = words[place + 1] if place + 1 < len(words) else ""
    before = words[place - 1] if place else ""
    return before in _DETERMINERS or after in {*_PAST, *PREPOSITIONS, *_NOUNS_TOO, ""}


def past_clause(clause: str) -> str:
    """Put a clause with slots into the past tense, whatever its verb.

    Examples
    --------
    >>> past_clause("{0} holds {1}"), past_clause("{0} leads to {1}"), past_clause("{0} is lit")
    ('{0} held {1}', '{0} led to {1}', '{0} was lit')
    """
    said = past(clause)
    found = _VERB.match(clause)
    if said != clause or found is None or not _is_verb(found.group(2)):
        return said
    return f"{found.group(1)} {past_form(base_form(found.group(2)))}{clause[found.end() :]}"


def past_form(verb: str) -> str:
    """Return a verb, without ending, in the past tense.

    Examples
    --------
    >>> past_form("press"), past_form("move"), past_form("carry"), past_form("give")
    ('pressed', 'moved', 'carried', 'gave')
    """
    regular = f"{verb[:-1]}ied" if re.search("[^aeiou]y$", verb) else f"{verb.removesuffix('e')}ed"
    return _IRREGULAR.get(verb, regular)


def _is(subject: str, words: list[str]) -> tuple[str, str]:
    predicate = " ".join(words)
    return f"{subject} is {predicate}", f"{subject} is not {predicate}"


def _is_verb(word: str) -> bool:
    return word.endswith("s") and len(word) > 2 and not word.endswith(_NO_VERBS)
