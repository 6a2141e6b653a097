"""`seewhy serve`: a model answers over HTTP."""

from __future__ import annotations

from typing import Annotated

import typer

from seewhy.cli.cores import share_cores
from seewhy.cli.listening import listen
from seewhy.cli.options import AllowHost, Device, Host, ModelFolder, Port, Token
from seewhy.cli.screen import remark


def serve(
    model: ModelFolder,
    host: Host = "127.0.0.1",
    port: Port = 8000,
    workers: Annotated[
        int, typer.Option("--workers", min=1, max=64, help="Processes, each with the model.")
    ] = 1,
    token: Token = None,
    allow_host: AllowHost = None,
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
        from seewhy.studio.serving import Service
        from seewhy.studio.serving import serve as answer_requests
    except ImportError as problem:
        raise SeeWhyError(
            f"the server needs {problem.name}; install it with pip install 'seewhy[studio]'"
        ) from None
    listener = listen(host, port, token=token, allow_host=allow_host)
    with listener.socket:
        agent = Agent.load(model, device=device)
        if listener.token and token is None:
            remark(f"token: {listener.token}")
        remark(f"{model} at {listener.address}")
        answer_requests(
            agent,
            Service(
                model=str(model),
                hosts=tuple(sorted(listener.hosts)),
                token=listener.token,
                workers=workers,
                most_bytes=most_megabytes * 1_000_000,
                seconds=seconds,
                device=device,
            ),
            listener.socket,
        )
