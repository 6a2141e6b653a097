"""How a feature's network is trained, as data."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from seewhy.errors import DomainError

__all__ = ["VARIATIONS", "TrainingOptions"]

VARIATIONS = (
    *("flip", "shift", "rotate", "scale", "shear"),
    *("brightness", "contrast", "colour", "noise"),
)
"""The options that say how pictures are varied."""


@dataclass(frozen=True)
class TrainingOptions:
    """How a feature is trained; a domain chooses those that fit its pictures.

    Parameters
    ----------
    threshold : float, default 0.9
        Validation accuracy (0..1) at which the network stops growing.
    max_epochs : int, default 18
        Passes over the pictures once the depth is settled. Sets of fewer than 1000 pictures get
        up to four times as many, since each pass is short; sets of more than 5000 down to half.
    growing_epochs : int, default 3
        Passes at each depth while growing (raised for small sets likewise).
    patience : int, default 6
        Passes (raised for small sets likewise) without a better validation result after which
        the settled depth goes straight to the small steps that end its training, and then stops.
    batch_size : int, default 64
        Pictures a step.
    learning_rate : float, default 0.003
        The largest; it rises to it for a quarter of a stage and falls in a cosine to zero.
    weight_decay : float, default 0.02
        AdamW's, on matrices only.
    dropout : float, default 0.5
        Share of dropped outputs of the dense layer.
    validation_share : float, default 0.15
        Share of the labelled pictures kept for validation.
    seed : int, default 0
        Two runs with the same seed and data agree bit for bit on processors with the same
        instruction set.
    flip : bool, default False
        Mirror half of the pictures left to right. Only where no value depends on the side.
    shift : float, default 0.05
        Largest displacement in each direction, as a share of the side.
    rotate : float, default 0.0
        Largest rotation, in degrees to either side.
    scale : float, default 0.0
        Largest relative stretching or shrinking, of width and height each on its own.
    shear : float, default 0.0
        Largest slant: how far the top moves against the bottom, as a share of the side.
    brightness, contrast, colour : float, default 0.1
        Largest relative change of the whole, of the distance from the picture's mean, and of
        each colour channel on its own.
    noise : float, default 2.0
        Standard deviation of added noise, in levels of 0..255.
    balance : float, default 0.0
        0 weighs every picture alike, 1 every value alike (weights go with the value's frequency
        to the power -balance). Above 0 rare values are found more often, and the probabilities
        lean towards them.
    depth : int, default 1
        Convolutions to start with; at most as many as the pictures allow, in which case nothing
        grows. More than one where it is known that fewer never suffice, as with a few pictures of
        many values, on which growing is guesswork.
    channels : tuple of int, default (8, 16, 32, 64)
        Channels of the convolutions, one a depth; see
        :class:`~seewhy.perception.network.GrowingNetwork`.
    dense : int, default 64
        Width of the dense layer.
    standard : {"set", "picture"}, default "set"
        What pictures are standardised by; see there.

    Raises
    ------
    DomainError
        A number is outside its range.

    Examples
    --------
    >>> TrainingOptions(threshold=0.97, flip=True).max_epochs
    18
    """

    threshold: float = 0.9
    max_epochs: int = 18
    growing_epochs: int = 3
    patience: int = 6
    batch_size: int = 64
    learning_rate: float = 0.003
    weight_decay: float = 0.02
    dropout: float = 0.5
    validation_share: float = 0.15
    seed: int = 0
    flip: bool = False
    shift: float = 0.05
    rotate: float = 0.0
    scale: float = 0.0
    shear: float = 0.0
    brightness: float = 0.1
    contrast: float = 0.1
    colour: float = 0.1
    noise: float = 2.0
    balance: float = 0.0
    depth: int = 1
    channels: tuple[int, ...] = (8, 16, 32, 64)
    dense: int = 64
    standard: Literal["set", "picture"] = "set"

    def __post_init__(self) -> None:
        ranges: dict[str, tuple[float, float]] = {
            "threshold": (0.0, 1.0),
            "max_epochs": (1, 10_000),
            "growing_epochs": (1, 10_000),
            "patience": (1, 10_000),
            "batch_size": (1, 65_536),
            "learning_rate": (1e-8, 1.0),
            "weight_decay": (0.0, 1.0),
            "dropout": (0.0, 0.95),
            "validation_share": (0.0, 0.5),
            "shift": (0.0, 0.5),
            "rotate": (0.0, 180.0),
            "scale": (0.0, 0.9),
            "shear": (0.0, 0.9),
            "brightness": (0.0, 0.9),
            "contrast": (0.0, 0.9),
            "colour": (0.0, 0.9),
            "noise": (0.0, 128.0),
            "balance": (0.0, 1.0),
            "depth": (1, 16),
            "dense": (1, 65_536),
        }
        for name, (low, high) in ranges.items():
            value = getattr(self, name)
            if not low <= value <= high:
                raise DomainError(f"{name} must be {low:g} to {high:g}, got {value!r}")
        if not self.channels or not all(1 <= filters <= 4096 for filters in self.channels):
            raise DomainError(
                f"channels must be one or more numbers from 1 to 4096, got {list(self.channels)}"
            )
