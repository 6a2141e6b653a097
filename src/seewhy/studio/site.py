"""The studio as an application: its pages, the pictures, and what the pages load."""

from __future__ import annotations

import secrets
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Annotated, cast

from fastapi import Depends, FastAPI, Form, Request, Response
from fastapi.exceptions import RequestValidationError
from fastapi.responses import RedirectResponse
from starlette.exceptions import HTTPException
from starlette.staticfiles import StaticFiles

from seewhy.errors import SeeWhyError
from seewhy.studio.access import AccessRules
from seewhy.studio.guard import Guard, require_csrf
from seewhy.studio.pages import PAGES, pictures
from seewhy.studio.per_session import PerSession
from seewhy.studio.project import Project
from seewhy.studio.project_model import ProjectModel
from seewhy.studio.project_things import ProjectThings
from seewhy.studio.proposing import Embed, Proposer, backbone_embedding
from seewhy.studio.rendering import STATIC, from_script, render
from seewhy.studio.session import THEMES, Theme, keep_theme, keep_who
from seewhy.studio.state import Studio
from seewhy.studio.talk import Talk
from seewhy.studio.thing_talk import ThingTalk
from seewhy.studio.trail import Trail

__all__ = ["site"]


def site(project: Project, *, rules: AccessRules, embed: Embed | None = None) -> FastAPI:
    """Return the application that shows a project.

    Parameters
    ----------
    project : Project
    rules : AccessRules
        Who may ask, and how large a request may be.
    embed : callable, optional
        What looks at pictures for the proposals; the domain's backbone where left out.
    """
    proposer = Proposer(project, embed or backbone_embedding())

    @asynccontextmanager
    async def lifespan(_: FastAPI) -> AsyncIterator[None]:
        proposer.start()
        yield
        proposer.close()

    app = FastAPI(
        title="SeeWhy studio", openapi_url=None, docs_url=None, redoc_url=None, lifespan=lifespan
    )
    app.state.studio = Studio(
        project,
        proposer,
        PerSession(Trail),
        ProjectModel(project),
        PerSession(Talk),
        ProjectThings(project),
        PerSession(ThingTalk),
        local=not rules.token,
    )
    app.state.csrf_key = secrets.token_bytes(32)
    for page in PAGES:
        app.include_router(page.router, dependencies=[Depends(require_csrf)])
    app.include_router(pictures.router, dependencies=[Depends(require_csrf)])
    app.mount("/static", StaticFiles(directory=STATIC), name="static")

    @app.get("/")
    def first() -> Response:
        return RedirectResponse("/begin" if project.domain_folder is None else "/label", 303)

    @app.post("/settings", dependencies=[Depends(require_csrf)])
    def settings(
        theme: Annotated[str, Form()] = "",
        who: Annotated[str, Form(max_length=60)] = "",
        back: Annotated[str, Form(max_length=200)] = "/",
    ) -> Response:
        known = any(back == page.path for page in PAGES)
        response = RedirectResponse(back if known else "/", 303)
        if theme in THEMES:
            keep_theme(response, cast("Theme", theme))
        if who.strip():
            keep_who(response, who.strip())
        return response

    @app.exception_handler(SeeWhyError)
    async def say_problem(request: Request, problem: SeeWhyError) -> Response:
        return _said(request, str(problem), 422)

    @app.exception_handler(RequestValidationError)
    async def say_parts(request: Request, problem: RequestValidationError) -> Response:
        said = [f"{found['loc'][-1]}: {found['msg'].lower()}" for found in problem.errors()]
        return _said(request, "; ".join(said), 422)

    @app.exception_handler(HTTPException)
    async def say_status(request: Request, problem: HTTPException) -> Response:
        return _said(request, str(problem.detail), problem.status_code)

    app.add_middleware(Guard, rules=rules)
    _make_ready(app)
    return app


def _make_ready(app: FastAPI) -> None:
    """Make the routes of the pages ready here, where there is one thread.

    FastAPI else does so at the first request, with a filter of warnings that holds for all threads
    and that another thread may lift. No route matches a path without a slash, so all are looked at.
    """
    for route in app.routes:
        route.matches({"type": "http", "method": "GET", "path": "", "root_path": ""})


def _said(request: Request, text: str, status: int) -> Response:
    """A sentence as a page, or as the part of one that htmx shows."""
    template = "_problem.html" if from_script(request) else "problem.html"
    response = render(request, template, status=status, problem=text)
    if from_script(request):
        response.headers["HX-Retarget"] = "#problem"
        response.headers["HX-Reswap"] = "innerHTML"
    return response
