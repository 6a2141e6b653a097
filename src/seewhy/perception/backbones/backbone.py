"""A backbone: a network that has seen millions of pictures before it sees yours."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
import torch
import torch.nn.functional as functional
from torch import nn

from seewhy.perception.side_by_side import even_pieces, side_by_side

__all__ = ["Backbone", "Embedded", "Tap", "Trunk", "halved", "pool"]

Pictures = npt.NDArray[np.uint8]
Maps = npt.NDArray[np.float16]

CHUNK = 8
"""Pictures that one thread looks at together: their maps stay in the processor's cache."""

ON_DEVICE = 256
"""The same on a graphics processor, which wants many."""


class Embedded(NamedTuple):
    """What a backbone makes of n pictures, in half precision.

    Attributes
    ----------
    pooled : ndarray of float16, shape (n, width)
        The maps of its taps, pooled and laid side by side: what heads are fitted to.
    middle : ndarray of float16, shape (n, channels, rows, columns)
        The map from which its last stages, once they are tuned, go on; of no channels where a
        backbone cannot be tuned.
    """

    pooled: npt.NDArray[np.float16]
    middle: Maps

    def of(self, pictures: npt.NDArray[np.int64]) -> Embedded:
        """What it makes of the pictures at some positions."""
        return Embedded(self.pooled[pictures], self.middle[pictures])


@dataclass(frozen=True)
class Tap:
    """A stage whose map is looked at, and the side to which it is pooled."""

    stage: int
    side: int


@dataclass(frozen=True, eq=False)
class Trunk:
    """The stages of a backbone that run one after another, and which of them may be tuned.

    Attributes
    ----------
    stages : nn.Sequential
    tuned_from : int
        The first stage that may be tuned to pictures at hand; those before stay as they are.
        All stages where none may.
    taps : tuple of Tap
        Of the tuned stages: what heads of their own look at.
    """

    stages: nn.Sequential
    tuned_from: int
    taps: tuple[Tap, ...] = ()


class Backbone:
    """Pictures → maps of its stages; made by :func:`~seewhy.perception.backbones.load_backbone`.

    Parameters
    ----------
    name : str
        As a domain says it.
    digest : str
        Of the weights and of what is looked at, in hexadecimal: others make other embeddings.
    side : int
        The side of the pictures that it looks at, in pixels.
    mean, scale : sequence of float, length 3
        A level of 0..255 is shown as (level - mean) / scale, for red, green and blue.
    trunk : Trunk
    taps : sequence of Tap
        Whose maps make up the embedding, from the first to the last.
    """

    def __init__(
        self,
        *,
        name: str,
        digest: str,
        side: int,
        mean: Sequence[float],
        scale: Sequence[float],
        trunk: Trunk,
        taps: Sequence[Tap],
    ) -> None:
        self.name, self.digest, self.side = name, digest, side
        self.trunk = trunk
        self.taps = tuple(taps)
        self.device = torch.device("cpu")
        self._mean, self._scale = torch.tensor(mean), torch.tensor(scale)

    @property
    def tunable(self) -> bool:
        """Whether its last stages may be tuned."""
        return self.trunk.tuned_from < len(self.trunk.stages)

    def embed(self, pictures: Pictures) -> Embedded:
        """Look at pictures.

        Parameters
        ----------
        pictures : ndarray of uint8, shape (n, side, side, 3)
        """
        found = self._in_chunks(pictures, self._embed)
        if not found:
            found = [self._embed(np.zeros((1, self.side, self.side, 3), dtype=np.uint8))]
            return Embedded(found[0].pooled[:0], found[0].middle[:0])
        return Embedded(
            np.concatenate([part.pooled for part in found]),
            np.concatenate([part.middle for part in found]),
        )

    def middle(self, pictures: torch.Tensor) -> Maps:
        """The map from which tuned stages go on, at the cost of the stages before alone.

        Parameters
        ----------
        pictures : tensor of float, shape (n, side, side, 3), in 0..255
        """
        *_, (_, maps) = self._run(pictures, until=self.trunk.tuned_from)
        return halved(maps)

    def stage_maps(self, pictures: Pictures, stages: Collection[int]) -> dict[int, torch.Tensor]:
        """The maps of some stages, of pictures of any shape.

        Parameters
        ----------
        pictures : ndarray of uint8, shape (n, rows, columns, 3)
        stages : collection of int
            Of the trunk.
        """
        levels = torch.from_numpy(np.require(pictures, requirements=["C", "W"]))
        return {
            number: maps
            for number, maps in self._run(levels, until=max(stages) + 1)
            if number in stages
        }

    def to(self, device: torch.device) -> Backbone:
        """Move the weights to a device."""
        self.device = device
        self.trunk.stages.to(device)
        self._mean, self._scale = self._mean.to(device), self._scale.to(device)
        return self

    def shown(self, pictures: torch.Tensor) -> torch.Tensor:
        """Pictures of shape (n, side, side, 3) as the network takes them: (n, 3, side, side)."""
        levels = (pictures.to(self.device).float() - self._mean) / self._scale
        # Rows × columns × channels in memory is what PyTorch calls channels last: no copy.
        return levels.permute(0, 3, 1, 2)

    def _in_chunks(
        self, pictures: Pictures, look: Callable[[Pictures], Embedded]
    ) -> list[Embedded]:
        if self.device.type != "cpu":
            starts = range(0, len(pictures), ON_DEVICE)
            return [look(pictures[start : start + ON_DEVICE]) for start in starts]
        return side_by_side(look, even_pieces(pictures, most=CHUNK))

    def _embed(self, pictures: Pictures) -> Embedded:
        sides = {tap.stage: tap.side for tap in self.taps}
        last = max(sides) + 1
        pooled = []
        middle = np.zeros((len(pictures), 0, 0, 0), dtype=np.float16)
        for number, maps in self._run(torch.from_numpy(pictures), until=last):
            if number in sides:
                pooled.append(pool(maps, sides[number]))
            if number == self.trunk.tuned_from - 1 and self.tunable:
                middle = halved(maps)
        return Embedded(halved(torch.cat(pooled, dim=1)), middle)

    def _run(self, pictures: torch.Tensor, *, until: int) -> Iterator[tuple[int, torch.Tensor]]:
        with torch.inference_mode():
            maps = self.shown(pictures)
            for number, stage in enumerate(list(self.trunk.stages)[:until]):
                maps = stage(maps)
                yield number, maps


def pool(maps: torch.Tensor, side: int) -> torch.Tensor:
    """Maps of shape (n, channels, rows, columns), averaged to side × side, as (n, width)."""
    smaller = min(side, maps.shape[-1])
    return functional.adaptive_avg_pool2d(maps, smaller).flatten(1)


def halved(values: torch.Tensor) -> npt.NDArray[np.float16]:
    """Numbers in half precision, those too large for it as large as can be."""
    limit = float(np.finfo(np.float16).max)
    halves: npt.NDArray[np.float16] = values.clamp(-limit, limit).half().cpu().numpy()
    return halves
