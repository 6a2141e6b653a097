"""What the parts of the page Ask share: what is asked, and answers as they are shown."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from seewhy.dialogue.asked import Question
from seewhy.errors import QuestionError
from seewhy.revision.remarks import remark_of
from seewhy.studio.state import Studio
from seewhy.studio.talk import Talk

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent

__all__ = ["asked_again", "shown_answer", "understood"]


def understood(agent: Agent, talk: Talk, text: str) -> Question | None:
    """What a text asks; None where it says that the answer is wrong.

    Raises
    ------
    QuestionError
        If it is neither.
    """
    previous = None if talk.previous is None else talk.previous.question
    try:
        return agent.questions.understand(text, previous=previous)
    except QuestionError:
        if remark_of(agent.questions, text) is None:
            raise
        return None


def asked_again(studio: Studio, talk: Talk) -> None:
    """Answer the last question with what is known by now."""
    talk.wanted = None
    if not talk.replies:
        return
    with studio.model.at_work() as agent:
        reply = agent.answer(
            studio.model.look(talk.picture),
            talk.replies[-1].question,
            previous=talk.previous,
            image=studio.project.picture_file(talk.picture),
        )
    talk.remember(reply)


def shown_answer(studio: Studio, talk: Talk) -> dict[str, Any]:
    """What the template of an answer shows."""
    with studio.model.at_work() as agent:
        return {
            "picture": talk.picture,
            "reply": talk.replies[-1] if talk.replies else None,
            "before": talk.replies[-2::-1],
            "features": agent.domain.features,
            "classes": agent.domain.classes,
        }
