"""Candidate axioms from scenes of which somebody said why they are of their class."""

from __future__ import annotations

from collections import Counter

import numpy as np
from numpy.typing import NDArray

from seewhy.induction.candidate import Candidate, is_borne_out, speaks_against
from seewhy.induction.scene_table import UNKNOWN, SceneTable
from seewhy.induction.tree import PathCondition

__all__ = ["explained_candidates"]


def explained_candidates(
    table: SceneTable, left: NDArray[np.int64], *, tolerance: float
) -> list[tuple[Candidate, Candidate]]:
    """What the explanations of scenes that are left propose.

    A scene's values of the features that are named as its reasons are a candidate. Further values
    are allowed where a scene with them is explained by the same features, and none speaks against
    it. No condition is dropped: whoever said why takes it to matter.

    Parameters
    ----------
    table : SceneTable
    left : ndarray of int, shape (rows, classes)
        The scenes that the knowledge left open or got wrong.
    tolerance : float
        See :class:`~seewhy.induction.axiom_learning.LearningOptions`.

    Returns
    -------
    list of (Candidate, Candidate)
        As the explanation has it, and with all values allowed that may be. Those with the fewest
        features first, then those with most scenes: where several rules apply to a scene, the
        features of all are named, and the rules by themselves explain it once they are known.

    Notes
    -----
    Departure from the paper, which learns axioms from features and classes alone; its recurrent
    network learns from annotated answers, which say why as well. Source of the idea: Michalski
    (1969), whose AQ grows a rule around one example; Zaidan, Eisner and Piatko (2007), who let
    annotators mark their reasons.

    Examples
    --------
    >>> from seewhy.induction.scene_table import scene_table
    >>> table = scene_table({"n": ("1", "2", "3"), "lean": ("yes", "no")},
    ...                     [("1", "no"), ("2", "no"), ("3", "no")], ["up", "up", "down"],
    ...                     reasons=[frozenset({"n"}), frozenset({"n"}), None])
    >>> for seed, grown in explained_candidates(table, table.counts, tolerance=0.0):
    ...     print(seed.conditions[0].values, grown.conditions[0].values)
    ('1',) ('1', '2')
    ('2',) ('1', '2')
    """
    seeds: Counter[Candidate] = Counter()
    features, said = list(table.features), table.explanations
    for n, (row, place) in enumerate(zip(said.rows.tolist(), said.classes.tolist(), strict=True)):
        named = np.flatnonzero(said.named[n]).tolist()
        label, vector = table.classes[place], table.vectors[row]
        if (
            not left[row, place]
            or speaks_against(table, label, tolerance)[row]
            or any(table.codes[row, column] == UNKNOWN for column in named)
        ):
            continue
        conditions = tuple(
            PathCondition(features[column], (str(vector[column]),)) for column in named
        )
        seeds[Candidate(label, conditions)] += int(said.counts[n])
    ordered = sorted(seeds, key=lambda seed: (seed.literals, -seeds[seed]))
    return [(seed, _widened(seed, table, tolerance)) for seed in ordered]


def _widened(candidate: Candidate, table: SceneTable, tolerance: float) -> Candidate:
    if not is_borne_out(candidate, table, tolerance):
        return candidate
    said = table.explanations
    asked = {condition.feature for condition in candidate.conditions}
    alike = (said.classes == table.classes.index(candidate.label)) & (
        said.named == [feature in asked for feature in table.features]
    ).all(axis=1)
    for number, condition in enumerate(candidate.conditions):
        values = table.features[condition.feature]
        for value in values:
            allowed = candidate.conditions[number].values
            if value in allowed or len(allowed) + 2 > len(values):
                continue
            wider = tuple(member for member in values if member in allowed or member == value)
            conditions = list(candidate.conditions)
            conditions[number] = PathCondition(condition.feature, wider)
            grown = Candidate(candidate.label, tuple(conditions))
            new = table.satisfying(grown.conditions) & ~table.satisfying(candidate.conditions)
            if new[said.rows[alike]].any() and is_borne_out(grown, table, tolerance):
                candidate = grown
    return candidate
