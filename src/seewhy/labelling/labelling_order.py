"""In which order to label pictures: those first of which one label is worth most.

A label is worth much where the heads are unsure, where the picture is unlike all that is labelled,
and where it is typical of many others: one picture of its kind stands for them. The three are
multiplied, the last by its square root. Pictures are taken one after the other, each counting as
labelled for the next, so that no two of the first are alike.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

__all__ = ["Landscape", "WorthLabelling", "labelling_order", "landscape"]

NEIGHBOURS = 20
"""Pictures to which a picture's likeness says how typical it is."""

SAMPLE = 2000
"""Pictures among which neighbours are looked for, where there are more."""

DISPUTED = 0.5
"""The share of certainty that a picture loses of which the rules say another class."""

SHARPNESS = 3
"""Heads of few labels are timid: who is unsure is seen in the power of their probabilities."""

_FLOOR = 1e-3  # nothing is worth so little that the other two cannot say anything

Floats = npt.NDArray[np.float32]
Probabilities = Mapping[str, npt.NDArray[np.floating]]


@dataclass(frozen=True, eq=False)
class Landscape:
    """Where pictures lie among each other; no label has a say in it.

    Attributes
    ----------
    directions : ndarray of float, shape (n, components)
        What heads look at, each row of length 1.
    typical : ndarray of float, shape (n,)
        How like a picture is to its nearest neighbours, from 0 to 1.
    """

    directions: Floats
    typical: Floats


@dataclass(frozen=True)
class WorthLabelling:
    """A picture that is not labelled yet, and why it is worth a label.

    Attributes
    ----------
    place : int
        Its row.
    worth : float
        From 0 to 1; only its order means something.
    unsure : float
        How unsure the heads are: 0 sure, 1 undecided between the two most probable values.
    unlike : float
        0 like a labelled picture, 1 like none.
    disputed : bool
        Whether rules and heads say different classes.
    """

    place: int
    worth: float
    unsure: float
    unlike: float
    disputed: bool = False


def landscape(components: Floats, *, seed: int = 0) -> Landscape:
    """Return where pictures lie among each other.

    Parameters
    ----------
    components : ndarray of float, shape (n, components)
        As :class:`~seewhy.perception.heads.Projection` makes them.
    seed : int
        Chooses the pictures that stand for all, where there are many.

    Examples
    --------
    >>> found = landscape(np.array([[1, 0], [1, 0.1], [0, 1]], dtype=np.float32))
    >>> found.typical.round(1).tolist()
    [0.5, 0.5, 0.0]
    """
    lengths = np.linalg.norm(components, axis=1, keepdims=True)
    directions = (components / np.maximum(lengths, 1e-9)).astype(np.float32)
    count = len(directions)
    chosen = np.random.default_rng(seed).permutation(count)[:SAMPLE]
    others = min(NEIGHBOURS, len(chosen) - 1)
    if others < 1:
        return Landscape(directions, np.ones(count, dtype=np.float32))
    typical = np.empty(count, dtype=np.float32)
    for start in range(0, count, SAMPLE):
        rows = np.arange(start, min(start + SAMPLE, count))
        likeness = directions[rows] @ directions[chosen].T
        likeness[rows[:, None] == chosen[None, :]] = -np.inf
        nearest = -np.partition(-likeness, others - 1, axis=1)[:, :others]
        typical[rows] = nearest.mean(axis=1)
    return Landscape(directions, np.clip(typical, _FLOOR, 1.0))


def labelling_order(
    pictures: Landscape,
    probabilities: Probabilities,
    labelled: Sequence[int] | npt.NDArray[np.integer],
    *,
    count: int = 20,
    disputed: npt.NDArray[np.bool_] | None = None,
    without: Collection[int] = (),
) -> list[WorthLabelling]:
    """Return the pictures to be labelled next, the one that is worth most first.

    Parameters
    ----------
    pictures : Landscape
    probabilities : mapping of str to ndarray of float, shape (n, values)
        What heads make of every picture, feature by feature; empty before there are heads.
    labelled : sequence of int
        Rows that are labelled.
    count : int
        So many at most.
    disputed : ndarray of bool, shape (n,), optional
        Where rules and heads say different classes.
    without : collection of int
        Rows that are not to be proposed.

    Examples
    --------
    >>> components = np.array([[1, 0], [1, 0.1], [0.1, 1]], dtype=np.float32)
    >>> order = labelling_order(landscape(components), {}, [0], count=2)
    >>> [found.place for found in order]
    [2, 1]
    """
    total = len(pictures.directions)
    known = np.zeros(total, dtype=bool)
    known[np.asarray(labelled, dtype=np.int64)] = True
    free = np.flatnonzero(~known & ~np.isin(np.arange(total), list(without)))
    if not len(free):
        return []
    directions = pictures.directions[free]
    unsure = _unsure(probabilities, free)
    quarrel = np.zeros(len(free), dtype=bool) if disputed is None else disputed[free]
    unsure = np.where(quarrel, 1 - (1 - unsure) * DISPUTED, unsure)
    nearest = np.zeros(len(free), dtype=np.float32)
    if known.any():
        nearest = (directions @ pictures.directions[known].T).max(axis=1)
    worth = np.maximum(unsure, _FLOOR) * np.sqrt(pictures.typical[free])
    left = np.ones(len(free), dtype=bool)
    found: list[WorthLabelling] = []
    for _ in range(min(count, len(free))):
        unlike = np.clip(1 - nearest, _FLOOR, 1.0)
        here = int(np.argmax(np.where(left, worth * unlike, -1.0)))
        left[here] = False
        found.append(
            WorthLabelling(
                int(free[here]),
                float(worth[here] * unlike[here]),
                float(unsure[here]),
                float(unlike[here]),
                bool(quarrel[here]),
            )
        )
        nearest = np.maximum(nearest, directions @ directions[here])
    return found


def _unsure(probabilities: Probabilities, rows: npt.NDArray[np.int64]) -> npt.NDArray[np.float64]:
    """How near the two most probable values of a feature are, as a mean over the features."""
    found = []
    for table in probabilities.values():
        if table.shape[1] < 2:
            continue
        sharp = table[rows] ** SHARPNESS
        highest = np.sort(sharp / sharp.sum(axis=1, keepdims=True), axis=1)[:, -2:]
        found.append(1 - (highest[:, 1] - highest[:, 0]))
    return np.mean(found, axis=0) if found else np.ones(len(rows))
