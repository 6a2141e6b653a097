"""Answers about answers: why, why not another, what would have to be otherwise."""

from __future__ import annotations

import re
from collections.abc import Iterator

from seewhy.dialogue.things.changing import smallest_change
from seewhy.dialogue.things.evaluating import UnclearReferenceError, members
from seewhy.dialogue.things.follow_up_forms import Wanted
from seewhy.dialogue.things.following import consequences
from seewhy.dialogue.things.outcome import Value
from seewhy.dialogue.things.query import (
    ClassIs,
    CompareCounts,
    CompareNumber,
    Concluded,
    Condition,
    Consequence,
    Count,
    CountDifference,
    Describe,
    Description,
    Exists,
    Groups,
    HasValue,
    Holds,
    Is,
    Most,
    Not,
    PartOf,
    Query,
    Reference,
    Together,
    Which,
)
from seewhy.dialogue.things.reasons import Reasons
from seewhy.dialogue.things.reasons_following import of_together, why_concluded
from seewhy.dialogue.things.saying_edits import would
from seewhy.dialogue.things.telling import tell_failure
from seewhy.dialogue.things.wording import ThingWords, number_word
from seewhy.domain.wording import join_words, sentence
from seewhy.knowledge.justification import Basis, Node

__all__ = ["tell_change", "tell_contrast", "tell_why", "tell_why_not"]

_MOST_TOLD = 3
_NO_OTHERS = "There are no other things."
_PRESENCE = re.compile(r"(\w+)\(\1\d+\)")
"""A literal that says that a thing is there."""
_TOLD = (Basis.FEATURE, Basis.AXIOM, Basis.REASONS)
_TOLD_OF_THINGS = (*_TOLD, Basis.COMPARISON)


def tell_why(justification: Node) -> str:
    """Return the reasons of an answer as sentences.

    Examples
    --------
    >>> red = Node("colour(thing1,red)", "it is red", Basis.FEATURE)
    >>> cube = Node("thing1", "there is the red cube", Basis.JOINTLY, children=(red,))
    >>> tell_why(Node("count", "There is one red thing.", Basis.JOINTLY, children=(cube,)))
    'There is the red cube: it is red.'
    """
    return " ".join(map(sentence, _said(justification))) or sentence(justification.text)


def _reason(node: Node) -> str:
    """A clause; of what was concluded, with what it was concluded from, where that is not much."""
    grounds = _grounds(node)
    if not 0 < len(grounds) < _MOST_TOLD:
        return node.text
    return f"{node.text}, since {join_words(grounds)}"


def _grounds(node: Node) -> list[str]:
    """What something was concluded from; of several reasons for it, each."""
    if node.basis is Basis.REASONS:
        return list(dict.fromkeys(text for child in node.children for text in _grounds(child)))
    if node.basis is not Basis.AXIOM:
        return []
    return [child.text for child in node.children if child.holds and child.basis in _TOLD]


def _leaves(node: Node) -> list[str]:
    """The reasons below something that is so; the axiom itself, where it tells more than they."""
    if node.basis is Basis.REASONS:
        return list(dict.fromkeys(text for child in node.children for text in _leaves(child)))
    if node.axiom is None:
        return [_reason(child) for child in node.children if child.basis in _TOLD_OF_THINGS]
    # That things differ goes without saying; how many there are does not.
    counted = any(child.basis is Basis.COMPARISON and child.children for child in node.children)
    found = [] if counted else [_reason(c) for c in node.children if c.basis in _TOLD]
    return found or [node.axiom.text]


def _denied(node: Node) -> str:
    """Why something is not so: what of the axiom that comes nearest fails, and what was seen."""
    if node.basis is Basis.FEATURE or not node.children:
        return node.text
    failing = [child for child in node.children[0].children if not child.holds]
    grounds = [_failing(child) for child in failing[:_MOST_TOLD]]
    return f"{node.text}: {'; '.join(filter(None, grounds))}" if any(grounds) else node.text


def _failing(node: Node) -> str:
    """A condition that fails; that things are there goes without saying."""
    seen = (
        leaf.text
        for leaf in node.walk()
        if leaf.basis is Basis.FEATURE and not _PRESENCE.fullmatch(leaf.literal)
    )
    grounds = list(dict.fromkeys(seen))[:_MOST_TOLD]
    if not grounds or node.basis is Basis.FEATURE:
        return node.text
    return f"{node.text}, since {join_words(grounds)}"


def _said(justification: Node) -> Iterator[str]:
    there = [node for node in justification.children if node.basis is not Basis.ABSENCE]
    for node in there:
        if not node.holds:
            yield _denied(node)
            continue
        leaves = _leaves(node)
        apart = any(", since " in leaf for leaf in leaves)
        told = "; ".join(leaves) if apart else join_words(leaves)
        yield f"{node.text}: {told}" if leaves else node.text
    if not there or justification.text.startswith("No"):
        for node in justification.children:
            if node.basis is Basis.ABSENCE and node.children:
                yield f"{node.text}: {'; '.join(child.text for child in node.children)}"


