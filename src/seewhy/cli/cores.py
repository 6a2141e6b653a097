"""How commands share the cores of a machine."""

from __future__ import annotations

import os

__all__ = ["share_cores"]


def share_cores() -> None:
    """Let the networks' threads sleep while they have nothing to do; call before PyTorch is loaded.

    They would watch for work all the time otherwise, on cores that threads which read pictures, or
    other programs, could use: on two busy cores that doubles the processor's time of an answer, and
    the time of many. What the environment says is kept.

    Examples
    --------
    >>> share_cores()
    >>> os.environ["OMP_WAIT_POLICY"]
    'PASSIVE'
    """
    os.environ.setdefault("OMP_WAIT_POLICY", "PASSIVE")
