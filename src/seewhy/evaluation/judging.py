"""Evaluate an agent: classify annotated pictures, ask about them, and compare."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from seewhy.data.dataset import Dataset
from seewhy.data.making import determined_share
from seewhy.dialogue.answer import AnswerType
from seewhy.dialogue.question import Asks
from seewhy.dialogue.reply import UNKNOWN
from seewhy.domain.tables import CLASS
from seewhy.errors import DatasetError
from seewhy.evaluation.answers import EXPLANATORY, score_answer
from seewhy.evaluation.axioms import axiom_records
from seewhy.evaluation.recognition import recognition_of_class, recognition_of_features
from seewhy.evaluation.redeciding import depended_on, redecided
from seewhy.evaluation.result import Evaluation
from seewhy.evaluation.wrong import wrong_pictures

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent
    from seewhy.dialogue.reference import ReferenceAnswers
    from seewhy.dialogue.reply import Classification

__all__ = ["classified", "evaluate", "seen_in_training"]


def evaluate(
    agent: Agent,
    dataset: Dataset,
    *,
    questions_per_scene: int = 8,
    seed: int = 0,
    reference: ReferenceAnswers | None = None,
    on_progress: Callable[[int], None] | None = None,
) -> Evaluation:
    """Evaluate an agent on the scenes of a dataset (those with split "test", if there are splits).

    For every scene, ``questions_per_scene`` of the domain's questions are drawn at random, whatever
    its class is; so what they presume is nobody's word, and the agent does not suppose it.
    Pictures without a class count for the features that are annotated, for nothing else.
    Correct answers are those of :mod:`seewhy.dialogue.reference`: of what the agent itself knows,
    or of ``reference``, where somebody knows more.

    Raises
    ------
    DatasetError
        If the dataset is of another domain, or no picture to evaluate on has a class.

    Examples
    --------
    >>> # evaluate(agent, Dataset.load("pictures", domain)).classification_accuracy
    """
    everything = dataset.of_split("test")
    if dataset.domain.name != agent.domain.name:
        raise DatasetError(
            f"{dataset.folder}: the dataset is of the domain '{dataset.domain.name}', the model "
            f"of '{agent.domain.name}'"
        )
    scenes = everything.with_class()
    if not len(scenes):
        raise DatasetError(
            f"{everything.table.name}: no picture to evaluate on has a class; fill the column "
            "'class'"
        )
    seen = classified(agent, everything, on_progress=on_progress)
    found = [
        scene for scene, label in zip(seen, everything.labels, strict=True) if label is not None
    ]
    right = [scene.label == true for scene, true in zip(found, scenes.classes, strict=True)]
    methods = [scene.method for scene in found]
    scored = _scored_answers(
        agent, scenes, found, reference or agent.reference, number=questions_per_scene, seed=seed
    )
    return Evaluation(
        scenes=len(scenes),
        without_class=len(everything) - len(scenes),
        groups=len(set(scenes.groups)),
        has_splits=any(scene.split for scene in dataset.scenes),
        seen_in_training=seen_in_training(agent, scenes),
        class_recognition=recognition_of_class(everything, seen),
        feature_recognition=recognition_of_features(everything, seen),
        without=agent.without,
        unknown=_share([scene.verdict == UNKNOWN for scene in found]),
        answer_accuracy=_share([enough for enough, _, _ in scored]),
        answer_accuracy_strict=_share([exact for _, exact, _ in scored]),
        explanation_accuracy=_share([enough for enough, _, explains in scored if explains]),
        explanation_accuracy_strict=_share([exact for _, exact, explains in scored if explains]),
        decided_by_knowledge=_share([method == "knowledge" for method in methods]),
        accuracy_by_method={
            method: _share(
                [is_right for is_right, used in zip(right, methods, strict=True) if used == method]
            )
            for method in sorted(set(methods))
        },
        determined=determined_share(scenes.vectors, scenes.classes),
        redecided=redecided(agent, scenes, found),
        depended_on=depended_on(agent, [*scenes.vectors, *(scene.vector for scene in found)]),
        asked_by_axioms=_asked_by_axioms(agent),
        training_pictures=_training_pictures(agent, dataset),
        wrong=wrong_pictures(everything, seen),
        axioms=axiom_records(agent.reasoner, scenes.vectors, scenes.classes),
    )


def seen_in_training(agent: Agent, scenes: Dataset) -> int:
    """The number of pictures that an agent's networks were trained on."""
    return sum(digest in agent.trained_on for digest in scenes.picture_digests())


def classified(
    agent: Agent, dataset: Dataset, *, on_progress: Callable[[int], None] | None = None
) -> list[Classification]:
    """Classify all pictures of a dataset, some at a time; nothing is supposed of any."""
    found: list[Classification] = []
    for pixels in dataset.iter_pictures(agent.picture_size, on_progress=on_progress):
        found += [replace(scene, otherwise=()) for scene in agent.classify_all(pixels)]
    return found


def _scored_answers(
    agent: Agent,
    scenes: Dataset,
    found: Sequence[Classification],
    reference: ReferenceAnswers,
    *,
    number: int,
    seed: int,
) -> list[tuple[bool, bool, bool]]:
    """For every question drawn: is the answer right, strictly so, and does it explain?"""
    generator = np.random.default_rng(seed)
    possible = [
        question for question in agent.questions.one_of_each() if question.asks is not Asks.EXPLAIN
    ]
    scored: list[tuple[bool, bool, bool]] = []
    known: dict[tuple[object, ...], AnswerType] = {}
    for row, true_class, scene in zip(scenes.scenes, scenes.classes, found, strict=True):
        for chosen in generator.choice(
            len(possible), size=min(number, len(possible)), replace=False
        ):
            question = possible[int(chosen)]
            asked = (question.query, scene.vector, scene.label, scene.verdict)
            if asked not in known:
                known[asked] = agent.answer(scene, question).kind
            enough, exact = score_answer(
                known[asked],
                reference.answer(question, row.vector, true_class),
                seen=agent.domain.named(scene.vector),
                true=agent.domain.named(row.vector),
                right_class=scene.label == true_class,
            )
            scored.append((enough, exact, question.asks in EXPLANATORY))
    return scored


def _asked_by_axioms(agent: Agent) -> dict[str, bool]:
    """Feature → whether some axiom has a literal of it, in its head or in its body."""
    axioms = agent.domain.knowledge.axioms
    predicates = frozenset[str]().union(*(axiom.predicates for axiom in axioms))
    return {
        key: any(literal.predicate in predicates for literal in feature.literals.values())
        for key, feature in agent.domain.features.items()
    }


def _training_pictures(agent: Agent, dataset: Dataset) -> dict[str, dict[str, int]]:
    """What the pictures to train on show: those of the dataset, or else those remembered."""
    train = [scene for scene in dataset.scenes if scene.split == "train"]
    if train:
        rows = [(scene.vector, scene.label, 1) for scene in train]
    else:
        rows = [
            (vector, label, count)
            for vector, labels in agent.experience.items()
            for label, count in labels.items()
        ]
    counts: dict[str, Counter[str]] = {key: Counter() for key in (CLASS, *agent.domain.features)}
    for vector, label, count in rows:
        for key, value in ((CLASS, label), *agent.domain.named(vector).items()):
            if value is not None:
                counts[key][value] += count
    values = {CLASS: tuple(agent.domain.classes)}
    values |= {key: feature.values for key, feature in agent.domain.features.items()}
    return {key: {value: counts[key][value] for value in values[key]} for key in counts}


def _share(outcomes: Sequence[bool]) -> float:
    return float(np.mean(outcomes)) if outcomes else 0.0
