"""Networks that have seen a domain's own drawings before they see photographs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from seewhy.agent.settings import Settings
from seewhy.data.dataset import Dataset
from seewhy.data.making import MADE, make_dataset
from seewhy.domain.domain import Domain
from seewhy.files.folders import scratch_folder
from seewhy.knowledge.scene import FeatureVector
from seewhy.perception.backbones import NONE
from seewhy.perception.course import QUIETLY, Course

if TYPE_CHECKING:
    from seewhy.perception.extractor import FeatureExtractor
    from seewhy.perception.eyes import Eyes
    from seewhy.perception.rehearsal import Rehearsal

__all__ = ["Pretrained", "is_drawn", "pretrained"]


@dataclass(frozen=True)
class Pretrained:
    """Networks that know a domain's drawings, and the drawings with their annotation."""

    extractor: FeatureExtractor | Eyes
    rehearsal: Rehearsal | None
    vectors: tuple[FeatureVector, ...]
    labels: tuple[str, ...]

    @property
    def networks(self) -> FeatureExtractor:
        """The extractor, where networks were grown."""
        from seewhy.perception.extractor import FeatureExtractor

        assert isinstance(self.extractor, FeatureExtractor)
        return self.extractor


def is_drawn(dataset: Dataset) -> bool:
    """Whether a dataset was made by its domain's own source."""
    return (dataset.folder / MADE).is_file()


def pretrained(
    domain: Domain,
    *,
    count: int,
    settings: Settings | None = None,
    without: Sequence[str] = (),
    course: Course = QUIETLY,
) -> Pretrained:
    """Draw pictures with the domain's source and train what sees on them.

    Use it where drawings are free and photographs are few: networks that know the drawings need
    fewer photographs. Source: none; the paper trains on the pictures of the domain alone.

    Parameters
    ----------
    domain : Domain
        With a source of pictures.
    count : int
        How many pictures to draw.
    settings : Settings, optional
        Of the agent that goes on from there; a network grown for each feature where left out.
    without : sequence of str
        Classes of which no drawing is used.
    course : Course
        How the training is run.

    Raises
    ------
    DomainError
        If the domain has no source of pictures.
    """
    settings = settings or Settings(eyes=NONE, reading="argmax")
    with scratch_folder() as temporary:
        folder = temporary if course.checkpoints is None else course.checkpoints
        make_dataset(
            domain,
            folder / "drawn",
            count=count,
            seed=settings.seed,
            # Twice as large as the networks see them, as photographs are: stretching blurs less.
            size=2 * domain.pictures.size,
            test_share=0.0,
            workers=course.workers,
            on_progress=course.on_picture,
        )
        scenes = Dataset.load(folder / "drawn", domain).without_classes(without)
        training = replace(course, checkpoints=folder / "drawn.training")
        return _taught(scenes, settings, training)


def _taught(scenes: Dataset, settings: Settings, course: Course) -> Pretrained:
    """What drawings teach."""
    annotated = (tuple(scenes.vectors), tuple(scenes.classes))
    if not settings.grown:
        from seewhy.agent.teaching import teach_eyes

        return Pretrained(teach_eyes(scenes, settings, course=course).eyes, None, *annotated)
    from seewhy.agent.growing import grow, labelled_pictures
    from seewhy.perception.rehearsal import Rehearsal

    shown = labelled_pictures(scenes, with_class=settings.class_is_seen, groups=False)
    columns = {key: [str(value) for value in column] for key, column in shown.labels.items()}
    networks = grow(shown, scenes.domain, settings, course=course)
    return Pretrained(networks, Rehearsal(shown.pixels, columns), *annotated)
