"""(b) One small network from the picture to the class, with the same variations of pictures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, replace
from functools import cache

from seewhy.data.dataset import Dataset
from seewhy.domain.tables import CLASS
from seewhy.perception.epochs import planned_epochs
from seewhy.perception.extractor import FeatureExtractor
from seewhy.perception.options import TrainingOptions
from seewhy.perception.rehearsal import Rehearsal
from seewhy_lab.comparison.system import Drawings, Fitted
from seewhy_lab.comparison.variations import same_variations
from seewhy_lab.experiments.seeing import class_network

__all__ = ["fit_small_network"]

DEPTH = 4
PASSES = 60
CHANNELS, DENSE = (16, 32, 64, 128), 128
BATCH = 32

_DRAWN_GONE_OVER = 200_000  # drawings gone over in all, at most


def fit_small_network(train: Dataset, seed: int, drawings: Drawings | None) -> Fitted:
    """Train a network of four convolutions for the class, for sixty passes, on every picture.

    None is kept for validation, and nothing grows or stops early: the last weights are taken.
    """
    first, rehearsal = _knowing_drawings(drawings) if drawings else (None, None)
    options = _options(train, seed=seed, fine_tune=drawings is not None)
    network = class_network(train, options, start_from=first, rehearsal=rehearsal)
    classes, size = tuple(train.domain.classes), train.domain.pictures.size

    def classify(pictures: Dataset) -> Sequence[str | None]:
        found = network.probabilities(pictures.pictures(size))[CLASS]
        return [classes[n] for n in found.argmax(axis=1)]

    return Fitted(classify, {**asdict(options), "size": size})


@cache
def _knowing_drawings(drawings: Drawings) -> tuple[FeatureExtractor, Rehearsal]:
    """The network after sixty passes, or as many as there is patience for, over drawings."""
    scenes = drawings.scenes()
    options = _options(scenes, seed=0, fine_tune=False)
    fewer = max(1, options.max_epochs * _DRAWN_GONE_OVER // (PASSES * len(scenes)))
    options = replace(options, max_epochs=min(options.max_epochs, fewer))
    pictures = scenes.pictures(scenes.domain.pictures.size)
    return class_network(scenes, options), Rehearsal(pictures, {CLASS: scenes.classes})


def _options(train: Dataset, *, seed: int, fine_tune: bool) -> TrainingOptions:
    return replace(
        same_variations(train, seed=seed),
        depth=DEPTH,
        channels=CHANNELS,
        dense=DENSE,
        max_epochs=epochs_for(PASSES, pictures=len(train), fine_tune=fine_tune),
        growing_epochs=1,
        threshold=0.0,
        patience=10_000,
        batch_size=BATCH,
        validation_share=0.0,
        standard=train.domain.pictures.standard,
        seed=seed,
    )


def epochs_for(passes: int, *, pictures: int, fine_tune: bool = False) -> int:
    """The ``max_epochs`` that mean so many passes over so many pictures, or as near as can be.

    Examples
    --------
    >>> from seewhy.perception.epochs import planned_epochs
    >>> [planned_epochs(epochs_for(60, pictures=n), pictures=n) for n in (100, 500, 1667, 9000)]
    [60, 60, 60, 60]
    """
    return min(
        range(1, 4 * passes + 1),
        key=lambda epochs: abs(
            planned_epochs(epochs, pictures=pictures, fine_tune=fine_tune) - passes
        ),
    )
