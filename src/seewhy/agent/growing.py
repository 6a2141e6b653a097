"""Grow a network for each feature of a domain, as the paper does."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from seewhy.agent.settings import Settings
from seewhy.data.dataset import Dataset
from seewhy.domain.domain import Domain
from seewhy.perception.course import Course
from seewhy.perception.domain_options import (
    seen_labels,
    seen_values,
    trained_together,
    training_options,
)
from seewhy.perception.extractor import FeatureExtractor
from seewhy.perception.fitting_extractor import fit_extractor
from seewhy.perception.labelled_pictures import LabelledPictures

if TYPE_CHECKING:
    from seewhy.perception.rehearsal import Rehearsal

__all__ = ["grow", "labelled_pictures"]


def labelled_pictures(
    scenes: Dataset,
    *,
    with_class: bool,
    groups: bool = True,
    validation: npt.NDArray[np.int64] | None = None,
) -> LabelledPictures:
    """The pictures of annotated scenes, as a domain's networks see them.

    Parameters
    ----------
    scenes : Dataset
    with_class : bool
        Whether a network sees the class as well.
    groups : bool, default True
        Whether pictures of one group stay together; False takes every picture by itself.
    validation : ndarray of int64, optional
        The places of those to validate all networks on.
    """
    domain = scenes.domain
    return LabelledPictures(
        scenes.pictures(domain.pictures.size),
        seen_labels(domain, scenes.vectors, scenes.labels, with_class=with_class),
        seen_values(domain, with_class=with_class),
        scenes.groups if groups else None,
        validation,
    )


def grow(
    shown: LabelledPictures,
    domain: Domain,
    settings: Settings,
    *,
    start_from: FeatureExtractor | None = None,
    rehearsal: Rehearsal | None = None,
    course: Course,
) -> FeatureExtractor:
    """Grow networks as a domain wants it, or train earlier ones on.

    See :func:`~seewhy.perception.fitting_extractor.fit_extractor`.
    """
    return fit_extractor(
        shown,
        options=training_options(domain, seed=settings.seed, with_class=settings.class_is_seen),
        start_from=start_from,
        rehearsal=rehearsal,
        together=trained_together(domain),
        course=course,
    )
