"""Annotated scenes as a table: equal scenes are one row with a count for each class."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from seewhy.induction.tree import PathCondition
from seewhy.knowledge.scene import FeatureVector

UNKNOWN = -1

Reasons = frozenset[str]
"""The features that somebody names as the reasons for a scene's class."""

Rows = NDArray[np.bool_]
"""Which rows of a table are meant, shape (rows,)."""


@dataclass(frozen=True, eq=False)
class Explanations:
    """Why scenes are of their class, as somebody said: equal ones about equal scenes are one.

    Attributes
    ----------
    rows, classes : ndarray of int, shape (explanations,)
        The row of the table, and the place of the class.
    named : ndarray of bool, shape (explanations, features)
        Which features are the reasons.
    counts : ndarray of int, shape (explanations,)
        Of how many scenes this was said.
    """

    rows: NDArray[np.int64]
    classes: NDArray[np.int64]
    named: NDArray[np.bool_]
    counts: NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class SceneTable:
    """Annotated scenes, equal feature vectors put together; a table equals itself alone.

    Attributes
    ----------
    features : mapping of str to tuple of str
        Feature → its values; a value's place is its code.
    classes : tuple of str
    vectors : tuple of FeatureVector, length rows
    codes : ndarray of int, shape (rows, features)
        The places of the values; -1 where a value is not known.
    counts : ndarray of int, shape (rows, classes)
        How many scenes of each class look like this.
    scenes : tuple of tuple of int, length rows
        The positions of these scenes among those that the table was made of.
    explanations : Explanations
        What somebody said of why they are of their class.

    Examples
    --------
    >>> table = scene_table({"lean": ("yes", "no")}, [("no",), ("yes",), ("no",)],
    ...                     ["up", "down", "up"])
    >>> table.vectors, table.counts.tolist(), table.scenes
    ((('no',), ('yes',)), [[0, 2], [1, 0]], ((0, 2), (1,)))
    """

    features: Mapping[str, tuple[str, ...]]
    classes: tuple[str, ...]
    vectors: tuple[FeatureVector, ...]
    codes: NDArray[np.int64]
    counts: NDArray[np.int64]
    scenes: tuple[tuple[int, ...], ...]
    explanations: Explanations

    def satisfying(self, conditions: Sequence[PathCondition]) -> Rows:
        """Return which rows satisfy all conditions; a value that is not known satisfies none.

        Examples
        --------
        >>> table = scene_table({"lean": ("yes", "no")}, [("no",), (None,)], ["up", "up"])
        >>> table.satisfying([PathCondition("lean", ("yes", "no"))]).tolist()
        [True, False]
        """
        rows = np.ones(len(self.vectors), dtype=bool)
        for condition in conditions:
            rows &= self._allows(condition)
        return rows

    def _allows(self, condition: PathCondition) -> Rows:
        values = self.features[condition.feature]
        chosen = [values.index(value) for value in condition.values]
        return np.asarray(self.showing[condition.feature][chosen].any(axis=0))

    @cached_property
    def showing(self) -> dict[str, NDArray[np.bool_]]:
        """Feature → which rows show each of its values, shape (values, rows)."""
        return {
            feature: self.codes[:, column] == np.arange(len(values))[:, None]
            for column, (feature, values) in enumerate(self.features.items())
        }

    def of_class(self, label: str) -> NDArray[np.int64]:
        """Return how many scenes of a class each row stands for."""
        if label not in self.classes:
            return np.zeros(len(self.vectors), dtype=np.int64)
        counts: NDArray[np.int64] = self.counts[:, self.classes.index(label)]
        return counts

    @cached_property
    def explained(self) -> NDArray[np.int64]:
        """Of how many scenes of each row and class somebody said why: shape (rows, classes)."""
        found = np.zeros_like(self.counts)
        said = self.explanations
        np.add.at(found, (said.rows, said.classes), said.counts)
        return found

    @cached_property
    def totals(self) -> NDArray[np.int64]:
        """How many scenes each row stands for."""
        totals: NDArray[np.int64] = self.counts.sum(axis=1)
        return totals


def scene_table(
    features: Mapping[str, Sequence[str]],
    vectors: Sequence[FeatureVector],
    labels: Sequence[str],
    *,
    reasons: Sequence[Reasons | None] = (),
) -> SceneTable:
    """Make a table of annotated scenes, rows in the order of their first scene.

    ``reasons`` has the features that are why a scene is of its class, None where nobody said so;
    it may be left out.

    Examples
    --------
    >>> table = scene_table({"lean": ("yes", "no"), "base": ("wide", "narrow")},
    ...                     [("no", "wide")], ["up"], reasons=[frozenset({"lean"})])
    >>> table.explained.tolist(), table.explanations.named.tolist()
    ([[1]], [[True, False]])
    """
    values = {name: tuple(possible) for name, possible in features.items()}
    places = [{value: n for n, value in enumerate(possible)} for possible in values.values()]
    classes = tuple(sorted(set(labels)))
    numbers = {label: n for n, label in enumerate(classes)}
    found: dict[FeatureVector, list[int]] = {}
    for position, vector in enumerate(vectors):
        found.setdefault(tuple(vector), []).append(position)
    codes = np.full((len(found), len(values)), UNKNOWN, dtype=np.int64)
    counts = np.zeros((len(found), len(classes)), dtype=np.int64)
    for row, (vector, positions) in enumerate(found.items()):
        codes[row] = [
            UNKNOWN if value is None else place[value]
            for place, value in zip(places, vector, strict=True)
        ]
        np.add.at(counts[row], [numbers[labels[n]] for n in positions], 1)
    said: Counter[tuple[int, int, Reasons]] = Counter()
    for row, positions in enumerate(found.values()) if any(reasons) else ():
        said.update((row, numbers[labels[n]], reason) for n in positions if (reason := reasons[n]))
    return SceneTable(
        values,
        classes,
        tuple(found),
        codes,
        counts,
        tuple(map(tuple, found.values())),
        Explanations(
            np.array([row for row, _, _ in said], dtype=np.int64),
            np.array([place for _, place, _ in said], dtype=np.int64),
            np.array(
                [[feature in reason for feature in values] for _, _, reason in said], dtype=bool
            ).reshape(len(said), len(values)),
            np.array(list(said.values()), dtype=np.int64),
        ),
    )
