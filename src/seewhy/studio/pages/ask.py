"""Ask: questions about a picture, with reasons that fold, and what if it showed something else."""

from __future__ import annotations

from typing import Annotated, Any
from urllib.parse import urlencode

from fastapi import APIRouter, Depends, File, Form, Query, Request, Response, UploadFile
from fastapi.responses import RedirectResponse

from seewhy.dialogue.asked import Asks, Question
from seewhy.errors import PictureError, QuestionError, SeeWhyError
from seewhy.studio.incoming import sent_picture
from seewhy.studio.pages import ask_doubt, ask_things_doubt, ask_where
from seewhy.studio.pages.ask_things import (
    answer_about_things,
    things_or_problem,
    what_if_about_things,
)
from seewhy.studio.pages.asking import asked_again, shown_answer, understood
from seewhy.studio.pages.chosen_picture import chosen
from seewhy.studio.pages.done import Done
from seewhy.studio.pages.page import Page
from seewhy.studio.rendering import from_script, render
from seewhy.studio.session import who_of
from seewhy.studio.state import Studio, studio_of
from seewhy.studio.suggesting import suggested_questions
from seewhy.studio.supposing import suppose
from seewhy.studio.thing_talk import ThingTalk

__all__ = ["PAGE"]

router = APIRouter()
router.include_router(ask_doubt.router)
router.include_router(ask_things_doubt.router)
router.include_router(ask_where.router)
PAGE = Page("/ask", "Ask", router)

_STRIP = 24
_LONGEST_QUESTION = 500

Name = Annotated[str, Query(max_length=2000)]
NameField = Annotated[str, Form(max_length=2000)]


