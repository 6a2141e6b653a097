"""How many of several things are so, as sentences."""

from __future__ import annotations

from seewhy.dialogue.things.evaluating import members
from seewhy.dialogue.things.query import (
    Condition,
    CountDifference,
    Description,
    HasValue,
    Most,
    MostCommon,
    Not,
    Occurring,
    SharedByMost,
)
from seewhy.dialogue.things.tallies import half_shared, shared_by_most, tally
from seewhy.dialogue.things.wording import ThingWords, number_word
from seewhy.domain.wording import join_words
from seewhy.text.nouns import plural

__all__ = ["say_share", "say_tally"]


def say_tally(
    query: CountDifference | Most | SharedByMost | MostCommon | Occurring,
    value: object,
    words: ThingWords,
) -> str:
    """Return what a count of several things comes to."""
    if isinstance(query, CountDifference):
        return _difference(query, int(str(value)), words)
    if isinstance(query, Occurring):
        return _occurring(query, words)
    described = query.described
    there = words.evaluation.fits(described).surely
    if not there:
        nothing = f"there is no {words.phrase(described, many=False)}"
        return f"no: {nothing}" if isinstance(query, Most) else nothing
    if isinstance(query, Most):
        so = there & words.evaluation.holds(query.condition).surely
        tied = ", which is just half" if 2 * so.bit_count() == there.bit_count() else ""
        names = f": {words.names(list(members(so)))}" if so else ""
        said = say_share(so.bit_count(), described, query.condition, words)
        return f"{'yes' if value else 'no'}: {said}{tied}{names}"
    if isinstance(query, SharedByMost):
        return _shared(query, words)
    return _common(query, value, words)


def say_share(count: int, described: Description, condition: Condition, words: ThingWords) -> str:
    """Return of how many of some things something is so: "two of the three cubes are red"."""
    total = words.evaluation.fits(described).surely.bit_count()
    every = {1: "the one", 2: "both"}.get(total, f"all {number_word(total)}")
    things = words.phrase(described, many=total > 1)
    if count == total:
        return words.being(condition, f"{every} {things}", many=total > 1)
    if not count and total == 1:
        return words.being(Not(condition), f"the one {things}")
    of = f"of the {number_word(total)} {things}"
    if not count:
        return words.being(condition, f"{'neither' if total == 2 else 'none'} {of}")
    return words.being(condition, f"{number_word(count)} {of}", many=count > 1)


def _difference(query: CountDifference, more: int, words: ThingWords) -> str:
    kinds = (query.first, query.second)
    counts = [words.evaluation.fits(kind).surely.bit_count() for kind in kinds]
    listed = join_words(list(map(words.counted, counts, kinds)))
    second = words.phrase(query.second, many=True)
    if not more:
        return f"there are as many {words.phrase(query.first, many=True)} as {second}: {listed}"
    asked, other = ("more", "fewer") if query.sign == ">" else ("fewer", "more")
    first = words.phrase(query.first, many=abs(more) > 1)
    verb = "are" if abs(more) > 1 else "is"
    if more > 0:
        return f"there {verb} {number_word(more)} {asked} {first} than {second}: {listed}"
    said = f"there {verb} {number_word(-more)} {other} {first} than {second}"
    return f"{said}, and not {asked}: {listed}"


def _occurring(query: Occurring, words: ThingWords) -> str:
    counted = tally(query.feature, query.described, words.evaluation)
    if not counted:
        return f"there is no {words.phrase(query.described, many=False)}"
    among = "" if not query.described.conditions else f" among {_the(query.described, words)}"
    name = _feature(query.feature, words, many=len(counted) > 1)
    said = join_words([words.value(query.feature, value) for value in counted])
    verb = "are" if len(counted) > 1 else "is"
    return f"there {verb} {number_word(len(counted))} {name}{among}: {said}"


def _shared(query: SharedByMost, words: ThingWords) -> str:
    things = words.phrase(query.described, many=True)

    def shares(pairs: tuple[tuple[str, str], ...]) -> list[str]:
        return [
            say_share(
                tally(feature, query.described, words.evaluation)[value].surely.bit_count(),
                query.described,
                HasValue(feature, value),
                words,
            )
            for feature, value in pairs
        ]

    half = shares(half_shared(query, words.evaluation))
    halves = f"; just half: {join_words(half)}" if half else ""
    found = shares(shared_by_most(query, words.evaluation) or ())
    if not found:
        return f"no value is that of more than half of the {things}{halves}"
    return f"{join_words(found)}{halves}"


def _common(query: MostCommon, value: object, words: ThingWords) -> str:
    counted = tally(query.feature, query.described, words.evaluation)
    values = [value] if isinstance(value, str) else list(value) if isinstance(value, tuple) else []
    shares = [
        say_share(
            counted[common].surely.bit_count(),
            query.described,
            HasValue(query.feature, common),
            words,
        )
        for common in values
    ]
    name = _feature(query.feature, words, many=len(values) > 1)
    how = "least" if query.least else "most"
    kind = f"the {how} common {name} of {_the(query.described, words)}"
    said = join_words([words.value(query.feature, value) for value in values])
    if len(values) == 1:
        return f"{kind} is {said}: {shares[0]}"
    return f"{kind} are {said}, which tie: {join_words(shares)}"


def _the(described: Description, words: ThingWords) -> str:
    many = words.evaluation.fits(described).surely.bit_count() != 1
    return f"the {words.phrase(described, many=many)}"


def _feature(key: str, words: ThingWords, *, many: bool) -> str:
    """The name of a feature; of "number of symbols", the number is several."""
    name = words.things.features[key].name
    head, of, what = name.partition(" of ")
    return f"{plural(head)}{of}{what}" if many else name
