"""The command that is being run, as somebody would type it again."""

from __future__ import annotations

import shlex
import sys

__all__ = ["as_typed"]


def as_typed() -> str:
    """Return the command line of this process, quoted for a shell.

    Examples
    --------
    >>> import sys
    >>> kept, sys.argv = sys.argv, ["/somewhere/bin/seewhy", "ask", "model", "why is it red?"]
    >>> as_typed()
    "seewhy ask model 'why is it red?'"
    >>> sys.argv = kept
    """
    # Where the program lies says nothing about how to run it elsewhere.
    return shlex.join(["seewhy", *sys.argv[1:]])
