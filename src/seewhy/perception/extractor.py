"""From pictures to the probabilities of each feature's values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import nullcontext
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, NamedTuple

import numpy as np
import numpy.typing as npt
import torch
from pydantic import Field

from seewhy.domain.tables import Channels
from seewhy.errors import DatasetError, ModelError
from seewhy.files.json_file import Strict
from seewhy.perception.events import FeatureRecord
from seewhy.perception.network import GrowingNetwork, Standard
from seewhy.perception.one_thread import one_thread
from seewhy.perception.picture_file import SMALLEST_SIDE
from seewhy.perception.weights import REMEDY, Described, check_tensors, read_weights, write_weights

__all__ = ["FeatureExtractor", "Seen", "checked_pictures"]

DESCRIPTION = "perception.json"
WEIGHTS = "perception.safetensors"
FORMAT = 3

FEW = 16
"""So few pictures are seen on one thread: for more, several are worth their waiting."""

Pictures = npt.NDArray[np.uint8]


class Seen(NamedTuple):
    """What networks make of n pictures, by feature.

    Attributes
    ----------
    probabilities : dict of str to ndarray of float, shape (n, number of values)
        See :meth:`FeatureExtractor.probabilities`.
    embeddings : dict of str to ndarray of float, shape (n, width of the dense layer)
        See :meth:`FeatureExtractor.embeddings`.
    """

    probabilities: dict[str, npt.NDArray[np.float64]]
    embeddings: dict[str, npt.NDArray[np.float32]]

    def of(self, pictures: npt.NDArray[np.int64]) -> Seen:
        """What they make of the pictures at some positions."""
        return Seen(
            {name: table[pictures] for name, table in self.probabilities.items()},
            {name: table[pictures] for name, table in self.embeddings.items()},
        )


class FeatureExtractor:
    """One network for each feature; made by
    :func:`~seewhy.perception.fitting_extractor.fit_extractor` or :meth:`load`.

    Parameters
    ----------
    networks : mapping of str to GrowingNetwork
        The network of each feature, all for pictures of one size.
    values : mapping of str to sequence of str
        The feature's values, in the order of the network's logits.
    records : mapping of str to FeatureRecord
        What came of training each.

    Attributes
    ----------
    size : int
        Side of the pictures, in pixels.
    values : dict of str to tuple of str
        The values of each feature.

    Notes
    -----
    Source: Riley and Sridharan (2019), feature extraction. Departure: the features carry
    probabilities, calibrated on validation pictures, beside the most probable value.
    """

    def __init__(
        self,
        networks: Mapping[str, GrowingNetwork],
        *,
        values: Mapping[str, Sequence[str]],
        records: Mapping[str, FeatureRecord],
    ) -> None:
        self.networks = {name: network.eval() for name, network in networks.items()}
        self.values = {name: tuple(values[name]) for name in networks}
        self.records = {name: records[name] for name in networks}
        self.size = next(iter(self.networks.values())).size

    @property
    def widths(self) -> dict[str, int]:
        """How many numbers each of the embeddings has that are seen of a picture."""
        return {name: network.dense for name, network in self.networks.items()}

    def probabilities(self, pictures: Pictures) -> dict[str, npt.NDArray[np.float64]]:
        """Probabilities of each feature's values.

        Parameters
        ----------
        pictures : ndarray of uint8, shape (n, size, size, 3)
            As :func:`seewhy.perception.picture.as_picture` makes them. One picture of shape
            (size, size, 3) counts as n = 1.

        Returns
        -------
        dict of str to ndarray of float, shape (n, number of values)
            Columns in the order of :attr:`values`; rows sum to 1.

        Raises
        ------
        DatasetError
            The array has another shape or type.
        """
        return self.see(pictures).probabilities

    def embeddings(self, pictures: Pictures) -> dict[str, npt.NDArray[np.float32]]:
        """Outputs of each network's dense layer: pictures that look alike to it lie together.

        Parameters and errors as for :meth:`probabilities`.

        Returns
        -------
        dict of str to ndarray of float, shape (n, width of the dense layer)
        """
        return self.see(pictures).embeddings

    def see(self, pictures: Pictures) -> Seen:
        """Probabilities and embeddings at the cost of the probabilities alone.

        Parameters and errors as for :meth:`probabilities`.
        """
        batch = checked_pictures(pictures[None] if pictures.ndim == 3 else pictures, size=self.size)
        seen = Seen({}, {})
        threads = one_thread() if len(batch) <= FEW else nullcontext()
        with threads, torch.inference_mode():
            for name, network in self.networks.items():
                # No picture at all is one empty batch.
                parts = [
                    network.see(torch.from_numpy(batch[i : i + 256]))
                    for i in range(0, max(1, len(batch)), 256)
                ]
                seen.probabilities[name] = torch.cat([part[0] for part in parts]).double().numpy()
                seen.embeddings[name] = torch.cat([part[1] for part in parts]).numpy()
                if not np.isfinite(seen.probabilities[name]).all():
                    raise ModelError(f"the network of '{name}' gives no number: {REMEDY}")
        return seen

    def summary(self) -> dict[str, dict[str, object]]:
        """What came of training each feature: the fields of FeatureRecord by name."""
        return {name: asdict(record) for name, record in self.records.items()}

    def shown(self, name: str) -> frozenset[str]:
        """The values that a network was trained on a picture of; none where there is no network."""
        if name not in self.networks:
            return frozenset()
        marks = self.networks[name].shown.tolist()
        return frozenset(
            value for value, mark in zip(self.values[name], marks, strict=True) if mark
        )

    def save(self, folder: Path | str) -> None:
        """Write ``perception.safetensors`` and ``perception.json`` into ``folder``."""
        tensors = {
            f"{feature}/{name}": tensor
            for feature, network in self.networks.items()
            for name, tensor in network.state_dict().items()
        }
        description = _Description(
            format=FORMAT,
            digest="",
            size=self.size,
            features={
                name: _Feature(
                    values=self.values[name],
                    dense=network.dense,
                    dropout=network.dropout,
                    channels=network.channels,
                    standard=network.standard,
                    record=self.records[name],
                )
                for name, network in self.networks.items()
            },
        )
        write_weights(
            tensors,
            description,
            weights=Path(folder) / WEIGHTS,
            described=Path(folder) / DESCRIPTION,
        )

    @classmethod
    def load(cls, folder: Path | str) -> FeatureExtractor:
        """Read what :meth:`save` wrote.

        Raises
        ------
        ModelError
            A file is missing, damaged, or does not belong to the other; the text names it.
        """
        weights, described = Path(folder) / WEIGHTS, Path(folder) / DESCRIPTION
        description, tensors = read_weights(
            _Description, number=FORMAT, weights=weights, described=described
        )
        try:
            with torch.device("meta"):
                networks = {
                    name: GrowingNetwork(
                        size=description.size,
                        values=len(feature.values),
                        depth=feature.record.depth,
                        dropout=feature.dropout,
                        dense=feature.dense,
                        channels=feature.channels,
                        standard=feature.standard,
                    )
                    for name, feature in description.features.items()
                }
        except ValueError as problem:
            raise ModelError(f"{described} is damaged ({problem}): {REMEDY}") from None
        expected = {
            f"{feature}/{name}": tensor
            for feature, network in networks.items()
            for name, tensor in network.state_dict().items()
        }
        check_tensors(tensors, expected, weights=weights, described=described)
        for feature, network in networks.items():
            network.load_state_dict(
                {name: tensors[f"{feature}/{name}"] for name in network.state_dict()}, assign=True
            )
        return cls(
            networks,
            values={name: feature.values for name, feature in description.features.items()},
            records={name: feature.record for name, feature in description.features.items()},
        )


class _Feature(Strict):
    values: Annotated[tuple[str, ...], Field(min_length=1)]
    dense: Annotated[int, Field(ge=1, le=65_536)]
    dropout: Annotated[float, Field(ge=0.0, le=1.0)]
    channels: Channels
    standard: Standard
    record: FeatureRecord


class _Description(Described):
    """The JSON beside the weights."""

    size: Annotated[int, Field(ge=SMALLEST_SIDE, le=512)]
    features: Annotated[dict[str, _Feature], Field(min_length=1)]


def checked_pictures(pictures: Pictures, *, size: int | None = None) -> Pictures:
    """The pictures, if they are an array that networks take, of one side where it is given.

    Raises
    ------
    DatasetError
        The array has another shape or type.

    Examples
    --------
    >>> checked_pictures(np.zeros((2, 16, 16, 3), dtype=np.uint8), size=16).shape
    (2, 16, 16, 3)
    """
    side = "size" if size is None else size
    shape = pictures.shape
    square = pictures.ndim == 4 and shape[1] == shape[2] and shape[3] == 3
    if pictures.dtype != np.uint8 or not square or (size is not None and shape[1] != size):
        raise DatasetError(
            f"pictures must be uint8 of shape (n, {side}, {side}, 3), got {pictures.dtype} of "
            f"shape {shape}: make them with as_picture"
        )
    if shape[1] < SMALLEST_SIDE:
        raise DatasetError(f"pictures must be at least {SMALLEST_SIDE} pixels wide, got {shape[1]}")
    return np.ascontiguousarray(pictures)
