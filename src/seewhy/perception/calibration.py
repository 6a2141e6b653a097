"""Temperature scaling: probabilities that are as often right as they say."""

from __future__ import annotations

import math

import torch
import torch.nn.functional as functional

__all__ = ["fitted_temperature"]


def fitted_temperature(*heldout: tuple[torch.Tensor, torch.Tensor]) -> float:
    """The number, 0.1 to 20, by which to divide logits so that held-out targets are most likely.

    Of several networks, one number for all.

    Targets are softened as Platt (1999) does, by one supposed mistake: a validation split
    without any is no proof that there never will be one.

    Parameters
    ----------
    heldout : (tensor of float, shape (n, values), tensor of int, shape (n,))
        A network's logits, on the CPU, of at least two values; the index of each picture's value.

    Examples
    --------
    >>> sure = torch.tensor([[8.0, 0.0]] * 10)
    >>> wrong_in_two = torch.tensor([0] * 8 + [1] * 2)
    >>> fitted_temperature((sure, wrong_in_two)) > 5
    True
    """
    from scipy.optimize import minimize_scalar  # slow to import, and seeing needs none of it

    networks = [(logits.double(), _softened(logits, targets)) for logits, targets in heldout]

    def loss(logarithm: float) -> float:
        scale = math.exp(logarithm)
        return sum(
            float(functional.cross_entropy(logits / scale, soft)) for logits, soft in networks
        )

    found = minimize_scalar(loss, bounds=(math.log(0.1), math.log(20.0)), method="bounded")
    return math.exp(float(found.x))


def _softened(logits: torch.Tensor, targets: torch.Tensor) -> torch.Tensor:
    n, values = logits.shape
    wrong = 1.0 / (n + 2.0)
    soft = torch.full((n, values), wrong / (values - 1), dtype=torch.float64)
    soft[torch.arange(n), targets] = 1.0 - wrong
    return soft
