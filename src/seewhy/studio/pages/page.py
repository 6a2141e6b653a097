"""What a page is: its address, its word in the navigation, and what it answers."""

from __future__ import annotations

from dataclasses import dataclass

from fastapi import APIRouter

__all__ = ["Page"]


@dataclass(frozen=True)
class Page:
    """A page of the studio.

    Its routes lie at its path and below. What changes something is a POST: that the session's own
    page sent it is checked for every route.

    Attributes
    ----------
    path : str
        Such as ``/label``.
    title : str
        One word for the navigation.
    router : APIRouter
    """

    path: str
    title: str
    router: APIRouter
