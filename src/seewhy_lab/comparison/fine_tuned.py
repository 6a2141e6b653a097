"""(d) The whole backbone, tuned end to end for the class: a loop that one reads in one sitting."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np
import numpy.typing as npt
import torch
import torch.nn.functional as functional
from torch import nn

from seewhy.data.dataset import Dataset
from seewhy.perception.augmentation import augment
from seewhy.perception.backbones.efficientnet_lite import efficientnet_lite0
from seewhy.perception.device import device_of
from seewhy.perception.epochs import batches
from seewhy.perception.optimisation import descend, one_cycle, slow_down
from seewhy.perception.options import TrainingOptions
from seewhy.perception.randomness import seeded
from seewhy_lab.comparison.system import Drawings, Fitted
from seewhy_lab.comparison.variations import same_variations, varied

__all__ = ["MOST", "fit_fine_tuned"]

MOST = 500
"""Labels that a processor has the patience for."""

SIDE = 112
"""The side of pictures, in pixels: that of SeeWhy's eyes."""

RATE, NEW_RATE = 3e-4, 3e-3
"""The largest learning rates, of the backbone and of the layer for the class."""

WEIGHT_DECAY, DROPOUT = 0.02, 0.2
BATCH = 16
GONE_OVER, PASSES = 12_000, (24, 60)
"""Pictures gone over in all, and the fewest and most passes over those that there are."""

DRAWN_GONE_OVER = 46_500
"""Drawings gone over in all, at most, where there are some: five times 9,300."""

_SEEN = 64  # pictures classified at a time


class ClassNetwork(nn.Module):
    """Every stage of EfficientNet-Lite0, the mean of its last map, and a layer for the class."""

    def __init__(self, classes: int) -> None:
        super().__init__()
        self.stages = efficientnet_lite0().requires_grad_(True)
        with torch.no_grad():
            width = self.stages(torch.zeros(1, 3, SIDE, SIDE)).shape[1]
        self.norm = nn.LayerNorm(width)
        self.dropout = nn.Dropout(DROPOUT)
        self.head = nn.Linear(width, classes)

    def forward(self, pictures: torch.Tensor) -> torch.Tensor:
        """Pictures of shape (n, side, side, 3), in 0..255 → logits of shape (n, classes)."""
        levels = ((pictures.float() - 127.0) / 128.0).permute(0, 3, 1, 2)
        pooled = self.stages(levels).mean(dim=(2, 3))
        logits: torch.Tensor = self.head(self.dropout(self.norm(pooled)))
        return logits


def fit_fine_tuned(train: Dataset, seed: int, drawings: Drawings | None) -> Fitted:
    """Tune every weight with AdamW and one cycle of the learning rate."""
    classes = tuple(train.domain.classes)
    targets = _targets(train)
    passes = int(np.clip(round(GONE_OVER / len(train)), *PASSES))
    variations = same_variations(train, seed=seed)
    device = device_of("auto")
    with seeded(device, seed, "fine-tuned"):
        network = ClassNetwork(len(classes)).to(device)
        if drawings is not None:
            network.load_state_dict(_knowing_drawings(drawings))
        _train(network, train.pictures(SIDE), targets, variations, passes=passes)

    def classify(pictures: Dataset) -> Sequence[str | None]:
        return [classes[n] for n in _best(network, pictures.pictures(SIDE))]

    options = {
        "passes": passes,
        "rate": RATE,
        "new_rate": NEW_RATE,
        "weight_decay": WEIGHT_DECAY,
        "dropout": DROPOUT,
        "batch": BATCH,
        "side": SIDE,
        "device": device.type,
        **varied(variations),
    }
    return Fitted(classify, options)


@cache
def _knowing_drawings(drawings: Drawings) -> dict[str, torch.Tensor]:
    scenes = drawings.scenes()
    variations = same_variations(scenes, seed=0)
    device = device_of("auto")
    with seeded(device, "fine-tuned by drawings"):
        network = ClassNetwork(len(scenes.domain.classes)).to(device)
        passes = max(1, min(PASSES[1], DRAWN_GONE_OVER // len(scenes)))
        _train(network, scenes.pictures(SIDE), _targets(scenes), variations, passes=passes)
    return network.state_dict()


def _targets(scenes: Dataset) -> npt.NDArray[np.int64]:
    classes = list(scenes.domain.classes)
    return np.array([classes.index(label) for label in scenes.classes], dtype=np.int64)


def _train(
    network: ClassNetwork,
    pictures: npt.NDArray[np.uint8],
    targets: npt.NDArray[np.int64],
    variations: TrainingOptions,
    *,
    passes: int,
) -> None:
    device = network.head.weight.device
    new = [*network.norm.parameters(), *network.head.parameters()]
    optimizer = torch.optim.AdamW(
        [
            {"params": list(network.stages.parameters()), "largest": RATE},
            {"params": new, "largest": NEW_RATE},
        ],
        weight_decay=WEIGHT_DECAY,
    )
    x, y = torch.from_numpy(pictures), torch.from_numpy(targets)
    rows = torch.arange(len(x))
    network.train()
    for epoch in range(passes):
        for batch in batches(rows, size=BATCH, epoch=epoch, epochs=passes):
            slow_down(optimizer, to=one_cycle(batch.progress))
            logits = network(augment(x[batch.rows].to(device), variations).clamp(0, 255))
            descend(functional.cross_entropy(logits, y[batch.rows].to(device)), optimizer)
    network.eval()


def _best(network: ClassNetwork, pictures: npt.NDArray[np.uint8]) -> list[int]:
    """The number of the most probable class of each picture."""
    device = network.head.weight.device
    found: list[int] = []
    with torch.inference_mode():
        for some in torch.split(torch.from_numpy(pictures), _SEEN):
            found += network(some.to(device)).argmax(dim=1).tolist()
    return found
