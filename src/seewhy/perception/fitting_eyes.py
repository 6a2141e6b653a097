"""Teach eyes what is to be seen in a domain's pictures."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import numpy as np
import numpy.typing as npt
import torch

from seewhy.perception.backbones.backbone import Backbone, Embedded, Maps
from seewhy.perception.checkpoint import Checkpoint
from seewhy.perception.course import QUIETLY, Course
from seewhy.perception.embedding import embed_pictures, embed_variations
from seewhy.perception.embedding_cache import EmbeddingCache
from seewhy.perception.events import EyesEvent
from seewhy.perception.extractor import Seen
from seewhy.perception.eyes import HEADS, TUNED, Eyes, EyesRecord
from seewhy.perception.heads import Head, Projection, fit_head, fit_projection
from seewhy.perception.lesson import Lesson, Targets
from seewhy.perception.randomness import seed_of, seeded
from seewhy.perception.stacking import Stack, Table, fit_stack, log_probabilities, stacked
from seewhy.perception.tail import Tail, new_tail
from seewhy.perception.tail_training import (
    Schedule,
    VariedMaps,
    see_with_tail,
    train_tail,
)
from seewhy.perception.variations import Judged, chosen_variations

__all__ = ["FittedEyes", "HeldOut", "fit_eyes"]

Rows = npt.NDArray[np.int64]
Told = Callable[[EyesEvent], None]

FEW = 120
"""With fewer pictures than this, each is held out once; with more, a fifth of them once."""

_FOLDS, _HELD_OUT = 3, 5
# Pictures gone over: as many as a minute has room for on two cores, within bounds for each picture.
_GONE_OVER, _PASSES = 8000, (5, 40)
_AGAIN, _PASSES_AGAIN = 6000, (3, 60)
_ANEW, _PASSES_ANEW = 12_000, (3, 120)  # where pictures are so few that each was kept out once
_VARIATIONS, _VIEWS = 9600, (2, 64)


@dataclass(frozen=True, eq=False)
class HeldOut:
    """Pictures as they were seen by eyes that were not taught by them.

    Attributes
    ----------
    rows : ndarray of int
        Their places among all.
    probabilities : dict of str to ndarray of float, shape (rows, values)
    """

    rows: Rows
    probabilities: dict[str, npt.NDArray[np.float64]]


@dataclass(frozen=True, eq=False)
class FittedEyes:
    """Eyes, and what is known from teaching them.

    Attributes
    ----------
    eyes : Eyes
    embedded : Embedded
        What the backbone makes of the pictures.
    held_out : HeldOut
    seen : Seen
        What the eyes make of the pictures that taught them.
    judged : tuple of Judged
        The variations that were judged.
    """

    eyes: Eyes
    embedded: Embedded
    held_out: HeldOut
    seen: Seen
    judged: tuple[Judged, ...]


def fit_eyes(
    backbone: Backbone,
    lesson: Lesson,
    *,
    given: Mapping[str, float | bool] | None = None,
    tune: bool = True,
    start_from: Eyes | None = None,
    cache: EmbeddingCache | None = None,
    seed: int = 0,
    course: Course = QUIETLY,
) -> FittedEyes:
    """Teach eyes to see features in pictures.

    Each feature gets a head on the backbone as it is. Where the backbone can be tuned, its last
    stages are, by all features at once and by pictures varied in many ways. Pictures that were
    kept out settle how much either counts, and calibrate both; then all pictures teach.

    Parameters
    ----------
    backbone : Backbone
    lesson : Lesson
    given : mapping, optional
        Variations that the domain settles, by the names of
        :class:`~seewhy.perception.options.TrainingOptions`; the others are chosen from the
        pictures (:func:`~seewhy.perception.variations.chosen_variations`).
    tune : bool, default True
        False leaves the backbone as it is: heads take a second where embeddings are cached.
    start_from : Eyes, optional
        Earlier eyes, whose tuned stages are tuned further. Where they were taught by the same
        pictures, none is new to them, and probabilities come out too sure.
    cache : EmbeddingCache, optional
        None keeps nothing.
    seed : int, default 0
        Two runs with the same seed and data agree on processors with the same instruction set.
    course : Course
        How the training is run: with checkpoints, an interrupted one goes on where it was.

    Raises
    ------
    DatasetError
        There is no picture or no feature, or a feature has no label at all.
    """
    targets = lesson.targets()
    told: Told = course.on_progress or (lambda _: None)
    kept = cache or EmbeddingCache(None)
    count = len(lesson)
    embedded = embed_pictures(
        backbone,
        lesson.batches(),
        cache=kept,
        on_picture=lambda done: told(EyesEvent("looking at pictures", done, count)),
    )
    sizes = {name: len(values) for name, values in lesson.values.items()}
    heads = _Heads(fit_projection(embedded.pooled, seed=seed), embedded, targets, sizes)
    tuning: _Tuning | None = None
    judged: tuple[Judged, ...] = ()
    if tune and backbone.tunable:
        varied, judged = _varied(
            backbone, lesson, embedded, given=given or {}, cache=kept, seed=seed, told=told
        )
        maps = VariedMaps(embedded.middle, varied, targets)
        tuning = _Tuning(backbone, maps, sizes, start_from, course.checkpoints, seed, told)
    held = _held_out(lesson, seed=seed)
    everything = np.arange(count)
    tables, tail = _seen_by_others(held, heads, tuning, count=count)
    if tuning:
        # What one fifth was kept from knows most already.
        tail = tuning.of_all(tail if len(held) == 1 else None)
    rows = np.concatenate(held) if held else everything[:0]
    stacks = _stacks(tables, targets, rows, preferred=TUNED if tuning else HEADS)
    eyes = Eyes(
        backbone,
        projection=heads.projection,
        heads={name: heads.fitted(name, everything) for name in targets},
        tail=tail,
        stacks=stacks,
        values=lesson.values,
        shown={
            name: frozenset(value for value in column if value is not None)
            for name, column in lesson.labels.items()
        },
    )
    seen_again = eyes.see_embedded(embedded)
    passes = tuning.gone_over(held) if tuning else 0
    eyes.records.update(_records(stacks, targets, seen_again, passes=passes))
    probabilities = {
        name: stacked({way: tables[way][name] for way in stack.asked}, stack.weights)
        for name, stack in stacks.items()
    }
    return FittedEyes(eyes, embedded, HeldOut(rows, probabilities), seen_again, judged)


def _varied(
    backbone: Backbone,
    lesson: Lesson,
    embedded: Embedded,
    *,
    given: Mapping[str, float | bool],
    cache: EmbeddingCache,
    seed: int,
    told: Told,
) -> tuple[Maps, tuple[Judged, ...]]:
    """Maps of the pictures in other variations, and the variations that were judged for it."""
    options, judged = chosen_variations(backbone, lesson, embedded.pooled, given=given, seed=seed)
    count = len(lesson)
    for judgement in judged:
        told(EyesEvent("varying pictures", 0, count, judgement.say()))
    varied = embed_variations(
        backbone,
        lesson.batches(),
        options,
        views=int(np.clip(_VARIATIONS // count, *_VIEWS)),
        count=count,
        cache=cache,
        on_picture=lambda done: told(EyesEvent("varying pictures", done, count)),
    )
    return varied, judged


def _seen_by_others(
    held: Sequence[Rows], heads: _Heads, tuning: _Tuning | None, *, count: int
) -> tuple[dict[str, dict[str, Table]], Tail | None]:
    """Way of seeing → what it makes of each part that was kept out of it; and the last tail."""
    seen: dict[str, list[dict[str, Table]]] = {HEADS: [], **({TUNED: []} if tuning else {})}
    tail: Tail | None = None
    for number, part in enumerate(held):
        rest = np.setdiff1d(np.arange(count), part)
        seen[HEADS].append(heads.seen(part, taught_by=rest))
        if tuning:
            tail = tuning.of_part(rest, number)
            seen[TUNED].append(see_with_tail(tail, tuning.maps.plain[part]))
    return {way: _joined(parts, heads.sizes) for way, parts in seen.items()}, tail


def _joined(parts: Sequence[Mapping[str, Table]], sizes: Mapping[str, int]) -> dict[str, Table]:
    """What was made of the pictures of each part, one after another."""
    return {
        name: np.concatenate([np.zeros((0, size)), *(part[name] for part in parts)])
        for name, size in sizes.items()
    }


@dataclass(frozen=True, eq=False)
class _Heads:
    """Heads on the backbone as it is, fitted to some pictures or to all."""

    projection: Projection
    embedded: Embedded
    targets: Targets
    sizes: Mapping[str, int]

    def fitted(self, name: str, rows: Rows) -> Head:
        """The head of a feature by the pictures at ``rows`` of which it is annotated."""
        column = self.targets[name]
        known = rows[column[rows] >= 0]
        projected = self.projection(self.embedded.pooled[known])
        return fit_head(projected, column[known], values=self.sizes[name])

    def seen(self, rows: Rows, *, taught_by: Rows) -> dict[str, Table]:
        """What heads that some pictures taught make of others, as logarithms of probabilities."""
        projected = self.projection(self.embedded.pooled[rows])
        return {
            name: log_probabilities(self.fitted(name, taught_by)(projected))
            for name in self.targets
        }


@dataclass(frozen=True, eq=False)
class _Tuning:
    """The backbone's last stages, tuned to some pictures or to all."""

    backbone: Backbone
    maps: VariedMaps
    sizes: Mapping[str, int]
    start_from: Eyes | None
    checkpoints: Path | None
    seed: int
    told: Told

    @property
    def passes(self) -> float:
        """Over the pictures that are not kept out."""
        return float(np.clip(_GONE_OVER / len(self.maps.plain), *_PASSES))

    def passes_in_the_end(self, *, anew: bool) -> float:
        """Over all pictures: by a tail that nothing has taught, or by one that most have."""
        gone_over, bounds = (_ANEW, _PASSES_ANEW) if anew else (_AGAIN, _PASSES_AGAIN)
        return float(np.clip(gone_over / len(self.maps.plain), *bounds))

    def gone_over(self, held: Sequence[Rows]) -> int:
        """How often the pictures were gone over for the tail that is kept."""
        if len(held) == 1:
            return round(self.passes + self.passes_in_the_end(anew=False))
        return round(self.passes_in_the_end(anew=True))

    def of_part(self, rows: Rows, number: int) -> Tail:
        """A tail that the pictures at ``rows`` taught."""
        place = ("part", number)
        return self._tuned(self._new(place), rows, Schedule(self.passes), place, "by most")

    def of_all(self, tail: Tail | None) -> Tail:
        """A tail that all pictures taught: anew, or further one that most had taught."""
        place = ("all",)
        schedule = Schedule(self.passes_in_the_end(anew=tail is None))
        if tail is not None:
            schedule = replace(schedule, rate=5e-4, new_rate=1.5e-3)
        rows = np.arange(len(self.maps.plain))
        return self._tuned(tail or self._new(place), rows, schedule, place, "once more, by all")

    def _tuned(
        self, tail: Tail, rows: Rows, schedule: Schedule, place: tuple[object, ...], said: str
    ) -> Tail:
        total = round(len(rows) * schedule.passes)
        train_tail(
            tail,
            self.maps,
            rows,
            schedule,
            seed=(self.seed, *place),
            kept=self._checkpoint(tail, rows, schedule, place),
            on_step=lambda done: self.told(EyesEvent(f"tuning layers {said}", done, total)),
        )
        return tail

    def _new(self, place: tuple[object, ...]) -> Tail:
        with seeded(torch.device("cpu"), self.seed, *place, "first"):
            tail = new_tail(self.backbone, self.sizes)
        if self.start_from is not None and self.start_from.tail is not None:
            known = self.start_from.tail.state_dict()
            weights = tail.state_dict()
            fitting = {
                name: weight
                for name, weight in known.items()
                if name in weights and weights[name].shape == weight.shape
            }
            tail.load_state_dict(fitting, strict=False)
        return tail

    def _checkpoint(
        self, tail: Tail, rows: Rows, schedule: Schedule, place: tuple[object, ...]
    ) -> Checkpoint | None:
        """Where an interrupted training was; its own where all that it starts with is the same."""
        if self.checkpoints is None:
            return None
        digest = hashlib.sha256(repr((self.backbone.digest, asdict(schedule), place)).encode())
        digest.update(repr((self.seed, dict(self.sizes), self.maps.varied.shape)).encode())
        columns = [self.maps.targets[name] for name in sorted(self.maps.targets)]
        # The variations follow from the pictures and from what was chosen by them: some tell.
        for array in (rows, *columns, self.maps.plain, self.maps.varied[:, :1]):
            digest.update(np.ascontiguousarray(array).data)
        for name, weight in sorted(tail.state_dict().items()):
            digest.update(name.encode() + weight.cpu().contiguous().numpy().tobytes())
        self.checkpoints.mkdir(parents=True, exist_ok=True)
        name = "-".join(str(part) for part in ("eyes", *place))
        return Checkpoint(self.checkpoints / f"{name}.checkpoint.safetensors", digest.hexdigest())