@router.get(PAGE.path)
def show(
    request: Request,
    picture: Name = "",
    find: Annotated[str, Query(max_length=200)] = "",
    at: Annotated[int, Query(ge=0)] = 0,
) -> Response:
    """The page, with the picture that was chosen last."""
    studio = studio_of(request)
    missing = studio.answering.missing
    if missing is not None:
        return render(request, "ask.html", missing=missing)
    talk = studio.talk_of(request.state.session)
    name = chosen(studio, picture) if picture else talk.picture
    if name not in set(studio.project.pictures()):
        name = studio.project.pictures()[0]
    talk.about(name)
    names = [each for each in studio.project.pictures() if find.casefold() in each.casefold()]
    at = min(at, max(0, len(names) - 1) // _STRIP)
    return render(
        request,
        "ask.html",
        missing=None,
        names=names[at * _STRIP : (at + 1) * _STRIP],
        count=len(names),
        find=find,
        at=at,
        last=max(0, len(names) - 1) // _STRIP,
        bench="_ask_things.html" if isinstance(talk, ThingTalk) else "_ask_bench.html",
        **(
            things_or_problem(studio, talk)
            if isinstance(talk, ThingTalk)
            else _bench_or_problem(studio, request)
        ),
    )


@router.post("/ask/picture")
def upload(request: Request, file: Annotated[UploadFile, File()]) -> Response:
    """Keep a picture that the browser sends, and speak of it."""
    studio = studio_of(request)
    if not file.filename:
        raise SeeWhyError("no picture was chosen; choose a file first")
    sent = sent_picture(studio.project, file.filename, file.file)
    studio.project.refresh()
    return RedirectResponse(f"{PAGE.path}?{urlencode({'picture': sent.name})}", 303)


async def fields_sent(request: Request) -> list[tuple[str, str]]:
    """All fields of a form, also those whose names things and features make."""
    sent = (await request.form()).multi_items()
    return [(name, value) for name, value in sent if isinstance(value, str)]


@router.post(PAGE.path)
def answer(
    request: Request,
    picture: NameField,
    sent: Annotated[list[tuple[str, str]], Depends(fields_sent)],
    question: Annotated[str, Form(max_length=_LONGEST_QUESTION)] = "",
) -> Response:
    """Answer a question; one that leaves something out is about what was spoken of."""
    studio = studio_of(request)
    if studio.project.has_things:
        remarked = ask_things_doubt.remarked_about_things(request, picture, question)
        return remarked or answer_about_things(request, picture, question, supposed=sent)
    talk = studio.talks.of(request.state.session)
    talk.about(chosen(studio, picture))
    if not question.strip():
        raise QuestionError("nothing is asked; type a question or choose one")
    with studio.model.at_work() as agent:
        asked = understood(agent, talk, question)
        if asked is None:
            return ask_doubt.doubted(request, question)
        reply = agent.answer(
            studio.model.look(talk.picture),
            asked,
            previous=talk.previous,
            image=studio.project.picture_file(talk.picture),
        )
    talk.remember(reply)
    if not from_script(request):
        return RedirectResponse(f"{PAGE.path}?{urlencode({'picture': talk.picture})}", 303)
    return render(request, "_ask_answer.html", **shown_answer(studio, talk))


@router.get("/ask/what-if")
def what_if(request: Request, picture: Name) -> Response:
    """Class, reasons and smallest change if the picture showed other values."""
    studio = studio_of(request)
    if studio.project.has_things:
        return what_if_about_things(request, picture)
    name = chosen(studio, picture)
    given = [
        f"{key.removeprefix('shows.')}={value}"
        for key, value in request.query_params.items()
        if key.startswith("shows.") and value
    ]
    with studio.model.at_work() as agent:
        supposed = suppose(agent, studio.model.look(name), given)
        domain = agent.domain
    template = "_ask_supposed.html" if from_script(request) else "ask_what_if.html"
    part = "_ask_supposed.html"
    return render(request, template, part=part, supposed=supposed, picture=name, domain=domain)


@router.post("/ask/take")
def take(
    request: Request, picture: NameField, key: Annotated[str, Form(max_length=40)]
) -> Response:
    """Take what was proposed, and answer the last question anew."""
    studio = studio_of(request)
    if studio.project.has_things:
        return ask_things_doubt.take_about_things(request, picture, key)
    talk = studio.talks.of(request.state.session)
    talk.about(chosen(studio, picture))
    done = ask_doubt.taken(studio, talk, key, who=who_of(request))
    asked_again(studio, talk)
    if not from_script(request):
        return RedirectResponse(f"{PAGE.path}?{urlencode({'picture': talk.picture})}", 303)
    return render(request, "_ask_bench.html", **{**_bench(studio, request), "done": done})


@router.post("/ask/take-back")
def take_back(request: Request, picture: NameField, number: Annotated[int, Form(ge=1)]) -> Response:
    """Take back what was taken, and answer the last question anew."""
    studio = studio_of(request)
    if studio.project.has_things:
        return ask_things_doubt.take_back_about_things(request, picture, number)
    talk = studio.talks.of(request.state.session)
    talk.about(chosen(studio, picture))
    studio.project.take_back(number, who=who_of(request))
    asked_again(studio, talk)
    if not from_script(request):
        return RedirectResponse(f"{PAGE.path}?{urlencode({'picture': talk.picture})}", 303)
    done = Done(f"Taken back: entry {number}.", None)
    return render(request, "_ask_bench.html", **{**_bench(studio, request), "done": done})


def _bench_or_problem(studio: Studio, request: Request) -> dict[str, Any]:
    """The bench; of a picture that cannot be read, why, so that another can be chosen."""
    try:
        return {**_bench(studio, request), "problem": ""}
    except PictureError as problem:
        talk = studio.talks.of(request.state.session)
        return {"problem": str(problem), "picture": talk.picture}


def _bench(studio: Studio, request: Request) -> dict[str, Any]:
    """The picture with its features as switches, and what was asked of it."""
    talk = studio.talks.of(request.state.session)
    with studio.model.at_work() as agent:
        scene = studio.model.look(talk.picture)
        if not talk.replies:
            first = Question(Asks.CLASS, "what is it", ())
            talk.remember(agent.answer(scene, first))
        return {
            "domain": agent.domain,
            "scene": scene,
            "supposed": suppose(agent, scene, ()),
            "suggested": suggested_questions(agent, scene),
            "trained_for_this": studio.model.trained_for_this,
            "done": None,
            **shown_answer(studio, talk),
        }
