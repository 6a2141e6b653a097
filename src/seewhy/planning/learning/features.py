"""The features of a fluent's arguments: how they are related, and which things they are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import clingo

from seewhy.knowledge.scene import FeatureVector
from seewhy.knowledge.signature import Signature
from seewhy.planning.learning.cases import Case
from seewhy.planning.learning.relations import Facts, Relation, relations

YES, NO = "yes", "no"


@dataclass(frozen=True)
class FluentFeatures:
    """What is learned from about one fluent.

    Attributes
    ----------
    fluent : str
    sorts : tuple of str
        Those of its arguments.
    relations : mapping of str to Relation
        Feature → the relation that it says yes or no of.
    places : mapping of str to int
        Feature → the argument whose identity it is.
    values : mapping of str to tuple of str
        Feature → its values, relations first.
    same : mapping of int to str
        Argument → the thing that it is in all cases: of others nothing was seen.
    """

    signature: Signature
    facts: Facts
    fluent: str
    relations: Mapping[str, Relation]
    places: Mapping[str, int]
    values: Mapping[str, tuple[str, ...]]
    same: Mapping[int, str]

    @property
    def sorts(self) -> tuple[str, ...]:
        """The sorts of the fluent's arguments."""
        return self.signature.predicates[self.fluent].sorts

    def vector(self, fluent: clingo.Symbol) -> FeatureVector:
        """The values of the features of one fluent."""
        related = (
            YES if self.facts.hold(relation, fluent) else NO for relation in self.relations.values()
        )
        things = (str(fluent.arguments[place]) for place in self.places.values())
        return (*related, *things)


def features_of(signature: Signature, facts: Facts, cases: Sequence[Case]) -> FluentFeatures:
    """Return the features of the fluent that all the cases are about.

    Relations that are alike in all cases say nothing and are left out, and so are those that are
    as another one throughout.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> office = load_planning_domain("robot_assistant").knowledge
    >>> texts = ("loc(sally,kitchen)", "loc(bob,bobs_office)", "loc(bob,library)")
    >>> cases = [Case(clingo.parse_term(text), True, 0) for text in texts]
    >>> features = features_of(office.signature, Facts(office), cases)
    >>> list(features.values)  # doctest: +NORMALIZE_WHITESPACE
    ['work_place(0, 1)', 'printer(1)', 'next_to(1, _)', 'next_to(_, 1)',
     'argument 0', 'argument 1']
    >>> features.vector(cases[0].fluent)
    ('no', 'no', 'yes', 'yes', 'sally', 'kitchen')
    """
    name = cases[0].fluent.name
    fluents = sorted({case.fluent for case in cases})
    told: dict[tuple[bool, ...], Relation] = {}
    for relation in relations(signature, name):
        pattern = tuple(facts.hold(relation, fluent) for fluent in fluents)
        if len(set(pattern)) > 1:
            told.setdefault(pattern, relation)
    kept = {str(relation): relation for relation in told.values()}
    values: dict[str, tuple[str, ...]] = dict.fromkeys(kept, (YES, NO))
    places: dict[str, int] = {}
    same: dict[int, str] = {}
    for place in range(len(signature.predicates[name].sorts)):
        members = sorted({str(fluent.arguments[place]) for fluent in fluents})
        if len(members) > 1:
            feature = f"argument {place}"
            places[feature], values[feature] = place, tuple(members)
        else:
            same[place] = members[0]
    return FluentFeatures(signature, facts, name, kept, places, values, same)
