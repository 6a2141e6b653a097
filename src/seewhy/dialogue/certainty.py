"""How surely an answer may be said: by the least sure of what it rests on."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import TYPE_CHECKING, Any

from seewhy.dialogue.answer import AnswerType
from seewhy.domain.tables import CLASS
from seewhy.knowledge.justification import Basis, Node

if TYPE_CHECKING:
    from seewhy.dialogue.reply import Classification

__all__ = [
    "PROBABLE_FROM",
    "SURE_FROM",
    "Certainty",
    "Ground",
    "certainty_of",
    "least_sure",
    "least_sure_told",
    "says_nothing_seen",
    "weakest",
]

SURE_FROM = 0.9
"""From this probability on, what is seen is said as it is: of ten such things nine are so."""

PROBABLE_FROM = 0.65
"""From here on "probably", below "perhaps": of three such things two are so, or fewer."""

_SAYS_NOTHING_SEEN = frozenset(
    {
        "undecided",
        "several",
        "contradictory",
        "unknown",
        "no_belief",
        "no_difference",
        "feature_unknown",
    }
)
_ABOUT_A_FEATURE = frozenset({"value", "yes", "no"})
_RESTS_ON_WHAT_FAILS = frozenset({Basis.ABSENCE, Basis.JOINTLY, Basis.EXCEPTION, Basis.OTHERWISE})
_CONCLUDES = frozenset({"class", "yes_class", "no_class", "already", "same", "belief"})


class Certainty(StrEnum):
    """How surely something is said; unless it is sure, the value is the adverb that says so."""

    SURE = "sure"
    PROBABLY = "probably"
    PERHAPS = "perhaps"

    @property
    def adverb(self) -> str:
        """The word that goes into a sentence; empty where it is sure."""
        return "" if self is Certainty.SURE else self.value


@dataclass(frozen=True)
class Ground:
    """Something that an answer rests on, and how probable it is.

    Attributes
    ----------
    feature : str
        A feature of the domain, or "class".
    value : str
    probability : float
        Of that value, 0 to 1.
    """

    feature: str
    value: str
    probability: float

    def to_dict(self) -> dict[str, Any]:
        """Return the ground as values that JSON can hold."""
        return {
            "feature": self.feature,
            "value": self.value,
            "probability": round(self.probability, 4),
        }


def certainty_of(ground: Ground | None) -> Certainty:
    """Return how surely an answer may be said whose least sure ground is given.

    Examples
    --------
    >>> [certainty_of(Ground("lean", "yes", p)).value for p in (0.9, 0.89, 0.65, 0.64)]
    ['sure', 'probably', 'probably', 'perhaps']
    >>> certainty_of(None).value
    'sure'
    """
    if ground is None or ground.probability >= SURE_FROM:
        return Certainty.SURE
    return Certainty.PROBABLY if ground.probability >= PROBABLE_FROM else Certainty.PERHAPS


def says_nothing_seen(kind: AnswerType) -> bool:
    """Whether an answer says nothing about the picture that could be so or not.

    Examples
    --------
    >>> says_nothing_seen(AnswerType("unknown")), says_nothing_seen(AnswerType("class"))
    (True, False)
    """
    return kind.form in _SAYS_NOTHING_SEEN


def least_sure(
    kind: AnswerType, scene: Classification, justification: Node, *, supposed: bool = False
) -> Ground | None:
    """Return the least sure of what an answer rests on.

    An answer about a feature rests on that feature. Every other rests on the class, and on the
    features that it mentions, or would change, or that its justification needs: of several
    independent reasons for a class the surest is enough, unless the answer tells them all.

    Parameters
    ----------
    kind : AnswerType
    scene : Classification
        What the answer speaks of.
    justification : Node
        With the probabilities of what is seen.
    supposed : bool, default False
        Whether the class is supposed, and said to be, so that the answer does not rest on it.

    Returns
    -------
    Ground or None
        None where it rests on nothing that is uncertain, like what is annotated.
    """
    if says_nothing_seen(kind):
        return None
    named = {*kind.mentions, *(feature for change in kind.changes for feature, _ in change)}
    readings = scene.features
    grounds = [
        Ground(key, readings[key].value, readings[key].probability)
        for key in readings
        if key in named
    ]
    if kind.form not in _ABOUT_A_FEATURE:
        grounds += [
            replace(ground, value=readings[ground.feature].value)
            for ground in _needed(kind, justification)
        ]
        if scene.label is not None and scene.probability is not None and not supposed:
            grounds.append(Ground(CLASS, scene.label, scene.probability))
    return min(grounds, key=_probability, default=None)


def least_sure_told(previous: Ground | None, scene: Classification, told: Node) -> Ground | None:
    """Return the least sure of what an explanation rests on: of the answer, and of all it tells.

    ``previous`` is the least sure of what the explained answer rests on, ``told`` its
    justification.
    """
    grounds = [
        Ground(feature, scene.features[feature].value, scene.features[feature].probability)
        for feature in told.features()
        if feature in scene.features
    ]
    return min([*grounds, *([previous] if previous else [])], key=_probability, default=None)


def _needed(kind: AnswerType, justification: Node) -> Iterator[Ground]:
    """What the justification of an answer rests on, beside what the answer names."""
    if kind.form in _CONCLUDES:
        found = weakest(justification)
    elif kind.changes and not justification.holds and justification.children:
        # Behind why it is not so stands why it would be, which needs what stays as it is.
        found = weakest(justification.children[-1])
    else:
        return
    if found is not None:
        yield found


def weakest(node: Node) -> Ground | None:
    """Return the least sure value that a belief needs, None where it needs none that is uncertain.

    Of several reasons the surest is enough.

    Examples
    --------
    >>> def leaf(feature: str, probability: float) -> Node:
    ...     return Node("", "", Basis.FEATURE, feature=feature, value="yes",
    ...                 probability=probability)
    >>> both = Node("", "", Basis.AXIOM, children=(leaf("lean", 0.7), leaf("base", 0.8)))
    >>> weakest(both).feature
    'lean'
    >>> weakest(Node("", "", Basis.REASONS, children=(both, leaf("displaced", 0.9)))).feature
    'displaced'
    """
    if node.holds or node.is_refuted:
        return _weakest_of(node)
    below = [_weakest_of(child) for child in node.children if child.holds]
    return _of(node, below, enough=node.basis is Basis.REASONS)


def _weakest_of(node: Node) -> Ground | None:
    """The least sure of what a step needs, which may be that something fails."""
    fails = not node.holds or node.basis in _RESTS_ON_WHAT_FAILS
    below = [_weakest_of(child) for child in node.children if child.holds or fails]
    # Of several reasons one is enough, and of the ways in which an axiom fails.
    return _of(node, below, enough=node.is_refuted or (node.holds and node.basis is Basis.REASONS))


def _of(node: Node, below: list[Ground | None], *, enough: bool) -> Ground | None:
    if enough and below:
        return None if None in below else max(filter(None, below), key=_probability)
    grounds = [ground for ground in below if ground is not None]
    if node.feature is not None and node.probability is not None:
        grounds.append(Ground(node.feature, node.value or "", node.probability))
    return min(grounds, key=_probability, default=None)


def _probability(ground: Ground) -> float:
    return ground.probability
