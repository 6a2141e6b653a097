"""What everybody does with few labels today: a backbone as it is, and logistic regression."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from seewhy.data.dataset import Dataset
from seewhy.files.cache_folder import cache_folder
from seewhy.perception.backbones import EMBEDDED, load_backbone
from seewhy.perception.embedding import embed_pictures
from seewhy.perception.embedding_cache import EmbeddingCache
from seewhy.perception.heads import Projection, fit_projection
from seewhy.perception.validation import folds

__all__ = ["STRENGTHS", "Embeddings", "FrozenFeatures", "embedded", "fit_frozen_features"]

STRENGTHS = (0.0003, 0.001, 0.003, 0.01, 0.03, 0.1, 1.0)
"""Inverses of the penalty on weights that cross-validation chooses among."""

FOLDS = 5

_STEPS = 300  # of the optimiser, enough for standardised components

Embeddings = npt.NDArray[np.float16]
Components = npt.NDArray[np.float32]
Labels = npt.NDArray[Any]


@dataclass(frozen=True, eq=False)
class FrozenFeatures:
    """A regression of the class on what a backbone makes of pictures.

    Attributes
    ----------
    projection : Projection
    strength : float
        The inverse of the penalty that was chosen.
    right : dict of float to int
        Strength → how many pictures were classified rightly while they were kept out.
    """

    projection: Projection
    strength: float
    right: dict[float, int]
    model: Any

    def classify(self, pooled: Embeddings) -> list[str]:
        """The most probable class for each embedding, of shape (n, width)."""
        return [str(label) for label in self.model(self.projection(pooled))]


def embedded(scenes: Dataset) -> Embeddings:
    """What the backbone that comes with SeeWhy makes of pictures, shape (n, width)."""
    backbone = load_backbone(EMBEDDED)
    batches = scenes.iter_pictures(backbone.side)
    return embed_pictures(backbone, batches, cache=EmbeddingCache(cache_folder())).pooled


def fit_frozen_features(
    pooled: Embeddings,
    labels: Sequence[str],
    *,
    groups: Sequence[str],
    drawn: tuple[Embeddings, Sequence[str]] | None = None,
    seed: int,
) -> FrozenFeatures:
    """Standardise embeddings, take their principal components, regress the class on them.

    How strongly weights are held down is chosen by cross-validation, groups whole: the strength
    with which most held-out pictures are classified rightly, of equals the strongest penalty.

    Parameters
    ----------
    pooled : ndarray of float16, shape (n, width)
    labels, groups : sequence of str, length n
    drawn : tuple, optional
        Embeddings of drawings with their classes. They are there beside the pictures in every
        fit, and count as much as all these together.
    seed : int
        Of the components and of the parts that are kept out.
    """
    projection = fit_projection(pooled, seed=seed)
    rows, classes = projection(pooled), np.array(labels)
    parts = folds(list(labels), count=FOLDS, seed=seed, groups=groups)
    beside = rows[:0], classes[:0]
    if drawn is not None:
        beside = projection(drawn[0]), np.array(drawn[1])
    right = {
        strength: _held_out_right(rows, classes, parts, beside, strength) for strength in STRENGTHS
    }
    strength = max(STRENGTHS, key=lambda choice: (right[choice], -choice))
    return FrozenFeatures(projection, strength, right, _regression(rows, classes, beside, strength))


def _held_out_right(
    rows: Components,
    labels: Labels,
    parts: Sequence[npt.NDArray[np.int64]],
    beside: tuple[Components, Labels],
    strength: float,
) -> int:
    """How many pictures are classified rightly by what the other parts taught."""
    right = 0
    for part in parts:
        rest = np.setdiff1d(np.arange(len(rows)), part)
        if len(rest):
            found = _regression(rows[rest], labels[rest], beside, strength)(rows[part])
            right += int((found == labels[part]).sum())
    return right


def _regression(
    rows: Components, labels: Labels, beside: tuple[Components, Labels], strength: float
) -> Any:
    """Rows of components → their classes."""
    from sklearn.exceptions import ConvergenceWarning
    from sklearn.linear_model import LogisticRegression
    from threadpoolctl import threadpool_limits

    weights = np.ones(len(rows) + len(beside[0]))
    weights[len(rows) :] = len(rows) / max(1, len(beside[0]))
    rows, labels = np.concatenate([rows, beside[0]]), np.concatenate([labels, beside[1]])
    if len(set(labels)) < 2:
        return lambda others: np.repeat(labels[:1], len(others))
    model = LogisticRegression(C=strength, max_iter=_STEPS)
    # For matrices as small as these, threads wait for each other.
    with threadpool_limits(1), warnings.catch_warnings():
        warnings.simplefilter("ignore", ConvergenceWarning)
        # Many classes of few pictures each are no regression.
        warnings.simplefilter("ignore", UserWarning)
        model.fit(rows, labels, sample_weight=weights)
    return model.predict
