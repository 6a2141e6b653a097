"""The readings of a row of words by forms, in the order in which the forms prefer them.

The notation of forms is that of :mod:`seewhy.dialogue.grammar`. Its chart gives a set of readings;
here their order matters, since what is said of a thing belongs to the nearest one where it can.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from typing import NamedTuple, Protocol

from seewhy.dialogue.grammar import Binding, Form
from seewhy.dialogue.inflection import lemma

__all__ = ["Category", "Chart", "Ending", "Fold", "Forms"]

_MOST = 48
"""Readings of one phrase at one place."""
_MOST_WORDS = 10_000
"""Words of which it is kept which forms may begin with them."""


class Ending(NamedTuple):
    """Where a phrase ends, and what it contributes."""

    end: int
    bindings: tuple[Binding, ...]


Matcher = Callable[["Chart", int], Sequence[Ending]]
"""What finds the endings of a phrase that begins at a place."""
Fold = Callable[[tuple[Binding, ...]], tuple[Binding, ...] | None]
"""What the bindings inside of a phrase come to; None where they do not go together."""

_base = lru_cache(maxsize=16_384)(lemma)


class Category(Protocol):
    """Phrases that a domain's words make."""

    @property
    def first_words(self) -> frozenset[str]:
        """The words with which they begin."""

    def __call__(self, chart: Chart, at: int) -> Sequence[Ending]:
        """Return those that begin at a place."""


class Chart:
    """One row of words, with what has been found in it.

    ``antecedent`` is what "it" refers to: whatever the domain's words mean by it.
    """

    def __init__(self, words: Sequence[str], antecedent: object = None) -> None:
        self.words = tuple(words)
        self.bases = tuple([_base(word) for word in words])
        self.antecedent = antecedent
        self.found: dict[tuple[str, int], Sequence[Ending]] = {}


class Forms:
    """Forms made ready to be matched.

    Parameters
    ----------
    phrases : mapping of str to Form
    lexicon : mapping of str to Category
        The categories that a domain's words fill.
    folds : mapping of str to callable
        What the bindings of a phrase come to.
    """

    def __init__(
        self,
        phrases: Mapping[str, Form],
        lexicon: Mapping[str, Category],
        folds: Mapping[str, Fold],
    ) -> None:
        self._phrases = phrases
        self._lexicon = lexicon
        self._folds = folds
        self._firsts: dict[str, frozenset[str]] = {}
        self._matchers: dict[str, Matcher] = {}
        twice = sorted(phrases.keys() & lexicon.keys())
        if twice:
            raise ValueError(f"a phrase and a category must not share a name, got {twice}")
        for name in phrases:
            self._matchers[name] = self._phrase(name)

    def readings(self, chart: Chart, name: str) -> list[tuple[Binding, ...]]:
        """Return what a phrase contributes in each reading of all words by it."""
        end = len(chart.words)
        if not self.may_begin(chart, 0, name):
            return []
        return [ending.bindings for ending in self._matchers[name](chart, 0) if ending.end == end]

    def beginnings(self, chart: Chart, name: str) -> Sequence[Ending]:
        """Return where a phrase that begins with the first word may end, and what it means."""
        return self._matchers[name](chart, 0) if self.may_begin(chart, 0, name) else ()

    def may_begin(self, chart: Chart, at: int, name: str) -> bool:
        """Whether a phrase may begin with the word at a place."""
        first = self._first(Form("phrase", name))
        return chart.bases[at] in first or chart.words[at] in first

    def _phrase(self, name: str) -> Matcher:
        inside = self._matcher(self._phrases[name])
        fold = self._folds.get(name)

        def match(chart: Chart, at: int) -> Sequence[Ending]:
            key = (name, at)
            known = chart.found.get(key)
            if known is not None:
                return known
            chart.found[key] = ()  # a phrase that begins with itself
            endings = inside(chart, at)
            if fold is not None:
                folded = [(ending.end, fold(ending.bindings)) for ending in endings]
                endings = [Ending(end, made) for end, made in folded if made is not None]
            endings = endings[:_MOST]
            chart.found[key] = endings
            return endings

        return match

    def _matcher(self, form: Form) -> Matcher:
        words = self._words(form)
        if words is not None:
            return _one_of(words)
        if form.kind == "phrase":
            if form.text in self._lexicon:
                return self._lexicon[form.text]
            return self._later(form.text)
        if form.kind == "choice":
            return _choice(
                [
                    (frozenset() if _may_be_empty(part) else self._first(part), self._matcher(part))
                    for part in form.parts
                ]
            )
        return _sequence([self._matcher(part) for part in form.parts])

    def _words(self, form: Form) -> frozenset[str] | None:
        """The words of a form that is one word or another, and means nothing; else None."""
        if form.kind == "word":
            return frozenset([form.text])
        if form.kind == "phrase":
            if form.text in self._lexicon or form.text in self._folds:
                return None
            return self._words(self._phrases[form.text]) if form.text in self._phrases else None
        if form.kind == "sequence":
            return self._words(form.parts[0]) if len(form.parts) == 1 else None
        words: frozenset[str] = frozenset()
        for part in form.parts:
            branch = self._words(part)
            if branch is None:
                return None
            words |= branch
        return words

    def _later(self, name: str) -> Matcher:
        """A phrase that may not be made ready yet, looked for only where it may begin."""
        matchers = self._matchers
        first = self._first(self._phrases[name])

        def match(chart: Chart, at: int) -> Sequence[Ending]:
            if at >= len(chart.words) or (
                chart.bases[at] not in first and chart.words[at] not in first
            ):
                return ()
            return matchers[name](chart, at)

        return match

    def _first(self, form: Form) -> frozenset[str]:
        """The words with which a form may begin, where it does not come to no words at all."""
        if form.kind == "word":
            return frozenset([form.text])
        if form.kind == "phrase":
            if form.text in self._lexicon:
                return self._lexicon[form.text].first_words
            known = self._firsts.get(form.text)
            if known is None:
                self._firsts[form.text] = frozenset()  # a phrase that begins with itself
                known = self._firsts[form.text] = self._first(self._phrases[form.text])
            return known
        words: frozenset[str] = frozenset()
        for part in form.parts:
            words |= self._first(part)
            if form.kind == "sequence" and not _may_be_empty(part):
                break
        return words


