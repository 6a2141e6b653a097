"""A small head for each feature, on the layers of a backbone as they are."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from seewhy.perception.matrix_product import matrix_product

__all__ = ["Head", "Projection", "fit_head", "fit_projection"]

WIDTH = 200
"""Principal components that heads look at."""

STRENGTH = 0.01
"""The inverse of the penalty on a head's weights: few pictures have to settle many of them."""

_FROM = 2000  # pictures that settle the components: more change them little
_NEVER_SHOWN = -12.0  # logit of a value that no picture shows

Floats = npt.NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Projection:
    """Embeddings → what heads look at: standardised, then their principal components.

    Attributes
    ----------
    mean, scale : ndarray of float, shape (width of the embedding,)
    components : ndarray of float, shape (width of the embedding, components)
    """

    mean: Floats
    scale: Floats
    components: Floats

    def __call__(self, pooled: npt.NDArray[np.floating]) -> Floats:
        """Embeddings of shape (n, width) → (n, components)."""
        standardised: Floats = ((pooled - self.mean) / self.scale).astype(np.float32)
        return matrix_product(standardised, self.components)


@dataclass(frozen=True, eq=False)
class Head:
    """A linear map from components to the logits of a feature's values.

    Attributes
    ----------
    weight : ndarray of float, shape (values, components)
    bias : ndarray of float, shape (values,)
    """

    weight: Floats
    bias: Floats

    def __call__(self, projected: Floats) -> Floats:
        """Shape (n, components) → logits of shape (n, values)."""
        logits: Floats = matrix_product(projected, self.weight.T) + self.bias
        return logits


def fit_projection(pooled: npt.NDArray[np.floating], *, seed: int = 0) -> Projection:
    """The principal components of embeddings; no label has a say in them.

    Examples
    --------
    >>> pooled = np.random.default_rng(0).normal(size=(30, 7))
    >>> fit_projection(pooled)(pooled).shape
    (30, 7)
    """
    chosen = np.random.default_rng(seed).permutation(len(pooled))[:_FROM]
    some = pooled[np.sort(chosen)].astype(np.float32)
    mean, deviation = some.mean(axis=0), some.std(axis=0)
    scale = np.where(deviation > 1e-6, deviation, np.float32(1.0)).astype(np.float32)
    standardised = (some - mean) / scale
    width = min(WIDTH, *some.shape)
    # There are fewer pictures than numbers of each: what they have in common is a small matrix.
    squares, vectors = np.linalg.eigh(standardised @ standardised.T)
    largest = np.argsort(-squares, kind="stable")[:width]
    lengths = np.sqrt(np.maximum(squares[largest], 1e-6))
    components = standardised.T @ (vectors[:, largest] / lengths)
    return Projection(mean, scale, np.ascontiguousarray(components, dtype=np.float32))


def fit_head(
    projected: Floats,
    targets: npt.NDArray[np.int64],
    *,
    values: int,
    strength: float = STRENGTH,
) -> Head:
    """Logistic regression of a feature's values.

    Parameters
    ----------
    projected : ndarray of float, shape (n, components)
    targets : ndarray of int, shape (n,)
        The index of each picture's value.
    values : int
        Values that the feature may have; those that no picture shows get a low logit.
    strength : float, default 0.01
        The inverse of the penalty on the weights.

    Examples
    --------
    >>> shown = np.array([[0.0], [0.1], [9.0], [9.1]], dtype=np.float32)
    >>> fit_head(shown, np.array([0, 0, 2, 2]), values=3)(shown).argmax(axis=1).tolist()
    [0, 0, 2, 2]
    """
    from sklearn.linear_model import LogisticRegression
    from threadpoolctl import threadpool_limits

    weight = np.zeros((values, projected.shape[1]), dtype=np.float32)
    bias = np.full(values, _NEVER_SHOWN, dtype=np.float32)
    shown = np.unique(targets)
    if len(shown) < 2:
        bias[shown] = 0.0
        return Head(weight, bias)
    model = LogisticRegression(C=strength, max_iter=300)
    # For matrices as small as these, threads wait for each other.
    with threadpool_limits(1), warnings.catch_warnings():
        # Many classes of few pictures each are no regression.
        warnings.simplefilter("ignore", UserWarning)
        model.fit(projected, targets)
    rows: Sequence[npt.NDArray[np.float64]] = model.coef_
    if len(shown) == 2:
        weight[shown[1]], bias[shown] = rows[0], (0.0, model.intercept_[0])
    else:
        weight[shown], bias[shown] = rows, model.intercept_
    return Head(weight, bias)
