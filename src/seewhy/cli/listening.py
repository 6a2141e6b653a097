"""Where a server of this machine listens, and who may ask it."""

from __future__ import annotations

import secrets
import socket
from collections.abc import Sequence
from dataclasses import dataclass

from seewhy.errors import SeeWhyError

__all__ = ["Listener", "listen"]


@dataclass(frozen=True)
class Listener:
    """An address at which it is listened already.

    Attributes
    ----------
    socket : socket.socket
        Bound; whoever comes before anybody answers waits.
    address : str
        Of the server, as others write it: ``http://127.0.0.1:8000``.
    hosts : frozenset of str
        Names by which the server may be called.
    token : str
        What who asks has to bring; empty: nothing.
    """

    socket: socket.socket
    address: str
    hosts: frozenset[str]
    token: str


def listen(
    host: str, port: int, *, token: str | None, allow_host: Sequence[str] | None
) -> Listener:
    """Return a listener at an address; who is not of this machine needs a token.

    Parameters
    ----------
    host : str
        The address; ``0.0.0.0`` and ``::`` are all of the machine's.
    port : int
        0: any that is free.
    token : str or None
        None: made up where others than this machine may ask.
    allow_host : sequence of str or None
        Names by which the server is called, too.

    Raises
    ------
    SeeWhyError
        If all addresses are listened at without a name by which the machine is called, or the
        address cannot be had.
    """
    # Who only asks for help needs nothing of the studio.
    from seewhy.studio.access import LOOPBACK
    from seewhy.studio.serving import bound_socket

    names = tuple(allow_host or ())
    if host in ("0.0.0.0", "::") and not names:
        raise SeeWhyError(
            f"--host {host}: say by which name others call this machine, with --allow-host NAME"
        )
    local = host in LOOPBACK
    if token is None:
        token = "" if local else secrets.token_urlsafe(24)
    bound = bound_socket(host, port)
    called = (*names, host)[0]
    called = f"[{called}]" if ":" in called else called
    return Listener(
        socket=bound,
        address=f"http://{called}:{bound.getsockname()[1]}",
        hosts=frozenset({host, *names}) | (LOOPBACK if local else frozenset()),
        token=token,
    )
