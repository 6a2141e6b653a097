"""Train what sees the pictures of a dataset: eyes, or the paper's growing networks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from seewhy.agent.pretraining import Pretrained
from seewhy.perception.extractor import FeatureExtractor, Seen, fit_extractor
from seewhy.perception.eyes import Eyes
from seewhy.perception.familiarity import Familiarity, TrainingPicture, fit_familiarity
from seewhy.perception.fitting_eyes import HeldOut
from seewhy.perception.options import TrainingOptions
from seewhy.perception.validation import split

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent
    from seewhy.data.dataset import Dataset

__all__ = ["Taught", "grown_networks", "taught_eyes"]

Progress = Callable[[Any], None]


@dataclass(frozen=True, eq=False)
class Taught:
    """What sees, and what is known of it from training.

    Attributes
    ----------
    extractor : FeatureExtractor or Eyes
    seen : Seen
        What it makes of the pictures that taught it.
    held_out : HeldOut or None
        Pictures as they were seen by what they had not taught.
    familiarity : Familiarity or None
        None where no picture is to be refused.
    judged : Seen or None
        Of the pictures by which is settled what is refused; their likeness depends on how they
        are read.
    scores : list of float or None
        Their likeness, where it does not.
    """

    extractor: FeatureExtractor | Eyes
    seen: Seen
    held_out: HeldOut | None = None
    familiarity: Familiarity | None = None
    judged: Seen | None = None
    scores: list[float] | None = None


def taught_eyes(
    scenes: Dataset,
    *,
    backbone: str,
    device: str,
    start_from: Agent | Pretrained | None,
    seed: int,
    checkpoints: Path | None,
    on_progress: Progress | None,
) -> Taught:
    """Teach eyes by annotated scenes; see :func:`seewhy.agent.teaching.teach_eyes`."""
    from seewhy.agent.teaching import familiar_scores, teach_eyes

    earlier = start_from.extractor if start_from else None
    fitted = teach_eyes(
        scenes,
        backbone=backbone,
        device=device,
        start_from=earlier if isinstance(earlier, Eyes) else None,
        seed=seed,
        checkpoints=checkpoints,
        on_progress=on_progress,
    )
    familiarity, scores = familiar_scores(
        fitted.eyes.familiar_by(fitted.embedded),
        scenes.groups,
        pictures=_named(scenes),
        seed=seed,
    )
    return Taught(
        fitted.eyes,
        fitted.seen,
        held_out=fitted.held_out,
        familiarity=familiarity,
        scores=scores,
    )


def _named(scenes: Dataset) -> list[TrainingPicture]:
    """The pictures by which answers name what is like a picture."""
    return [
        TrainingPicture(
            scenes.name_of(scene),
            scene.label,
            {
                key: value
                for key, value in zip(scenes.domain.features, scene.vector, strict=True)
                if value is not None
            },
        )
        for scene in scenes.scenes
    ]


def grown_networks(
    scenes: Dataset,
    *,
    with_class: bool,
    judged: bool,
    start_from: Agent | Pretrained | None,
    seed: int,
    checkpoints: Path | None,
    workers: int,
    on_progress: Progress | None,
) -> Taught:
    """Grow a network for each feature, as the paper does.

    Parameters
    ----------
    scenes : Dataset
    with_class : bool
        Whether one sees the class as well.
    judged : bool
        Whether pictures are kept for validation of all networks, to tell what is refused.
    start_from, seed, checkpoints, workers, on_progress
        See :meth:`seewhy.agent.agent.Agent.fit`.
    """
    from seewhy.perception.domain_options import (
        seen_labels,
        seen_values,
        trained_together,
        training_options,
    )

    domain = scenes.domain
    pixels = scenes.pictures(domain.pictures.size)
    validation = None
    if judged:
        # Only of pictures that no network was trained on is it known how well such fit.
        _, validation = split(
            scenes.labels,
            share=TrainingOptions().validation_share,
            seed=seed,
            groups=scenes.groups,
        )
    earlier = start_from.extractor if start_from else None
    extractor = fit_extractor(
        pixels,
        seen_labels(domain, scenes.vectors, scenes.labels, with_class=with_class),
        values=seen_values(domain, with_class=with_class),
        options=training_options(domain, seed=seed, with_class=with_class),
        groups=scenes.groups,
        validation=validation,
        checkpoints=checkpoints,
        start_from=earlier if isinstance(earlier, FeatureExtractor) else None,
        rehearsal=start_from.rehearsal if isinstance(start_from, Pretrained) else None,
        together=trained_together(domain),
        workers=workers,
        on_progress=on_progress,
    )
    seen = extractor.see(pixels)
    if validation is None:
        return Taught(extractor, seen)
    known = np.setdiff1d(np.arange(len(scenes)), validation)
    columns = zip(*(scenes.vectors[n] for n in known), strict=True)
    familiarity = fit_familiarity(
        {key: seen.embeddings[key][known] for key in domain.features},
        dict(zip(domain.features, columns, strict=True)),
        seed=seed,
    )
    return Taught(extractor, seen, familiarity=familiarity, judged=seen.of(validation))
