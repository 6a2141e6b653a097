"""Pictures for the pages: decoded and drawn anew, never a file as it was sent."""

from __future__ import annotations

import io
from functools import lru_cache
from pathlib import Path
from typing import Annotated

from fastapi import APIRouter, HTTPException, Query, Request, Response

from seewhy.errors import PictureError
from seewhy.perception.picture import reduced_picture
from seewhy.studio.state import studio_of

__all__ = ["router"]

router = APIRouter()
SIDES = (160, 320, 640, 1280)
"""Pixels of the longer side that may be asked for."""


@router.get("/picture/{name:path}")
def picture(request: Request, name: str, side: Annotated[int, Query()] = SIDES[2]) -> Response:
    """A picture of the project, its longer side at most so long."""
    if side not in SIDES:
        raise HTTPException(404, f"pictures come with a side of {', '.join(map(str, SIDES))}")
    try:
        file = studio_of(request).project.picture_file(name)
        changed = file.stat().st_mtime_ns
    except (LookupError, OSError):
        raise HTTPException(404, "there is no such picture in the project") from None
    tag = f'"{changed:x}-{side}"'
    kept = {"ETag": tag, "Cache-Control": "private, no-cache"}
    if request.headers.get("If-None-Match") == tag:
        return Response(status_code=304, headers=kept)
    try:
        content = _drawn(file, changed, side)
    except PictureError as problem:
        raise HTTPException(422, str(problem)) from None
    return Response(content, media_type="image/jpeg", headers=kept)


@lru_cache(maxsize=600)
def _drawn(file: Path, changed: int, side: int) -> bytes:  # noqa: ARG001
    stream = io.BytesIO()
    reduced_picture(file, longest=side).save(stream, "JPEG", quality=88)
    return stream.getvalue()
