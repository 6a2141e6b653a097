"""Vary pictures, so that a few hundred count for more."""

from __future__ import annotations

import torch

from seewhy.perception.options import TrainingOptions

__all__ = ["augment"]


def augment(pictures: torch.Tensor, options: TrainingOptions) -> torch.Tensor:
    """Vary a batch as ``options`` say; randomness comes from PyTorch's CPU generator.

    Parameters
    ----------
    pictures : tensor of uint8, shape (n, size, size, 3)
        Left as it is.
    options : TrainingOptions
        See there.

    Returns
    -------
    tensor of float, shape (n, size, size, 3), about 0..255
    """
    n, size = pictures.shape[:2]
    device = pictures.device

    def uniform(*shape: int) -> torch.Tensor:
        return (torch.rand(shape) * 2 - 1).to(device)

    # Drawn on the CPU always, so that runs with and without a GPU see the same pictures.
    reach = options.shift * size
    offsets = torch.round(uniform(2, n, 1) * reach).long()
    places = torch.arange(size, device=device).expand(n, size)
    columns = places
    if options.flip:
        mirrored = torch.rand(n, 1).to(device) < 0.5
        columns = torch.where(mirrored, size - 1 - places, places)
    # Clamped indices repeat the border where the picture has moved away from it.
    rows = (places + offsets[0]).clamp(0, size - 1)
    columns = (columns + offsets[1]).clamp(0, size - 1)
    numbers = torch.arange(n, device=device)[:, None, None]
    varied = pictures[numbers, rows[:, :, None], columns[:, None, :]].float()

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
        varied += options.noise * torch.randn(1, size, size, 3).to(device)
    return varied
