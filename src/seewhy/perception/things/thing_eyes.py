"""Eyes for things: what each is by its region and its box, and what holds between two."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np
import numpy.typing as npt
import torch
from pydantic import Field

from seewhy.errors import ModelError
from seewhy.files.json_file import Strict
from seewhy.perception.backbones.backbone import Embedded
from seewhy.perception.eyes import Eyes
from seewhy.perception.heads import Head
from seewhy.perception.stacking import MOST, Stack, Table, log_probabilities, stacked
from seewhy.perception.things.boxes import Boxes
from seewhy.perception.things.geometry import of_pairs
from seewhy.perception.weights import REMEDY, Described, check_tensors, read_weights, write_weights

__all__ = ["BOX", "REGION", "ScaledHead", "SeenThings", "ThingEyes", "box_numbers", "pair_numbers"]

REGION, BOX = "region", "box"
"""The ways of seeing a feature of a thing: what its region shows; where it is and how large."""

DESCRIPTION, WEIGHTS, FORMAT = "things.json", "things.safetensors", 2

_OF_REGION = 60  # components that a head on the box looks at
_COMPONENTS = 24  # of a region that a head on the pair looks at

Floats = npt.NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class ScaledHead:
    """A linear map from numbers in standard deviations to logits.

    Attributes
    ----------
    mean, scale : ndarray of float, shape (numbers,)
    head : Head
    """

    mean: Floats
    scale: Floats
    head: Head

    def __call__(self, numbers: npt.NDArray[np.floating]) -> Floats:
        """Shape (n, numbers) → logits of shape (n, values)."""
        standardised: Floats = ((numbers - self.mean) / self.scale).astype(np.float32)
        # What no picture of training came near to has no say in proportion.
        return self.head(np.clip(standardised, -6.0, 6.0))


@dataclass(frozen=True, eq=False)
class SeenThings:
    """What is made of n things.

    Attributes
    ----------
    probabilities : dict of str to ndarray of float, shape (n, values)
        Of each feature's values.
    projected : ndarray of float, shape (n, components)
        What heads on pairs look at.
    """

    probabilities: dict[str, npt.NDArray[np.float64]]
    projected: Floats


class ThingEyes:
    """Regions and boxes → probabilities of each feature's values; of pairs, of each relation.

    Parameters
    ----------
    eyes : Eyes
        Of regions.
    boxed : mapping of str to ScaledHead
        Feature → a head on where the box lies, how large it is, and what is in it.
    stacks : mapping of str to Stack
        Feature → how much its region and its box count.
    related : mapping of str to ScaledHead
        Relation → a head on the pair, whose values are no and yes.
    accuracies : mapping of str to float
        Relation → share of pairs read rightly that had no part in teaching it.
    """

    def __init__(
        self,
        eyes: Eyes,
        *,
        boxed: Mapping[str, ScaledHead],
        stacks: Mapping[str, Stack],
        related: Mapping[str, ScaledHead],
        accuracies: Mapping[str, float],
    ) -> None:
        self.eyes = eyes
        self.boxed = dict(boxed)
        self.stacks = dict(stacks)
        self.related = dict(related)
        self.accuracies = dict(accuracies)

    @property
    def side(self) -> int:
        """The side of regions, in pixels."""
        return self.eyes.size

    def see(self, regions: npt.NDArray[np.uint8], boxes: Floats) -> SeenThings:
        """What each thing is.

        Parameters
        ----------
        regions : ndarray of uint8, shape (n, side, side, 3)
        boxes : ndarray of float, shape (n, numbers)
            As :func:`~seewhy.perception.things.geometry.of_boxes` makes them.
        """
        return self.see_embedded(self.eyes.backbone.embed(regions), boxes)

    def see_embedded(self, embedded: Embedded, boxes: Floats) -> SeenThings:
        """The same of regions that the backbone has looked at already."""
        seen = self.eyes.see_embedded(embedded).probabilities
        projected = self.eyes.projection(embedded.pooled)
        numbers = box_numbers(projected, boxes)
        found = {
            name: stacked(ways(seen[name], self.boxed[name](numbers)), stack.weights)
            for name, stack in self.stacks.items()
        }
        return SeenThings(found, projected)

    def see_pairs(
        self, projected: Floats, boxes: Boxes, pairs: npt.NDArray[np.int64]
    ) -> dict[str, npt.NDArray[np.float64]]:
        """How probable each relation is that has a head, of each pair.

        Parameters
        ----------
        projected : ndarray of float, shape (n, components)
            Of the things in one picture.
        boxes : ndarray of float, shape (n, 4)
        pairs : ndarray of int, shape (pairs, 2)
        """
        if not self.related or not len(pairs):
            return {name: np.zeros(len(pairs)) for name in self.related}
        numbers = pair_numbers(projected, boxes, pairs)
        return {
            name: np.exp(log_probabilities(head(numbers)))[:, 1]
            for name, head in self.related.items()
        }

    def save(self, folder: Path | str) -> None:
        """Write ``things.safetensors``, ``things.json`` and the eyes' files into ``folder``."""
        self.eyes.save(folder)
        heads = {f"box/{name}": head for name, head in self.boxed.items()} | {
            f"pair/{name}": head for name, head in self.related.items()
        }
        tensors = {
            f"{name}/{part}": torch.from_numpy(np.ascontiguousarray(array))
            for name, head in heads.items()
            for part, array in (
                ("mean", head.mean),
                ("scale", head.scale),
                ("weight", head.head.weight),
                ("bias", head.head.bias),
            )
        }
        description = _Description(
            format=FORMAT,
            digest="",
            features={
                name: _Feature(
                    weights=stack.weights, accuracies=stack.accuracies, pictures=stack.pictures
                )
                for name, stack in self.stacks.items()
            },
            relations=self.accuracies,
        )
        write_weights(
            tensors,
            description,
            weights=Path(folder) / WEIGHTS,
            described=Path(folder) / DESCRIPTION,
        )

    @classmethod
    def load(cls, folder: Path | str, *, device: str = "auto") -> ThingEyes:
        """Read what :meth:`save` wrote.

        Raises
        ------
        ModelError
            A file is missing, damaged, or does not belong to the others; the text names it.
        """
        weights, described = Path(folder) / WEIGHTS, Path(folder) / DESCRIPTION
        description, tensors = read_weights(
            _Description, number=FORMAT, weights=weights, described=described
        )
        eyes = Eyes.load(folder, device=device)
        if eyes.values.keys() != description.features.keys():
            raise ModelError(f"{described} is damaged (other features than the eyes'): {REMEDY}")
        counts = {f"box/{name}": len(row) for name, row in eyes.values.items()} | {
            f"pair/{name}": 2 for name in description.relations
        }
        check_tensors(tensors, _expected(tensors, counts), weights=weights, described=described)

        def head(name: str) -> ScaledHead:
            mean, scale, weight, bias = (
                tensors[f"{name}/{part}"].numpy() for part in ("mean", "scale", "weight", "bias")
            )
            return ScaledHead(mean, scale, Head(weight, bias))

        return cls(
            eyes,
            boxed={name: head(f"box/{name}") for name in eyes.values},
            stacks={
                name: Stack(found.weights, found.accuracies, found.pictures)
                for name, found in description.features.items()
            },
            related={name: head(f"pair/{name}") for name in description.relations},
            accuracies=description.relations,
        )


