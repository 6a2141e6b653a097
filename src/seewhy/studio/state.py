"""What the pages of one running studio share."""

from __future__ import annotations

from dataclasses import dataclass

from fastapi import Request

from seewhy.studio.project import Project

__all__ = ["Studio", "studio_of"]


@dataclass(frozen=True)
class Studio:
    """What the pages share.

    Attributes
    ----------
    project : Project
    """

    project: Project


def studio_of(request: Request) -> Studio:
    """The studio that a request came to."""
    studio = request.app.state.studio
    assert isinstance(studio, Studio)
    return studio
