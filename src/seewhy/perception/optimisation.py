"""The optimiser of a network in training, and its learning rate."""

from __future__ import annotations

import math

import torch

from seewhy.perception.network import GrowingNetwork
from seewhy.perception.options import TrainingOptions

__all__ = ["load_optimizer", "new_optimizer", "one_cycle", "optimizer_tensors"]


def new_optimizer(network: GrowingNetwork, options: TrainingOptions) -> torch.optim.AdamW:
    """AdamW over the network; only matrices decay."""
    decayed, free = network.decayed_and_free()
    return torch.optim.AdamW(
        [
            {"params": decayed, "weight_decay": options.weight_decay},
            {"params": free, "weight_decay": 0.0},
        ],
        lr=options.learning_rate,
    )


def one_cycle(progress: float, *, rising: float = 0.25, least: float = 0.05) -> float:
    """The learning rate at ``progress`` (0..1) of a stage, as a share of the largest.

    It rises from ``least`` for a share ``rising`` of the stage, and falls in a cosine to 0.

    Examples
    --------
    >>> [round(one_cycle(progress), 2) for progress in (0, 0.25, 0.625, 1)]
    [0.05, 1.0, 0.5, 0.0]
    """
    if progress < rising:
        return least + (1 - least) * progress / rising
    return 0.5 + 0.5 * math.cos(math.pi * (progress - rising) / (1 - rising))


def optimizer_tensors(optimizer: torch.optim.Optimizer) -> dict[str, torch.Tensor]:
    """The state of an optimiser, by "parameter's number.name"."""
    state: dict[int, dict[str, torch.Tensor]] = optimizer.state_dict()["state"]
    return {f"{number}.{key}": tensor for number, of in state.items() for key, tensor in of.items()}


def load_optimizer(optimizer: torch.optim.Optimizer, tensors: dict[str, torch.Tensor]) -> None:
    """Put ``optimizer`` into a state that :func:`optimizer_tensors` gave."""
    state: dict[int, dict[str, torch.Tensor]] = {}
    for name, tensor in tensors.items():
        number, key = name.split(".")
        state.setdefault(int(number), {})[key] = tensor
    groups = optimizer.state_dict()["param_groups"]
    optimizer.load_state_dict({"state": state, "param_groups": groups})
    for weight, of in optimizer.state.items():
        for key, tensor in of.items():
            if tensor.shape == weight.shape:
                # A fused step takes weights and state in the order of the memory, whatever the
                # strides: files have them row by row, weights of other libraries may not.
                of[key] = torch.empty_like(weight, requires_grad=False).copy_(tensor)
