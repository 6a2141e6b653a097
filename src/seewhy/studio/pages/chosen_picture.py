"""The picture that a request means."""

from __future__ import annotations

from seewhy.errors import SeeWhyError
from seewhy.studio.state import Studio

__all__ = ["chosen"]


def chosen(studio: Studio, name: str, *, remedy: str = "choose another") -> str:
    """The name of a picture of the project.

    Parameters
    ----------
    studio : Studio
    name : str
    remedy : str
        What to do where it is none.

    Raises
    ------
    SeeWhyError
        If it is none.
    """
    try:
        studio.project.picture_file(name)
    except LookupError as problem:
        raise SeeWhyError(f"{problem}; {remedy}") from None
    return name
