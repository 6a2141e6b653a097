"""What is usually so, as axioms that give way to what is known."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from itertools import product

from seewhy.induction.candidate import Candidate
from seewhy.induction.tree import PathCondition
from seewhy.knowledge.axiom import Literal
from seewhy.planning.learning.features import NO, YES, ArgumentFeatures

__all__ = [
    "argument_terms",
    "condition_parts",
    "default_statement",
    "excluded",
    "narrowest_sorts",
    "single",
    "things_named",
    "values_left_out",
]

_SPARE = "XYZUVW"


def single(candidate: Candidate, features: ArgumentFeatures) -> Iterator[Candidate]:
    """Divide a candidate into candidates that are one axiom each.

    That an argument is one of several things is said by naming the others, where they are fewer,
    and by an axiom each otherwise.
    """
    ways = [
        [condition]
        if condition.feature in features.relations
        or len(condition.values) == 1
        or _is_exclusion(condition, features)
        else [PathCondition(condition.feature, (value,)) for value in condition.values]
        for condition in candidate.conditions
    ]
    for chosen in product(*ways):
        yield Candidate(candidate.label, chosen)


def excluded(
    candidate: Candidate, features: ArgumentFeatures
) -> Iterator[tuple[Candidate, PathCondition]]:
    """Yield the opposite of a candidate for each thing that it leaves out by naming it.

    The condition says which thing it is.
    """
    for place, condition in enumerate(candidate.conditions):
        if condition.feature in features.places and _is_exclusion(condition, features):
            for thing in values_left_out(condition, features):
                conditions = list(candidate.conditions)
                conditions[place] = named = PathCondition(condition.feature, (thing,))
                yield Candidate(NO if candidate.label == YES else YES, tuple(conditions)), named


def _is_exclusion(condition: PathCondition, features: ArgumentFeatures) -> bool:
    every = len(features.values[condition.feature])
    return len(condition.values) > 1 and every < 2 * len(condition.values)


def values_left_out(condition: PathCondition, features: ArgumentFeatures) -> list[str]:
    """Return the things, or the values, that a condition does not allow."""
    return [v for v in features.values[condition.feature] if v not in condition.values]


def default_statement(candidate: Candidate, features: ArgumentFeatures) -> str:
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
    >>> cases = [Case(clingo.parse_term(text), True, 0) for text in texts]
    >>> features = features_of(office.signature, Facts(office), cases)
    >>> at_work = PathCondition("work_place(0, 1)", ("yes",))
    >>> not_bob = PathCondition("argument 0", ("sally", "sarah"))
    >>> default_statement(Candidate("yes", (at_work, not_bob)), features)
    'loc(P, L) if work_place(P, L), P != bob, not -loc(P, L).'
    >>> bob = PathCondition("argument 0", ("bob",))
    >>> default_statement(Candidate("no", (at_work, bob)), features)
    '-loc(bob, P) if work_place(bob, P), not loc(bob, P).'
    """
    terms = argument_terms(candidate, features)
    head = Literal(features.predicate, tuple(terms), candidate.label == YES)
    parts = condition_parts(candidate, features, terms)
    return f"{head} if {', '.join([*parts, f'not {head.complement}'])}."


def condition_parts(
    candidate: Candidate,
    features: ArgumentFeatures,
    terms: Sequence[str],
    *,
    unless: Collection[str] = (),
) -> list[str]:
    """Return the conditions of a candidate as they stand in an axiom.

    What is said of the features ``unless`` is said as an exception: that they are not otherwise.
    """
    parts: list[str] = []
    for condition in candidate.conditions:
        feature, values = condition.feature, condition.values
        if feature in features.relations:
            denied = "" if values == (YES,) else "not "
            parts.append(f"{denied}{features.relations[feature].of(terms)}")
        elif feature in features.attributes:
            attribute = features.attributes[feature]
            if len(values) == 1 and feature not in unless:
                parts.append(attribute.of(terms, values[0]))
            else:
                left_out = values_left_out(condition, features)
                parts += [f"not {attribute.of(terms, value)}" for value in left_out]
        elif len(values) > 1:
            variable = terms[features.places[feature]]
            parts += [f"{variable} != {thing}" for thing in values_left_out(condition, features)]
    return parts


def argument_terms(candidate: Candidate, features: ArgumentFeatures) -> list[str]:
    """What stands for the arguments: the one thing that is meant, or a variable."""
    named = things_named(candidate, features)
    terms: list[str] = []
    for place, sort in enumerate(narrowest_sorts(candidate, features)):
        letters = [letter for letter in sort.upper() if letter.isalpha()]
        free = (letter for letter in (*letters, *_SPARE) if letter not in terms)
        terms.append(named.get(place) or next(free, f"V{place}"))
    return terms


def things_named(candidate: Candidate, features: ArgumentFeatures) -> dict[int, str]:
    """Return the arguments that are one thing: the only one seen, or the one that is meant."""
    meant = {
        features.places[condition.feature]: condition.values[0]
        for condition in candidate.conditions
        if condition.feature in features.places and len(condition.values) == 1
    }
    return {**features.same, **meant}


def narrowest_sorts(candidate: Candidate, features: ArgumentFeatures) -> list[str]:
    """Return the narrowest sort of every argument that a candidate leaves."""
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
