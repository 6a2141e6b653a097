"""`seewhy serve`: a model answers over HTTP."""

from __future__ import annotations

import secrets
from typing import Annotated

import typer

from seewhy.cli.cores import share_cores
from seewhy.cli.options import Device, ModelFolder
from seewhy.cli.screen import remark


def serve(
    model: ModelFolder,
    host: Annotated[
        str, typer.Option("--host", help="The address to listen at; 0.0.0.0: all of the machine.")
    ] = "127.0.0.1",
    port: Annotated[
        int, typer.Option("--port", min=0, max=65535, help="0: any that is free.")
    ] = 8000,
    workers: Annotated[
        int, typer.Option("--workers", min=1, max=64, help="Processes, each with the model.")
    ] = 1,
    token: Annotated[
        str | None,
        typer.Option(
            "--token",
            envvar="SEEWHY_TOKEN",
            help="What who asks has to send; made up where others than this machine may ask.",
        ),
    ] = None,
    allow_host: Annotated[
        list[str] | None,
        typer.Option("--allow-host", help="A name by which the server is called, too."),
    ] = None,
    most_megabytes: Annotated[
        int, typer.Option("--most-megabytes", min=1, max=1000, help="Of a request.")
    ] = 20,
    seconds: Annotated[
        float, typer.Option("--seconds", min=1, max=3600, help="Of a request, at most.")
    ] = 60.0,
    device: Device = "auto",
) -> None:
    """Serve a model: POST /ask (image, question), /classify, /explain, /what-if (image, change).

    GET /health and /metrics say how it is; /openapi.json describes all of it.
    """
    share_cores()
    from seewhy.agent.agent import Agent
    from seewhy.errors import SeeWhyError

    try:
        from seewhy.studio.access import LOOPBACK
        from seewhy.studio.serving import Service, bound_socket
        from seewhy.studio.serving import serve as answer_requests
    except ImportError as problem:
        raise SeeWhyError(
            f"the server needs {problem.name}; install it with pip install 'seewhy[studio]'"
        ) from None
    names = frozenset({host, *(allow_host or ())})
    local = host in LOOPBACK
    if token is None:
        token = "" if local else secrets.token_urlsafe(24)
        if token:
            remark(f"token: {token}")
    if host in ("0.0.0.0", "::") and not allow_host:
        raise SeeWhyError(
            f"--host {host}: say by which name others call this machine, with --allow-host NAME"
        )
    agent = Agent.load(model, device=device)
    listening = bound_socket(host, port)
    shown = f"[{host}]" if ":" in host else host
    remark(f"{model} at http://{shown}:{listening.getsockname()[1]}")
    answer_requests(
        agent,
        Service(
            model=str(model),
            hosts=tuple(sorted(names | (LOOPBACK if local else frozenset()))),
            token=token,
            workers=workers,
            most_bytes=most_megabytes * 1_000_000,
            seconds=seconds,
            device=device,
        ),
        listening,
    )
