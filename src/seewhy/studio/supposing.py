"""What if: class, reasons and smallest change of a picture that shows other values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from seewhy.dialogue.asked import Asks, Question
from seewhy.dialogue.reply import Classification, Reply
from seewhy.domain.assignments import named_values

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent

__all__ = ["SmallestChange", "Supposed", "suppose"]

_NEAREST = 2
_OF_EACH = 2


@dataclass(frozen=True)
class SmallestChange:
    """What would have to change for a class.

    Attributes
    ----------
    label : str
    says : tuple of str
        A clause for each feature.
    values : mapping of str to str
        What the picture would show.
    """

    label: str
    says: tuple[str, ...]
    values: Mapping[str, str]


@dataclass(frozen=True)
class Supposed:
    """What a picture would be if it showed other values.

    Attributes
    ----------
    values : mapping of str to (str or None)
        What it shows then.
    changed : tuple of str
        The features that are otherwise than what was seen.
    label : str or None
        Its class then.
    was : str or None
        Its class as it was seen.
    reply : Reply
        The class and its reasons.
    smallest : tuple of SmallestChange
        What would have to change for the nearest other classes, the least of it first.
    """

    values: Mapping[str, str | None]
    changed: tuple[str, ...]
    label: str | None
    was: str | None
    reply: Reply
    smallest: tuple[SmallestChange, ...]


def suppose(agent: Agent, scene: Classification, shows: Sequence[str]) -> Supposed:
    """Return what a picture would be; nothing is looked at anew.

    Parameters
    ----------
    agent : Agent
    scene : Classification
        As it was seen.
    shows : sequence of str
        Such as ``colour=red``: all that it shows. Without any, it shows what was seen.

    Raises
    ------
    DomainError
        If one names no feature, or no value of it.

    Examples
    --------
    >>> from seewhy.agent.agent import Agent
    >>> from seewhy.domain.domain import load_domain
    >>> agent = Agent(load_domain("structure_stability"))
    >>> scene = agent.classify_values({"lean": "no", "block_displaced": "yes", "base": "wide"})
    >>> then = suppose(agent, scene, ["lean=no", "block_displaced=no", "base=narrow"])
    >>> then.was, then.changed
    ('unstable', ('base', 'block_displaced'))
    >>> sorted(change.says for change in then.smallest if change.label == "unstable")
    [('displace a block',)]
    """
    seen = agent.domain.named(scene.vector)
    given = named_values(agent.domain, shows) if shows else seen
    values = {key: given.get(key) for key in agent.domain.features}
    then = agent.classify_values({key: value for key, value in values.items() if value})
    reply = agent.answer(then, Question(Asks.CLASS, "what is it", ()))
    return Supposed(
        values,
        tuple(key for key, value in values.items() if value != seen[key]),
        then.label,
        scene.label,
        reply,
        _smallest(agent, then),
    )


def _smallest(agent: Agent, then: Classification) -> tuple[SmallestChange, ...]:
    features = agent.domain.features
    found = []
    for label in agent.reasoned.nearest_classes(then.vector, most=_NEAREST):
        if label == then.label:
            continue
        for change in agent.reasoned.ways.smallest(then.vector, label)[:_OF_EACH]:
            says = tuple(
                features[changed.feature].change.get(changed.after)
                or f"{changed.feature}: {changed.after}"
                for changed in change.changes
            )
            after = agent.domain.named(change.vector)
            values = {key: value for key, value in after.items() if value}
            found.append((change.cost, SmallestChange(label, says, values)))
    return tuple(change for _, change in sorted(found, key=lambda one: one[0]) if change.says)
