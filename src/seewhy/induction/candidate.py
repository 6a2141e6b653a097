"""Candidate axioms: what a path of the tree proposes, in feature values."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import comb

import numpy as np
from numpy.typing import NDArray

from seewhy.induction.binomial import at_least
from seewhy.induction.scene_table import Rows, SceneTable
from seewhy.induction.tree import PathCondition

_IMPLAUSIBLE = 0.01  # errors that are less likely than this are no errors of annotation


@dataclass(frozen=True)
class Candidate:
    """Scenes whose features have certain values are of a class.

    Attributes
    ----------
    label : str
    conditions : tuple of PathCondition
        In the order of the features; the values in the order of the feature's.

    Examples
    --------
    >>> general = Candidate("down", (PathCondition("lean", ("yes",)),))
    >>> special = Candidate("down", (PathCondition("lean", ("yes",)), PathCondition("n", ("4",))))
    >>> general.covers(special), special.covers(general)
    (True, False)
    """

    label: str
    conditions: tuple[PathCondition, ...]

    def covers(self, other: Candidate) -> bool:
        """Whether every scene that ``other`` speaks about is spoken about by this one too."""
        theirs = {condition.feature: frozenset(condition.values) for condition in other.conditions}
        return self.label == other.label and all(
            condition.feature in theirs and theirs[condition.feature] <= frozenset(condition.values)
            for condition in self.conditions
        )

    @property
    def literals(self) -> int:
        """How many feature values must be looked at."""
        return len(self.conditions)


@dataclass(frozen=True)
class Tally:
    """How the annotated scenes bear a candidate out.

    ``left`` counts the scenes among those that are right which the knowledge left open or got
    wrong.
    """

    right: int
    wrong: int
    left: int

    @property
    def precision(self) -> float:
        """The share of the scenes spoken about that are of the class; 1 where there is none."""
        return self.right / (self.right + self.wrong) if self.right + self.wrong else 1.0


def tally(candidate: Candidate, table: SceneTable, left: NDArray[np.int64] | None = None) -> Tally:
    """Count the scenes that speak for and against a candidate.

    ``left`` counts, for every row and class of the table, the scenes that the knowledge left open
    or got wrong; without it they are all.
    """
    rows = table.satisfying(candidate.conditions)
    of_class = table.of_class(candidate.label)
    right = int(of_class[rows].sum())
    wrong = int(table.totals[rows].sum()) - right
    if left is None or candidate.label not in table.classes:
        return Tally(right, wrong, right)
    return Tally(right, wrong, int(left[rows, table.classes.index(candidate.label)].sum()))


def is_borne_out(candidate: Candidate, table: SceneTable, tolerance: float) -> bool:
    """Whether all scenes that a candidate speaks about are of its class, and for its reasons.

    Where somebody said why scenes are of the class, all features that the candidate asks have to
    be among the reasons: whoever says why names what every rule asks that applies.

    With a ``tolerance`` above 0, that share of the annotation is taken to be wrong: what speaks
    against the candidate must be few enough to be such errors, in all and for every feature
    vector, or a large number of scenes that fit would hide a kind of scene that does not.

    Examples
    --------
    >>> from seewhy.induction.scene_table import scene_table
    >>> vectors = [("no",)] * 20 + [("yes",)] * 3
    >>> table = scene_table({"lean": ("yes", "no")}, vectors, ["up"] * 19 + ["down"] * 4)
    >>> straight = Candidate("up", (PathCondition("lean", ("no",)),))
    >>> is_borne_out(straight, table, 0.0), is_borne_out(straight, table, 0.05)
    (False, True)
    >>> is_borne_out(Candidate("up", ()), table, 0.05)
    False
    """
    rows = table.satisfying(candidate.conditions)
    if speaks_against(table, candidate.label, tolerance)[rows].any():
        return False
    if len(table.explanations.rows):
        explained, otherwise = explained_otherwise(candidate, table)
        if _beyond_errors(otherwise, explained, tolerance).any() or _beyond_errors(
            otherwise.sum(), explained.sum(), tolerance
        ):
            return False
    if tolerance == 0.0:
        return True
    scenes = table.totals[rows].sum()
    return not _beyond_errors(
        scenes - table.of_class(candidate.label)[rows].sum(), scenes, tolerance
    )


def explained_otherwise(
    candidate: Candidate, table: SceneTable
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Count, row by row, explained scenes that bear a candidate out; and those for other reasons.

    Examples
    --------
    >>> from seewhy.induction.scene_table import scene_table
    >>> table = scene_table({"lean": ("yes", "no"), "base": ("wide", "narrow")},
    ...                     [("no", "wide"), ("no", "narrow")], ["up", "up"],
    ...                     reasons=[frozenset({"lean"}), None])
    >>> wide = Candidate("up", (PathCondition("base", ("wide",)),))
    >>> [counts.tolist() for counts in explained_otherwise(wide, table)]
    [[1, 0], [1, 0]]
    """
    said = table.explanations
    asked = [list(table.features).index(condition.feature) for condition in candidate.conditions]
    place = table.classes.index(candidate.label) if candidate.label in table.classes else -1
    ours = table.satisfying(candidate.conditions)[said.rows] & (said.classes == place)
    lacking = ours & ~said.named[:, asked].all(axis=1)
    explained, otherwise = (
        np.bincount(said.rows, weights=said.counts * some, minlength=len(table.vectors))
        for some in (ours, lacking)
    )
    return explained.astype(np.int64), otherwise.astype(np.int64)