def ways(seen: npt.NDArray[np.float64], boxed: Floats) -> dict[str, Table]:
    """Logarithms of probabilities by what a region shows, and by where its box is."""
    return {REGION: np.log(np.maximum(seen, 1e-4)), BOX: log_probabilities(boxed)}


def box_numbers(projected: Floats, boxes: Floats) -> Floats:
    """What heads on boxes look at: where a box is, and what is in it, which tells how large it is.

    A ball looks smaller than a cube of its size, and what stands on another thing is nearer than
    where it ends in the picture says.
    """
    found: Floats = np.concatenate([boxes, projected[:, :_OF_REGION]], axis=1)
    return found


def pair_numbers(projected: Floats, boxes: Boxes, pairs: npt.NDArray[np.int64]) -> Floats:
    """What heads on pairs look at: how two boxes lie to each other, and what both regions show."""
    some = projected[:, :_COMPONENTS]
    found: Floats = np.concatenate(
        [of_pairs(boxes, pairs), some[pairs[:, 0]], some[pairs[:, 1]]], axis=1
    )
    return found


def _expected(
    tensors: Mapping[str, torch.Tensor], counts: Mapping[str, int]
) -> dict[str, torch.Tensor]:
    """Tensors of the shapes that heads have, for as many numbers as there are."""
    expected: dict[str, torch.Tensor] = {}
    for name, values in counts.items():
        mean = tensors.get(f"{name}/mean")
        width = len(mean) if mean is not None and mean.ndim == 1 else 1
        sides = {"mean": (width,), "scale": (width,), "weight": (values, width), "bias": (values,)}
        expected |= {
            f"{name}/{part}": torch.empty(lengths, device="meta") for part, lengths in sides.items()
        }
    return expected


class _Feature(Strict):
    weights: dict[str, Annotated[float, Field(ge=0.0, le=MOST)]]
    accuracies: dict[str, float]
    pictures: int


class _Description(Described):
    """The JSON beside the weights."""

    features: Annotated[dict[str, _Feature], Field(min_length=1)]
    relations: dict[str, float]
