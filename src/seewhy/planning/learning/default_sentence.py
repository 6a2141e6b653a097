"""What is usually so, as sentences in the words of planning.toml."""

from __future__ import annotations

import re
from collections.abc import Mapping

from seewhy.induction.candidate import Candidate
from seewhy.planning.learning.features import YES, FluentFeatures
from seewhy.planning.learning.learned_defaults import narrowest_sorts, things_left_out, things_named
from seewhy.planning.tables import FluentTable
from seewhy.planning.words import PlanningWords, in_sequence

__all__ = ["default_sentence"]

_ARTICLE_AND_SLOT = re.compile(r"(?:\b(?:an?|the) )?\{(\d+)\}")


def default_sentence(candidate: Candidate, features: FluentFeatures, words: PlanningWords) -> str:
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
    things = _Things(candidate, features, words)
    clauses = []
    for condition in candidate.conditions:
        relation = features.relations.get(condition.feature)
        if relation is None or (relation.is_sort and condition.values == (YES,)):
            continue  # said by what the argument is called
        yes = condition.values == (YES,)
        if relation.is_sort:
            clauses.append(f"{things.say(relation.places[0])} is no {_noun(relation.predicate)}")
        else:
            clauses.append(things.filled(words.statics, relation.predicate, relation.places, yes))
    holds = candidate.label == YES
    places = tuple(range(len(features.sorts)))
    said = things.filled(words.fluents, features.fluent, places, holds)
    return f"if {in_sequence(clauses)}, then usually {said}" if clauses else f"usually {said}"


class _Things:
    """What arguments are called: "a person other than Bob" at first, "the person" then."""

    def __init__(
        self, candidate: Candidate, features: FluentFeatures, words: PlanningWords
    ) -> None:
        self.words = words
        self.named = things_named(candidate, features)
        self.sorts = narrowest_sorts(candidate, features)
        self.besides = {
            features.places[condition.feature]: things_left_out(condition, features)
            for condition in candidate.conditions
            if condition.feature in features.places and len(condition.values) > 1
        }
        self.said: set[int] = set()

    def say(self, place: int | None) -> str:
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
        tables: Mapping[str, FluentTable],
        predicate: str,
        places: tuple[int | None, ...],
        holds: bool,
    ) -> str:
        table = tables.get(predicate)
        if table is None:
            about = ", ".join(self.say(place) for place in places)
            said = predicate.replace("_", " ") + (f" ({about})" if about else "")
            return said if holds else f"not: {said}"
        text = table.say if holds or table.deny is None else table.deny
        said = _ARTICLE_AND_SLOT.sub(lambda match: self.say(places[int(match.group(1))]), text)
        return f"it is not so that {said}" if not holds and table.deny is None else said


def _noun(sort: str) -> str:
    return sort.replace("_", " ")
