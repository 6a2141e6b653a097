"""Where in a picture a feature is seen, fetched when somebody opens it: a map takes seconds."""

from __future__ import annotations

import base64
import io
from typing import Annotated

from fastapi import APIRouter, Query, Request, Response

from seewhy.errors import SeeWhyError
from seewhy.studio.pages.chosen_picture import chosen
from seewhy.studio.rendering import render
from seewhy.studio.state import studio_of

__all__ = ["router"]

router = APIRouter()

_SIDE = 320


@router.get("/ask/where")
def where(
    request: Request,
    picture: Annotated[str, Query(max_length=2000)],
    feature: Annotated[str, Query(max_length=200)],
) -> Response:
    """The picture with a line around what matters most for a feature."""
    studio = studio_of(request)
    name = chosen(studio, picture)
    found = studio.model.where(name).get(feature)
    if found is None:
        raise SeeWhyError(f"'{feature}' is nothing that is seen in the picture")
    stream = io.BytesIO()
    fit = studio.project.domain().pictures.fit
    file = studio.project.picture_file(name)
    found.picture(file, side=_SIDE, fit=fit).save(stream, "JPEG", quality=85)
    return render(
        request,
        "_ask_where.html",
        found=found,
        content=base64.b64encode(stream.getvalue()).decode(),
    )
