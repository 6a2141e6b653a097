"""What the questions of the grammar come to: queries about a picture's things."""

from __future__ import annotations

from collections.abc import Callable

from seewhy.dialogue.grammar import Binding
from seewhy.dialogue.things.chart import Fold
from seewhy.dialogue.things.phrases import Bindings, all_of, meanings, settled
from seewhy.dialogue.things.query import (
    AnyOf,
    ClassIs,
    CompareCounts,
    CompareNumber,
    Completing,
    Condition,
    Consequence,
    Count,
    CountDifference,
    Describe,
    Description,
    Difference,
    Exists,
    Groups,
    HasValue,
    Holds,
    Is,
    Most,
    MostCommon,
    Occurring,
    Query,
    Reference,
    References,
    Related,
    SameValue,
    SharedByMost,
    Together,
    ValueOf,
    Which,
    WhichClass,
)

__all__ = ["QUESTIONS", "as_held", "as_query", "conditions_of", "references_of"]


def as_query(query: Query) -> Bindings:
    """Return a query as the one thing that a question comes to."""
    return (Binding("query", query),)


def _descriptions(bindings: Bindings) -> list[Description]:
    found = meanings(bindings, "described")
    return [described for described in found if isinstance(described, Description)]


def references_of(bindings: Bindings) -> tuple[Reference, ...]:
    """Return the references among some bindings, in order."""
    found = meanings(bindings, "one")
    return tuple(reference for reference in found if isinstance(reference, Reference))


def conditions_of(bindings: Bindings) -> tuple[Condition, ...]:
    """Return the conditions among some bindings, in order."""
    return tuple(meanings(bindings, "condition"))  # type: ignore[arg-type]


def _feature(bindings: Bindings) -> str | None:
    """The feature that is asked for; None where several are named."""
    named = set(meanings(bindings, "feature"))
    return str(named.pop()) if len(named) == 1 else None


def _described(bindings: Bindings) -> Description:
    found = _descriptions(bindings)
    them = meanings(bindings, "them")
    if them and isinstance(them[0], Description):
        return _of_them(them[0], conditions_of(bindings))
    return (found[0] if found else Description(many=True)).also(*conditions_of(bindings))


def _of_them(them: Description, conditions: tuple[Condition, ...]) -> Description:
    """Those of some things that are so; what was asked of them before is asked no more.

    "How many cubes are there?", "how many are red?", "how many are green?" asks of the cubes.
    """
    asked = {condition.feature for condition in conditions if isinstance(condition, HasValue)}
    kept = tuple(
        condition
        for condition in them.conditions
        if not (isinstance(condition, HasValue) and condition.feature in asked)
        and condition not in conditions
    )
    return Description((*kept, *conditions), them.selection, them.many)


def _about(make: Callable[[Description], Query]) -> Fold:
    return lambda bindings: as_query(make(settled(_described(bindings))))


def _exists(bindings: Bindings) -> Bindings:
    if meanings(bindings, "query"):
        return bindings
    return as_query(Exists(settled(_described(bindings))))


def _value(bindings: Bindings) -> Bindings | None:
    feature, ones = _feature(bindings), references_of(bindings)
    return None if feature is None or len(ones) != 1 else as_query(ValueOf(feature, ones[0]))


def _two_kinds(bindings: Bindings) -> list[Description]:
    """What is counted beside each other; "more red than green cubes" leaves a noun out."""
    found, short = _descriptions(bindings), meanings(bindings, "short")
    if not short:
        return found
    (other,) = found
    said: HasValue = short[0]  # type: ignore[assignment]
    adjectives = [c for c in other.conditions if isinstance(c, HasValue) and not c.noun]
    kept = (c for c in other.conditions if c is not adjectives[0]) if adjectives else ()
    return [Description((said, *kept), many=other.many), other] if adjectives else [other]


def _in_few(bindings: Bindings) -> Bindings | None:
    (condition,) = conditions_of(bindings)
    return (Binding("short", condition),) if isinstance(condition, HasValue) else None


def _compared(bindings: Bindings, sign: str | None = None) -> Bindings | None:
    kinds = _two_kinds(bindings)
    if len(kinds) != 2:
        return None
    first, second = map(settled, kinds)
    signs = meanings(bindings, "sign")
    return as_query(CompareCounts(sign or str(signs[0]), first, second))


