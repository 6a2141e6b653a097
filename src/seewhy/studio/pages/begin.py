"""Begin: pictures, classes and features become a domain; or what there is already is opened."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

from fastapi import APIRouter, File, Form, Request, Response, UploadFile
from fastapi.responses import RedirectResponse

from seewhy.data.importers import ImportRequest
from seewhy.errors import PictureError, SeeWhyError
from seewhy.new_domain.from_names import (
    MOST_THINGS,
    NamedDomain,
    domain_from_names,
    named_classes,
    named_features,
)
from seewhy.studio.incoming import Arrived, domain_place, from_folder, from_source, sent_picture
from seewhy.studio.opening_folders import open_folder
from seewhy.studio.pages.page import Page
from seewhy.studio.project import Project
from seewhy.studio.rendering import from_script, render
from seewhy.studio.session import who_of
from seewhy.studio.state import studio_of

__all__ = ["PAGE"]

router = APIRouter()
PAGE = Page("/begin", "Begin", router)

_SHOWN = 12
_MOST_FILES = 1000
_LONGEST = 100_000
_PATH = 4000

Text = Annotated[str, Form(max_length=_LONGEST)]
PathText = Annotated[str, Form(max_length=_PATH)]


@router.get(PAGE.path)
def show(request: Request) -> Response:
    """The page."""
    return _shown(request)


@router.post("/begin/pictures")
def pictures(
    request: Request, files: Annotated[list[UploadFile], File(max_length=_MOST_FILES)]
) -> Response:
    """Keep pictures that the browser sends."""
    project = studio_of(request).project
    kept, refused = 0, []
    for file in files:
        if not file.filename:
            continue
        try:
            kept += sent_picture(project, file.filename, file.file).is_new
        except PictureError as problem:
            refused.append(str(problem))
    project.refresh()
    return _after(request, Arrived(kept, tuple(refused)))


@router.post("/begin/folder")
def folder(request: Request, path: PathText) -> Response:
    """Take in the pictures of a folder of this machine."""
    return _after(request, from_folder(studio_of(request).project, _place(request, path)))


@router.post("/begin/names")
def names(
    request: Request,
    classes: Text = "",
    features: Text = "",
    table: Text = "",
    subject: Annotated[str, Form(max_length=100)] = "the picture",
    thing: Annotated[str, Form(max_length=100)] = "",
    of_things: Text = "",
    most: Annotated[int, Form(ge=1, le=1000)] = MOST_THINGS,
) -> Response:
    """Write the domain of what was named."""
    project = studio_of(request).project
    if project.domain_folder is not None:
        raise SeeWhyError(
            "there is a domain already; the page Rules changes it, or edit domain.toml in "
            f"{project.domain_folder}"
        )
    named = NamedDomain(
        named_classes(classes),
        named_features(features),
        table,
        subject,
        thing.strip(),
        named_features(of_things),
        most,
    )
    domain_from_names(named, domain_place(project), data=str(project.folder))
    project.refresh(who=who_of(request), why="begun with these names")
    return _to(request, "/label")


@router.post("/begin/export")
def export(
    request: Request,
    path: PathText,
    features: PathText = "",
    class_parts: Annotated[str, Form(max_length=500)] = "",
    subject: Annotated[str, Form(max_length=100)] = "the picture",
) -> Response:
    """Take in pictures that are labelled already."""
    asked = ImportRequest(
        _place(request, path),
        "",
        features=_place(request, features) if features.strip() else None,
        class_parts=class_parts.strip() or None,
    )
    project = studio_of(request).project
    from_source(project, asked, subject=subject, who=who_of(request))
    return _to(request, PAGE.path)


@router.post("/begin/open")
def open_what_there_is(request: Request, path: PathText) -> Response:
    """Open a domain, a dataset or a model: what it holds is copied into the project."""
    place = _place(request, path)
    open_folder(studio_of(request).project, place, who=who_of(request))
    return _to(request, PAGE.path)


def _place(request: Request, path: str) -> Path:
    if not studio_of(request).local:
        raise SeeWhyError(
            "paths of the studio's machine are not taken from others than its own browser; send "
            "the pictures instead"
        )
    if not path.strip():
        raise SeeWhyError("no path is given; write one such as /home/me/pictures")
    return Path(path.strip()).expanduser()


def _to(request: Request, path: str) -> Response:
    """Show another page: what is shown of this one changed in many places."""
    if from_script(request):
        return Response(headers={"HX-Redirect": path})
    return RedirectResponse(path, 303)


def _after(request: Request, arrived: Arrived) -> Response:
    if from_script(request):
        return render(request, "_begin_arrived.html", arrived=arrived, **_state(request))
    return _shown(request, arrived=arrived)


def _shown(request: Request, *, arrived: Arrived | None = None) -> Response:
    return render(request, "begin.html", arrived=arrived, **_state(request))


def _state(request: Request) -> dict[str, Any]:
    project: Project = studio_of(request).project
    domain = None if project.domain_folder is None else project.domain()
    pictures = project.pictures()
    step = max(1, len(pictures) // _SHOWN)
    return {
        "domain": domain,
        "most_things": MOST_THINGS,
        "count": len(pictures),
        "some": pictures[::step][:_SHOWN],
        "labelled": len(project.labels().of),
        "local": studio_of(request).local,
    }
