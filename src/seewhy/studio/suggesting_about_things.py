"""Questions that one may ask about the things in a picture, in words that are understood."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from seewhy.errors import QuestionError

if TYPE_CHECKING:
    from seewhy.agent.things.thing_agent import ThingAgent
    from seewhy.agent.things.thing_reply import PictureReply, ReadScene

__all__ = ["FIRST", "suggested_about_things"]

FIRST = "what is there?"
"""What is asked of a picture before anybody asks."""

_MOST = 7


def suggested_about_things(
    agent: ThingAgent, scene: ReadScene, previous: PictureReply | None = None
) -> tuple[str, ...]:
    """Return questions about what was read, those first that go on from the last answer.

    Only such are returned as are understood, and have an answer.
    """
    before = None if previous is None else previous.reply
    asked = "" if before is None else before.question
    found: list[str] = []
    for question in dict.fromkeys((*_following(scene, asked), *_beginning(scene))):
        if question == asked or len(found) == _MOST:
            continue
        try:
            reply = agent.answerer.answer(question, scene.scene, previous=before)
        except QuestionError:
            continue
        if reply.failed is None:
            found.append(question)
    return tuple(found)


def _following(scene: ReadScene, asked: str) -> Iterator[str]:
    """What goes on from an answer; "and the blue ones?" only where another was asked about."""
    if not asked:
        return
    yield "why?"
    for feature in scene.things.features.values():
        values = [value for value in feature.values if value in asked.split()]
        seen = [thing.values[feature.key].value for thing in scene.reading.things]
        yield from (f"and the {other} ones?" for other in dict.fromkeys(seen) if values != [other])
        if values:
            return


def _beginning(scene: ReadScene) -> Iterator[str]:
    things, reading = scene.things, scene.reading
    yield f"how many {things.many} are there?"
    yield FIRST
    if not reading.things:
        return
    name = scene.words.name(0)
    for key, feature in things.features.items():
        value = reading.things[0].values[key].value
        yield f"how many {value} {things.many} are there?"
        yield f"what {feature.name} is {name}?"
    for relation in things.relations.values():
        for words in relation.words[:1]:
            yield f"what is {words} {name}?"
    yield f"what is the most common {next(iter(things.features.values())).name}?"
