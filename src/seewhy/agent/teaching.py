"""Teach eyes by the annotated pictures of a dataset."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from seewhy.agent.settings import Settings
from seewhy.files.cache_folder import cache_folder
from seewhy.perception.backbones import load_backbone
from seewhy.perception.course import Course
from seewhy.perception.domain_options import given_variations, seen_labels, seen_values
from seewhy.perception.embedding_cache import EmbeddingCache
from seewhy.perception.eyes import SCENE, Eyes
from seewhy.perception.familiarity import MOST, Familiarity, TrainingPicture, fit_familiarity
from seewhy.perception.fitting_eyes import FittedEyes, fit_eyes
from seewhy.perception.lesson import Lesson

if TYPE_CHECKING:
    from seewhy.data.dataset import Dataset

__all__ = ["familiar_scores", "lesson_of", "teach_eyes"]

_KEPT_IN_MEMORY = 5000
"""Up to so many pictures are read once; of more, those at hand are in the memory alone."""

_MOST = 2000  # training pictures whose likeness to the others is taken


def lesson_of(scenes: Dataset, *, side: int) -> Lesson:
    """The lesson of annotated scenes: every feature, and the class.

    Parameters
    ----------
    scenes : Dataset
        Each with something annotated.
    side : int
        Of the pictures, in pixels.
    """
    domain = scenes.domain
    if len(scenes) <= _KEPT_IN_MEMORY:
        scenes.pictures(side)
    vectors = [scene.vector for scene in scenes.scenes]  # without the things in them
    return Lesson(
        batches=lambda: scenes.iter_pictures(side),
        labels=seen_labels(domain, vectors, scenes.labels, with_class=True),
        values=seen_values(domain, with_class=True),
        strata=[label or vector for label, vector in zip(scenes.labels, vectors, strict=True)],
        groups=scenes.groups,
    )


def teach_eyes(
    scenes: Dataset, settings: Settings, *, start_from: Eyes | None = None, course: Course
) -> FittedEyes:
    """Teach eyes the features and the class of annotated scenes.

    Parameters
    ----------
    scenes : Dataset
        Each with something annotated.
    settings : Settings
        Which backbone is to see, where it computes, and the seed.
    start_from : Eyes, optional
        Earlier ones, whose tuned layers are tuned further.
    course : Course
        How the training is run.
    """
    backbone = load_backbone(settings.eyes, device=settings.device)
    same = start_from is not None and start_from.backbone.digest == backbone.digest
    return fit_eyes(
        backbone,
        lesson_of(scenes, side=backbone.side),
        given=given_variations(scenes.domain),
        start_from=start_from if same else None,
        cache=EmbeddingCache(cache_folder()),
        seed=settings.seed,
        course=course,
    )


def familiar_scores(
    embeddings: npt.NDArray[np.float32],
    groups: list[str],
    *,
    pictures: Sequence[TrainingPicture] = (),
    seed: int = 0,
) -> tuple[Familiarity, list[float]]:
    """What is known of training pictures, and how like each is to those of other groups.

    The backbone was not trained on them, so that each tells how like the others a new one is.

    Parameters
    ----------
    embeddings : ndarray of float, shape (n, width)
    groups : list of str, length n
    pictures : sequence of TrainingPicture, length n, optional
        Which pictures they are, to be named where another is like them.
    seed : int, default 0

    Returns
    -------
    familiarity : Familiarity
    scores : list of float
    """
    familiarity = fit_familiarity(
        {SCENE: embeddings},
        {SCENE: [SCENE] * len(embeddings)},
        seed=seed,
        kept=MOST,
        pictures=pictures,
    )
    chosen = np.random.default_rng(seed).permutation(len(embeddings))[:_MOST]
    lengths = np.maximum(np.linalg.norm(embeddings[chosen], axis=1, keepdims=True), 1e-9)
    directions = embeddings[chosen] / lengths
    likeness = directions @ directions.T
    names, codes = np.unique(np.array(groups)[chosen], return_inverse=True)
    likeness[codes[:, None] == codes[None, :]] = 0.0
    return familiarity, likeness.max(axis=1).tolist() if len(names) > 1 else []
