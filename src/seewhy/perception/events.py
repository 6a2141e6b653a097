"""What training tells: events while it runs, a record when it is done."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

__all__ = ["EyesEvent", "FeatureRecord", "Kind", "Progress", "TrainingEvent"]

Kind = Literal["epoch", "grown", "settled", "done"]


@dataclass(frozen=True)
class TrainingEvent:
    """Something that happened in training, for a progress display.

    Attributes
    ----------
    feature : str
        The feature in training.
    depth : int
        Convolutions in its network.
    epoch, epochs : int
        Passes finished and planned at this depth.
    validation_accuracy : float
        Share of the validation pictures that are right, 0..1.
    kind : {"epoch", "grown", "settled", "done"}
        A pass ended, the network grew, its depth was settled, or the feature is finished.
    message : str
        The same in words; for all but "epoch" it names the layers.
    """

    feature: str
    depth: int
    epoch: int
    epochs: int
    validation_accuracy: float
    kind: Kind
    message: str


Progress = Callable[[TrainingEvent], None]


@dataclass(frozen=True)
class EyesEvent:
    """Something that happened while eyes were taught, for a progress display.

    Attributes
    ----------
    stage : str
        What is going on, in words.
    done, total : int
        Pictures gone over, and how many there will be.
    message : str or None
        Something worth a line of its own.
    """

    stage: str
    done: int
    total: int
    message: str | None = None


@dataclass(frozen=True)
class FeatureRecord:
    """What came of training one feature.

    Attributes
    ----------
    layers : str
        The layers found, in words.
    depth, parameters, epochs : int
        Convolutions, trained weights, and passes over the pictures in all.
    validation_accuracy : float
        Of the kept weights, 0..1. Where ``validation_pictures`` is 0 there were too few pictures
        to put some aside, and it is the accuracy on the training pictures.
    threshold : float
        What was aimed at.
    temperature : float
        By which logits are divided.
    training_pictures, validation_pictures : int
        How many of each.
    """

    layers: str
    depth: int
    parameters: int
    epochs: int
    validation_accuracy: float
    threshold: float
    temperature: float
    training_pictures: int
    validation_pictures: int
