"""What the recurrent network learns from and how, as data."""

from __future__ import annotations

from dataclasses import dataclass

from seewhy.errors import DomainError

__all__ = ["MOST_LAYERS", "WIDEST", "AnswerExample", "AnswererEvent", "RecurrentOptions"]

MOST_LAYERS = 8
WIDEST = 4096
"""Units of a layer, and numbers that stand for a word, at most."""


@dataclass(frozen=True)
class AnswerExample:
    """A question about one scene and the type of its right answer.

    Attributes
    ----------
    words : tuple of str
        The question's words, normalised.
    features : tuple of str
        The scene's value of each feature, in the order of the ``feature_values`` that
        :func:`fit_answerer` is given.
    label : str
        The class that the tree gave the scene.
    answer : str
        The answer type.
    scene : int, optional
        Questions of one scene are never divided between training and holding out.
    """

    words: tuple[str, ...]
    features: tuple[str, ...]
    label: str
    answer: str
    scene: int | None = None


@dataclass(frozen=True)
class RecurrentOptions:
    """How the answerer is trained.

    Parameters
    ----------
    max_layers : int, default 3
        LSTM layers at most.
    alpha : float, default 0.05
        Level of significance that a further layer's improvement must reach.
    width : int, default 48
        Units of each LSTM layer and of the dense layer.
    embedding : int, default 24
        Numbers that stand for a word.
    epochs : int, default 10
        Passes over the examples with each number of layers. Sets of fewer than 3000 examples
        get up to ten times as many, since each pass is short.
    batch_size : int, default 128
        Examples a step.
    learning_rate : float, default 0.01
        The largest; it rises to it in the first tenth and falls in a cosine to zero.
    word_dropout : float, default 0.05
        Share of the words replaced by the unknown word in training, so that the network has met
        it when a user's question holds one.
    held_out_share : float, default 0.2
        Share of the scenes whose questions are held out.
    seed : int, default 0
        Two runs with the same seed and examples agree, on processors with the same instruction
        set.

    Raises
    ------
    DomainError
        A number is outside its range.
    """

    max_layers: int = 3
    alpha: float = 0.05
    width: int = 48
    embedding: int = 24
    epochs: int = 10
    batch_size: int = 128
    learning_rate: float = 0.01
    word_dropout: float = 0.05
    held_out_share: float = 0.2
    seed: int = 0

    def __post_init__(self) -> None:
        ranges: dict[str, tuple[float, float]] = {
            "max_layers": (1, MOST_LAYERS),
            "alpha": (0.0, 1.0),
            "width": (1, WIDEST),
            "embedding": (1, WIDEST),
            "epochs": (1, 10_000),
            "batch_size": (1, 65_536),
            "learning_rate": (1e-8, 1.0),
            "word_dropout": (0.0, 0.9),
            "held_out_share": (0.0, 0.5),
        }
        for name, (low, high) in ranges.items():
            value = getattr(self, name)
            if not low <= value <= high:
                raise DomainError(f"{name} must be {low:g} to {high:g}, got {value!r}")


@dataclass(frozen=True)
class AnswererEvent:
    """An epoch ended, for a progress display.

    Attributes
    ----------
    layers : int
        LSTM layers of the network in training.
    epoch, epochs : int
        Passes finished and planned with so many layers.
    held_out_accuracy : float or None
        After the last epoch with so many layers: share of held-out questions that are right.
    message : str
        The same in words.
    """

    layers: int
    epoch: int
    epochs: int
    held_out_accuracy: float | None
    message: str
