"""Heads trained anew after every label: on embeddings that are there, in less than a second."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from seewhy.perception.heads import Floats, Head, fit_head, fit_projection
from seewhy.perception.validation import folds

__all__ = ["HeldOutCounts", "QuickHeads"]

Targets = npt.NDArray[np.int64]

FOLDS = 3
"""So often a part of the labelled pictures is kept out, to see how well the rest recognise it."""


@dataclass(frozen=True)
class HeldOutCounts:
    """How pictures were recognised by heads that were not taught by them.

    Attributes
    ----------
    shown, right : tuple of int
        For each value: pictures that show it, and those of them that were recognised.
    """

    shown: tuple[int, ...]
    right: tuple[int, ...]


class QuickHeads:
    """A linear head a feature, of which only those are trained again whose labels changed.

    Parameters
    ----------
    pooled : ndarray of float, shape (n, width)
        What the backbone makes of the pictures.

    Examples
    --------
    >>> generator = np.random.default_rng(0)
    >>> heads = QuickHeads(np.repeat([[0.0, 1.0], [1.0, 0.0]], 5, axis=0)
    ...                    + generator.normal(0, 0.01, (10, 2)))
    >>> targets = np.array([0, -1, -1, -1, 0, 1, -1, -1, -1, 1])
    >>> heads.probabilities("colour", targets, values=2).argmax(axis=1).tolist()
    [0, 0, 0, 0, 0, 1, 1, 1, 1, 1]
    """

    def __init__(self, pooled: npt.NDArray[np.floating]) -> None:
        self.components: Floats = fit_projection(pooled)(pooled)
        self._known: dict[str, tuple[bytes, npt.NDArray[np.float32]]] = {}
        self._judged: dict[str, tuple[bytes, HeldOutCounts]] = {}

    def probabilities(
        self, feature: str, targets: Targets, *, values: int
    ) -> npt.NDArray[np.float32]:
        """The probability of each value in every picture, shape (n, values).

        Parameters
        ----------
        feature : str
        targets : ndarray of int, shape (n,)
            The index of each picture's value, -1 where nobody said it.
        values : int
        """
        key = targets.tobytes()
        known = self._known.get(feature)
        if known is None or known[0] != key:
            known = self._known[feature] = (key, self._seen(targets, values))
        return known[1]

    def _seen(self, targets: Targets, values: int) -> npt.NDArray[np.float32]:
        rows = np.flatnonzero(targets >= 0)
        if len(np.unique(targets[rows])) < 2:
            # Nothing is told apart yet: a head would be sure of the one value that it knows.
            return np.full((len(targets), values), 1 / values, dtype=np.float32)
        return _shares(_taught(self.components[rows], targets[rows], values)(self.components))

    def held_out(self, feature: str, targets: Targets, *, values: int) -> HeldOutCounts:
        """How well the values are recognised in pictures that were kept out; quick, and rough."""
        key = targets.tobytes()
        known = self._judged.get(feature)
        if known is None or known[0] != key:
            known = self._judged[feature] = (key, self._judge(targets, values))
        return known[1]

    def _judge(self, targets: Targets, values: int) -> HeldOutCounts:
        rows = np.flatnonzero(targets >= 0)
        right = np.zeros(values, dtype=np.int64)
        if len(np.unique(targets[rows])) > 1:
            for part in folds(targets[rows].tolist(), count=FOLDS, seed=0):
                away = np.isin(np.arange(len(rows)), part)
                taught = rows[~away]
                if len(np.unique(targets[taught])) < 2:
                    continue
                head = _taught(self.components[taught], targets[taught], values)
                seen = head(self.components[rows[away]]).argmax(axis=1)
                hit = targets[rows[away]][seen == targets[rows[away]]]
                right += np.bincount(hit, minlength=values)
        shown = np.bincount(targets[rows], minlength=values)
        return HeldOutCounts(tuple(shown.tolist()), tuple(right.tolist()))


def _taught(components: Floats, targets: Targets, values: int) -> Head:
    return fit_head(components, targets, values=values)


def _shares(logits: Floats) -> npt.NDArray[np.float32]:
    weights = np.exp(logits - logits.max(axis=1, keepdims=True))
    shares: npt.NDArray[np.float32] = weights / weights.sum(axis=1, keepdims=True)
    return shares
