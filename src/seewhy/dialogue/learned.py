"""Answers for scenes that the tree classified: the recurrent network chooses the answer type."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from seewhy.dialogue.answer import AnswerType
from seewhy.dialogue.question import Asks, Question, Questions
from seewhy.dialogue.recurrent import fit_answerer
from seewhy.dialogue.recurrent_answerer import RecurrentAnswerer
from seewhy.dialogue.recurrent_options import AnswerExample, RecurrentOptions
from seewhy.dialogue.reference import ReferenceAnswers
from seewhy.domain import Domain
from seewhy.knowledge.scene import FeatureVector


def fit_learned_answers(
    domain: Domain,
    questions: Questions,
    reference: ReferenceAnswers,
    vectors: Sequence[FeatureVector],
    labels: Sequence[str],
    *,
    seed: int = 0,
    on_progress: Callable[[Any], None] | None = None,
) -> RecurrentAnswerer:
    """Train the recurrent network on every question about scenes that reasoning left open."""
    wordings = [q for q in questions.all if q.asks is not Asks.EXPLAIN]
    by_query: dict[tuple[str | None, ...], list[Question]] = {}
    for question in wordings:
        by_query.setdefault(question.query, []).append(question)
    examples = [
        AnswerExample(
            words=same[number % len(same)].words,
            features=_known(vector),
            label=label,
            answer=reference.answer(same[0], vector, label).identifier,
            scene=number,
        )
        for number, (vector, label) in enumerate(zip(vectors, labels, strict=True))
        for same in by_query.values()
    ]
    return fit_answerer(
        examples,
        feature_values={key: feature.values for key, feature in domain.features.items()},
        options=RecurrentOptions(seed=seed),
        on_progress=on_progress,
    )


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
    chosen: list[tuple[AnswerType, float]] = []
    kinds = {identifier: AnswerType.parse(identifier) for identifier in answerer.answer_types}
    for question, vector, label, path_features in asked:
        form = answer_form(domain, question, vector, label)
        allowed = [
            identifier
            for identifier, kind in kinds.items()
            if _possible(domain, kind, form, question, vector)
        ]
        if allowed:
            identifier, probability = answerer.answer(
                question.words, _known(vector), label, allowed=allowed
            )
            chosen.append((kinds[identifier], probability))
        else:
            mentions = tuple(path_features) if form in _WITH_REASONS else ()
            if question.feature is not None:
                mentions = (question.feature,)
            form = "no_change" if form == "change" else form
            chosen.append((AnswerType(form, mentions), 0.0))
    return chosen


def _known(vector: FeatureVector) -> tuple[str, ...]:
    """The vector for the network, which reads an empty value as one that is not known."""
    return tuple(value or "" for value in vector)


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
        case Asks.FEATURE_VALUE:
            return "value"
        case Asks.FEATURE_IS:
            value = domain.named(vector)[question.feature or ""]
            return "yes" if value == question.value else "no"
    raise ValueError(f"'{question.asks}' is not a question about the scene")


def _possible(
    domain: Domain, kind: AnswerType, form: str, question: Question, vector: FeatureVector
) -> bool:
    if kind.form != form and not (form == "change" and kind.form == "no_change"):
        return False
    if question.feature is not None and kind.mentions != (question.feature,):
        return False
    values = domain.named(vector)
    return all(values[f] != value for change in kind.changes for f, value in change)
