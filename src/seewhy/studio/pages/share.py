"""Share: answers and evaluations, each as one file that opens with no network."""

from __future__ import annotations

from typing import Annotated
from urllib.parse import quote

from fastapi import APIRouter, Query, Request, Response

from seewhy.errors import SeeWhyError
from seewhy.report.answers_page import answers_page
from seewhy.studio.pages.asking import chosen
from seewhy.studio.pages.page import Page
from seewhy.studio.rendering import render
from seewhy.studio.state import studio_of

__all__ = ["PAGE"]

router = APIRouter()
PAGE = Page("/share", "Share", router)


@router.get(PAGE.path)
def show(request: Request) -> Response:
    """What there is to share."""
    studio = studio_of(request)
    talk = studio.talks.of(request.state.session)
    return render(request, "share.html", missing=studio.model.missing, talk=talk)


@router.get("/share/answers.html")
def answers(request: Request, picture: Annotated[str, Query(max_length=2000)]) -> Response:
    """What was asked of a picture, with reasons and where they are seen."""
    studio = studio_of(request)
    name = chosen(studio, picture)
    talk = studio.talks.of(request.state.session)
    if talk.picture != name or not talk.replies:
        raise SeeWhyError(f"nothing was asked of {name} yet; ask on the page Ask")
    where = studio.model.where(name)
    with studio.model.at_work() as agent:
        file = studio.project.picture_file(name)
        text = answers_page(agent.domain, file, talk.replies, where=where)
    return _file(text, f"{file.stem}.html")


@router.get("/share/evaluation.html")
def evaluation(request: Request) -> Response:
    """How good the model is on the labelled pictures; it looks at all of them anew."""
    from seewhy.evaluation import evaluate
    from seewhy.report.evaluation_page import evaluation_page

    studio = studio_of(request)
    with studio.model.at_work() as agent:
        found = evaluate(agent, studio.project.dataset())
        text = evaluation_page(
            agent.domain, found, command=f"seewhy evaluate {studio.project.name}/model"
        )
    return _file(text, f"{studio.project.name}-evaluation.html")


def _file(text: str, name: str) -> Response:
    """A file that the browser keeps and does not show: it has styles of its own."""
    disposition = f"attachment; filename*=UTF-8''{quote(name)}"
    return Response(
        text, media_type="text/html; charset=utf-8", headers={"Content-Disposition": disposition}
    )
