"""The readings of a row of words by forms, in the order in which the forms prefer them.

The notation of forms is that of :mod:`seewhy.dialogue.grammar`. Its chart gives a set of readings;
here their order matters, since what is said of a thing belongs to the nearest one where it can.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from typing import NamedTuple

from seewhy.dialogue.grammar import Binding, Form
from seewhy.dialogue.inflection import lemma

__all__ = ["Chart", "Ending", "Forms", "Matcher"]

_MOST = 48
"""Readings of one phrase at one place."""


class Ending(NamedTuple):
    """Where a phrase ends, and what it contributes."""

    end: int
    bindings: tuple[Binding, ...]


Matcher = Callable[["Chart", int], Sequence[Ending]]
"""What finds the endings of a phrase that begins at a place."""
Fold = Callable[[tuple[Binding, ...]], tuple[Binding, ...] | None]
"""What the bindings inside of a phrase come to; None where they do not go together."""

_base = lru_cache(maxsize=16_384)(lemma)
_ANY = None
"""What may come first where a domain's own words do."""


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
    lexicon : mapping of str to Matcher
        The categories that a domain's words fill.
    folds : mapping of str to callable
        What the bindings of a phrase come to.
    """

    def __init__(
        self,
        phrases: Mapping[str, Form],
        lexicon: Mapping[str, Matcher],
        folds: Mapping[str, Fold],
    ) -> None:
        self._phrases = phrases
        self._lexicon = lexicon
        self._folds = folds
        self._firsts: dict[str, frozenset[str] | None] = {}
        self._matchers: dict[str, Matcher] = {}
        twice = sorted(phrases.keys() & lexicon.keys())
        if twice:
            raise ValueError(f"a phrase and a category must not share a name, got {twice}")
        for name in phrases:
            self._matchers[name] = self._phrase(name)

    def readings(self, chart: Chart, name: str) -> list[tuple[Binding, ...]]:
        """Return what a phrase contributes in each reading of all words by it."""
        end = len(chart.words)
        return [ending.bindings for ending in self._matchers[name](chart, 0) if ending.end == end]

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
        if form.kind == "word":
            return _word(form.text)
        if form.kind == "phrase":
            if form.text in self._lexicon:
                return self._lexicon[form.text]
            return self._later(form.text)
        parts = [self._matcher(part) for part in form.parts]
        if form.kind == "choice":
            return _choice([(self._first(part), m) for part, m in zip(form.parts, parts, strict=True)])
        return _sequence(parts)

    def _later(self, name: str) -> Matcher:
        matchers = self._matchers
        return lambda chart, at: matchers[name](chart, at)

    def _first(self, form: Form) -> frozenset[str] | None:
        """The words with which a form may begin; None where that is not known."""
        if form.kind == "word":
            return frozenset([form.text])
        if form.kind == "phrase":
            if form.text in self._lexicon:
                return _ANY
            if form.text not in self._firsts:
                self._firsts[form.text] = _ANY  # while it is looked for
                self._firsts[form.text] = self._first(self._phrases[form.text])
            return self._firsts[form.text]
        if form.kind == "choice":
            branches = [self._first(part) for part in form.parts]
            known = [branch for branch in branches if branch is not _ANY]
            return frozenset().union(*known) if len(known) == len(branches) else _ANY
        words: frozenset[str] = frozenset()
        for part in form.parts:
            first = self._first(part)
            if first is _ANY:
                return _ANY
            words |= first
            if not _may_be_empty(part):
                return words
        return _ANY


def _may_be_empty(form: Form) -> bool:
    if form.kind == "sequence":
        return all(map(_may_be_empty, form.parts))
    return form.kind == "choice" and any(map(_may_be_empty, form.parts))


def _word(text: str) -> Matcher:
    def match(chart: Chart, at: int) -> Sequence[Ending]:
        bases = chart.bases
        return (Ending(at + 1, ()),) if at < len(bases) and bases[at] == text else ()

    return match


def _choice(branches: Sequence[tuple[frozenset[str] | None, Matcher]]) -> Matcher:
    def match(chart: Chart, at: int) -> Sequence[Ending]:
        word = chart.bases[at] if at < len(chart.bases) else ""
        found: list[Ending] = []
        for first, branch in branches:
            if first is _ANY or word in first:
                found += branch(chart, at)
        return found

    return match


def _sequence(parts: Sequence[Matcher]) -> Matcher:
    def match(chart: Chart, at: int) -> Sequence[Ending]:
        found: Sequence[Ending] = (Ending(at, ()),)
        for part in parts:
            found = [
                Ending(more.end, before.bindings + more.bindings if more.bindings else before.bindings)
                for before in found
                for more in part(chart, before.end)
            ]
            if not found:
                return ()
        return found

    return match
