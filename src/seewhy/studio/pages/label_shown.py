"""What the page Label shows: the picture at hand, its things, and where one goes from there."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any
from urllib.parse import urlencode

from fastapi import Form, Request, Response
from fastapi.responses import RedirectResponse

from seewhy.errors import PictureError, SeeWhyError
from seewhy.studio.drawing import picture_size
from seewhy.studio.labelling import class_comes_first, pictures_of
from seewhy.studio.progress import progress_of
from seewhy.studio.record import Entry
from seewhy.studio.rendering import from_script, render
from seewhy.studio.state import Studio, studio_of
from seewhy.studio.thing_bench import ThingBench, thing_bench
from seewhy.studio.what_next import what_next, why_next
from seewhy.studio.workbench import Workbench, workbench

__all__ = [
    "GO_ON",
    "Name",
    "bench_of",
    "go_on",
    "question_after",
    "shown",
    "shown_after",
]

Name = Annotated[str, Form(max_length=2000)]
"""A picture, a thing, or what is said, as a form brings it."""

GO_ON = "go on with the next"
"""What to do where a picture is not there any more."""

_ADDRESS = "/label"


def shown(request: Request, *, at: str = "", thing: str = "", done: str = "") -> Response:
    """The picture at which the browser stands: a page, or the part of it that scripts ask for.

    Parameters
    ----------
    request : Request
    at : str
        The question at hand; the first that is open where it is none.
    thing : str
        The thing at hand; none where the picture has no such thing.
    done : str
        What was done, in words.

    Raises
    ------
    SeeWhyError
        If there is no picture.
    """
    studio = studio_of(request)
    here = studio.trails.of(request.state.session).here
    if here is None:
        raise SeeWhyError("there is no picture to label; send some on the page Begin")
    if request.method == "POST" and not from_script(request):
        query = {"picture": here, "at": at, "thing": thing}
        said = {key: text for key, text in query.items() if text}
        return RedirectResponse(f"{_ADDRESS}?{urlencode(said)}", 303)
    proposals = studio.proposer.latest()
    filled: dict[str, Any] = {
        "bench": bench_of(studio, here, at=at),
        "things": _things(studio, here, at=at, thing=thing),
        "proposals": proposals,
        "why_next": why_next(here, studio.project.labels(), studio.project.domain(), proposals),
        "done": done,
        "progress": progress_of(studio.project, proposals),
    }
    if not from_script(request):
        return render(request, "label.html", **filled)
    response = render(request, "_label_bench.html", **filled)
    response.headers["HX-Replace-Url"] = f"{_ADDRESS}?{urlencode({'picture': here})}"
    return response


def bench_of(studio: Studio, picture: str, *, at: str = "") -> Workbench:
    """What is shown of a picture as a whole."""
    project = studio.project
    return workbench(
        picture,
        project.domain(),
        project.labels(),
        studio.proposer.latest(),
        class_first=class_comes_first(project),
        at=at,
    )


def _things(studio: Studio, picture: str, *, at: str, thing: str) -> ThingBench | None:
    things = studio.project.domain().things
    if things is None:
        return None
    try:
        size = picture_size(studio.project.picture_file(picture))
    except (LookupError, PictureError):
        size = None
    here = studio.project.labels().drawn_in(picture)
    return thing_bench(here, things, size=size, chosen=thing, at=at)


def question_after(studio: Studio, picture: str, name: str) -> str:
    """The question behind the one that was answered, the next open one if there is any."""
    questions = bench_of(studio, picture).questions
    names = [question.name for question in questions]
    place = names.index(name) + 1 if name in names else 0
    behind = [*questions[place:], *questions[:place]]
    return next((question.name for question in behind if question.label is None), name)


def go_on(request: Request) -> None:
    """Stand at the next picture."""
    studio = studio_of(request)
    trail = studio.trails.of(request.state.session)
    here = trail.here
    if trail.go_on(_order(studio)) is None:
        first = next((name for name in _order(studio) if name != here), None)
        if first is not None:
            trail.visit(first)


def _order(studio: Studio) -> Iterator[str]:
    project = studio.project
    pictures, labels = project.pictures(), project.labels()
    return what_next(pictures, labels, project.domain(), studio.proposer.latest())


def shown_after(request: Request, entry: Entry, *, done: str) -> Response:
    """The picture, and the thing, that an entry of the record is about."""
    studio = studio_of(request)
    there = set(studio.project.pictures())
    found = next((name for name in pictures_of(entry) if name in there), None)
    if found is None:
        return shown(request, done=done)
    studio.trails.of(request.state.session).visit(found)
    boxes: dict[str, object] = entry.body.get("boxes", {}).get(found, {})
    related: list[list[str]] = entry.body.get("related", {}).get(found, [])
    named = (*boxes, *(said[1] for said in related))
    return shown(request, thing=next(iter(named), ""), done=done)
