"""The application: a model's answers as resources of HTTP."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from fastapi import FastAPI, File, Form, Request, Response, UploadFile
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException

from seewhy.classification.rows import columns_of
from seewhy.errors import SeeWhyError
from seewhy.studio.access import Access, AccessRules
from seewhy.studio.answers import Seen, answered, classified, explained, supposed
from seewhy.studio.batches import Batches, BusyError
from seewhy.studio.bounded import Bounded
from seewhy.studio.metrics import Metrics

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent

__all__ = ["Limits", "application"]

_PATHS = frozenset({"/ask", "/classify", "/explain", "/what-if", "/health", "/metrics"})

Image = Annotated[UploadFile, File(description="A picture file.")]


@dataclass(frozen=True)
class Limits:
    """How much one request, and all together, may take.

    Attributes
    ----------
    seconds : float
        Of a request, waiting included.
    waiting : int
        Pictures that wait to be looked at.
    """

    seconds: float = 60.0
    waiting: int = 512


def application(agent: Agent, *, rules: AccessRules, limits: Limits | None = None) -> FastAPI:
    """Return the application that answers with a trained agent.

    Parameters
    ----------
    agent : Agent
    rules : AccessRules
        Who may ask.
    limits : Limits, optional
    """
    bounds = limits or Limits()
    batches = Batches(agent, most=bounds.waiting)
    metrics = Metrics()
    columns = columns_of(agent.domain)

    @asynccontextmanager
    async def lifespan(_: FastAPI) -> AsyncIterator[None]:
        yield
        batches.close()

    # The pages of FastAPI fetch scripts from elsewhere; the description itself needs none.
    app = FastAPI(
        title=f"SeeWhy: {agent.domain.title}",
        version=version("seewhy"),
        docs_url=None,
        redoc_url=None,
        lifespan=lifespan,
    )

    async def look(image: UploadFile, *, with_reasons: bool = False) -> Seen:
        return await batches.look(image.file, name=_named(image), with_reasons=with_reasons)

    @app.post("/ask", summary="Answer a question about a picture, with the reasons.")
    async def ask(
        image: Image, question: Annotated[str, Form(min_length=1, max_length=500)]
    ) -> dict[str, Any]:
        seen = await look(image)
        return await run_in_threadpool(answered, agent, seen, question)

    @app.post("/classify", summary="Classify a picture: a row of the table of `seewhy classify`.")
    async def classify(image: Image) -> dict[str, Any]:
        seen = await look(image, with_reasons=True)
        return classified(agent, seen, Path(_named(image)), columns=columns)

    @app.post("/explain", summary="Say why a picture is of its class.")
    async def explain(image: Image) -> dict[str, Any]:
        seen = await look(image, with_reasons=True)
        return await run_in_threadpool(explained, agent, seen)

    @app.post("/what-if", summary="Say what the class would be if the picture showed other values.")
    async def what_if(
        image: Image,
        change: Annotated[
            list[str], Form(description="FEATURE=VALUE; several times for several.", max_length=64)
        ],
    ) -> dict[str, Any]:
        seen = await look(image)
        return await run_in_threadpool(supposed, agent, seen, change)

    @app.get("/health", summary="Say that the model is loaded.")
    async def health() -> dict[str, Any]:
        return {"status": "ok", "domain": agent.domain.name, "version": app.version}

    @app.get("/metrics", summary="What this process did, in Prometheus' text.")
    async def shown_metrics() -> Response:
        return Response(metrics.text(), media_type="text/plain; version=0.0.4")

    @app.exception_handler(SeeWhyError)
    async def say_problem(_: Request, problem: SeeWhyError) -> Response:
        status = 503 if isinstance(problem, BusyError) else 422
        return JSONResponse({"error": str(problem)}, status)

    @app.exception_handler(RequestValidationError)
    async def say_parts(_: Request, problem: RequestValidationError) -> Response:
        said = [f"{found['loc'][-1]}: {found['msg'].lower()}" for found in problem.errors()]
        return JSONResponse({"error": "; ".join(said)}, 422)

    @app.exception_handler(HTTPException)
    async def say_status(_: Request, problem: HTTPException) -> Response:
        headers = problem.headers
        return JSONResponse({"error": str(problem.detail)}, problem.status_code, headers)

    app.add_middleware(Bounded, seconds=bounds.seconds, paths=_PATHS, metrics=metrics)
    app.add_middleware(Access, rules=rules)
    return app


def _named(image: UploadFile) -> str:
    """What errors and rows call a picture: its name, without folders."""
    return Path(image.filename or "").name or "image"
