"""What is asked back where a question is not understood: the nearest ones, of the same kind."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import cached_property

from rapidfuzz import fuzz, process

from seewhy.dialogue.asked import Asks, Query, Question, Statement
from seewhy.dialogue.inflection import lemma
from seewhy.dialogue.question_words import words_of
from seewhy.dialogue.saying_questions import PLAIN_WORDINGS, say_question
from seewhy.domain.domain import Domain

__all__ = ["Suggestions", "beyond_templates"]

_QUESTION_WORDS = ("why", "what", "which", "who", "where", "how", "when")
_WHETHER = "whether"
_IF = "if"
_SUPPOSING = re.compile(r"((what|how about|and) )?if\b|(suppos|imagin|assum)(e|ing)\b")
_ILL_SAID = re.compile(r"\b(one|1|single) \w+s\b|\bnone\b|\ba (not|[aeiou]\w*)\b")
"""What a template makes of a word that does not fit into it: "one blocks", "a unstable"."""
_LEAST_WORDS = 3
_NOT_TELLING = {
    "is", "are", "the", "a", "an", "it", "to", "of", "in", "on", "do", "does", "you", "i",
    "there", "for", "and", "be", "this", "that", "would",
}  # fmt: skip
_MOST = 3


class Suggestions:
    """Chooses questions that are near to one that is not understood.

    Those that ask with the same question word and deny as much as it does, about something that it
    names, come first; then those that deny as much about that; then those with the same question
    word.
    """

    def __init__(self, domain: Domain, questions: Sequence[Question]) -> None:
        self.domain = domain
        by_text = {
            question.text: question
            for question in questions
            if len(question.text.split()) >= _LEAST_WORDS and not _ILL_SAID.search(question.text)
        }
        for question in beyond_templates(domain):
            by_text.setdefault(say_question(domain, question), question)
        for asks, text in PLAIN_WORDINGS.items():
            if asks in (Asks.CLASS, Asks.EXPLAIN):
                continue
            by_text.setdefault(text, Question(asks, text, ()))
        self._by_kind: dict[tuple[str, bool], dict[str, Query]] = {}
        by_text = {
            text: question for text, question in by_text.items() if words_of(text).count("not") < 2
        }
        for text, question in by_text.items():
            self._by_kind.setdefault(_kind(text), {}).setdefault(text, question.query)
        self._all = {text: question.query for text, question in by_text.items()}

    def nearest(self, text: str) -> tuple[str, ...]:
        """Return at most three questions that are understood, the nearest first."""
        kind = _kind(text)
        same = self._by_kind.get(kind, {})
        as_denying = {
            wording: query
            for (asked, denies), pool in self._by_kind.items()
            if denies == kind[1] and (asked == _IF) is (kind[0] == _IF)
            for wording, query in pool.items()
        }
        chosen: dict[Query, str] = {}
        about = _about(text)
        for pool in (self._sharing(same, about), self._sharing(as_denying, about), same, self._all):
            if len(chosen) >= _MOST or (chosen and pool is self._all):
                break
            ranked = process.extract(text, list(pool), scorer=fuzz.token_set_ratio, limit=40)
            for found, _, _ in ranked:
                chosen.setdefault(pool[found], found)
        return tuple(f"{found}?" for found in list(chosen.values())[:_MOST])

    def _sharing(self, questions: dict[str, Query], about: frozenset[str]) -> dict[str, Query]:
        return {text: query for text, query in questions.items() if about & self._about[text]}

    @cached_property
    def _about(self) -> dict[str, frozenset[str]]:
        """What each wording is about; worked out at the first question that is not understood."""
        return {text: _about(text) for text in self._all}


def beyond_templates(domain: Domain) -> Iterator[Question]:
    """Questions of the kinds that no template words: where, what if, when."""
    for feature in domain.features.values():
        there = "yes" if "yes" in feature.values else None
        if not feature.name.startswith("number of"):
            yield Question(Asks.WHERE, "", (), feature=feature.key, value=there)
        for value in feature.values:
            supposed = (Statement(feature=feature.key, value=value),)
            yield Question(Asks.WHAT_IF, "", (), statements=supposed)
    for label in domain.classes:
        yield Question(Asks.WHEN_CLASS, "", (), label=label)


def _about(text: str) -> frozenset[str]:
    """The words that tell what a question is about."""
    return frozenset(map(lemma, set(words_of(text)) - _NOT_TELLING - set(_QUESTION_WORDS)))


def _kind(text: str) -> tuple[str, bool]:
    """The question word, and whether something is denied."""
    words = words_of(text)
    if _SUPPOSING.match(text):
        return _IF, "not" in words or "no" in words
    asked = next((word for word in words if word in _QUESTION_WORDS), _WHETHER)
    asked = "what" if asked == "which" else asked
    return asked, "not" in words or "no" in words
