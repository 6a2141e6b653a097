"""Questions about things, read by the grammar and a domain's words."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache
from importlib import resources
from itertools import islice
from typing import Any

from seewhy.dialogue.grammar import Binding, Form, parse_form, words_of_form
from seewhy.dialogue.question_words import words_of
from seewhy.dialogue.spelling import Spelling
from seewhy.dialogue.things.chart import Chart, Forms
from seewhy.dialogue.things.follow_up_forms import FOLLOW_UPS, FollowUp
from seewhy.dialogue.things.lexicon import lexicon_of, vocabulary_of
from seewhy.dialogue.things.phrases import PHRASES, meanings, settled
from seewhy.dialogue.things.query import Description, Query, Reference
from seewhy.dialogue.things.question_forms import QUESTIONS
from seewhy.domain.things import Things
from seewhy.errors import QuestionError

__all__ = ["QuestionReader", "Reading"]

LONGEST = 1000
"""Characters of a question."""
MOST_WORDS = 120
_MOST_READINGS = 12
_SENTENCES = re.compile(r"[.;:!?\n]+")
_POSSESSIVE = re.compile(
    r"(?<!\bwhat)(?<!\bit)(?<!\bthat)(?<!\bthere)(?<!\bwho)(?<!\bwhere)['’]s\b", re.I
)
_SUPPOSE = frozenset({"if", "when", "once", "without", "supposing", "suppose", "assuming"})
"""Words with which it begins what is supposed."""
_QUESTION_WORDS = frozenset({"how", "which", "what", "where", "why"})
_BEGIN_QUESTIONS = _QUESTION_WORDS | {
    "is", "are", "was", "were", "do", "does", "did", "has", "have", "would", "will", "could",
    "can", "might", "may", "describe",
}  # fmt: skip
_PRONOUNS = frozenset({"it", "its", "they", "them", "their"})


@dataclass(frozen=True)
class Reading:
    """One way to understand a question.

    ``query`` is what is asked; ``spoken_of`` is what "it" means in what follows.
    """

    query: Query | FollowUp
    spoken_of: Reference | None = None


class QuestionReader:
    """Reads questions about the things of a domain.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> reader = QuestionReader(load_domain("tabletop").things)
    >>> next(reader.readings("How many red blocks are there?")).query.described.conditions[0].value
    'red'
    """

    def __init__(self, things: Things) -> None:
        lexicon = lexicon_of(things)
        self._forms = Forms(_phrases(), lexicon, {**PHRASES, **QUESTIONS, **FOLLOW_UPS})
        self._spelling = Spelling(vocabulary_of(lexicon) | _words_of_grammar())
        self._one = things.one

    def readings(
        self, text: str, *, antecedent: Reference | None = None, answered: bool = False
    ) -> Iterator[Reading]:
        """Yield the ways to understand a question, the most natural first.

        Parameters
        ----------
        antecedent : Reference, optional
            What "it" means, from the question before.
        answered : bool
            Whether there is an answer that may be asked about: "why?".

        Raises
        ------
        QuestionError
            If it cannot be understood at all.
        """
        if len(text) > LONGEST:
            raise QuestionError(
                f"the question has {len(text):,} characters; ask in {LONGEST:,} at most"
            )
        sentences = [words_of(_POSSESSIVE.sub(" s", part)) for part in _SENTENCES.split(text)]
        sentences = [words for words in sentences if words]
        if not sentences:
            raise QuestionError("the question has no words; ask 'how many things are there?'")
        if sum(map(len, sentences)) > MOST_WORDS:
            raise QuestionError(f"the question has more than {MOST_WORDS} words; ask in fewer")
        found = False
        for reading in islice(self._in_turn(sentences, antecedent, answered), _MOST_READINGS):
            found = True
            yield reading
        if not found:
            for plain in self._plainly(sentences):
                for reading in islice(self._in_turn(plain, antecedent, answered), _MOST_READINGS):
                    found = True
                    yield reading
                if found:
                    return
        if not found:
            mended = [next(self._spelling.readings(words)).split() for words in sentences]
            for reading in islice(self._in_turn(mended, antecedent, answered), _MOST_READINGS):
                found = True
                yield reading
        if not found:
            raise self._not_understood(text, sentences, antecedent)

    def _plainly(self, sentences: list[list[str]]) -> Iterator[list[list[str]]]:
        """The same without what changes nothing: "isn't it still red?" asks whether it is red."""
        adverbs = _adverbs()
        fewer = [[word for word in words if word not in adverbs] for words in sentences]
        if fewer != sentences and all(fewer):
            yield fewer
        *before, last = fewer
        if len(last) > 2 and last[1] == "not" and last[0] != "why":
            yield [*before, [last[0], *last[2:]]]

    def references(self, text: str) -> Iterator[Reference]:
        """Yield what a phrase such as "the red cube on the ball" may refer to.

        Examples
        --------
        >>> from seewhy.domain.domain import load_domain
        >>> reader = QuestionReader(load_domain("tabletop").things)
        >>> [str(found.which) for found in reader.references("the red block")]
        ['the']
        """
        words = words_of(text)[:MOST_WORDS]
        if not words:
            return
        found = False
        for said in (words, next(self._spelling.readings(words)).split()):
            for reference in self._named(said, None):
                found = True
                yield reference
            if found:
                return

    def _in_turn(
        self, sentences: list[list[str]], antecedent: Reference | None, answered: bool
    ) -> Iterator[Reading]:
        """Read statements, each perhaps about the thing of the one before, and a question."""
        if len(sentences) == 1:
            yield from self._whole(sentences[0], antecedent, answered)
            return
        for stated in self._statements(sentences[0], antecedent):
            yield from self._in_turn(sentences[1:], stated, answered)

    def _whole(
        self, words: list[str], antecedent: Reference | None, answered: bool
    ) -> Iterator[Reading]:
        yield from self._asked(words, antecedent, answered)
        if words[:2] == ["there", "is"]:  # "there is a cube, what colour is it"
            for cut in range(len(words) - 1, 3, -1):
                if words[cut] not in _BEGIN_QUESTIONS:
                    continue
                for stated in self._statements(words[:cut], antecedent):
                    yield from self._asked(words[cut:], stated, answered)
        if words[0] == "the":  # "the second cube from the left, what colour is it"
            for cut in range(len(words) - 2, 1, -1):
                if words[cut] not in _BEGIN_QUESTIONS or _PRONOUNS.isdisjoint(words[cut:]):
                    continue
                for named in self._named(words[:cut], antecedent):
                    yield from self._asked(words[cut:], named, answered)

    def _named(self, words: list[str], antecedent: Reference | None) -> Iterator[Reference]:
        """The things that words may name."""
        for bindings in self._forms.readings(Chart(words, antecedent), "one"):
            for named in meanings(bindings, "one"):
                if isinstance(named, Reference):
                    yield named

    def _statements(self, words: list[str], antecedent: Reference | None) -> Iterator[Reference]:
        """The things that a statement may introduce: "there is a red cube", "the red cube"."""
        yield from self._named(words, antecedent)
        for bindings in self._forms.readings(Chart(words, antecedent), "statement"):
            for described in meanings(bindings, "described"):
                if isinstance(described, Description):
                    yield Reference(settled(described, antecedent))

    def _asked(
        self, words: list[str], antecedent: Reference | None, answered: bool
    ) -> Iterator[Reading]:
        for said in _without_asides(words):
            for of_them in _of_them(said, antecedent):
                for query in self._queries(Chart(of_them, antecedent)):
                    yield Reading(query, antecedent)
            chart = Chart(said, antecedent)
            for query in self._queries(chart):
                yield Reading(query, antecedent)
            if said[0] == "why" and len(said) > 1:
                yield from self._reasons_asked(said[1:], antecedent)
            yield from self._supposing(said, antecedent)
            tables = _tables()
            names = (*tables["openings"], *(tables["follow_ups"] if answered else ()))
            for name in names:
                for bindings in self._forms.readings(chart, name):
                    for asked in meanings(bindings, "follow_up"):
                        yield Reading(asked, antecedent)  # type: ignore[arg-type]

    def _supposing(self, words: list[str], antecedent: Reference | None) -> Iterator[Reading]:
        """Read what is supposed and what is asked of it: "if it were red, would it fall?"."""
        if words[0] in _SUPPOSE or words[1:2] == ["if"]:
            for ending in self._forms.beginnings(Chart(words, antecedent), "supposition"):
                yield from self._supposed(ending.bindings, words[ending.end :], antecedent)
        for at in range(2, len(words)):
            if words[at] in _SUPPOSE:
                for bindings in self._forms.readings(Chart(words[at:], antecedent), "supposition"):
                    yield from self._supposed(bindings, words[:at], antecedent)

    def _supposed(
        self, bindings: tuple[Binding, ...], words: list[str], antecedent: Reference | None
    ) -> Iterator[Reading]:
        for supposed in meanings(bindings, "follow_up"):
            if not words or not isinstance(supposed, FollowUp):
                continue
            # "It" is what was spoken of before, or the picture; else the thing that is supposed.
            for meant in (antecedent, supposed.instead):
                for said in _without_asides(words):
                    one = meant if isinstance(meant, Reference) else None
                    for query in self._queries(Chart(said, one)):
                        yield Reading(replace(supposed, query=query), antecedent)

    def _reasons_asked(self, words: list[str], antecedent: Reference | None) -> Iterator[Reading]:
        """Read what is asked why: "is the block clear", "does the block not fall"."""
        for query in self._queries(Chart(words, antecedent)):
            yield Reading(FollowUp("why", query=query), antecedent)
        if "not" in words and len(words) > 1:
            at = words.index("not")
            for query in self._queries(Chart([*words[:at], *words[at + 1 :]], antecedent)):
                yield Reading(FollowUp("why", wanted=False, query=query), antecedent)

    def _queries(self, chart: Chart) -> Iterator[Query]:
        for name in _tables()["questions"]:
            for bindings in self._forms.readings(chart, name):
                yield from meanings(bindings, "query")  # type: ignore[misc]

    def _not_understood(
        self, text: str, sentences: list[list[str]], antecedent: Reference | None
    ) -> QuestionError:
        words = {word for words in sentences for word in words}
        strange = [word for word in words if not self._spelling.knows(word)]
        if antecedent is None and words & _PRONOUNS:
            remedy = f"say which {self._one} is meant, as in 'there is …; what is it?'"
        elif strange:
            remedy = f"'{min(strange, key=text.casefold().find)}' is no word of the domain"
        elif _asks_twice(sentences):
            remedy = "ask one question at a time"
        else:
            remedy = "ask how many, which, what or whether there are"
        return QuestionError(f"I do not understand the question; {remedy}")


def _of_them(words: list[str], antecedent: Reference | None) -> Iterator[list[str]]:
    """ "How many are red?" behind "how many cubes are there?" asks of the cubes."""
    if antecedent is None or not antecedent.description.many:
        return
    for asked in (["how", "many"], ["which"]):
        size = len(asked)
        if words[:size] == asked and words[size : size + 1] in (["are"], ["is"]):
            yield [*asked, "of", "them", *words[size:]]


def _asks_twice(sentences: list[list[str]]) -> bool:
    """Whether there are two questions: "how many cubes, and how many balls?"."""
    words = [word for sentence in sentences for word in sentence]
    return any(
        word in _QUESTION_WORDS and at > 1 and words[at - 1] in ("and", "or", "there")
        for at, word in enumerate(words)
    )


def _without_asides(words: list[str]) -> Iterator[list[str]]:
    """The words, and where they begin or end with an aside, what is left without."""
    yield words
    for aside in _asides():
        size = len(aside)
        if len(words) > size and words[:size] == aside:
            yield from _without_asides(words[size:])
            return
        if len(words) > size and words[-size:] == aside:
            yield from _without_asides(words[:-size])
            return


@cache
def _tables() -> dict[str, Any]:
    file = resources.files("seewhy.dialogue.things").joinpath("grammar.toml")
    return tomllib.loads(file.read_text(encoding="utf-8"))


@cache
def _asides() -> tuple[list[str], ...]:
    return tuple(sorted((words_of(aside) for aside in _tables()["aside"]), key=len, reverse=True))


@cache
def _adverbs() -> frozenset[str]:
    return frozenset(_tables()["adverbs"])


@cache
def _phrases() -> dict[str, Form]:
    return {name: parse_form(form) for name, form in _written().items()}


def _written() -> dict[str, str]:
    return {
        name: form if isinstance(form, str) else "|".join(form)
        for name, form in _tables()["phrases"].items()
    }


@cache
def _words_of_grammar() -> frozenset[str]:
    return frozenset(word for form in _written().values() for word in words_of_form(form))
