"""What would have to change for another class, and what a scene differs from it by."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache

from seewhy.dialogue.answer import AnswerType, Changes
from seewhy.domain.domain import Domain
from seewhy.knowledge.change import Change, ChangeFinder
from seewhy.knowledge.justification import Node
from seewhy.knowledge.scene import FeatureVector

__all__ = ["Ways", "difference"]

_LISTED = 3
_ALL = 64  # what a finder looks at
_REMEMBERED = 20_000


class Ways:
    """The smallest changes that make a scene one of another class.

    Parameters
    ----------
    domain : Domain
    finder : ChangeFinder
    why_class : callable
        Why a scene is of a class: what a change needs is told of it.
    """

    def __init__(
        self,
        domain: Domain,
        finder: ChangeFinder,
        why_class: Callable[[FeatureVector, str], Node],
    ) -> None:
        self.domain = domain
        self._finder = finder
        self._why_class = why_class
        self._nearest = lru_cache(maxsize=_REMEMBERED)(self._one_more_than_listed)

    def _one_more_than_listed(self, vector: FeatureVector, asked: str) -> tuple[Change, ...]:
        return self._finder.smallest(vector, asked, limit=_LISTED + 1)

    def smallest(self, vector: FeatureVector, asked: str) -> tuple[Change, ...]:
        """Return the cheapest changes, at most those that an answer lists."""
        return self._nearest(vector, asked)[:_LISTED]

    def change(self, vector: FeatureVector, asked: str) -> AnswerType:
        """Return the answer what would have to change, and whether other ways are as small."""
        nearest = [change for change in self._nearest(vector, asked) if change.changes]
        listed = tuple(
            tuple((change.feature, change.after) for change in alternative.changes)
            for alternative in nearest[:_LISTED]
        )
        if not listed:
            return AnswerType("no_change")
        return AnswerType("change", changes=listed, has_more=len(nearest) > _LISTED)

    def difference(self, vector: FeatureVector, asked: str) -> AnswerType:
        """What the axioms ask of a change, without what only other scenes make go with it."""
        listed = dict.fromkeys(
            self._needed(change, asked) for change in self.smallest(vector, asked)
        )
        kind = difference(self.domain, tuple(filter(None, listed)))
        if len(self._nearest(vector, asked)) <= _LISTED:
            return kind
        others = self._finder.smallest(vector, asked, limit=_ALL)[_LISTED:]
        return replace(
            kind, has_more=any(self._needed(change, asked) not in listed for change in others)
        )

    def _needed(self, change: Change, asked: str) -> Changes:
        """The part of a change that the class rests on; all of it where that is none."""
        features = self._why_class(change.vector, asked).features()
        pairs = tuple((changed.feature, changed.after) for changed in change.changes)
        return tuple(pair for pair in pairs if pair[0] in features) or pairs


def difference(domain: Domain, alternatives: tuple[Changes, ...]) -> AnswerType:
    """Return the answer that a scene differs from a class by one of these changes."""
    if not alternatives:
        return AnswerType("no_difference")
    changed = {feature for change in alternatives for feature, _ in change}
    return AnswerType("difference", tuple(f for f in domain.features if f in changed), alternatives)
