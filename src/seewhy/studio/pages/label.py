"""Label: pictures are annotated by keyboard."""

from __future__ import annotations

from fastapi import APIRouter, Request, Response

from seewhy.studio.pages.page import Page
from seewhy.studio.rendering import render

__all__ = ["PAGE"]

router = APIRouter()
PAGE = Page("/label", "Label", router)


@router.get(PAGE.path)
def show(request: Request) -> Response:
    """The page."""
    return render(request, "label.html")
