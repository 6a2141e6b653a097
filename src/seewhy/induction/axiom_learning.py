"""Learn axioms from annotated scenes: the fourth component of the architecture."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from math import ceil

import numpy as np
from numpy.typing import NDArray

from seewhy.induction.binomial import at_least
from seewhy.induction.candidate import (
    Candidate,
    Tally,
    chance,
    explained_otherwise,
    is_borne_out,
    settled,
    tally,
)
from seewhy.induction.explained import explained_candidates
from seewhy.induction.generalisation import generalised, most_general, specialised
from seewhy.induction.scene_table import Reasons, SceneTable, scene_table
from seewhy.induction.tree import DecisionTree
from seewhy.knowledge.reasoner import Decision, Verdict
from seewhy.knowledge.scene import FeatureVector

__all__ = [
    "DEFAULTS",
    "Fate",
    "Judgement",
    "Learned",
    "LearningOptions",
    "decide_by_candidates",
    "learn_axioms",
]

BY_CHANCE = 0.01
"""A candidate that would fit by chance more often than this is not proposed."""

ENOUGH_EXPLAINED = 2
"""So many scenes whose explanation names all that a candidate asks are no accident.

If none is otherwise, that is. One may be a slip; asking for more than chance of these as well
leaves rare rules out that an expert has stated twice.
"""

_MOST_ROUNDS = 100

Decide = Callable[[Sequence[Candidate], Sequence[FeatureVector]], Sequence[Decision]]
"""The decisions about feature vectors of the knowledge with some candidates added."""


class Fate(StrEnum):
    """What became of a candidate."""

    ACCEPTED = "accepted"
    MERGED = "merged"
    DROPPED = "dropped"
    REJECTED = "rejected"


@dataclass(frozen=True)
class Judgement:
    """A candidate, what became of it, and why.

    ``path`` is what the tree, or the explanation of a scene, proposed; ``candidate`` what
    generalisation made of it.
    """

    path: Candidate
    candidate: Candidate
    tally: Tally
    fate: Fate
    reason: str


@dataclass(frozen=True)
class Learned:
    """What came of learning.

    Attributes
    ----------
    accepted : tuple of Judgement
        The candidates that became axioms, in the order in which they were accepted.
    judgements : tuple of Judgement
        All candidates.
    tree : DecisionTree
        The tree of the first round; unfitted where the knowledge decides all scenes, or those
        that it leaves open are explained.
    accepted_leaves : frozenset of int
        The places, among the tree's paths, of those that accepted axioms come from or cover.
    """

    accepted: tuple[Judgement, ...]
    judgements: tuple[Judgement, ...]
    tree: DecisionTree
    accepted_leaves: frozenset[int]


@dataclass(frozen=True)
class LearningOptions:
    """How much evidence an axiom needs.

    Attributes
    ----------
    support : float, default 0.1
        The least share, of the scenes that the knowledge left open or got wrong, that an axiom
        must speak about; or twice that share of those of its class, where that is less.
    validation : float, default 0.1
        The share of all scenes that is drawn, among those that an axiom speaks about, to see
        whether it is right with the knowledge around it.
    tolerance : float, default 0
        The share of the annotation that is taken to be wrong.
    seed : int, default 0
    """

    support: float = 0.1
    validation: float = 0.1
    tolerance: float = 0.0
    seed: int = 0


DEFAULTS = LearningOptions()


def decide_by_candidates(features: Mapping[str, Sequence[str]]) -> Decide:
    """Return how candidates decide where there is no other knowledge.

    A scene is of a class if all candidates that speak about it agree.

    Examples
    --------
    >>> from seewhy.induction.tree import PathCondition
    >>> decide = decide_by_candidates({"lean": ("yes", "no")})
    >>> leaning = Candidate("down", (PathCondition("lean", ("yes",)),))
    >>> [decision.label for decision in decide([leaning], [("yes",), ("no",)])]
    ['down', None]
    """

    def decide(candidates: Sequence[Candidate], vectors: Sequence[FeatureVector]) -> list[Decision]:
        table = scene_table(features, vectors, ["?"] * len(vectors))
        classes: list[set[str]] = [set() for _ in table.vectors]
        for candidate in candidates:
            for row in np.flatnonzero(table.satisfying(candidate.conditions)):
                classes[row].add(candidate.label)
        found = {}
        for vector, labels in zip(table.vectors, classes, strict=True):
            if len(labels) == 1:
                found[vector] = Decision(next(iter(labels)), Verdict.BELIEVED)
            else:
                verdict = Verdict.CONTRADICTION if labels else Verdict.SILENT
                found[vector] = Decision(None, verdict)
        return [found[tuple(vector)] for vector in vectors]

    return decide


def learn_axioms(
    features: Mapping[str, Sequence[str]],
    vectors: Sequence[FeatureVector],
    labels: Sequence[str],
    *,
    decide: Decide,
    reasons: Sequence[Reasons | None] = (),
    options: LearningOptions = DEFAULTS,
) -> Learned:
    """Induce, generalise and validate axioms until the scenes give no further one.

    Each round finds the scenes that the knowledge, with what was learned so far, leaves open or
    gets wrong, but for those that look the same and are of several classes (no axiom could tell
    them apart); grows a tree on them; and takes every path that ends in one class. A path is
    narrowed where decided scenes speak against it, then generalised over all scenes; it becomes
    an axiom if enough scenes bear it out, if it would hardly fit by chance, and if the knowledge
    with it classifies the scenes that it speaks about.

    Scenes of which somebody said why they are of their class propose axioms with these reasons
    (:func:`~seewhy.induction.explained.explained_candidates`); the tree is grown on the others.

    Parameters
    ----------
    features : mapping of str to sequence of str
    vectors, labels : sequences of one length
        The annotated scenes.
    decide : callable
        See :data:`Decide`.
    reasons : sequence of (frozenset of str or None), optional
        The features that are why each scene is of its class; None where nobody said so.
    options : LearningOptions

    Notes
    -----
    Source: Riley and Sridharan (2019), section 3.4. Departures: support is counted after
    generalising, so that a kind of scene that the tree cut into pieces is not lost; rounds
    repeat; chance is bounded.

    Examples
    --------
    >>> features = {"base": ("wide", "narrow"), "lean": ("yes", "no")}
    >>> vectors = [("wide", "no"), ("wide", "yes"), ("narrow", "no"), ("narrow", "yes")] * 10
    >>> learned = learn_axioms(features, vectors, ["up", "down", "up", "down"] * 10,
    ...                        decide=decide_by_candidates(features))
    >>> for judgement in learned.accepted:
    ...     print(judgement.candidate, judgement.tally.right)
    Candidate(label='up', conditions=(PathCondition(feature='lean', values=('no',)),)) 20
    Candidate(label='down', conditions=(PathCondition(feature='lean', values=('yes',)),)) 20
    """
    table = scene_table(features, vectors, labels, reasons=reasons)
    rng = np.random.default_rng(options.seed)
    accepted: list[Judgement] = []
    judged: dict[Candidate, Judgement] = {}
    first: tuple[DecisionTree, list[Candidate | None]] | None = None
    for _ in range(_MOST_ROUNDS):
        found = len(accepted)
        known = [judgement.candidate for judgement in accepted]
        decisions = decide(known, table.vectors)
        left = _left(table, decisions)
        left *= settled(table, options.tolerance)[:, None]
        unexplained = np.maximum(left - table.explained, 0)
        tree = _grown(table, unexplained, options)
        paths = _paths(tree, table, unexplained)
        first = first or (tree, paths)
        for judgement in (
            *_explained(table, left, options),
            *_proposed(paths, table, left, options),
        ):
            if judgement.candidate in judged:
                continue
            if judgement.fate is Fate.ACCEPTED:
                known = [earlier.candidate for earlier in accepted]
                judgement = _validated(judgement, table, left, known, decide, options, rng)
            judged[judgement.candidate] = judgement
            if judgement.fate is Fate.ACCEPTED:
                accepted.append(judgement)
        if len(accepted) == found:
            break
    kept = set(most_general([judgement.candidate for judgement in accepted]))
    final = tuple(judgement for judgement in accepted if judgement.candidate in kept)
    tree, paths = first or (DecisionTree(table.features), [])
    proposals = {judgement.path for judgement in final}
    leaves = frozenset(
        n
        for n, path in enumerate(paths)
        if path in proposals or (path and any(candidate.covers(path) for candidate in kept))
    )
    return Learned(final, tuple(judged.values()), tree, leaves)


def _left(table: SceneTable, decisions: Sequence[Decision]) -> NDArray[np.int64]:
    """The scenes of each row and class that are left open or decided wrongly."""
    left = table.counts.copy()
    for row, decision in enumerate(decisions):
        if decision.label in table.classes:
            left[row, table.classes.index(decision.label)] = 0
    return left


def _grown(table: SceneTable, left: NDArray[np.int64], options: LearningOptions) -> DecisionTree:
    """A tree over the scenes that are left; unfitted where there are none."""
    rows, columns = np.nonzero(left)
    counts = left[rows, columns]
    return DecisionTree(table.features).fit(
        [table.vectors[row] for row in np.repeat(rows, counts)],
        [table.classes[column] for column in np.repeat(columns, counts)],
        seed=options.seed,
        smallest_leaf=1 if options.tolerance == 0 else max(1, int(counts.sum()) // 50),
    )


def _paths(
    tree: DecisionTree, table: SceneTable, left: NDArray[np.int64]
) -> list[Candidate | None]:
    """What each path of the tree proposes; None where it holds only scenes with unknown values.

    The tree puts values that are not known with others; an axiom does not speak of them.
    """
    found: list[Candidate | None] = []
    for path in tree.paths():
        asked = {condition.feature: condition for condition in path.conditions if condition.values}
        conditions = tuple(asked[feature] for feature in table.features if feature in asked)
        counts = left[table.satisfying(conditions)].sum(axis=0)
        label = table.classes[int(counts.argmax())] if counts.any() else None
        found.append(None if label is None else Candidate(label, conditions))
    return found


def _explained(
    table: SceneTable, left: NDArray[np.int64], options: LearningOptions
) -> Iterator[Judgement]:
    """What explanations propose. It needs no support: somebody says that it is the rule."""
    seen: set[Candidate] = set()
    for path, candidate in explained_candidates(table, left, tolerance=options.tolerance):
        if candidate in seen:
            continue
        seen.add(candidate)
        tallied = tally(candidate, table, left)
        explained, otherwise = (int(n.sum()) for n in explained_otherwise(candidate, table))
        fate, reason = Fate.ACCEPTED, ""
        if not is_borne_out(candidate, table, options.tolerance):
            fate = Fate.REJECTED
            against = [f"{tallied.wrong} scenes speak against it"] if tallied.wrong else []
            if otherwise:
                against.append(f"{otherwise} of {explained} are explained by other reasons")
            reason = " and ".join(against)
        elif (tallied.wrong or explained - otherwise < ENOUGH_EXPLAINED) and chance(
            candidate, table, tallied, searched=False
        ) > BY_CHANCE:
            fate, reason = Fate.DROPPED, "so few scenes could be alike by chance"
        yield Judgement(path, candidate, tallied, fate, reason)


def _proposed(
    paths: Sequence[Candidate | None],
    table: SceneTable,
    left: NDArray[np.int64],
    options: LearningOptions,
) -> Iterator[Judgement]:
    """The generalised paths of a tree over the scenes that are left, those with most first."""
    total = int(left.sum())
    of_class = dict(zip(table.classes, left.sum(axis=0).tolist(), strict=True))
    proposed: dict[Candidate, Judgement] = {}
    for path in paths:
        if path is None:
            continue
        narrow = path
        if not is_borne_out(path, table, options.tolerance):
            counts = left[table.satisfying(path.conditions)].sum(axis=0)
            if counts.max() < (1.0 - 2 * options.tolerance) * counts.sum():
                continue
            found = specialised(path, table, left, tolerance=options.tolerance)
            if found is None:
                continue
            narrow = found
        candidate = generalised(narrow, table, tolerance=options.tolerance)
        if candidate in proposed:
            continue
        tallied = tally(candidate, table, left)
        needed = ceil(options.support * min(total, 2 * of_class[candidate.label]))
        fate, reason = Fate.ACCEPTED, ""
        if tallied.left < needed:
            fate = Fate.DROPPED
            reason = f"{tallied.left} scenes that are left open bear it out, {needed} are needed"
        elif chance(candidate, table, tallied) > BY_CHANCE:
            fate, reason = Fate.DROPPED, "so few scenes could be alike by chance"
        proposed[candidate] = Judgement(path, candidate, tallied, fate, reason)
    accepted = [judgement.candidate for judgement in proposed.values() if not judgement.reason]
    general = set(most_general(accepted))
    for judgement in sorted(proposed.values(), key=lambda judgement: -judgement.tally.left):
        if not judgement.reason and judgement.candidate not in general:
            yield _with(judgement, Fate.MERGED, "a more general one says the same")
        else:
            yield judgement


def _validated(
    judgement: Judgement,
    table: SceneTable,
    left: NDArray[np.int64],
    known: Sequence[Candidate],
    decide: Decide,
    options: LearningOptions,
    rng: np.random.Generator,
) -> Judgement:
    """Try a candidate with the knowledge: on scenes that it speaks about, and on all others."""
    if any(other.covers(judgement.candidate) for other in known):
        return _with(judgement, Fate.MERGED, "a more general one says the same")
    before = decide(known, table.vectors)
    labels = np.array([decision.label or "" for decision in before])
    ours = table.satisfying(judgement.candidate.conditions) & (
        left[:, table.classes.index(judgement.candidate.label)] > 0
    )
    if (labels[ours] == judgement.candidate.label).all():
        return _with(judgement, Fate.MERGED, "others say the same of all these scenes")
    after = decide([*known, judgement.candidate], table.vectors)
    spoken = np.flatnonzero(table.satisfying(judgement.candidate.conditions))
    scenes = np.repeat(spoken, table.totals[spoken])
    drawn = min(len(scenes), ceil(options.validation * table.totals.sum()))
    chosen = rng.permutation(len(scenes))[:drawn]
    wrong = 0
    for row in scenes[chosen]:
        right = after[row].label
        share = table.of_class(right)[row] / table.totals[row] if right else 0.0
        wrong += int(rng.random() >= share)
    if wrong and at_least(wrong, drawn, options.tolerance) < BY_CHANCE:
        return _with(judgement, Fate.REJECTED, f"{wrong} of {drawn} scenes drawn are misclassified")
    for row, (first, then) in enumerate(zip(before, after, strict=True)):
        if first.label is not None and then.label != first.label:
            vector = ", ".join(str(value) for value in table.vectors[row])
            return _with(
                judgement, Fate.REJECTED, f"it contradicts what is known of the scenes ({vector})"
            )
    return judgement


def _with(judgement: Judgement, fate: Fate, reason: str) -> Judgement:
    return Judgement(judgement.path, judgement.candidate, judgement.tally, fate, reason)
