"""Teach eyes what things are, by the regions and boxes of annotated ones, and what holds of two."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from seewhy.perception.backbones.backbone import Backbone
from seewhy.perception.course import QUIETLY, Course
from seewhy.perception.embedding_cache import EmbeddingCache
from seewhy.perception.eyes import Eyes
from seewhy.perception.fitting_eyes import FittedEyes, fit_eyes
from seewhy.perception.heads import Head, fit_head
from seewhy.perception.lesson import Lesson
from seewhy.perception.randomness import seed_of
from seewhy.perception.stacking import Stack, Table, fit_stack, log_probabilities
from seewhy.perception.things.boxes import Boxes
from seewhy.perception.things.thing_eyes import (
    REGION,
    ScaledHead,
    ThingEyes,
    box_numbers,
    pair_numbers,
    ways,
)
from seewhy.perception.validation import folds

__all__ = ["PairLesson", "ThingLesson", "fit_thing_eyes"]

Rows = npt.NDArray[np.int64]
Floats = npt.NDArray[np.float32]

_FOLDS = 3
_STRENGTH = 0.1  # the inverse of the penalty on weights


@dataclass(frozen=True, eq=False)
class PairLesson:
    """What is annotated of a relation.

    Attributes
    ----------
    pairs : ndarray of int, shape (pairs, 2)
        Places of two things of one picture among all.
    holds : ndarray of int, shape (pairs,)
        1 where the relation holds of the first to the second, 0 where it does not.
    """

    pairs: Rows
    holds: Rows


@dataclass(frozen=True, eq=False)
class ThingLesson:
    """What eyes for things are taught by.

    Attributes
    ----------
    regions : Lesson
        A picture a thing; groups are those of the pictures.
    boxes : ndarray of float, shape (n, numbers)
        As :func:`~seewhy.perception.things.geometry.of_boxes` makes them.
    corners : ndarray of float, shape (n, 4)
        Left, top, right and bottom.
    relations : mapping of str to PairLesson
        Of those that are seen by a head on the pair.
    """

    regions: Lesson
    boxes: Floats
    corners: Boxes
    relations: Mapping[str, PairLesson]


def fit_thing_eyes(
    backbone: Backbone,
    lesson: ThingLesson,
    *,
    given: Mapping[str, float | bool] | None = None,
    start_from: Eyes | None = None,
    cache: EmbeddingCache | None = None,
    seed: int = 0,
    course: Course = QUIETLY,
) -> ThingEyes:
    """Teach eyes to see things.

    The eyes of regions are those of whole pictures (:func:`~seewhy.perception.fitting_eyes`). What
    a region does not show, how large a thing is for instance, its box may tell: regions that were
    kept out settle how much either counts.

    Parameters
    ----------
    backbone, given, start_from, cache, seed, course
        As for :func:`~seewhy.perception.fitting_eyes.fit_eyes`.
    lesson : ThingLesson

    Raises
    ------
    DatasetError
        There is no thing or no feature, or a feature has no label at all.
    """
    targets = lesson.regions.targets()
    fitted = fit_eyes(
        backbone,
        lesson.regions,
        given=given,
        start_from=start_from,
        cache=cache,
        seed=seed,
        course=course,
    )
    parts = lesson.regions.parts(_FOLDS, seed=seed_of(seed, "boxes"))
    sizes = {name: len(values) for name, values in lesson.regions.values.items()}
    everything = np.arange(len(lesson.regions))
    projected = fitted.eyes.projection(fitted.embedded.pooled)
    boxes = box_numbers(projected, lesson.boxes)
    boxed = {
        name: _head(boxes, column, everything, values=sizes[name])
        for name, column in targets.items()
    }
    stacks = {
        name: _stack(fitted, boxes, name, column, parts, values=sizes[name])
        for name, column in targets.items()
    }
    related, accuracies = {}, {}
    for name, pairs in lesson.relations.items():
        numbers = pair_numbers(projected, lesson.corners, pairs.pairs)
        groups = [lesson.regions.groups[n] for n in pairs.pairs[:, 0]]
        related[name], accuracies[name] = _pair_head(numbers, pairs.holds, groups, seed=seed)
    return ThingEyes(
        fitted.eyes, boxed=boxed, stacks=stacks, related=related, accuracies=accuracies
    )


def _head(
    numbers: Floats,
    column: npt.NDArray[np.int64],
    rows: Rows,
    *,
    values: int,
) -> ScaledHead:
    """A head by the rows of which the value is known."""
    known = rows[column[rows] >= 0]
    mean = numbers[known].mean(axis=0) if len(known) else np.zeros(numbers.shape[1])
    scale = numbers[known].std(axis=0) if len(known) else np.ones(numbers.shape[1])
    untaught = ScaledHead(
        mean.astype(np.float32),
        np.maximum(scale, 1e-3).astype(np.float32),
        Head(
            np.zeros((values, numbers.shape[1]), dtype=np.float32),
            np.zeros(values, dtype=np.float32),
        ),
    )
    if not len(known):
        return untaught
    standardised = np.clip((numbers[known] - untaught.mean) / untaught.scale, -6.0, 6.0)
    head = fit_head(standardised, column[known], values=values, strength=_STRENGTH)
    return ScaledHead(untaught.mean, untaught.scale, head)


def _kept_out(
    numbers: Floats,
    column: npt.NDArray[np.int64],
    parts: Sequence[Rows],
    *,
    values: int,
) -> Floats:
    """Logits of every row by a head that its part did not teach."""
    found = np.zeros((len(column), values), dtype=np.float32)
    everything = np.arange(len(column))
    for part in parts:
        rest = np.setdiff1d(everything, part)
        found[part] = _head(numbers, column, rest, values=values)(numbers[part])
    return found


def _stack(
    fitted: FittedEyes,
    boxes: Floats,
    name: str,
    column: npt.NDArray[np.int64],
    parts: Sequence[Rows],
    *,
    values: int,
) -> Stack:
    """How much the region and the box of a thing count, by those that were kept out."""
    rows, seen = fitted.held_out.rows, fitted.held_out.probabilities[name]
    boxed = _kept_out(boxes, column, parts, values=values)[rows]
    known = column[rows] >= 0
    tables: dict[str, Table] = ways(seen[known], boxed[known])
    # Neither is likelier from the start: how large a thing is shows its box, and what it is made
    # of its region.
    return fit_stack(tables, column[rows][known], preferred=REGION, clearly=False)


def _pair_head(
    numbers: Floats, holds: Rows, groups: Sequence[object], *, seed: int
) -> tuple[ScaledHead, float]:
    """A head on the pair, calibrated, and its accuracy on pairs that had no part in it."""
    parts = folds(holds.tolist(), count=_FOLDS, seed=seed_of(seed, "pairs"), groups=groups)
    head = _head(numbers, holds, np.arange(len(holds)), values=2)
    if len(parts) < 2:
        return head, float((head(numbers).argmax(axis=1) == holds).mean())
    kept_out = _kept_out(numbers, holds, parts, values=2)
    stack = fit_stack({"pair": log_probabilities(kept_out)}, holds, preferred="pair")
    power = np.float32(stack.weights["pair"])
    calibrated = Head(head.head.weight * power, head.head.bias * power)
    accuracy = float((kept_out.argmax(axis=1) == holds).mean())
    return ScaledHead(head.mean, head.scale, calibrated), accuracy
