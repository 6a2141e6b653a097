"""Answers about answers: why, why not another, what would have to be otherwise."""

from __future__ import annotations

import re
from collections.abc import Iterator

from seewhy.dialogue.things.changing import smallest_change
from seewhy.dialogue.things.evaluating import members
from seewhy.dialogue.things.outcome import Value
from seewhy.dialogue.things.query import (
    CompareCounts,
    CompareNumber,
    Count,
    CountDifference,
    Description,
    Exists,
    HasValue,
    Holds,
    Query,
    Together,
    Which,
)
from seewhy.dialogue.things.question_forms import Wanted
from seewhy.dialogue.things.reasons import Reasons
from seewhy.dialogue.things.reasons_following import of_together
from seewhy.dialogue.things.wording import ThingWords, number_word
from seewhy.domain.wording import join_words, sentence
from seewhy.knowledge.justification import Basis, Node

__all__ = ["tell_change", "tell_why", "tell_why_not"]

_MOST_TOLD = 3
_NO_OTHERS = "There are no other things."
_PRESENCE = re.compile(r"(\w+)\(\1\d+\)")
"""A literal that says that a thing is there."""
_TOLD = (Basis.FEATURE, Basis.AXIOM)
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
    grounds = [child.text for child in node.children if child.holds and child.basis in _TOLD]
    if node.basis is not Basis.AXIOM or not 0 < len(grounds) < _MOST_TOLD:
        return node.text
    return f"{node.text}, since {join_words(grounds)}"


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
        leaves = [_reason(child) for child in node.children if child.basis in _TOLD_OF_THINGS]
        yield f"{node.text}: {join_words(leaves)}" if leaves else node.text
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
        case Holds(ones=ones, condition=condition):
            reasons = Reasons(words.evaluation, words)
            leaves = [
                reasons.judged(number, condition) for one in ones for number in reasons.numbers(one)
            ]
            return " ".join(sentence(_denied(leaf)) for leaf in leaves)
        case Together(denied=denied) if denied is bool(value):
            told = of_together(query, words)
            return " ".join(sentence(_denied(leaf)) for leaf in told)
    return tell_why(Reasons(words.evaluation, words).tree(query, ""))


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
    told = sentence(f"if {join_words(found.changes)}, the answer would be {said_aim}")
    return f"{told}{ways}{untried}"


def _makes(aim: str) -> str:
    return f"makes the answer {aim}; larger ones were not looked for"


def _aim(goal: bool | int | HasValue, words: ThingWords) -> str:
    if isinstance(goal, HasValue):
        return words.value(goal.feature, goal.value)
    if isinstance(goal, bool):
        return "yes" if goal else "no"
    return number_word(goal)
