"""Which pictures are kept for validation."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from seewhy.perception.labelled_pictures import LabelledPictures

__all__ = ["clearly_better", "divided", "folds", "split"]


def divided(
    shown: LabelledPictures,
    rows: npt.NDArray[np.int64],
    labels: Sequence[object],
    *,
    share: float,
    seed: int,
) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """Divide some of the pictures as they say themselves, or else as :func:`split` does.

    Parameters
    ----------
    shown : LabelledPictures
    rows : ndarray of int64
        Which of them.
    labels : sequence, of the length of ``rows``
    share, seed
        As for :func:`split`.

    Returns
    -------
    train, validation : ndarray of int64
        Places in ``rows``, ascending.

    Examples
    --------
    >>> shown = LabelledPictures(np.zeros((3, 8, 8, 3)), {}, {}, validation=np.array([2]))
    >>> divided(shown, np.array([0, 2]), ["a", "b"], share=0.2, seed=0)
    (array([0]), array([1]))
    """
    if shown.validation is not None:
        away = np.isin(rows, shown.validation)
        return np.flatnonzero(~away), np.flatnonzero(away)
    groups = None if shown.groups is None else [shown.groups[row] for row in rows]
    return split(labels, share=share, seed=seed, groups=groups)


def split(
    labels: Sequence[object],
    *,
    share: float,
    seed: int,
    groups: Sequence[object] | None = None,
) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """Divide pictures into those to train on and those to validate on.

    Every label gives its share, groups stay whole, and every label keeps at least one group for
    training: what scikit-learn's splitters refuse (a label that occurs once) is common in sets
    of a few dozen pictures.

    Parameters
    ----------
    labels : sequence, length n
        What to stratify by.
    share : float
        Share for validation, 0..0.5.
    seed : int
        Another seed, another split.
    groups : sequence, length n, optional
        Group of each picture; without it every picture is a group.

    Returns
    -------
    train, validation : ndarray of int64
        Indices, ascending.

    Examples
    --------
    >>> train, validation = split(["a"] * 8 + ["b"] * 4, share=0.25, seed=0)
    >>> len(train), len(validation)
    (9, 3)
    """
    members: dict[object, list[int]] = {}
    for i, group in enumerate(range(len(labels)) if groups is None else groups):
        members.setdefault(group, []).append(i)
    # A group stands for its most frequent label (the first of equals).
    by_label: dict[object, list[list[int]]] = {}
    for indices in members.values():
        group_labels = [labels[i] for i in indices]
        by_label.setdefault(max(group_labels, key=group_labels.count), []).append(indices)

    rng = np.random.default_rng(seed)
    validation: list[int] = []
    for label in sorted(by_label, key=str):
        candidates = by_label[label]
        wanted = share * sum(len(indices) for indices in candidates)
        taken = 0
        for position in rng.permutation(len(candidates))[1:]:  # the first stays for training
            indices = candidates[position]
            # Take a group when that brings the count nearer to what is wanted.
            if taken + len(indices) / 2 <= wanted:
                validation += indices
                taken += len(indices)
    inside = np.zeros(len(labels), dtype=bool)
    inside[validation] = True
    return np.flatnonzero(~inside), np.flatnonzero(inside)


def folds(
    labels: Sequence[object],
    *,
    count: int,
    seed: int,
    groups: Sequence[object] | None = None,
) -> list[npt.NDArray[np.int64]]:
    """Divide pictures into ``count`` parts, each with its share of every label, groups whole.

    Parameters
    ----------
    labels : sequence, length n
        What to stratify by.
    count : int
        Parts; fewer come back where there are fewer groups.
    seed : int
        Another seed, other parts.
    groups : sequence, length n, optional
        Group of each picture; without it every picture is a group.

    Returns
    -------
    list of ndarray of int64
        Indices, ascending; every picture is in one part.

    Examples
    --------
    >>> [len(part) for part in folds(["a"] * 6 + ["b"] * 3, count=3, seed=0)]
    [3, 3, 3]
    """
    members: dict[object, list[int]] = {}
    for i, group in enumerate(range(len(labels)) if groups is None else groups):
        members.setdefault(group, []).append(i)
    generator = np.random.default_rng(seed)
    names = list(members)
    order = [names[n] for n in generator.permutation(len(names))]
    # The largest groups first: what comes later evens out what they left uneven.
    order.sort(key=lambda group: -len(members[group]))
    parts: list[list[int]] = [[] for _ in range(min(count, len(order)))]
    of_label: list[dict[object, int]] = [{} for _ in parts]
    for group in order:
        shown = [labels[i] for i in members[group]]

        def filled(n: int, shown: list[object] = shown) -> tuple[int, int]:
            return sum(of_label[n].get(label, 0) for label in shown), len(parts[n])

        part = min(range(len(parts)), key=filled)
        parts[part] += members[group]
        for label in shown:
            of_label[part][label] = of_label[part].get(label, 0) + 1
    return [np.array(sorted(part), dtype=np.int64) for part in parts]


def clearly_better(accuracy: float, *, than: float, pictures: int) -> bool:
    """Whether one accuracy beats another by more than its standard error.

    Of a few validation pictures, some pass of training gets more right by luck than the last one,
    whose small steps usually end where it is best.

    Examples
    --------
    >>> clearly_better(0.85, than=0.77, pictures=13)
    False
    >>> clearly_better(0.85, than=0.77, pictures=130)
    True
    """
    return accuracy - than > math.sqrt(than * (1.0 - than) / pictures)
