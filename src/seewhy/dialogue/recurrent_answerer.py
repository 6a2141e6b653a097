"""Answers for the scenes that reasoning left open, and the files that keep what was learned."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt
import torch

from seewhy.dialogue.recurrent_network import FORMAT, Description, Encoding, Network
from seewhy.errors import DatasetError, ModelError
from seewhy.perception.weights import REMEDY, check_tensors, read_weights, write_weights

__all__ = ["RecurrentAnswerer"]

DESCRIPTION = "answers.json"
WEIGHTS = "answers.safetensors"
_REMEMBERED = 20_000  # questions about kinds of scenes whose logits are kept

Asked = tuple[tuple[str, ...], tuple[str, ...], str]


class RecurrentAnswerer:
    """Answer types for questions about scenes that the tree classified.

    Made by :func:`~seewhy.dialogue.recurrent.fit_answerer` or :meth:`load`.

    Attributes
    ----------
    layers : int
        LSTM layers found.
    held_out_accuracy : float
        Share of the held-out questions that are right, 0..1; on the training questions where
        ``held_out`` is 0.
    held_out : int
        How many questions were held out.
    answer_types : tuple of str
        What can be answered.

    Notes
    -----
    Source: Riley and Sridharan (2019), the recurrent network for answering questions about
    scenes that the decision tree classified. The departures are listed at
    :func:`~seewhy.dialogue.recurrent.fit_answerer`.
    """

    def __init__(self, network: Network, description: Description) -> None:
        self._network = network.eval()
        self._description = description
        self._encoding = Encoding(description)
        self._logits: dict[Asked, npt.NDArray[np.float64]] = {}

    @property
    def layers(self) -> int:
        return self._description.layers

    @property
    def held_out_accuracy(self) -> float:
        return self._description.held_out_accuracy

    @property
    def held_out(self) -> int:
        return self._description.held_out

    @property
    def features(self) -> dict[str, tuple[str, ...]]:
        """The values of each feature of the scenes that it answers for."""
        return self._description.features

    @property
    def answer_types(self) -> tuple[str, ...]:
        return self._description.answers

    def answer(
        self,
        words: Sequence[str],
        features: Sequence[str],
        label: str,
        *,
        allowed: Collection[str] | None = None,
    ) -> tuple[str, float]:
        """The most probable answer type and its probability.

        Parameters
        ----------
        words : sequence of str
            The question's words, normalised as in training; others count as unknown.
        features : sequence of str
            The scene's value of each feature, in the order of training. A value never listed
            counts as not known.
        label : str
            The class that the tree gave.
        allowed : collection of str, optional
            Only these types are answered: those that the question's template can produce. The
            probability is among them. If training met none of them, the first in alphabetical
            order is given with probability 1 divided by their number.

        Returns
        -------
        answer : str
        probability : float

        Raises
        ------
        DatasetError
            There are more or fewer features than in training, or ``allowed`` is empty.
        """
        return self.answers([(words, features, label)], allowed=[allowed])[0]

    def answers(
        self,
        questions: Sequence[tuple[Sequence[str], Sequence[str], str]],
        *,
        allowed: Sequence[Collection[str] | None] | None = None,
    ) -> list[tuple[str, float]]:
        """Many at once: (words, features, label) each, and what each allows.

        See :meth:`answer`.
        """
        if allowed is not None and len(allowed) != len(questions):
            raise DatasetError(
                f"allowed must have one entry a question ({len(questions)}), got {len(allowed)}"
            )
        if not questions:
            return []
        asked = [(tuple(words), tuple(features), label) for words, features, label in questions]
        self._compute(asked)
        choices = [None] * len(questions) if allowed is None else allowed
        return [
            self._choose(self._logits[question], types)
            for question, types in zip(asked, choices, strict=True)
        ]

    def _compute(self, asked: Sequence[Asked]) -> None:
        """Run the network on what it was not asked before: pictures of one kind come back often."""
        if len(self._logits) + len(asked) > _REMEMBERED:
            self._logits.clear()
        new = [question for question in dict.fromkeys(asked) if question not in self._logits]
        if new:
            with torch.inference_mode():
                logits = self._network(*self._encoding.encode(new)).double().numpy()
            if not np.isfinite(logits).all():
                raise ModelError(f"the network that answers questions gives no number: {REMEDY}")
            self._logits.update(zip(new, logits, strict=True))

    def _choose(
        self, logits: npt.NDArray[np.float64], allowed: Collection[str] | None
    ) -> tuple[str, float]:
        types = self.answer_types
        open_to = list(range(len(types)))
        if allowed is not None:
            if not allowed:
                raise DatasetError("allowed must name at least one answer type, got none")
            open_to = [i for i in open_to if types[i] in allowed]
            if not open_to:
                return min(allowed), 1.0 / len(allowed)
        weights = np.exp(logits[open_to] - logits[open_to].max())
        best = int(weights.argmax())
        return types[open_to[best]], float(weights[best] / weights.sum())

    def save(self, folder: Path | str) -> None:
        """Write ``answers.safetensors`` and ``answers.json`` into ``folder``."""
        write_weights(
            self._network.state_dict(),
            self._description,
            weights=Path(folder) / WEIGHTS,
            described=Path(folder) / DESCRIPTION,
        )

    @classmethod
    def load(cls, folder: Path | str) -> RecurrentAnswerer:
        """Read what :meth:`save` wrote.

        Raises
        ------
        ModelError
            A file is missing, damaged, or does not belong to the other; the text names it.
        """
        weights, described = Path(folder) / WEIGHTS, Path(folder) / DESCRIPTION
        description, tensors = read_weights(
            Description, number=FORMAT, weights=weights, described=described
        )
        with torch.device("meta"):
            network = Network(description, drawn=False)
        check_tensors(tensors, network.state_dict(), weights=weights, described=described)
        network.load_state_dict(tensors, assign=True)
        return cls(network, description)
