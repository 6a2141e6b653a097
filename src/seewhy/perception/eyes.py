"""Eyes: a backbone that has seen before, and what it was taught to see in pictures of a domain."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated

import numpy as np
import numpy.typing as npt
import torch
from pydantic import Field, field_validator, model_validator

from seewhy.domain.tables import SCENE
from seewhy.errors import DatasetError, ModelError
from seewhy.files.json_file import Strict
from seewhy.perception.backbones import load_backbone
from seewhy.perception.backbones.backbone import Backbone, Embedded
from seewhy.perception.extractor import Seen
from seewhy.perception.heads import Head, Projection
from seewhy.perception.stacking import MOST, Stack, Table, log_probabilities, stacked
from seewhy.perception.tail import Tail, new_tail
from seewhy.perception.tail_training import see_with_tail
from seewhy.perception.weights import REMEDY, Described, check_tensors, read_weights, write_weights

__all__ = ["EYES", "HEADS", "SCENE", "TUNED", "Eyes", "EyesRecord"]

EYES = "eyes.json"
WEIGHTS = "eyes.safetensors"
FORMAT = 2

HEADS, TUNED = "heads", "tuned layers"
"""The ways of seeing: heads on the backbone as it is, and its last layers tuned."""

_PROJECTION = ("mean", "scale", "components")

_CONSTANT = 3.0  # in the length that a picture's embedding has on average

Pictures = npt.NDArray[np.uint8]


class EyesRecord(Strict):
    """What came of training one feature.

    Attributes
    ----------
    layers : str
        What the feature is seen by, and why, in words.
    validation_accuracy : float
        On pictures that were kept for validation, 0..1; on the training pictures where
        ``validation_pictures`` is 0.
    accuracies : dict of str to float
        The same for each way of seeing.
    epochs : int
        Passes over the pictures.
    training_pictures, validation_pictures : int
        How many of each.
    """

    layers: str
    validation_accuracy: float
    accuracies: dict[str, float]
    epochs: int
    training_pictures: int
    validation_pictures: int


class Eyes:
    """Pictures → probabilities of each feature's values; made by :func:`fit_eyes` or :meth:`load`.

    Departure from the paper, whose networks have seen nothing but the domain's pictures:
    ``eyes = "none"`` is its way.

    Parameters
    ----------
    backbone : Backbone
    projection : Projection
    heads : mapping of str to Head
        On the backbone as it is.
    tail : Tail or None
        The backbone's last stages, tuned; None where it cannot be.
    stacks : mapping of str to Stack
        How much each way of seeing counts.
    values : mapping of str to sequence of str
        The values of each feature, in the order of logits.
    shown : mapping of str to collection of str
        The values that some training picture shows.
    records : mapping of str to EyesRecord, optional
        What came of training each feature.

    Attributes
    ----------
    size : int
        Side of the pictures, in pixels.
    """

    def __init__(
        self,
        backbone: Backbone,
        *,
        projection: Projection,
        heads: Mapping[str, Head],
        tail: Tail | None,
        stacks: Mapping[str, Stack],
        values: Mapping[str, Sequence[str]],
        shown: Mapping[str, frozenset[str]],
        records: Mapping[str, EyesRecord] | None = None,
    ) -> None:
        self.backbone = backbone
        self.projection = projection
        self.heads = dict(heads)
        self.tail = tail
        self.stacks = dict(stacks)
        self.values = {name: tuple(row) for name, row in values.items()}
        self.records = dict(records or {})
        self.size = backbone.side
        self._shown = dict(shown)

    def see(self, pictures: Pictures) -> Seen:
        """Probabilities of each feature's values, and the embedding of each picture.

        Parameters
        ----------
        pictures : ndarray of uint8, shape (n, size, size, 3)
            As :func:`seewhy.perception.picture.as_picture` makes them. One picture of shape
            (size, size, 3) counts as n = 1.

        Returns
        -------
        Seen
            Its embeddings are one a picture, under :data:`SCENE`.

        Raises
        ------
        DatasetError
            The array has another shape or type.
        """
        batch = pictures[None] if pictures.ndim == 3 else pictures
        if batch.dtype != np.uint8 or batch.ndim != 4 or batch.shape[1:] != (*[self.size] * 2, 3):
            raise DatasetError(
                f"pictures must be uint8 of shape (n, {self.size}, {self.size}, 3), got "
                f"{pictures.dtype} of shape {pictures.shape}: make them with as_picture"
            )
        return self.see_embedded(self.backbone.embed(np.ascontiguousarray(batch)))

    def see_embedded(self, embedded: Embedded) -> Seen:
        """The same of pictures that the backbone has looked at already."""
        width = len(self.projection.mean)
        if embedded.pooled.shape[1] != width:
            raise ModelError(
                f"the eyes look at {width} numbers of a picture, {self.backbone.name} gives "
                f"{embedded.pooled.shape[1]}: {REMEDY}"
            )
        tables = self.ways(embedded)
        probabilities = {
            name: stacked({way: tables[way][name] for way in stack.asked}, stack.weights)
            for name, stack in self.stacks.items()
        }
        for name, found in probabilities.items():
            if not np.isfinite(found).all():
                raise ModelError(f"what sees '{name}' gives no number: {REMEDY}")
        return Seen(probabilities, {SCENE: self.familiar_by(embedded)})

    def ways(self, embedded: Embedded) -> dict[str, dict[str, Table]]:
        """Way of seeing → feature → logarithms of probabilities; only of ways that count."""
        asked = {way for stack in self.stacks.values() for way in stack.asked}
        tables: dict[str, dict[str, Table]] = {}
        if HEADS in asked:
            projected = self.projection(embedded.pooled)
            tables[HEADS] = {
                name: log_probabilities(head(projected)) for name, head in self.heads.items()
            }
        if TUNED in asked and self.tail is not None:
            tables[TUNED] = see_with_tail(self.tail, embedded.middle)
        return tables

    def familiar_by(self, embedded: Embedded) -> npt.NDArray[np.float32]:
        """What pictures are compared by, to tell what is like those of training.

        Embeddings in standard deviations, with a large constant beside them: so the angle between
        two grows with their distance. The angle between embeddings alone forgets how far from
        all of training a picture lies, and a stranger's lies far.
        """
        mean, scale = self.projection.mean, self.projection.scale
        standardised = (embedded.pooled.astype(np.float32) - mean) / scale
        constant = np.float32(_CONSTANT * np.sqrt(standardised.shape[1]))
        beside = np.full((len(standardised), 1), constant, dtype=np.float32)
        return np.concatenate([standardised, beside], axis=1)

    @property
    def widths(self) -> dict[str, int]:
        """How many numbers each of the embeddings has that are seen of a picture."""
        return {SCENE: len(self.projection.mean) + 1}

    def probabilities(self, pictures: Pictures) -> dict[str, npt.NDArray[np.float64]]:
        """Probabilities of each feature's values, shape (n, values); as for :meth:`see`."""
        return self.see(pictures).probabilities

    def embeddings(self, pictures: Pictures) -> dict[str, npt.NDArray[np.float32]]:
        """Embeddings of pictures, shape (n, width), under :data:`SCENE`; as for :meth:`see`."""
        return self.see(pictures).embeddings

    def shown(self, name: str) -> frozenset[str]:
        """The values that some training picture shows; none where the feature is not seen."""
        return self._shown.get(name, frozenset())

    def summary(self) -> dict[str, dict[str, object]]:
        """What came of training each feature: the fields of EyesRecord by name."""
        return {name: record.model_dump() for name, record in self.records.items()}

    def save(self, folder: Path | str) -> None:
        """Write ``eyes.safetensors`` and ``eyes.json`` into ``folder``."""
        tensors = {
            "projection/mean": torch.from_numpy(self.projection.mean),
            "projection/scale": torch.from_numpy(self.projection.scale),
            "projection/components": torch.from_numpy(self.projection.components),
        }
        for name, head in self.heads.items():
            tensors[f"heads/{name}/weight"] = torch.from_numpy(head.weight)
            tensors[f"heads/{name}/bias"] = torch.from_numpy(head.bias)
        if self.tail is not None:
            tensors |= {
                f"tail/{name}": weight.cpu() for name, weight in self.tail.state_dict().items()
            }
        description = _Description(
            format=FORMAT,
            digest="",
            backbone=self.backbone.name,
            backbone_digest=self.backbone.digest,
            side=self.backbone.side,
            tuned=self.tail is not None,
            features={
                name: _Feature(
                    values=self.values[name],
                    shown=tuple(value for value in self.values[name] if value in self._shown[name]),
                    weights=self.stacks[name].weights,
                    record=self.records[name],
                )
                for name in self.values
            },
        )
        write_weights(
            tensors, description, weights=Path(folder) / WEIGHTS, described=Path(folder) / EYES
        )

    @classmethod
    def load(cls, folder: Path | str, *, device: str = "auto") -> Eyes:
        """Read what :meth:`save` wrote.

        Raises
        ------
        ModelError
            A file is missing, damaged, or does not belong to the other, or the backbone is
            another than in training; the text names it.
        """
        weights, described = Path(folder) / WEIGHTS, Path(folder) / EYES
        description, tensors = read_weights(
            _Description, number=FORMAT, weights=weights, described=described
        )
        backbone = load_backbone(description.backbone, device=device, side=description.side)
        if backbone.digest != description.backbone_digest:
            raise ModelError(
                f"{described}: the model was trained with another {backbone.name} than the one "
                "installed: train it again, or install the one of then"
            )
        features = description.features
        values = {name: feature.values for name, feature in features.items()}
        if description.tuned and not backbone.tunable:
            raise ModelError(f"{described} is damaged (tuned: {backbone.name} cannot be): {REMEDY}")
        tail = None
        if description.tuned:
            tail = new_tail(backbone, {name: len(row) for name, row in values.items()})
        check_tensors(
            tensors, _expected(tensors, values, tail), weights=weights, described=described
        )
        projection = Projection(*(tensors[f"projection/{part}"].numpy() for part in _PROJECTION))
        heads = {
            name: Head(*(tensors[f"heads/{name}/{part}"].numpy() for part in ("weight", "bias")))
            for name in values
        }
        if tail is not None:
            tail.load_state_dict({name: tensors[f"tail/{name}"] for name in tail.state_dict()})
            tail.eval()
        return cls(
            backbone,
            projection=projection,
            heads=heads,
            tail=tail,
            stacks={
                name: Stack(
                    feature.weights, feature.record.accuracies, feature.record.validation_pictures
                )
                for name, feature in features.items()
            },
            values=values,
            shown={name: frozenset(feature.shown) for name, feature in features.items()},
            records={name: feature.record for name, feature in features.items()},
        )


