"""Networks before there is anything to train, and the record of one in the end."""

from __future__ import annotations

import numpy as np
import torch

from seewhy.perception.events import FeatureRecord
from seewhy.perception.labelled_pictures import LabelledPictures
from seewhy.perception.labels import labelled
from seewhy.perception.network import GrowingNetwork, deepest
from seewhy.perception.options import TrainingOptions
from seewhy.perception.randomness import seeded

__all__ = ["constant_network", "new_network", "record_of"]


def new_network(size: int, values: int, options: TrainingOptions) -> GrowingNetwork:
    """An untrained network for pictures of ``size`` pixels, as deep as it starts."""
    return GrowingNetwork(
        size=size,
        values=values,
        depth=min(options.depth, deepest(size)),
        dropout=options.dropout,
        dense=options.dense,
        channels=options.channels,
        standard=options.standard,
    )


def constant_network(
    shown: LabelledPictures, feature: str, *, options: TrainingOptions
) -> GrowingNetwork:
    """A network that answers the one value that occurs, whatever the picture.

    Where only one value occurs nothing can be learned from the pictures.
    """
    values = shown.values[feature]
    chosen, targets = labelled(shown.labels[feature], feature=feature, values=values)
    pictures = shown.pixels[chosen]
    with seeded(torch.device("cpu"), options.seed, feature, "first"):
        network = new_network(pictures.shape[1], len(values), options)
    network.standardise_by(pictures)
    network.is_shown(targets)
    # One more picture of each value is supposed, so that the others stay possible.
    counts = np.bincount(targets, minlength=len(values)) + 1.0
    network.always(torch.as_tensor(np.log(counts / counts.sum())))
    return network.eval()


def record_of(
    network: GrowingNetwork,
    *,
    epochs: int,
    accuracy: float,
    threshold: float,
    training: int,
    validation: int,
) -> FeatureRecord:
    """What came of training a network, by so many pictures of training and of validation."""
    return FeatureRecord(
        layers=network.layers,
        depth=network.depth,
        parameters=network.parameters_count,
        epochs=epochs,
        validation_accuracy=accuracy,
        threshold=threshold,
        temperature=float(network.temperature),
        training_pictures=training,
        validation_pictures=validation,
    )
