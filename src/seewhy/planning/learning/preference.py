"""Say what a candidate says of single things by how they are related, where that is the same."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from seewhy.induction.candidate import Candidate
from seewhy.induction.scene_table import Rows, SceneTable
from seewhy.induction.tree import PathCondition
from seewhy.planning.learning.features import NO, YES, FluentFeatures


def preferred(candidate: Candidate, features: FluentFeatures, table: SceneTable) -> Candidate:
    """Return a candidate that speaks of the same cases, naming things only where it must.

    Instead of which thing an argument is, a relation is asked, if it divides the cases alike, one
    that holds rather than one that does not; and of several arguments whose identity divides them
    alike, the first.

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
    >>> cases = [Case(clingo.parse_term(own), True, 0) for own in texts]
    >>> features = features_of(office.signature, Facts(office), cases)
    >>> table = scene_table(features.values, [features.vector(o.fluent) for o in cases], "yyn")
    >>> own = PathCondition("argument 1", ("bobs_office", "sallys_office"))
    >>> preferred(Candidate("yes", (own,)), features, table).conditions
    (PathCondition(feature='work_place(0, 1)', values=('yes',)),)
    """
    for place, own in enumerate(candidate.conditions):
        if own.values == (YES,):
            continue
        others = (*candidate.conditions[:place], *candidate.conditions[place + 1 :])
        among = table.satisfying(others)
        asked = {condition.feature for condition in others}
        for other in _alike(own, features, table, among):
            if other.feature not in asked:
                conditions = [*others, other]
                order = list(features.values)
                conditions.sort(key=lambda condition: order.index(condition.feature))
                return preferred(replace(candidate, conditions=tuple(conditions)), features, table)
    return candidate


def _alike(
    own: PathCondition, features: FluentFeatures, table: SceneTable, among: Rows
) -> Iterator[PathCondition]:
    """Conditions that come before this one and divide some rows as it does, the best first."""
    inside = among & table.satisfying([own])
    outside = among & ~inside
    for value in (YES, NO) if own.feature in features.places else (YES,):
        for relation in features.relations:
            condition = PathCondition(relation, (value,))
            if (table.satisfying([condition])[among] == inside[among]).all():
                yield condition
    if own.feature not in features.places:
        return
    for feature, place in features.places.items():
        if place >= features.places[own.feature]:
            continue
        showing = table.showing[feature]
        values = zip(features.values[feature], showing, strict=True)
        kept = tuple(value for value, rows in values if not (rows & outside).any())
        condition = PathCondition(feature, kept)
        if (table.satisfying([condition])[among] == inside[among]).all():
            yield condition
