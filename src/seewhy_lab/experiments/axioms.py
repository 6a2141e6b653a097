"""H3: axioms are removed and learned again, from classes alone and from reasons as well."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from seewhy.agent.agent import Agent
from seewhy.agent.learning_from_pictures import AnnotatedScenes, axioms_of, learn_for_domain
from seewhy.agent.refutation import refuted
from seewhy.dialogue.question import Asks, Questions
from seewhy.dialogue.reference import ReferenceAnswers
from seewhy.domain.domain import Domain
from seewhy.induction.axiom_learning import LearningOptions
from seewhy.induction.scene_table import Reasons
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.learned_file import Withdrawn
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector
from seewhy_lab.experiments.drawing import available
from seewhy_lab.experiments.experiment import (
    ALL,
    Claim,
    Experiment,
    Measure,
    Plan,
    Row,
    Setting,
    Trial,
)
from seewhy_lab.experiments.questioning import draw_questions
from seewhy_lab.experiments.seeing import see
from seewhy_lab.experiments.vqa import MEASURES, agent_of, annotator, common_columns, score_agent

__all__ = ["AXIOMS", "agreement", "explanations", "incomplete", "learned_again"]

REMOVED = {"structure_stability": 0.5}
"""Domain → share of the axioms that is removed; of all others a quarter."""

TOLERANCE = {"structure_stability": 0.05}
"""Domain → share of annotations that learning takes to be wrong; of all others none.

Structures fall or stand by what the four features do not say, too: of one feature vector, a few
are always otherwise.
"""

LARGEST = {"structure_stability": 1667, "traffic_signs": 2000}
"""Domain → pictures that the networks are trained on, unless axioms are learned from more scenes.

