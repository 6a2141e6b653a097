"""The features of a fluent's arguments: how they are related, and which things they are."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import clingo

from seewhy.knowledge.scene import FeatureVector
from seewhy.knowledge.signature import Signature
from seewhy.planning.learning.cases import Case
from seewhy.planning.learning.relations import Attribute, Facts, Relation, relations

YES, NO = "yes", "no"


@dataclass(frozen=True, kw_only=True)
class ArgumentFeatures:
    """What is learned from about the arguments of one fluent, or of one action.

    Attributes
    ----------
    predicate : str
        The fluent or action.
    relations : mapping of str to Relation
        Feature → the relation that it says yes or no of.
    places : mapping of str to int
        Feature → the argument whose identity it is.
    values : mapping of str to tuple of str
        Feature → its values, what is said of arguments before who they are.
    same : mapping of int to str
        Argument → the thing that it is in all cases: of others nothing was seen.
    attributes : mapping of str to Attribute
        Feature → the attribute whose value it is.
    """

    signature: Signature
    predicate: str
    relations: Mapping[str, Relation]
    places: Mapping[str, int]
    values: Mapping[str, tuple[str, ...]]
    same: Mapping[int, str]
    attributes: Mapping[str, Attribute] = field(default_factory=dict)

    @property
    def sorts(self) -> tuple[str, ...]:
        """The sorts of the arguments."""
        return self.signature.predicates[self.predicate].sorts


@dataclass(frozen=True, kw_only=True)
class FluentFeatures(ArgumentFeatures):
    """What is learned from about one fluent, by what is fixed."""

    facts: Facts

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
    places, same = identities(fluents, range(len(signature.predicates[name].sorts)))
    values |= {
        feature: tuple(sorted({str(fluent.arguments[place]) for fluent in fluents}))
        for feature, place in places.items()
    }
    return FluentFeatures(
        signature=signature,
        facts=facts,
        predicate=name,
        relations=kept,
        places=places,
        values=values,
        same=same,
    )


def identities(
    terms: Sequence[clingo.Symbol], places: Iterable[int]
) -> tuple[dict[str, int], dict[int, str]]:
    """Return the features that say which thing an argument is, and what those are that say nothing.

    Examples
    --------
    >>> going = [clingo.parse_term(text) for text in ("go(rob, hall)", "go(rob, attic)")]
    >>> identities(going, (0, 1))
    ({'argument 1': 1}, {0: 'rob'})
    """
    features: dict[str, int] = {}
    same: dict[int, str] = {}
    for place in places:
        members = {str(term.arguments[place]) for term in terms}
        if len(members) > 1:
            features[f"argument {place}"] = place
        else:
            same[place] = members.pop()
    return features, same
