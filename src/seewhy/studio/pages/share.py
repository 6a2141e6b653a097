"""Share: answers and evaluations, each as one file that opens with no network."""

from __future__ import annotations

from typing import Annotated
from urllib.parse import quote

from fastapi import APIRouter, Query, Request, Response

from seewhy.errors import SeeWhyError
from seewhy.report.answers_page import answers_page, answers_page_of_things
from seewhy.studio.pages.chosen_picture import chosen
from seewhy.studio.pages.evaluate import evaluation_file
from seewhy.studio.pages.page import Page
from seewhy.studio.rendering import render
from seewhy.studio.state import studio_of
from seewhy.studio.thing_talk import ThingTalk

__all__ = ["PAGE"]

router = APIRouter()
PAGE = Page("/share", "Share", router)


@router.get(PAGE.path)
def show(request: Request) -> Response:
    """What there is to share."""
    studio = studio_of(request)
    return render(
        request,
        "share.html",
        missing=studio.answering.missing,
        talk=studio.talk_of(request.state.session),
        evaluated=evaluation_file(studio.project) is not None,
    )


@router.get("/share/answers.html")
def answers(request: Request, picture: Annotated[str, Query(max_length=2000)]) -> Response:
    """What was asked of a picture, with reasons and where they are seen."""
    studio = studio_of(request)
    name = chosen(studio, picture)
    talk = studio.talk_of(request.state.session)
    if talk.picture != name or not talk.replies:
        raise SeeWhyError(f"nothing was asked of {name} yet; ask on the page Ask")
    file = studio.project.picture_file(name)
    if isinstance(talk, ThingTalk):
        with studio.things.at_work() as things_agent:
            text = answers_page_of_things(things_agent.domain, file, talk.replies)
    else:
        where = studio.model.where(name)
        with studio.model.at_work() as agent:
            text = answers_page(agent.domain, file, talk.replies, where=where)
    return _file(text, f"{file.stem}.html")


def _file(text: str, name: str) -> Response:
    """A file that the browser keeps and does not show: it has styles of its own."""
    disposition = f"attachment; filename*=UTF-8''{quote(name)}"
    return Response(
        text, media_type="text/html; charset=utf-8", headers={"Content-Disposition": disposition}
    )
