"""The last stages of a backbone, tuned to the pictures at hand, with a head for each feature."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import deepcopy

import numpy as np
import torch
from torch import nn

from seewhy.perception.backbones.backbone import Backbone, Tap, pool

__all__ = ["Tail", "new_tail"]

DROPOUT = 0.2


class Tail(nn.Module):
    """Maps of a backbone's middle → logits of every feature.

    All features share the stages: what one learns to see, the others see as well.

    Parameters
    ----------
    stages : nn.Sequential
    taps : sequence of Tap
        Stages (counted from the first of these) whose maps are pooled and laid side by side.
    widths : sequence of int
        Numbers that each tap gives.
    values : mapping of str to int
        Feature → number of its values.

    Notes
    -----
    Depthwise convolutions keep their weights: their gradient takes longer than all else together,
    and tuning them was no better.
    """

    def __init__(
        self,
        stages: nn.Sequential,
        *,
        taps: Sequence[Tap],
        widths: Sequence[int],
        values: Mapping[str, int],
    ) -> None:
        super().__init__()
        self.stages = stages
        self.taps = tuple(taps)
        self.norms = nn.ModuleList([nn.LayerNorm(width) for width in widths])
        self.dropout = nn.Dropout(DROPOUT)
        # A module's name must have no dot, a feature's must not be one of nn.Module's own words.
        self.heads = nn.ModuleDict(
            {f"head {name}": nn.Linear(sum(widths), count) for name, count in values.items()}
        )

    def embeddings(self, middle: torch.Tensor) -> torch.Tensor:
        """What the heads look at: shape (n, width)."""
        sides = {tap.stage: tap.side for tap in self.taps}
        parts: list[torch.Tensor] = []
        maps = middle
        for number, stage in enumerate(self.stages):
            maps = stage(maps)
            if number in sides:
                parts.append(self.norms[len(parts)](pool(maps, sides[number])))
        return torch.cat(parts, dim=1)

    def forward(self, middle: torch.Tensor) -> dict[str, torch.Tensor]:
        """Feature → logits for maps of shape (n, channels, rows, columns)."""
        kept = self.dropout(self.embeddings(middle))
        return {name.removeprefix("head "): head(kept) for name, head in self.heads.items()}

    def tuned(self) -> list[nn.Parameter]:
        """The weights of the stages that are tuned."""
        return [weight for weight in self.stages.parameters() if weight.requires_grad]

    def new(self) -> list[nn.Parameter]:
        """The weights that no backbone had."""
        return [*self.norms.parameters(), *self.heads.parameters()]


def new_tail(backbone: Backbone, values: Mapping[str, int]) -> Tail:
    """A tail from a backbone's weights, with untrained heads.

    Parameters
    ----------
    backbone : Backbone
        A tunable one.
    values : mapping of str to int
        Feature → number of its values.
    """
    trunk = backbone.trunk
    stages = nn.Sequential(*deepcopy(list(trunk.stages)[trunk.tuned_from :]))
    taps = [Tap(tap.stage - trunk.tuned_from, tap.side) for tap in trunk.taps]
    for module in stages.modules():
        depthwise = getattr(module, "groups", 1) > 1
        for weight in module.parameters(recurse=False):
            weight.requires_grad_(not depthwise)
    sides = {tap.stage: tap.side for tap in taps}
    widths = []
    blank = np.zeros((1, backbone.side, backbone.side, 3), dtype=np.uint8)
    maps = torch.from_numpy(backbone.embed(blank).middle).float().to(backbone.device)
    with torch.no_grad():
        for number, stage in enumerate(stages):
            maps = stage(maps)
            if number in sides:
                widths.append(pool(maps, sides[number]).shape[1])
    return Tail(stages, taps=taps, widths=widths, values=values).to(backbone.device)
