"""A question in words becomes a query: a controlled vocabulary that forgives spelling."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import lru_cache
from itertools import islice, product, zip_longest

import snowballstemmer
from rapidfuzz import fuzz, process
from rapidfuzz.distance import DamerauLevenshtein

from seewhy.domain import Domain
from seewhy.domain_tables import QuestionTable
from seewhy.errors import DomainError, QuestionError
from seewhy.nearest import did_you_mean
from seewhy.question_words import CONTRACTIONS, words_of
from seewhy.slots import filled, wrong_slot
from seewhy.toml_file import lines_of_tables
from seewhy.visible import visible

LONGEST_QUESTION = 300
"""Characters; nothing in a controlled vocabulary is nearly as long."""
_MOST_READINGS = 256

MOST_OPTIONAL = 8
"""Parts of a pattern that may be left out: so many make 256 wordings."""

MOST_WORDINGS = 50_000
"""Of all questions of a domain; the largest that is bundled has a fifth."""


class Asks(StrEnum):
    """What a question asks for."""

    CLASS = "class"
    IS_CLASS = "is_class"
    WHY_CLASS = "why_class"
    WHY_NOT_CLASS = "why_not_class"
    CHANGE_TO_CLASS = "change_to_class"
    DIFFERENCE_TO_CLASS = "difference_to_class"
    BELIEF_VALUE = "belief_value"
    FEATURE_VALUE = "feature_value"
    FEATURE_IS = "feature_is"
    EXPLAIN = "explain"


_ABOUT_A_CLASS = {
    Asks.IS_CLASS, Asks.WHY_CLASS, Asks.WHY_NOT_CLASS, Asks.CHANGE_TO_CLASS,
    Asks.DIFFERENCE_TO_CLASS,
}  # fmt: skip
_ABOUT_A_FEATURE = {Asks.FEATURE_VALUE, Asks.FEATURE_IS}
_DROPPED = {"a", "an", "the", "any", "some"}
_SUBJECT = {"it", "this", "that", "these", "those"}
# Words that a question may have or lack without asking for anything else.
_LIGHT = {
    "is", "are", "be", "been", "being", "do", "does", "did", "it", "there", "here", "to", "of",
    "in", "on", "at", "for", "so", "then", "now", "really", "actually", "currently", "exactly",
    "would", "could", "can", "will", "should", "have", "has", "having", "you", "i", "me", "and",
    "picture", "image", "photo", "shown", "see", "all", "just", "about", "get", "that", "which",
    "with", "am", "was", "were", "need", "by", "also", "still",
}  # fmt: skip
_STEM = lru_cache(maxsize=16_384)(snowballstemmer.stemmer("english").stemWord)


Query = tuple[str, str | None, str | None, str | None]
"""What is asked, the class, the feature or static, and the value that it is about."""


@dataclass(frozen=True)
class Question:
    """A question that was understood.

    Attributes
    ----------
    asks : Asks
    text : str
        The question in the words of the domain's template.
    label, feature, value, predicate : str or None
        The class, the feature and the value, or the static that it is about.
    words : tuple of str
        Its normalised words, which the recurrent network reads.
    """

    asks: Asks
    text: str
    words: tuple[str, ...]
    label: str | None = None
    feature: str | None = None
    value: str | None = None
    predicate: str | None = None

    @property
    def query(self) -> Query:
        """What is asked, without the wording; equal for questions that mean the same."""
        return (self.asks.value, self.label, self.feature or self.predicate, self.value)


class Questions:
    """The questions that a domain's templates can ask.

    Raises
    ------
    DomainError
        Where a template names something that the domain does not have.

    Examples
    --------
    >>> from seewhy.domain import load_domain
    >>> questions = Questions(load_domain("structure_stability"))
    >>> questions.understand("WHAT makes this tower unstabel??").query
    ('why_class', 'unstable', None, None)
    """

    def __init__(self, domain: Domain) -> None:
        self.domain = domain
        _check_words(domain)
        self._subject = {_STEM(word) for word in (words_of(domain.subject)[-1], *_SUBJECT)}
        self._synonyms = self._read_synonyms()
        self._known: dict[tuple[str, ...], Question] = {}
        spelling: set[str] = set(CONTRACTIONS) | _LIGHT | _SUBJECT | _DROPPED
        for canonical, others in domain.questions.synonyms.items():
            spelling.update(word for phrase in (canonical, *others) for word in words_of(phrase))
        for question in self._expand(domain):
            spelling.update(words_of(question.text))
            self._known.setdefault(question.words, question)
        self._by_weighty: dict[frozenset[str], list[Question]] = {}
        for question in self._known.values():
            self._by_weighty.setdefault(_weighty(question.words), []).append(question)
        self._spelling = spelling
        self._stems = frozenset(map(_STEM, spelling))

    @property
    def all(self) -> tuple[Question, ...]:
        """Every distinct wording that is understood exactly."""
        return tuple(self._known.values())

    def one_of_each(self) -> tuple[Question, ...]:
        """The first wording of every distinct query, in the order of the templates."""
        first: dict[Query, Question] = {}
        for question in self._known.values():
            first.setdefault(question.query, question)
        return tuple(first.values())

    def understand(self, text: str) -> Question:
        """Return the query that a question in words asks for.

        Case, punctuation, word forms, the domain's synonyms and typing errors are forgiven.

        Raises
        ------
        QuestionError
            If the question is empty, too long or not understood; it names the nearest ones.
        """
        if not text.strip():
            raise QuestionError(
                f"the question is empty; {self._suggest(self._examples())}",
                nearest=self._examples(),
            )
        if len(text) > LONGEST_QUESTION:
            raise QuestionError(
                f"the question has {len(text)} characters, at most {LONGEST_QUESTION} are read; "
                f"{self._suggest(self._examples())}",
                nearest=self._examples(),
            )
        tokens = words_of(text)
        if not any(re.search("[a-z]", token) for token in tokens):
            raise QuestionError(
                f"'{' '.join(text.split())}' has no word in the vocabulary's alphabet; "
                f"{self._suggest(self._examples())}",
                nearest=self._examples(),
            )
        readings = self._readings(tokens)
        found = {
            question.query: question
            for words in map(self._normalise, readings)
            if (question := self._known.get(words) or self._loosely(words)) is not None
        }
        # A typing error that could be mended into two different questions is asked back.
        if len(found) != 1:
            nearest = tuple(f"{own.text}?" for own in found.values())
            nearest = nearest[:3] or self._nearest(readings[0])
            raise QuestionError(
                f"'{' '.join(text.split())}' is not understood; {self._suggest(nearest)}",
                nearest=nearest,
            )
        return next(iter(found.values()))

    def _loosely(self, words: tuple[str, ...]) -> Question | None:
        """The question with the same weighty words, whatever their order, if there is one."""
        weighty = _weighty(words)
        if not weighty:
            return None
        queries: dict[Query, Question] = {}
        best = -1.0
        for question in self._by_weighty.get(weighty, ()):
            # What a "not" denies is told by its place alone.
            if "not" in weighty and _after_not(words) != _after_not(question.words):
                continue
            score = fuzz.ratio(" ".join(words), " ".join(question.words))
            if score > best:
                best, queries = score, {question.query: question}
            elif score == best:
                queries.setdefault(question.query, question)
        return next(iter(queries.values())) if len(queries) == 1 else None

    def _readings(self, tokens: Sequence[str]) -> list[str]:
        """The texts that the words may stand for, with unknown words mended."""
        # A word is not mended into one that the question has already: "is the table stable".
        spellings = [
            [word for word in self._spellings(token) if word == token or word not in tokens]
            or [token]
            for token in tokens
        ]
        readings = product(*spellings)
        return [" ".join(words) for words in islice(readings, _MOST_READINGS)]

    def _spellings(self, token: str) -> list[str]:
        """The words of the vocabulary that are nearest to a word that nobody knows."""
        if token in self._spelling or len(token) < 4 or _STEM(token) in self._stems:
            return [token]
        allowed = 1 if len(token) < 7 else 2
        close = process.extract(
            token,
            sorted(word for word in self._spelling if word[0] == token[0] or len(word) > 4),
            scorer=DamerauLevenshtein.distance,
            score_cutoff=allowed,
            limit=None,
        )
        least = min((distance for _, distance, _ in close), default=0)
        return [word for word, distance, _ in close if distance == least] or [token]

    def _nearest(self, text: str) -> tuple[str, ...]:
        weighty = _weighty(self._normalise(text))
        alike = [q for q in self._known.values() if not weighty.isdisjoint(q.words)]
        texts = {question.text: question.query for question in alike or self._known.values()}
        ranked = process.extract(text, list(texts), scorer=fuzz.token_set_ratio, limit=40)
        chosen: dict[Query, str] = {}
        for found, _, _ in ranked:
            chosen.setdefault(texts[found], found)
        return tuple(f"{found}?" for found in list(chosen.values())[:3])

    def _examples(self) -> tuple[str, ...]:
        return tuple(f"{question.text}?" for question in self.one_of_each()[:3])

    @staticmethod
    def _suggest(questions: Sequence[str]) -> str:
        return "ask for instance: " + " · ".join(questions)

    def _read_synonyms(self) -> dict[str, list[tuple[tuple[str, ...], tuple[str, ...]]]]:
        """First stem → the phrases that begin with it and what they stand for, longest first."""
        pairs = [
            (tuple(map(_STEM, words_of(other))), tuple(map(_STEM, words_of(canonical))))
            for canonical, others in self.domain.questions.synonyms.items()
            for other in others
        ]
        fillers = [(tuple(map(_STEM, words_of(f))), ()) for f in self.domain.questions.fillers]
        by_first: dict[str, list[tuple[tuple[str, ...], tuple[str, ...]]]] = {}
        for pair in sorted([*pairs, *fillers], key=lambda pair: -len(pair[0])):
            by_first.setdefault(pair[0][0], []).append(pair)
        return by_first

    def _normalise(self, text: str) -> tuple[str, ...]:
        stems = [_STEM(token) for token in words_of(text) if token not in _DROPPED]
        position = 0
        while position < len(stems):
            for other, canonical in self._synonyms.get(stems[position], ()):
                if tuple(stems[position : position + len(other)]) == other:
                    stems[position : position + len(other)] = canonical
                    position += len(canonical) - 1
                    break
            position += 1
        words: list[str] = []
        for stem in stems:
            word = "it" if stem in self._subject else stem
            if not (word == "it" and words and words[-1] == "it"):
                words.append(word)
        return tuple(words)

    def _expand(self, domain: Domain) -> Iterator[Question]:
        path = domain.folder / "questions.toml"
        lines = lines_of_tables(path.read_text(encoding="utf-8-sig"), "question")
        told: list[tuple[QuestionTable, Asks, str, list[_Slot]]] = []
        wordings = 0
        for table, line in zip_longest(domain.questions.question, lines, fillvalue=1):
            if isinstance(table, int):
                break  # what looks like one more heading stands in a text
            place = f"{path}:{line}"
            asks = _check_table(table, domain, place)
            for pattern in table.patterns:
                _check_pattern(pattern, place)
                slots = _slots(table, asks, domain, pattern, place)
                told.append((table, asks, pattern, slots))
                wordings += len(slots) << pattern.count("[")
                if wordings > MOST_WORDINGS:
                    raise DomainError(
                        f"{place}: with '{visible(pattern)}' there are {wordings:,} wordings of "
                        f"questions, more than {MOST_WORDINGS:,}; leave out patterns or [...]"
                    )
        for table, asks, pattern, slots in told:
            for variant in _optional(pattern):
                for slot in slots:
                    word = slot.word
                    said = {"it": domain.subject, "class": word, "value": word}
                    text = filled(variant, said)
                    if "not not" in text:
                        continue  # a class that is worded as "not …" in a question with "not"
                    yield Question(
                        asks=asks,
                        text=" ".join(text.split()),
                        words=self._normalise(text),
                        label=slot.label,
                        feature=table.feature,
                        value=slot.value,
                        predicate=table.predicate,
                    )


def _check_pattern(pattern: str, place: str) -> None:
    """Raise a DomainError where a pattern has an unknown slot or brackets that do not pair."""
    if wrong_slot(pattern, ("it", "class", "value")) is not None:
        raise DomainError(
            f"{place}: '{pattern}' has a slot that does not exist; there are {{it}}, {{class}} and "
            "{value}"
        )
    brackets = "".join(re.findall(r"[\[\]]", pattern))
    if brackets.replace("[]", ""):
        raise DomainError(
            f"{place}: the brackets of '{pattern}' do not pair; [...] is what may be left out"
        )
    if len(brackets) > 2 * MOST_OPTIONAL:
        raise DomainError(
            f"{place}: '{visible(pattern)}' has {len(brackets) // 2} parts that may be left out, "
            f"more than {MOST_OPTIONAL}; write several patterns"
        )


def _check_words(domain: Domain) -> None:
    """Raise a DomainError where a subject, synonym or filler is not made of words."""
    if not words_of(domain.subject):
        raise DomainError(
            f"{domain.folder / 'domain.toml'}: subject = '{domain.subject}' has no word; "
            'write one such as "the apple"'
        )
    questions = domain.questions
    phrases = {f"synonyms of '{key}'": (key, *own) for key, own in questions.synonyms.items()}
    phrases["fillers"] = tuple(questions.fillers)
    for where, own in phrases.items():
        for phrase in own:
            if not words_of(phrase):
                raise DomainError(
                    f"{domain.folder / 'questions.toml'}: '{phrase}' in the {where} has no word; "
                    "remove it"
                )


_LIGHT_STEMS = frozenset(_STEM(word) for word in _LIGHT)


def _weighty(words: Sequence[str]) -> frozenset[str]:
    """The normalised words that tell what is asked."""
    return frozenset(words) - _LIGHT_STEMS


def _after_not(words: Sequence[str]) -> tuple[str, ...]:
    """The word behind every "not"."""
    return tuple(
        next((w for w in words[n + 1 :] if w not in _LIGHT_STEMS), "")
        for n, word in enumerate(words)
        if word == "not"
    )


def _optional(pattern: str) -> Iterator[str]:
    """Every reading of a pattern with its [optional] parts left in or out."""
    parts = re.split(r"\[([^\]]*)\]", pattern)
    fixed, optional = parts[::2], parts[1::2]
    for chosen in product((True, False), repeat=len(optional)):
        kept = [part if keep else "" for part, keep in zip(optional, chosen, strict=True)]
        yield "".join(a + b for a, b in zip(fixed, [*kept, ""], strict=True))


@dataclass(frozen=True)
class _Slot:
    """A word for the slot of a pattern and what it stands for."""

    word: str = ""
    label: str | None = None
    value: str | None = None


def _slots(
    table: QuestionTable, asks: Asks, domain: Domain, pattern: str, place: str
) -> list[_Slot]:
    """All ways to fill the slots of a pattern."""
    if "{class}" in pattern:
        if asks not in _ABOUT_A_CLASS:
            raise DomainError(f"{place}: '{pattern}' names {{class}}, but asks '{asks}'; remove it")
        return [
            _Slot(word=word, label=key) for key, own in domain.classes.items() for word in own.words
        ]
    if asks in _ABOUT_A_CLASS:
        raise DomainError(f"{place}: '{pattern}' asks about a class; name it as {{class}}")
    if "{value}" in pattern:
        if table.feature is None or asks is not Asks.FEATURE_IS or table.value is not None:
            raise DomainError(
                f"{place}: '{pattern}' names {{value}}; that goes with asks = 'feature_is', a "
                "feature, and no value of its own"
            )
        feature = domain.features[table.feature]
        return [
            _Slot(word=word, value=value)
            for value in feature.values
            for word in feature.words[value]
        ]
    if asks is Asks.FEATURE_IS and table.value is None:
        raise DomainError(f"{place}: '{pattern}' needs {{value}}, or the question a 'value'")
    return [_Slot(value=table.value)]


def _check_table(table: QuestionTable, domain: Domain, place: str) -> Asks:
    if table.asks not in set(Asks):
        raise DomainError(
            f"{place}: asks = '{table.asks}' is not known; "
            f"{did_you_mean(table.asks, [a.value for a in Asks])}"
        )
    asks = Asks(table.asks)
    if asks in _ABOUT_A_FEATURE and table.feature is None:
        raise DomainError(f"{place}: asks = '{asks}' needs a feature; add feature = \"…\"")
    if asks not in _ABOUT_A_FEATURE and table.feature is not None:
        raise DomainError(f"{place}: asks = '{asks}' is about no feature; remove 'feature'")
    if asks is Asks.BELIEF_VALUE and table.predicate is None:
        raise DomainError(f"{place}: asks = '{asks}' needs a static; add predicate = \"…\"")
    if asks is not Asks.BELIEF_VALUE and table.predicate is not None:
        raise DomainError(f"{place}: asks = '{asks}' is about no static; remove 'predicate'")
    if table.predicate is not None and table.predicate in domain.features:
        raise DomainError(
            f"{place}: '{table.predicate}' is a feature; ask for it with asks = "
            f"'{Asks.FEATURE_VALUE}' and feature = \"{table.predicate}\""
        )
    if table.predicate is not None and table.predicate not in domain.beliefs:
        raise DomainError(
            f"{place}: '{table.predicate}' is no static of knowledge.al that gives "
            f"'{domain.scene}' a value; {did_you_mean(table.predicate, domain.beliefs)}"
        )
    if table.feature is not None and table.feature not in domain.features:
        raise DomainError(
            f"{place}: '{table.feature}' is no feature of domain.toml; "
            f"{did_you_mean(table.feature, domain.features)}"
        )
    if table.value is not None:
        values = domain.features[table.feature].values if table.feature else ()
        if table.value not in values:
            raise DomainError(
                f"{place}: '{table.value}' is no value of '{table.feature}'; "
                f"{did_you_mean(table.value, values)}"
            )
    return asks
