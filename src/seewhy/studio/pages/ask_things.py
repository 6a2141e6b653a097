"""Ask, where pictures show several things: what was seen, questions in one talk, and what if."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, Any
from urllib.parse import urlencode

from fastapi import Request, Response
from fastapi.responses import RedirectResponse

from seewhy.agent.things.thing_supposing import SupposedThings, say_edits, suppose_things
from seewhy.errors import PictureError, QuestionError
from seewhy.report.thing_card import rests_on, spoken_of
from seewhy.studio.box_labels import box_labels, letter_size
from seewhy.studio.drawing import picture_size
from seewhy.studio.pages.chosen_picture import chosen
from seewhy.studio.pages.done import Done
from seewhy.studio.rendering import from_script, render
from seewhy.studio.state import Studio, studio_of
from seewhy.studio.suggesting_about_things import FIRST, suggested_about_things
from seewhy.studio.supposing_things import (
    edits_of,
    fields_of,
    loose_relations,
    orders,
    read_supposition,
)
from seewhy.studio.thing_talk import ThingTalk

if TYPE_CHECKING:
    from seewhy.agent.things.thing_agent import ThingAgent

__all__ = [
    "answer_about_things",
    "begin",
    "shown_anew",
    "things_or_problem",
    "what_if_about_things",
]


def things_or_problem(studio: Studio, talk: ThingTalk) -> dict[str, Any]:
    """What the bench shows; of a picture that cannot be read, why."""
    try:
        begin(studio, talk)
        return {
            **_shown(studio, talk),
            "trained_for_this": studio.things.trained_for_this,
            "problem": "",
        }
    except PictureError as problem:
        return {"problem": str(problem), "picture": talk.picture}


def begin(studio: Studio, talk: ThingTalk) -> None:
    """Look at the picture that is spoken of, and tell what is there where nothing was asked."""
    with studio.things.at_work() as agent:
        scene = studio.things.look(talk.picture)
        talk.about(talk.picture, scene)
        if not talk.replies:
            talk.remember(agent.answer(FIRST, scene))


def shown_anew(request: Request, studio: Studio, talk: ThingTalk, done: Done) -> Response:
    """The bench when something was done: the picture is read and the question asked anew."""
    question = talk.replies[-1].reply.question if talk.replies else FIRST
    with studio.things.at_work() as agent:
        scene = studio.things.look(talk.picture)
        talk.about(talk.picture, scene)
        try:
            talk.remember(agent.answer(question, scene))
        except QuestionError:  # it was about the answer before
            begin(studio, talk)
    if not from_script(request):
        return RedirectResponse(f"/ask?{urlencode({'picture': talk.picture})}", 303)
    return render(request, "_ask_things.html", **_shown(studio, talk, done=done))


def answer_about_things(
    request: Request, picture: str, question: str, *, supposed: Sequence[tuple[str, str]] = ()
) -> Response:
    """Answer a question; one that leaves something out is about what was answered last.

    What is ``supposed`` (fields of its form) stays so, and the new question is asked of it.
    """
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
    return render(request, "_ask_things.html", **_shown(studio, talk, supposed=supposed))


def _shown(
    studio: Studio,
    talk: ThingTalk,
    *,
    done: Done | None = None,
    supposed: Sequence[tuple[str, str]] = (),
) -> dict[str, Any]:
    """What the template of the bench shows."""
    reply = talk.replies[-1]
    with studio.things.at_work() as agent:
        return {
            "picture": talk.picture,
            "done": done,
            "beside": False,
            "before": talk.replies[-2::-1],
            "suggested": suggested_about_things(agent, reply.read, reply),
            "features": agent.domain.features,
            **_supposed(studio, agent, talk, supposed),
        }


def what_if_about_things(request: Request, picture: str) -> Response:
    """The last question, answered anew if things were otherwise, and what then follows."""
    studio = studio_of(request)
    talk = studio.thing_talks.of(request.state.session)
    talk.about(chosen(studio, picture))
    begin(studio, talk)
    with studio.things.at_work() as agent:
        shown = _supposed(studio, agent, talk, request.query_params.multi_items())
    part = "_ask_things_supposed.html"
    template = part if from_script(request) else "ask_what_if.html"
    # The page has the picture already: its boxes are exchanged beside what is supposed.
    beside = from_script(request)
    return render(request, template, picture=talk.picture, part=part, beside=beside, **shown)


def _supposed(
    studio: Studio, agent: ThingAgent, talk: ThingTalk, fields: Sequence[tuple[str, str]]
) -> dict[str, Any]:
    """What is shown of what is supposed, in the picture and beside it."""
    reply = talk.replies[-1]
    read = reply.read
    said = read_supposition(fields, read)
    edits = edits_of(said, read)
    supposed = suppose_things(agent.answerer, reply, edits)
    size = picture_size(studio.project.picture_file(talk.picture))
    called = [
        (supposed if supposed.is_changed(number) else read).words.name(number).removeprefix("the ")
        for number in range(len(read.reading.things))
    ]
    return {
        "labels": box_labels([thing.box for thing in read.reading.things], called, size),
        "letters": letter_size(size),
        "read": read,
        "reply": reply,
        "size": size,
        "shown": rests_on(reply),
        "classes": agent.domain.classes,
        "said": said,
        "clauses": say_edits(read, edits),
        "supposed": supposed,
        "marked": _marked(supposed, added=said.added),
        "others": list(fields_of(said, but=said.at)),
        "orders": orders(read),
        "loose": loose_relations(read),
        "spoken_of": partial(spoken_of, read=read),
    }


def _marked(supposed: SupposedThings, *, added: int) -> list[str]:
    """What marks in the picture stand for."""
    seen = range(supposed.reply.read.scene.count)
    marks = {
        "green: otherwise": any(map(supposed.is_changed, seen)),
        "struck out: not there": any(map(supposed.is_gone, seen)),
        "what is added has no place in it": added > 0,
    }
    return [mark for mark, stands in marks.items() if stands]
