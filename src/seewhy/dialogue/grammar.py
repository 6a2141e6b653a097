"""A phrase-structure grammar in a few signs, and what a row of words means by it.

In a form, a word stands for itself, ``<name>`` for a phrase of the grammar or a category of the
lexicon, ``[...]`` for what may be left out, ``(a|b)`` for a choice. Every word of a question has to
be used: what no form accounts for is not understood.

Source: memoised recursive descent over all readings at once, as in chart parsing; Norvig (1991),
"Techniques for automatic memoization with applications to context-free parsing".
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property
from typing import NamedTuple

from seewhy.dialogue.first_words import Beginning, beginnings_of
from seewhy.dialogue.inflection import lemma
from seewhy.errors import DomainError

__all__ = ["Binding", "Chart", "Form", "Grammar", "Match", "parse_form", "words_of_form"]

_SIGNS = re.compile(r"<[a-z_]+>|[\[\]()|]|[^\s\[\]()|<>]+")


class Binding(NamedTuple):
    """What a word or a phrase contributes to the meaning of what it stands in."""

    role: str
    meaning: object


class Match(NamedTuple):
    """Where a phrase ends, and what it contributes."""

    end: int
    bindings: tuple[Binding, ...]


@dataclass(frozen=True)
class Form:
    """A node of a form: a word, a phrase's name, a sequence or a choice."""

    kind: str
    text: str = ""
    parts: tuple[Form, ...] = ()


Lexicon = Mapping[str, Callable[[Sequence[str], int], Iterable[Match]]]
"""Category → the entries that begin at a position."""
Fold = Callable[[tuple[Binding, ...]], Iterable[tuple[Binding, ...]]]
"""What the bindings inside of a phrase come to; none where they do not go together."""


def parse_form(text: str) -> Form:
    """Return a form that is written down.

    Raises
    ------
    DomainError
        Where brackets do not pair.

    Examples
    --------
    >>> parse_form("is <it> [not] (red|blue)").parts[3].kind
    'choice'
    """
    signs = _SIGNS.findall(text)
    form, rest = _choice(signs, 0)
    if rest != len(signs):
        raise DomainError(f"the brackets of '{text}' do not pair")
    return form


def _choice(signs: Sequence[str], at: int) -> tuple[Form, int]:
    branches: list[Form] = []
    parts: list[Form] = []
    while at < len(signs) and signs[at] not in ("]", ")"):
        sign = signs[at]
        at += 1
        if sign == "|":
            branches.append(Form("sequence", parts=tuple(parts)))
            parts = []
        elif sign in ("[", "("):
            inner, at = _choice(signs, at)
            closing = "]" if sign == "[" else ")"
            if at >= len(signs) or signs[at] != closing:
                raise DomainError(f"the brackets of '{' '.join(signs)}' do not pair")
            at += 1
            parts.append(Form("choice", parts=(inner, _NOTHING)) if sign == "[" else inner)
        else:
            parts.append(_smallest(sign))
    branches.append(Form("sequence", parts=tuple(parts)))
    return (branches[0] if len(branches) == 1 else Form("choice", parts=tuple(branches))), at


_NOTHING = Form("sequence")


@cache
def _smallest(sign: str) -> Form:
    """A phrase's name or a word; ten thousand of a grammar's signs are a thousand words."""
    return Form("phrase", sign[1:-1]) if sign.startswith("<") else Form("word", lemma(sign))


def words_of_form(text: str) -> set[str]:
    """Return the words that stand in a form for themselves.

    Examples
    --------
    >>> sorted(words_of_form("is <it> [not] (red|blue)"))
    ['blue', 'is', 'not', 'red']
    """
    return {sign for sign in _SIGNS.findall(text) if sign[0] not in "<[]()|"}


@dataclass(frozen=True)
class Grammar:
    """Phrases by name.

    Attributes
    ----------
    phrases : dict of str to Form
    lexicon : dict of str to callable
        What is looked up instead, in the words of one domain.
    folds : dict of str to callable
        Phrases whose bindings come to something else.
    looked_up : dict of str to Beginning, optional
        How what is in the lexicon begins; what is not listed may begin with any word.
    """

    phrases: Mapping[str, Form]
    lexicon: Lexicon
    folds: Mapping[str, Fold]
    looked_up: Mapping[str, Beginning] = field(default_factory=dict)

    @cached_property
    def first_words(self) -> dict[int, frozenset[str]]:
        """Form, by its identity → the words with which it begins, where it has any."""
        return beginnings_of(self.phrases, {**dict.fromkeys(self.lexicon), **self.looked_up})


class Chart:
    """The readings of one row of words."""

    def __init__(self, grammar: Grammar, words: Sequence[str]) -> None:
        self.grammar = grammar
        self.words = tuple(words)
        self._first_words = grammar.first_words
        self._found: dict[tuple[str, int], frozenset[Match]] = {}
        self._open: set[tuple[str, int]] = set()

    def whole(self, form: Form) -> list[tuple[Binding, ...]]:
        """Return the bindings of every reading of all words by a form."""
        ends = self._match(form, 0)
        return [match.bindings for match in ends if match.end == len(self.words)]

    def _word_at(self, at: int) -> str | None:
        return self.words[at] if at < len(self.words) else None

    def _match(self, form: Form, at: int) -> set[Match]:
        first_words = self._first_words.get(id(form))
        if first_words is not None and self._word_at(at) not in first_words:
            return set()
        if form.kind == "word":
            here = at < len(self.words) and self.words[at] == form.text
            return {Match(at + 1, ())} if here else set()
        if form.kind == "phrase":
            return set(self._phrase(form.text, at))
        if form.kind == "choice":
            return {match for part in form.parts for match in self._match(part, at)}
        found = {Match(at, ())}
        for part in form.parts:
            found = {
                Match(more.end, (*match.bindings, *more.bindings))
                for match in found
                for more in self._match(part, match.end)
            }
            if not found:
                break
        return found

    def _phrase(self, name: str, at: int) -> frozenset[Match]:
        key = (name, at)
        if key in self._found:
            return self._found[key]
        if key in self._open:
            return frozenset()  # a phrase that begins with itself
        self._open.add(key)
        looked_up = self.grammar.lexicon.get(name)
        if looked_up is not None:
            found = frozenset(looked_up(self.words, at))
        else:
            found = frozenset(self._match(self.grammar.phrases[name], at))
            fold = self.grammar.folds.get(name)
            if fold is not None:
                found = frozenset(
                    Match(match.end, bindings)
                    for match in found
                    for bindings in fold(match.bindings)
                )
        self._open.discard(key)
        self._found[key] = found
        return found
