"""Tune the last stages of a backbone: a training loop over maps that were made before.

It goes by steps, not by epochs: batches run on from one pass into the next, it is saved by the
clock, and it has no validation of its own (what comes of it is weighed against heads by pictures
that were kept out of it). The optimiser and the checkpoint are those of all trainings.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt
import torch
import torch.nn.functional as functional

from seewhy.perception.backbones.backbone import Maps
from seewhy.perception.checkpoint import Checkpoint
from seewhy.perception.lesson import Targets
from seewhy.perception.optimisation import (
    descend,
    load_optimizer,
    one_cycle,
    optimizer_tensors,
    slow_down,
)
from seewhy.perception.randomness import seed_of, seeded
from seewhy.perception.side_by_side import even_pieces, side_by_side
from seewhy.perception.stacking import Table, log_probabilities
from seewhy.perception.tail import Tail

__all__ = ["Schedule", "VariedMaps", "see_with_tail", "train_tail"]

SAVED_EVERY = 20.0
"""Seconds of training that a killed program loses at most."""

_BATCH = 16
_SEEN = 32  # pictures seen at a time: their maps stay in the processor's cache


@dataclass(frozen=True)
class Schedule:
    """How long and how fast a tail is trained.

    Attributes
    ----------
    passes : float
        Over the pictures, each time in another variation.
    rate : float, default 1e-3
        The largest learning rate of tuned stages; it rises to it and falls in a cosine to 0.
    new_rate : float, default 3e-3
        The same of heads.
    rising : float, default 0.15
        Share of the steps in which the rates rise.
    weight_decay : float, default 0.02
        AdamW's.
    """

    passes: float
    rate: float = 1e-3
    new_rate: float = 3e-3
    rising: float = 0.15
    weight_decay: float = 0.02


@dataclass(frozen=True, eq=False)
class VariedMaps:
    """What tails are trained by: maps of pictures and of their variations, and what they show.

    Attributes
    ----------
    plain : ndarray of float16, shape (n, channels, rows, columns)
    varied : ndarray of float16, shape (n, views, channels, rows, columns)
    targets : mapping of str to ndarray of int, shape (n,)
    """

    plain: Maps
    varied: Maps
    targets: Targets

    def some(self, pictures: npt.NDArray[np.int64], views: npt.NDArray[np.int64]) -> torch.Tensor:
        """The maps of pictures, each in one view; 0 is the picture as it is."""
        maps = [
            self.plain[picture] if view == 0 else self.varied[picture, view - 1]
            for picture, view in zip(pictures, views, strict=True)
        ]
        return torch.from_numpy(np.stack(maps)).float()


@dataclass
class _Position:
    """Where training stands between two steps: all but the tensors."""

    step: int = 0
    order: list[int] = field(default_factory=list)
    generator: dict[str, Any] = field(default_factory=dict)


def train_tail(
    tail: Tail,
    maps: VariedMaps,
    rows: npt.NDArray[np.int64],
    schedule: Schedule,
    *,
    seed: tuple[object, ...],
    kept: Checkpoint | None = None,
    on_step: Callable[[int], None] | None = None,
) -> None:
    """Train a tail, all features at once, on the pictures at ``rows``.

    Parameters
    ----------
    tail : Tail
        Changed.
    maps : VariedMaps
    rows : ndarray of int
    schedule : Schedule
    seed : tuple
        Settles the order, the variations and the dropout.
    kept : Checkpoint, optional
        Interrupted, training goes on from there and ends with the same weights (on a processor).
    on_step : callable, optional
        Called with the number of pictures gone over so far.
    """
    device = next(tail.parameters()).device
    answers = {name: torch.from_numpy(column).to(device) for name, column in maps.targets.items()}
    optimizer = torch.optim.AdamW(
        [
            {"params": tail.tuned(), "largest": schedule.rate},
            {"params": tail.new(), "largest": schedule.new_rate},
        ],
        weight_decay=schedule.weight_decay,
        fused=True,
    )
    views = maps.varied.shape[1] + 1
    total = max(1, round(len(rows) * schedule.passes / _BATCH))
    generator = np.random.default_rng(seed_of(*seed, "order"))
    position = _Position()
    tail.train()
    with seeded(device, *seed):
        if kept is not None:
            position = _resumed(tail, optimizer, generator, kept)
        saved = time.monotonic()
        while position.step < total:
            if len(position.order) < _BATCH:
                position.order += generator.permutation(rows).tolist()
            batch = np.array(position.order[:_BATCH])
            del position.order[:_BATCH]
            shown = maps.some(batch, generator.integers(0, views, len(batch))).to(device)
            progress = (position.step + 0.5) / total
            slow_down(optimizer, to=one_cycle(progress, rising=schedule.rising, least=0.0))
            _step(tail, optimizer, shown, {name: column[batch] for name, column in answers.items()})
            position.step += 1
            last = position.step == total
            if kept is not None and (last or time.monotonic() - saved >= SAVED_EVERY):
                _save(tail, optimizer, generator, position, kept)
                saved = time.monotonic()
            if on_step is not None:
                on_step(min(position.step * _BATCH, round(len(rows) * schedule.passes)))
    tail.eval()


def _step(
    tail: Tail,
    optimizer: torch.optim.Optimizer,
    shown: torch.Tensor,
    answers: dict[str, torch.Tensor],
) -> None:
    """One step by the mean loss of the features that somebody annotated in some picture."""
    logits = tail(shown)
    losses = [
        functional.cross_entropy(logits[name], answer, ignore_index=-1)
        for name, answer in answers.items()
        if bool((answer >= 0).any())
    ]
    if losses:
        descend(torch.stack(losses).mean(), optimizer)


def _save(
    tail: Tail,
    optimizer: torch.optim.Optimizer,
    generator: np.random.Generator,
    position: _Position,
    kept: Checkpoint,
) -> None:
    state: dict[str, Any] = dict(generator.bit_generator.state)
    where = _Position(position.step, position.order, state)
    tensors = {
        "tail": tail.state_dict(),
        "optimizer": optimizer_tensors(optimizer),
        "random": {"state": torch.get_rng_state()},
    }
    kept.write(where, tensors)


def _resumed(
    tail: Tail,
    optimizer: torch.optim.Optimizer,
    generator: np.random.Generator,
    kept: Checkpoint,
) -> _Position:
    """Where an earlier training was, with everything put as it was then; the start where none."""
    found = kept.read(_Position)
    if found is None:
        return _Position()
    position, tensors = found
    tail.load_state_dict(tensors["tail"])
    load_optimizer(optimizer, tensors.get("optimizer", {}))
    generator.bit_generator.state = position.generator
    torch.set_rng_state(tensors["random"]["state"])
    return position


def see_with_tail(tail: Tail, plain: Maps) -> dict[str, Table]:
    """Feature → logarithms of probabilities, shape (n, values), of pictures as they are.

    Parameters
    ----------
    tail : Tail
    plain : ndarray of float16, shape (n, channels, rows, columns)
    """
    device = next(tail.parameters()).device
    tail.eval()

    def see(maps: Maps) -> dict[str, Table]:
        with torch.inference_mode():
            logits = tail(torch.from_numpy(maps).float().to(device))
            return {
                name: log_probabilities(table.float().cpu().numpy())
                for name, table in logits.items()
            }

    # No picture at all is one empty piece.
    parts = side_by_side(see, even_pieces(plain, most=_SEEN) or [plain])
    return {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
