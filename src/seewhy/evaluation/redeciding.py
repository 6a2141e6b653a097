"""Which feature holds the class back: decide again with annotated values in the place of seen."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from seewhy.dialogue.reply import UNKNOWN

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent
    from seewhy.data.dataset import Dataset
    from seewhy.dialogue.reply import Classification
    from seewhy.knowledge.scene import FeatureVector

_BATCH = 16
"""Most features matter to some of so many feature vectors: then no more are looked at."""

__all__ = ["Redecided", "classes_of", "depended_on", "redecided"]


@dataclass(frozen=True)
class Redecided:
    """What reading features rightly would do to the classes.

    Attributes
    ----------
    wrong : int
        Pictures whose class is wrong.
    not_known : int
        Those of them that the agent said it does not know; reading does not mend them.
    mended : dict
        Feature → the wrong classes that would be right, were only that feature read rightly.
    spoilt : dict
        Feature → the right classes that would then be wrong: two mistakes can cancel out.
    mended_by_all : int
        The wrong classes that would be right, were every annotated feature read rightly. The rest
        is what the knowledge and the tree make of rightly read features.
    """

    wrong: int
    not_known: int
    mended: dict[str, int]
    spoilt: dict[str, int]
    mended_by_all: int

    def to_dict(self) -> dict[str, Any]:
        """Return the numbers as values that JSON can hold."""
        return {**self.__dict__, "mended": dict(self.mended), "spoilt": dict(self.spoilt)}


def classes_of(agent: Agent, vectors: Sequence[FeatureVector]) -> dict[FeatureVector, str | None]:
    """The class that the knowledge, or else the tree, gives every feature vector."""
    distinct = list(dict.fromkeys(vectors))
    decisions = agent.reasoner.decide_all(distinct)
    classes = {vector: decision.label for vector, decision in zip(distinct, decisions, strict=True)}
    left = [vector for vector, label in classes.items() if label is None]
    if left and agent.tree.fitted:
        classes.update(zip(left, agent.tree.classify_all(left), strict=True))
    return classes


def redecided(agent: Agent, dataset: Dataset, found: Sequence[Classification]) -> Redecided:
    """Decide every picture again, with each feature's annotated value in the place of the seen.

    Parameters
    ----------
    agent : Agent
    dataset : Dataset
        Pictures that have a class.
    found : sequence of Classification
        What the agent made of each.
    """
    features = tuple(agent.domain.features)
    pictures = [
        (label, scene.label, scene.vector, _corrected(scene.vector, true))
        for label, true, scene in zip(dataset.classes, dataset.vectors, found, strict=True)
        if scene.verdict != UNKNOWN
    ]
    variants = {
        (seen, right): [_with(seen, position, right[position]) for position in range(len(features))]
        for _, _, seen, right in pictures
    }
    classes = classes_of(
        agent,
        [vector for (_, right), some in variants.items() for vector in (right, *some)],
    )
    mended, spoilt = dict.fromkeys(features, 0), dict.fromkeys(features, 0)
    by_all = 0
    for label, said, seen, right in pictures:
        by_all += said != label == classes[right]
        for key, variant in zip(features, variants[seen, right], strict=True):
            if variant != seen:
                mended[key] += said != label == classes[variant]
                spoilt[key] += said == label != classes[variant]
    wrong = sum(label != scene.label for label, scene in zip(dataset.classes, found, strict=True))
    not_known = sum(scene.verdict == UNKNOWN for scene in found)
    return Redecided(wrong, not_known, mended, spoilt, by_all)


def depended_on(agent: Agent, vectors: Sequence[FeatureVector]) -> dict[str, bool]:
    """Feature → whether another value of it would change the class of some of these vectors."""
    distinct = list(dict.fromkeys(vectors))
    return {
        key: any(
            _matters(agent, distinct[start : start + _BATCH], position, feature.values)
            for start in range(0, len(distinct), _BATCH)
        )
        for position, (key, feature) in enumerate(agent.domain.features.items())
    }


def _matters(
    agent: Agent, vectors: Sequence[FeatureVector], position: int, values: Sequence[str]
) -> bool:
    pairs = [(vector, _with(vector, position, value)) for vector in vectors for value in values]
    classes = classes_of(agent, [vector for pair in pairs for vector in pair])
    return any(classes[vector] != classes[other] for vector, other in pairs)


def _corrected(seen: FeatureVector, true: FeatureVector) -> FeatureVector:
    """What was seen, with the annotated values where there are some."""
    return tuple(
        value if annotated is None else annotated
        for value, annotated in zip(seen, true, strict=True)
    )


def _with(vector: FeatureVector, position: int, value: str | None) -> FeatureVector:
    return (*vector[:position], value, *vector[position + 1 :])