def _expected(
    tensors: Mapping[str, torch.Tensor], values: Mapping[str, Sequence[str]], tail: Tail | None
) -> dict[str, torch.Tensor]:
    """Tensors of the shapes that eyes have, for as many components as there are."""
    components = tensors.get("projection/components")
    shape = () if components is None else tuple(components.shape)
    width, count = shape if len(shape) == 2 else (1, 1)
    sides: dict[str, tuple[int, ...]] = {
        "projection/mean": (width,),
        "projection/scale": (width,),
        "projection/components": (width, count),
    }
    for name, row in values.items():
        sides |= {f"heads/{name}/weight": (len(row), count), f"heads/{name}/bias": (len(row),)}
    expected = {name: torch.empty(lengths, device="meta") for name, lengths in sides.items()}
    if tail is not None:
        expected |= {f"tail/{name}": weight for name, weight in tail.state_dict().items()}
    return expected


class _Feature(Strict):
    values: Annotated[tuple[str, ...], Field(min_length=1)]
    shown: tuple[str, ...]
    weights: dict[str, Annotated[float, Field(ge=0.0, le=MOST)]]
    record: EyesRecord

    @field_validator("weights")
    @classmethod
    def _some_count(cls, weights: dict[str, float]) -> dict[str, float]:
        if not any(weights.values()) or not weights.keys() <= {HEADS, TUNED}:
            raise ValueError(f"one of {HEADS} and {TUNED} must count")
        return weights


class _Description(Described):
    """The JSON beside the weights."""

    backbone: str
    backbone_digest: str
    side: int | None = None
    """Of pictures, in pixels; None in models of before, which have the backbone's usual one."""
    tuned: bool
    features: Annotated[dict[str, _Feature], Field(min_length=1)]

    @model_validator(mode="after")
    def _tuned_where_it_counts(self) -> _Description:
        if not self.tuned and any(feature.weights.get(TUNED) for feature in self.features.values()):
            raise ValueError("layers count that were not tuned")
        return self
