"""`seewhy studio`: label, train, ask and correct in a browser."""

from __future__ import annotations

import secrets
import webbrowser
from pathlib import Path
from threading import Timer
from typing import Annotated

import typer

from seewhy.cli.cores import share_cores
from seewhy.cli.screen import remark


def studio(
    folder: Annotated[
        Path,
        typer.Argument(
            metavar="FOLDER",
            help="The project: a folder of pictures, a dataset, a domain, or a new one.",
        ),
    ] = Path(),
    host: Annotated[
        str, typer.Option("--host", help="The address to listen at; 0.0.0.0: all of the machine.")
    ] = "127.0.0.1",
    port: Annotated[
        int, typer.Option("--port", min=0, max=65535, help="0: any that is free.")
    ] = 8300,
    token: Annotated[
        str | None,
        typer.Option(
            "--token",
            envvar="SEEWHY_TOKEN",
            help="What a browser has to say; made up where others than this machine may ask.",
        ),
    ] = None,
    allow_host: Annotated[
        list[str] | None,
        typer.Option("--allow-host", help="A name by which the studio is called, too."),
    ] = None,
    browser: Annotated[bool, typer.Option("--browser/--no-browser", help="Open a browser.")] = True,
) -> None:
    """Open the studio: name features, label, train, ask and correct in a browser, offline."""
    share_cores()
    from seewhy.errors import SeeWhyError

    try:
        from seewhy.studio.access import LOOPBACK
        from seewhy.studio.opening import open_studio
        from seewhy.studio.serving import bound_socket
    except ImportError as problem:
        raise SeeWhyError(
            f"the studio needs {problem.name}; install it with pip install 'seewhy[studio]'"
        ) from None
    local = host in LOOPBACK
    if host in ("0.0.0.0", "::") and not allow_host:
        raise SeeWhyError(
            f"--host {host}: say by which name others call this machine, with --allow-host NAME"
        )
    if token is None:
        token = "" if local else secrets.token_urlsafe(24)
    listening = bound_socket(host, port)
    shown = (allow_host or [host])[0]
    shown = f"[{shown}]" if ":" in shown else shown
    address = f"http://{shown}:{listening.getsockname()[1]}/"
    if token:
        address += f"?token={token}"
    remark(f"{folder} at {address} (Ctrl-C ends it)")
    if browser:
        # The socket is bound: a browser that comes early waits.
        Timer(0.5, webbrowser.open, (address,)).start()
    open_studio(
        folder,
        listening,
        hosts=frozenset({host, *(allow_host or ())}) | (LOOPBACK if local else frozenset()),
        token=token,
    )
