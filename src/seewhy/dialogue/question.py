"""A question in words becomes a query: by the domain's templates, or by the grammar."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property

from seewhy.dialogue.asked import Asks, Query, Question
from seewhy.dialogue.clarification import Suggestions
from seewhy.dialogue.ellipsis import completed
from seewhy.dialogue.grammar_file import around_phrases, aside_phrases, grammar_words
from seewhy.dialogue.inflection import ARTICLES, forbidden
from seewhy.dialogue.lexicon import NUMBERS
from seewhy.dialogue.question_words import CONTRACTIONS, words_of
from seewhy.dialogue.readings import Readings
from seewhy.dialogue.saying_questions import say_question
from seewhy.dialogue.spelling import Spelling
from seewhy.dialogue.static_lexicon import static_clauses
from seewhy.dialogue.templates import as_what, embedded, expanded
from seewhy.dialogue.vocabulary import SUBJECTS, Vocabulary
from seewhy.domain.domain import Domain
from seewhy.domain.wording import join_words
from seewhy.errors import QuestionError

__all__ = ["Asks", "Query", "Question", "Questions"]

LONGEST_QUESTION = 300
"""Characters; nothing that the grammar says is nearly as long."""
_LONGEST_OPENING = 12


_TAG = re.compile(r",\s*(right|correct|true|no|yes|okay|ok|huh|eh)\s*[.?!]*\s*$", re.IGNORECASE)
"""What may follow a statement to make it a question: "it leans, right?"."""

_POLITE_NOT = re.compile(r"^(is|are|does|do|has|have|can|will|would) not (?=it|this|that|the\b)")
"""A "not" that asks the same: "isn't it crossed out?"."""


_DEFINED = re.compile(r"what (?:is|are) (?:a|an|meant by) (.+)")
"""Asks what a word means, where "what is the base?" asks what is seen."""
_LONGEST_DEFINED = 3
"""Words of what is defined; "what is a driver allowed to do?" asks for something else."""
_MEANT = "what do you mean by "
_OF_ANY = re.compile(
    r"(what (?:makes|lets|causes|keeps)|why (?:does|is|would|can)|when (?:does|is|would|can)|"
    r"how come) an? (\w+)\b"
)
"""Asks of one as of all: "what makes a tower stable?"."""
_RECOGNISED = re.compile(
    r"(how (?:do|can|could|would) (?:you|one|we|i) (?:recognise|recognize|identify|tell|know|spot)"
    r") an? (\w+) (\w+)"
)
"""The same of one that is so: "how do you recognise a stable tower?"."""


class Questions:
    """The questions that can be asked about pictures of a domain.

    A wording of the domain's templates means what its template says; every other one is read by
    the grammar (dialogue/grammar.toml) over the words of the domain.

    Raises
    ------
    DomainError
        Where a template names something that the domain does not have.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> questions = Questions(load_domain("structure_stability"))
    >>> questions.understand("WHAT makes this tower unstabel??").query
    ('why_class', 'unstable', None, None)
    >>> questions.understand("would it still be stable if it leaned?").query
    ('what_if', None, None, None, 'lean=yes')
    """

    def __init__(self, domain: Domain) -> None:
        self.domain = domain
        self._vocabulary = Vocabulary(domain)
        self._known: dict[tuple[str, ...], Question] = {}
        for question in expanded(domain, self._vocabulary.for_templates):
            self._known.setdefault(question.words, question)
        self._by_query: dict[Query, Question] = {}
        for question in self._known.values():
            self._by_query.setdefault(question.query, question)
        self._readings = Readings(domain, self._vocabulary.for_grammar)
        self._spelling = Spelling(self._spelled())

    @cached_property
    def _embedded(self) -> dict[tuple[str, ...], Question]:
        """The templates as they stand behind "tell me"."""
        found: dict[tuple[str, ...], Question] = {}
        for words, question in self._known.items():
            for variant in embedded(words):
                found.setdefault(variant, question)
        return found

    @cached_property
    def _suggestions(self) -> Suggestions:
        return Suggestions(self.domain, tuple(self._known.values()))

    @property
    def all(self) -> tuple[Question, ...]:
        """Every distinct wording of the domain's templates."""
        return tuple(self._known.values())

    def one_of_each(self) -> tuple[Question, ...]:
        """The first wording of every distinct query of the templates, in their order."""
        return tuple(self._by_query.values())

    def understand(self, text: str, *, previous: Question | None = None) -> Question:
        """Return the query that a question in words asks for.

        Case, punctuation, word forms, the domain's synonyms and typing errors are forgiven.

        Parameters
        ----------
        text : str
        previous : Question, optional
            What was asked before, which a question may leave out: "and the base?".

        Raises
        ------
        QuestionError
            If the question is empty, too long or not understood; it names the nearest ones.
        """
        self._refuse_what_is_none(text)
        readings = list(self._spelling.readings(words_of(_TAG.sub("", text))))
        found: dict[Query, Question] = {}
        for reading in readings:
            for question in self._read(reading, previous):
                found.setdefault(question.query, question)
        # What could be two different questions is asked back.
        if len(found) != 1:
            nearest = tuple(dict.fromkeys(f"{question.text}?" for question in found.values()))[:3]
            nearest = nearest or self._suggestions.nearest(readings[0])
            self._refuse_no_class(text, nearest)
            raise QuestionError(
                f"'{' '.join(text.split())}' is not understood; {_suggest(nearest)}",
                nearest=nearest,
            )
        return next(iter(found.values()))

    def _read(self, text: str, previous: Question | None) -> list[Question]:
        """What a text without typing errors may ask."""
        if self._vocabulary.speaks_of_another(text) or self._vocabulary.is_command(text):
            return []
        of_any = _OF_ANY.match(text)
        if of_any is not None and self._vocabulary.speaks_of_many(f"{of_any[2]}s"):
            text = f"{of_any[1]} {of_any[2]}s{text[of_any.end() :]}"
        recognised = _RECOGNISED.fullmatch(text)
        if recognised is not None and self._vocabulary.speaks_of_many(f"{recognised[3]}s"):
            text = f"{recognised[1]} {recognised[2]} {recognised[3]}s"
        defined = _DEFINED.fullmatch(text)
        if defined is not None:
            read = self._readings.read(self._vocabulary.for_grammar(_MEANT + defined[1]))
            if read:
                return [self._worded(question) for question in read]
            if len(defined[1].split()) <= _LONGEST_DEFINED:
                return []  # "what is a room?" asks for no class of this one
        by_template = self._template(self._known, text, self._vocabulary.for_templates(text))
        if by_template is not None and not (previous and by_template.asks is Asks.EXPLAIN):
            return [by_template]
        words = self._vocabulary.for_grammar(text)
        if previous is not None:
            follow_up = completed(self._readings, words, previous)
            if follow_up:
                return [self._worded(question) for question in follow_up]
        by_template = by_template or self._embedded_in(text)
        plainly = _POLITE_NOT.sub(r"\1 ", self._vocabulary.plainly(text))
        if by_template is None and plainly != text:
            words_of_it = self._vocabulary.for_templates(plainly)
            by_template = self._template(self._known, plainly, words_of_it)
        if by_template is not None:
            return [by_template]
        read = self._readings.read(words) or self._readings.read(self._vocabulary.bare(words))
        if not read and "'s" in text:
            return self._read(text.replace("'s", " is"), previous)  # "the room's empty"
        return [self._worded(question) for question in read]

    def _template(
        self, templates: Mapping[tuple[str, ...], Question], text: str, words: tuple[str, ...]
    ) -> Question | None:
        """The template of some words, where it forbids what the text forbids."""
        if self._vocabulary.speaks_of_many(text):
            return None  # templates speak of what is shown
        found = templates.get(words)
        same = found is not None and forbidden(words_of(text)) == forbidden(words_of(found.text))
        return found if same else None

    def _embedded_in(self, text: str) -> Question | None:
        """The template behind "tell me" and the like, or one with "what" for "which"."""
        tokens = text.split()
        for start in range(min(len(tokens), _LONGEST_OPENING)):
            rest = self._vocabulary.for_templates(" ".join(tokens[start:]))
            found = self._template(self._known, text, rest) if start else None
            found = found or self._template(self._embedded, text, as_what(rest))
            opening = self._vocabulary.for_grammar(" ".join(tokens[:start]))
            if found is not None and self._readings.is_opening(opening):
                return found
        return None

    def _worded(self, question: Question) -> Question:
        """A question of the grammar in the words of a template, or in its own."""
        same = self._by_query.get(question.query)
        if same is not None:
            return same
        text = say_question(self.domain, question)
        return replace(question, text=text, words=self._vocabulary.for_templates(text))

    def _spelled(self) -> set[str]:
        """All words that a question can be made of, as they are written."""
        domain = self.domain
        spelled = set(CONTRACTIONS) | SUBJECTS | ARTICLES | self._vocabulary.spelled
        spelled.update(grammar_words())
        for group in (aside_phrases(), *around_phrases()):
            spelled.update(word for phrase in group for word in words_of(phrase))
        tokens = {token for question in self._known.values() for token in question.text.split()}
        spelled.update(words_of(" ".join(tokens)))
        for scene_class in domain.classes.values():
            for phrase in (*scene_class.words, scene_class.say, *scene_class.verbs):
                spelled.update(words_of(phrase))
        for feature in domain.features.values():
            phrases = [feature.name, feature.key, *feature.values, *feature.change.values()]
            phrases += [clause.replace("{it}", "it") for clause in feature.say.values()]
            phrases += [word for words in feature.words.values() for word in words]
            for phrase in phrases:
                spelled.update(words_of(phrase))
        for belief in domain.beliefs.values():
            clauses = (clause for _, clause in static_clauses(domain, belief))
            for phrase in (belief.name, *belief.words.values(), *belief.acts, *clauses):
                spelled.update(words_of(phrase))
        return spelled

    def _refuse_no_class(self, text: str, nearest: tuple[str, ...]) -> None:
        """Raise a QuestionError where a question of numbered classes names a number of none."""
        classes = [scene_class.say for scene_class in self.domain.classes.values()]
        numbers = [say for say in classes if say.isdecimal()]
        words = words_of(text)
        for position, word in enumerate(words if numbers else ()):
            if not word.isdecimal() and word not in NUMBERS:
                continue
            instead = " ".join([*words[:position], numbers[0], *words[position + 1 :]])
            if any(question.label for question in self._read(instead, None)):
                raise QuestionError(
                    f"'{' '.join(text.split())}' is not understood: '{word}' is no class; the "
                    f"classes are {join_words(classes)}",
                    nearest=nearest,
                )

    def _refuse_what_is_none(self, text: str) -> None:
        """Raise a QuestionError where a text is no question at all."""
        problem = None
        if not text.strip():
            problem = "the question is empty"
        elif len(text) > LONGEST_QUESTION:
            problem = (
                f"the question has {len(text)} characters, at most {LONGEST_QUESTION} are read"
            )
        elif not any(re.search("[a-z]", token) for token in words_of(text)):
            problem = f"'{' '.join(text.split())}' has no word in the vocabulary's alphabet"
        if problem is not None:
            examples = tuple(f"{question.text}?" for question in self.one_of_each()[:3])
            examples = examples or self._suggestions.nearest("what")
            raise QuestionError(f"{problem}; {_suggest(examples)}", nearest=examples)


def _suggest(questions: Sequence[str]) -> str:
    return "ask for instance: " + " · ".join(questions)
