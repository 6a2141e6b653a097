"""Questions drawn for pictures, and the score of the answers, alike for every system."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from seewhy.data.dataset import Dataset
from seewhy.dialogue.answer import AnswerType
from seewhy.dialogue.question import Asks, Query, Question, Questions
from seewhy.dialogue.reference import ReferenceAnswers
from seewhy.evaluation import EXPLANATORY, score_answer
from seewhy.knowledge.scene import FeatureVector
from seewhy_lab.experiments.sufficiency import answer_suffices, sufficiency_of

__all__ = [
    "QUESTIONS",
    "Asked",
    "answer_scores",
    "draw_questions",
    "suitable",
    "wordings_of",
]

QUESTIONS = 8
"""Questions drawn for every picture."""


@dataclass(frozen=True)
class Asked:
    """A question about one of several pictures."""

    picture: int
    question: Question


def suitable(question: Question, label: str) -> bool:
    """Whether a question can be asked of a picture of a class: what it presumes is so.

    Examples
    --------
    >>> why = Question(Asks.WHY_CLASS, "", (), label="stable")
    >>> suitable(why, "stable"), suitable(why, "unstable")
    (True, False)
    """
    if question.asks is Asks.WHY_CLASS:
        return question.label == label
    if question.asks in (Asks.WHY_NOT_CLASS, Asks.CHANGE_TO_CLASS, Asks.DIFFERENCE_TO_CLASS):
        return question.label != label
    return question.asks is not Asks.EXPLAIN


def draw_questions(
    questions: Questions,
    labels: Sequence[str],
    *,
    seed: int,
    count: int = QUESTIONS,
    stream: Sequence[int] = (2,),
) -> list[Asked]:
    """Draw different questions for each picture from those that suit its class, and a wording.

    Every kind of question (why, how many, …) is as likely as every other, however many classes
    and values it can be asked about. Other numbers in ``stream`` give other questions: those that
    are tested on have 2.
    """
    wordings = wordings_of(questions)
    rng = np.random.default_rng([seed, *stream])
    found: list[Asked] = []
    by_class: dict[str, tuple[list[Query], np.ndarray[tuple[int], np.dtype[np.float64]]]] = {}
    for number, label in enumerate(labels):
        if label not in by_class:
            fitting = [query for query, same in wordings.items() if suitable(same[0], label)]
            kinds = [query[0] for query in fitting]
            chances = np.array([1.0 / kinds.count(kind) for kind in kinds])
            by_class[label] = fitting, chances / chances.sum()
        queries, chance = by_class[label]
        drawn = rng.choice(len(queries), size=min(count, len(queries)), replace=False, p=chance)
        for chosen in drawn:
            same = wordings[queries[int(chosen)]]
            found.append(Asked(number, same[int(rng.integers(len(same)))]))
    return found


def wordings_of(questions: Questions) -> dict[Query, list[Question]]:
    """All questions by what they ask: each in its wordings."""
    found: dict[Query, list[Question]] = {}
    for question in questions.all:
        found.setdefault(question.query, []).append(question)
    return found


def answer_scores(
    asked: Sequence[Asked],
    kinds: Sequence[AnswerType],
    scenes: Dataset,
    reference: ReferenceAnswers,
    *,
    vectors: Sequence[FeatureVector],
    labels: Sequence[str | None],
) -> dict[str, float]:
    """Score answers by the paper's measure, by the strict one, and by whether reasons suffice.

    Parameters
    ----------
    asked, kinds : sequence, length n
        The questions, and the type of the answer to each.
    scenes : Dataset
        The pictures with their annotation.
    reference : ReferenceAnswers
        What correct answers say, and the annotated scenes among which reasons suffice or not.
    vectors, labels : sequence, length n
        What the answer to each question takes the features and the class to be; it names these.

    Returns
    -------
    dict of str to float
        "answers" and "answers_strict" over all questions, "explanations" and
        "explanations_strict" over those that ask why, why not, and what would have to change,
        "explanations_sufficient" over the same, whatever other reasons the annotator gives
        (:func:`~seewhy_lab.experiments.sufficiency.answer_suffices`).
    """
    features = list(scenes.domain.features)
    true = [_named(features, vector) for vector in scenes.vectors]
    classes = scenes.classes
    sufficiency = sufficiency_of(reference)
    scored: list[tuple[bool, bool]] = []
    explaining: list[tuple[bool, bool, bool]] = []
    for asked_question, kind, vector, label in zip(asked, kinds, vectors, labels, strict=True):
        scene, true_class = scenes.scenes[asked_question.picture], classes[asked_question.picture]
        seen = _named(features, vector)
        gold = reference.answer(asked_question.question, scene.vector, true_class)
        enough, exact = score_answer(
            kind,
            gold,
            seen=seen,
            true=true[asked_question.picture],
            right_class=label == true_class,
        )
        scored.append((enough, exact))
        if asked_question.question.asks in EXPLANATORY:
            suffices = answer_suffices(
                kind,
                gold,
                asked_question.question,
                scene.vector,
                true_class,
                seen=seen,
                strict=exact,
                sufficiency=sufficiency,
            )
            explaining.append((enough, exact, suffices))
    return {
        "answers": _share([row[0] for row in scored]),
        "answers_strict": _share([row[1] for row in scored]),
        "explanations": _share([row[0] for row in explaining]),
        "explanations_strict": _share([row[1] for row in explaining]),
        "explanations_sufficient": _share([row[2] for row in explaining]),
    }


def _named(features: Sequence[str], vector: FeatureVector) -> dict[str, str | None]:
    named: Mapping[str, str | None] = dict(zip(features, vector, strict=True))
    return dict(named)


def _share(outcomes: Sequence[bool]) -> float:
    return float(np.mean(outcomes)) if outcomes else 0.0
