"""Proposals as they are shown: what would change, and a button to take it."""

from __future__ import annotations

from collections.abc import Sequence

from fastapi import Request, Response

from seewhy.studio.offered import Remedy
from seewhy.studio.rendering import from_script, render

__all__ = ["shown_remedies"]


def shown_remedies(
    request: Request, remedies: Sequence[Remedy], *, picture: str, nothing: str
) -> Response:
    """The proposals that there are, or the sentence that there are none."""
    template = "_ask_remedies.html" if from_script(request) else "ask_remedies.html"
    return render(request, template, remedies=remedies, picture=picture, nothing=nothing)
