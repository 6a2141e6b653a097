"""Serve a model from one process or several, at an address that is bound once."""

from __future__ import annotations

import gc
import json
import os
import socket
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING

from seewhy.errors import SeeWhyError

if TYPE_CHECKING:
    from fastapi import FastAPI

    from seewhy.agent.agent import Agent

__all__ = ["Service", "bound_socket", "serve"]

_SERVICE = "SEEWHY_SERVICE"

_BACKLOG = 2048


@dataclass(frozen=True)
class Service:
    """What is served, and how.

    Attributes
    ----------
    model : str
        The model's folder.
    hosts : tuple of str
        Names by which the server may be called.
    token : str
        What who asks has to send; empty: nothing.
    workers : int
        Processes, each with the model.
    most_bytes : int
        Of a request.
    seconds : float
        Of a request.
    device : str
        See :class:`~seewhy.agent.agent.Agent`.
    """

    model: str
    hosts: tuple[str, ...]
    token: str = ""
    workers: int = 1
    most_bytes: int = 20_000_000
    seconds: float = 60.0
    device: str = "auto"


def bound_socket(host: str, port: int) -> socket.socket:
    """Return a socket at an address; port 0 takes a free one.

    Raises
    ------
    SeeWhyError
        If the address is taken, or none of this machine's.
    """
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    listening = socket.socket(family, socket.SOCK_STREAM)
    listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listening.bind((host, port))
        listening.listen(_BACKLOG)  # who comes while the model is loaded waits
    except OSError as problem:
        listening.close()
        raise SeeWhyError(
            f"{host}:{port} cannot be served ({problem.strerror or problem}); choose another port "
            "with --port (0: any that is free), or another address with --host"
        ) from None
    listening.set_inheritable(True)
    return listening


def serve(agent: Agent, service: Service, listening: socket.socket) -> None:
    """Answer requests until the process is asked to end.

    Several processes load the model anew, each for itself.
    """
    import uvicorn
    from uvicorn.supervisors import Multiprocess

    one = service.workers == 1
    os.environ[_SERVICE] = json.dumps(asdict(service))
    config = uvicorn.Config(
        _application(agent, service) if one else f"{__name__}:from_environment",
        factory=not one,
        workers=service.workers,
        log_level="warning",
        access_log=False,
        timeout_keep_alive=30,
        timeout_worker_healthcheck=60,
        limit_concurrency=2048,
        server_header=False,
    )
    server = uvicorn.Server(config)
    if one:
        server.run(sockets=[listening])
    else:
        Multiprocess(config, sockets=[listening]).run()


def from_environment() -> FastAPI:
    """Load the model that this process was begun for; the processes share the cores."""
    import torch

    from seewhy.agent.agent import Agent

    read: Callable[..., Service] = Service
    service = read(**json.loads(os.environ[_SERVICE]))
    torch.set_num_threads(max(1, torch.get_num_threads() // service.workers))
    return _application(Agent.load(service.model, device=service.device), service)


def _application(agent: Agent, service: Service) -> FastAPI:
    from seewhy.studio.access import AccessRules
    from seewhy.studio.application import Limits, application

    rules = AccessRules(frozenset(service.hosts), service.token, service.most_bytes)
    answering = application(agent, rules=rules, limits=Limits(seconds=service.seconds))
    # What is there by now stays: it need not be looked through for garbage ever again.
    gc.freeze()
    return answering
