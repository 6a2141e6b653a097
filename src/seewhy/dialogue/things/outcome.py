"""What a query comes to in a scene: yes or no, a number, a value, things; None: not known."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from operator import eq, ge, gt, le, lt

from seewhy.dialogue.things.evaluating import Evaluation, Fits, members
from seewhy.dialogue.things.following import (
    compared_numbers,
    completions,
    consequences,
    numbers_of,
)
from seewhy.dialogue.things.query import (
    ClassIs,
    CompareCounts,
    CompareNumber,
    Completing,
    Consequence,
    Count,
    CountDifference,
    Describe,
    Description,
    Difference,
    Exists,
    Groups,
    Holds,
    Most,
    MostCommon,
    Occurring,
    Query,
    Reference,
    References,
    SameValue,
    SharedByMost,
    Together,
    ValueOf,
    Which,
    WhichClass,
)
from seewhy.dialogue.things.tallies import most_are, most_common, occurring, shared_by_most

__all__ = ["Outcome", "Value", "outcome_of"]

Value = bool | int | str | tuple[int, ...] | tuple[str, ...] | tuple[tuple[int, ...], ...] | None
"""Yes or no, a number, a value, numbers of things (or several such), features; None: not known."""

_SIGNS: dict[str, Callable[[int, int], bool]] = {"=": eq, "<": lt, ">": gt, "<=": le, ">=": ge}


@dataclass(frozen=True)
class Outcome:
    """What a query comes to.

    ``fits`` are the things that were asked for, a set for each description of the query.
    """

    value: Value
    fits: tuple[Fits, ...] = ()


def outcome_of(query: Query, evaluation: Evaluation) -> Outcome:
    """Evaluate a query.

    Raises
    ------
    UnclearReferenceError
        If it refers to a thing that is not there or not one.
    """
    match query:
        case Count(described=described):
            fits = evaluation.fits(described)
            return Outcome(fits.surely.bit_count() if fits.known else None, (fits,))
        case Exists(described=described, denied=denied):
            fits = evaluation.fits(described)
            found = True if fits.surely else None if fits.maybe else False
            return Outcome(_denied(found) if denied else found, (fits,))
        case Which(described=described):
            fits = evaluation.fits(described)
            return Outcome(tuple(members(fits.surely)) if fits.known else None, (fits,))
        case CompareCounts(sign=sign, first=first, second=second):
            one, other = evaluation.fits(first), evaluation.fits(second)
            return Outcome(_compared(sign, _span(one), _span(other)), (one, other))
        case CountDifference():
            return _count_difference(query, evaluation)
        case Most(described=described, condition=condition):
            fits = evaluation.fits(Description((*described.conditions, condition)))
            return Outcome(most_are(query, evaluation), (fits,))
        case SharedByMost() | MostCommon() | Occurring():
            return _tallied(query, evaluation)
        case CompareNumber(sign=sign, described=described, number=number):
            fits = evaluation.fits(described)
            return Outcome(_compared(sign, _span(fits), (number, number)), (fits,))
        case ValueOf(feature=feature, one=one):
            return _value_of(feature, one, evaluation)
        case SameValue():
            return Outcome(_same_value(query, evaluation))
        case Holds(ones=ones, condition=condition):
            fits = evaluation.fits(Description((condition,)))
            return Outcome(
                _all([_holds_of(reference, fits, evaluation) for reference in ones]), (fits,)
            )
        case Describe(one=one):
            return Outcome((evaluation.the(one),))
        case Difference():
            return _difference(query, evaluation)
        case Consequence():
            follows = consequences(query, evaluation)
            return Outcome(
                None if follows is None else tuple(consequence.number for consequence in follows)
            )
        case Groups():
            return Outcome(_groups(query, evaluation))
        case Together(group=group, ones=ones, denied=denied):
            numbers = numbers_of(ones, evaluation)
            if len(numbers) != evaluation.things.groups[group].size:
                return Outcome(None)
            so = _known_groups(evaluation, group)
            return Outcome(None if so is None else (numbers in so) is not denied)
        case Completing():
            return Outcome(_completing(query, evaluation))
        case ClassIs(label=label, denied=denied):
            told = evaluation.scene.label
            return Outcome(None if told is None else (told == label) is not denied)
        case WhichClass():
            return Outcome(evaluation.scene.label)
    raise TypeError(f"must be a query, got {query!r}")


def _count_difference(query: CountDifference, evaluation: Evaluation) -> Outcome:
    fits = (evaluation.fits(query.first), evaluation.fits(query.second))
    first, second = (fitting.surely.bit_count() for fitting in fits)
    more = first - second if query.sign == ">" else second - first
    return Outcome(more if all(fitting.known for fitting in fits) else None, fits)


def _tallied(query: SharedByMost | MostCommon | Occurring, evaluation: Evaluation) -> Outcome:
    fits = evaluation.fits(query.described)
    features = evaluation.scene.values if isinstance(query, SharedByMost) else (query.feature,)
    known = fits.surely
    for feature in features:
        known &= ~evaluation.without_value[feature]
    asked = (Fits(known, fits.maybe),)
    if isinstance(query, SharedByMost):
        shared = shared_by_most(query, evaluation)
        return Outcome(None if shared is None else tuple(value for _, value in shared), asked)
    if isinstance(query, Occurring):
        found = occurring(query, evaluation)
        return Outcome(len(found) if query.counted and found is not None else found, asked)
    found = most_common(query, evaluation)
    return Outcome(found[0] if found is not None and len(found) == 1 else found, asked)


def _known_groups(evaluation: Evaluation, group: str) -> tuple[tuple[int, ...], ...] | None:
    """Those of which it is so; None where nothing was concluded of the scene."""
    return evaluation.scene.groups.get(group)


def _groups(query: Groups, evaluation: Evaluation) -> Value:
    found = _known_groups(evaluation, query.group)
    if found is None or query.asks == "which":
        return found
    return len(found) if query.asks == "count" else bool(found) is not query.denied


def _completing(query: Completing, evaluation: Evaluation) -> Value:
    found = completions(query, evaluation)
    if found is None:
        return None
    return tuple(completion.number for completion in found if completion.number is not None)


def _value_of(feature: str, one: Reference, evaluation: Evaluation) -> Outcome:
    values = evaluation.scene.values[feature]
    if one.which is References.THE:
        return Outcome(values[evaluation.the(one)])
    fits = evaluation.fits(one.description)
    found = {values[number] for number in members(fits.maybe)}
    single = len(found) == 1 and fits.known
    return Outcome(found.pop() if single else None, (fits,))


def _same_value(query: SameValue, evaluation: Evaluation) -> bool | None:
    """Whether things have one value of a feature; denied, whether no two have the same."""
    column = evaluation.scene.values[query.feature]
    values = [column[number] for number in compared_numbers(query, evaluation)]
    if not values or None in values:
        return None
    return len(set(values)) == (len(values) if query.denied else 1)


def _difference(query: Difference, evaluation: Evaluation) -> Outcome:
    numbers = compared_numbers(query, evaluation)
    known: list[tuple[str, bool]] = []
    for key, column in evaluation.scene.values.items():
        values = {column[number] for number in numbers}
        if None in values or len(numbers) < 2:
            return Outcome(None)
        known.append((key, len(values) == 1))
    return Outcome(tuple(key for key, same in known if same is query.alike))


def _holds_of(one: Reference, fits: Fits, evaluation: Evaluation) -> bool | None:
    """Whether what fits is so of the thing, of some thing or of every thing of a description."""
    if one.which is References.THE:
        return _of(evaluation.the(one), fits)
    described = evaluation.fits(one.description)
    each = [
        (described.surely >> number & 1, _of(number, fits)) for number in members(described.maybe)
    ]
    if one.which is References.SOME:
        if any(sure and so for sure, so in each):
            return True
        return False if all(so is False for _, so in each) else None
    if any(sure and so is False for sure, so in each):
        return False
    return True if each and all(so for _, so in each) else None if each else False


def _of(number: int, fits: Fits) -> bool | None:
    if fits.surely >> number & 1:
        return True
    return None if fits.maybe >> number & 1 else False


def _denied(so: bool | None) -> bool | None:
    return None if so is None else not so


def _all(parts: list[bool | None]) -> bool | None:
    if False in parts:
        return False
    return None if None in parts else True


def _span(fits: Fits) -> tuple[int, int]:
    return fits.surely.bit_count(), fits.maybe.bit_count()


def _compared(sign: str, first: tuple[int, int], second: tuple[int, int]) -> bool | None:
    """Whether a comparison holds of all numbers within two spans, of none, or of some."""
    holds = _SIGNS[sign]
    found = {
        holds(one, other)
        for one in range(first[0], first[1] + 1)
        for other in range(second[0], second[1] + 1)
    }
    return found.pop() if len(found) == 1 else None
