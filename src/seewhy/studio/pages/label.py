"""Label: pictures are annotated by keyboard, with proposals from heads trained a second ago."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Query, Request, Response
from fastapi.responses import RedirectResponse

from seewhy.new_domain.words import plain_words
from seewhy.studio.entry_words import in_words
from seewhy.studio.labelling import (
    bring_back,
    choose,
    last_undone,
    reasons_with,
    take_back_last,
)
from seewhy.studio.labels import REASONS
from seewhy.studio.pages import label_history, label_sheet, label_things
from seewhy.studio.pages.chosen_picture import chosen
from seewhy.studio.pages.label_shown import (
    GO_ON,
    Name,
    bench_of,
    go_on,
    question_after,
    shown,
    shown_after,
)
from seewhy.studio.pages.page import Page
from seewhy.studio.session import who_of
from seewhy.studio.state import studio_of

__all__ = ["PAGE"]

router = APIRouter()
router.include_router(label_sheet.router)
router.include_router(label_history.router)
router.include_router(label_things.router)
PAGE = Page("/label", "Label", router)


@router.get(PAGE.path)
def show(
    request: Request,
    picture: Annotated[str, Query(max_length=2000)] = "",
    at: Annotated[str, Query(max_length=200)] = "",
    go: Annotated[str, Query(max_length=10)] = "",
    thing: Annotated[str, Query(max_length=200)] = "",
) -> Response:
    """One picture, or one thing in it: that which is named, the next or previous, or the one
    worth most.
    """
    studio = studio_of(request)
    if studio.project.domain_folder is None or not studio.project.pictures():
        return RedirectResponse("/begin", 303)
    trail = studio.trails.of(request.state.session)
    if go == "back":
        trail.go_back()
    elif go == "on":
        go_on(request)
    elif picture:
        chosen(studio, picture, remedy=GO_ON)
        trail.visit(picture)
    elif trail.here is None:
        go_on(request)
    return shown(request, at=at, thing=thing)


@router.post("/label/set")
def set_value(request: Request, picture: Name, choice: Name = "", other: Name = "") -> Response:
    """Say a value of a feature, or the class: ``FEATURE=VALUE``, an empty one for nobody knows."""
    studio = studio_of(request)
    chosen(studio, picture, remedy=GO_ON)
    name, _, value = (other or choice).partition("=")
    choose(studio.project, {picture: {name: value or None}}, who=who_of(request), how="typed")
    studio.trails.of(request.state.session).visit(picture)
    labels, domain = studio.project.labels(), studio.project.domain()
    if value and labels.is_complete(picture, domain):
        go_on(request)
        return shown(request, done=f"{picture}: {name} {plain_words(value)}, all said")
    at = question_after(studio, picture, name) if value else name
    return shown(request, at=at, done=f"{name} {plain_words(value) or 'open again'}")


@router.post("/label/confirm")
def confirm(request: Request, picture: Name) -> Response:
    """Say all that is proposed of a picture, as it was shown."""
    studio = studio_of(request)
    chosen(studio, picture, remedy=GO_ON)
    values = bench_of(studio, picture).confirmable
    if not values:
        return shown(request, done="nothing is proposed yet")
    choose(studio.project, {picture: values}, who=who_of(request), how="confirmed")
    studio.trails.of(request.state.session).visit(picture)
    if studio.project.labels().is_complete(picture, studio.project.domain()):
        go_on(request)
    return shown(request, done=f"{picture}: {len(values)} confirmed")


@router.post("/label/reason")
def reason(request: Request, picture: Name, feature: Name, at: Name = "") -> Response:
    """Say that the class of a picture rests on a feature, or that it does not."""
    studio = studio_of(request)
    chosen(studio, picture, remedy=GO_ON)
    features = reasons_with(studio.project, picture, feature)
    studio.project.note(REASONS, {"reasons": {picture: features}}, who=who_of(request))
    said = ", ".join(features) or "nothing in particular"
    return shown(request, at=at, done=f"because of {said}")


@router.post("/label/undo")
def undo(request: Request) -> Response:
    """Take back what was done last, a revision of the rules included, and show its picture."""
    studio = studio_of(request)
    entry = take_back_last(studio.project, who=who_of(request))
    if entry is None:
        return shown(request, done="nothing is left to take back")
    return shown_after(request, entry, done=f"taken back: {in_words(entry)}")


@router.post("/label/redo")
def redo(request: Request) -> Response:
    """Take back the last undoing."""
    studio = studio_of(request)
    undone = last_undone(studio.project)
    if undone is None:
        return shown(request, done="nothing was taken back")
    entry = bring_back(studio.project, undone, who=who_of(request))
    return shown_after(request, entry, done=f"brought back: {in_words(entry)}")


@router.get("/label/news")
def news(
    request: Request,
    picture: Annotated[str, Query(max_length=2000)],
    version: int,
    at: Annotated[str, Query(max_length=200)] = "",
    thing: Annotated[str, Query(max_length=200)] = "",
) -> Response:
    """The same picture with newer proposals; nothing where there are none."""
    studio = studio_of(request)
    here = studio.trails.of(request.state.session).here
    if studio.proposer.latest().version == version or picture != here:
        return Response(status_code=204)
    return shown(request, at=at, thing=thing)
