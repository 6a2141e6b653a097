"""Proposals as they are shown: what would change, and a button to take it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from fastapi import Request, Response

from seewhy.revision.proposal import Proposal
from seewhy.studio.rendering import from_script, render

__all__ = ["Remedy", "shown_remedies"]


@dataclass(frozen=True)
class Remedy:
    """A proposal as it is shown, with the key to take it by."""

    key: str
    proposal: Proposal
    said: str


def shown_remedies(
    request: Request, remedies: Sequence[Remedy], *, picture: str, nothing: str
) -> Response:
    """The proposals that there are, or the sentence that there are none."""
    template = "_ask_remedies.html" if from_script(request) else "ask_remedies.html"
    return render(request, template, remedies=remedies, picture=picture, nothing=nothing)
