"""Answers about things as sentences."""

from __future__ import annotations

from seewhy.dialogue.things.evaluating import Fits, Obstacle, UnclearReferenceError, members
from seewhy.dialogue.things.following import compared_numbers
from seewhy.dialogue.things.outcome import Outcome
from seewhy.dialogue.things.query import (
    AnyOf,
    ClassIs,
    CompareCounts,
    CompareNumber,
    Completing,
    Concluded,
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
    Not,
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
from seewhy.dialogue.things.telling_following import (
    say_completing,
    say_consequence,
    say_groups,
    say_together,
)
from seewhy.dialogue.things.telling_tallies import say_tally
from seewhy.dialogue.things.wording import ThingWords, number_word
from seewhy.domain.wording import join_words, sentence

__all__ = ["tell", "tell_failure"]


def tell(query: Query, outcome: Outcome, words: ThingWords) -> str:
    """Return an answer as one or two sentences.

    Examples
    --------
    >>> from seewhy.data.thing_scene import thing_scene
    >>> from seewhy.dialogue.things.evaluating import Evaluation
    >>> from seewhy.dialogue.things.outcome import outcome_of
    >>> from seewhy.dialogue.things.query import HasValue
    >>> from seewhy.domain.domain import load_domain
    >>> things = load_domain("tabletop").things
    >>> red = Count(Description((HasValue("colour", "red"),), many=True))
    >>> scene = thing_scene(things, [{"colour": "red", "shape": "cube"}], relations={})
    >>> evaluation = Evaluation(scene, things)
    >>> tell(red, outcome_of(red, evaluation), ThingWords(evaluation))
    'There is one red thing: the red cube.'
    """
    if isinstance(query, Together | Completing):
        return sentence(_of_group(query, outcome, words))
    if outcome.value is None and not (isinstance(query, ValueOf) and outcome.fits):
        return sentence(f"I don't know: {_open(query, outcome, words)}")
    match query:
        case Which(described=described) if _is_one(described, outcome.fits[0]):
            return sentence(f"it is {words.names(list(members(outcome.fits[0].surely)))}")
        case Count(described=described) | Which(described=described):
            return sentence(_there_are(described, outcome.fits[0], words))
        case Exists(described=described):
            so = _yes(outcome.value)
            found = outcome.fits[0].surely
            return sentence(f"{so}: {_there_are(described, Fits(found, found), words)}")
        case CompareCounts(first=first, second=second):
            counts = [
                words.counted(fits.surely.bit_count(), described)
                for fits, described in zip(outcome.fits, (first, second), strict=True)
            ]
            verb = _are(outcome.fits[0].surely.bit_count())
            return sentence(f"{_yes(outcome.value)}: there {verb} {join_words(counts)}")
        case CountDifference() | Most() | SharedByMost() | MostCommon() | Occurring():
            return sentence(say_tally(query, outcome.value, words))
        case CompareNumber(described=described):
            return sentence(
                f"{_yes(outcome.value)}: {_there_are(described, outcome.fits[0], words)}"
            )
        case ValueOf(feature=feature, one=one):
            return sentence(_value(feature, one, outcome, words))
        case SameValue():
            return sentence(f"{_yes(outcome.value)}: {_both(query, words)}")
        case Holds():
            return sentence(f"{_yes(outcome.value)}, {_held(query, outcome, words)}")
        case Describe(one=one, place=place):
            return sentence(_described(one, words, place=place))
        case Difference():
            return sentence(_differing(query, outcome, words))
        case Consequence():
            return sentence(say_consequence(query, words))
        case Groups():
            return sentence(say_groups(query, words))
        case ClassIs():
            label = str(words.evaluation.scene.label)
            return sentence(f"{_yes(outcome.value)}, {words.things.whole.say(label)}")
        case WhichClass():
            return sentence(words.things.whole.say(str(outcome.value)))
    raise TypeError(f"must be a query, got {query!r}")


def _of_group(query: Together | Completing, outcome: Outcome, words: ThingWords) -> str:
    if words.evaluation.scene.conclusions is None:
        return "I don't know: nothing was concluded of the things"
    if isinstance(query, Completing):
        return say_completing(query, words)
    return say_together(query, outcome.value, words)


def tell_failure(failed: UnclearReferenceError, words: ThingWords) -> str:
    """Return that a question speaks of one thing, and there is none, or there are several.

    A thing that there is not is no answer: who asks is told, or asked which is meant.
    """
    description = failed.reference.description
    phrase = words.phrase(description, many=False)
    if failed.obstacle is Obstacle.NONE:
        return sentence(f"there is no {phrase}")
    found = list(members(failed.fits.surely or failed.fits.maybe))
    if failed.obstacle is Obstacle.UNKNOWN:
        known = f"it may be {join_words([words.name(n) for n in found], word='or')}"
        return sentence(f"I don't know which is the {phrase}: {known}" if found else "I don't know")
    count = number_word(len(found))
    return f"Which {phrase}? There are {count}: {words.names(found)}."


def _is_one(described: Description, fits: Fits) -> bool:
    """Whether a question asks which one a thing is, and it is one."""
    asked = described.selection is not None or any(isinstance(c, Is) for c in described.conditions)
    return asked and fits.surely.bit_count() == 1


def _yes(so: object) -> str:
    return "yes" if so else "no"


def _are(count: int) -> str:
    return "is" if count == 1 else "are"


def _there_are(described: Description, fits: Fits, words: ThingWords) -> str:
    found = list(members(fits.surely))
    said = f"there {_are(len(found))} {words.counted(len(found), described)}"
    if not found:
        return said.replace("there are no ", "there is no ").replace(
            words.phrase(described, many=True), words.phrase(described, many=False)
        )
    return f"{said}: {words.names(found)}"


def _value(feature: str, one: Reference, outcome: Outcome, words: ThingWords) -> str:
    scene = words.evaluation.scene
    if one.which is References.THE:
        number = words.evaluation.the(one)
        return words.clause(feature, str(outcome.value), words.name(number))
    parts = []
    for number in members(outcome.fits[0].surely):
        value = scene.values[feature][number]
        name = words.name(number)
        unknown = f"the {words.things.features[feature].name} of {name} is not known"
        parts.append(unknown if value is None else words.clause(feature, value, name))
    return (
        join_words(parts) if parts else f"there is no {words.phrase(one.description, many=False)}"
    )


def _both(query: SameValue, words: ThingWords) -> str:
    values = words.evaluation.scene.values[query.feature]
    return join_words(
        [
            words.clause(query.feature, str(values[number]), words.name(number))
            for number in compared_numbers(query, words.evaluation)
        ]
    )


def _held(query: Holds, outcome: Outcome, words: ThingWords) -> str:
    if (clause := _single_clause(query, outcome, words)) is not None:
        return clause
    if isinstance(query.condition, Is) and query.ones[0].which is References.EVERY:
        return _only(query.ones[0].description, query.condition.one, outcome, words)
    subjects = join_words([words.reference(reference) for reference in query.ones])
    if not outcome.value and any(reference.which is References.EVERY for reference in query.ones):
        return f"not {words.being(query.condition, subjects)}"
    if not outcome.value and any(reference.which is References.SOME for reference in query.ones):
        some = words.phrase(query.ones[0].description, many=False)
        return words.being(query.condition, f"no {some}")
    if outcome.value and len(query.ones) == 1:
        return words.being(query.condition, subjects)
    verb = "are" if len(query.ones) > 1 else "is"
    if isinstance(query.condition, AnyOf) and not outcome.value and len(query.ones) == 1:
        neither = [words.predicate(condition) for condition in query.condition.conditions]
        return f"{subjects} is neither {join_words(neither, word='nor')}"
    if isinstance(query.condition, Not) and not outcome.value and len(query.ones) == 1:
        return f"{subjects} is {words.predicate(query.condition.condition)}"
    denied = "" if outcome.value else "not "
    both = "both " if len(query.ones) > 1 and not outcome.value else ""
    return f"{subjects} {verb} {denied}{both}{words.predicate(query.condition)}"


def _only(kind: Description, one: Reference, outcome: Outcome, words: ThingWords) -> str:
    """Whether a thing is the only one of a kind; what is none of it is said to be none."""
    name, kind_said = words.reference(one), words.phrase(kind, many=False)
    is_one = words.evaluation.fits(kind).maybe >> words.evaluation.the(one) & 1
    if not is_one:
        return f"{name} is no {kind_said}"
    return f"{name} is {'' if outcome.value else 'not '}the only {kind_said}"


def _single_clause(query: Holds, outcome: Outcome, words: ThingWords) -> str | None:
    """What is concluded of one thing, in the clause that the domain has for it."""
    condition, so = query.condition, bool(outcome.value)
    if isinstance(condition, Not):
        condition, so = condition.condition, not so
    if len(query.ones) != 1 or query.ones[0].which is not References.THE:
        return None
    name = words.reference(query.ones[0])
    match condition:
        case Concluded(conclusion=conclusion):
            said = words.things.conclusions[conclusion]
            return (said.say if so else said.deny).replace("{it}", name)
        case HasValue(feature=feature, value=value) if (
            value in words.things.features[feature].behind
        ):
            seen = words.evaluation.scene.values[feature][words.evaluation.the(query.ones[0])]
            return words.clause(feature, str(seen), name) + (
                "" if so else words.denied(feature, value)
            )
        case Related(relation=relation, to=to) if not words.things.relations[relation].words:
            clause = words.things.relations[relation].say.format(name, words.reference(to))
            denied = clause.replace(" would ", " would not ", 1)
            return clause if so else denied if denied != clause else f"it is not so that {clause}"
    return None


def _described(one: Reference, words: ThingWords, *, place: bool) -> str:
    number = words.evaluation.the(one)
    scene = words.evaluation.scene
    name = words.name(number)
    if place:
        where = [
            f"{relation.words[0]} {words.names(found)}"
            for key, relation in words.things.relations.items()
            if relation.words
            and (found := [o for o in range(scene.count) if scene.related[key][o] >> number & 1])
        ]
        return f"{name} is {join_words(where)}" if where else f"{name} is by itself"
    clauses = [
        words.clause(feature, value, "it")
        for feature, values in scene.values.items()
        if (value := values[number]) is not None
    ]
    return f"it is {name}: {join_words(clauses)}" if clauses else f"nothing is known of {name}"


def _differing(query: Difference, outcome: Outcome, words: ThingWords) -> str:
    named = outcome.value if isinstance(outcome.value, tuple) else ()
    numbers = compared_numbers(query, words.evaluation)
    scene = words.evaluation.scene
    if not named:
        return "they have nothing in common" if query.alike else "they differ in nothing"
    parts = []
    for key in map(str, named):
        if query.alike:
            parts.append(words.clause(key, str(scene.values[key][numbers[0]]), "each"))
            continue
        values = [(str(scene.values[key][number]), words.name(number)) for number in numbers]
        parts.append(join_words([words.clause(key, value, name) for value, name in values]))
    features = join_words([words.things.features[str(key)].name for key in named])
    return f"they {'share' if query.alike else 'differ in'} {features}: {join_words(parts)}"


def _open(query: Query, outcome: Outcome, words: ThingWords) -> str:
    """What is not known."""
    if isinstance(query, ClassIs | WhichClass):
        return f"it is not decided of which class {words.things.whole.subject} is"
    unsure = 0
    for fits in outcome.fits:
        unsure |= fits.maybe & ~fits.surely
    if isinstance(query, ValueOf | SameValue):
        values = words.evaluation.scene.values[query.feature]
        numbers = (
            compared_numbers(query, words.evaluation)
            if isinstance(query, SameValue)
            else (words.evaluation.the(query.one),)
        )
        unsure = sum(1 << number for number in set(numbers) if values[number] is None)
        name = words.things.features[query.feature].name
        return f"the {name} of {words.names(list(members(unsure)))} is not known"
    if isinstance(query, Consequence | Groups):
        return "that does not follow from what is seen"
    if isinstance(query, Count | Exists) and outcome.fits:
        low, high = outcome.fits[0].surely.bit_count(), outcome.fits[0].maybe.bit_count()
        between = f"at least {number_word(low)} and at most {number_word(high)}"
        return f"there are {between}; not enough is seen of {words.names(list(members(unsure)))}"
    if not unsure:
        return "not enough is seen of the things"
    return f"not enough is seen of {words.names(list(members(unsure)))}"
