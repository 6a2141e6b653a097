"""`seewhy studio`: label, train, ask and correct in a browser."""

from __future__ import annotations

import webbrowser
from pathlib import Path
from threading import Timer
from typing import Annotated

import typer

from seewhy.cli.cores import share_cores
from seewhy.cli.listening import listen
from seewhy.cli.options import AllowHost, Host, Port, Token
from seewhy.cli.screen import remark


def studio(
    folder: Annotated[
        Path,
        typer.Argument(
            metavar="FOLDER",
            help="The project: a folder of pictures, a dataset, a domain, or a new one.",
        ),
    ] = Path(),
    host: Host = "127.0.0.1",
    port: Port = 8300,
    token: Token = None,
    allow_host: AllowHost = None,
    browser: Annotated[bool, typer.Option("--browser/--no-browser", help="Open a browser.")] = True,
) -> None:
    """Open the studio: name features, label, train, ask and correct in a browser, offline."""
    share_cores()
    from seewhy.errors import SeeWhyError

    try:
        from seewhy.studio.opening import open_studio
    except ImportError as problem:
        raise SeeWhyError(
            f"the studio needs {problem.name}; install it with pip install 'seewhy[studio]'"
        ) from None
    listener = listen(host, port, token=token, allow_host=allow_host)
    address = f"{listener.address}/" + (f"?token={listener.token}" if listener.token else "")
    remark(f"{folder} at {address} (Ctrl-C ends it)")
    if browser:
        # The socket is bound: a browser that comes early waits.
        Timer(0.5, webbrowser.open, (address,)).start()
    with listener.socket:
        open_studio(folder, listener.socket, hosts=listener.hosts, token=listener.token)
