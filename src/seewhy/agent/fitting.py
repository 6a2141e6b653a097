"""Train what sees the pictures of a dataset: eyes, or the paper's growing networks."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Protocol

import numpy as np

from seewhy.agent.fitting_reading_weights import fit_reading_weights
from seewhy.agent.growing import grow, labelled_pictures
from seewhy.agent.picture_reader import PictureReader
from seewhy.agent.pretraining import Pretrained, is_drawn
from seewhy.agent.reading_weights import ReadingWeights
from seewhy.agent.seeing import Seeing, likeness
from seewhy.agent.settings import Settings
from seewhy.domain.reading_rule import READINGS, ReadingRule
from seewhy.domain.tables import CLASS
from seewhy.errors import DatasetError
from seewhy.perception.course import Course
from seewhy.perception.device import device_of
from seewhy.perception.extractor import FeatureExtractor, Seen
from seewhy.perception.eyes import Eyes
from seewhy.perception.familiarity import Familiarity, TrainingPicture, fit_familiarity
from seewhy.perception.options import TrainingOptions
from seewhy.perception.validation import split

if TYPE_CHECKING:
    from seewhy.data.dataset import Dataset
    from seewhy.domain.domain import Domain
    from seewhy.knowledge.scene import FeatureVector
    from seewhy.perception.fitting_eyes import HeldOut

__all__ = ["Sees", "Taught", "known_from_training", "pictures_to_draw", "teach"]


class Sees(Protocol):
    """What has networks to start from: an agent, or those that drawings taught."""

    @property
    def extractor(self) -> FeatureExtractor | Eyes | None:
        """What sees; None where nothing does yet."""


@dataclass(frozen=True, eq=False)
class Taught:
    """What sees, and what is known of it from training.

    Attributes
    ----------
    extractor : FeatureExtractor or Eyes
    scenes : Dataset
        That taught it.
    drawings : Pretrained or None
        That taught it before.
    seen : Seen
        What it makes of their pictures.
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
    scenes: Dataset
    drawings: Pretrained | None
    seen: Seen
    held_out: HeldOut | None = None
    familiarity: Familiarity | None = None
    judged: Seen | None = None
    scores: list[float] | None = None

    @property
    def annotated(self) -> tuple[list[FeatureVector], list[str]]:
        """The feature vectors and classes of the scenes that have one, and of the drawings.

        Drawings show all classes alike; a few photographs leave most of them out.
        """
        classed = self.scenes.with_class()
        if self.drawings is None:
            return classed.vectors, classed.classes
        return (
            [*classed.vectors, *self.drawings.vectors],
            [*classed.classes, *self.drawings.labels],
        )

    def less_sure_than(self, gate: float | None) -> list[int]:
        """Of the scenes with a class, the places of those of which some network is less sure."""
        features = self.scenes.domain.features
        if gate is None or not features:
            return []
        classed = [n for n, label in enumerate(self.scenes.labels) if label is not None]
        seen = self.seen.of(np.array(classed, dtype=np.int64))
        certainty = np.min([seen.probabilities[key].max(axis=1) for key in features], axis=0)
        return [int(n) for n in np.flatnonzero(certainty < gate)]


def pictures_to_draw(
    dataset: Dataset, domain: Domain, *, drawn: int | None, start_from: Sees | None
) -> int:
    """Return how many pictures are to be drawn that train the networks before.

    Parameters
    ----------
    dataset : Dataset
        To train on then.
    domain : Domain
        That says how many, where nobody else does.
    drawn : int or None
        So many; where left out, none if the dataset was drawn itself.
    start_from : Sees or None
        Networks that there are already: none are drawn for then.

    Raises
    ------
    DatasetError
        If there are both networks to start from and pictures to draw.
    """
    if start_from is not None:
        if drawn:
            raise DatasetError(
                "start_from, drawn: networks begin with what they know (--from) or with new "
                "drawings (--drawn); leave one of the two out"
            )
        return 0
    if drawn is None:
        return 0 if is_drawn(dataset) else domain.pictures.drawn
    return drawn


