"""Train: training as a job, with progress; it goes on where it was stopped."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from fastapi import APIRouter, Form, Request, Response
from fastapi.responses import RedirectResponse

from seewhy.data.training_needs import require_feature_labels, require_two_classes
from seewhy.domain.things import Things
from seewhy.errors import SeeWhyError
from seewhy.studio.drawn_things import BOXES
from seewhy.studio.jobs import FINISHED, Job, jobs_of
from seewhy.studio.keeping_back import keep_back, kept, place, suggested_pattern
from seewhy.studio.labels import LABEL
from seewhy.studio.pages.page import Page
from seewhy.studio.project import Project
from seewhy.studio.rendering import render
from seewhy.studio.session import who_of
from seewhy.studio.state import studio_of
from seewhy.studio.time_left import PICTURES, WENT_ON, time_left

__all__ = ["PAGE", "TASK"]

router = APIRouter()
PAGE = Page("/train", "Train", router)
TASK = "train"

SHOWN = 10
"""Trainings that are listed, the last ones."""


@dataclass(frozen=True)
class Ready:
    """What there is to train on.

    Attributes
    ----------
    train, test : int
        Labelled pictures to train on, and those kept for evaluation; where the domain has things,
        pictures with a box around each.
    problem : str
        What is missing, as ``seewhy train`` says it.
    since : int
        Labels that came since the last training that was finished.
    goes_on : bool
        Whether a training was stopped that goes on where it was.
    things : Things or None
        The domain's, where its pictures show several.
    """

    train: int
    test: int
    problem: str
    since: int
    goes_on: bool
    things: Things | None


@router.get(PAGE.path)
def show(request: Request) -> Response:
    """The page."""
    project = studio_of(request).project
    if project.domain_folder is None:
        return render(request, "train.html", ready=None, job=None, jobs=())
    jobs = jobs_of(project).of(TASK)
    job = jobs[0] if jobs else None
    return render(
        request,
        "train.html",
        ready=_ready(project, jobs),
        job=job,
        in_all=time_left(job, jobs[1:]) if job is not None and job.runs else "",
        jobs=jobs[:SHOWN],
        suggested=suggested_pattern(project),
    )


@router.get("/train/state")
def state(request: Request) -> Response:
    """How far the training is; when it has ended, the whole page is to be shown."""
    jobs = jobs_of(studio_of(request).project).of(TASK)
    job = jobs[0] if jobs else None
    if job is None or not job.runs:
        return Response(headers={"HX-Refresh": "true"})
    in_all = time_left(job, jobs[1:])
    return render(request, "_job.html", job=job, address="/train/state", in_all=in_all)


@router.post(PAGE.path)
def begin(request: Request) -> Response:
    """Begin to train, or go on where it was stopped."""
    project, who = studio_of(request).project, who_of(request)
    domain = project.domain()
    place(project, who=who)
    _require_enough(project)
    # As somebody would type it in the project's folder.
    folder = project.domain_folder or project.folder
    name = folder.relative_to(project.folder).as_posix()
    arguments = [TASK, name, "--data", ".", "--out", project.model_folder.name]
    asked = {
        "domain": domain.name,
        PICTURES: kept(project.labels(), domain.things)["train"],
        WENT_ON: _checkpoints(project).is_dir(),
    }
    jobs_of(project).start(TASK, "seewhy", arguments, who=who, asked=asked)
    return RedirectResponse(PAGE.path, 303)


@router.post("/train/stop")
def stop(request: Request) -> Response:
    """Interrupt the training; what is learned so far is kept."""
    jobs_of(studio_of(request).project).stop(TASK)
    return RedirectResponse(PAGE.path, 303)


@router.post("/train/anew")
def anew(request: Request) -> Response:
    """Forget what an interrupted training has learned, and begin."""
    project = studio_of(request).project
    job = jobs_of(project).last(TASK)
    if job is None or not job.runs:
        shutil.rmtree(_checkpoints(project), ignore_errors=True)
    return begin(request)


@router.post("/train/keep-back")
def keep(request: Request, together: Annotated[str, Form(max_length=200)] = "") -> Response:
    """Keep a quarter of the labelled pictures for evaluation."""
    project = studio_of(request).project
    project.domain()
    keep_back(project, who=who_of(request), pattern=together)
    return RedirectResponse(PAGE.path, 303)


def _require_enough(project: Project) -> None:
    things = project.domain().things
    if things is not None:
        _require_boxes(project, things)
        return
    if not project.labels().of:
        raise SeeWhyError(
            "no picture is labelled yet; label some of at least two classes, a few dozen of each "
            "if you can"
        )
    train = project.dataset().of_split("train")
    require_two_classes(train)
    require_feature_labels(train)


def _require_boxes(project: Project, things: Things) -> None:
    # What teaches things brings the networks along, which no other page of the studio waits for.
    from seewhy.agent.things.thing_lessons import FEWEST, require_boxes

    if not any(here.things for here in project.labels().drawn.values()):
        raise SeeWhyError(
            f"no {things.one} is drawn yet; draw a box around each in at least {FEWEST} pictures, "
            "a hundred if you can"
        )
    require_boxes(project.dataset().of_split("train"))


def _ready(project: Project, jobs: Sequence[Job]) -> Ready:
    problem, things = "", None
    try:
        things = project.domain().things
        _require_enough(project)
    except SeeWhyError as said:
        problem = str(said)
    counts = kept(project.labels(), things)
    done = next((job.number for job in jobs if job.state == FINISHED), None)
    since = 0
    if done is not None:
        entries = [entry for kind in (LABEL, BOXES) for entry in project.record.holding(kind)]
        since = sum(entry.number > done for entry in entries)
    goes_on = _checkpoints(project).is_dir()
    return Ready(counts["train"], counts["test"], problem, since, goes_on, things)


def _checkpoints(project: Project) -> Path:
    model = project.model_folder
    return model.with_name(f"{model.name}.training")
