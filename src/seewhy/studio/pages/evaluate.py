"""Evaluate: figures beside chance, and wrong pictures, each a click from its correction."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Annotated, Any

from fastapi import APIRouter, Form, HTTPException, Query, Request, Response
from fastapi.responses import FileResponse, RedirectResponse

from seewhy.domain.domain import Domain
from seewhy.domain.tables import CLASS
from seewhy.errors import SeeWhyError
from seewhy.studio.jobs import FINISHED, Job, jobs_of
from seewhy.studio.keeping_back import keep_back, kept, suggested_pattern
from seewhy.studio.labelling import pictures_of
from seewhy.studio.model_there import other_kind
from seewhy.studio.pages.evaluate_things import (
    is_of_things_seen,
    rows_of_things,
    wrong_pictures,
)
from seewhy.studio.pages.page import Page
from seewhy.studio.project import Project
from seewhy.studio.rendering import render
from seewhy.studio.session import who_of
from seewhy.studio.state import studio_of

__all__ = ["PAGE", "TASK", "evaluation_file"]

router = APIRouter()
PAGE = Page("/evaluate", "Evaluate", router)
TASK = "evaluate"

TILES = 60
"""Wrong pictures that are shown at once."""

_TABLE = 12
"""Of more values than these only what was confused is listed."""

_NO_MODEL = "there is no model yet; train one on labelled pictures"
_NONE_KEPT = (
    "no labelled picture is kept for evaluation: all train, and results on pictures that were "
    "trained on prove nothing; keep a quarter, and train again"
)


@dataclass(frozen=True)
class Wrong:
    """A wrong picture as a tile.

    Attributes
    ----------
    picture : str
    said, annotated : str
        The class that the model said and the one that is annotated, in words.
    wrong_class : bool
    probability : float or None
        Of the class said.
    misread : sequence of mapping
        ``words``, ``seen``, ``probability`` and ``annotated`` of each feature.
    at : str
        Which question of the Label page it is about.
    changed : bool
        Whether its labels were changed since.
    """

    picture: str
    said: str
    annotated: str
    wrong_class: bool
    probability: float | None
    misread: Sequence[Mapping[str, Any]]
    at: str
    changed: bool


@router.get(PAGE.path)
def show(request: Request, start: Annotated[int, Query(ge=0, le=1_000_000)] = 0) -> Response:
    """The page: what keeps from evaluating, or the last evaluation."""
    project = studio_of(request).project
    if project.domain_folder is None:
        return render(request, "evaluate.html", problem="no domain", job=None, found=None)
    jobs = jobs_of(project).of(TASK)
    done = next((job for job in jobs if job.state == FINISHED), None)
    found = done.printed() if done else None
    domain = project.domain()
    if is_of_things_seen(found) != (domain.things is not None):
        found = None  # it is of the domain as it was, which had things, or had none
    shown: dict[str, Any] = {"rows": (), "wrong": (), "more": 0, "stale": False}
    if done is not None and found:
        shown = {**_figures(project, done, found, start), "stale": _is_stale(project, done)}
    return render(
        request,
        "evaluate.html",
        problem=_problem(project),
        job=jobs[0] if jobs else None,
        done=done,
        found=found,
        has_file=evaluation_file(project) is not None,
        things=domain.things,
        start=start,
        suggested=suggested_pattern(project),
        tiles=TILES,
        counts=kept(project.labels(), domain.things),
        **shown,
    )


@router.get("/evaluate/state")
def state(request: Request) -> Response:
    """How far the evaluation is; when it has ended, the whole page is to be shown."""
    job = jobs_of(studio_of(request).project).last(TASK)
    if job is None or not job.runs:
        return Response(headers={"HX-Refresh": "true"})
    return render(request, "_job.html", job=job, address="/evaluate/state")


@router.post(PAGE.path)
def begin(request: Request) -> Response:
    """Evaluate the model on the pictures that are kept."""
    project = studio_of(request).project
    project.domain()
    problem = _problem(project)
    if problem:
        raise SeeWhyError(problem)
    model = project.model_folder.name
    command = [TASK, model, "--data", ".", "--json", "--page", "{job}/page.html"]
    jobs_of(project).start(TASK, "seewhy", command, who=who_of(request))
    return RedirectResponse(PAGE.path, 303)


@router.post("/evaluate/stop")
def stop(request: Request) -> Response:
    """Interrupt the evaluation."""
    jobs_of(studio_of(request).project).stop(TASK)
    return RedirectResponse(PAGE.path, 303)


@router.post("/evaluate/keep-back")
def keep(request: Request, together: Annotated[str, Form(max_length=200)] = "") -> Response:
    """Keep a quarter of the labelled pictures; the model has to be trained again without them."""
    project = studio_of(request).project
    project.domain()
    keep_back(project, who=who_of(request), pattern=together)
    return RedirectResponse("/train", 303)


@router.get("/evaluate/page.html")
def page(request: Request) -> Response:
    """The last evaluation as one file that opens with no network."""
    project = studio_of(request).project
    file = evaluation_file(project)
    if file is None:
        raise HTTPException(404, "nothing was evaluated yet; evaluate on the page Evaluate")
    return FileResponse(file, media_type="text/html", filename=f"{project.name}-evaluation.html")


def evaluation_file(project: Project) -> Path | None:
    """The page of the last evaluation; None where there is none."""
    done = next((job for job in jobs_of(project).of(TASK) if job.state == FINISHED), None)
    file = None if done is None else done.folder / "page.html"
    return file if file is not None and file.is_file() else None


def _problem(project: Project) -> str:
    if not project.has_model:
        return _NO_MODEL
    other = other_kind(project)
    if other is not None:
        return other.sentence[:-1]
    return "" if kept(project.labels(), project.domain().things)["test"] else _NONE_KEPT


def _figures(project: Project, done: Job, found: Mapping[str, Any], start: int) -> dict[str, Any]:
    """The rows and the wrong pictures of an evaluation, from one of them on."""
    domain, pictures = project.domain(), set(project.pictures())
    changed = {
        picture
        for entry in project.record.holding()
        if entry.number > done.number
        for picture in pictures_of(entry)
    }
    some = slice(start, start + TILES)
    if domain.things is not None:
        tiles = wrong_pictures(found, pictures=pictures, changed=changed)
        rows: list[Any] = list(rows_of_things(domain, found))
        return {"rows": rows, "wrong": tiles[some], "more": max(0, len(tiles) - start - TILES)}
    wrong = [picture for picture in found["wrong"] if picture["image"] in pictures]
    return {
        "rows": list(_rows(domain, found)),
        "wrong": list(_tiles(domain, wrong[some], changed=changed)),
        "more": max(0, len(wrong) - start - TILES),
    }


def _is_stale(project: Project, job: Job) -> bool:
    """Whether the model is another by now."""
    try:
        changed = (project.model_folder / "model.json").stat().st_mtime
    except OSError:
        return True
    return datetime.fromtimestamp(changed, UTC) > datetime.fromisoformat(job.started)


def _rows(domain: Domain, found: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    recognitions = {CLASS: found["class_recognition"], **found["feature_recognition"]}
    for key, recognition in recognitions.items():
        confusion = recognition["confusion"]
        values, undecided = confusion["values"], any(confusion["undecided"])
        matrix = [
            (value, [*counts, *([left] if undecided else [])])
            for value, counts, left in zip(
                values, confusion["counts"], confusion["undecided"], strict=True
            )
        ]
        confused = [
            (true, said, count)
            for true, counts in zip(values, confusion["counts"], strict=True)
            for said, count in zip(values, counts, strict=True)
            if count and true != said
        ]
        yield {
            **recognition,
            "words": domain.features[key].name if key in domain.features else key,
            "columns": [*values, *(["undecided"] if undecided else [])],
            "matrix": matrix if len(values) <= _TABLE else None,
            "confused": sorted(confused, key=lambda one: -one[2])[:TILES],
        }


def _tiles(
    domain: Domain, wrong: list[Mapping[str, Any]], *, changed: Collection[str]
) -> Iterator[Wrong]:
    for picture in wrong:
        misread = [
            {**read, "words": domain.features[read["feature"]].name}
            for read in picture["misread"]
            if read["feature"] in domain.features
        ]
        yield Wrong(
            picture["image"],
            _said(domain, picture["said"]) if picture["said"] else "undecided",
            _said(domain, picture["class"]) if picture["class"] else "no class",
            picture["class"] is not None and picture["said"] != picture["class"],
            picture["probability"],
            misread,
            misread[0]["feature"] if misread else CLASS,
            picture["image"] in changed,
        )


def _said(domain: Domain, label: str) -> str:
    return domain.classes[label].say if label in domain.classes else label
