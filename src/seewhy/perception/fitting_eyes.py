"""Teach eyes what is to be seen in a domain's pictures."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from seewhy.errors import DatasetError
from seewhy.perception.backbones.backbone import Backbone, Embedded, Maps
from seewhy.perception.embedding import embed_pictures, embed_variations
from seewhy.perception.embedding_cache import EmbeddingCache
from seewhy.perception.eyes import HEADS, TUNED, Eyes, EyesRecord
from seewhy.perception.heads import Projection, fit_head, fit_projection
from seewhy.perception.labels import labelled
from seewhy.perception.randomness import seed_of
from seewhy.perception.stacking import Stack, Table, fit_stack, log_probabilities, stacked
from seewhy.perception.tail import Tail, new_tail
from seewhy.perception.tail_training import Schedule, Targets, see_with_tail, train_tail
from seewhy.perception.validation import folds
from seewhy.perception.variations import Judged, chosen_variations

__all__ = ["EyesEvent", "FittedEyes", "HeldOut", "Lesson", "fit_eyes"]

Pictures = npt.NDArray[np.uint8]
Rows = npt.NDArray[np.int64]
Told = Callable[["EyesEvent"], None]

FEW = 120
"""With fewer pictures than this, each is held out once; with more, a fifth of them once."""

_FOLDS, _HELD_OUT = 3, 5
# Pictures gone over: as many as a minute has room for on two cores, within bounds for each picture.
_GONE_OVER, _PASSES = 8000, (5, 40)
_AGAIN, _PASSES_AGAIN = 6000, (3, 60)
_VARIATIONS, _VIEWS = 9600, (2, 64)
_JUDGED_FROM = 2000  # pictures kept in the memory to choose variations by


@dataclass(frozen=True)
class EyesEvent:
    """Something that happened in training, for a progress display.

    Attributes
    ----------
    stage : str
        What is going on, in words.
    done, total : int
        Pictures gone over, and how many there will be.
    message : str or None
        Something worth a line of its own.
    """

    stage: str
    done: int
    total: int
    message: str | None = None


@dataclass(frozen=True)
class Lesson:
    """What eyes are taught by.

    Attributes
    ----------
    batches : callable
        Yields the pictures from the first on, each time it is called: arrays of uint8, of shape
        (some, side, side, 3).
    labels : mapping of str to sequence of str or None, length n
        Each feature's value in each picture; None where it is unknown.
    values : mapping of str to sequence of str
        All values that each feature can have.
    strata : sequence, length n
        What pictures kept for validation are to show in the same shares.
    groups : sequence, length n
        Pictures of one group are never divided.
    """

    batches: Callable[[], Iterator[Pictures]]
    labels: Mapping[str, Sequence[str | None]]
    values: Mapping[str, Sequence[str]]
    strata: Sequence[object]
    groups: Sequence[object]

    def __len__(self) -> int:
        return len(self.strata)


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
    judged : tuple of Judged
        The variations that were judged.
    """

    eyes: Eyes
    embedded: Embedded
    held_out: HeldOut
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
    on_progress: Told | None = None,
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
        Earlier eyes, whose tuned stages are tuned further.
    cache : EmbeddingCache, optional
        None keeps nothing.
    seed : int, default 0
        Two runs with the same seed and data agree on the same kind of machine.
    on_progress : callable, optional
        Called with an :class:`EyesEvent`.

    Raises
    ------
    DatasetError
        There is no picture or no feature, or a feature has no label at all.
    """
    if not len(lesson):
        raise DatasetError("there is no picture to learn from: add labelled pictures")
    targets = _targets(lesson)
    told = on_progress or (lambda _: None)
    kept = cache or EmbeddingCache(None)
    count = len(lesson)
    embedded = embed_pictures(
        backbone,
        lesson.batches(),
        cache=kept,
        on_picture=lambda done: told(EyesEvent("looking at pictures", done, count)),
    )
    projection = fit_projection(embedded.pooled, seed=seed)
    tuning = tune and backbone.tunable
    held = _held_out(lesson, seed=seed)
    judged: tuple[Judged, ...] = ()
    varied: Maps | None = None
    if tuning:
        options, judged = chosen_variations(
            backbone,
            _first(lesson, _JUDGED_FROM),
            embedded.pooled[:_JUDGED_FROM],
            {name: column[:_JUDGED_FROM] for name, column in targets.items()},
            _within(folds(lesson.strata, count=3, seed=seed, groups=lesson.groups), _JUDGED_FROM),
            given=given or {},
            seed=seed,
        )
        for judgement in judged:
            told(EyesEvent("varying pictures", 0, count, judgement.say()))
        varied = embed_variations(
            backbone,
            lesson.batches(),
            options,
            views=int(np.clip(_VARIATIONS // count, *_VIEWS)),
            count=count,
            cache=kept,
            on_picture=lambda done: told(EyesEvent("varying pictures", done, count)),
        )
    sizes = {name: len(row) for name, row in lesson.values.items()}
    ways = [HEADS, *([TUNED] if tuning else [])]
    tables: dict[str, dict[str, list[Table]]] = {way: {name: [] for name in sizes} for way in ways}
    tail: Tail | None = None
    work = _Work(backbone, embedded, varied, targets, sizes, start_from, seed, told)
    passes = float(np.clip(_GONE_OVER / count, *_PASSES))
    again = float(np.clip(_AGAIN / count, *_PASSES_AGAIN))
    for number, part in enumerate(held):
        rest = np.setdiff1d(np.arange(count), part)
        for name, column in targets.items():
            logits = _head_logits(projection, embedded, column, rest, part, sizes[name])
            tables[HEADS][name].append(log_probabilities(logits))
        if varied is not None:
            tail = work.tuned(rest, Schedule(passes), place=("part", number))
            for name, table in see_with_tail(tail, embedded.middle[part]).items():
                tables[TUNED][name].append(table)
    everything = np.arange(count)
    gone_over = passes + again if len(held) == 1 else again
    if varied is not None:
        if len(held) == 1 and tail is not None:
            # What a fifth was kept from knows most already.
            gently = Schedule(again, rate=5e-4, new_rate=1.5e-3)
            tail = work.tuned(everything, gently, place=("all",), tail=tail)
        else:
            tail = work.tuned(everything, Schedule(again), place=("all",))
    rows = np.concatenate(held) if held else np.zeros(0, dtype=np.int64)
    stacks, probabilities = {}, {}
    for name, column in targets.items():
        own = {
            way: np.concatenate(tables[way][name]) if held else np.zeros((0, sizes[name]))
            for way in ways
        }
        known = column[rows] >= 0
        stack = fit_stack(
            {way: table[known] for way, table in own.items()},
            column[rows][known],
            preferred=ways[-1],
        )
        stacks[name] = stack
        probabilities[name] = stacked({way: own[way] for way in stack.asked}, stack.weights)
    eyes = Eyes(
        backbone,
        projection=projection,
        heads={
            name: fit_head(
                projection(embedded.pooled[column >= 0]), column[column >= 0], values=sizes[name]
            )
            for name, column in targets.items()
        },
        tail=tail,
        stacks=stacks,
        values=lesson.values,
        shown={
            name: frozenset(value for value in column if value is not None)
            for name, column in lesson.labels.items()
        },
        records={
            name: _record(stacks[name], targets[name], gone_over if tuning else 0.0)
            for name in targets
        },
    )
    return FittedEyes(eyes, embedded, HeldOut(rows, probabilities), judged)


@dataclass(frozen=True, eq=False)
class _Work:
    """What every tuning shares."""

    backbone: Backbone
    embedded: Embedded
    varied: Maps | None
    targets: Targets
    sizes: Mapping[str, int]
    start_from: Eyes | None
    seed: int
    told: Told

    def tuned(
        self, rows: Rows, schedule: Schedule, *, place: tuple[object, ...], tail: Tail | None = None
    ) -> Tail:
        assert self.varied is not None
        total = round(len(rows) * schedule.passes)
        again = "once more, by all" if place == ("all",) else "by most"
        train = tail or self._new(place)
        train_tail(
            train,
            self.embedded.middle,
            self.varied,
            self.targets,
            rows,
            schedule,
            seed=(self.seed, *place),
            on_step=lambda done: self.told(
                EyesEvent(f"tuning layers {again}", min(done, total), total)
            ),
        )
        return train

    def _new(self, place: tuple[object, ...]) -> Tail:
        import torch

        from seewhy.perception.randomness import seeded

        with seeded(torch.device("cpu"), self.seed, *place, "first"):
            tail = new_tail(self.backbone, self.sizes)
        if self.start_from is not None and self.start_from.tail is not None:
            known = self.start_from.tail.state_dict()
            fitting = {
                name: weight
                for name, weight in tail.state_dict().items()
                if name in known and known[name].shape == weight.shape
            }
            tail.load_state_dict({name: known[name] for name in fitting}, strict=False)
        return tail


def _targets(lesson: Lesson) -> dict[str, npt.NDArray[np.int64]]:
    if not lesson.labels:
        raise DatasetError("there is no feature to learn: name at least one in the domain")
    found = {}
    for name, column in lesson.labels.items():
        indices, values = labelled(column, feature=name, values=lesson.values[name])
        found[name] = np.full(len(lesson), -1, dtype=np.int64)
        found[name][indices] = values
    return found


def _held_out(lesson: Lesson, *, seed: int) -> list[Rows]:
    count = _FOLDS if len(lesson) <= FEW else _HELD_OUT
    parts = folds(lesson.strata, count=count, seed=seed_of(seed, "held out"), groups=lesson.groups)
    if len(parts) < 2:
        return []
    return parts if len(lesson) <= FEW else parts[:1]


def _first(lesson: Lesson, count: int) -> Pictures:
    some: list[Pictures] = []
    for batch in lesson.batches():
        some.append(batch)
        if sum(len(part) for part in some) >= count:
            break
    return np.concatenate(some)[:count]


def _within(parts: Sequence[Rows], count: int) -> list[Rows]:
    return [part[part < count] for part in parts]


def _head_logits(
    projection: Projection,
    embedded: Embedded,
    column: npt.NDArray[np.int64],
    rest: Rows,
    part: Rows,
    values: int,
) -> npt.NDArray[np.float32]:
    known = rest[column[rest] >= 0]
    if not len(known):
        return np.zeros((len(part), values), dtype=np.float32)
    head = fit_head(projection(embedded.pooled[known]), column[known], values=values)
    return head(projection(embedded.pooled[part]))


def _record(stack: Stack, column: npt.NDArray[np.int64], passes: float) -> EyesRecord:
    asked = stack.asked
    others = [way for way in stack.accuracies if way not in (*asked, "together")]
    beside = asked if len(asked) > 1 else others
    compared = ", ".join(f"{way} {stack.accuracies[way]:.1%}" for way in beside)
    layers = " and ".join(asked)
    return EyesRecord(
        layers=f"{layers} ({compared})" if compared else layers,
        validation_accuracy=stack.accuracy if stack.accuracy is not None else 1.0,
        accuracies=stack.accuracies,
        epochs=round(passes),
        training_pictures=int((column >= 0).sum()),
        validation_pictures=stack.pictures,
    )
