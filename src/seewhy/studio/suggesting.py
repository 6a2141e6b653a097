"""Questions that one may ask of a picture, in words that are understood."""

from __future__ import annotations

from typing import TYPE_CHECKING

from seewhy.dialogue.asked import Asks, Question
from seewhy.dialogue.saying_questions import say_question

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent
    from seewhy.dialogue.reply import Classification

__all__ = ["suggested_questions"]

_MOST = 7


def suggested_questions(agent: Agent, scene: Classification) -> tuple[str, ...]:
    """Return questions about a picture, those first that one asks first.

    Examples
    --------
    >>> from seewhy.agent.agent import Agent
    >>> from seewhy.domain.domain import load_domain
    >>> agent = Agent(load_domain("structure_stability"))
    >>> scene = agent.classify_values({"lean": "yes", "block_displaced": "yes"})
    >>> suggested_questions(agent, scene)[:2]
    ('why do you say that the structure is unstable?', 'what would make the structure stable?')
    """
    domain = agent.domain
    nearest = agent.reasoned.nearest_classes(scene.vector, most=2)
    other = next((label for label in nearest if label != scene.label), None)
    asked = [Question(Asks.CLASS, "", ())]
    if scene.label is not None:
        asked = [Question(Asks.WHY_CLASS, "", (), label=scene.label)]
    if other is not None:
        asked.append(Question(Asks.CHANGE_TO_CLASS, "", (), label=other))
        asked.append(Question(Asks.WHY_NOT_CLASS, "", (), label=other))
    asked += [Question(asks, "", ()) for asks in (Asks.HOW_SURE, Asks.WHAT_TO_CHECK)]
    unsure = scene.least_certain if scene.features else next(iter(domain.features))
    asked.append(Question(Asks.FEATURE_VALUE, "", (), feature=unsure))
    asked += [Question(asks, "", ()) for asks in (Asks.SIMILAR, Asks.DESCRIBE)]
    return tuple(f"{say_question(domain, question)}?" for question in asked[:_MOST])
