"""A backbone whose layers stay as they are: what another library or a file offers."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import torch
from torch import nn

from seewhy.perception.backbones.backbone import Backbone, Embedded, Pictures, Trunk, halved, pool

__all__ = ["IMAGENET_MEAN", "IMAGENET_SCALE", "FrozenBackbone"]

IMAGENET_MEAN = (123.675, 116.28, 103.53)
IMAGENET_SCALE = (58.395, 57.12, 57.375)
"""What nearly all networks trained on ImageNet were shown: (level - mean) / scale."""

_SIDES = (1, 3, 5)  # to which the last map, the one before and the one before that are pooled

Look = Callable[[torch.Tensor], Sequence[torch.Tensor]]


class FrozenBackbone(Backbone):
    """Pictures → what a network makes of them at some of its layers; heads look at it.

    Parameters
    ----------
    name, digest, side, mean, scale
        As for :class:`~seewhy.perception.backbones.backbone.Backbone`.
    look : callable
        Takes pictures of shape (n, 3, side, side); gives what is looked at, the last layer last:
        maps of shape (n, channels, rows, columns), tokens (n, tokens, width), or numbers
        (n, width).
    module : nn.Module, optional
        What computes on a device; without it, the processor does.
    """

    def __init__(
        self,
        *,
        name: str,
        digest: str,
        side: int,
        look: Look,
        mean: Sequence[float] = IMAGENET_MEAN,
        scale: Sequence[float] = IMAGENET_SCALE,
        module: nn.Module | None = None,
    ) -> None:
        nothing = Trunk(nn.Sequential(), 0)
        super().__init__(
            name=name, digest=digest, side=side, mean=mean, scale=scale, trunk=nothing, taps=()
        )
        self._look = look
        self._module = module

    def to(self, device: torch.device) -> Backbone:
        """Move the weights to a device."""
        if self._module is None:
            return self
        self._module.to(device)
        return super().to(device)

    def _embed(self, pictures: Pictures) -> Embedded:
        with torch.inference_mode():
            found = list(self._look(self.shown(torch.from_numpy(pictures))))
            rows = [
                _flat(values, side) for values, side in zip(reversed(found), _SIDES, strict=False)
            ]
        middle = np.zeros((len(pictures), 0, 0, 0), dtype=np.float16)
        return Embedded(halved(torch.cat(rows[::-1], dim=1)), middle)


def _flat(values: torch.Tensor, side: int) -> torch.Tensor:
    if values.ndim == 4:
        return pool(values, side)
    return values.mean(dim=1) if values.ndim == 3 else values.flatten(1)