def _may_be_empty(form: Form) -> bool:
    if form.kind == "sequence":
        return all(map(_may_be_empty, form.parts))
    return form.kind == "choice" and any(map(_may_be_empty, form.parts))


def _one_of(words: frozenset[str]) -> Matcher:
    def match(chart: Chart, at: int) -> Sequence[Ending]:
        bases = chart.bases
        return (Ending(at + 1, ()),) if at < len(bases) and bases[at] in words else ()

    return match


def _choice(branches: Sequence[tuple[frozenset[str], Matcher]]) -> Matcher:
    """One of several; which of them may begin with a word is looked up once a word.

    A branch of which no first words are told may come to no words at all.
    """
    of_word: dict[tuple[str, str], tuple[Matcher, ...]] = {}

    def match(chart: Chart, at: int) -> Sequence[Ending]:
        here = (chart.bases[at], chart.words[at]) if at < len(chart.words) else ("", "")
        matchers = of_word.get(here)
        if matchers is None:
            matchers = tuple(
                matcher for first, matcher in branches if not first or not first.isdisjoint(here)
            )
            if len(of_word) < _MOST_WORDS:
                of_word[here] = matchers
        if len(matchers) == 1:
            return matchers[0](chart, at)
        found: list[Ending] = []
        for matcher in matchers:
            found += matcher(chart, at)
        return found

    return match


def _sequence(parts: Sequence[Matcher]) -> Matcher:
    if not parts:
        return lambda _, at: (Ending(at, ()),)
    if len(parts) == 1:
        return parts[0]
    beginning, *others = parts

    def match(chart: Chart, at: int) -> Sequence[Ending]:
        found = beginning(chart, at)
        for part in others:
            if not found:
                return ()
            found = [
                Ending(more.end, before.bindings + more.bindings)
                for before in found
                for more in part(chart, before.end)
            ]
        return found

    return match