def teach(
    scenes: Dataset, settings: Settings, *, start_from: Sees | None, course: Course
) -> Taught:
    """Teach what sees by annotated scenes: eyes, or a network for each feature that grows."""
    if settings.grown:
        device_of(settings.device)  # networks take CUDA where there is one; none that is not there
        return _grown_networks(scenes, settings, start_from=start_from, course=course)
    return _taught_eyes(scenes, settings, start_from=start_from, course=course)


def _drawings(start_from: Sees | None) -> Pretrained | None:
    return start_from if isinstance(start_from, Pretrained) else None


def _taught_eyes(
    scenes: Dataset, settings: Settings, *, start_from: Sees | None, course: Course
) -> Taught:
    from seewhy.agent.teaching import familiar_scores, teach_eyes

    earlier = start_from.extractor if start_from else None
    fitted = teach_eyes(
        scenes,
        settings,
        start_from=earlier if isinstance(earlier, Eyes) else None,
        course=course,
    )
    familiarity, scores = familiar_scores(
        fitted.eyes.familiar_by(fitted.embedded),
        scenes.groups,
        pictures=_named(scenes),
        seed=settings.seed,
    )
    return Taught(
        fitted.eyes,
        scenes,
        _drawings(start_from),
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


def _grown_networks(
    scenes: Dataset, settings: Settings, *, start_from: Sees | None, course: Course
) -> Taught:
    validation = None
    if settings.known_share < 1.0:
        # Only of pictures that no network was trained on is it known how well such fit.
        _, validation = split(
            scenes.labels,
            share=TrainingOptions().validation_share,
            seed=settings.seed,
            groups=scenes.groups,
        )
    drawings = _drawings(start_from)
    shown = labelled_pictures(scenes, with_class=settings.class_is_seen, validation=validation)
    earlier = start_from.extractor if start_from else None
    extractor = grow(
        shown,
        scenes.domain,
        settings,
        start_from=earlier if isinstance(earlier, FeatureExtractor) else None,
        rehearsal=drawings.rehearsal if drawings else None,
        course=course,
    )
    seen = extractor.see(shown.pixels)
    if validation is None:
        return Taught(extractor, scenes, drawings, seen)
    known = np.setdiff1d(np.arange(len(scenes)), validation)
    features = scenes.domain.features
    columns = zip(*(scenes.vectors[n] for n in known), strict=True)
    familiarity = fit_familiarity(
        {key: seen.embeddings[key][known] for key in features},
        dict(zip(features, columns, strict=True)),
        seed=settings.seed,
    )
    return Taught(
        extractor, scenes, drawings, seen, familiarity=familiarity, judged=seen.of(validation)
    )


def known_from_training(taught: Taught, reading: PictureReader) -> Seeing:
    """Return what sees with what is known of it, now that what it sees can be decided.

    What is seen is weighed by pictures that taught it nothing, for both consistent readings; and
    it is kept how like those of training others are.
    """
    seeing = replace(
        reading.seeing,
        reading_weights=_reading_weights(taught, reading),
        familiarity=taught.familiarity,
        validation_scores={},
    )
    scores = _validation_scores(taught, replace(reading, seeing=seeing))
    return replace(seeing, validation_scores=scores)


def _reading_weights(taught: Taught, reading: PictureReader) -> dict[ReadingRule, ReadingWeights]:
    held = taught.held_out
    if held is None or not len(held.rows):
        return {}
    labels = [taught.scenes.labels[n] for n in held.rows]
    return {
        rule: fit_reading_weights(reading.consistent(rule), held.probabilities, labels)
        for rule in READINGS
        if rule != "argmax"
    }


def _validation_scores(taught: Taught, reading: PictureReader) -> dict[ReadingRule, list[float]]:
    if taught.scores is not None:
        return dict.fromkeys(READINGS, taught.scores)
    judged, familiarity = taught.judged, taught.familiarity
    if judged is None or familiarity is None:
        return {}
    features = taught.scenes.domain.features
    return {
        rule: likeness(
            familiarity, judged, reading.read(judged.probabilities, rule), features=features
        )
        for rule in READINGS
        if rule != "with_class" or CLASS in judged.probabilities
    }
