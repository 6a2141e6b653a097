"""Answers for scenes that the tree classified: the recurrent network chooses the answer type."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from pathlib import Path

import numpy as np

from seewhy.dialogue.answer import AnswerType
from seewhy.dialogue.question import Asks, Query, Question, Questions
from seewhy.dialogue.recurrent import fit_answerer
from seewhy.dialogue.recurrent_answerer import RecurrentAnswerer
from seewhy.dialogue.recurrent_options import AnswerExample, RecurrentOptions
from seewhy.dialogue.reference import ReferenceAnswers
from seewhy.domain.domain import Domain
from seewhy.errors import ModelError
from seewhy.knowledge.scene import FeatureVector

MOST_EXAMPLES = 20_000
"""Examples that the recurrent network is trained on at most."""
_NOT_LEARNED = {Asks.EXPLAIN, Asks.BELIEF_VALUE}  # what follows from the class need not be learned


def fit_learned_answers(
    domain: Domain,
    questions: Questions,
    reference: ReferenceAnswers,
    vectors: Sequence[FeatureVector],
    labels: Sequence[str],
    *,
    seed: int = 0,
) -> RecurrentAnswerer:
    """Train the recurrent network on questions about scenes that reasoning left open.

    Every query is asked of every scene. Where that makes more than :data:`MOST_EXAMPLES`, as many
    classes do, each scene is asked what concerns its own class and a share of the rest, which is
    dealt out until every query had its turn, then again; so none is missing.
    """
    by_query: dict[Query, list[Question]] = {}
    for question in questions.all:
        if question.asks not in _NOT_LEARNED:
            by_query.setdefault(question.query, []).append(question)
    examples = []
    for number, queries in dealt(by_query, labels, most=MOST_EXAMPLES, seed=seed):
        vector, label = vectors[number], labels[number]
        for query in queries:
            same = by_query[query]
            examples.append(
                AnswerExample(
                    words=same[number % len(same)].words,
                    features=_known(vector),
                    label=label,
                    answer=reference.answer(same[0], vector, label).identifier,
                    scene=number,
                )
            )
    return fit_answerer(
        examples,
        feature_values={key: feature.values for key, feature in domain.features.items()},
        options=RecurrentOptions(seed=seed),
    )


def dealt(
    by_query: Mapping[Query, Sequence[Question]], labels: Sequence[str], *, most: int, seed: int
) -> Iterator[tuple[int, list[Query]]]:
    """Yield scenes by their numbers, and what each is asked; see :func:`fit_learned_answers`."""
    queries = list(by_query)
    if len(queries) * len(labels) <= most:
        for number in range(len(labels)):
            yield number, queries
        return
    generator = np.random.default_rng(seed)
    # Of more scenes than examples, a sample is asked one question each.
    scenes = sorted(generator.permutation(len(labels))[:most].tolist())
    each = max(1, most // len(scenes))
    deck: list[Query] = []
    for number in scenes:
        of_class = [query for query in queries if query[1] == labels[number]]
        chosen = dict.fromkeys(of_class if 2 * len(of_class) <= each else ())
        while len(chosen) < min(each, len(queries)):
            deck = deck or [queries[n] for n in generator.permutation(len(queries))]
            chosen.setdefault(deck.pop())
        yield number, list(chosen)


def learned_answers(
    domain: Domain,
    answerer: RecurrentAnswerer,
    asked: Sequence[tuple[Question, FeatureVector, str, Sequence[str]]],
) -> list[tuple[AnswerType, float]]:
    """Choose answer types for (question, feature vector, class, features of the path).

    Only answer types that the templates can produce for the question, the class and the features
    come into question: an answer never contradicts what the reply says elsewhere. Where the
    network knows none of them, the features of the tree's path are mentioned, with probability 0.
    """
    by_form = _by_form(answerer.answer_types)
    forms = [answer_form(domain, question, vector, label) for question, vector, label, _ in asked]
    allowed = [
        {
            identifier: kind
            for fitting in (form, _NOTHING.get(form, ""))
            for identifier, kind in by_form.get(fitting, {}).items()
            if _possible(kind, question, domain.named(vector))
        }
        for form, (question, vector, *_) in zip(forms, asked, strict=True)
    ]
    found = iter(
        answerer.answers(
            [
                (question.words, _known(vector), label)
                for (question, vector, label, _), possible in zip(asked, allowed, strict=True)
                if possible
            ],
            allowed=[possible for possible in allowed if possible],
        )
    )
    chosen: list[tuple[AnswerType, float]] = []
    for form, kinds, (question, _, _, path_features) in zip(forms, allowed, asked, strict=True):
        if kinds:
            identifier, probability = next(found)
            chosen.append((kinds[identifier], probability))
            continue
        mentions = tuple(path_features) if form in _WITH_REASONS else ()
        if question.feature is not None:
            mentions = (question.feature,)
        chosen.append((AnswerType(_NOTHING.get(form, form), mentions), 0.0))
    return chosen


def check_answers(domain: Domain, answerer: RecurrentAnswerer, folder: Path) -> None:
    """Raise a ModelError where a network was trained to answer for another domain."""
    fits = answerer.features == {
        key: feature.values for key, feature in domain.features.items()
    } and all(_fits(domain, identifier) for identifier in answerer.answer_types)
    if not fits:
        raise ModelError(
            f"{folder}: the network answers for other features than the model's domain names; "
            "train it again"
        )


def _fits(domain: Domain, identifier: str) -> bool:
    try:
        kind = AnswerType.parse(identifier)
    except ValueError:
        return False
    return domain.features.keys() >= {*kind.mentions} and all(
        feature in domain.features and value in domain.features[feature].values
        for change in kind.changes
        for feature, value in change
    )


@lru_cache(maxsize=8)
def _by_form(identifiers: tuple[str, ...]) -> dict[str, dict[str, AnswerType]]:
    """Form → identifier → answer type."""
    found: dict[str, dict[str, AnswerType]] = {}
    for identifier in identifiers:
        kind = AnswerType.parse(identifier)
        found.setdefault(kind.form, {})[identifier] = kind
    return found


def _known(vector: FeatureVector) -> tuple[str, ...]:
    """The vector for the network, which reads an empty value as one that is not known."""
    return tuple(value or "" for value in vector)


_NOTHING = {"change": "no_change", "difference": "no_difference"}
"""Forms that propose something, and what is said where there is nothing to propose."""
_WITH_REASONS = {"reasons", "false_premise", "denied_not", "against"}


def answer_form(domain: Domain, question: Question, vector: FeatureVector, label: str) -> str:
    """Return the form of answer that fits a question about a scene of class ``label``."""
    same = question.label == label
    match question.asks:
        case Asks.CLASS:
            return "class"
        case Asks.IS_CLASS:
            return "yes_class" if same else "no_class"
        case Asks.WHY_CLASS:
            return "reasons" if same else "false_premise"
        case Asks.WHY_NOT_CLASS:
            return "denied_not" if same else "against"
        case Asks.CHANGE_TO_CLASS:
            return "already" if same else "change"
        case Asks.DIFFERENCE_TO_CLASS:
            return "same" if same else "difference"
        case Asks.FEATURE_VALUE:
            return "value"
        case Asks.FEATURE_IS:
            value = domain.named(vector)[question.feature or ""]
            return "yes" if value == question.value else "no"
    raise ValueError(f"'{question.asks}' is not a question about the scene")


def _possible(kind: AnswerType, question: Question, values: Mapping[str, str | None]) -> bool:
    if question.feature is not None and kind.mentions != (question.feature,):
        return False
    return all(values[f] != value for change in kind.changes for f, value in change)
