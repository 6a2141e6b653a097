"""(c) The backbone as it is, and logistic regression of the class on its embeddings."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from functools import cache
from typing import Any

import numpy as np
import numpy.typing as npt

from comparison.system import Drawings, Fitted
from seewhy.data.dataset import Dataset
from seewhy.perception.backbones import EMBEDDED, load_backbone
from seewhy.perception.backbones.backbone import Backbone
from seewhy.perception.embedding import embed_pictures
from seewhy.perception.embedding_cache import EmbeddingCache, cache_folder
from seewhy.perception.heads import fit_projection
from seewhy.perception.validation import folds

__all__ = ["fit_frozen_features"]

STRENGTHS = (0.0003, 0.001, 0.003, 0.01, 0.03, 0.1, 1.0)
"""Inverses of the penalty on weights that cross-validation chooses among."""

FOLDS = 5

_STEPS = 300  # of the optimiser, enough for standardised components

Floats = npt.NDArray[np.float32]
Labelled = tuple[Floats, npt.NDArray[Any]]


def fit_frozen_features(train: Dataset, seed: int, drawings: Drawings | None) -> Fitted:
    """Standardise embeddings, take their principal components, regress the class on them.

    How strongly weights are held down is chosen by cross-validation, groups whole: the strength
    with which most held-out pictures are classified rightly, of equals the strongest penalty.
    Drawings are there beside the pictures in every fit, and count as much as all these together.
    """
    backbone = load_backbone(EMBEDDED)
    pooled = _embedded(backbone, train)
    projection = fit_projection(pooled, seed=seed)
    rows, labels = projection(pooled), np.array(train.classes)
    parts = folds(train.classes, count=FOLDS, seed=seed, groups=train.groups)
    drawn = _no_rows(rows, labels)
    if drawings is not None:
        embedded, drawn_labels = _embedded_drawings(drawings)
        drawn = projection(embedded), drawn_labels
    right = {
        strength: _held_out_right(rows, labels, parts, drawn, strength) for strength in STRENGTHS
    }
    strength = max(STRENGTHS, key=lambda choice: (right[choice], -choice))
    model = _regression(rows, labels, drawn, strength)

    def classify(pictures: Dataset) -> Sequence[str | None]:
        return [str(label) for label in model(projection(_embedded(backbone, pictures)))]

    options = {
        "backbone": backbone.name,
        "strength": strength,
        "held_out_right": {str(choice): count for choice, count in right.items()},
    }
    return Fitted(classify, options)


def _embedded(backbone: Backbone, scenes: Dataset) -> npt.NDArray[np.float16]:
    batches = scenes.iter_pictures(backbone.side)
    return embed_pictures(backbone, batches, cache=EmbeddingCache(cache_folder())).pooled


@cache
def _embedded_drawings(drawings: Drawings) -> tuple[npt.NDArray[np.float16], npt.NDArray[Any]]:
    scenes = drawings.scenes()
    return _embedded(load_backbone(EMBEDDED), scenes), np.array(scenes.classes)


def _no_rows(rows: Floats, labels: npt.NDArray[Any]) -> Labelled:
    return rows[:0], labels[:0]


def _held_out_right(
    rows: Floats,
    labels: npt.NDArray[Any],
    parts: Sequence[npt.NDArray[np.int64]],
    drawn: Labelled,
    strength: float,
) -> int:
    """How many pictures are classified rightly by what the other parts taught."""
    right = 0
    for part in parts:
        rest = np.setdiff1d(np.arange(len(rows)), part)
        if len(rest):
            found = _regression(rows[rest], labels[rest], drawn, strength)(rows[part])
            right += int((found == labels[part]).sum())
    return right


def _regression(rows: Floats, labels: npt.NDArray[Any], drawn: Labelled, strength: float) -> Any:
    """Rows of components → their classes."""
    from sklearn.exceptions import ConvergenceWarning
    from sklearn.linear_model import LogisticRegression
    from threadpoolctl import threadpool_limits

    weights = np.ones(len(rows) + len(drawn[0]))
    weights[len(rows) :] = len(rows) / max(1, len(drawn[0]))
    rows, labels = np.concatenate([rows, drawn[0]]), np.concatenate([labels, drawn[1]])
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
