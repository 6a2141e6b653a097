"""What was labelled, by whom and when, each a click from being taken back; and how far it is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from fastapi import APIRouter, Form, Request, Response
from fastapi.responses import RedirectResponse

from seewhy.studio.entry_words import in_words
from seewhy.studio.labelling import pictures_of
from seewhy.studio.progress import progress_of
from seewhy.studio.record import UNDO, Entry
from seewhy.studio.rendering import render
from seewhy.studio.session import who_of
from seewhy.studio.state import studio_of

__all__ = ["router"]

router = APIRouter()

SHOWN = 200
"""Entries that are listed, the last ones."""

_SHOWN_PICTURES = 3


@dataclass(frozen=True)
class Done:
    """An entry of the record in words."""

    entry: Entry
    said: str
    pictures: tuple[str, ...]
    more: int
    holds: bool


@router.get("/label/history")
def history(request: Request) -> Response:
    """The last entries of the record."""
    project = studio_of(request).project
    entries = project.record.all()
    holding = {entry.number for entry in (*project.record.holding(), *project.record.holding(UNDO))}
    done = [
        Done(
            entry,
            in_words(entry),
            pictures_of(entry)[:_SHOWN_PICTURES],
            max(0, len(pictures_of(entry)) - _SHOWN_PICTURES),
            entry.number in holding,
        )
        for entry in reversed(entries[-SHOWN:])
    ]
    return render(request, "label_history.html", done=done, count=len(entries))


@router.post("/label/take-back")
def take_back(request: Request, number: Annotated[int, Form()]) -> Response:
    """Take an entry back, whichever it is."""
    studio_of(request).project.take_back(number, who=who_of(request))
    return RedirectResponse("/label/history", 303)


@router.get("/label/progress")
def progress(request: Request) -> Response:
    """How far each feature and value has come, and what would help most."""
    studio = studio_of(request)
    if studio.project.domain_folder is None:
        return RedirectResponse("/begin", 303)
    found = progress_of(studio.project, studio.proposer.latest())
    return render(request, "label_progress.html", progress=found)
