"""Open the studio: one process, one project, one address."""

from __future__ import annotations

import socket
from pathlib import Path

from seewhy.errors import BusyError
from seewhy.files.locks import locked
from seewhy.studio.access import AccessRules
from seewhy.studio.project import Project
from seewhy.studio.site import site

__all__ = ["MOST_BYTES", "open_studio"]

MOST_BYTES = 256_000_000
"""Of a request: pictures are sent some at a time."""


def open_studio(
    folder: Path, listening: socket.socket, *, hosts: frozenset[str], token: str = ""
) -> None:
    """Show a project until the process is asked to end.

    Parameters
    ----------
    folder : Path
        The project's.
    listening : socket
        A socket that is bound.
    hosts : frozenset of str
        Names by which the studio may be called.
    token : str
        What a browser has to say; empty: nothing.

    Raises
    ------
    BusyError
        If another studio has the project open.
    """
    import uvicorn

    folder.mkdir(parents=True, exist_ok=True)
    with locked(folder / "studio") as ours:
        if not ours:
            raise BusyError(
                f"{folder}: another studio has the project open; go to its page, or end it first"
            )
        app = site(Project(folder), rules=AccessRules(hosts, token, MOST_BYTES))
        config = uvicorn.Config(
            app, log_level="warning", timeout_keep_alive=30, server_header=False
        )
        uvicorn.Server(config).run(sockets=[listening])
