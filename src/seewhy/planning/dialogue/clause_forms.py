"""The forms of English that questions put a clause into: "is {0} in {1}", "where does {0} work".

A clause has slots for its things, ``{0}``, ``{1}`` and so on, as planning.toml writes them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from seewhy.planning.dialogue.surface_realisation import of_several
from seewhy.text.nouns import plural
from seewhy.text.predicate_words import base_form, verb_place

SLOT = re.compile(r"\{(\d+)\}")
_AUXILIARIES = ("is", "are", "can", "was", "would", "could", "will", "does")
_ARTICLES = {"a", "an", "the"}
_WHERE = {"in", "at", "on", "under", "behind", "near", "inside", "beside"}


def question_form(clause: str) -> str:
    """Turn a clause into a question.

    Examples
    --------
    >>> question_form("{0} is in {1}"), question_form("{0} holds {1}")
    ('is {0} in {1}', 'does {0} hold {1}')
    >>> question_form("{0} does not hold {1}")
    'does {0} not hold {1}'
    """
    words = clause.split()
    place = verb_place(words, _AUXILIARIES)
    if place is not None:
        return " ".join([words[place], *words[:place], *words[place + 1 :]])
    after = next((n for n, word in enumerate(words) if SLOT.fullmatch(word)), 0) + 1
    if after >= len(words):
        return f"is it so that {clause}"
    verb = base_form(words[after])
    return " ".join(["does", *words[:after], verb, *words[after + 1 :]])


def asking_for(clause: str, sorts: Sequence[str]) -> Iterator[tuple[int, str]]:
    """Yield the questions for one thing of a clause, each with the slot that it leaves open.

    Examples
    --------
    >>> for slot, question in asking_for("{0} works in {1}", ("person", "place")):
    ...     print(slot, question)
    0 what works in {1}
    0 who works in {1}
    0 which person works in {1}
    0 which persons work in {1}
    1 what does {0} work in
    1 who does {0} work in
    1 which place does {0} work in
    1 which places does {0} work in
    1 where does {0} work
    """
    words = clause.split()
    slots = [place for place, word in enumerate(words) if SLOT.fullmatch(word)]
    if not slots:
        return
    first, last = slots[0], slots[-1]
    begins = words[:2] == ["there", "is"]
    if set(words[2 * begins : first]) <= _ARTICLES:
        number = int(words[first][1:-1])
        rest = (["is"] if begins else []) + words[first + 1 :]
        for asked in _what(sorts[number]):
            agreeing = rest if asked != _what(sorts[number])[-1] else of_several(rest)
            yield number, " ".join([asked, *agreeing])
    if last == len(words) - 1 and last > first:
        number = int(words[last][1:-1])
        for text in _asking_for_the_end(words[:-1], sorts[number]):
            yield number, text
    elif last == len(words) - 1 and not set(words[:last]) <= _ARTICLES:
        number = int(words[last][1:-1])
        if words[last - 1] in _WHERE:
            yield number, f"where {question_form(' '.join(words[: last - 1]))}"


def _asking_for_the_end(words: list[str], sort: str) -> Iterator[str]:
    if words[-1] in ("is", "are"):
        yield " ".join(["what", words[-1], *words[:-1]])
        return
    asked = question_form(" ".join(words))
    for what in _what(sort):
        yield f"{what} {asked}"
    found = re.fullmatch(r"does (\{\d+\}) (\w+)", asked)
    if found and found.group(2) != "have":
        yield f"what is {found.group(1)} {gerund(found.group(2))}"
    if words[-1] in _WHERE:
        place = question_form(" ".join(words[:-1])).replace("is there ", "is ")
        yield f"where {place}"


def _what(sort: str) -> tuple[str, ...]:
    noun = sort.replace("_", " ")
    return "what", "who", f"which {noun}", f"which {plural(noun)}"


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
    for place in range(len(rest)):
        if place == 0 or SLOT.fullmatch(rest[place - 1]):
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
