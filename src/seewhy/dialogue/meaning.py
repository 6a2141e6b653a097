"""What the readings of a question by the grammar mean."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from importlib import resources
from typing import Any

from seewhy.dialogue.asked import Asks, Question, Statement
from seewhy.dialogue.grammar import Binding, Chart, Fold, Form, Grammar, parse_form, words_of_form
from seewhy.dialogue.lexicon import Normalise, lexicon_of, words_in
from seewhy.dialogue.question_words import words_of
from seewhy.domain.domain import Domain

__all__ = ["Readings", "aside_phrases", "grammar_words"]


@dataclass(frozen=True)
class _Said:
    """A statement as it was said, and whether it was denied."""

    statement: Statement
    denied: bool = False
    forward: bool = False
    """Whether the "not" stands before the subject ("isn't it …"), which asks the same."""
    named: bool = False
    """Whether it was only named, and what is said of it follows."""


_STATEMENTS = (
    "stated", "asserted", "left", "because", "making", "because_bare", "opposed", "supposed",
    "supposed_more", "equipment", "unequipped", "other_one", "surely", "located", "group_state",
    "goal", "avoided", "one_value", "first_existing", "existing_too", "deny_one", "deny_other",
    "pair_rest", "lacking", "pair_two", "fragment_named", "possessed", "dispossessed",
    "supposed_kind", "first_doing", "other_doing", "denied_too", "other_class",
)  # fmt: skip


_ROLES: dict[str, Fold] = {
    name: lambda _, role=role: ((Binding(role, True),),)  # type: ignore[misc]
    for name, role in {
        "not": "denied", "none": "denied", "without": "denied", "not_longer": "denied",
        "gone": "denied", "taking": "denied", "put_back": "denied", "back": "denied",
        "free_of": "denied", "fore": "forward",
    }.items()
}  # fmt: skip


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
            phrases=_phrases(),
            lexicon={name: entry.at for name, entry in self.entries.items()},
            folds={
                **dict.fromkeys(_STATEMENTS, self._fold),
                **_ROLES,
                "existing_named": self._fold_named,
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
                    for question in mean(self, bindings):
                        found.setdefault(question.query, question)
            if found:
                return self._best(list(found.values()))
        return []

    def is_opening(self, words: Sequence[str]) -> bool:
        """Whether words only lead to a question, as "can you tell me" does."""
        return not words or bool(Chart(self._grammar, words).whole(_phrase("intro")))

    def _best(self, found: list[Question]) -> list[Question]:
        """Of several readings those that explain most: a class before a value."""
        classes = [
            question
            for question in found
            if question.label or (question.statements and question.statements[0].label)
        ]
        meant = [question for question in found if self._named_plainly(question)]
        return classes or meant or found

    def _named_plainly(self, question: Question) -> bool:
        """Whether the values it names go by their words alone, as the domain's templates say."""
        named = {question.feature, *(statement.feature for statement in question.statements)} - {
            None
        }
        return named <= self._plain

    def _fold(self, bindings: tuple[Binding, ...]) -> Iterable[tuple[Binding, ...]]:
        """What is stated by a phrase, where its parts go together."""
        said = self._said(bindings)
        rest = tuple(
            binding
            for binding in bindings
            if binding.role in ("feature", "group", "said", "counts")
        )
        if said is None:
            return
        if said == ():
            if any(binding.role in ("fact", "label", "about") for binding in bindings):
                return
            yield rest
            return
        kept = tuple(binding for binding in bindings if binding.role == "said")
        yield (*kept, *(Binding("said", clause) for clause in said))

    def _fold_named(self, bindings: tuple[Binding, ...]) -> Iterable[tuple[Binding, ...]]:
        """What is named first of two things of which the same is said."""
        for said in self._said(bindings) or ():
            yield (Binding("said", replace(said, named=True)),)

    def _said(self, bindings: tuple[Binding, ...]) -> tuple[_Said, ...] | None:
        """The one statement of a phrase; () where it states nothing, None where it is none."""
        facts = [binding.meaning for binding in bindings if binding.role == "fact"]
        labels = list(
            dict.fromkeys(binding.meaning for binding in bindings if binding.role == "label")
        )
        about = {binding.meaning for binding in bindings if binding.role in ("feature", "about")}
        denied = sum(binding.role == "denied" for binding in bindings) % 2 == 1
        forward = any(binding.role == "forward" for binding in bindings)
        if not facts and not labels:
            return ()
        if len(facts) + len(labels) > 1:
            return None
        if labels:
            if about:
                return None
            return (_Said(Statement(label=str(labels[0])), denied, forward),)
        stated = _stated(facts[0])
        if about - {stated.feature}:
            return None
        return (_Said(stated, denied, forward),)

    # What the phrases mean ------------------------------------------------------------------

    def polar(self, bindings: tuple[Binding, ...]) -> Iterator[Question]:
        """Whether one thing is so."""
        for said in _all_said(bindings)[:1]:
            turned = self._turned(said) if said.denied else said.statement
            if said.denied and turned == said.statement:
                # "Is it not brown?" of many colours: which it is answers it, whatever is meant.
                yield (
                    _question(Asks.CLASS)
                    if turned.label
                    else _question(Asks.FEATURE_VALUE, feature=turned.feature)
                )
            else:
                yield self._is(turned)

    def joined(self, bindings: tuple[Binding, ...], asks: Asks) -> Iterator[Question]:
        """Whether several things are so, or one of them."""
        said = [
            self._turned(spoken) if spoken.denied else spoken.statement
            for spoken in _all_said(bindings)
        ]
        if len(set(said)) < 2:
            return
        features = {clause.feature for clause in said}
        if asks is Asks.EITHER and len(features) == 1:
            feature = said[0].feature
            yield (
                _question(Asks.CLASS)
                if feature is None
                else _question(Asks.FEATURE_VALUE, feature=feature)
            )
            return
        if asks is Asks.ALL and len(features) < len(said):
            return
        yield _question(asks, statements=tuple(said))

    def neither(self, bindings: tuple[Binding, ...]) -> Iterator[Question]:
        """Whether none of two things is so."""
        denied = [replace(spoken, denied=not spoken.denied) for spoken in _all_said(bindings)]
        yield from self.joined(tuple(Binding("said", binding) for binding in denied), Asks.ALL)

    def why(self, bindings: tuple[Binding, ...], *, denied: bool = False) -> Iterator[Question]:
        """Why something is so, or is not."""
        for spoken in _all_said(bindings)[:1]:
            statement = spoken.statement
            if spoken.denied or spoken.forward or denied:
                asks = Asks.WHY_NOT_CLASS if statement.label else Asks.WHY_NOT_VALUE
            else:
                asks = Asks.WHY_CLASS if statement.label else Asks.WHY_VALUE
            yield _about(asks, statement)

    def contrast(self, bindings: tuple[Binding, ...]) -> Iterator[Question]:
        """Why one class or value rather than another."""
        said = _all_said(bindings)
        if len(said) != 2 or said[0].denied or said[0].statement == said[1].statement:
            return
        first, other = said[0].statement, said[1].statement
        if first.feature == other.feature:
            yield _question(Asks.CONTRAST, statements=(first, other))

    def supposing(self, bindings: tuple[Binding, ...]) -> Iterator[Question]:
        """What would be if some features were different."""
        parts: list[Statement] = []
        said = _all_said(bindings)
        if any(clause.named for clause in said):
            said = [replace(clause, denied=said[-1].denied, named=False) for clause in said]
        for clause in said:
            statement = clause.statement
            if statement.label is not None:
                return
            if clause.denied or clause.forward:
                opposite = self._turned(clause)
                if opposite == statement:
                    return
                statement = opposite
            parts.append(statement)
        if parts and len({part.feature for part in parts}) == len(parts):
            yield _question(Asks.WHAT_IF, statements=tuple(parts))

    def change(self, bindings: tuple[Binding, ...], *, away: bool = False) -> Iterator[Question]:
        """What would have to change for a class, or so that it is none."""
        goals = [binding for binding in bindings if binding.role == "said"]
        if len(goals) != 1:
            return
        said = goals[0].meaning
        assert isinstance(said, _Said)
        label = said.statement.label
        if label is None:
            return
        if away:
            others = [key for key in self.domain.classes if key != label]
            if len(others) != 1:
                return
            label = others[0]
        yield _question(Asks.CHANGE_TO_CLASS, label=label)

    def difference(self, bindings: tuple[Binding, ...]) -> Iterator[Question]:
        """What tells what is shown from a class."""
        for spoken in _all_said(bindings)[:1]:
            yield _question(Asks.DIFFERENCE_TO_CLASS, label=spoken.statement.label)

    def sure(self, bindings: tuple[Binding, ...]) -> Iterator[Question]:
        """How sure something is."""
        for spoken in _all_said(bindings)[:1]:
            statement = spoken.statement
            if statement.label is not None:
                yield _question(Asks.HOW_SURE, label=statement.label)
            else:
                yield _question(Asks.HOW_SURE, feature=statement.feature)
            return
        features = _roles(bindings, "feature")
        yield from (_question(Asks.HOW_SURE, feature=feature) for feature in features[:1])

    def where(self, bindings: tuple[Binding, ...]) -> Iterator[Question]:
        """Where something is seen."""
        for spoken in _all_said(bindings)[:1]:
            statement = spoken.statement
            if statement.label is not None:
                yield _question(Asks.WHERE, label=statement.label)
            else:
                yield _question(Asks.WHERE, feature=statement.feature, value=statement.value)
            return
        for feature in _roles(bindings, "feature")[:1]:
            values = self.domain.features[feature].values
            yield _question(Asks.WHERE, feature=feature, value="yes" if "yes" in values else None)

    def value(self, bindings: tuple[Binding, ...]) -> Iterator[Question]:
        """Which value a feature has."""
        features = dict.fromkeys(_roles(bindings, "feature"))
        if len(features) != 1:
            return
        feature = next(iter(features))
        facts = [binding.meaning for binding in bindings if binding.role == "fact"]
        if all(_stated(fact).feature == feature for fact in facts):
            yield _question(Asks.FEATURE_VALUE, feature=feature)

    def choice(self, bindings: tuple[Binding, ...]) -> Iterator[Question]:
        """Which of the values that are named."""
        said = [spoken.statement for spoken in _all_said(bindings)]
        facts = [binding.meaning for binding in bindings if binding.role == "fact"]
        said += map(_stated, facts)
        about = set(_roles(bindings, "feature"))
        if len(set(said)) < 2:
            return
        features = {clause.feature for clause in said}
        if len(features) == 1 and None not in features and not about - features:
            yield _question(Asks.FEATURE_VALUE, feature=said[0].feature)

    def grouped(self, bindings: tuple[Binding, ...], asks: Asks) -> Iterator[Question]:
        """Which features of a group have a value, or how many."""
        groups = [binding.meaning for binding in bindings if binding.role == "group"]
        said = _all_said(bindings)
        for group in groups[:1]:
            assert isinstance(group, tuple)
            for clause in said:
                if clause.statement.feature in group and clause.statement.value is not None:
                    yield _question(asks, value=clause.statement.value, group=group)
                    return

    def whether_or_not(self, bindings: tuple[Binding, ...]) -> Iterator[Question]:
        """Whether something is so or not: its value is asked for."""
        for said in _all_said(bindings)[:1]:
            if said.statement.feature is None:
                yield self._is(said.statement)
            else:
                yield _question(Asks.FEATURE_VALUE, feature=said.statement.feature)

    def anybody(self, *, nobody: bool) -> Iterator[Question]:
        """Whether somebody is to be seen, or nobody."""
        for question in self.persons():
            value = "no" if nobody else "yes"
            statements = tuple(Statement(feature=key, value=value) for key in question.group)
            yield _question(Asks.ALL if nobody else Asks.EITHER, statements=statements)

    def persons(self) -> Iterator[Question]:
        """Who is to be seen."""
        persons = self.entries["person"].by_first
        features = tuple(
            _stated(bindings[0].meaning).feature
            for person in persons.values()
            for _, bindings in person
        )
        if features:
            yield _question(Asks.DESCRIBE, group=features)

    def told(self, bindings: tuple[Binding, ...]) -> Iterator[Question]:
        """What follows from the picture for somebody."""
        keys = _roles(bindings, "belief") or [
            key for key, belief in self.domain.beliefs.items() if belief.acts
        ]
        yield from (_question(Asks.BELIEF_VALUE, predicate=key) for key in keys[:1])

    def _is(self, statement: Statement) -> Question:
        return _about(Asks.IS_CLASS if statement.label else Asks.FEATURE_IS, statement)

    def _turned(self, said: _Said) -> Statement:
        """The opposite of a statement, where there is one; else the statement."""
        own = said.statement
        if own.label is not None:
            others = [key for key in self.domain.classes if key != own.label]
            return Statement(label=others[0]) if len(others) == 1 else own
        others = [v for v in self.domain.features[own.feature or ""].values if v != own.value]
        return replace(own, value=others[0]) if len(others) == 1 else own


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


