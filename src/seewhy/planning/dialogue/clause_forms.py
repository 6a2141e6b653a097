"""The forms of English that questions put a clause into: "is {0} in {1}", "where does {0} work".

A clause has slots for its things, ``{0}``, ``{1}`` and so on, as planning.toml writes them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from seewhy.planning.dialogue.speech import base

SLOT = re.compile(r"\{(\d+)\}")


def question_form(clause: str) -> str:
    """Turn a clause into a question.

    Examples
    --------
    >>> question_form("{0} is in {1}"), question_form("{0} holds {1}")
    ('is {0} in {1}', 'does {0} hold {1}')
    """
    words = clause.split()
    for place, word in enumerate(words):
        if word in ("is", "are", "can", "was"):
            return " ".join([word, *words[:place], *words[place + 1 :]])
    after = next((n for n, word in enumerate(words) if SLOT.fullmatch(word)), 0) + 1
    if after >= len(words):
        return f"is it so that {clause}"
    verb = "have" if words[after] == "has" else base(words[after])
    return " ".join(["does", *words[:after], verb, *words[after + 1 :]])


def gerund(do: str) -> str:
    """Return what is to be done as what somebody is doing; of regular verbs.

    Examples
    --------
    >>> gerund("move to {1}"), gerund("put {1} on {2}"), gerund("pick up {1}")
    ('moving to {1}', 'putting {1} on {2}', 'picking up {1}')
    """
    verb, *rest = do.split(" ")
    if verb.endswith("e") and not verb.endswith("ee"):
        verb = verb[:-1]
    elif re.fullmatch("[^aeiou]*[aeiou][^aeiouwxy]", verb):
        verb += verb[-1]
    return " ".join([f"{verb}ing", *rest])


def denies(clause: str) -> bool:
    """Whether a clause says that something is not so."""
    return re.search(r"\b(not|no)\b", clause) is not None


def with_not(clause: str) -> Iterator[str]:
    """Yield the question for a clause with "not" in it, which asks the same.

    Examples
    --------
    >>> list(with_not("{0} is in {1}"))
    ['is not {0} in {1}', 'is {0} not in {1}']
    """
    auxiliary, *rest = question_form(clause).split()
    for place in (0, 1):
        if place < len(rest):
            yield " ".join([auxiliary, *rest[:place], "not", *rest[place:]])


def without_first_words(do: str) -> str | None:
    """Return the last place of an action: "on {2}"; None where it names none.

    Examples
    --------
    >>> without_first_words("put {1} on {2}")
    'on {2}'
    """
    found = re.fullmatch(r".* ([a-z]+ \{\d+\})", do)
    return found.group(1) if found else None


def without_last_thing(do: str) -> str | None:
    """Return an action without the last thing that it is done to; None where there is but one.

    Examples
    --------
    >>> without_last_thing("deliver {1} to {2}")
    'deliver {1}'
    """
    found = re.fullmatch(r"(.*\{\d+\}) [a-z ]+ \{\d+\}", do)
    return found.group(1) if found else None
