"""Robot: a run as it happens, beliefs beside truth, questions about it, and what if."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any

from fastapi import APIRouter, File, Form, HTTPException, Query, Request, Response, UploadFile
from fastapi.responses import FileResponse, RedirectResponse

from seewhy.errors import PlanningError, SeeWhyError
from seewhy.planning.dialogue.run_answers import PlanningReply
from seewhy.planning.execution.simulation import ground_fluents
from seewhy.planning.goal import example_fluent
from seewhy.planning.spoken_goals import SpokenGoals, goal_of
from seewhy.studio.jobs import Job, jobs_of
from seewhy.studio.pages.page import Page
from seewhy.studio.rendering import from_script, render
from seewhy.studio.robot_beginnings import Beginning, keep_file, scenes_kept
from seewhy.studio.robot_process import PAGE_FILE
from seewhy.studio.robot_runs import (
    RobotRun,
    answer,
    domains_of,
    questions_about,
    run_of,
    supposable,
    what_if,
)
from seewhy.studio.session import who_of
from seewhy.studio.state import Studio, studio_of
from seewhy.text.nearest import did_you_mean

__all__ = ["PAGE", "TASK"]

router = APIRouter()
PAGE = Page("/robot", "Robot", router)
TASK = "robot"

_NOTHING_ASKED = {"goal": "", "seed": 0, "steps": 60, "at_first": [], "scene": "", "history": ""}
_KEPT = {"Cache-Control": "private, max-age=3600"}
Text = Annotated[str, Form(max_length=2000)]


@router.get(PAGE.path)
def show(request: Request, domain: Annotated[str, Query(max_length=4000)] = "") -> Response:
    """The page: the form, and the run that was begun last."""
    return _shown(request, domain=domain)


@router.post(PAGE.path)
def begin(
    request: Request,
    domain: Annotated[str, Form(max_length=4000)] = "",
    folder: Annotated[str, Form(max_length=4000)] = "",
    goal: Text = "",
    seed: Annotated[int, Form(ge=0, le=2**31 - 1)] = 0,
    steps: Annotated[int, Form(ge=1, le=200)] = 60,
    at_first: Text = "",
    scene: Annotated[str, Form(max_length=4000)] = "",
    number: Annotated[str, Form(pattern=r"^\d{0,9}$")] = "",
    scene_file: Annotated[UploadFile | None, File()] = None,
    history_file: Annotated[UploadFile | None, File()] = None,
) -> Response:
    """Let the robot run; what cannot be is said before anything begins."""
    studio = studio_of(request)
    name = _domain(studio, domain, folder.strip())
    if scene and scene not in scenes_kept(studio.project, name):
        raise SeeWhyError("that scene is none of the list; send its file")
    if (sent := _sent(studio, scene_file)) is not None:
        scene = f"{sent}#{number}" if number else str(sent)
    history = _sent(studio, history_file)
    beginning = Beginning(name, scene, "" if history is None else str(history))
    loaded = beginning.load()
    goal_of(goal, loaded)
    beginning.past(loaded)
    literals = [part.strip() for part in at_first.split(";") if part.strip()]
    ground_fluents(literals, loaded.knowledge)
    asked = {**asdict(beginning), "goal": goal, "seed": seed, "steps": steps, "at_first": literals}
    jobs_of(studio.project).start(
        TASK,
        "seewhy.studio.robot_process",
        [json.dumps(asked), "{job}"],
        who=who_of(request),
        asked=asked,
    )
    return RedirectResponse(PAGE.path, 303)


@router.get("/robot/steps")
def more_steps(request: Request, after: Annotated[int, Query(ge=0)] = 0) -> Response:
    """The steps that came since; when the run has ended, the whole page is to be shown."""
    job = jobs_of(studio_of(request).project).last(TASK)
    if job is None or not job.runs:
        return Response(headers={"HX-Refresh": "true"})
    steps = run_of(job).steps
    if len(steps) <= after:
        return Response(status_code=204)
    return render(request, "_robot_steps.html", job=job, steps=steps[after:], count=len(steps))


@router.get("/robot/map/{number}/{step}.svg")
def plan_map(request: Request, number: int, step: int) -> Response:
    """The map at a step of a run."""
    jobs = jobs_of(studio_of(request).project).of(TASK)
    job = next((job for job in jobs if job.number == number), None)
    steps = run_of(job).steps if job else ()
    if not 0 <= step < len(steps) or not steps[step]["map"]:
        raise HTTPException(404, "there is no map of such a step")
    return Response(steps[step]["map"], media_type="image/svg+xml", headers=_KEPT)


@router.post("/robot/stop")
def stop(request: Request) -> Response:
    """Interrupt the run."""
    jobs_of(studio_of(request).project).stop(TASK)
    return RedirectResponse(PAGE.path, 303)


@router.post("/robot/ask")
def ask(request: Request, question: Text = "") -> Response:
    """Answer a question about the run."""
    job = _last(request)
    return _answered(request, question, answer(job, question))


@router.post("/robot/what-if")
def suppose(
    request: Request,
    fluent: Text,
    holds: Annotated[bool, Form()] = True,
    step: Annotated[str, Form(pattern=r"^\d{0,4}$")] = "",
) -> Response:
    """Say what the robot would do if something were so."""
    job = _last(request)
    reply = what_if(job, fluent if holds else f"-{fluent}", step=int(step) if step else None)
    return _answered(request, f"{reply.query.text}?", reply)


@router.get("/robot/run.html")
def page(request: Request) -> Response:
    """The run as one file that opens with no network."""
    job = jobs_of(studio_of(request).project).last(TASK)
    file = None if job is None else job.folder / PAGE_FILE
    if file is None or not file.is_file():
        raise HTTPException(404, "no run has ended yet; let the robot run on the page Robot")
    return FileResponse(file, media_type="text/html", filename="run.html")


def _shown(
    request: Request, *, domain: str = "", question: str = "", reply: PlanningReply | None = None
) -> Response:
    studio = studio_of(request)
    job = jobs_of(studio.project).last(TASK)
    asked: dict[str, Any] = dict(job.asked) if job else {}
    domains = domains_of(studio.project)
    if asked.get("domain"):
        domains.setdefault(asked["domain"], Path(asked["domain"]).name)
    chosen = domain or asked.get("domain") or next(iter(domains))
    problem, example = "", ""
    questions: tuple[str, ...] = ()
    literals: dict[str, str] = {}
    scenes: dict[str, str] = {}
    goals: tuple[str, ...] = ()
    try:
        name = _domain(studio, chosen, "")
        scenes = scenes_kept(studio.project, name)
        same = chosen == asked.get("domain")
        loaded = (Beginning.of(asked) if same else Beginning(name)).load()
        example = example_fluent(loaded.knowledge)
        literals = supposable(loaded)
        goals = tuple(SpokenGoals(loaded).examples())
        if job is not None:
            questions = questions_about(Beginning.of(asked))
    except SeeWhyError as said:
        problem = str(said)
    run = run_of(job) if job else RobotRun(())
    same = chosen == asked.get("domain")
    return render(
        request,
        "robot.html",
        job=job,
        run=run,
        domains=domains,
        chosen=chosen,
        asked=asked if same else _NOTHING_ASKED,
        example=example,
        scenes=scenes,
        goals=goals,
        questions=questions,
        literals=literals,
        same=same,
        problem=problem,
        question=question,
        reply=reply,
        actions=_actions(job, reply),
        local=studio.local,
    )


def _answered(request: Request, question: str, reply: PlanningReply) -> Response:
    if not from_script(request):
        return _shown(request, question=question, reply=reply)
    actions = _actions(_last(request), reply)
    return render(request, "_robot_answer.html", question=question, reply=reply, actions=actions)


def _actions(job: Job | None, reply: PlanningReply | None) -> list[str]:
    """What the robot would do, as words."""
    if job is None or reply is None:
        return []
    import clingo

    words = Beginning.of(job.asked).load().words
    found = reply.reasons.get("actions", ())
    return [words.do(clingo.parse_term(action)) for action in found]


def _sent(studio: Studio, file: UploadFile | None) -> Path | None:
    """Keep a file that was chosen; None where none was."""
    if file is None or not file.filename:
        return None
    return keep_file(studio.project, file.filename, file.file)


def _last(request: Request) -> Job:
    job = jobs_of(studio_of(request).project).last(TASK)
    if job is None:
        raise PlanningError("there is no run to ask about; let the robot run first")
    return job


def _domain(studio: Studio, chosen: str, folder: str) -> str:
    """The domain that is meant: one of the list, or a folder that a browser of this machine names.

    Raises
    ------
    SeeWhyError
        If it is none of them.
    """
    known = domains_of(studio.project)
    if folder or chosen not in known:
        named = folder or chosen
        if studio.local and Path(named).expanduser().is_dir():
            return str(Path(named).expanduser().resolve())
        raise SeeWhyError(
            f"'{named}' is no domain that plans; {did_you_mean(named, tuple(known))}"
            if not folder
            else f"{named} is no folder that the studio may read; name one of this machine"
        )
    return chosen
