"""What the classifiers of scikit-learn here have in common: tables whose columns are features."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from sklearn.base import BaseEstimator, ClassifierMixin
from sklearn.utils.multiclass import check_classification_targets
from sklearn.utils.validation import check_is_fitted, validate_data

from seewhy.knowledge.scene import FeatureVector

__all__ = ["FeatureClassifier"]


class FeatureClassifier(ClassifierMixin, BaseEstimator):  # type: ignore[misc]
    """A classifier of feature vectors, as a table says them.

    Every distinct value of a column is a category; whole numbers are compared. A value that was
    not there in training is one that is not known.

    Attributes
    ----------
    classes_ : ndarray
    features_ : dict of str to list of str
        Column → its values.
    """

    @abstractmethod
    def _shares(self, vectors: Sequence[FeatureVector]) -> Iterable[Mapping[str, float]]:
        """How probable each class of each scene is; a class that is not named is not."""

    def _read(self, X: ArrayLike, y: ArrayLike) -> tuple[list[FeatureVector], list[str]]:  # noqa: N803
        """The feature vectors and classes of a table to learn from; what they can be is kept."""
        table, labels = validate_data(self, X, y, dtype=None, ensure_all_finite=True)
        check_classification_targets(labels)
        self.classes_ = np.unique(labels)
        columns = [sorted({_word(value) for value in column}) for column in table.T]
        names = getattr(self, "feature_names_in_", [f"x{n}" for n in range(len(columns))])
        self.features_ = dict(zip(map(str, names), columns, strict=True))
        return _vectors(table, columns), [str(label) for label in labels]

    def predict_proba(self, X: ArrayLike) -> NDArray[np.float64]:  # noqa: N803
        """Return how probable each class of each scene is, shape (scenes, classes)."""
        check_is_fitted(self)
        table = validate_data(self, X, dtype=None, ensure_all_finite=True, reset=False)
        column_of = {str(label): column for column, label in enumerate(self.classes_)}
        found = np.zeros((len(table), len(self.classes_)))
        vectors = _vectors(table, [*self.features_.values()])
        for row, shares in enumerate(self._shares(vectors)):
            for label, share in shares.items():
                found[row, column_of[label]] = share
        return found

    def predict(self, X: ArrayLike) -> NDArray[Any]:  # noqa: N803
        """Return the class of each scene."""
        shares = self.predict_proba(X)
        predicted: NDArray[Any] = self.classes_[np.argmax(shares, axis=1)]
        return predicted

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


def _vectors(table: NDArray[Any], columns: Sequence[Sequence[str]]) -> list[FeatureVector]:
    known = [frozenset(values) for values in columns]
    return [
        tuple(
            word if (word := _word(value)) in values else None
            for value, values in zip(row, known, strict=True)
        )
        for row in table
    ]
