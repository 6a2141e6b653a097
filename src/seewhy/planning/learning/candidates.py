"""Candidates by which a fluent usually holds, and by which it usually does not."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from seewhy.induction.axiom_learning import BY_CHANCE, Decide, LearningOptions, learn_axioms
from seewhy.induction.binomial import at_least
from seewhy.induction.candidate import Candidate, chance, is_borne_out, tally
from seewhy.induction.generalisation import most_general
from seewhy.induction.scene_table import SceneTable, scene_table
from seewhy.induction.tree import PathCondition
from seewhy.knowledge.scene import FeatureVector
from seewhy.planning.learning.features import YES, ArgumentFeatures
from seewhy.planning.learning.learned_defaults import excluded, single
from seewhy.planning.learning.preference import preferred

AS_OFTEN_WRONG = 0.05
"""What is usual is right more often than wrong: so unlikely is the opposite."""


def default_candidates(
    features: ArgumentFeatures, table: SceneTable, decide: Decide, options: LearningOptions
) -> list[Candidate]:
    """Return the candidates by which a fluent usually holds, each one axiom.

    Examples
    --------
    >>> import clingo
    >>> from seewhy.induction.axiom_learning import decide_by_candidates
    >>> from seewhy.planning.domain import load_planning_domain
    >>> from seewhy.planning.learning.cases import Case
    >>> from seewhy.planning.learning.features import features_of
    >>> from seewhy.planning.learning.relations import Facts
    >>> office = load_planning_domain("robot_assistant").knowledge
    >>> texts = ("loc(sally,sallys_office)", "loc(bob,bobs_office)", "loc(bob,kitchen)")
    >>> cases = [Case(clingo.parse_term(text), True, 0) for text in texts]
    >>> features = features_of(office.signature, Facts(office), cases)
    >>> vectors = [features.vector(case.fluent) for case in cases] * 20
    >>> table = scene_table(features.values, vectors, ["yes", "yes", "no"] * 20)
    >>> decide = decide_by_candidates(features.values)
    >>> usual = default_candidates(features, table, decide, LearningOptions())
    >>> [candidate.conditions for candidate in usual]
    [(PathCondition(feature='work_place(0, 1)', values=('yes',)),)]
    """
    everywhere = Candidate(YES, ())
    if is_borne_out(everywhere, table, options.tolerance) and is_usual(everywhere, table):
        return [everywhere]
    if not features.values:
        return []
    scenes = [scene for row in range(len(table.vectors)) for scene in _scenes(table, row)]
    learned = learn_axioms(
        features.values,
        [vector for vector, _ in scenes],
        [label for _, label in scenes],
        decide=decide,
        options=options,
    )
    found = [
        preferred(_with_usual_things(judgement.candidate, features, table), features, table)
        for judgement in learned.accepted
        if judgement.candidate.label == YES
    ]
    every = [
        part for candidate in found for part in single(candidate, features) if is_usual(part, table)
    ]
    return most_general(every)


def _with_usual_things(
    candidate: Candidate, features: ArgumentFeatures, table: SceneTable
) -> Candidate:
    """Take back things that a candidate leaves out, though it is usually right of them, too.

    What is usual has exceptions; more of them than elsewhere are no reason to know nothing.
    """
    for opposite, thing in excluded(candidate, features):
        found = tally(opposite, table)
        if found.wrong > found.right:
            conditions = []
            for condition in candidate.conditions:
                values = features.values[condition.feature]
                allowed = condition.values
                if condition.feature == thing.feature:
                    allowed = tuple(v for v in values if v in (*condition.values, *thing.values))
                if allowed != values:
                    conditions.append(PathCondition(condition.feature, allowed))
            candidate = Candidate(candidate.label, tuple(conditions))
    return candidate


def is_usual(candidate: Candidate, table: SceneTable) -> bool:
    """Return whether an axiom by itself is right more often than not, and than chance explains.

    A candidate about several things may owe its evidence to some of them.
    """
    found = tally(candidate, table)
    if at_least(found.right, found.right + found.wrong, 0.5) > AS_OFTEN_WRONG:
        return False
    return not candidate.conditions or chance(candidate, table, found) <= BY_CHANCE


def exceptions(
    candidate: Candidate, features: ArgumentFeatures, table: SceneTable
) -> Iterator[Candidate]:
    """Yield that things which a candidate leaves out are usually otherwise than it says.

    Chance is judged among what the candidate would speak about, did it leave nothing out.
    """
    for opposite, thing in excluded(candidate, features):
        every = tuple(o for o in opposite.conditions if o != thing)
        rows = np.flatnonzero(table.satisfying(every))
        spoken = [(v, c) for row in rows for v, c in _scenes(table, int(row))]
        among = scene_table(features.values, [v for v, _ in spoken], [c for _, c in spoken])
        alone = Candidate(opposite.label, (thing,))
        if is_usual(alone, among):
            yield opposite


def _scenes(table: SceneTable, row: int) -> Iterator[tuple[FeatureVector, str]]:
    for label, count in zip(table.classes, table.counts[row], strict=True):
        for _ in range(int(count)):
            yield table.vectors[row], label
