"""Labels as numbers: which pictures have one, and how much each value weighs in the loss."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
import torch

from seewhy.errors import DatasetError

__all__ = ["labelled", "value_weights"]


def labelled(
    labels: Sequence[str | None], *, feature: str, values: Sequence[str]
) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """Indices of the labelled pictures, and the index of each one's value.

    Raises
    ------
    DatasetError
        No picture is labelled, or a label is none of the values.

    Examples
    --------
    >>> labelled(["on", None, "off"], feature="light", values=["on", "off"])
    (array([0, 2]), array([0, 1]))
    """
    number = {value: i for i, value in enumerate(values)}
    wrong = next((x for x in labels if x is not None and x not in number), None)
    if wrong is not None:
        raise DatasetError(
            f"{feature} must be one of {', '.join(values)}, got {wrong!r}: "
            "correct the label, or leave it empty if it is unknown"
        )
    indices = [i for i, label in enumerate(labels) if label is not None]
    if not indices:
        raise DatasetError(
            f"no picture has a label for {feature}: label some pictures (a few hundred are "
            "better), or remove the feature from the domain"
        )
    targets = [number[label] for label in labels if label is not None]
    return np.array(indices, dtype=np.int64), np.array(targets, dtype=np.int64)


def value_weights(targets: npt.NDArray[np.int64], values: int, balance: float) -> torch.Tensor:
    """Weight of each value in the loss; their mean over the pictures is 1."""
    counts = np.maximum(np.bincount(targets, minlength=values), 1)
    weights = counts**-balance
    return torch.as_tensor(weights / weights[targets].mean(), dtype=torch.float32)
