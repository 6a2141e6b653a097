"""Train the recurrent network that answers where reasoning left a scene open."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
import torch
import torch.nn.functional as functional

from seewhy.dialogue.recurrent_answerer import RecurrentAnswerer
from seewhy.dialogue.recurrent_network import (
    FORMAT,
    PADDING,
    UNKNOWN,
    Description,
    Encoding,
    Network,
)
from seewhy.dialogue.recurrent_options import AnswererEvent, AnswerExample, RecurrentOptions
from seewhy.errors import DatasetError
from seewhy.perception.epochs import batches
from seewhy.perception.one_thread import one_thread
from seewhy.perception.optimisation import descend, one_cycle, slow_down
from seewhy.perception.randomness import seeded

__all__ = ["Asked", "fit_answerer", "grown_network", "hold_out"]

ENOUGH_EXAMPLES = 3000  # what `epochs` is meant for; fewer examples get more epochs


def fit_answerer(
    examples: Sequence[AnswerExample],
    *,
    feature_values: Mapping[str, Sequence[str]],
    options: RecurrentOptions | None = None,
    on_progress: Callable[[AnswererEvent], None] | None = None,
) -> RecurrentAnswerer:
    """Train an LSTM to answer questions about scenes that reasoning left open.

    A network with one LSTM layer is trained; a layer is added as long as that improves the
    accuracy on held-out questions significantly. The improvement is tested by McNemar's exact
    test, one-sided: of the held-out questions that exactly one of the two networks answers
    rightly, the deeper must win more than chance would let it (a binomial test at level
    ``options.alpha``). The network before the first insignificant layer is kept.

    Parameters
    ----------
    examples : sequence of AnswerExample
        Questions about those scenes only.
    feature_values : mapping of str to sequence of str
        The features in the order of ``AnswerExample.features``, and all values of each.
    options : RecurrentOptions, optional
        See there.
    on_progress : callable, optional
        Called with an :class:`AnswererEvent` after every epoch.

    Returns
    -------
    RecurrentAnswerer

    Raises
    ------
    DatasetError
        There is no example, or one has another number of features.

    Notes
    -----
    Source: Riley and Sridharan (2019), the recurrent network for answers. Departures: words are
    embedded by numbers that are learned along; the scene (features and class, one-hot) enters
    every step beside the word and the dense layer once more, because an LSTM alone is slow to
    carry through a sentence what it could be told at its end; a rare word stands for unknown
    ones (word dropout); the significance of an improvement is McNemar's exact test, where the
    paper leaves the test open.

    Examples
    --------
    >>> examples = [
    ...     AnswerExample(("is", "it", "stable"), (lean,), "open", {"yes": "no", "no": "yes"}[lean])
    ...     for lean in ("yes", "no") * 50
    ... ]
    >>> answerer = fit_answerer(examples, feature_values={"lean": ["yes", "no"]})
    >>> answerer.answer(["is", "it", "stable"], ["yes"], "open")[0]
    'no'
    """
    options = options or RecurrentOptions()
    if not examples:
        raise DatasetError("there is no question to learn from: add scenes that are left open")
    for example in examples:
        if len(example.features) != len(feature_values):
            raise DatasetError(
                f"an example must have one value for each of {', '.join(feature_values)}, "
                f"got {example.features}"
            )
    train, held_out = hold_out([example.scene for example in examples], options)
    description = Description(
        format=FORMAT,
        layers=1,
        width=options.width,
        embedding=options.embedding,
        # Words of held-out questions alone have no trained embedding: they are unknown.
        words=tuple(sorted({word for i in train for word in examples[i].words})),
        features={name: tuple(values) for name, values in feature_values.items()},
        labels=tuple(sorted({example.label for example in examples})),
        answers=tuple(sorted({example.answer for example in examples})),
        held_out_accuracy=0.0,
        held_out=len(held_out),
        digest="",
    )
    number = {answer: i for i, answer in enumerate(description.answers)}
    asked = Asked(
        *Encoding(description).encode([(e.words, e.features, e.label) for e in examples]),
        torch.tensor([number[example.answer] for example in examples]),
    )
    return RecurrentAnswerer(
        *grown_network(
            description,
            asked,
            train=train,
            held_out=held_out,
            options=options,
            on_progress=on_progress,
        )
    )


def grown_network(
    description: Description,
    asked: Asked,
    *,
    train: npt.NDArray[np.int64],
    held_out: npt.NDArray[np.int64],
    options: RecurrentOptions,
    on_progress: Callable[[AnswererEvent], None] | None = None,
) -> tuple[Network, Description]:
    """Train networks of one LSTM layer, two, and so on; return the last that was worth it.

    Parameters
    ----------
    description : Description
        Of a network with one layer.
    asked : Asked
        All questions.
    train, held_out : ndarray of int64
        Which of them train, and which judge.
    options, on_progress
        As for :func:`fit_answerer`.
    """
    # With too few scenes to spare any, those of training must do.
    judged = asked.only(held_out if len(held_out) else train)

    kept: tuple[Network, npt.NDArray[np.bool_]] | None = None
    for layers in range(1, options.max_layers + 1):
        deeper = description.model_copy(update={"layers": layers})
        network = _train(deeper, asked.only(train), judged, options, on_progress)
        right = _right(network, judged)
        if kept is not None and not _improves(kept[1], right, options.alpha):
            break
        kept = network, right
        description = deeper.model_copy(update={"held_out_accuracy": float(right.mean())})
        if right.all():
            break  # nothing is left to improve
    assert kept is not None
    return kept[0], description


def hold_out(
    scenes: Sequence[int | None], options: RecurrentOptions
) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """Indices of the questions to train on and of those held out, scenes kept whole.

    ``scenes`` names the scene of every question; one without a scene is one by itself.
    """
    groups = [("alone", i) if scene is None else scene for i, scene in enumerate(scenes)]
    kinds = list(dict.fromkeys(groups))
    rng = np.random.default_rng(options.seed)
    count = min(round(options.held_out_share * len(kinds)), len(kinds) - 1)
    away = {kinds[i] for i in rng.permutation(len(kinds))[:count]}
    outside = np.array([group in away for group in groups], dtype=bool)
    return np.flatnonzero(~outside), np.flatnonzero(outside)


class Asked(NamedTuple):
    """Questions as tensors, one a row, and the numbers of their right answers."""

    words: torch.Tensor
    lengths: torch.Tensor
    scenes: torch.Tensor
    answers: torch.Tensor

    def only(self, rows: npt.NDArray[np.int64] | torch.Tensor) -> Asked:
        """The questions in some rows."""
        rows = torch.as_tensor(rows)
        return Asked(*(tensor[rows] for tensor in self))


def _train(
    description: Description,
    asked: Asked,
    judged: Asked,
    options: RecurrentOptions,
    on_progress: Callable[[AnswererEvent], None] | None,
) -> Network:
    """A network of so many layers, trained to the end."""
    n, layers = len(asked.answers), description.layers
    epochs = math.ceil(options.epochs * min(10.0, max(1.0, ENOUGH_EXAMPLES / n)))
    rows = torch.arange(n)
    with seeded(torch.device("cpu"), options.seed, layers), one_thread():
        network = Network(description)
        weights = {"params": network.parameters(), "largest": options.learning_rate}
        optimizer = torch.optim.AdamW([weights])
        for epoch in range(epochs):
            network.train()
            for batch in batches(rows, size=options.batch_size, epoch=epoch, epochs=epochs):
                slow_down(optimizer, to=one_cycle(batch.progress, rising=0.1, least=0.1))
                shown = asked.only(batch.rows)
                words = shown.words[:, : int(shown.lengths.max())]
                dropped = (torch.rand(words.shape) < options.word_dropout) & (words != PADDING)
                words = words.masked_fill(dropped, UNKNOWN)
                logits = network(words, shown.lengths, shown.scenes)
                descend(functional.cross_entropy(logits, shown.answers), optimizer, steepest=1.0)
            if on_progress is not None:
                accuracy = None
                message = f"answers: epoch {epoch + 1} of {epochs}, {layers} LSTM layer"
                message += "s" if layers > 1 else ""
                if epoch + 1 == epochs:
                    accuracy = float(_right(network, judged).mean())
                    message += f", {accuracy:.1%} on held-out questions"
                on_progress(AnswererEvent(layers, epoch + 1, epochs, accuracy, message))
    return network.eval()


def _right(network: Network, asked: Asked) -> npt.NDArray[np.bool_]:
    """Which questions are answered rightly."""
    network.eval()
    with torch.inference_mode():
        logits = network(asked.words, asked.lengths, asked.scenes)
        found: npt.NDArray[np.bool_] = (logits.argmax(dim=1) == asked.answers).numpy()
    return found


def _improves(before: npt.NDArray[np.bool_], after: npt.NDArray[np.bool_], alpha: float) -> bool:
    """Whether ``after`` is right significantly more often: McNemar's exact test, one-sided."""
    from scipy.stats import binomtest  # slow to import, and answering needs none of it

    won, lost = int((after & ~before).sum()), int((before & ~after).sum())
    if won + lost == 0:
        return False
    return bool(binomtest(won, won + lost, 0.5, alternative="greater").pvalue < alpha)
