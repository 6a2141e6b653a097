"""Of which classes a picture may be whose features are read each by itself."""

from __future__ import annotations

import heapq
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from math import prod

import numpy as np
from numpy.typing import NDArray

from seewhy.agent.picture_reading import Other, Reading
from seewhy.dialogue.reply import FeatureReading
from seewhy.knowledge.scene import FeatureVector, SceneSchema

__all__ = ["MOST_VECTORS", "with_class_shares"]

MOST_VECTORS = 128
"""So many of a picture's most probable feature vectors are looked at at most.

What is beyond them counts for no class: a class may be more probable than it is said to be.
"""

_LEFT_OUT = 0.001  # in sum; less where that would matter for whether a class is named

Shares = Mapping[str, float]


def with_class_shares(
    readings: Sequence[Reading],
    schema: SceneSchema,
    probabilities: Mapping[str, NDArray[np.float64]],
    *,
    shares_of_all: Callable[[Sequence[FeatureVector]], Sequence[Shares]],
    label_of: Callable[[FeatureVector], str | None],
    other_from: float,
) -> list[Reading]:
    """Return readings with the probability of their class, and with what else a picture may be.

    The probability of a class is that of all feature vectors of that class together, where
    features count as independent. In a reading that takes each feature's most probable value by
    itself (:func:`~seewhy.agent.picture_reading.read_separately`) the features stay as they
    are read.

    Parameters
    ----------
    readings : sequence of Reading
        One a picture.
    schema : SceneSchema
    probabilities : mapping of str to ndarray of float, shape (pictures, values)
        Of every feature.
    shares_of_all : callable
        Feature vectors → for each, its classes with the probability of each; empty for one without.
    label_of : callable
        The class that a picture with some feature vector is taken to be of, or None.
    other_from : float
        How probable another class has to be to be named (0 to 1); 1 names none.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> from seewhy.knowledge.reasoner import Reasoner
    >>> from seewhy.agent.picture_reading import read_separately
    >>> domain = load_domain("structure_stability")
    >>> reasoner = Reasoner(domain.knowledge, domain.schema)
    >>> seen = {"num_blocks": np.array([[0.0, 0.0, 0.0, 0.0, 1.0]]), "base": np.array([[1.0, 0.0]]),
    ...         "lean": np.array([[0.0, 1.0]]), "block_displaced": np.array([[0.3, 0.7]])}
    >>> label_of = lambda vector: reasoner.decide(vector).label
    >>> (reading,) = with_class_shares(
    ...     read_separately(domain.schema, seen), domain.schema, seen, label_of=label_of,
    ...     shares_of_all=lambda all: [{label_of(v): 1.0} if label_of(v) else {} for v in all],
    ...     other_from=0.1)
    >>> round(reading.probability, 3)
    0.7
    >>> [(other.label, round(other.probability, 3)) for other in reading.others]
    [('unstable', 0.3)]
    """
    tables = [np.asarray(probabilities[key], dtype=np.float64) for key in schema.features]
    values = [tuple(literals) for literals in schema.features.values()]
    left_out = min(_LEFT_OUT, other_from / 10)
    likely = [
        list(_most_probable([table[row] for table in tables], least=left_out))
        for row in range(len(readings))
    ]
    vectors = {
        columns: tuple(column[n] for column, n in zip(values, columns, strict=True))
        for picture in likely
        for columns, _ in picture
    }
    shares = dict(zip(vectors, shares_of_all(list(vectors.values())), strict=True))
    found = []
    for row, (reading, picture) in enumerate(zip(readings, likely, strict=True)):
        label = label_of(reading.vector)
        probable: dict[str, float] = {}
        best: dict[str, tuple[float, tuple[int, ...]]] = {}
        for columns, probability in picture:
            for name, share in shares[columns].items():
                joint = probability * share
                probable[name] = probable.get(name, 0.0) + joint
                best[name] = max(best.get(name, (0.0, columns)), (joint, columns))
        others = [
            Other(
                name,
                min(1.0, probability),
                vectors[best[name][1]],
                _readings([table[row] for table in tables], best[name][1], schema),
            )
            for name, probability in probable.items()
            if name != label and probability >= other_from and other_from < 1.0
        ]
        found.append(
            replace(
                reading,
                probability=reading.probability
                if label is None
                else min(1.0, probable.get(label, 0.0)),
                others=tuple(sorted(others, key=lambda other: -other.probability)),
            )
        )
    return found


def _most_probable(
    tables: Sequence[NDArray[np.float64]], *, least: float
) -> Iterator[tuple[tuple[int, ...], float]]:
    """Yield feature vectors as places of values with their probability, the most probable first.

    It ends where all others together are less probable than ``least``.
    """
    order = [(-table).argsort(kind="stable") for table in tables]
    sorted_ = [table[places].tolist() for table, places in zip(tables, order, strict=True)]
    start = (0,) * len(tables)
    left = 1.0
    heap = [(-prod(table[0] for table in sorted_), start, 0)]
    for _ in range(MOST_VECTORS):
        if not heap or left < least:
            return
        negative, ranks, first = heapq.heappop(heap)
        if negative == 0.0:
            return
        yield tuple(int(places[n]) for places, n in zip(order, ranks, strict=True)), -negative
        left += negative
        # Every vector is reached once: from the one whose last changed place is a step better.
        for place in range(first, len(ranks)):
            if ranks[place] + 1 < len(sorted_[place]):
                after = (*ranks[:place], ranks[place] + 1, *ranks[place + 1 :])
                joint = prod(table[n] for table, n in zip(sorted_, after, strict=True))
                heapq.heappush(heap, (-joint, after, place))


def _readings(
    tables: Sequence[NDArray[np.float64]], columns: Sequence[int], schema: SceneSchema
) -> dict[str, FeatureReading]:
    """What the features of one picture would be read as."""
    found = {}
    for (key, literals), table, place in zip(schema.features.items(), tables, columns, strict=True):
        values, alone = tuple(literals), int(table.argmax())
        probability, highest = float(table[place]), float(table[alone])
        overruled = (values[alone], highest) if highest > probability else None
        found[key] = FeatureReading(values[place], probability, overruled)
    return found
