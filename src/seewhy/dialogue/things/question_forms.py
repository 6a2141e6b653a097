"""What the questions of the grammar come to: queries about a picture's things."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

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

__all__ = ["QUESTIONS", "FollowUp", "Wanted"]

Wanted = bool | int | HasValue | None
"""An answer that a question speaks of: yes or no, a number, a value."""


@dataclass(frozen=True)
class FollowUp:
    """A question about the answer before: why, why not, what change, what if, and of others.

    ``wanted`` is the other answer; ``instead`` what is to be put in the place of what the question
    before asked about. With ``query`` it names the answer itself: "why is there no red cube?".
    """

    asks: str
    wanted: Wanted = None
    instead: Description | Reference | None = None
    query: Query | None = None
    supposed: Condition | None = None
    """What is supposed of ``instead``, in "what if the ball were red?"; None: that it is gone."""


def _query(query: Query) -> Bindings:
    return (Binding("query", query),)


def _descriptions(bindings: Bindings) -> list[Description]:
    found = meanings(bindings, "described")
    return [described for described in found if isinstance(described, Description)]


def _references(bindings: Bindings) -> tuple[Reference, ...]:
    found = meanings(bindings, "one")
    return tuple(one for one in found if isinstance(one, Reference))


def _conditions(bindings: Bindings) -> tuple[Condition, ...]:
    return tuple(meanings(bindings, "condition"))  # type: ignore[arg-type]


def _feature(bindings: Bindings) -> str | None:
    """The feature that is asked for; None where several are named."""
    named = set(meanings(bindings, "feature"))
    return str(named.pop()) if len(named) == 1 else None


def _described(bindings: Bindings) -> Description:
    found = _descriptions(bindings)
    them = meanings(bindings, "them")
    if them and isinstance(them[0], Description):
        return _of_them(them[0], _conditions(bindings))
    return (found[0] if found else Description(many=True)).also(*_conditions(bindings))


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
    return lambda bindings: _query(make(settled(_described(bindings))))


def _exists(bindings: Bindings) -> Bindings:
    if meanings(bindings, "query"):
        return bindings
    return _query(Exists(settled(_described(bindings))))


def _value(bindings: Bindings) -> Bindings | None:
    feature, ones = _feature(bindings), _references(bindings)
    return None if feature is None or len(ones) != 1 else _query(ValueOf(feature, ones[0]))


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
    (condition,) = _conditions(bindings)
    return (Binding("short", condition),) if isinstance(condition, HasValue) else None


def _compared(bindings: Bindings, sign: str | None = None) -> Bindings | None:
    kinds = _two_kinds(bindings)
    if len(kinds) != 2:
        return None
    first, second = map(settled, kinds)
    signs = meanings(bindings, "sign")
    return _query(CompareCounts(sign or str(signs[0]), first, second))


def _number(bindings: Bindings) -> Bindings | None:
    number, signs = meanings(bindings, "number")[0], meanings(bindings, "sign")
    if not isinstance(number, int):
        return None
    sign = str(signs[0]) if signs else "="
    return _query(CompareNumber(sign, settled(_described(bindings)), number))


def _count_difference(bindings: Bindings) -> Bindings:
    first, second = map(settled, _descriptions(bindings))
    return _query(CountDifference(str(meanings(bindings, "sign")[0]), first, second))


def _mostly(bindings: Bindings) -> Bindings | None:
    conditions, described = _conditions(bindings), _descriptions(bindings)
    if not conditions or len(described) != 1:
        return None
    return _query(Most(settled(described[0]), all_of(conditions)))


def _most_common(bindings: Bindings) -> Bindings | None:
    feature = _feature(bindings)
    if feature is None:
        return None
    least = bool(meanings(bindings, "least"))
    return _query(MostCommon(settled(_described(bindings)), feature, least))


def _occurring(*, counted: bool) -> Fold:
    def fold(bindings: Bindings) -> Bindings | None:
        feature = _feature(bindings)
        if feature is None:
            return None
        return _query(Occurring(settled(_described(bindings)), feature, counted))

    return fold


def _signed(sign: str) -> Fold:
    return lambda _: (Binding("sign", sign),)


def _same_value(bindings: Bindings) -> Bindings | None:
    if meanings(bindings, "query"):
        return bindings
    return _alike(bindings, denied=False)


def _alike(bindings: Bindings, *, denied: bool) -> Bindings | None:
    feature, ones = _feature(bindings), _references(bindings)
    if len(ones) == 1 and ones[0].which is References.EVERY:
        ones = (ones[0], ones[0])
    if feature is None or len(ones) != 2:
        return None
    return _query(SameValue(feature, ones[0], ones[1], denied))


def _holds(bindings: Bindings) -> Bindings | None:
    if meanings(bindings, "query"):
        return bindings
    conditions, ones = _conditions(bindings), _references(bindings)
    features = set(meanings(bindings, "feature"))
    of_another = any(isinstance(c, HasValue) and features - {c.feature} for c in conditions)
    if not conditions or not ones or of_another:
        return None
    return _query(Holds(ones, all_of(conditions)))


def _each_other(bindings: Bindings) -> Bindings | None:
    """Whether several things stand to each other in some way: each of them to every other."""
    ones, relations = _references(bindings), meanings(bindings, "relation")
    if len(ones) == 2 and all(one.which is References.THE for one in ones):
        return _query(Holds(ones[:1], Related(str(relations[0]), ones[1])))
    if len(ones) != 1 or ones[0].which is not References.EVERY:
        return None
    return _query(Holds(ones, Related(str(relations[0]), ones[0])))


def _choice(bindings: Bindings) -> Bindings | None:
    """Which of two values a thing has: "is the ball red or blue?"."""
    ones, conditions = _references(bindings), _conditions(bindings)
    features = {c.feature for c in conditions if isinstance(c, HasValue)}
    if len(ones) != 1 or len(features) != 1 or ones[0].which is not References.THE:
        return None
    return _query(ValueOf(features.pop(), ones[0]))


def _pair(make: Callable[[Reference, Reference], Query]) -> Fold:
    def fold(bindings: Bindings) -> Bindings | None:
        ones = _each(_references(bindings))
        if len(ones) == 1 and ones[0].which is References.EVERY:
            ones = (ones[0], ones[0])  # all of them beside each other
        return _query(make(*ones)) if len(ones) == 2 else None

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
    return lambda bindings: _query(make(_references(bindings)[0]))


def _consequence(bindings: Bindings) -> Bindings | None:
    ones, conditions = _references(bindings), _conditions(bindings)
    about = meanings(bindings, "about")
    if len(ones) != 1:
        return None
    to = about[0] if about and isinstance(about[0], Reference) else None
    return _query(Consequence(ones[0], all_of(conditions) if conditions else None, to))


def _with_it(bindings: Bindings) -> Bindings:
    return (Binding("about", _references(bindings)[0]),)


def _completing(bindings: Bindings) -> Bindings | None:
    named = meanings(bindings, "group")
    return _query(Completing(_references(bindings), str(named[0]) if named else ""))


def _no_group(bindings: Bindings) -> Bindings:
    return (*bindings, Binding("denied", True))


def _together(bindings: Bindings) -> Bindings | None:
    named = meanings(bindings, "group")
    denied = bool(meanings(bindings, "denied"))
    return _query(Together(str(named[0]), _references(bindings), denied))


def _groups(asks: str) -> Fold:
    def fold(bindings: Bindings) -> Bindings:
        group = str(meanings(bindings, "group")[0])
        return _query(Groups(group, asks, denied=bool(meanings(bindings, "denied"))))

    return fold


def _follow(asks: str) -> Fold:
    def fold(bindings: Bindings) -> Bindings:
        wanted = meanings(bindings, "wanted")
        other: list[Description | Reference] = [*_references(bindings), *_descriptions(bindings)]
        follow_up = FollowUp(
            asks,
            wanted=wanted[-1] if wanted else None,  # type: ignore[arg-type]
            instead=other[0] if other else None,
        )
        return (Binding("follow_up", follow_up),)

    return fold


def _supposing(bindings: Bindings) -> Bindings:
    if meanings(bindings, "follow_up"):
        return bindings
    conditions = _conditions(bindings)
    follow_up = FollowUp(
        "what_if",
        instead=_references(bindings)[0],
        supposed=all_of(conditions) if conditions else None,
    )
    return (Binding("follow_up", follow_up),)


def _class_is(bindings: Bindings) -> Bindings | None:
    if meanings(bindings, "query"):
        return bindings
    return _of_class(bindings, denied=False)


def _of_class(bindings: Bindings, *, denied: bool) -> Bindings | None:
    labels = meanings(bindings, "class")
    return _query(ClassIs(str(labels[0]), denied)) if labels else None


def _why_no_class(bindings: Bindings) -> Bindings:
    label = str(meanings(bindings, "class")[-1])
    return (Binding("follow_up", FollowUp("why", query=ClassIs(label, denied=True))),)


def _change_to(bindings: Bindings) -> Bindings | None:
    """What would make something so that the question names."""
    query = meanings(bindings, "query")
    if query:
        wanted: Query = query[0]  # type: ignore[assignment]
    else:
        held = _holds(bindings)
        if held is None:
            return None
        wanted = held[0].meaning  # type: ignore[assignment]
    return (Binding("follow_up", FollowUp("change", wanted=True, query=wanted)),)


def _supposed(bindings: Bindings) -> Bindings | None:
    """What is supposed, of which it is asked later what would be."""
    if meanings(bindings, "follow_up"):
        return bindings
    ones = _references(bindings)
    return _supposing(bindings) if len(ones) == 1 else None


def _wanted(bindings: Bindings) -> Bindings | None:
    for role in ("wanted", "number", "condition"):
        if found := meanings(bindings, role):
            return (Binding("wanted", found[0]),)
    return None


def _so(wanted: bool) -> Fold:
    return lambda _: (Binding("wanted", wanted),)


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
    "holds": _holds,
    "difference": _pair(Difference),
    "alike": _pair(lambda first, second: Difference(first, second, alike=True)),
    "consequence": _consequence,
    "with_it": _with_it,
    "each_other": _each_other,
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
    "class_asked": lambda _: _query(WhichClass()),
    "class_made": lambda bindings: _of_class(bindings, denied=False),
    "class_instead": lambda _: (),
    "one_instead": lambda _: (),
    "why_no_class": _why_no_class,
    "why_class": lambda _: (Binding("follow_up", FollowUp("why", query=WhichClass())),),
    "how_sure": _follow("how_sure"),
    "change_to": _change_to,
    "to_exist": _about(Exists),
    "supposition": _supposed,
    "supposed_gone": _supposing,
    "contrast": _follow("contrast"),
    "why": _follow("why"),
    "why_not": _follow("why_not"),
    "change": _follow("change"),
    "instead": _follow("instead"),
    "what_if": _supposing,
    "without_it": _supposing,
    "wanted": _wanted,
    "yes": _so(True),
    "no": _so(False),
}
"""Question → what its bindings come to."""