def _number(bindings: Bindings) -> Bindings | None:
    number, signs = meanings(bindings, "number")[0], meanings(bindings, "sign")
    if not isinstance(number, int):
        return None
    sign = str(signs[0]) if signs else "="
    return as_query(CompareNumber(sign, settled(_described(bindings)), number))


def _count_difference(bindings: Bindings) -> Bindings:
    first, second = map(settled, _descriptions(bindings))
    return as_query(CountDifference(str(meanings(bindings, "sign")[0]), first, second))


def _mostly(bindings: Bindings) -> Bindings | None:
    conditions, described = conditions_of(bindings), _descriptions(bindings)
    if not conditions or len(described) != 1:
        return None
    return as_query(Most(settled(described[0]), all_of(conditions)))


def _most_common(bindings: Bindings) -> Bindings | None:
    feature = _feature(bindings)
    if feature is None:
        return None
    least = bool(meanings(bindings, "least"))
    return as_query(MostCommon(settled(_described(bindings)), feature, least))


def _occurring(*, counted: bool) -> Fold:
    def fold(bindings: Bindings) -> Bindings | None:
        feature = _feature(bindings)
        if feature is None:
            return None
        return as_query(Occurring(settled(_described(bindings)), feature, counted))

    return fold


def _signed(sign: str) -> Fold:
    return lambda _: (Binding("sign", sign),)


def _same_value(bindings: Bindings) -> Bindings | None:
    if meanings(bindings, "query"):
        return bindings
    return _alike(bindings, denied=False)


def _alike(bindings: Bindings, *, denied: bool) -> Bindings | None:
    feature, ones = _feature(bindings), references_of(bindings)
    if len(ones) == 1 and ones[0].which is References.EVERY:
        ones = (ones[0], ones[0])
    if feature is None or len(ones) != 2:
        return None
    return as_query(SameValue(feature, ones[0], ones[1], denied))


def as_held(bindings: Bindings) -> Bindings | None:
    """Return the query whether something is so of things; None where it does not go together."""
    if meanings(bindings, "query"):
        return bindings
    conditions, ones = conditions_of(bindings), references_of(bindings)
    features = set(meanings(bindings, "feature"))
    of_another = any(isinstance(c, HasValue) and features - {c.feature} for c in conditions)
    if not conditions or not ones or of_another:
        return None
    return as_query(Holds(ones, all_of(conditions)))


def _the_only(bindings: Bindings) -> Bindings | None:
    """Whether every thing of a kind is one thing, which is then the only one of the kind."""
    ones, described, conditions = (
        references_of(bindings), _descriptions(bindings), conditions_of(bindings)
    )  # fmt: skip
    if len(ones) != 1 or ones[0].which is not References.THE or len(described) > 1:
        return None
    kind = (described[0] if described else Description()).also(*conditions)
    every = Reference(Description(kind.conditions, many=True), References.EVERY)
    return as_query(Holds((every,), Is(ones[0])))


def _each_other(bindings: Bindings) -> Bindings | None:
    """Whether several things stand to each other in some way: each of them to every other."""
    ones, relations = references_of(bindings), meanings(bindings, "relation")
    if len(ones) == 2 and all(reference.which is References.THE for reference in ones):
        return as_query(Holds(ones[:1], Related(str(relations[0]), ones[1])))
    if len(ones) != 1 or ones[0].which is not References.EVERY:
        return None
    return as_query(Holds(ones, Related(str(relations[0]), ones[0])))


def _choice(bindings: Bindings) -> Bindings | None:
    """Which of two values a thing has: "is the ball red or blue?"."""
    ones, conditions = references_of(bindings), conditions_of(bindings)
    features = {c.feature for c in conditions if isinstance(c, HasValue)}
    if len(ones) != 1 or len(features) != 1 or ones[0].which is not References.THE:
        return None
    return as_query(ValueOf(features.pop(), ones[0]))


def _pair(make: Callable[[Reference, Reference], Query]) -> Fold:
    def fold(bindings: Bindings) -> Bindings | None:
        ones = _each(references_of(bindings))
        if len(ones) == 1 and ones[0].which is References.EVERY:
            ones = (ones[0], ones[0])  # all of them beside each other
        return as_query(make(*ones)) if len(ones) == 2 else None

    return fold


