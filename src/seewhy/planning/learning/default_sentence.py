"""What is usually so, as sentences in the words of planning.toml."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence

from seewhy.induction.candidate import Candidate
from seewhy.induction.tree import PathCondition
from seewhy.planning.learning.features import YES, ArgumentFeatures
from seewhy.planning.learning.learned_defaults import narrowest_sorts, things_named, values_left_out
from seewhy.planning.learning.relations import Attribute
from seewhy.planning.tables import FluentTable
from seewhy.planning.words import PlanningWords, in_sequence

__all__ = ["ArgumentNouns", "condition_clauses", "default_sentence", "exception_clauses"]

_ARTICLE_AND_SLOT = re.compile(r"(?:\b(?:an?|the) )?\{(\d+)\}")


def default_sentence(candidate: Candidate, features: ArgumentFeatures, words: PlanningWords) -> str:
    """Return what is usually so as "if a person works in a place, then usually …".

    ``candidate`` is one of :func:`seewhy.planning.learning.learned_defaults.single`.

    Examples
    --------
    >>> import clingo
    >>> from seewhy.induction.tree import PathCondition
    >>> from seewhy.planning.domain import load_planning_domain
    >>> from seewhy.planning.learning.cases import Case
    >>> from seewhy.planning.learning.features import features_of
    >>> from seewhy.planning.learning.relations import Facts
    >>> office = load_planning_domain("robot_assistant")
    >>> texts = ("loc(sally,kitchen)", "loc(bob,bobs_office)", "loc(sarah,library)")
    >>> cases = [Case(clingo.parse_term(text), True, 0) for text in texts]
    >>> features = features_of(office.knowledge.signature, Facts(office.knowledge), cases)
    >>> at_work = PathCondition("work_place(0, 1)", ("yes",))
    >>> not_bob = PathCondition("argument 0", ("sally", "sarah"))
    >>> default_sentence(Candidate("yes", (at_work, not_bob)), features, office.words)
    'if a person other than Bob works in a place, then usually the person is in the place'
    """
    things = ArgumentNouns(candidate, features, words)
    clauses = condition_clauses(candidate, things)
    holds = candidate.label == YES
    places = tuple(range(len(features.sorts)))
    said = things.filled(words.fluents.get(features.predicate), features.predicate, places, holds)
    return f"if {in_sequence(clauses)}, then usually {said}" if clauses else f"usually {said}"


def condition_clauses(
    candidate: Candidate, things: ArgumentNouns, *, unless: Collection[str] = ()
) -> list[str]:
    """Return the conditions of a candidate as clauses, but for those about the features ``unless``.

    What sort an argument is of, and which thing, is said by what it is called.
    """
    features, words = things.features, things.words
    clauses = []
    for condition in candidate.conditions:
        relation = features.relations.get(condition.feature)
        attribute = features.attributes.get(condition.feature)
        if condition.feature in unless:
            continue
        if attribute is not None:
            clauses += _told(attribute, condition, things)
        if relation is None or (relation.is_sort and condition.values == (YES,)):
            continue
        yes = condition.values == (YES,)
        if relation.is_sort:
            clauses.append(f"{things.say(relation.places[0])} is no {_noun(relation.predicate)}")
        else:
            table = words.table(relation.predicate)
            clauses.append(things.filled(table, relation.predicate, relation.places, yes))
    return clauses


def exception_clauses(
    candidate: Candidate, things: ArgumentNouns, *, unless: Collection[str]
) -> list[str]:
    """Return what makes exceptions of a candidate: that features are otherwise than it asks."""
    return [
        things.told(things.features.attributes[condition.feature], value, True)
        for condition in candidate.conditions
        if condition.feature in unless
        for value in values_left_out(condition, things.features)
    ]


def _told(attribute: Attribute, condition: PathCondition, things: ArgumentNouns) -> list[str]:
    """What an attribute is, or what it is not."""
    if len(condition.values) == 1:
        return [things.told(attribute, condition.values[0], True)]
    left_out = values_left_out(condition, things.features)
    return [things.told(attribute, value, False) for value in left_out]


class ArgumentNouns:
    """What arguments are called: "a person other than Bob" at first, "the person" then."""

    def __init__(
        self, candidate: Candidate, features: ArgumentFeatures, words: PlanningWords
    ) -> None:
        self.features = features
        self.words = words
        self.named = things_named(candidate, features)
        self.sorts = narrowest_sorts(candidate, features)
        self.besides = {
            features.places[condition.feature]: values_left_out(condition, features)
            for condition in candidate.conditions
            if condition.feature in features.places and len(condition.values) > 1
        }
        self.said: set[int] = set()

    def say(self, place: int | None) -> str:
        """What an argument is called, as it is said next."""
        if place is None:
            return "some thing"
        if place in self.named:
            return self.words.name(self.named[place])
        noun = _noun(self.sorts[place])
        alike = [
            earlier for earlier in sorted(self.said) if self.sorts[earlier] == self.sorts[place]
        ]
        if place in self.said:
            return f"the {'other ' if alike and alike[0] != place else ''}{noun}"
        other = [self.words.name(thing) for thing in self.besides.get(place, ())]
        besides = f" other than {' or '.join(other)}" if other else ""
        article = "another" if alike else "an" if noun[0] in "aeiou" else "a"
        self.said.add(place)
        return f"{article} {noun}{besides}"

    def filled(
        self,
        table: FluentTable | None,
        predicate: str,
        places: tuple[int | None, ...],
        holds: bool,
    ) -> str:
        """A clause about arguments, by the table that has its words."""
        if table is None:
            about = ", ".join(self.say(place) for place in places)
            said = predicate.replace("_", " ") + (f" ({about})" if about else "")
            return said if holds else f"not: {said}"
        said = self.slots(table.say if holds or table.deny is None else table.deny, places)
        return f"it is not so that {said}" if not holds and table.deny is None else said

    def told(self, attribute: Attribute, value: str, holds: bool) -> str:
        """That an attribute has a value, or has it not, as a clause."""
        arity = len(attribute.places)
        said, denied = self.words.clauses(attribute.predicate, arity)
        named = said.replace(f"{{{attribute.places.index(None)}}}", self.words.name(value))
        without = denied.replace(f"{{{attribute.places.index(None)}}}", self.words.name(value))
        return self.slots(named if holds else without, attribute.places)

    def slots(self, text: str, places: Sequence[int | None]) -> str:
        """A text with the arguments in its slots."""
        return _ARTICLE_AND_SLOT.sub(lambda match: self.say(places[int(match.group(1))]), text)


def _noun(sort: str) -> str:
    return sort.replace("_", " ")
