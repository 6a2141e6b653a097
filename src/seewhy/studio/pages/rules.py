"""Rules: knowledge.al with its sentences and how they stand; rules by example, or as learned."""

from __future__ import annotations

import re
from typing import Annotated, Any
from urllib.parse import urlencode

from fastapi import APIRouter, Form, Query, Request, Response
from fastapi.responses import RedirectResponse

from seewhy.errors import DomainError, KnowledgeError, SeeWhyError
from seewhy.revision.edit import KNOWLEDGE
from seewhy.studio.labelled_scenes import labelled_scenes
from seewhy.studio.pages import rules_by_example
from seewhy.studio.pages.page import Page
from seewhy.studio.project import Project
from seewhy.studio.rendering import render
from seewhy.studio.revised_domain import revised_domain
from seewhy.studio.rule_standing import rules_standing
from seewhy.studio.session import who_of
from seewhy.studio.state import studio_of
from seewhy.studio.text_edits import edits_between
from seewhy.studio.writing import digest_of_text, read_text

__all__ = ["PAGE"]

router = APIRouter()
router.include_router(rules_by_example.router)
PAGE = Page("/rules", "Rules", router)

_LONGEST = 200_000
_PLACE = re.compile(r"knowledge\.al:(\d+):(\d+)")

Text = Annotated[str, Form(max_length=_LONGEST)]


@router.get(PAGE.path)
def show(request: Request, done: Annotated[str, Query(max_length=500)] = "") -> Response:
    """The rules as they are written."""
    project = studio_of(request).project
    if project.domain_folder is None:
        return render(request, "rules.html", text=None)
    text = _knowledge(project)
    read = _read(project, text)
    return render(
        request, "rules.html", text=text, base=digest_of_text(text), done=done, problem="", **read
    )


@router.post("/rules/check")
def check(request: Request, text: Text = "") -> Response:
    """How rules would stand that are being typed; nothing is kept."""
    project = studio_of(request).project
    _require_domain(project)
    return render(request, "_rules_read.html", **_read(project, text))


@router.post("/rules/save")
def save(
    request: Request, text: Text = "", base: Annotated[str, Form(max_length=64)] = ""
) -> Response:
    """Keep the rules as they were typed, as one revision that can be taken back."""
    project = studio_of(request).project
    _require_domain(project)
    before = _knowledge(project)
    read = _read(project, text)
    problem = read["wrong"]
    if not problem and base != digest_of_text(before):
        problem = (
            "the rules were changed since this page was loaded; copy what you typed, load the "
            "page again and put it in"
        )
    if problem:
        shown: dict[str, Any] = {**read, "text": text, "base": base, "done": "", "problem": problem}
        return render(request, "rules.html", status=422, **shown)
    edits = edits_between(KNOWLEDGE, before, text)
    done = "nothing was changed"
    if edits:
        entry = project.revise(edits, why="edited", who=who_of(request))
        done = f"kept as entry {entry.number}"
    return RedirectResponse(f"{PAGE.path}?{urlencode({'done': done})}", 303)


def _require_domain(project: Project) -> None:
    if project.domain_folder is None:
        raise SeeWhyError("there is no domain yet; name classes and features on the page Begin")


def _knowledge(project: Project) -> str:
    assert project.domain_folder is not None
    return read_text(project.domain_folder / KNOWLEDGE) or ""


def _read(project: Project, text: str) -> dict[str, Any]:
    """What a text says and how that stands, or what is wrong with it and where."""
    assert project.domain_folder is not None
    try:
        domain = revised_domain(project.domain_folder, {KNOWLEDGE: text.replace("\r\n", "\n")})
    except (KnowledgeError, DomainError) as problem:
        place = _PLACE.search(str(problem))
        at = (int(place[1]), int(place[2])) if place else None
        return {"wrong": str(problem), "place": at, "standing": None}
    standing = rules_standing(domain, labelled_scenes(project))
    return {"wrong": "", "place": None, "standing": standing}