def _each(ones: tuple[Reference, ...]) -> tuple[Reference, ...]:
    """References, and in the place of "they" each of those that were spoken of."""
    if len(ones) != 1 or len(ones[0].description.conditions) != 1:
        return ones
    match ones[0].description.conditions[0]:
        case AnyOf(conditions=each):
            return tuple(one.one for one in each if isinstance(one, Is))
    return ones


def _single(make: Callable[[Reference], Query]) -> Fold:
    return lambda bindings: as_query(make(references_of(bindings)[0]))


def _consequence(bindings: Bindings) -> Bindings | None:
    ones, conditions = references_of(bindings), conditions_of(bindings)
    about = meanings(bindings, "about")
    if len(ones) != 1:
        return None
    to = about[0] if about and isinstance(about[0], Reference) else None
    return as_query(Consequence(ones[0], all_of(conditions) if conditions else None, to))


def _with_it(bindings: Bindings) -> Bindings:
    return (Binding("about", references_of(bindings)[0]),)


def _completing(bindings: Bindings) -> Bindings | None:
    named = meanings(bindings, "group")
    return as_query(Completing(references_of(bindings), str(named[0]) if named else ""))


def _no_group(bindings: Bindings) -> Bindings:
    return (*bindings, Binding("denied", True))


def _together(bindings: Bindings) -> Bindings | None:
    named = meanings(bindings, "group")
    denied = bool(meanings(bindings, "denied"))
    return as_query(Together(str(named[0]), references_of(bindings), denied))


def _groups(asks: str) -> Fold:
    def fold(bindings: Bindings) -> Bindings:
        group = str(meanings(bindings, "group")[0])
        return as_query(Groups(group, asks, denied=bool(meanings(bindings, "denied"))))

    return fold


def _class_is(bindings: Bindings) -> Bindings | None:
    if meanings(bindings, "query"):
        return bindings
    return _of_class(bindings, denied=False)


def _of_class(bindings: Bindings, *, denied: bool) -> Bindings | None:
    labels = meanings(bindings, "class")
    return as_query(ClassIs(str(labels[0]), denied)) if labels else None


QUESTIONS: dict[str, Fold] = {
    "count": _about(Count),
    "exists": _exists,
    "no_such": _about(lambda described: Exists(described, denied=True)),
    "value_of": _value,
    "compare_counts": _compared,
    "more": _signed(">"),
    "fewer": _signed("<"),
    "at_least": _signed(">="),
    "at_most": _signed("<="),
    "just": _signed("="),
    "same_number": lambda bindings: _compared(bindings, "="),
    "compare_number": _number,
    "count_difference": _count_difference,
    "mostly": _mostly,
    "shared_by_most": _about(SharedByMost),
    "most_common": _most_common,
    "least_so": lambda _: (Binding("least", True),),
    "least_often": lambda _: (Binding("least", True),),
    "values_listed": _occurring(counted=False),
    "values_counted": _occurring(counted=True),
    "same_value": _same_value,
    "unlike": lambda bindings: _alike(bindings, denied=True),
    "holds": as_held,
    "difference": _pair(Difference),
    "alike": _pair(lambda first, second: Difference(first, second, alike=True)),
    "consequence": _consequence,
    "with_it": _with_it,
    "each_other": _each_other,
    "the_only": _the_only,
    "choice": _choice,
    "in_few": _in_few,
    "together_made": _together,
    "shown_on": _single(Describe),
    "completing": _completing,
    "together": _together,
    "no_group": _no_group,
    "group_denied": _no_group,
    "group_exists": _groups("exists"),
    "group_counted": _groups("count"),
    "groups_listed": _groups("which"),
    "describe": _single(Describe),
    "place": _single(lambda one: Describe(one, place=True)),
    "which": _about(Which),
    "class_is": _class_is,
    "class_denied": lambda bindings: _of_class(bindings, denied=True),
    "class_asked": lambda _: as_query(WhichClass()),
    "class_made": lambda bindings: _of_class(bindings, denied=False),
    "to_exist": _about(Exists),
}
"""Question → what its bindings come to."""