def tell_why_not(query: Query, value: Value, wanted: Wanted, words: ThingWords) -> str:
    """Return why an answer is not another one: what is nearest to making it so."""
    if (
        wanted is not None
        and wanted == value
        and isinstance(wanted, bool) == isinstance(value, bool)
    ):
        return sentence(f"but it is so: {_short(query, words)}")
    if wanted is None and value is True and isinstance(query, CompareNumber | CompareCounts):
        return sentence(f"but it is so: {_counted(query, words)}")
    if isinstance(wanted, HasValue):
        return tell_why(Reasons(words.evaluation, words).tree(query, ""))
    match query:
        case Count(described=described) | Which(described=described):
            fewer = isinstance(wanted, int) and isinstance(value, int) and wanted < value
            return _why_no_more(described, words, fewer=fewer)
        case Exists(described=described):
            return _why_no_more(described, words, fewer=bool(value))
        case CompareNumber(described=described, number=number):
            count = words.evaluation.fits(described).surely.bit_count()
            return _why_no_more(described, words, fewer=count > number)
        case CompareCounts() | CountDifference():
            few = _too_few(query, wanted, value, words)
            nearest = _nearest(few, words, to=f"{words.counted(1, few)} more")
            return f"{sentence(_counted(query, words))} {nearest}"
        case Holds(ones=ones, condition=condition) if not isinstance(condition, Is):
            reasons = Reasons(words.evaluation, words)
            leaves = [
                reasons.judged(number, condition)
                for reference in ones
                for number in reasons.numbers(reference)
            ]
            return " ".join(sentence(_denied(leaf)) for leaf in leaves)
        case Together(denied=denied) if denied is bool(value):
            told = of_together(query, words)
            return " ".join(sentence(_denied(leaf)) for leaf in told)
    return tell_why(Reasons(words.evaluation, words).tree(query, ""))


def tell_contrast(
    query: Query, instead: Description | Reference | None, words: ThingWords
) -> str | None:
    """Return why an answer is not about a thing that was expected; None where it could not be."""
    if not isinstance(instead, Reference):
        return None
    try:
        numbers = Reasons(words.evaluation, words).numbers(instead)
    except UnclearReferenceError as failed:
        return tell_failure(failed, words)
    told = [_contrasted(query, number, words) for number in numbers]
    return " ".join(filter(None, told)) or None


def _contrasted(query: Query, number: int, words: ThingWords) -> str | None:
    """Why what was asked is not so of a thing; that it is, where it is."""
    reasons, name = Reasons(words.evaluation, words), words.name(number)
    match query:
        case Holds(ones=(kind,), condition=Is()):
            described = kind.description
        case Holds(condition=condition):
            return _of_condition(condition, number, words)
        case Consequence():
            return _not_following(query, number, words)
        case Most(described=described, condition=condition):
            described = described.also(condition)
        case Groups(group=group):
            return _of_condition(PartOf(group), number, words)
        case (
            Count(described=described)
            | Which(described=described)
            | Exists(described=described)
            | CompareNumber(described=described)
        ):
            pass
        case Describe(one=one) if one.description.selection is not None:
            described = one.description
        case _:
            return None
    if words.evaluation.fits(described).surely >> number & 1:
        so = join_words(reasons.so(number, described))
        return sentence(f"but {name} is one{f': {so}' if so else ''}")
    failing = [
        condition
        for condition in described.conditions
        if not words.evaluation.holds(condition).surely >> number & 1
    ]
    if failing:
        return " ".join(sentence(_denied(reasons.judged(number, part))) for part in failing)
    left_out = reasons.excluded(number, described)
    grounds = join_words([child.text for child in left_out.children])
    return sentence(f"{left_out.text}: {grounds}" if grounds else left_out.text)


def _of_condition(condition: Condition, number: int, words: ThingWords) -> str:
    judged = Reasons(words.evaluation, words).judged(number, condition)
    if words.evaluation.holds(condition).surely >> number & 1:
        return sentence(f"but it is so: {judged.text}")
    return sentence(_denied(judged))


def _not_following(query: Consequence, number: int, words: ThingWords) -> str | None:
    """Why what follows of others does not follow of a thing."""
    follows = consequences(query, words.evaluation)
    if follows is None:
        return None
    things = words.things
    true = [follow.conclusion for follow in follows if follow.number == number]
    if true:
        clauses = [things.conclusions[key].say.replace("{it}", words.name(number)) for key in true]
        return sentence(f"but it is so: {join_words(clauses)}")
    taken = words.evaluation.the(query.one)
    if number == taken and query.supposed is None:
        return sentence(f"{words.name(number)} is what would be taken away")
    for key, relation in things.relations.items():
        if relation.removed is not None and query.supposed is None:
            return sentence(_denied(why_concluded(key, (number, taken), words)))
    return None


def _short(query: Query, words: ThingWords) -> str:
    return Reasons(words.evaluation, words).tree(query, "the answer is that").text


