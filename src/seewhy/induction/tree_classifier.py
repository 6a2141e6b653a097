"""The decision tree as a classifier of scikit-learn: in its pipelines, searches and scores."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from numpy.typing import ArrayLike
from sklearn.utils.validation import check_is_fitted

from seewhy.induction.feature_classifier import FeatureClassifier
from seewhy.induction.tree import DecisionTree
from seewhy.knowledge.scene import FeatureVector

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["TreeClassifier"]


class TreeClassifier(FeatureClassifier):
    """Classes from feature vectors, by :class:`~seewhy.induction.tree.DecisionTree`.

    Every distinct value of a column is a category; whole numbers are compared. A value that was
    not there in training is one that is not known. The probability of a class is its share in the
    leaf of a scene.

    Parameters
    ----------
    smallest_leaf : int, optional
        Grow until a leaf cannot be divided into leaves of so many scenes, and prune nothing; where
        left out, how far the tree is pruned is chosen by cross-validation.
    seed : int, default 0
        Settles every random choice.

    Attributes
    ----------
    tree_ : DecisionTree
    classes_ : ndarray

    Examples
    --------
    >>> scenes = [["1", "no"], ["2", "no"], ["3", "no"], ["3", "yes"]] * 10
    >>> model = TreeClassifier().fit(scenes, ["up", "up", "up", "down"] * 10)
    >>> model.predict([["3", "yes"]]).tolist(), model.score(scenes, model.predict(scenes))
    (['down'], 1.0)
    """

    def __init__(self, *, smallest_leaf: int | None = None, seed: int = 0) -> None:
        self.smallest_leaf = smallest_leaf
        self.seed = seed

    def fit(self, X: ArrayLike, y: ArrayLike) -> TreeClassifier:  # noqa: N803
        """Grow the tree; see :meth:`seewhy.induction.tree.DecisionTree.fit`.

        Raises
        ------
        ValueError
            If there is nothing to learn from, or X and y do not fit together.
        """
        vectors, labels = self._read(X, y)
        self.tree_ = DecisionTree(self.features_).fit(
            vectors, labels, seed=self.seed, smallest_leaf=self.smallest_leaf
        )
        return self

    def get_rules(self) -> pd.DataFrame:
        """Return the paths as a data frame; see :meth:`DecisionTree.get_rules`."""
        check_is_fitted(self)
        return self.tree_.get_rules()

    def _shares(self, vectors: Sequence[FeatureVector]) -> Iterator[Mapping[str, float]]:
        return map(self.tree_.probability, vectors)
