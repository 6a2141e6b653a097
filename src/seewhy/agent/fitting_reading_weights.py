"""How much each that is seen counts in a consistent reading, by pictures that taught nobody."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from seewhy.agent.consistent_reading import ConsistentReading
from seewhy.agent.picture_reading import Probabilities
from seewhy.agent.reading_weights import ReadingWeights

_FEATURE_WEIGHTS = (0.35, 0.5, 0.7, 1.0, 1.4)
_WITNESS_WEIGHTS = (0.0, 0.15, 0.3, 0.5, 0.7, 1.0)
_JUDGED = 500  # pictures: more cost time and change nothing
_LEAST = 1e-3  # a class that the knowledge excludes is no infinite surprise


def fit_reading_weights(
    reader: ConsistentReading,
    probabilities: Probabilities,
    labels: Sequence[str | None],
) -> ReadingWeights:
    """Weigh what is seen so that the classes of pictures that taught nobody are most likely.

    A witness that was shown three pictures of every class is worse than the knowledge, one that was
    shown a hundred may be better: how much it counts is a matter of the pictures.

    Parameters
    ----------
    reader : ConsistentReading
    probabilities : mapping
        As for :meth:`ConsistentReading.read`, of pictures kept out of training.
    labels : sequence of str or None
        Their classes.

    Returns
    -------
    ReadingWeights
        Those given where there are too few pictures, or candidates are searched.
    """
    places = {name: n for n, name in enumerate(reader.schema.classes)}
    rows = [n for n, label in enumerate(labels) if label in places][:_JUDGED]
    if len(rows) < 10:
        return reader.weights
    true = [places[str(labels[n])] for n in rows]
    some = {name: table[rows] for name, table in probabilities.items()}
    found: list[tuple[float, float, ReadingWeights]] = []
    for features in _FEATURE_WEIGHTS:
        for witness in _WITNESS_WEIGHTS if reader.witnessed else (1.0,):
            weights = ReadingWeights(features, witness)
            classes = reader.weighing(weights).class_probabilities(some)
            if classes is None:
                return reader.weights
            loss = -np.log(np.maximum(classes[np.arange(len(true)), true], _LEAST)).sum()
            # Of nearly equal ones the plainest: features as they are, a witness little asked.
            found.append((round(float(loss), 1), abs(np.log(features)) + witness, weights))
    return min(found, key=lambda row: row[:2])[2]
