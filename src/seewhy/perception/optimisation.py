"""The optimiser of a network in training, and its learning rate."""

from __future__ import annotations

import math

import torch

from seewhy.perception.network import GrowingNetwork
from seewhy.perception.options import TrainingOptions

__all__ = [
    "descend",
    "load_optimizer",
    "new_optimizer",
    "one_cycle",
    "optimizer_tensors",
    "slow_down",
]


def new_optimizer(
    network: GrowingNetwork, options: TrainingOptions, *, largest: float
) -> torch.optim.AdamW:
    """AdamW over the network, with its largest learning rate; only matrices decay."""
    decayed, free = network.decayed_and_free()
    return torch.optim.AdamW(
        [
            {"params": decayed, "weight_decay": options.weight_decay, "largest": largest},
            {"params": free, "weight_decay": 0.0, "largest": largest},
        ],
    )


def slow_down(optimizer: torch.optim.Optimizer, *, to: float) -> None:
    """Set every group's learning rate to a share of its entry "largest".

    Examples
    --------
    >>> weights = [torch.nn.Parameter(torch.zeros(1))]
    >>> optimizer = torch.optim.AdamW([{"params": weights, "largest": 0.1}])
    >>> slow_down(optimizer, to=0.5)
    >>> optimizer.param_groups[0]["lr"]
    0.05
    """
    for group in optimizer.param_groups:
        group["lr"] = group["largest"] * to


def descend(
    loss: torch.Tensor, optimizer: torch.optim.Optimizer, *, steepest: float | None = None
) -> None:
    """Take one step down the gradient of a loss, whose norm is cut to ``steepest`` where given."""
    optimizer.zero_grad(set_to_none=True)
    loss.backward()  # type: ignore[no-untyped-call]
    if steepest is not None:
        weights = [weight for group in optimizer.param_groups for weight in group["params"]]
        torch.nn.utils.clip_grad_norm_(weights, steepest)
    optimizer.step()


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
