"""Train what sees the things in the pictures of a dataset."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from seewhy.agent.settings import Settings
from seewhy.agent.teaching import lesson_of
from seewhy.agent.things.thing_lessons import (
    Lessons,
    boxes_of,
    is_whole,
    lessons_of,
    require_boxes,
    shown_boxes,
)
from seewhy.agent.things.thing_seeing import ThingSeeing
from seewhy.agent.training_pictures import require_same_domain
from seewhy.data.dataset import Dataset
from seewhy.files.cache_folder import cache_folder
from seewhy.perception.backbones import load_backbone, sides_of
from seewhy.perception.backbones.backbone import Backbone
from seewhy.perception.course import Course
from seewhy.perception.domain_options import given_variations
from seewhy.perception.embedding_cache import EmbeddingCache
from seewhy.perception.eyes import Eyes
from seewhy.perception.fitting_eyes import fit_eyes
from seewhy.perception.lesson import Lesson
from seewhy.perception.picture import whole_picture
from seewhy.perception.things.boxes import Boxes
from seewhy.perception.things.detector import Detected, Detector, Trust
from seewhy.perception.things.fitting_detector import fit_detector, fit_trust
from seewhy.perception.things.fitting_thing_eyes import fit_thing_eyes
from seewhy.perception.things.regions import LONGEST, region_side

if TYPE_CHECKING:
    from seewhy.domain.domain import Domain

__all__ = ["fitted_seeing", "scenes_with_things"]

_TRUSTED_BY = 200  # pictures by which a given detector is judged


def scenes_with_things(dataset: Dataset, domain: Domain) -> Dataset:
    """Return the scenes to train on.

    Raises
    ------
    DatasetError
        If the dataset is of another domain, or shows too little of things.
    """
    require_same_domain(dataset, domain)
    scenes = dataset.of_split("train")
    require_boxes(scenes)
    return scenes


def fitted_seeing(
    dataset: Dataset, settings: Settings, *, detector: Detector | None, course: Course
) -> tuple[Dataset, ThingSeeing]:
    """Teach what sees things by a dataset; the scenes that taught it come first.

    Raises
    ------
    DatasetError
        See :func:`scenes_with_things`.
    """
    domain = dataset.domain
    scenes = scenes_with_things(dataset, domain)
    backbone = _of_regions(scenes, settings)
    cache = EmbeddingCache(cache_folder())
    lessons: Lessons = lessons_of(scenes, side=backbone.side, with_places=detector is None)
    eyes = fit_thing_eyes(
        backbone,
        lessons.things,
        given=given_variations(domain),
        cache=cache,
        seed=settings.seed,
        course=course,
    )
    if lessons.places is not None:
        found = fit_detector(lessons.places, seed=settings.seed, on_progress=course.on_progress)
        detector, trust = found.detector, found.trust
    else:
        assert detector is not None
        trust = _trust_in(detector, scenes)
    whole = _whole_eyes(scenes, settings, cache, course)
    return scenes, ThingSeeing(domain, eyes, detector, trust, whole)


def _of_regions(scenes: Dataset, settings: Settings) -> Backbone:
    """What looks at regions, as large as their details ask for."""
    sides = sides_of(settings.eyes)
    side = region_side(shown_boxes(scenes), sides) if sides else None
    return load_backbone(settings.eyes, device=settings.device, side=side)


def _trust_in(detector: Detector, scenes: Dataset) -> Trust:
    """How the scores of a given detector become probabilities, by annotated pictures."""
    found: list[Detected] = []
    true: list[Boxes] = []
    for scene in scenes.scenes:
        if is_whole(scene) and len(true) < _TRUSTED_BY:
            whole = whole_picture(scene.picture, longest=LONGEST)
            found.append(detector.find(whole.image))
            true.append(boxes_of(scene.things) / whole.scale)
    return fit_trust(found, true)


def _whole_eyes(
    scenes: Dataset, settings: Settings, cache: EmbeddingCache, course: Course
) -> Eyes | None:
    """Eyes of the picture as a whole and of its class; None where nothing is annotated of it."""
    annotated = scenes.annotated()
    backbone = load_backbone(settings.eyes, device=settings.device)
    lesson: Lesson | None = None
    if annotated.scenes:
        plain = annotated.of_scenes(annotated.scenes)
        lesson = lesson_of(plain, side=backbone.side)
        labels = {
            key: column
            for key, column in lesson.labels.items()
            if any(value is not None for value in column)
        }
        lesson = replace(lesson, labels=labels, values={key: lesson.values[key] for key in labels})
    if lesson is None or not lesson.labels:
        return None
    fitted = fit_eyes(
        backbone,
        lesson,
        given=given_variations(scenes.domain),
        cache=cache,
        seed=settings.seed,
        course=replace(course, checkpoints=course.checkpoints and course.checkpoints / "whole"),
    )
    return fitted.eyes
