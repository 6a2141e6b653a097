"""How a feature's network is trained, as data."""

from __future__ import annotations

from dataclasses import dataclass

from seewhy.errors import DomainError

__all__ = ["TrainingOptions"]


@dataclass(frozen=True)
class TrainingOptions:
    """How a feature is trained; a domain chooses those that fit its pictures.

    Parameters
    ----------
    threshold : float, default 0.9
        Validation accuracy (0..1) at which the network stops growing.
    max_epochs : int, default 18
        Passes over the pictures once the depth is settled. Sets of fewer than 1000 pictures get
        up to four times as many, since each pass is short.
    growing_epochs : int, default 3
        Passes at each depth while growing (raised for small sets likewise).
    patience : int, default 6
        Passes without a better validation result after which the settled depth goes straight
        to the small steps that end its training, and then stops.
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
        Two runs with the same seed and data agree bit for bit on the same kind of machine.
    flip : bool, default False
        Mirror half of the pictures left to right. Only where no value depends on the side.
    shift : float, default 0.05
        Largest displacement in each direction, as a share of the side.
    brightness, contrast, colour : float, default 0.1
        Largest relative change of the whole, of the distance from the picture's mean, and of
        each colour channel on its own.
    noise : float, default 2.0
        Standard deviation of added noise, in levels of 0..255.
    balance : float, default 0.0
        0 weighs every picture alike, 1 every value alike (weights go with the value's frequency
        to the power -balance). Above 0 rare values are found more often, and the probabilities
        lean towards them.

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
    brightness: float = 0.1
    contrast: float = 0.1
    colour: float = 0.1
    noise: float = 2.0
    balance: float = 0.0

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
            "brightness": (0.0, 0.9),
            "contrast": (0.0, 0.9),
            "colour": (0.0, 0.9),
            "noise": (0.0, 128.0),
            "balance": (0.0, 1.0),
        }
        for name, (low, high) in ranges.items():
            value = getattr(self, name)
            if not low <= value <= high:
                raise DomainError(f"{name} must be {low:g} to {high:g}, got {value!r}")
