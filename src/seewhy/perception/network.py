"""A convolutional network that starts small and grows."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Literal

import numpy as np
import numpy.typing as npt
import torch
from torch import nn

__all__ = ["CHANNELS", "GrowingNetwork", "Standard", "deepest"]

CHANNELS = (8, 16, 32, 64)
"""Channels of the first convolutions; further ones have as many as the last."""

Standard = Literal["set", "picture"]
"""By whose mean and deviation a picture is standardised: all pictures' or its own."""

DARKEST = 4.0
"""Least deviation, in levels of 0..255, by which a picture's own is divided: noise stays noise."""


def deepest(size: int) -> int:
    """The depth at which pooling has left 2×2 or 3×3 points: no further one would see more.

    Examples
    --------
    >>> deepest(56)
    4
    """
    return max(1, size.bit_length() - 2)


class GrowingNetwork(nn.Module):
    """One feature's network: convolutions with pooling, a dense layer, dropout, the logits.

    It starts with one convolution and :meth:`grow` adds one at a time; see
    :func:`seewhy.perception.training.train_network` for when.

    Parameters
    ----------
    size : int
        Side of the pictures, in pixels; at least 8.
    values : int
        Number of values of the feature: one logit each.
    depth : int, default 1
        Number of convolutions, 1 to :attr:`deepest`.
    dropout : float, default 0.5
        Share of the dense layer's outputs that are dropped in training.
    dense : int, default 64
        Width of the dense layer.
    channels : sequence of int, default (8, 16, 32, 64)
        Channels of the first convolutions; further ones have as many as the last.
    standard : {"set", "picture"}, default "set"
        "picture" takes each picture's own mean brightness and deviation, over all channels
        alike: for photographs between shade and glare, where no value depends on the light.

    Attributes
    ----------
    mean, deviation : tensor of float, shape (3,)
        Of the training pictures, per channel; pictures are standardised by them.
    temperature : tensor of float, scalar
        Divides the logits so that probabilities are honest; fitted on the validation pictures.
    shown : tensor of bool, shape (values,)
        The values that it was trained on a picture of; of the others it knows only what they are
        not.

    Notes
    -----
    Source: Riley and Sridharan (2019), feature extraction with convolutional networks: one
    network for each feature, grown until it is accurate enough. Departures: batch
    normalisation follows every convolution, which the paper does not have but which lets a few
    hundred pictures suffice within a few epochs; pooling comes before normalisation and ReLU,
    which gives nearly the same function at a quarter of the work; a temperature makes the
    probabilities honest. The paper's layers alone are had by removing ``BatchNorm2d`` from
    ``_block``.

    Examples
    --------
    >>> network = GrowingNetwork(size=56, values=5)
    >>> network.grow()
    >>> network.layers
    'conv 3→8, pool, conv 8→16, pool, dense 64, dropout 0.5, logits 5'
    """

    mean: torch.Tensor
    deviation: torch.Tensor
    temperature: torch.Tensor
    shown: torch.Tensor

    def __init__(
        self,
        *,
        size: int,
        values: int,
        depth: int = 1,
        dropout: float = 0.5,
        dense: int = 64,
        channels: Sequence[int] = CHANNELS,
        standard: Standard = "set",
    ) -> None:
        super().__init__()
        self.size = size
        self.values = values
        self.dropout = dropout
        self.dense = dense
        self.channels = tuple(channels)
        self.standard: Standard = standard
        if not 1 <= depth <= self.deepest:
            raise ValueError(f"depth must be 1 to {self.deepest} for pictures of {size} pixels")
        self.blocks = nn.ModuleList([self._block(i) for i in range(depth)])
        self.head: nn.Sequential = self._new_head()
        self.register_buffer("mean", torch.full((3,), 127.5))
        self.register_buffer("deviation", torch.full((3,), 64.0))
        self.register_buffer("temperature", torch.ones(()))
        self.register_buffer("shown", torch.zeros(values, dtype=torch.bool))

    @property
    def depth(self) -> int:
        """Number of convolutions."""
        return len(self.blocks)

    @property
    def deepest(self) -> int:
        """The greatest depth that pictures of this size allow, see :func:`deepest`."""
        return deepest(self.size)

    @property
    def layers(self) -> str:
        """The layers in words, from the picture to the logits."""
        parts = []
        for i in range(self.depth):
            parts += [f"conv {self._channels(i - 1)}→{self._channels(i)}", "pool"]
        parts += [f"dense {self.dense}", f"dropout {self.dropout:g}", f"logits {self.values}"]
        return ", ".join(parts)

    @property
    def parameters_count(self) -> int:
        """Number of trained weights."""
        return sum(parameter.numel() for parameter in self.parameters())

    def grow(self) -> None:
        """Add a convolution and pooling; earlier convolutions keep their weights, the head is new.

        Raises
        ------
        ValueError
            The network is as deep as its pictures allow.
        """
        if self.depth >= self.deepest:
            raise ValueError(f"a network for {self.size} pixels has at most {self.deepest} layers")
        self.blocks.append(self._block(self.depth).to(self.mean.device))
        self.head = self._new_head().to(self.mean.device)

    def of_depth(self, depth: int) -> GrowingNetwork:
        """A new network like this one with ``depth`` convolutions."""
        return GrowingNetwork(
            size=self.size,
            values=self.values,
            depth=depth,
            dropout=self.dropout,
            dense=self.dense,
            channels=self.channels,
            standard=self.standard,
        )

    def adopt(self, other: GrowingNetwork) -> None:
        """Take depth, convolutions and standardisation from ``other``.

        Its head, and what that was shown, if it fits.
        """
        self.channels, self.standard, self.dense = other.channels, other.standard, other.dense
        self.blocks = nn.ModuleList([self._block(i) for i in range(min(other.depth, self.deepest))])
        for block, source in zip(self.blocks, other.blocks, strict=False):
            block.load_state_dict(source.state_dict())
        self.mean.copy_(other.mean)
        self.deviation.copy_(other.deviation)
        self.head = self._new_head()
        if (self.size, self.values) == (other.size, other.values):
            self.head.load_state_dict(other.head.state_dict())
            self.shown.copy_(other.shown)

    def is_shown(self, targets: npt.NDArray[np.int64]) -> None:
        """Remember that pictures of the values at these places train it."""
        self.shown[torch.as_tensor(np.unique(targets), device=self.shown.device)] = True

    def standardise_by(self, pictures: npt.NDArray[np.uint8]) -> None:
        """Set mean and deviation to those of ``pictures``, uint8 of shape (n, size, size, 3)."""
        flat = pictures.reshape(-1, 3)
        self.mean.copy_(torch.as_tensor(flat.mean(axis=0, dtype=np.float64)))
        # A picture set of one colour has no deviation to divide by.
        deviation = np.maximum(flat.std(axis=0, dtype=np.float64), 1.0)
        self.deviation.copy_(torch.as_tensor(deviation))

    def always(self, logits: torch.Tensor) -> None:
        """Give ``logits``, shape (values,), whatever the picture."""
        last = self.head[-1]
        assert isinstance(last, nn.Linear)
        with torch.no_grad():
            last.weight.zero_()
            last.bias.copy_(logits)

    def forward(self, pictures: torch.Tensor) -> torch.Tensor:
        """Logits of shape (n, values) for pictures of shape (n, size, size, 3) in 0..255."""
        return self.logits(self.embeddings(pictures))

    def embeddings(self, pictures: torch.Tensor) -> torch.Tensor:
        """Outputs of the dense layer, shape (n, dense): what the logits are computed from."""
        # Rows × columns × channels in memory is what PyTorch calls channels last: no copy.
        state = self._standardised(pictures.float()).permute(0, 3, 1, 2)
        for block in self.blocks:
            state = block(state)
        flatten, dense, relu, _, _ = self.head
        outputs: torch.Tensor = relu(dense(flatten(state)))
        return outputs

    def see(self, pictures: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor]:
        """Calibrated probabilities, shape (n, values), and the embeddings that they come from."""
        embeddings = self.embeddings(pictures)
        return torch.softmax(self.logits(embeddings) / self.temperature, dim=1), embeddings

    def logits(self, embeddings: torch.Tensor) -> torch.Tensor:
        """Logits of shape (n, values) for embeddings of shape (n, dense)."""
        *_, dropout, last = self.head
        found: torch.Tensor = last(dropout(embeddings))
        return found

    def decayed_and_free(self) -> tuple[list[nn.Parameter], list[nn.Parameter]]:
        """Parameters that weight decay shrinks (matrices) and those it leaves alone (vectors)."""

        def of(matrices: bool) -> Iterator[nn.Parameter]:
            return (
                parameter for parameter in self.parameters() if (parameter.ndim > 1) == matrices
            )

        return list(of(True)), list(of(False))

    def _standardised(self, pictures: torch.Tensor) -> torch.Tensor:
        if self.standard == "set":
            return (pictures - self.mean) / self.deviation
        # Over all channels at once: what is blue stays blue.
        deviation, mean = torch.std_mean(pictures, dim=(1, 2, 3), keepdim=True)
        return (pictures - mean) / deviation.clamp_min(DARKEST)

    def _new_head(self) -> nn.Sequential:
        side = self.size >> self.depth
        return nn.Sequential(
            nn.Flatten(),
            nn.Linear(side * side * self._channels(self.depth - 1), self.dense),
            nn.ReLU(),
            nn.Dropout(self.dropout),
            nn.Linear(self.dense, self.values),
        )

    def _channels(self, index: int) -> int:
        """Channels after the convolution ``index``; -1 is the picture."""
        return 3 if index < 0 else self.channels[min(index, len(self.channels) - 1)]

    def _block(self, index: int) -> nn.Sequential:
        """A convolution and its pooling."""
        channels = self._channels(index)
        return nn.Sequential(
            nn.Conv2d(self._channels(index - 1), channels, 3, padding=1, bias=False),
            nn.MaxPool2d(2),
            nn.BatchNorm2d(channels),
            nn.ReLU(),
        )
