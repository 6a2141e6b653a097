"""Vary pictures, so that a few hundred count for more."""

from __future__ import annotations

import math
from collections.abc import Callable

import torch
import torch.nn.functional as functional

from seewhy.perception.options import TrainingOptions

__all__ = ["augment"]

Uniform = Callable[..., torch.Tensor]  # of a shape, from -1 to 1


def augment(
    pictures: torch.Tensor, options: TrainingOptions, *, generator: torch.Generator | None = None
) -> torch.Tensor:
    """Vary a batch as ``options`` say; randomness comes from a generator on the CPU.

    Parameters
    ----------
    pictures : tensor of uint8, shape (n, size, size, 3)
        Left as it is.
    options : TrainingOptions
        See there.
    generator : torch.Generator, optional
        PyTorch's own where left out.

    Returns
    -------
    tensor of float, shape (n, size, size, 3), about 0..255
    """
    n, size = pictures.shape[:2]
    device = pictures.device

    def uniform(*shape: int) -> torch.Tensor:
        # Drawn on the CPU always, so that runs with and without a GPU see the same pictures.
        return (torch.rand(shape, generator=generator) * 2 - 1).to(device)

    if options.rotate or options.scale or options.shear:
        varied = _tilted(pictures, options, uniform)
    else:
        varied = _moved(pictures, options, uniform)

    gain = (1 + options.brightness * uniform(n, 1, 1, 1)) * (
        1 + options.colour * uniform(n, 1, 1, 3)
    )
    spread = 1 + options.contrast * uniform(n, 1, 1, 1)
    middle = varied.mean(dim=(1, 2), keepdim=True)
    # (v - m)·s·g + m·g in one pass over the pixels.
    varied = varied * (spread * gain) + middle * (gain * (1 - spread))
    if options.noise > 0:
        # One field for the batch, another for each step: drawing one a picture would take
        # longer than all else here.
        varied += options.noise * torch.randn(1, size, size, 3, generator=generator).to(device)
    return varied


def _moved(pictures: torch.Tensor, options: TrainingOptions, uniform: Uniform) -> torch.Tensor:
    """Shift by whole pixels, which blurs nothing, and mirror."""
    n, size = pictures.shape[:2]
    device = pictures.device
    offsets = torch.round(uniform(2, n, 1) * options.shift * size).long()
    places = torch.arange(size, device=device).expand(n, size)
    columns = places
    if options.flip:
        # Below 0 of -1 to 1: half of them.
        mirrored = uniform(n, 1) < 0
        columns = torch.where(mirrored, size - 1 - places, places)
    # Clamped indices repeat the border where the picture has moved away from it.
    rows = (places + offsets[0]).clamp(0, size - 1)
    columns = (columns + offsets[1]).clamp(0, size - 1)
    numbers = torch.arange(n, device=device)[:, None, None]
    # Selecting whole pixels of one long row takes a quarter of the time of three indices.
    pixels = (numbers * size + rows[:, :, None]) * size + columns[:, None, :]
    chosen = pictures.reshape(-1, 3).index_select(0, pixels.flatten())
    return chosen.view(n, size, size, 3).float()


def _tilted(pictures: torch.Tensor, options: TrainingOptions, uniform: Uniform) -> torch.Tensor:
    """Rotate, stretch, slant, shift and mirror by one affine map a picture."""
    n = len(pictures)
    angle = uniform(n) * math.radians(options.rotate)
    across, along = (torch.exp(uniform(n) * math.log1p(options.scale)) for _ in range(2))
    slant = uniform(n) * options.shear
    # In coordinates from -1 to 1, as affine_grid has them.
    moves = uniform(2, n) * options.shift * 2
    if options.flip:
        across = torch.where(uniform(n) < 0, -across, across)
    cosine, sine = torch.cos(angle), torch.sin(angle)
    maps = torch.stack(
        [
            torch.stack([cosine * across, slant - sine * along, moves[0]], dim=1),
            torch.stack([sine * across, cosine * along, moves[1]], dim=1),
        ],
        dim=1,
    )
    upright = pictures.float().permute(0, 3, 1, 2)
    grid = functional.affine_grid(maps, list(upright.shape), align_corners=False)
    tilted = functional.grid_sample(upright, grid, padding_mode="border", align_corners=False)
    return tilted.permute(0, 2, 3, 1)
