"""How often what is usual may be otherwise, by the one-standard-error rule of cross-validation."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from scipy.stats import sem
from sklearn.model_selection import GroupKFold

from seewhy.induction.axiom_learning import Decide, LearningOptions, decide_by_candidates
from seewhy.induction.candidate import Candidate
from seewhy.induction.scene_table import scene_table
from seewhy.knowledge.reasoner import Decision
from seewhy.knowledge.scene import FeatureVector
from seewhy.planning.learning.candidates import default_candidates
from seewhy.planning.learning.cases import Run
from seewhy.planning.learning.features import NO, YES, ArgumentFeatures

TOLERANCES = (0.0, 0.05, 0.1, 0.2, 0.3, 0.4)
_FOLDS = 5


def suggested_tolerance(
    features: ArgumentFeatures,
    vectors: Sequence[FeatureVector],
    labels: Sequence[str],
    runs: Sequence[Run],
    options: LearningOptions,
) -> float:
    """Return the greatest tolerance within a standard error of the one that predicts best.

    What the axioms learned from four fifths of the runs predict is held against the rest; ``runs``
    says of which run each case is.
    """
    folds = min(_FOLDS, len(set(runs)))
    if folds < 2:
        return 0.0
    scores = []
    for tolerance in TOLERANCES:
        right = []
        for train, test in GroupKFold(folds).split(vectors, labels, runs):
            predict = _predictor(
                features,
                [vectors[n] for n in train],
                [labels[n] for n in train],
                replace(options, tolerance=tolerance),
            )
            predicted = predict([vectors[n] for n in test])
            right.append(np.mean([predicted[m] == labels[n] for m, n in enumerate(test)]))
        scores.append(right)
    means = np.mean(scores, axis=1)
    best = int(np.argmax(means))
    least = means[best] - sem(scores[best])
    return max(
        tolerance for tolerance, mean in zip(TOLERANCES, means, strict=True) if mean >= least
    )


def _predictor(
    features: ArgumentFeatures,
    vectors: Sequence[FeatureVector],
    labels: Sequence[str],
    options: LearningOptions,
) -> Callable[[Sequence[FeatureVector]], list[str]]:
    """Learn from some cases alone; where no axiom says that a fluent holds, it does not."""
    decide = decide_what_holds(features)
    table = scene_table(features.values, vectors, labels)
    holding = default_candidates(features, table, decide, options)
    return lambda some: [decision.label or NO for decision in decide(holding, some)]


def decide_what_holds(features: ArgumentFeatures) -> Decide:
    """Return how candidates decide of which only those become axioms by which something holds."""
    by_all = decide_by_candidates(features.values)

    def decide(some: Sequence[Candidate], asked: Sequence[FeatureVector]) -> Sequence[Decision]:
        return by_all([candidate for candidate in some if candidate.label == YES], asked)

    return decide
