"""Pages as functions of the state: a template, what it shows, and what every page has."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

from fastapi import Request
from fastapi.responses import HTMLResponse
from jinja2 import Environment, PackageLoader, StrictUndefined

from seewhy.studio.guard import CSRF, CSRF_HEADER, csrf_of
from seewhy.studio.session import theme_of, who_of
from seewhy.studio.state import studio_of

__all__ = ["STATIC", "from_script", "render"]

STATIC = Path(__file__).parent / "static"


@cache
def _templates() -> Environment:
    return Environment(
        loader=PackageLoader("seewhy.studio"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )


def from_script(request: Request) -> bool:
    """Whether htmx asks, which wants a part of the page."""
    return request.headers.get("HX-Request") == "true"


def render(request: Request, template: str, *, status: int = 200, **shown: Any) -> HTMLResponse:
    """Fill a template of ``templates/``.

    Every template knows ``project``, ``pages`` (the navigation), ``here`` (the path), ``csrf``
    and ``csrf_field``, ``theme`` and ``who``, beside what is given.

    Parameters
    ----------
    request : Request
    template : str
        Its file's name. Parts that htmx swaps begin with an underscore.
    status : int
    **shown
        What it shows.
    """
    from seewhy.studio.pages import PAGES

    studio = studio_of(request)
    text = (
        _templates()
        .get_template(template)
        .render(
            project=studio.project,
            pages=PAGES,
            here=request.url.path,
            csrf=csrf_of(request),
            csrf_field=CSRF,
            csrf_header=CSRF_HEADER,
            theme=theme_of(request),
            who=who_of(request),
            **shown,
        )
    )
    return HTMLResponse(text, status)
