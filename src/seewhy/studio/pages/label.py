"""Label: pictures are annotated by keyboard, with proposals from heads trained a second ago."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Annotated, Any
from urllib.parse import urlencode

from fastapi import APIRouter, Form, Query, Request, Response
from fastapi.responses import RedirectResponse

from seewhy.domain.tables import CLASS
from seewhy.errors import SeeWhyError
from seewhy.studio.labelling import (
    bring_back,
    choose,
    class_comes_first,
    last_undone,
    pictures_of,
    reasons_with,
    take_back_last,
)
from seewhy.studio.labels import REASONS
from seewhy.studio.pages import label_history, label_sheet
from seewhy.studio.pages.page import Page
from seewhy.studio.progress import progress_of
from seewhy.studio.rendering import from_script, render
from seewhy.studio.session import who_of
from seewhy.studio.state import Studio, studio_of
from seewhy.studio.workbench import Workbench, is_complete, workbench

__all__ = ["PAGE"]

router = APIRouter()
router.include_router(label_sheet.router)
router.include_router(label_history.router)
PAGE = Page("/label", "Label", router)

Name = Annotated[str, Form(max_length=2000)]


@router.get(PAGE.path)
def show(
    request: Request,
    picture: Annotated[str, Query(max_length=2000)] = "",
    at: Annotated[str, Query(max_length=200)] = "",
    go: Annotated[str, Query(max_length=10)] = "",
) -> Response:
    """One picture: that which is named, the next or previous, or the one worth most."""
    studio = studio_of(request)
    if studio.project.domain_folder is None or not studio.project.pictures():
        return RedirectResponse("/begin", 303)
    trail = studio.trails.of(request.state.session)
    if go == "back":
        trail.go_back()
    elif go == "on":
        _next(request)
    elif picture:
        _picture(studio, picture)
        trail.visit(picture)
    elif trail.here is None:
        _next(request)
    return _shown(request, at=at)


@router.post("/label/set")
def set_value(request: Request, picture: Name, choice: Name = "", other: Name = "") -> Response:
    """Say a value of a feature, or the class: ``FEATURE=VALUE``, an empty one for nobody knows."""
    studio = studio_of(request)
    _picture(studio, picture)
    name, _, value = (other or choice).partition("=")
    choose(studio.project, {picture: {name: value or None}}, who=who_of(request), how="typed")
    studio.trails.of(request.state.session).visit(picture)
    labels, domain = studio.project.labels(), studio.project.domain()
    if value and is_complete(labels, picture, domain):
        _next(request)
        return _shown(request, done=f"{picture}: {name} {value}, all said")
    at = _after(studio, picture, name) if value else name
    return _shown(request, at=at, done=f"{name} {value or 'open again'}")


@router.post("/label/confirm")
def confirm(request: Request, picture: Name) -> Response:
    """Say all that is proposed of a picture, as it was shown."""
    studio = studio_of(request)
    _picture(studio, picture)
    values = _bench(studio, picture).confirmable
    if not values:
        return _shown(request, done="nothing is proposed yet")
    choose(studio.project, {picture: values}, who=who_of(request), how="confirmed")
    studio.trails.of(request.state.session).visit(picture)
    if is_complete(studio.project.labels(), picture, studio.project.domain()):
        _next(request)
    return _shown(request, done=f"{picture}: {len(values)} confirmed")


@router.post("/label/reason")
def reason(request: Request, picture: Name, feature: Name, at: Name = "") -> Response:
    """Say that the class of a picture rests on a feature, or that it does not."""
    studio = studio_of(request)
    _picture(studio, picture)
    features = reasons_with(studio.project, picture, feature)
    studio.project.note(REASONS, {"reasons": {picture: features}}, who=who_of(request))
    said = ", ".join(features) or "nothing in particular"
    return _shown(request, at=at, done=f"because of {said}")


@router.post("/label/undo")
def undo(request: Request) -> Response:
    """Take back what was done last, and show the picture that it was done to."""
    studio = studio_of(request)
    entry = take_back_last(studio.project, who=who_of(request))
    if entry is None:
        return _shown(request, done="nothing is left to take back")
    _stand_at(request, pictures_of(entry))
    return _shown(request, done="taken back")


@router.post("/label/redo")
def redo(request: Request) -> Response:
    """Take back the last undoing."""
    studio = studio_of(request)
    undone = last_undone(studio.project)
    if undone is None:
        return _shown(request, done="nothing was taken back")
    entry = bring_back(studio.project, undone, who=who_of(request))
    _stand_at(request, pictures_of(entry))
    return _shown(request, done="brought back")


@router.get("/label/news")
def news(
    request: Request,
    picture: Annotated[str, Query(max_length=2000)],
    version: int,
    at: Annotated[str, Query(max_length=200)] = "",
) -> Response:
    """The same picture with newer proposals; nothing where there are none."""
    studio = studio_of(request)
    here = studio.trails.of(request.state.session).here
    if studio.proposer.latest().version == version or picture != here:
        return Response(status_code=204)
    return _shown(request, at=at)


def _shown(request: Request, *, at: str = "", done: str = "") -> Response:
    studio = studio_of(request)
    here = studio.trails.of(request.state.session).here
    if here is None:
        raise SeeWhyError("there is no picture to label; send some on the page Begin")
    if request.method == "POST" and not from_script(request):
        query = {"picture": here, **({"at": at} if at else {})}
        return RedirectResponse(f"{PAGE.path}?{urlencode(query)}", 303)
    proposals = studio.proposer.latest()
    bench = _bench(studio, here, at=at)
    shown: dict[str, Any] = {
        "bench": bench,
        "proposals": proposals,
        "worth": dict(proposals.order).get(here),
        "done": done,
        "progress": progress_of(studio.project, proposals),
    }
    if not from_script(request):
        return render(request, "label.html", **shown)
    response = render(request, "_label_bench.html", **shown)
    response.headers["HX-Replace-Url"] = f"{PAGE.path}?{urlencode({'picture': here})}"
    return response


def _bench(studio: Studio, picture: str, *, at: str = "") -> Workbench:
    project = studio.project
    return workbench(
        picture,
        project.domain(),
        project.labels(),
        studio.proposer.latest(),
        class_first=class_comes_first(project),
        at=at,
    )


def _picture(studio: Studio, name: str) -> None:
    try:
        studio.project.picture_file(name)
    except LookupError as problem:
        raise SeeWhyError(f"{problem}; go on with the next") from None


def _after(studio: Studio, picture: str, name: str) -> str:
    """The question behind the one that was answered, the next open one if there is any."""
    questions = _bench(studio, picture).questions
    names = [question.name for question in questions]
    place = names.index(name) + 1 if name in names else 0
    behind = [*questions[place:], *questions[:place]]
    return next((question.name for question in behind if question.label is None), name)


def _next(request: Request) -> None:
    studio = studio_of(request)
    trail = studio.trails.of(request.state.session)
    here = trail.here
    if trail.go_on(_order(studio)) is None:
        first = next((name for name in _order(studio) if name != here), None)
        if first is not None:
            trail.visit(first)


def _order(studio: Studio) -> Iterator[str]:
    """Pictures by what a label is worth, then what is open in the order of the names, then all."""
    labels: Mapping[str, Mapping[str, object]] = studio.project.labels().of
    domain = studio.project.domain()
    wanted = {CLASS, *domain.features}
    pictures = studio.project.pictures()
    there = set(pictures)

    def is_open(name: str) -> bool:
        return name in there and not wanted <= labels.get(name, {}).keys()

    yield from (name for name, _ in studio.proposer.latest().order if is_open(name))
    yield from filter(is_open, pictures)
    yield from pictures


def _stand_at(request: Request, pictures: tuple[str, ...]) -> None:
    studio = studio_of(request)
    there = set(studio.project.pictures())
    found = next((name for name in pictures if name in there), None)
    if found is not None:
        studio.trails.of(request.state.session).visit(found)
