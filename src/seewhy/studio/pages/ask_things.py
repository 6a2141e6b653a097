"""Ask, where pictures show several things: what was seen of each, and questions in one talk."""

from __future__ import annotations

from typing import Any
from urllib.parse import urlencode

from fastapi import Request, Response
from fastapi.responses import RedirectResponse

from seewhy.errors import PictureError, QuestionError
from seewhy.report.thing_card import rests_on
from seewhy.studio.drawing import picture_size
from seewhy.studio.pages.chosen_picture import chosen
from seewhy.studio.rendering import from_script, render
from seewhy.studio.state import Studio, studio_of
from seewhy.studio.suggesting_about_things import FIRST, suggested_about_things
from seewhy.studio.thing_talk import ThingTalk

__all__ = ["answer_about_things", "things_or_problem"]


def things_or_problem(studio: Studio, talk: ThingTalk) -> dict[str, Any]:
    """What the bench shows; of a picture that cannot be read, why."""
    try:
        with studio.things.at_work() as agent:
            scene = studio.things.look(talk.picture)
            talk.about(talk.picture, scene)
            if not talk.replies:
                talk.remember(agent.answer(FIRST, scene))
        return {
            **_shown(studio, talk),
            "trained_for_this": studio.things.trained_for_this,
            "problem": "",
        }
    except PictureError as problem:
        return {"problem": str(problem), "picture": talk.picture}


def answer_about_things(request: Request, picture: str, question: str) -> Response:
    """Answer a question; one that leaves something out is about what was answered last."""
    studio = studio_of(request)
    talk = studio.thing_talks.of(request.state.session)
    talk.about(chosen(studio, picture))
    if not question.strip():
        raise QuestionError("nothing is asked; type a question or choose one")
    with studio.things.at_work() as agent:
        scene = studio.things.look(talk.picture)
        talk.about(talk.picture, scene)
        talk.remember(agent.answer(question, scene, previous=talk.previous))
    if not from_script(request):
        return RedirectResponse(f"/ask?{urlencode({'picture': talk.picture})}", 303)
    return render(request, "_ask_things.html", **_shown(studio, talk))


def _shown(studio: Studio, talk: ThingTalk) -> dict[str, Any]:
    """What the template of the bench shows."""
    reply = talk.replies[-1]
    with studio.things.at_work() as agent:
        return {
            "picture": talk.picture,
            "size": picture_size(studio.project.picture_file(talk.picture)),
            "reply": reply,
            "read": reply.read,
            "shown": rests_on(reply),
            "before": talk.replies[-2::-1],
            "suggested": suggested_about_things(agent, reply.read, reply),
            "classes": agent.domain.classes,
            "features": agent.domain.features,
        }
