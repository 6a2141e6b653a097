"""H1 and H2: classes and answers against the number of training pictures, beside other systems."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from seewhy.agent.agent import Agent
from seewhy.data.dataset import Dataset
from seewhy.data.making import determined_share
from seewhy.dialogue.reference import ReferenceAnswers, experience_of
from seewhy.domain.domain import Domain
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.learned_file import Withdrawn
from seewhy.perception.backbones import NONE
from seewhy_lab.experiments.experiment import Claim, Experiment, Measure, Plan, Row, Setting, Trial
from seewhy_lab.experiments.frozen_features import embedded, fit_frozen_features
from seewhy_lab.experiments.questioning import Asked, answer_scores, draw_questions
from seewhy_lab.experiments.seeing import Remembered, Seen, drawings, pretrain, see

__all__ = [
    "MEASURES",
    "VQA",
    "agent_of",
    "annotator",
    "common_columns",
    "scenes_to_learn",
    "score_agent",
]

MEASURES = (
    Measure("accuracy", "classified rightly"),
    Measure("answers", "answers, every relevant attribute"),
    Measure("answers_strict", "answers, those and no other"),
    Measure("explanations", "explanatory answers, every relevant attribute"),
    Measure("explanations_strict", "explanatory answers, those and no other"),
    Measure("explanations_sufficient", "explanatory answers whose reasons suffice"),
)


def annotator(scenes: Dataset) -> ReferenceAnswers:
    """Who annotates questions with answers: knows the full knowledge and all annotated scenes.

    The same answers train all systems and judge them.
    """
    agent = Agent(scenes.domain, eyes=NONE)
    experience = experience_of(scenes.vectors, scenes.classes)
    return ReferenceAnswers(scenes.domain, agent.reasoned, experience)


def score_agent(
    agent: Agent,
    test: Dataset,
    asked: list[Asked],
    reference: ReferenceAnswers,
    *,
    believing: bool = False,
) -> dict[str, Any]:
    """The measures of an agent on pictures and questions about them.

    With ``believing`` it may suppose what a question presumes; in all questions that is so.
    """
    found = agent.classify_all(test.pictures(test.domain.pictures.size))
    if not believing:
        found = [replace(classification, otherwise=()) for classification in found]
    replies = agent.answer_all(
        [(found[asked_question.picture], asked_question.question) for asked_question in asked]
    )
    labels = [classification.label for classification in found]
    vectors = [classification.vector for classification in found]
    return {
        "accuracy": _agreement(labels, test.classes),
        **answer_scores(
            asked,
            [reply.kind for reply in replies],
            test,
            reference,
            vectors=[reply.scene.vector for reply in replies],
            labels=[reply.scene.label for reply in replies],
        ),
        "features": _feature_accuracy(vectors, test),
        "by_knowledge": float(
            np.mean([classification.method == "knowledge" for classification in found])
        ),
    }


def _agreement(found: list[str | None] | list[str], true: list[str]) -> float:
    return float(np.mean([given == label for given, label in zip(found, true, strict=True)]))


def _feature_accuracy(vectors: list[Any], test: Dataset) -> float:
    pairs = zip(vectors, test.vectors, strict=True)
    return float(np.mean([a == b for read, true in pairs for a, b in zip(read, true, strict=True)]))


def agent_of(
    setting: Setting,
    seen: Seen,
    *,
    seed: int,
    gate: float | None = None,
    domain: Domain | None = None,
    learned: Sequence[Axiom] = (),
    withdrawn: Sequence[Withdrawn] = (),
) -> Agent:
    """An agent that sees what a trial's networks saw in the pictures to test on.

    It knows what ``domain`` says, the setting's where left out; see :class:`seewhy.Agent`.
    """
    agent = Agent(
        domain or setting.domain,
        seed=seed,
        eyes=NONE,
        known_share=1.0,
        gate=gate,
        learned=learned,
        withdrawn=withdrawn,
    )
    agent.extractor = Remembered(seen)  # type: ignore[assignment]
    return agent


def scenes_to_learn(setting: Setting, train: Dataset) -> tuple[list[Any], list[str]]:
    """The annotated scenes that the tree and the answers are learned from.

    Those of the training pictures, and of the drawings that networks saw before.
    """
    vectors, labels = list(train.vectors), list(train.classes)
    if setting.drawn:
        first, _ = pretrain(setting)
        vectors, labels = [*vectors, *first.vectors], [*labels, *first.labels]
    return vectors, labels


def common_columns(trial: Trial, seen: Seen) -> Row:
    """What all rows of a trial say."""
    train, test = seen.train.scenes, seen.test.scenes
    return {
        "seed": trial.seed,
        "size": trial.size,
        "trained": len(train),
        "tested": len(test),
        "determined": determined_share(test.vectors, test.classes),
    }


def run_trial(setting: Setting, trial: Trial) -> list[Row]:
    """Train all systems on one drawing of pictures and score them on another."""
    from seewhy_lab.experiments.end_to_end import EndToEnd

    seen = see(setting, trial)
    train, test = seen.train.scenes, seen.test.scenes
    reference = annotator(setting.scenes)
    agent = agent_of(setting, seen, seed=trial.seed)
    asked = draw_questions(agent.questions, test.classes, seed=trial.seed)
    common = common_columns(trial, seen)
    with_class = agent.reading == "with_class"

    began = time.process_time()
    agent.fit_induction(*scenes_to_learn(setting, train), reference=reference)
    fitted = time.process_time()
    ours = score_agent(agent, test, asked, reference)
    scored = time.process_time()
    believing = score_agent(agent, test, asked, reference, believing=True)
    again = time.process_time()
    baseline = EndToEnd(setting.domain, seen.train)
    baseline.fit_answers(agent.questions, reference, seed=trial.seed)
    answering = time.process_time()
    theirs = baseline.score(seen.test, asked, reference)
    ended = time.process_time()
    trained = {
        "weights": seen.weights + with_class * seen.weights_class,
        "seconds_networks": _seconds_networks(seen, with_class=with_class),
        "seconds_answers": round(fitted - began, 2),
    }
    return [
        {
            **common,
            "system": "seewhy",
            **ours,
            **trained,
            "seconds_test": round(scored - fitted, 2),
        },
        {
            **common,
            "system": "believing",
            **believing,
            **trained,
            "seconds_test": round(again - scored, 2),
        },
        {
            **common,
            "system": "end_to_end",
            **theirs,
            "weights": seen.weights + seen.weights_class,
            "seconds_networks": _seconds_networks(seen, with_class=True),
            "seconds_answers": round(answering - again, 2),
            "seconds_test": round(ended - answering, 2),
        },
        {**common, "system": "frozen", **_frozen(setting, train, test, seed=trial.seed)},
    ]


def _frozen(setting: Setting, train: Dataset, test: Dataset, *, seed: int) -> Row:
    """The columns of a backbone as it is with a regression of the class, which answers nothing."""
    began = time.process_time()
    drawn = None
    if setting.drawn:
        shown = drawings(setting)
        drawn = embedded(shown), shown.classes
    model = fit_frozen_features(
        embedded(train), train.classes, groups=train.groups, drawn=drawn, seed=seed
    )
    fitted = time.process_time()
    found = model.classify(embedded(test))
    return {
        "accuracy": _agreement(found, test.classes),
        # Embeddings that another trial made are found again.
        "seconds_networks": round(fitted - began, 2),
        "seconds_test": round(time.process_time() - fitted, 2),
    }


def _seconds_networks(seen: Seen, *, with_class: bool) -> float | None:
    """How long the networks were trained; None where another kind of machine did."""
    if seen.seconds_features is None or seen.seconds_class is None:
        return None
    return round(seen.seconds_features + with_class * seen.seconds_class, 2)


VQA = Experiment(
    name="vqa",
    title="Classes and answers against the number of training pictures",
    hypothesis=(
        "H1: with up to 1,000 training pictures the architecture classifies better than a network "
        "trained end to end, with more no worse; structures at least as well at every size. "
        "H2: it answers questions better at every size."
    ),
    systems={
        "seewhy": "SeeWhy",
        "believing": "SeeWhy, believing who asks",
        "end_to_end": "end to end",
        "frozen": "frozen features of a backbone and logistic regression",
    },
    measures=MEASURES,
    claims=(
        Claim(
            "accuracy",
            "seewhy",
            "end_to_end",
            equal_in=("structure_stability",),
            significant_to=1000,
        ),
        # What is asked is so of the picture: the network end to end learns from such questions
        # alone that it can rely on it, so it is compared with a SeeWhy that does.
        Claim("answers", "believing", "end_to_end"),
        Claim("answers_strict", "believing", "end_to_end"),
        Claim("explanations", "believing", "end_to_end"),
        Claim("explanations_strict", "believing", "end_to_end"),
        Claim("explanations_sufficient", "believing", "end_to_end"),
        Claim("answers", "seewhy", "end_to_end"),
        Claim("explanations_strict", "seewhy", "end_to_end"),
        # What the paper could not compare with: what few labels are given to today.
        Claim("accuracy", "seewhy", "frozen"),
    ),
    trial=run_trial,
    full={
        "structure_stability": Plan(trials=50, sizes=(100, 200, 400, 800, 1667)),
        "traffic_signs": Plan(trials=50, sizes=(100, 200, 500, 1000, 2000, 0)),
        "": Plan(trials=50, sizes=(100, 200, 400, 800), pictures=2000, tested=500),
    },
    quick={
        "traffic_signs": Plan(trials=2, sizes=(50, 100)),
        "": Plan(trials=3, sizes=(100, 300), pictures=900, tested=400),
    },
)
