"""The decision tree as a classifier of scikit-learn: in its pipelines, searches and scores."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from sklearn.base import BaseEstimator, ClassifierMixin
from sklearn.utils.multiclass import check_classification_targets
from sklearn.utils.validation import check_is_fitted, validate_data

from seewhy.induction.tree import DecisionTree

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["TreeClassifier"]


class TreeClassifier(ClassifierMixin, BaseEstimator):  # type: ignore[misc]
    """Classes from feature vectors, by :class:`~seewhy.induction.tree.DecisionTree`.

    Every distinct value of a column is a category; whole numbers are compared. A value that was
    not there in training is one that is not known.

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
        table, labels = validate_data(self, X, y, dtype=None, ensure_all_finite=True)
        check_classification_targets(labels)
        self.classes_ = np.unique(labels)
        columns = [sorted({_word(value) for value in column}) for column in table.T]
        names = getattr(self, "feature_names_in_", [f"x{n}" for n in range(len(columns))])
        self.tree_ = DecisionTree(dict(zip(map(str, names), columns, strict=True))).fit(
            _vectors(table, columns),
            [str(label) for label in labels],
            seed=self.seed,
            smallest_leaf=self.smallest_leaf,
        )
        return self

    def predict_proba(self, X: ArrayLike) -> NDArray[np.float64]:  # noqa: N803
        """Return the share of each class in the leaf of each scene, shape (scenes, classes)."""
        check_is_fitted(self)
        table = validate_data(self, X, dtype=None, ensure_all_finite=True, reset=False)
        column_of = {str(label): column for column, label in enumerate(self.classes_)}
        shares = np.zeros((len(table), len(self.classes_)))
        for row, vector in enumerate(_vectors(table, [*self.tree_.features.values()])):
            for label, share in self.tree_.probability(vector).items():
                shares[row, column_of[label]] = share
        return shares

    def predict(self, X: ArrayLike) -> NDArray[Any]:  # noqa: N803
        """Return the class of each scene."""
        shares = self.predict_proba(X)
        predicted: NDArray[Any] = self.classes_[np.argmax(shares, axis=1)]
        return predicted

    def get_rules(self) -> pd.DataFrame:
        """Return the paths as a data frame; see :meth:`DecisionTree.get_rules`."""
        check_is_fitted(self)
        return self.tree_.get_rules()

    def __sklearn_tags__(self) -> Any:
        tags = super().__sklearn_tags__()
        tags.input_tags.string = True
        tags.input_tags.categorical = True
        return tags


def _word(value: Any) -> str:
    """A value of a table as a feature's value: whole numbers are said as such."""
    if isinstance(value, float | np.floating) and float(value).is_integer():
        return str(int(value))
    return str(value)


def _vectors(table: NDArray[Any], columns: Sequence[Sequence[str]]) -> list[tuple[str | None, ...]]:
    known = [frozenset(values) for values in columns]
    return [
        tuple(
            word if (word := _word(value)) in values else None
            for value, values in zip(row, known, strict=True)
        )
        for row in table
    ]
