"""Which variations change nothing that is to be seen: found out from labelled pictures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt
import torch

from seewhy.perception.augmentation import augment
from seewhy.perception.backbones.backbone import Backbone
from seewhy.perception.heads import Floats, fit_head, fit_projection
from seewhy.perception.lesson import Lesson, Targets
from seewhy.perception.options import TrainingOptions
from seewhy.perception.randomness import seeded
from seewhy.perception.stacking import log_probabilities

__all__ = ["VARIED", "Judged", "chosen_variations"]

VARIED = TrainingOptions(
    shift=0.06,
    rotate=12.0,
    scale=0.15,
    shear=0.06,
    brightness=0.25,
    contrast=0.25,
    colour=0.1,
    noise=0.0,
)
"""How pictures are varied where nothing speaks against it.

They are mirrored only where the domain says so: what a few labelled pictures show of arrows and of
left hands is too little to find it out, and a mirror spoils them altogether.
"""

JUDGED = ("rotate", "scale")
"""Variations that change what is to be seen in some domains: a lean, a width."""

NAMES = {"rotate": "turned", "scale": "stretched"}

_PARTS = 3
_MOST = 240  # pictures by which a variation is judged
_FEWEST = 24
_ERRORS = 3.0  # standard errors of a loss that is clearly worse
_WORSE = 0.02  # and at least so much, in nats a picture

Pictures = npt.NDArray[np.uint8]


@dataclass(frozen=True)
class Judged:
    """What came of judging a variation.

    Attributes
    ----------
    variation : str
        Its key in ``[pictures]``.
    against : str or None
        The feature that is seen clearly worse with it; None where it is used.
    loss : float
        By how much more, in nats a picture, of the feature for which that is most.
    """

    variation: str
    against: str | None
    loss: float

    def say(self) -> str:
        """Say it in a sentence."""
        way = NAMES[self.variation]
        if self.against is None:
            return f"pictures are also shown {way}: no feature is seen worse for it"
        return f"pictures are not shown {way}: {self.against} would be seen worse"


def chosen_variations(
    backbone: Backbone,
    lesson: Lesson,
    pooled: npt.NDArray[np.float16],
    *,
    given: Mapping[str, float | bool],
    seed: int = 0,
) -> tuple[TrainingOptions, tuple[Judged, ...]]:
    """Vary as much as leaves every feature recognisable.

    For each variation that ``given`` does not settle, heads are fitted to pictures as they are,
    and to these with varied ones beside them, labelled alike. Where the second see some feature
    clearly worse in pictures that they were not fitted to, the variation changes that feature:
    what leans, once turned, stands upright.

    Parameters
    ----------
    backbone : Backbone
    lesson : Lesson
    pooled : ndarray of float16, shape (n, width)
        The embeddings of its pictures.
    given : mapping
        What a domain says itself.
    seed : int, default 0

    Returns
    -------
    options : TrainingOptions
        With the variations; nothing else of them is meant.
    judged : tuple of Judged
    """
    options = replace(VARIED, **given)  # type: ignore[arg-type]
    unsettled = [name for name in JUDGED if name not in given]
    parts = lesson.parts(_PARTS, seed=seed)
    if len(lesson) < _FEWEST or len(parts) < 2:
        cautious = {name: getattr(TrainingOptions(), name) for name in unsettled}
        return replace(options, **cautious), ()
    if not unsettled:
        return options, ()
    chosen = np.random.default_rng(seed).permutation(len(lesson))[:_MOST]
    pictures = lesson.pictures(chosen)
    projection = fit_projection(pooled, seed=seed)
    plain = projection(pooled[chosen])
    targets = {name: column[chosen] for name, column in lesson.targets().items()}
    part_of = np.zeros(len(lesson), dtype=np.int64)
    for number, part in enumerate(parts):
        part_of[part] = number
    where = part_of[chosen]
    before = _losses(plain, None, targets, where)
    judged = []
    for name in unsettled:
        varied = projection(backbone.embed(_varied(pictures, name, seed=seed)).pooled)
        against, loss = _worst(before, _losses(plain, varied, targets, where))
        judged.append(Judged(name, against, loss))
        if against is not None:
            options = replace(options, **{name: 0.0})  # type: ignore[arg-type]
    return options, tuple(judged)


def _varied(pictures: Pictures, name: str, *, seed: int) -> Pictures:
    """Pictures with one variation alone."""
    alone = replace(
        TrainingOptions(shift=0.0, brightness=0.0, contrast=0.0, colour=0.0, noise=0.0),
        **{name: getattr(VARIED, name)},
    )
    with seeded(torch.device("cpu"), seed, name):
        found: Pictures = augment(torch.from_numpy(pictures), alone).clamp(0, 255).byte().numpy()
    return found


def _losses(
    plain: Floats, varied: Floats | None, targets: Targets, where: npt.NDArray[np.int64]
) -> dict[str, npt.NDArray[np.float64]]:
    """Feature → the loss of each picture, by heads that were fitted to those of other parts."""
    found = {}
    for name, column in targets.items():
        losses = np.full(len(plain), np.nan)
        for part in np.unique(where):
            fitted, held = (column >= 0) & (where != part), (column >= 0) & (where == part)
            if not held.any() or len(np.unique(column[fitted])) < 2:
                continue
            rows, answers = plain[fitted], column[fitted]
            if varied is not None:
                rows = np.concatenate([rows, varied[fitted]])
                answers = np.concatenate([answers, answers])
            head = fit_head(rows, answers, values=int(column.max()) + 1)
            logs = log_probabilities(head(plain[held]))
            losses[held] = -logs[np.arange(len(logs)), column[held]]
        found[name] = losses
    return found


def _worst(
    before: Mapping[str, npt.NDArray[np.float64]], after: Mapping[str, npt.NDArray[np.float64]]
) -> tuple[str | None, float]:
    """The feature that is seen clearly worse, and by how much; else the largest loss."""
    ranked = []
    for name, losses in before.items():
        more = after[name] - losses
        more = more[~np.isnan(more)]
        if len(more) > 1:
            error = max(float(more.std()) / np.sqrt(len(more)), 1e-9)
            ranked.append((float(more.mean()) / error, float(more.mean()), name))
    if not ranked:
        return None, 0.0
    clearly = [row for row in ranked if row[0] > _ERRORS and row[1] > _WORSE]
    if clearly:
        _, loss, name = max(clearly, key=lambda row: row[1])
        return name, loss
    return None, max(loss for _, loss, _ in ranked)
