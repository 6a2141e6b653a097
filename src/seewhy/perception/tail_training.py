"""Tune the last stages of a backbone: a training loop over maps that were made before."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import torch
import torch.nn.functional as functional

from seewhy.perception.backbones.backbone import Maps
from seewhy.perception.randomness import seed_of, seeded
from seewhy.perception.side_by_side import side_by_side
from seewhy.perception.stacking import Table, log_probabilities
from seewhy.perception.tail import Tail

__all__ = ["Schedule", "see_with_tail", "train_tail"]

Targets = Mapping[str, npt.NDArray[np.int64]]
"""Feature → the index of each picture's value, -1 where nobody knows it."""

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
    rise : float, default 0.15
        Share of the steps in which the rates rise.
    weight_decay : float, default 0.02
        AdamW's.
    """

    passes: float
    rate: float = 1e-3
    new_rate: float = 3e-3
    rise: float = 0.15
    weight_decay: float = 0.02

    def share(self, done: float) -> float:
        """The share of the largest rates after a share of the steps."""
        if done < self.rise:
            return done / self.rise
        return 0.5 * (1.0 + math.cos(math.pi * (done - self.rise) / (1.0 - self.rise)))


def train_tail(
    tail: Tail,
    plain: Maps,
    varied: Maps,
    targets: Targets,
    rows: npt.NDArray[np.int64],
    schedule: Schedule,
    *,
    seed: tuple[object, ...],
    on_step: Callable[[int], None] | None = None,
) -> None:
    """Train a tail, all features at once, on the pictures at ``rows``.

    Parameters
    ----------
    tail : Tail
        Changed.
    plain : ndarray of float16, shape (n, channels, rows, columns)
    varied : ndarray of float16, shape (n, views, channels, rows, columns)
    targets : mapping of str to ndarray of int, shape (n,)
    rows : ndarray of int
    schedule : Schedule
    seed : tuple
        Settles the order, the variations and the dropout.
    on_step : callable, optional
        Called with the number of pictures gone over so far.
    """
    device = next(tail.parameters()).device
    answers = {name: torch.from_numpy(column).to(device) for name, column in targets.items()}
    optimizer = torch.optim.AdamW(
        [
            {"params": tail.tuned(), "lr": schedule.rate, "largest": schedule.rate},
            {"params": tail.new(), "lr": schedule.new_rate, "largest": schedule.new_rate},
        ],
        weight_decay=schedule.weight_decay,
        fused=True,
    )
    views = varied.shape[1] + 1
    total = max(1, round(len(rows) * schedule.passes / _BATCH))
    tail.train()
    order: list[int] = []
    generator = np.random.default_rng(seed_of(*seed, "order"))
    with seeded(device, *seed):
        for step in range(total):
            if len(order) < _BATCH:
                order += generator.permutation(rows).tolist()
            batch = np.array(order[:_BATCH])
            del order[:_BATCH]
            chosen = generator.integers(0, views, len(batch))
            maps = np.stack(
                [
                    plain[n] if view == 0 else varied[n, view - 1]
                    for n, view in zip(batch, chosen, strict=True)
                ]
            )
            for group in optimizer.param_groups:
                group["lr"] = group["largest"] * schedule.share((step + 0.5) / total)
            logits = tail(torch.from_numpy(maps).float().to(device))
            losses = []
            for name, column in answers.items():
                target = column[batch]
                if bool((target >= 0).any()):
                    losses.append(functional.cross_entropy(logits[name], target, ignore_index=-1))
            if not losses:
                continue
            optimizer.zero_grad(set_to_none=True)
            torch.stack(losses).mean().backward()  # type: ignore[no-untyped-call]
            optimizer.step()
            if on_step is not None:
                on_step((step + 1) * _BATCH)
    tail.eval()


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
    pieces = [plain[start : start + _SEEN] for start in range(0, max(1, len(plain)), _SEEN)]
    parts = side_by_side(see, pieces)
    return {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
