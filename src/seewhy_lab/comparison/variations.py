"""How training pictures are varied: as SeeWhy chooses it from them, for all who vary them."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from seewhy.agent.teaching import lesson_of
from seewhy.data.dataset import Dataset
from seewhy.files.cache_folder import cache_folder
from seewhy.perception.backbones import EMBEDDED, load_backbone
from seewhy.perception.domain_options import given_variations
from seewhy.perception.embedding import embed_pictures
from seewhy.perception.embedding_cache import EmbeddingCache
from seewhy.perception.options import VARIATIONS, TrainingOptions
from seewhy.perception.variations import chosen_variations

__all__ = ["same_variations", "varied"]


def same_variations(train: Dataset, *, seed: int) -> TrainingOptions:
    """The variations that SeeWhy's eyes are tuned with on these pictures.

    What the domain says holds; whether pictures may be turned and stretched is found
    out from the pictures and what is annotated of them.
    """
    backbone = load_backbone(EMBEDDED)
    lesson = lesson_of(train, side=backbone.side)
    cache = EmbeddingCache(cache_folder())
    pooled = embed_pictures(backbone, lesson.batches(), cache=cache).pooled
    given = given_variations(train.domain)
    options, _ = chosen_variations(backbone, lesson, pooled, given=given, seed=seed)
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
