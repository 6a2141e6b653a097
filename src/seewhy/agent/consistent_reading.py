"""Read pictures: from the networks' probabilities to one feature vector for each picture."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from copy import copy
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from seewhy.dialogue.reply import FeatureReading
from seewhy.domain.tables import CLASS, READINGS, ReadingRule
from seewhy.errors import DomainError
from seewhy.knowledge.candidates import TRIED, decided_vectors, most_probable_decided
from seewhy.knowledge.reasoner import Reasoner, Verdict
from seewhy.knowledge.scene import FeatureVector, SceneSchema
from seewhy.text.nearest import did_you_mean

__all__ = [
    "READINGS",
    "ConsistentReading",
    "Other",
    "Reading",
    "ReadingRule",
    "ReadingWeights",
    "fit_reading_weights",
    "open_vectors",
    "read_separately",
    "reading_rule",
]

LISTED = 20_000
"""Where the knowledge decides more vectors than this, they are searched instead of listed."""

_SMALLEST = 1e-300  # a network's 0.0 is a number too small for its type, not an impossibility
_AT_ONCE = 1 << 21  # (picture, candidate) pairs of one NumPy operation: 16 MiB

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


@dataclass(frozen=True)
class ReadingWeights:
    """How much what is seen counts in a consistent reading.

    Attributes
    ----------
    features : float
        The power to which the probabilities of features are raised: below 1 where features are
        misread together, so that their product says more than it knows.
    witness : float
        That of the class's, where it is seen by itself; 0 does not ask it.
    """

    features: float = 1.0
    witness: float = 1.0


UNWEIGHTED = ReadingWeights()
"""What is seen counts as it is."""


def reading_rule(name: str) -> ReadingRule:
    """Return the way of reading of a name.

    Raises
    ------
    DomainError
        If there is none.

    Examples
    --------
    >>> reading_rule("consistent")
    'consistent'
    """
    for rule in READINGS:
        if name == rule:
            return rule
    raise DomainError(f"'{name}' is no way to read features; {did_you_mean(name, READINGS)}")


def read_separately(schema: SceneSchema, probabilities: Probabilities) -> list[Reading]:
    """Read the most probable value of every feature, whatever the others are (as the paper does).

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> schema = load_domain("structure_stability").schema
    >>> sure = {key: np.full((1, len(own)), 1 / len(own)) for key, own in schema.features.items()}
    >>> sure["lean"] = np.array([[0.2, 0.8]])
    >>> (reading,) = read_separately(schema, sure)
    >>> reading.vector, reading.features["lean"].probability, round(reading.probability, 3)
    (('1', 'wide', 'no', 'yes'), 0.8, 0.04)
    """
    tables = _tables(schema, probabilities)
    best = np.stack([own.argmax(axis=1) for own in tables], axis=1)
    joint = _logarithms(np.stack([own.max(axis=1) for own in tables], axis=1)).sum(axis=1)
    return [
        Reading(_vector(schema, columns), features, float(score), float(np.exp(score)))
        for columns, features, score in zip(
            best.tolist(), _features(schema, tables, best), joint, strict=True
        )
    ]


class ConsistentReading:
    """Reads the most probable feature vector among those that can be.

    Candidates are the vectors that the knowledge decides and ``open_vectors``: vectors of
    annotated pictures that it leaves open. Features count as independent, so that a vector's
    probability is the product of its values' probabilities. Where there is no candidate at all,
    features are read separately.

    Where a network sees the class as well, it is one more witness: a vector's probability is
    multiplied with that of its class. It says nothing of vectors without a class, or of a class
    of which it was shown no picture: these count like its most probable class.

    Departure from the paper, in which every feature is read by itself; the results are the
    paper's with :func:`read_separately`.

    Parameters
    ----------
    reasoner : Reasoner
    open_vectors : sequence of FeatureVector
        Vectors with unknown values are left out.
    label_of : callable
        The class of a candidate, or None.
    shares_of : callable, optional
        The classes of a candidate with the probability of each; ``label_of`` without doubt where
        left out.
    other_from : float, default 1.0
        How probable another class has to be for the reading to name it (:class:`Other`). Where
        vectors are searched instead of listed none is.
    witnessed : collection of str
        The classes that the network of the class was shown; none where there is no such network.
    weights : ReadingWeights
        See :func:`fit_reading_weights`.
    outweighs : bool, default False
        Whether the witness, weighed beside the tree's leaf, may decide what the knowledge leaves
        open (:attr:`Reading.leaning`).
    listed : int
        With more vectors that the knowledge decides than this, the best one is searched for every
        picture: the reading is the same, but the class's probability is then that of the one
        vector.
    tried : int
        See :func:`~seewhy.knowledge.candidates.most_probable_decided`.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> reasoner = Reasoner(domain.knowledge, domain.schema)
    >>> reader = ConsistentReading(reasoner, (), label_of=lambda v: reasoner.decide(v).label)
    >>> (reading,) = reader.read({"num_blocks": np.array([[0.0, 0.0, 0.2, 0.8, 0.0]]),
    ...                           "base": np.array([[0.1, 0.9]]), "lean": np.array([[0.1, 0.9]]),
    ...                           "block_displaced": np.array([[0.1, 0.9]])})
    >>> reading.vector
    ('3', 'narrow', 'no', 'no')
    >>> reading.features["num_blocks"]
    FeatureReading(value='3', probability=0.2, overruled=('4', 0.8))
    """

    def __init__(
        self,
        reasoner: Reasoner,
        open_vectors: Sequence[FeatureVector],
        *,
        label_of: Callable[[FeatureVector], str | None],
        shares_of: Callable[[FeatureVector], Mapping[str, float]] | None = None,
        other_from: float = 1.0,
        witnessed: Collection[str] = (),
        weights: ReadingWeights = UNWEIGHTED,
        outweighs: bool = False,
        listed: int = LISTED,
        tried: int = TRIED,
    ) -> None:
        self.schema = reasoner.schema
        self.reasoner = reasoner
        self.label_of = label_of
        self.shares_of = shares_of
        self.other_from = other_from
        self.witnessed = frozenset(witnessed)
        self.weights = weights
        self.outweighs = outweighs
        self.listed = listed
        self.tried = tried
        self._open = [v for v in dict.fromkeys(open_vectors) if None not in v]

    @cached_property
    def _decided(self) -> tuple[FeatureVector, ...] | None:
        return decided_vectors(self.reasoner, limit=self.listed)

    @cached_property
    def _candidates(self) -> NDArray[np.intp]:
        """The listed candidates, shape (candidates, features): places of the values."""
        places = [{value: n for n, value in enumerate(own)} for own in self._values]
        rows = [
            [place[value or ""] for place, value in zip(places, vector, strict=True)]
            for vector in dict.fromkeys((*(self._decided or ()), *self._open))
        ]
        return np.array(sorted(rows), dtype=np.intp).reshape(-1, len(places))

    @cached_property
    def _classes(self) -> NDArray[np.intp]:
        """The place of every listed candidate's class; beyond the last for one without."""
        places: dict[str | None, int] = {own: n for n, own in enumerate(self.schema.classes)}
        labels = (self.label_of(_vector(self.schema, row)) for row in self._candidates.tolist())
        return np.array([places.get(own, len(places)) for own in labels], dtype=np.intp)

    @cached_property
    def _shares(self) -> NDArray[np.float64]:
        """How probable each class, or none, is for each candidate: (candidates, classes + 1)."""
        places = {own: n for n, own in enumerate(self.schema.classes)}
        found = np.zeros((len(self._candidates), len(places) + 1))
        for row, (columns, place) in enumerate(
            zip(self._candidates.tolist(), self._classes.tolist(), strict=True)
        ):
            own = self.shares_of(_vector(self.schema, columns)) if self.shares_of else {}
            for label, share in own.items():
                found[row, places[label]] = share
            if not own:
                found[row, place] = 1.0
        return found

    @cached_property
    def _values(self) -> list[tuple[str, ...]]:
        return [tuple(own) for own in self.schema.features.values()]

    def read(self, probabilities: Probabilities) -> list[Reading]:
        """Read pictures.

        Parameters
        ----------
        probabilities : mapping of str to ndarray of float, shape (pictures, values)
            Of every feature, and under "class" of the classes where they are ``witnessed``.

        Returns
        -------
        list of Reading
            One a picture. Of equally probable vectors that are listed, the first in the order of
            the values.
        """
        tables = _tables(self.schema, probabilities)
        searched = self._decided is None
        if not searched and not len(self._candidates):
            return read_separately(self.schema, probabilities)
        logarithms = [_logarithms(own) for own in tables]
        classes = self._class_scores(probabilities, len(tables[0]))
        seen = self._classes_seen(probabilities, len(tables[0]))
        pictures = len(tables[0])
        step = max(1, _AT_ONCE // max(1, len(self._candidates)))
        found: list[Reading] = []
        for start in range(0, pictures, step):
            part = [own[start : start + step] for own in logarithms]
            shown = [own[start : start + step] for own in tables]
            scored = classes[start : start + step]
            others: list[tuple[Other, ...]] = [()] * len(part[0])
            leaning: list[str | None] = [None] * len(part[0])
            if searched:
                best, scores, shares = self._search(part, scored)
            else:
                best, scores, shares, others, leaning = self._choose(part, scored, shown)
            features = _features(self.schema, shown, best)
            found += [
                Reading(_vector(self.schema, columns), *own)
                for columns, *own in zip(
                    best.tolist(),
                    features,
                    scores.tolist(),
                    shares.tolist(),
                    seen[start : start + step],
                    others,
                    leaning,
                    strict=True,
                )
            ]
        return found

    def _class_scores(self, probabilities: Probabilities, pictures: int) -> NDArray[np.float64]:
        """What is added for a vector of every class, or of none: shape (pictures, classes + 1)."""
        scores = np.zeros((pictures, len(self.schema.classes) + 1))
        if self.witnessed:
            seen = _logarithms(np.asarray(probabilities[CLASS], dtype=np.float64))
            relative = seen - seen.max(axis=1, keepdims=True)
            own = [n for n, name in enumerate(self.schema.classes) if name in self.witnessed]
            scores[:, own] = self.weights.witness * relative[:, own]
        return scores

    def _classes_seen(
        self, probabilities: Probabilities, pictures: int
    ) -> list[tuple[str, float] | None]:
        if not self.witnessed:
            return [None] * pictures
        names, table = tuple(self.schema.classes), np.asarray(probabilities[CLASS])
        return [(names[int(row.argmax())], float(row.max())) for row in table]

    def _choose(
        self,
        logarithms: Sequence[NDArray[np.float64]],
        class_scores: NDArray[np.float64],
        tables: Sequence[NDArray[np.float64]],
    ) -> tuple[
        NDArray[np.intp],
        NDArray[np.float64],
        NDArray[np.float64],
        list[tuple[Other, ...]],
        list[str | None],
    ]:
        """The best candidate of every picture, its score, its class's probability, and others.

        Last, the class to which it leans, where the knowledge leaves the candidate open.
        """
        alone = self._joint(logarithms)
        weighted = self.weights.features * alone
        agreeing = class_scores[:, self._classes]
        if self.outweighs and len(self._doubtful):
            agreeing[:, self._doubtful] = self._leaf_scores(class_scores, self._doubtful).max(
                axis=2
            )
        best = (weighted + agreeing).argmax(axis=1)
        relative = np.exp(weighted - weighted.max(axis=1, keepdims=True))
        probable = self._probable(relative, class_scores)
        rows, read = np.arange(len(best)), self._classes[best]
        leaning: list[str | None] = [None] * len(best)
        doubted = np.flatnonzero(np.isin(best, self._doubtful)) if self.outweighs else rows[:0]
        for row in doubted.tolist():
            scores = self._leaf_scores(class_scores[row : row + 1], best[row : row + 1])[0, 0]
            read[row] = int(scores.argmax())
            leaning[row] = tuple(self.schema.classes)[read[row]]
        shares = probable[rows, read]
        probable[rows, read] = 0.0
        others: list[tuple[Other, ...]] = [()] * len(best)
        if self.other_from < 1.0:
            others = self._others(probable, relative, tables)
        return self._candidates[best], alone[rows, best], shares, others, leaning

    @cached_property
    def _doubtful(self) -> NDArray[np.intp]:
        """The candidates that may be of several classes, by the tree's leaf."""
        return np.flatnonzero((self._shares[:, :-1] > 0).sum(axis=1) > 1)

    def _leaf_scores(
        self, class_scores: NDArray[np.float64], candidates: NDArray[np.intp]
    ) -> NDArray[np.float64]:
        """Leaf and witness together: (pictures, candidates, classes), in logarithms."""
        leaves = _logarithms(self._shares[candidates, :-1])
        return class_scores[:, None, :-1] + leaves[None]

    def _probable(
        self, relative: NDArray[np.float64], class_scores: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Probabilities of the classes, and of none: shape (pictures, classes + 1)."""
        mass = (relative @ self._shares) * np.exp(class_scores)
        found: NDArray[np.float64] = mass / np.maximum(mass.sum(axis=1, keepdims=True), _SMALLEST)
        return found

    def class_probabilities(self, probabilities: Probabilities) -> NDArray[np.float64] | None:
        """Probabilities of the classes, and of none, by all candidates together.

        Parameters
        ----------
        probabilities : mapping
            As for :meth:`read`.

        Returns
        -------
        ndarray of float, shape (pictures, classes + 1), or None
            None where candidates are searched instead of listed.
        """
        if self._decided is None or not len(self._candidates):
            return None
        tables = _tables(self.schema, probabilities)
        weighted = self.weights.features * self._joint([_logarithms(table) for table in tables])
        relative = np.exp(weighted - weighted.max(axis=1, keepdims=True))
        return self._probable(relative, self._class_scores(probabilities, len(tables[0])))

    def weighing(self, weights: ReadingWeights) -> ConsistentReading:
        """The same reading, with what is seen weighed otherwise; candidates are not listed anew."""
        other = copy(self)
        other.weights = weights
        return other

    def _others(
        self,
        probable: NDArray[np.float64],
        relative: NDArray[np.float64],
        tables: Sequence[NDArray[np.float64]],
    ) -> list[tuple[Other, ...]]:
        """What each picture may be, of the classes that are probable beside the one read."""
        names = tuple(self.schema.classes)
        pictures, places = np.nonzero(probable[:, : len(names)] >= self.other_from)
        nearest = (relative[pictures] * self._shares.T[places]).argmax(axis=1)
        columns = self._candidates[nearest]
        features = _features(self.schema, [own[pictures] for own in tables], columns)
        found: list[list[Other]] = [[] for _ in probable]
        for picture, place, vector, own in zip(
            pictures.tolist(), places.tolist(), columns.tolist(), features, strict=True
        ):
            probability = float(probable[picture, place])
            found[picture].append(
                Other(names[place], probability, _vector(self.schema, vector), own)
            )
        return [tuple(sorted(own, key=lambda other: -other.probability)) for own in found]

    def _joint(self, logarithms: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
        joint = np.zeros((len(logarithms[0]), len(self._candidates)))
        for own, column in zip(logarithms, self._candidates.T, strict=True):
            joint += own[:, column]
        return joint

    def _search(
        self, logarithms: Sequence[NDArray[np.float64]], class_scores: NDArray[np.float64]
    ) -> tuple[NDArray[np.intp], NDArray[np.float64], NDArray[np.float64]]:
        """The same for candidates that are not listed; without any, the separate reading."""
        best = np.stack([own.argmax(axis=1) for own in logarithms], axis=1)
        places = [{value: n for n, value in enumerate(own)} for own in self._values]
        logarithms = [self.weights.features * table for table in logarithms]
        opened = self._joint(logarithms) + class_scores[:, self._classes]
        for number in range(len(best)):
            above = -np.inf
            if len(self._candidates):
                nearest = int(opened[number].argmax())
                above = opened[number, nearest]
                best[number] = self._candidates[nearest]
            scores = zip(self.schema.classes, class_scores[number].tolist(), strict=False)
            found = most_probable_decided(
                self.reasoner,
                [own[number] for own in logarithms],
                class_scores={label: own for label, own in scores if own},
                above=above,
                tried=self.tried,
            )
            if found is not None:
                chosen = zip(places, found[0], strict=True)
                best[number] = [place[value or ""] for place, value in chosen]
        rows = np.arange(len(best))
        weighted = np.sum(
            [table[rows, n] for table, n in zip(logarithms, best.T, strict=True)], axis=0
        )
        alone = weighted / self.weights.features
        return best, alone, np.exp(alone)


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


def open_vectors(
    reasoner: Reasoner, experience: Mapping[FeatureVector, object]
) -> list[FeatureVector]:
    """Return the annotated vectors that the knowledge leaves open without contradiction."""
    vectors = list(experience)
    return [
        vector
        for vector, own in zip(vectors, reasoner.decide_all(vectors), strict=True)
        if own.verdict in (Verdict.SILENT, Verdict.SEVERAL)
    ]


def _tables(schema: SceneSchema, probabilities: Probabilities) -> list[NDArray[np.float64]]:
    return [np.asarray(probabilities[key], dtype=np.float64) for key in schema.features]


def _logarithms(probabilities: NDArray[np.float64]) -> NDArray[np.float64]:
    logarithms: NDArray[np.float64] = np.log(np.maximum(probabilities, _SMALLEST))
    return logarithms


def _vector(schema: SceneSchema, columns: Sequence[int]) -> FeatureVector:
    return tuple(tuple(own)[n] for own, n in zip(schema.features.values(), columns, strict=True))


def _features(
    schema: SceneSchema, tables: Sequence[NDArray[np.float64]], chosen: NDArray[np.intp]
) -> Iterator[dict[str, FeatureReading]]:
    """Yield the readings of every picture whose values' places are ``chosen``."""
    rows = np.arange(len(chosen))
    columns = []
    for own, places, literals in zip(tables, chosen.T, schema.features.values(), strict=True):
        values = tuple(literals)
        alone = own.argmax(axis=1)
        columns.append(
            [
                FeatureReading(values[n], p, (values[m], q) if q > p else None)
                for n, p, m, q in zip(
                    places.tolist(),
                    own[rows, places].tolist(),
                    alone.tolist(),
                    own[rows, alone].tolist(),
                    strict=True,
                )
            ]
        )
    for readings in zip(*columns, strict=True):
        yield dict(zip(schema.features, readings, strict=True))
