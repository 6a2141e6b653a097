"""Why several things come to a count: each value, and the things that have it."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from seewhy.dialogue.things.evaluating import members
from seewhy.dialogue.things.query import HasValue, MostCommon, Occurring, SharedByMost
from seewhy.dialogue.things.tallies import half_shared, shared_by_most, tally
from seewhy.dialogue.things.telling_tallies import say_share
from seewhy.dialogue.things.wording import ThingWords
from seewhy.knowledge.justification import Basis, Node

__all__ = ["of_tally"]

Seen = Callable[[int, str], Node]
"""What was seen of a feature of a thing."""


def of_tally(
    query: MostCommon | Occurring | SharedByMost, words: ThingWords, seen: Seen
) -> Iterator[Node]:
    """Yield each value that counts, the one that most have first, with the things that have it."""
    if isinstance(query, SharedByMost):
        told = (
            *(shared_by_most(query, words.evaluation) or ()),
            *half_shared(query, words.evaluation),
        )
    else:
        told = tuple(
            (query.feature, value)
            for value in tally(query.feature, query.described, words.evaluation)
        )
    counted = [
        (feature, value, tally(feature, query.described, words.evaluation)[value].surely)
        for feature, value in told
    ]
    for feature, value, having in sorted(counted, key=lambda one: -one[2].bit_count()):
        condition = HasValue(feature, value)
        text = say_share(having.bit_count(), query.described, condition, words)
        children = tuple(seen(number, feature) for number in members(having))
        if having:
            yield Node(f"{feature}({value})", text, Basis.JOINTLY, children=children)
