"""An LSTM over a question's words and a scene, and how both become tensors."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

import numpy as np
import torch
import torch.nn.functional as functional
from pydantic import Field
from torch import nn
from torch.nn.utils.rnn import pack_padded_sequence

from seewhy.dialogue.recurrent_options import MOST_LAYERS, WIDEST
from seewhy.errors import DatasetError
from seewhy.perception.weights import Described

__all__ = ["FORMAT", "PADDING", "UNKNOWN", "Description", "Encoded", "Encoding", "Network"]

FORMAT = 1
PADDING, UNKNOWN = 0, 1  # numbers of no word and of a word never met; words follow

Encoded = tuple[torch.Tensor, torch.Tensor, torch.Tensor]
"""Words (n, longest), lengths (n) and scenes (n, one-hot)."""


class Description(Described):
    """The JSON beside the weights: shapes, and the meaning of every number."""

    layers: Annotated[int, Field(ge=1, le=MOST_LAYERS)]
    width: Annotated[int, Field(ge=1, le=WIDEST)]
    embedding: Annotated[int, Field(ge=1, le=WIDEST)]
    words: tuple[str, ...]
    features: dict[str, tuple[str, ...]]
    labels: tuple[str, ...]
    answers: Annotated[tuple[str, ...], Field(min_length=1)]
    held_out_accuracy: Annotated[float, Field(ge=0.0, le=1.0)]
    held_out: Annotated[int, Field(ge=0)]


class Network(nn.Module):
    """Words and scene → LSTM → dense → logits of the answer types.

    Words that are not ``drawn`` have no numbers yet: to draw them on the device "meta", PyTorch
    imports for a second.
    """

    def __init__(self, description: Description, *, drawn: bool = True) -> None:
        super().__init__()
        d = description
        scene = sum(len(values) for values in d.features.values()) + len(d.labels)
        words = len(d.words) + 2
        self.embedding = nn.Embedding(
            words,
            d.embedding,
            padding_idx=PADDING,
            _weight=None if drawn else torch.empty(words, d.embedding),
        )
        self.lstm = nn.LSTM(d.embedding + scene, d.width, num_layers=d.layers, batch_first=True)
        self.dense = nn.Linear(d.width + scene, d.width)
        self.logits = nn.Linear(d.width, len(d.answers))

    def forward(
        self, words: torch.Tensor, lengths: torch.Tensor, scene: torch.Tensor
    ) -> torch.Tensor:
        """Logits (n, types) of words (n, longest), lengths (n), scene (n, one-hot)."""
        steps = scene[:, None].expand(-1, words.shape[1], -1)
        sequence = pack_padded_sequence(
            torch.cat([self.embedding(words), steps], dim=2),
            lengths,
            batch_first=True,
            enforce_sorted=False,
        )
        _, (hidden, _) = self.lstm(sequence)
        dense = functional.relu(self.dense(torch.cat([hidden[-1], scene], dim=1)))
        logits: torch.Tensor = self.logits(dense)
        return logits


class Encoding:
    """Questions and scenes as tensors."""

    def __init__(self, description: Description) -> None:
        self._word = {word: i + 2 for i, word in enumerate(description.words)}
        self._places: list[dict[str, int]] = []
        place = 0
        for values in (*description.features.values(), description.labels):
            self._places.append({value: place + i for i, value in enumerate(values)})
            place += len(values)
        self._scene_size = place

    def encode(self, questions: Sequence[tuple[Sequence[str], Sequence[str], str]]) -> Encoded:
        longest = max(1, max(len(words) for words, _, _ in questions))
        words = np.full((len(questions), longest), PADDING, dtype=np.int64)
        lengths = np.ones(len(questions), dtype=np.int64)
        scenes = np.zeros((len(questions), self._scene_size), dtype=np.float32)
        for i, (question, features, label) in enumerate(questions):
            if len(features) != len(self._places) - 1:
                raise DatasetError(
                    f"a scene must have {len(self._places) - 1} features, got {len(features)}"
                )
            # A question without words counts as one unknown word: an LSTM needs a step.
            numbers = [self._word.get(word, UNKNOWN) for word in question] or [UNKNOWN]
            words[i, : len(numbers)] = numbers
            lengths[i] = len(numbers)
            for value, places in zip((*features, label), self._places, strict=True):
                if value in places:
                    scenes[i, places[value]] = 1.0
        return torch.from_numpy(words), torch.from_numpy(lengths), torch.from_numpy(scenes)
