"""What a picture's features are taken to be, and the plainest reading: each by itself."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seewhy.dialogue.reply import FeatureReading
from seewhy.knowledge.scene import FeatureVector, SceneSchema

SMALLEST = 1e-300
"""A network's 0.0 is a number too small for its type, not an impossibility."""

Probabilities = Mapping[str, NDArray[np.float64]]
"""Feature → probabilities of its values, of shape (pictures, values).

Where a network sees the class as well, its probabilities are here under "class".
"""


@dataclass(frozen=True)
class Other:
    """What a picture may be as well: a class, how probable it is, and what would then be seen.

    Attributes
    ----------
    label : str
    probability : float
        Of the class; see :class:`Reading`.
    vector : FeatureVector
        The most probable of that class.
    features : dict
        Feature → FeatureReading.
    """

    label: str
    probability: float
    vector: FeatureVector
    features: dict[str, FeatureReading]


@dataclass(frozen=True)
class Reading:
    """What a picture's features are taken to be.

    Attributes
    ----------
    vector : FeatureVector
    features : dict
        Feature → FeatureReading.
    score : float
        The log-probability of the vector (features count as independent): how well the picture
        fits what is read. It is low where a network is not sure, and where what the networks see
        does not go together. (The probability of all candidates together would say nothing where
        most vectors are candidates.)
    probability : float
        Of the class: where features are read separately, the probability that all of them are
        read rightly, until :mod:`seewhy.agent.class_shares` says more. Where the reading is
        consistent, the share of the candidates of that class in the probability of all; one that
        the knowledge leaves open counts for each class as often as the tree's training scenes in
        its leaf are of that class.
    class_seen : (str, float) or None
        The most probable class that a network of its own saw, and its probability, where such a
        network has a say in the reading.
    others : tuple of Other
        What the picture may be as well, the most probable class first.
    leaning : str or None
        Where the knowledge leaves the vector open: the class that is most probable by the tree's
        leaf and by the witness together. None where no witness may outweigh the tree.
    """

    vector: FeatureVector
    features: dict[str, FeatureReading]
    score: float
    probability: float
    class_seen: tuple[str, float] | None = None
    others: tuple[Other, ...] = ()
    leaning: str | None = None


def read_separately(schema: SceneSchema, probabilities: Probabilities) -> list[Reading]:
    """Read the most probable value of every feature, whatever the others are (as the paper does).

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> schema = load_domain("structure_stability").schema
    >>> sure = {
    ...     key: np.full((1, len(values)), 1 / len(values))
    ...     for key, values in schema.features.items()
    ... }
    >>> sure["lean"] = np.array([[0.2, 0.8]])
    >>> (reading,) = read_separately(schema, sure)
    >>> reading.vector, reading.features["lean"].probability, round(reading.probability, 3)
    (('1', 'wide', 'no', 'yes'), 0.8, 0.04)
    """
    tables = feature_tables(schema, probabilities)
    best = np.stack([table.argmax(axis=1) for table in tables], axis=1)
    joint = logarithms_of(np.stack([table.max(axis=1) for table in tables], axis=1)).sum(axis=1)
    return [
        Reading(vector_of_places(schema, columns), features, float(score), float(np.exp(score)))
        for columns, features, score in zip(
            best.tolist(), features_of_places(schema, tables, best), joint, strict=True
        )
    ]


def feature_tables(schema: SceneSchema, probabilities: Probabilities) -> list[NDArray[np.float64]]:
    return [np.asarray(probabilities[key], dtype=np.float64) for key in schema.features]


def logarithms_of(probabilities: NDArray[np.float64]) -> NDArray[np.float64]:
    logarithms: NDArray[np.float64] = np.log(np.maximum(probabilities, SMALLEST))
    return logarithms


def vector_of_places(schema: SceneSchema, columns: Sequence[int]) -> FeatureVector:
    return tuple(
        tuple(literals)[n] for literals, n in zip(schema.features.values(), columns, strict=True)
    )


def features_of_places(
    schema: SceneSchema, tables: Sequence[NDArray[np.float64]], chosen: NDArray[np.intp]
) -> Iterator[dict[str, FeatureReading]]:
    """Yield the readings of every picture whose values' places are ``chosen``."""
    rows = np.arange(len(chosen))
    columns = []
    for table, places, literals in zip(tables, chosen.T, schema.features.values(), strict=True):
        values = tuple(literals)
        alone = table.argmax(axis=1)
        columns.append(
            [
                FeatureReading(values[n], p, (values[m], q) if q > p else None)
                for n, p, m, q in zip(
                    places.tolist(),
                    table[rows, places].tolist(),
                    alone.tolist(),
                    table[rows, alone].tolist(),
                    strict=True,
                )
            ]
        )
    for readings in zip(*columns, strict=True):
        yield dict(zip(schema.features, readings, strict=True))