def _question(asks: Asks, **about: Any) -> Question:
    return Question(asks=asks, text="", words=(), **about)


def _stated(fact: object) -> Statement:
    """The statement that a word of the lexicon stands for."""
    assert isinstance(fact, tuple)
    feature, value = fact
    return Statement(feature=feature, value=value)


def _about(asks: Asks, statement: Statement) -> Question:
    return _question(asks, label=statement.label, feature=statement.feature, value=statement.value)


def _all_said(bindings: Iterable[Binding]) -> list[_Said]:
    return [binding.meaning for binding in bindings if isinstance(binding.meaning, _Said)]


def _roles(bindings: Iterable[Binding], role: str) -> list[str]:
    return [str(binding.meaning) for binding in bindings if binding.role == role]


def _phrase(name: str) -> Form:
    return Form("phrase", name)


Meaning = Callable[[Readings, tuple[Binding, ...]], Iterator[Question]]


def _plain(asks: Asks) -> Meaning:
    return lambda _readings, _bindings: iter((_question(asks),))


_RANKS: tuple[tuple[tuple[str, Meaning], ...], ...] = (
    (
        ("explain_it", _plain(Asks.EXPLAIN)),
        ("how_sure", _plain(Asks.HOW_SURE)),
        ("which_rule", _plain(Asks.WHICH_RULE)),
        ("to_check", _plain(Asks.WHAT_TO_CHECK)),
        ("similar", _plain(Asks.SIMILAR)),
    ),
    (
        ("what_told", Readings.told),
        ("who", lambda r, _: r.persons()),
        ("anybody", lambda r, _: r.anybody(nobody=False)),
        ("nobody", lambda r, _: r.anybody(nobody=True)),
        ("whether_or_not", Readings.whether_or_not),
        ("how_many_of_them", lambda r, b: r.grouped(b, Asks.HOW_MANY)),
        ("which_of_them", lambda r, b: r.grouped(b, Asks.WHICH)),
        ("how_many_there", Readings.value),
    ),
    (
        ("what_change", Readings.change),
        ("what_change_away", lambda r, b: r.change(b, away=True)),
        ("difference", Readings.difference),
        ("contrast", Readings.contrast),
        ("why_not", lambda r, b: r.why(b, denied=True)),
        ("why", Readings.why),
        ("what_if", Readings.supposing),
        ("how_sure_that", Readings.sure),
        ("where", Readings.where),
    ),
    (
        ("which_class", _plain(Asks.CLASS)),
        ("choose_class", _plain(Asks.CLASS)),
        ("choose_value", Readings.choice),
    ),
    (("whether", Readings.polar),),
    (
        ("both", lambda r, b: r.joined(b, Asks.ALL)),
        ("either", lambda r, b: r.joined(b, Asks.EITHER)),
        ("neither", Readings.neither),
    ),
    (("which_value", Readings.value), ("which_static", Readings.told)),
    (("describe", _plain(Asks.DESCRIBE)),),
)
"""Phrases that are whole questions, and what they mean; an earlier rank is preferred."""


@cache
def _tables() -> dict[str, Any]:
    text = resources.files("seewhy.dialogue").joinpath("grammar.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)


@cache
def _phrases() -> dict[str, Form]:
    return {name: parse_form(text) for name, text in _tables()["phrases"].items()}


@cache
def aside_phrases() -> tuple[str, ...]:
    """Return the phrases that a question may have and that change nothing of what is asked."""
    return tuple(_tables()["aside"])


@cache
def grammar_words() -> frozenset[str]:
    """Return the words that stand in the grammar for themselves, as they are written there."""
    return frozenset(word for text in _tables()["phrases"].values() for word in words_of_form(text))
