"""Read pictures as what can be: the most probable feature vector among candidates."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from copy import copy
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from seewhy.agent.picture_reading import (
    SMALLEST,
    Other,
    Probabilities,
    Reading,
    feature_tables,
    features_of_places,
    logarithms_of,
    read_separately,
    vector_of_places,
)
from seewhy.agent.reading_weights import UNWEIGHTED, ReadingWeights
from seewhy.domain.tables import CLASS
from seewhy.knowledge.candidates import TRIED, decided_vectors, most_probable_decided
from seewhy.knowledge.reasoner import Reasoner, Verdict
from seewhy.knowledge.scene import FeatureVector

__all__ = ["LISTED", "ConsistentReading", "open_vectors"]

LISTED = 20_000
"""Where the knowledge decides more vectors than this, they are searched instead of listed."""

_AT_ONCE = 1 << 21  # (picture, candidate) pairs of one NumPy operation: 16 MiB


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
        See :func:`~seewhy.agent.fitting_reading_weights.fit_reading_weights`.
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
        places = [{value: n for n, value in enumerate(values)} for values in self._values]
        rows = [
            [place[value or ""] for place, value in zip(places, vector, strict=True)]
            for vector in dict.fromkeys((*(self._decided or ()), *self._open))
        ]
        return np.array(sorted(rows), dtype=np.intp).reshape(-1, len(places))

    @cached_property
    def _classes(self) -> NDArray[np.intp]:
        """The place of every listed candidate's class; beyond the last for one without."""
        places: dict[str | None, int] = {label: n for n, label in enumerate(self.schema.classes)}
        vectors = (vector_of_places(self.schema, row) for row in self._candidates.tolist())
        labels = (self.label_of(vector) for vector in vectors)
        return np.array([places.get(label, len(places)) for label in labels], dtype=np.intp)

    @cached_property
    def _shares(self) -> NDArray[np.float64]:
        """How probable each class, or none, is for each candidate: (candidates, classes + 1)."""
        places = {label: n for n, label in enumerate(self.schema.classes)}
        found = np.zeros((len(self._candidates), len(places) + 1))
        for row, (columns, place) in enumerate(
            zip(self._candidates.tolist(), self._classes.tolist(), strict=True)
        ):
            vector = vector_of_places(self.schema, columns)
            shares = self.shares_of(vector) if self.shares_of else {}
            for label, share in shares.items():
                found[row, places[label]] = share
            if not shares:
                found[row, place] = 1.0
        return found

    @cached_property
    def _values(self) -> list[tuple[str, ...]]:
        return [tuple(literals) for literals in self.schema.features.values()]

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
        tables = feature_tables(self.schema, probabilities)
        searched = self._decided is None
        if not searched and not len(self._candidates):
            return read_separately(self.schema, probabilities)
        logarithms = [logarithms_of(table) for table in tables]
        classes = self._class_scores(probabilities, len(tables[0]))
        seen = self._classes_seen(probabilities, len(tables[0]))
        pictures = len(tables[0])
        step = max(1, _AT_ONCE // max(1, len(self._candidates)))
        found: list[Reading] = []
        for start in range(0, pictures, step):
            part = [table[start : start + step] for table in logarithms]
            shown = [table[start : start + step] for table in tables]
            scored = classes[start : start + step]
            others: list[tuple[Other, ...]] = [()] * len(part[0])
            leaning: list[str | None] = [None] * len(part[0])
            if searched:
                best, scores, shares = self._search(part, scored)
            else:
                best, scores, shares, others, leaning = self._choose(part, scored, shown)
            features = features_of_places(self.schema, shown, best)
            found += [
                Reading(vector_of_places(self.schema, columns), *told)
                for columns, *told in zip(
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
            seen = logarithms_of(np.asarray(probabilities[CLASS], dtype=np.float64))
            relative = seen - seen.max(axis=1, keepdims=True)
            shown = [n for n, name in enumerate(self.schema.classes) if name in self.witnessed]
            scores[:, shown] = self.weights.witness * relative[:, shown]
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
        leaves = logarithms_of(self._shares[candidates, :-1])
        return class_scores[:, None, :-1] + leaves[None]

    def _probable(
        self, relative: NDArray[np.float64], class_scores: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Probabilities of the classes, and of none: shape (pictures, classes + 1)."""
        from seewhy.perception.matrix_product import matrix_product  # PyTorch comes with it

        mass = matrix_product(relative, self._shares) * np.exp(class_scores)
        found: NDArray[np.float64] = mass / np.maximum(mass.sum(axis=1, keepdims=True), SMALLEST)
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
        tables = feature_tables(self.schema, probabilities)
        weighted = self.weights.features * self._joint([logarithms_of(table) for table in tables])
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
        features = features_of_places(self.schema, [table[pictures] for table in tables], columns)
        found: list[list[Other]] = [[] for _ in probable]
        for picture, place, vector, readings in zip(
            pictures.tolist(), places.tolist(), columns.tolist(), features, strict=True
        ):
            probability = float(probable[picture, place])
            found[picture].append(
                Other(names[place], probability, vector_of_places(self.schema, vector), readings)
            )
        return [tuple(sorted(others, key=lambda other: -other.probability)) for others in found]

    def _joint(self, logarithms: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
        joint = np.zeros((len(logarithms[0]), len(self._candidates)))
        for table, column in zip(logarithms, self._candidates.T, strict=True):
            joint += table[:, column]
        return joint

    def _search(
        self, logarithms: Sequence[NDArray[np.float64]], class_scores: NDArray[np.float64]
    ) -> tuple[NDArray[np.intp], NDArray[np.float64], NDArray[np.float64]]:
        """The same for candidates that are not listed; without any, the separate reading."""
        best = np.stack([table.argmax(axis=1) for table in logarithms], axis=1)
        places = [{value: n for n, value in enumerate(values)} for values in self._values]
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
                [table[number] for table in logarithms],
                class_scores={label: score for label, score in scores if score},
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


def open_vectors(
    reasoner: Reasoner, experience: Mapping[FeatureVector, object]
) -> list[FeatureVector]:
    """Return the annotated vectors that the knowledge leaves open without contradiction."""
    vectors = list(experience)
    return [
        vector
        for vector, decision in zip(vectors, reasoner.decide_all(vectors), strict=True)
        if decision.verdict in (Verdict.SILENT, Verdict.SEVERAL)
    ]
