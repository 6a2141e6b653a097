"""Say what a candidate says of single things by how they are related, where that is the same."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from seewhy.induction.candidate import Candidate
from seewhy.induction.scene_table import Rows, SceneTable
from seewhy.induction.tree import PathCondition
from seewhy.planning.learning.features import NO, YES, ArgumentFeatures


def preferred(candidate: Candidate, features: ArgumentFeatures, table: SceneTable) -> Candidate:
    """Return a candidate that speaks of the same cases, naming things only where it must.

    Of conditions that divide the cases alike, what an argument is like is preferred, then that a
    relation holds (one between more of the arguments), then that one does not hold, then which
    thing the first argument is.

    Examples
    --------
    >>> import clingo
    >>> from seewhy.induction.scene_table import scene_table
    >>> from seewhy.planning.domain import load_planning_domain
    >>> from seewhy.planning.learning.cases import Case
    >>> from seewhy.planning.learning.features import features_of
    >>> from seewhy.planning.learning.relations import Facts
    >>> office = load_planning_domain("robot_assistant").knowledge
    >>> texts = ("loc(sally,sallys_office)", "loc(bob,bobs_office)", "loc(bob,kitchen)")
    >>> cases = [Case(clingo.parse_term(text), True, 0) for text in texts]
    >>> features = features_of(office.signature, Facts(office), cases)
    >>> vectors = [features.vector(case.fluent) for case in cases]
    >>> table = scene_table(features.values, vectors, "yyn")
    >>> offices = PathCondition("argument 1", ("bobs_office", "sallys_office"))
    >>> preferred(Candidate("yes", (offices,)), features, table).conditions
    (PathCondition(feature='work_place(0, 1)', values=('yes',)),)
    """
    for place, condition in enumerate(candidate.conditions):
        others = (*candidate.conditions[:place], *candidate.conditions[place + 1 :])
        among = table.satisfying(others)
        inside = among & table.satisfying([condition])
        asked = {other.feature for other in others}
        for other in _before(condition, features, table, among & ~inside):
            if (
                other.feature not in asked
                and (table.satisfying([other])[among] == inside[among]).all()
            ):
                conditions = [*others, other]
                order = list(features.values)
                conditions.sort(key=lambda kept: order.index(kept.feature))
                return preferred(replace(candidate, conditions=tuple(conditions)), features, table)
    return candidate


def _before(
    condition: PathCondition, features: ArgumentFeatures, table: SceneTable, left_out: Rows
) -> Iterator[PathCondition]:
    """Conditions that are preferred to this one, the best first."""
    for other in _in_order(features, table, left_out):
        if other == condition or (
            other.feature == condition.feature and condition.feature not in features.relations
        ):
            return
        yield other


def _in_order(
    features: ArgumentFeatures, table: SceneTable, left_out: Rows
) -> Iterator[PathCondition]:
    """What arguments are like, that relations hold, that they do not, and which things they are."""

    def allowed(feature: str) -> PathCondition:
        values = zip(features.values[feature], table.showing[feature], strict=True)
        return PathCondition(
            feature, tuple(value for value, rows in values if not (rows & left_out).any())
        )

    yield from map(allowed, features.attributes)
    for value in (YES, NO):
        yield from (PathCondition(relation, (value,)) for relation in features.relations)
    yield from map(allowed, features.places)
