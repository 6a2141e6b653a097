"""Generalise candidate axioms: drop and widen what the evidence does not need."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from seewhy.induction.candidate import Candidate, explained_otherwise, is_borne_out, tally
from seewhy.induction.scene_table import SceneTable
from seewhy.induction.tree import PathCondition

__all__ = ["generalised", "most_general", "specialised"]

_ALL_SUBSETS = 10  # conditions of which all choices are tried; of more, one at a time is dropped


def specialised(
    candidate: Candidate, table: SceneTable, left: NDArray[np.int64], *, tolerance: float
) -> Candidate | None:
    """Add conditions until a candidate is right on all annotated scenes.

    A path is pure among the scenes that the knowledge left open; scenes that it decides may speak
    against it. The condition that keeps most of the candidate's own scenes for each wrong one
    that remains is added, one at a time.

    Returns
    -------
    Candidate or None
        None where no condition helps any more.

    Examples
    --------
    >>> from seewhy.induction.scene_table import scene_table
    >>> table = scene_table({"lean": ("yes", "no")}, [("no",), ("yes",)], ["up", "down"])
    >>> specialised(Candidate("up", ()), table, table.counts, tolerance=0.0)
    Candidate(label='up', conditions=(PathCondition(feature='lean', values=('no',)),))
    """
    while not is_borne_out(candidate, table, tolerance):
        narrower = _narrowed(candidate, table, left)
        if narrower is None:
            return None
        candidate = narrower
    return candidate


def _narrowed(candidate: Candidate, table: SceneTable, left: NDArray[np.int64]) -> Candidate | None:
    """The candidate with the best value demanded alone, or the worst one excluded."""
    spoken = table.satisfying(candidate.conditions)
    of_class = table.of_class(candidate.label)
    wrong = np.where(spoken, table.totals - of_class, 0) + explained_otherwise(candidate, table)[1]
    ours = np.where(spoken, left[:, table.classes.index(candidate.label)], 0)
    conditions = {condition.feature: condition.values for condition in candidate.conditions}
    best: tuple[float, str, tuple[str, ...]] | None = None
    for feature, values in table.features.items():
        allowed = conditions.get(feature, values)
        if len(allowed) < 2:
            continue
        showing = table.showing[feature]
        by_value = {
            value: (int(ours[showing[n]].sum()), int(wrong[showing[n]].sum()))
            for n, value in enumerate(values)
            if value in allowed
        }
        all_ours = sum(count for count, _ in by_value.values())
        all_wrong = sum(count for _, count in by_value.values())
        for value, (some, against) in by_value.items():
            others = tuple(other for other in allowed if other != value)
            for kept, right, rest in (
                ((value,), some, against),
                (others, all_ours - some, all_wrong - against),
            ):
                if not right or rest >= wrong.sum():
                    continue
                gain = right / ours.sum() - rest / wrong.sum()
                if best is None or gain > best[0]:
                    best = gain, feature, kept
    return None if best is None else _with(candidate, table, *best[1:])


def generalised(candidate: Candidate, table: SceneTable, *, tolerance: float) -> Candidate:
    """Drop every condition, and allow every value, that no annotated scene speaks against.

    Of the smallest sets of conditions that do, the one with most scenes is kept. A further value
    is allowed only where a scene with it speaks for the candidate.

    Examples
    --------
    >>> from seewhy.induction.scene_table import scene_table
    >>> table = scene_table({"base": ("wide", "narrow"), "lean": ("yes", "no")},
    ...                     [("wide", "no"), ("narrow", "no"), ("narrow", "yes")],
    ...                     ["up", "up", "down"])
    >>> path = (PathCondition("base", ("wide",)), PathCondition("lean", ("no",)))
    >>> generalised(Candidate("up", path), table, tolerance=0.0).conditions
    (PathCondition(feature='lean', values=('no',)),)
    """
    return _widened(_dropped(candidate, table, tolerance), table, tolerance)


def most_general(candidates: Sequence[Candidate]) -> list[Candidate]:
    """Return the candidates that no other covers, equal ones once, in their order.

    Examples
    --------
    >>> lean = PathCondition("lean", ("yes",))
    >>> most_general([Candidate("down", (lean, PathCondition("n", ("4",)))),
    ...               Candidate("down", (lean,))])
    [Candidate(label='down', conditions=(PathCondition(feature='lean', values=('yes',)),))]
    """
    once = list(dict.fromkeys(candidates))
    return [
        candidate
        for candidate in once
        if not any(other is not candidate and other.covers(candidate) for other in once)
    ]


def _with(
    candidate: Candidate, table: SceneTable, feature: str, values: tuple[str, ...]
) -> Candidate:
    """The candidate with these values of a feature allowed; with all of them, it is not asked."""
    conditions = {condition.feature: condition.values for condition in candidate.conditions}
    conditions[feature] = values
    return Candidate(
        candidate.label,
        tuple(
            PathCondition(name, tuple(value for value in all_values if value in conditions[name]))
            for name, all_values in table.features.items()
            if name in conditions and len(conditions[name]) < len(all_values)
        ),
    )


def _dropped(candidate: Candidate, table: SceneTable, tolerance: float) -> Candidate:
    conditions = candidate.conditions
    if len(conditions) > _ALL_SUBSETS:
        return _dropped_one_by_one(candidate, table, tolerance)
    for size in range(len(conditions)):
        fitting = [
            shorter
            for chosen in combinations(conditions, size)
            if is_borne_out(shorter := Candidate(candidate.label, chosen), table, tolerance)
        ]
        if fitting:
            return _most_borne_out(fitting, table)
    return candidate


def _most_borne_out(candidates: Sequence[Candidate], table: SceneTable) -> Candidate:
    """The candidate that most scenes speak for, the first of equals."""
    return max(candidates, key=lambda candidate: tally(candidate, table).right)


def _dropped_one_by_one(candidate: Candidate, table: SceneTable, tolerance: float) -> Candidate:
    while True:
        shorter = [
            Candidate(candidate.label, candidate.conditions[:n] + candidate.conditions[n + 1 :])
            for n in range(candidate.literals)
        ]
        fitting = [variant for variant in shorter if is_borne_out(variant, table, tolerance)]
        if not fitting:
            return candidate
        candidate = _most_borne_out(fitting, table)


def _widened(candidate: Candidate, table: SceneTable, tolerance: float) -> Candidate:
    for condition in candidate.conditions:
        for value in table.features[condition.feature]:
            allowed = {current.feature: current.values for current in candidate.conditions}.get(
                condition.feature
            )
            if allowed is None or value in allowed:
                continue
            wider = _with(candidate, table, condition.feature, (*allowed, value))
            more = tally(wider, table).right > tally(candidate, table).right
            if more and is_borne_out(wider, table, tolerance):
                candidate = wider
    return candidate
