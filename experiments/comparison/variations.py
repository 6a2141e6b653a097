"""How training pictures are varied: as SeeWhy chooses it from them, for all who vary them."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

import numpy as np

from seewhy.data.dataset import Dataset
from seewhy.perception.backbones import EMBEDDED, load_backbone
from seewhy.perception.domain_options import given_variations, seen_labels, seen_values
from seewhy.perception.embedding import embed_pictures
from seewhy.perception.embedding_cache import EmbeddingCache, cache_folder
from seewhy.perception.labels import labelled
from seewhy.perception.options import TrainingOptions
from seewhy.perception.validation import folds
from seewhy.perception.variations import chosen_variations

__all__ = ["same_variations", "varied"]

VARIATIONS = (
    "flip", "shift", "rotate", "scale", "shear", "brightness", "contrast", "colour", "noise",
)  # fmt: skip

_FOLDS, _JUDGED = 3, 2000  # as in seewhy.perception.fitting_eyes


def same_variations(train: Dataset, *, seed: int) -> TrainingOptions:
    """The variations that SeeWhy's eyes are tuned with on these pictures.

    What the domain says holds; whether pictures may be mirrored, turned and stretched is found
    out from the pictures and what is annotated of them.
    """
    domain = train.domain
    backbone = load_backbone(EMBEDDED)
    pictures = train.pictures(backbone.side)
    pooled = embed_pictures(backbone, [pictures], cache=EmbeddingCache(cache_folder())).pooled[
        :_JUDGED
    ]
    columns = seen_labels(domain, train.vectors, train.classes, with_class=True)
    targets = {}
    for name, values in seen_values(domain, with_class=True).items():
        rows, answers = labelled(columns[name], feature=name, values=values)
        targets[name] = np.full(len(train), -1, dtype=np.int64)
        targets[name][rows] = answers
    parts = folds(train.classes, count=_FOLDS, seed=seed, groups=train.groups)
    options, _ = chosen_variations(
        backbone,
        pictures[:_JUDGED],
        pooled,
        {name: column[:_JUDGED] for name, column in targets.items()},
        [part[part < _JUDGED] for part in parts],
        given=given_variations(domain),
        seed=seed,
    )
    return options


def varied(options: TrainingOptions) -> dict[str, Any]:
    """The variations among the options of a training.

    Examples
    --------
    >>> varied(TrainingOptions(rotate=12.0))["rotate"]
    12.0
    """
    described = asdict(options)
    return {name: described[name] for name in VARIATIONS}
