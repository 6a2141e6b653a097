"""The readings of a question about one domain's pictures by the grammar, and which is preferred."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from seewhy.dialogue import meaning
from seewhy.dialogue.asked import Asks, Question
from seewhy.dialogue.grammar import Binding, Chart, Form, Grammar
from seewhy.dialogue.grammar_file import phrases
from seewhy.dialogue.lexicon import Normalise, lexicon_of, words_in
from seewhy.dialogue.question_words import words_of
from seewhy.dialogue.said import folds
from seewhy.domain.domain import Domain

__all__ = ["Readings"]


class Readings:
    """Reads questions about one domain's pictures by the grammar.

    Parameters
    ----------
    domain : Domain
    normalise : callable
        What the words of questions and of the domain go through alike.

    Examples
    --------
    >>> from seewhy.dialogue.question import Questions
    >>> from seewhy.domain.domain import load_domain
    >>> read = Questions(load_domain("structure_stability")).understand
    >>> read("what if the base were wide?").query
    ('what_if', None, None, None, 'base=wide')
    """

    def __init__(self, domain: Domain, normalise: Normalise) -> None:
        self.domain = domain
        self.entries = lexicon_of(domain, normalise)
        self._grammar = Grammar(
            phrases=phrases(),
            lexicon={name: entry.at for name, entry in self.entries.items()},
            folds=folds(),
            looked_up={
                name: entry.beginning
                for name, entry in self.entries.items()
                if entry.beginning is not None
            },
        )
        self._plain = _plainly_named(domain)
        self.words = frozenset(words_in(self.entries.values()))

    def read(self, words: Sequence[str]) -> list[Question]:
        """Return the questions that a row of normalised words may be, best first.

        Those that come from the same rank of rules are equally good; only the best rank is given.
        """
        chart = Chart(self._grammar, words)
        for rank in _RANKS:
            found: dict[tuple[str | None, ...], Question] = {}
            for phrase, mean in rank:
                for bindings in chart.whole(_phrase(phrase)):
                    for read in mean(self.domain, bindings):
                        question = meaning.of_static(self.domain, read)
                        if question is not None and self._can_be_stated(question):
                            found.setdefault(question.query, question)
            if found:
                best = self._best(list(found.values()))
                # Of what is supposed to be of a class nothing follows: it is asked back.
                return [read for read in best if read.asks is not Asks.WHAT_IF or not read.label]
        return []

    def _can_be_stated(self, question: Question) -> bool:
        """Whether every feature that is spoken of has the value that is said of it."""
        return all(
            statement.feature is None
            or statement.value in self.domain.features[statement.feature].values
            for statement in question.statements
        )

    def is_opening(self, words: Sequence[str]) -> bool:
        """Whether words only lead to a question, as "can you tell me" does."""
        return not words or bool(Chart(self._grammar, words).whole(_phrase("intro")))

    def _best(self, found: list[Question]) -> list[Question]:
        """Of several readings those that explain most: a class, a value, what follows."""
        classes = [
            question
            for question in found
            if question.asks is Asks.CLASS
            or question.label
            or (question.statements and question.statements[0].label)
        ]
        if classes:
            return classes
        found = [question for question in found if question.predicate is None] or found
        plain = [self._plainly_named_in(question) for question in found]
        return [
            question for question, count in zip(found, plain, strict=True) if count == max(plain)
        ]

    def _plainly_named_in(self, question: Question) -> int:
        """How many values it names go by their words alone, as the domain's templates say."""
        named = {question.feature, *(statement.feature for statement in question.statements)}
        return len(named & self._plain)


def _plainly_named(domain: Domain) -> set[str | None]:
    """Features whose values stand alone in a template, as in "is {it} {value}"."""
    return {
        table.feature
        for table in domain.questions.question
        if any(
            "{value}" in pattern and set(words_of(pattern)) <= _NAMES_NOTHING
            for pattern in table.patterns
        )
    }


_NAMES_NOTHING = {
    "is", "are", "it", "value", "does", "do", "show", "have", "there", "on", "in", "a", "can",
    "you", "see",
}  # fmt: skip


def _phrase(name: str) -> Form:
    return Form("phrase", name)


Meaning = Callable[[Domain, tuple[Binding, ...]], Iterator[Question]]


def _plain(asks: Asks) -> Meaning:
    return lambda _domain, _bindings: meaning.plain(asks)


def _grouped(asks: Asks) -> Meaning:
    return lambda domain, bindings: meaning.grouped(domain, bindings, asks)


def _joined(asks: Asks) -> Meaning:
    return lambda domain, bindings: meaning.joined(domain, bindings, asks)


_RANKS: tuple[tuple[tuple[str, Meaning], ...], ...] = (
    (
        ("explain_it", _plain(Asks.EXPLAIN)),
        ("how_sure", _plain(Asks.HOW_SURE)),
        ("which_rule", meaning.rule),
        ("to_check", _plain(Asks.WHAT_TO_CHECK)),
        ("similar", _plain(Asks.SIMILAR)),
        ("more", _plain(Asks.MORE)),
    ),
    (
        ("what_told", meaning.told),
        ("who", lambda domain, _: meaning.persons(domain)),
        ("anybody", lambda domain, _: meaning.anybody(domain, nobody=False)),
        ("nobody", lambda domain, _: meaning.anybody(domain, nobody=True)),
        ("whether_or_not", meaning.whether_or_not),
        ("how_many_of_them", _grouped(Asks.HOW_MANY)),
        ("which_of_them", _grouped(Asks.WHICH)),
        ("how_many_there", meaning.value),
        ("matters", meaning.matters),
        ("because_of", meaning.because),
        ("what_possible", meaning.possible),
    ),
    (
        ("when_class", meaning.when),
        ("what_change", meaning.change),
        ("what_change_away", lambda domain, bindings: meaning.change(domain, bindings, away=True)),
        ("difference", meaning.difference),
        ("contrast", meaning.contrast),
        ("contrast_turned", meaning.contrast_turned),
        ("why_not", lambda domain, bindings: meaning.why(domain, bindings, denied=True)),
        ("why", meaning.why),
        ("what_if", meaning.supposing),
        ("how_sure_that", meaning.sure),
        ("where", meaning.where),
    ),
    (
        ("which_class", _plain(Asks.CLASS)),
        ("choose_class", _plain(Asks.CLASS)),
        ("choose_value", meaning.choice),
    ),
    (("whether", meaning.polar), ("preferred", meaning.preferred)),
    (
        ("both", _joined(Asks.ALL)),
        ("either", _joined(Asks.EITHER)),
        ("neither", meaning.neither),
    ),
    (("which_value", meaning.value), ("which_static", meaning.told)),
    (("describe", _plain(Asks.DESCRIBE)), ("supposed_alone", meaning.supposing)),
)
"""Phrases that are whole questions, and what they mean; an earlier rank is preferred."""