The sizes then differ in the scenes alone, and the networks are those that ``vqa`` trains.
"""

NETWORKS = 5
"""Networks are trained for five seeds; trial after trial takes those of the next."""


def incomplete(domain: Domain, *, seed: int) -> Domain:
    """The domain without a random share of its axioms."""
    axioms = domain.knowledge.axioms
    number = round(REMOVED.get(domain.name, 0.25) * len(axioms))
    gone = set(np.random.default_rng(seed).permutation(len(axioms))[:number].tolist())
    kept = tuple(axiom for n, axiom in enumerate(axioms) if n not in gone)
    return replace(domain, knowledge=replace(domain.knowledge, axioms=kept))


def learned_again(
    domain: Domain, scenes: AnnotatedScenes
) -> tuple[tuple[Axiom, ...], tuple[Withdrawn, ...]]:
    """The axioms that a domain learns from annotated scenes, and those that it sets aside.

    What a lost fact made wrong is set aside first, as ``seewhy learn`` does.
    """
    tolerance = TOLERANCE.get(domain.name, 0.0)
    wrong = refuted(domain, scenes, tolerance=tolerance)
    aside = [axiom for axiom, _ in wrong]
    rest = tuple(axiom for axiom in domain.knowledge.axioms if axiom not in aside)
    right = replace(domain, knowledge=replace(domain.knowledge, axioms=rest))
    found = learn_for_domain(right, scenes, options=LearningOptions(tolerance=tolerance))
    axioms = axioms_of(right, [judgement.candidate for judgement in found.accepted], scenes)
    return axioms, tuple(withdrawn for _, withdrawn in wrong)


def explanations(
    reference: ReferenceAnswers,
    questions: Questions,
    vectors: Sequence[FeatureVector],
    labels: Sequence[str],
) -> tuple[Reasons | None, ...]:
    """What the annotator answers when asked why each scene is of its class, as features."""
    why = {
        question.label: question for question in questions.all if question.asks is Asks.WHY_CLASS
    }
    said = (
        reference.answer(why[label], vector, label).mentions if label in why else ()
        for vector, label in zip(vectors, labels, strict=True)
    )
    return tuple(frozenset(mentioned) or None for mentioned in said)


def agreement(known: Reasoner, full: Reasoner, vectors: list[FeatureVector]) -> float:
    """The share of the scenes that the full knowledge decides which are decided alike."""
    pairs = zip(known.decide_all(vectors), full.decide_all(vectors), strict=True)
    same = [decision.label == whole.label for decision, whole in pairs if whole.label is not None]
    return float(np.mean(same)) if same else 1.0


def run_trial(setting: Setting, trial: Trial) -> list[Row]:
    """Remove axioms, learn from annotated scenes twice, and score four times.

    First from features and classes alone, as in the paper; then the annotator, whose answers the
    recurrent network learns in all four, is asked why each scene is of its class.
    """
    given = setting.domain
    seed = trial.seed % NETWORKS
    largest = LARGEST.get(given.name, ALL)
    enough = trial.size != ALL and trial.size <= largest <= available(setting, seed)
    seen = see(setting, Trial(seed, largest if enough else ALL))
    train, test = seen.train.scenes, seen.test.scenes
    rng = np.random.default_rng([trial.seed, trial.size])
    order = rng.permutation(len(train))
    chosen = order if trial.size == ALL else order[: trial.size]
    vectors = [train.vectors[n] for n in chosen]
    labels = [train.classes[n] for n in chosen]
    scenes = AnnotatedScenes(tuple(vectors), tuple(labels), ("",) * len(vectors))
    reference = annotator(setting.scenes)
    whole = Agent(given)
    full = whole.reasoner
    reasons = explanations(reference, whole.questions, vectors, labels)
    less = incomplete(given, seed=trial.seed)
    began = time.process_time()
    axioms, aside = learned_again(less, scenes)
    middle = time.process_time()
    explained, set_aside = learned_again(less, replace(scenes, reasons=reasons))
    seconds = {"learned": middle - began, "explained": time.process_time() - middle}
    rows = []
    for system, domain, more, gone in (
        ("incomplete", less, (), ()),
        ("learned", less, axioms, aside),
        ("explained", less, explained, set_aside),
        ("full", given, (), ()),
    ):
        agent = agent_of(
            setting, seen, seed=trial.seed, domain=domain, learned=more, withdrawn=gone
        )
        agent.fit_induction(vectors, labels, reference=reference)
        asked = draw_questions(agent.questions, test.classes, seed=trial.seed)
        row: dict[str, Any] = {
            **common_columns(trial, seen),
            "trained": len(vectors),
            "system": system,
            **score_agent(agent, test, asked, reference),
            "agreement": agreement(agent.reasoner, full, test.vectors),
            "axioms": len(agent.domain.knowledge.axioms),
        }
        if system in seconds:
            row |= {
                "added": len(more),
                "set_aside": len(gone),
                "seconds_learning": seconds[system],
            }
        rows.append(row)
    return rows


AXIOMS = Experiment(
    name="axioms",
    title="Axioms removed and learned again",
    hypothesis=(
        "H3: reasoning with axioms learned from annotated scenes classifies and answers better "
        "than reasoning without them."
    ),
    systems={
        "incomplete": "incomplete knowledge",
        "learned": "axioms learned from classes",
        "explained": "axioms learned from classes and reasons",
        "full": "full knowledge",
    },
    measures=(
        *MEASURES,
        Measure("by_knowledge", "decided by the knowledge"),
        Measure("agreement", "annotated scenes decided as by the full knowledge"),
    ),
    claims=tuple(
        Claim(measure, system, "incomplete")
        for system in ("explained", "learned")
        for measure in (
            "accuracy",
            "answers",
            "answers_strict",
            "explanations_strict",
            "explanations_sufficient",
            "agreement",
        )
    ),
    trial=run_trial,
    full={
        "structure_stability": Plan(trials=30, sizes=(100, 200, 500, 1000, 1667)),
        "traffic_signs": Plan(trials=30, sizes=(100, 200, 500, 1000, 2000)),
        "": Plan(trials=30, sizes=(100, 400)),
    },
    quick={
        "traffic_signs": Plan(trials=2, sizes=(50, 100)),
        "": Plan(trials=3, sizes=(100, 300), pictures=900, tested=400),
    },
    across="annotated scenes to learn from",
)
