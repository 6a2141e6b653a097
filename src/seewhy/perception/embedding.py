"""Embeddings of pictures and of variations of them, each made once."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict

import numpy as np
import numpy.typing as npt
import torch

from seewhy.perception.augmentation import augment
from seewhy.perception.backbones.backbone import Backbone, Embedded, Maps
from seewhy.perception.embedding_cache import EmbeddingCache, key_of
from seewhy.perception.options import VARIATIONS, TrainingOptions
from seewhy.perception.side_by_side import side_by_side

__all__ = ["embed_pictures", "embed_variations"]

Pictures = npt.NDArray[np.uint8]
Told = Callable[[int], None]


def embed_pictures(
    backbone: Backbone,
    batches: Iterable[Pictures],
    *,
    cache: EmbeddingCache,
    on_picture: Told | None = None,
) -> Embedded:
    """What a backbone makes of pictures, in their order.

    Parameters
    ----------
    backbone : Backbone
    batches : iterable of ndarray of uint8, each of shape (some, side, side, 3)
    cache : EmbeddingCache
        Where known embeddings are found and new ones kept.
    on_picture : callable, optional
        Called with the number of pictures looked at so far.
    """
    parts: list[Embedded] = []
    done = 0
    for pictures in batches:
        parts.append(_embedded(backbone, pictures, cache))
        done += len(pictures)
        if on_picture is not None:
            on_picture(done)
    return Embedded(
        np.concatenate([part.pooled for part in parts]),
        np.concatenate([part.middle for part in parts]),
    )


def _embedded(backbone: Backbone, pictures: Pictures, cache: EmbeddingCache) -> Embedded:
    pooled_keys = [key_of(picture, backbone.digest, "pooled") for picture in pictures]
    middle_keys = [key_of(picture, backbone.digest, "middle") for picture in pictures]
    pooled, middle = cache.find(pooled_keys), cache.find(middle_keys)
    pairs = list(zip(pooled_keys, middle_keys, strict=True))
    new = [n for n, (one, other) in enumerate(pairs) if one not in pooled or other not in middle]
    if new:
        seen = backbone.embed(pictures[new])
        pooled |= {pooled_keys[n]: row for n, row in zip(new, seen.pooled, strict=True)}
        middle |= {middle_keys[n]: row for n, row in zip(new, seen.middle, strict=True)}
        made = {key: pooled[key] for key in (pooled_keys[n] for n in new)}
        cache.keep(made | {key: middle[key] for key in (middle_keys[n] for n in new)})
    return Embedded(
        np.stack([pooled[key] for key in pooled_keys]),
        np.stack([middle[key] for key in middle_keys]),
    )


def embed_variations(
    backbone: Backbone,
    batches: Iterable[Pictures],
    options: TrainingOptions,
    *,
    views: int,
    count: int,
    cache: EmbeddingCache,
    on_picture: Told | None = None,
) -> Maps:
    """The maps from which tuned stages go on, of variations of pictures.

    A picture's variations depend on nothing but the picture and the options.

    Parameters
    ----------
    backbone : Backbone
    batches : iterable of ndarray of uint8, each of shape (some, side, side, 3)
    options : TrainingOptions
        How pictures may be varied.
    views : int
        Variations of each picture.
    count : int
        Pictures in all.
    cache, on_picture
        As for :func:`embed_pictures`.

    Returns
    -------
    ndarray of float16, shape (count, views, channels, rows, columns)
    """
    described = repr((sorted(_variations(options).items()), views))
    found: Maps | None = None
    done = 0
    for pictures in batches:
        keys = [key_of(picture, backbone.digest, described) for picture in pictures]
        known = cache.find(keys)
        new = [n for n, key in enumerate(keys) if key not in known]

        def look(n: int, pictures: Pictures = pictures, keys: Sequence[bytes] = keys) -> Maps:
            return _varied(backbone, pictures[n], options, views=views, seed=keys[n])

        made = dict(zip([keys[n] for n in new], side_by_side(look, new), strict=True))
        cache.keep(made)
        known |= made
        for key in keys:
            if found is None:
                found = np.empty((count, *known[key].shape), dtype=np.float16)
            found[done] = known[key]
            done += 1
        if on_picture is not None:
            on_picture(done)
    return found if found is not None else np.empty((0, views, 0, 0, 0), dtype=np.float16)


def _varied(
    backbone: Backbone, picture: Pictures, options: TrainingOptions, *, views: int, seed: bytes
) -> Maps:
    generator = torch.Generator().manual_seed(
        int.from_bytes(hashlib.sha256(seed).digest()[:7], "big")
    )
    same = torch.from_numpy(picture)[None].expand(views, -1, -1, -1)
    return backbone.middle(augment(same, options, generator=generator).clamp(0, 255))


def _variations(options: TrainingOptions) -> dict[str, object]:
    described = asdict(options)
    return {name: described[name] for name in VARIATIONS}