def _beyond_errors(
    wrong: NDArray[np.int64], scenes: NDArray[np.int64], tolerance: float
) -> NDArray[np.bool_]:
    """Whether more of some scenes are annotated wrongly than errors of annotation explain."""
    if tolerance == 0.0:
        return np.asarray(wrong > 0)
    return np.asarray(at_least(wrong, scenes, tolerance) < _IMPLAUSIBLE)


@lru_cache(maxsize=256)
def speaks_against(table: SceneTable, label: str, tolerance: float) -> Rows:
    """The rows with more scenes of other classes than errors of annotation explain."""
    wrong = table.totals - table.of_class(label)
    return _beyond_errors(wrong, table.totals, tolerance)


def settled(table: SceneTable, tolerance: float) -> Rows:
    """Return the rows whose scenes are all of one class, but for errors of annotation.

    Examples
    --------
    >>> from seewhy.induction.scene_table import scene_table
    >>> table = scene_table({"lean": ("yes", "no")}, [("no",), ("yes",), ("no",)],
    ...                     ["up", "down", "down"])
    >>> settled(table, 0.0).tolist()
    [False, True]
    """
    wrong = table.totals - table.counts.max(axis=1, initial=0)
    return ~_beyond_errors(wrong, table.totals, tolerance)


def chance(
    candidate: Candidate, table: SceneTable, found: Tally, *, searched: bool = True
) -> float:
    """How likely a candidate would fit so well if features said nothing of the class.

    The probability that at least as many of the scenes spoken about are of the class, times the
    number of axioms about as many features that could have been tried (Bonferroni), so that the
    bound holds for all of them together; not times it where nothing was ``searched``, since
    somebody named the features. Source: none; the paper asks for support alone.

    Examples
    --------
    >>> from seewhy.induction.scene_table import scene_table
    >>> table = scene_table({"lean": ("yes", "no")}, [("no",), ("yes",)] * 10, ["up", "down"] * 10)
    >>> rule = Candidate("up", (PathCondition("lean", ("no",)),))
    >>> f"{chance(rule, table, tally(rule, table)):.4f}"
    '0.0020'
    """
    share = table.of_class(candidate.label).sum() / max(1, table.totals.sum())
    alone = float(at_least(found.right, found.right + found.wrong, share))
    if not searched:
        return alone
    tried = float(
        np.prod([len(table.features[condition.feature]) for condition in candidate.conditions])
    )
    return min(1.0, alone * tried * comb(len(table.features), candidate.literals))
