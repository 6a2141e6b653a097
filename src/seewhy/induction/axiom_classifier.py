"""Learned axioms as a classifier of scikit-learn: rules over the columns of a table."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from numpy.typing import ArrayLike
from sklearn.utils.validation import check_is_fitted

from seewhy.induction.axiom_learning import (
    Judgement,
    LearningOptions,
    decide_by_candidates,
    learn_axioms,
)
from seewhy.induction.feature_classifier import FeatureClassifier
from seewhy.induction.rule_table import rules_of_judgements
from seewhy.induction.tree import DecisionTree
from seewhy.knowledge.scene import FeatureVector

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["AxiomClassifier"]


class AxiomClassifier(FeatureClassifier):
    """Classes from feature vectors, by axioms learned from them.

    Every distinct value of a column is a category; whole numbers are compared. A value that was
    not there in training is one that is not known. A scene is of a class where all axioms that
    speak about it agree; what they leave open a decision tree classifies, as an agent does. Where
    axioms decide, the probability of their class is 1; else it is its share in a leaf of the tree.

    Parameters
    ----------
    support : float, default 0.1
        The least share, of the scenes that are left open, that an axiom must speak about.
    tolerance : float, default 0
        The share of the annotation that is taken to be wrong.
    seed : int, default 0
        Settles every random choice.

    Attributes
    ----------
    axioms_ : tuple of Judgement
        The candidates that became axioms, in the order in which they were found.
    tree_ : DecisionTree
        Of the scenes of training that the axioms leave open or get wrong; of all where there are
        none, for those to come.
    classes_ : ndarray

    See Also
    --------
    seewhy.induction.axiom_learning.learn_axioms : how they are learned.

    Examples
    --------
    >>> scenes = [["1", "no"], ["2", "no"], ["3", "no"], ["3", "yes"]] * 10
    >>> model = AxiomClassifier().fit(scenes, ["up", "up", "up", "down"] * 10)
    >>> for judgement in model.axioms_:
    ...     print(judgement.candidate.label, judgement.candidate.conditions)
    up (PathCondition(feature='x1', values=('no',)),)
    down (PathCondition(feature='x1', values=('yes',)),)
    >>> model.predict([["3", "yes"]]).tolist()
    ['down']
    """

    def __init__(self, *, support: float = 0.1, tolerance: float = 0.0, seed: int = 0) -> None:
        self.support = support
        self.tolerance = tolerance
        self.seed = seed

    def fit(self, X: ArrayLike, y: ArrayLike) -> AxiomClassifier:  # noqa: N803
        """Learn axioms, and grow the tree of what they leave open.

        Raises
        ------
        ValueError
            If there is nothing to learn from, or X and y do not fit together.
        """
        vectors, labels = self._read(X, y)
        self.axioms_: tuple[Judgement, ...] = learn_axioms(
            self.features_,
            vectors,
            labels,
            decide=decide_by_candidates(self.features_),
            options=LearningOptions(support=self.support, tolerance=self.tolerance, seed=self.seed),
        ).accepted
        decided = self._decided(vectors)
        left = [place for place, label in enumerate(labels) if decided[place] != label]
        places = left or range(len(labels))
        self.tree_ = DecisionTree(self.features_).fit(
            [vectors[place] for place in places],
            [labels[place] for place in places],
            seed=self.seed,
        )
        return self

    def get_rules(self) -> pd.DataFrame:
        """Return the axioms as a data frame, one a row, in the order in which they were found.

        Raises
        ------
        NotFittedError, SeeWhyError
            Scikit-learn's, if nothing was learned; if pandas is not installed.
        """
        check_is_fitted(self)
        return rules_of_judgements(self.axioms_)

    def _shares(self, vectors: Sequence[FeatureVector]) -> Iterator[Mapping[str, float]]:
        for vector, label in zip(vectors, self._decided(vectors), strict=True):
            yield self.tree_.probability(vector) if label is None else {label: 1.0}

    def _decided(self, vectors: Sequence[FeatureVector]) -> list[str | None]:
        """The classes by axioms alone; None where they say nothing, or contradict each other."""
        decide = decide_by_candidates(self.features_)
        candidates = [judgement.candidate for judgement in self.axioms_]
        return [decision.label for decision in decide(candidates, vectors)]