def _held_out(lesson: Lesson, *, seed: int) -> list[Rows]:
    """The places of pictures to keep out, a training of all others for each."""
    few = len(lesson) <= FEW
    parts = lesson.parts(_FOLDS if few else _HELD_OUT, seed=seed_of(seed, "held out"))
    if len(parts) < 2:
        return []
    return parts if few else parts[:1]


def _stacks(
    tables: Mapping[str, Mapping[str, Table]], targets: Targets, rows: Rows, *, preferred: str
) -> dict[str, Stack]:
    """How much each way of seeing counts, by what each made of the pictures at ``rows``."""
    return {
        name: fit_stack(
            {way: table[name][column[rows] >= 0] for way, table in tables.items()},
            column[rows][column[rows] >= 0],
            preferred=preferred,
        )
        for name, column in targets.items()
    }


def _records(
    stacks: Mapping[str, Stack], targets: Targets, seen: Seen, *, passes: int
) -> dict[str, EyesRecord]:
    """What came of teaching each feature; ``seen`` are the pictures that taught it."""
    records = {}
    for name, column in targets.items():
        right = seen.probabilities[name].argmax(axis=1)[column >= 0] == column[column >= 0]
        records[name] = _record(
            stacks[name], passes, pictures=len(right), trained_accuracy=float(right.mean())
        )
    return records


def _record(stack: Stack, passes: int, *, pictures: int, trained_accuracy: float) -> EyesRecord:
    asked = stack.asked
    others = [way for way in stack.accuracies if way not in (*asked, "together")]
    beside = asked if len(asked) > 1 else others
    compared = ", ".join(f"{way} {100 * stack.accuracies[way]:.1f} %" for way in beside)
    layers = " and ".join(asked)
    return EyesRecord(
        layers=f"{layers} ({compared})" if compared else layers,
        validation_accuracy=trained_accuracy if stack.accuracy is None else stack.accuracy,
        accuracies=stack.accuracies,
        epochs=passes,
        training_pictures=pictures,
        validation_pictures=stack.pictures,
    )