def _why_no_more(described: Description, words: ThingWords, *, fewer: bool) -> str:
    """Those that are so; or the things that lack least, and what they lack."""
    evaluation = words.evaluation
    fits = evaluation.fits(described)
    reasons = Reasons(evaluation, words)
    if fewer:
        return " ".join(
            sentence(f"{words.name(number)} is one: {join_words(reasons.so(number, described))}")
            for number in members(fits.surely)
        )
    nearest = _nearest(described, words)
    told = f"{sentence(_there_are(described, words))} " if nearest != _NO_OTHERS else ""
    return f"{told}{nearest}"


def _there_are(described: Description, words: ThingWords) -> str:
    count = words.evaluation.fits(described).surely.bit_count()
    return f"there {'is' if count == 1 else 'are'} {words.counted(count, described)}"


def _counted(query: CompareNumber | CompareCounts | CountDifference, words: ThingWords) -> str:
    """How many there are of what was counted."""
    if isinstance(query, CompareNumber):
        return _there_are(query.described, words)
    second = words.evaluation.fits(query.second).surely.bit_count()
    return f"{_there_are(query.first, words)} and {words.counted(second, query.second)}"


def _too_few(
    query: CompareCounts | CountDifference, wanted: Wanted, value: Value, words: ThingWords
) -> Description:
    """Of the two that were counted, the one of which more would make the other answer."""
    first, second = query.first, query.second
    counts = [words.evaluation.fits(side).surely.bit_count() for side in (first, second)]
    if isinstance(query, CountDifference):
        lower = isinstance(wanted, int) and isinstance(value, int) and wanted < value
        return second if lower != (query.sign == "<") else first
    if query.sign == "=":
        return first if counts[0] < counts[1] else second
    return first if query.sign.startswith(">") else second


def _nearest(described: Description, words: ThingWords, *, to: str = "one more") -> str:
    """The things that lack least of being described so, and what they lack."""
    evaluation = words.evaluation
    fits = evaluation.fits(described)
    reasons = Reasons(evaluation, words)
    lacking: list[tuple[int, int, str]] = []
    for number in members(evaluation.everything & ~fits.surely):
        missing = reasons.missing(number, described)
        lacking.append((len(missing), number, join_words(missing)))
    if not lacking:
        return _NO_OTHERS
    least = min(lacking)[0]
    nearest = [said for count, _, said in lacking if count == least]
    several = f"; so it is with {number_word(len(nearest) - _MOST_TOLD)} more"
    more = several if len(nearest) > _MOST_TOLD else ""
    # "No other" comes nearer than these.
    return f"Nearest to {to}: {'; '.join(nearest[:_MOST_TOLD])}{more}."


def tell_change(query: Query, value: Value, wanted: Wanted, words: ThingWords) -> str:
    """Return the smallest change of the scene after which an answer is another one."""
    goal = wanted
    if goal is None:
        if not isinstance(value, bool):
            return "Say what the answer is to be, as in 'what would make the answer two?'."
        goal = not value
    aim = goal.value if isinstance(goal, HasValue) else goal
    if aim == value and isinstance(aim, bool) == isinstance(value, bool):
        return "Nothing: that is the answer."
    found = smallest_change(query, aim, words)
    said_aim = _aim(goal, words)
    untried = " One thing more was not tried." if found.without_additions else ""
    if found.changes is None:
        if not found.looked_at:
            return "There are more changes than can be looked at."
        count = number_word(found.looked_at)
        several = f"up to {count} things" if found.looked_at > 1 else f"{count} thing"
        return f"{sentence(f'no change of {several} {_makes(said_aim)}')}{untried}"
    others = f" {number_word(found.others).capitalize()} other" if found.others else ""
    ways = f"{others} change{'s' * (found.others > 1)} as small would do, too." if others else ""
    would = _then(query, words) if aim is True else None
    would = would or f"the answer would be {said_aim}"
    told = sentence(f"if {join_words(found.changes)}, {would}")
    return f"{told}{ways}{untried}"


def _then(query: Query, words: ThingWords) -> str | None:
    """What would be so, in the clause that the domain has for it; None where it has none."""
    match query:
        case ClassIs(label=label, denied=False):
            return words.things.whole.say(label, be="would be")
        case Holds(ones=(one,), condition=Concluded(conclusion=conclusion)):
            said = words.things.conclusions[conclusion].say
            return would(said).replace("{it}", words.reference(one))
        case Holds(ones=(one,), condition=Not(condition=Concluded(conclusion=conclusion))):
            denied = words.things.conclusions[conclusion].deny
            return would(denied).replace("{it}", words.reference(one))
    return None


def _makes(aim: str) -> str:
    return f"makes the answer {aim}; larger ones were not looked for"


def _aim(goal: bool | int | HasValue, words: ThingWords) -> str:
    if isinstance(goal, HasValue):
        return words.value(goal.feature, goal.value)
    if isinstance(goal, bool):
        return "yes" if goal else "no"
    return number_word(goal)
