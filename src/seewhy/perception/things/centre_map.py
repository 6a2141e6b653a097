"""A centre map: a small network on a backbone's maps that tells where the middles of things are.

Source: Zhou, Wang and Krähenbühl, "Objects as Points" (2019): a map of how likely the middle of a
thing lies in each cell, and the box around it. Departures: the backbone stays as it is, and the box
is learned in all cells near the middle by generalised intersection over union (Rezatofighi et al.
2019), so that it takes minutes and a few dozen pictures.
"""

from __future__ import annotations

from typing import NamedTuple

import torch
import torch.nn.functional as functional
from torch import nn

__all__ = ["STRIDE", "CentreMap", "Maps", "Predicted", "box_loss", "centre_loss"]

STRIDE = 8
"""Pixels of a picture from one cell of the map to the next."""

WIDTH = 48
"""Channels of the network."""

_RARE = -3.0  # logit of a middle before anything is learned: nearly all cells are none


class Maps(NamedTuple):
    """What a backbone makes of pictures: a fine map, and a coarse one of half as many cells."""

    fine: torch.Tensor
    coarse: torch.Tensor


class Predicted(NamedTuple):
    """What the network makes of n pictures.

    Attributes
    ----------
    centres : tensor of float, shape (n, rows, columns)
        Logits that the middle of a thing lies in a cell.
    boxes : tensor of float, shape (n, 4, rows, columns)
        Left, top, right and bottom in cells of the map.
    """

    centres: torch.Tensor
    boxes: torch.Tensor


class CentreMap(nn.Module):
    """Maps of a backbone → where things are.

    Parameters
    ----------
    fine, coarse : int
        Channels of the backbone's maps.

    Examples
    --------
    >>> maps = Maps(torch.zeros(1, 3, 8, 6), torch.zeros(1, 5, 4, 3))
    >>> CentreMap(3, 5)(maps).boxes.shape
    torch.Size([1, 4, 8, 6])
    """

    mean_fine: torch.Tensor
    scale_fine: torch.Tensor
    mean_coarse: torch.Tensor
    scale_coarse: torch.Tensor

    def __init__(self, fine: int, coarse: int) -> None:
        super().__init__()
        for name, channels in (("fine", fine), ("coarse", coarse)):
            self.register_buffer(f"mean_{name}", torch.zeros(channels))
            self.register_buffer(f"scale_{name}", torch.ones(channels))
        self.fine = nn.Conv2d(fine, WIDTH, 1)
        self.coarse = nn.Conv2d(coarse, WIDTH, 1)
        self.first = nn.Conv2d(WIDTH, WIDTH, 3, padding=1)
        self.second = nn.Conv2d(WIDTH, WIDTH, 3, padding=1)
        self.centre = nn.Conv2d(WIDTH, 1, 1)
        self.box = nn.Conv2d(WIDTH, 4, 1)
        nn.init.constant_(self.centre.bias, _RARE)  # type: ignore[arg-type]
        nn.init.zeros_(self.box.weight)
        nn.init.zeros_(self.box.bias)  # type: ignore[arg-type]

    def standardise_by(self, maps: Maps) -> None:
        """Take the mean and the deviation of each channel from the maps of training."""
        for name, values in zip(("fine", "coarse"), maps, strict=True):
            rows = values.permute(1, 0, 2, 3).flatten(1).float()
            getattr(self, f"mean_{name}").copy_(rows.mean(dim=1))
            getattr(self, f"scale_{name}").copy_(rows.std(dim=1).clamp_min(1e-3))

    def forward(self, maps: Maps) -> Predicted:
        """See the class."""
        fine = (maps.fine - self.mean_fine[:, None, None]) / self.scale_fine[:, None, None]
        coarse = (maps.coarse - self.mean_coarse[:, None, None]) / self.scale_coarse[:, None, None]
        wide = functional.interpolate(
            self.coarse(coarse), size=fine.shape[-2:], mode="bilinear", align_corners=False
        )
        seen = functional.relu(self.fine(fine) + wide)
        seen = functional.relu(self.first(seen))
        seen = functional.relu(seen + self.second(seen))
        return Predicted(self.centre(seen)[:, 0], _boxes(self.box(seen)))


def _boxes(found: torch.Tensor) -> torch.Tensor:
    """Offsets of middles in cells, and logarithms of lengths in cells, as corners."""
    rows = torch.arange(found.shape[-2], device=found.device)[:, None] + 0.5
    columns = torch.arange(found.shape[-1], device=found.device)[None, :] + 0.5
    lengths = torch.exp(found[:, 2:].clamp(-3.0, 4.0)) * 4.0
    across = columns + 2.0 * found[:, 0]
    down = rows + 2.0 * found[:, 1]
    wide, high = lengths[:, 0] / 2, lengths[:, 1] / 2
    return torch.stack([across - wide, down - high, across + wide, down + high], dim=1)


def centre_loss(logits: torch.Tensor, targets: torch.Tensor) -> torch.Tensor:
    """The focal loss of a centre map (Lin et al. 2017), less strict near a middle.

    Parameters
    ----------
    logits : tensor, shape (n, rows, columns)
    targets : tensor of the same shape
        1 where a middle lies, falling to 0 around it.
    """
    probabilities = torch.sigmoid(logits)
    middles = targets >= 1.0
    found = functional.logsigmoid(logits) * (1.0 - probabilities) ** 2
    denied = functional.logsigmoid(-logits) * probabilities**2 * (1.0 - targets) ** 4
    total = torch.where(middles, found, denied).sum()
    return -total / middles.sum().clamp_min(1)


def box_loss(boxes: torch.Tensor, true: torch.Tensor, weights: torch.Tensor) -> torch.Tensor:
    """1 less the generalised intersection over union, a weighted mean over cells.

    Parameters
    ----------
    boxes, true : tensor, shape (n, 4, rows, columns)
    weights : tensor, shape (n, rows, columns)
    """
    from_corner = torch.maximum(boxes[:, :2], true[:, :2])
    to_corner = torch.minimum(boxes[:, 2:], true[:, 2:])
    common = (to_corner - from_corner).clamp_min(0).prod(dim=1)
    areas = [(one[:, 2:] - one[:, :2]).prod(dim=1) for one in (boxes, true)]
    together = areas[0] + areas[1] - common
    around = (
        torch.maximum(boxes[:, 2:], true[:, 2:]) - torch.minimum(boxes[:, :2], true[:, :2])
    ).prod(dim=1)
    shares = common / together.clamp_min(1e-6) - (around - together) / around.clamp_min(1e-6)
    # What counts last are edges that are off by parts of a cell.
    edges = (
        (boxes - true).abs() / (true[:, 2:] - true[:, :2]).repeat(1, 2, 1, 1).clamp_min(1.0)
    ).mean(dim=1)
    return ((1.0 - shares + edges) * weights).sum() / weights.sum().clamp_min(1e-6)
