"""What follows as sentences: consequences, groups, what completes them."""

from __future__ import annotations

from math import comb

from seewhy.dialogue.things.following import (
    Follows,
    class_that_follows,
    completions,
    consequences,
    group_of,
    numbers_of,
)
from seewhy.dialogue.things.query import Completing, Consequence, Groups, Together
from seewhy.dialogue.things.saying_edits import would
from seewhy.dialogue.things.wording import ThingWords, number_word
from seewhy.domain.conclusions import Group
from seewhy.domain.wording import join_words
from seewhy.text.nouns import with_article

__all__ = ["no_group", "say_completing", "say_consequence", "say_groups", "say_together"]

_MOST_LISTED = 12


def say_consequence(query: Consequence, words: ThingWords) -> str:
    """Return what comes true where something is otherwise."""
    found = consequences(query, words.evaluation) or ()
    label = class_that_follows(query, words.evaluation)
    then = [] if label is None else [words.things.whole.say(label, be="would be")]
    if not found and not then:
        if query.to is not None:
            return f"nothing would happen to {words.reference(query.to)}"
        removed = [r.removed for r in words.things.relations.values() if r.removed is not None]
        if query.supposed is None and removed:
            return words.things.conclusions[removed[0]].say.replace("{it}", "nothing")
        return "nothing else would follow"
    told = [_come_true(key, found, words) for key in _keys(found, ends=False)]
    told += [_end(key, found, words) for key in _keys(found, ends=True)]
    return join_words([*told, *then])


def _keys(found: tuple[Follows, ...], *, ends: bool) -> list[str]:
    return list(dict.fromkeys(follow.conclusion for follow in found if follow.ends is ends))


def _come_true(key: str, found: tuple[Follows, ...], words: ThingWords) -> str:
    numbers = [follow.number for follow in found if follow.conclusion == key and not follow.ends]
    clause = would(words.things.conclusions[key].say)
    return clause.replace("{it}", words.names(numbers))


def _end(key: str, found: tuple[Follows, ...], words: ThingWords) -> str:
    numbers = [follow.number for follow in found if follow.conclusion == key and follow.ends]
    clause = would(words.things.conclusions[key].deny)
    return clause.replace("{it}", words.names(numbers))


def say_groups(query: Groups, words: ThingWords) -> str:
    """Return whether there are such groups, how many, or which."""
    group = words.things.groups[query.group]
    found = words.evaluation.scene.groups[query.group]
    if not found:
        there = f"there is no {group.one}"
    else:
        noun = group.one if len(found) == 1 else group.many
        listed = "; ".join(words.names(numbers) for numbers in found[:_MOST_LISTED])
        more = len(found) - _MOST_LISTED
        others = f"; and {number_word(more)} more" if more > 0 else ""
        verb = "is" if len(found) == 1 else "are"
        there = f"there {verb} {number_word(len(found))} {noun}: {listed}{others}"
    if query.asks != "exists":
        return there
    return f"{'yes' if bool(found) is not query.denied else 'no'}: {there}"


def no_group(group: Group, words: ThingWords) -> str:
    """Return that things can be taken in so many ways, and none of them is such a group."""
    count = comb(words.evaluation.everything.bit_count(), group.size)
    many = words.things.many
    if not count:
        return f"{with_article(group.one)} takes {number_word(group.size)} {many}"
    ways = "the one way" if count == 1 else f"the {number_word(count)} ways"
    return (
        f"none of {ways} to take {number_word(group.size)} {many} makes {with_article(group.one)}"
    )


def say_together(query: Together, value: object, words: ThingWords) -> str:
    """Return whether some things are such a group."""
    group = words.things.groups[query.group]
    numbers = numbers_of(query.ones, words.evaluation)
    if value is None:
        return _wrong_size(group, group.size, numbers, words)
    so = bool(value) is not query.denied
    said = (group.say if so else group.deny).replace("{them}", words.names(numbers))
    return f"{'yes' if value else 'no'}: {said}"


def _wrong_size(group: Group, wanted: int, numbers: tuple[int, ...], words: ThingWords) -> str:
    count = len(numbers)
    takes = f"{with_article(group.one)} takes {number_word(group.size)} {words.things.many}"
    besides = "" if wanted == group.size else f", {number_word(wanted)} of them given"
    noun = words.things.one if count == 1 else words.things.many
    return f"{takes}{besides}, and these are {number_word(count)} {noun}"


def say_completing(query: Completing, words: ThingWords) -> str:
    """Return which thing makes such a group with others."""
    group = group_of(query, words.things.groups)
    numbers = numbers_of(query.ones, words.evaluation)
    if len(numbers) != group.size - 1:
        return _wrong_size(group, group.size - 1, numbers, words)
    found = completions(query, words.evaluation)
    if found is None:
        return "I don't know: there are too many ways to complete them"
    them = words.names(numbers)
    if not found:
        return f"no {words.things.one} makes {with_article(group.one)} with {them}"
    there = [completion.number for completion in found if completion.number is not None]
    if there:
        verb = "make" if len(there) > 1 else "makes"
        return f"{words.names(there)} {verb} {with_article(group.one)} with {them}"
    likes = [
        with_article(words.described(completion.values)) for completion in found[:_MOST_LISTED]
    ]
    return (
        f"{join_words(likes, word='or')} would make {with_article(group.one)} with {them}; there "
        "is none here"
    )
