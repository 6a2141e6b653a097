"""What is usually so, as axioms that give way to what is known, and as sentences."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import product

from seewhy.induction.candidate import Candidate
from seewhy.induction.tree import PathCondition
from seewhy.knowledge.axiom import Literal
from seewhy.planning.learning.features import NO, YES, FluentFeatures
from seewhy.planning.tables import FluentTable
from seewhy.planning.words import PlanningWords, in_sequence

_SPARE = "XYZUVW"
_ARTICLE_AND_SLOT = re.compile(r"(?:\b(?:an?|the) )?\{(\d+)\}")


def single(candidate: Candidate, features: FluentFeatures) -> Iterator[Candidate]:
    """Divide a candidate into candidates that are one axiom each.

    That an argument is one of several things is said by naming the others, where they are fewer,
    and by an axiom each otherwise.
    """
    ways = [
        [condition]
        if condition.feature in features.relations
        or len(condition.values) == 1
        or _is_exclusion(condition, features)
        else [PathCondition(condition.feature, (own,)) for own in condition.values]
        for condition in candidate.conditions
    ]
    for chosen in product(*ways):
        yield Candidate(candidate.label, chosen)


def excluded(
    candidate: Candidate, features: FluentFeatures
) -> Iterator[tuple[Candidate, PathCondition]]:
    """Yield the opposite of a candidate for each thing that it leaves out by naming it.

    The condition says which thing it is.
    """
    for place, condition in enumerate(candidate.conditions):
        if condition.feature in features.places and _is_exclusion(condition, features):
            for thing in _others(condition, features):
                conditions = list(candidate.conditions)
                conditions[place] = own = PathCondition(condition.feature, (thing,))
                yield Candidate(NO if candidate.label == YES else YES, tuple(conditions)), own


def _is_exclusion(condition: PathCondition, features: FluentFeatures) -> bool:
    every = len(features.values[condition.feature])
    return len(condition.values) > 1 and every < 2 * len(condition.values)


def _others(condition: PathCondition, features: FluentFeatures) -> list[str]:
    return [v for v in features.values[condition.feature] if v not in condition.values]


def usual_statement(candidate: Candidate, features: FluentFeatures) -> str:
    """Return the axiom that says what one of :func:`single` says.

    Examples
    --------
    >>> import clingo
    >>> from seewhy.planning.domain import load_planning_domain
    >>> from seewhy.planning.learning.cases import Case
    >>> from seewhy.planning.learning.features import features_of
    >>> from seewhy.planning.learning.relations import Facts
    >>> office = load_planning_domain("robot_assistant").knowledge
    >>> texts = ("loc(sally,kitchen)", "loc(bob,bobs_office)", "loc(sarah,library)")
    >>> cases = [Case(clingo.parse_term(own), True, 0) for own in texts]
    >>> features = features_of(office.signature, Facts(office), cases)
    >>> at_work = PathCondition("work_place(0, 1)", ("yes",))
    >>> not_bob = PathCondition("argument 0", ("sally", "sarah"))
    >>> usual_statement(Candidate("yes", (at_work, not_bob)), features)
    'loc(P, L) if work_place(P, L), P != bob, not -loc(P, L).'
    >>> bob = PathCondition("argument 0", ("bob",))
    >>> usual_statement(Candidate("no", (at_work, bob)), features)
    '-loc(bob, P) if work_place(bob, P), not loc(bob, P).'
    """
    terms = _terms(candidate, features)
    head = Literal(features.fluent, tuple(terms), candidate.label == YES)
    parts: list[str] = []
    for condition in candidate.conditions:
        relation = features.relations.get(condition.feature)
        if relation is not None:
            denied = "" if condition.values == (YES,) else "not "
            parts.append(f"{denied}{relation.of(terms)}")
        elif len(condition.values) > 1:
            variable = terms[features.places[condition.feature]]
            parts += [f"{variable} != {own}" for own in _others(condition, features)]
    return f"{head} if {', '.join([*parts, f'not {head.complement}'])}."


def _terms(candidate: Candidate, features: FluentFeatures) -> list[str]:
    """What stands for the arguments: the one thing that is meant, or a variable."""
    named = _named(candidate, features)
    terms: list[str] = []
    for place, sort in enumerate(_sorts(candidate, features)):
        letters = [own for own in sort.upper() if own.isalpha()]
        free = (own for own in (*letters, *_SPARE) if own not in terms)
        terms.append(named.get(place) or next(free, f"V{place}"))
    return terms


def _named(candidate: Candidate, features: FluentFeatures) -> dict[int, str]:
    """Arguments that are one thing: the only one that was seen, or the one that is meant."""
    meant = {
        features.places[own.feature]: own.values[0]
        for own in candidate.conditions
        if own.feature in features.places and len(own.values) == 1
    }
    return {**features.same, **meant}


def _sorts(candidate: Candidate, features: FluentFeatures) -> list[str]:
    """The narrowest sort of every argument that a candidate leaves."""
    sorts = list(features.sorts)
    for condition in candidate.conditions:
        relation = features.relations.get(condition.feature)
        if relation is None or condition.values != (YES,):
            continue
        for place, sort in zip(relation.places, relation.sorts, strict=True):
            if place is not None and set(features.signature.members(sort)) < set(
                features.signature.members(sorts[place])
            ):
                sorts[place] = sort
    return sorts


def usual_sentence(candidate: Candidate, features: FluentFeatures, words: PlanningWords) -> str:
    """Return one of :func:`single` as "if a person works in a place, then usually …".

    Examples
    --------
    >>> import clingo
    >>> from seewhy.planning.domain import load_planning_domain
    >>> from seewhy.planning.learning.cases import Case
    >>> from seewhy.planning.learning.features import features_of
    >>> from seewhy.planning.learning.relations import Facts
    >>> office = load_planning_domain("robot_assistant")
    >>> texts = ("loc(sally,kitchen)", "loc(bob,bobs_office)", "loc(sarah,library)")
    >>> cases = [Case(clingo.parse_term(own), True, 0) for own in texts]
    >>> features = features_of(office.knowledge.signature, Facts(office.knowledge), cases)
    >>> at_work = PathCondition("work_place(0, 1)", ("yes",))
    >>> not_bob = PathCondition("argument 0", ("sally", "sarah"))
    >>> usual_sentence(Candidate("yes", (at_work, not_bob)), features, office.words)
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
        self.named = _named(candidate, features)
        self.sorts = _sorts(candidate, features)
        self.besides = {
            features.places[own.feature]: _others(own, features)
            for own in candidate.conditions
            if own.feature in features.places and len(own.values) > 1
        }
        self.said: set[int] = set()

    def say(self, place: int | None, sort: str = "thing") -> str:
        if place is None:
            return f"some {_noun(sort)}"
        if place in self.named:
            return self.words.name(self.named[place])
        noun = _noun(self.sorts[place])
        alike = [own for own in sorted(self.said) if self.sorts[own] == self.sorts[place]]
        if place in self.said:
            return f"the {'other ' if alike and alike[0] != place else ''}{noun}"
        other = [self.words.name(own) for own in self.besides.get(place, ())]
        besides = f" other than {' or '.join(other)}" if other else ""
        article = "another" if alike else "an" if noun[0] in "aeiou" else "a"
        self.said.add(place)
        return f"{article} {noun}{besides}"

    def filled(
        self,
        tables: object,
        predicate: str,
        places: tuple[int | None, ...],
        holds: bool,
    ) -> str:
        assert isinstance(tables, dict)
        table: FluentTable | None = tables.get(predicate)
        if table is None:
            about = ", ".join(self.say(own) for own in places)
            said = predicate.replace("_", " ") + (f" ({about})" if about else "")
            return said if holds else f"not: {said}"
        text = table.say if holds or table.deny is None else table.deny
        said = _ARTICLE_AND_SLOT.sub(lambda own: self.say(places[int(own.group(1))]), text)
        return f"it is not so that {said}" if not holds and table.deny is None else said


def _noun(sort: str) -> str:
    return sort.replace("_", " ")
