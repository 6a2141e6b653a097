"""(c) The backbone as it is, and logistic regression of the class on its embeddings."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

from seewhy.data.dataset import Dataset
from seewhy.perception.backbones import EMBEDDED
from seewhy_lab.comparison.system import Drawings, Fitted
from seewhy_lab.experiments.frozen_features import Embeddings, embedded
from seewhy_lab.experiments.frozen_features import fit_frozen_features as regress

__all__ = ["fit_frozen_features"]


def fit_frozen_features(train: Dataset, seed: int, drawings: Drawings | None) -> Fitted:
    """See :func:`seewhy_lab.experiments.frozen_features.fit_frozen_features`."""
    model = regress(
        embedded(train),
        train.classes,
        groups=train.groups,
        drawn=None if drawings is None else _embedded_drawings(drawings),
        seed=seed,
    )

    def classify(pictures: Dataset) -> Sequence[str | None]:
        return model.classify(embedded(pictures))

    options = {
        "backbone": EMBEDDED,
        "strength": model.strength,
        "held_out_right": {str(choice): count for choice, count in model.right.items()},
    }
    return Fitted(classify, options)


@cache
def _embedded_drawings(drawings: Drawings) -> tuple[Embeddings, Sequence[str]]:
    scenes = drawings.scenes()
    return embedded(scenes), scenes.classes
