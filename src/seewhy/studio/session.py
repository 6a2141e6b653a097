"""What a browser keeps of its own: who sits before it, and light or dark."""

from __future__ import annotations

import getpass
from functools import cache
from typing import Literal
from urllib.parse import quote, unquote

from fastapi import Request, Response

__all__ = ["THEMES", "keep_theme", "keep_who", "theme_of", "who_of"]

THEMES = ("system", "light", "dark")
_THEME = "seewhy_theme"
_WHO = "seewhy_who"
_YEAR = 365 * 24 * 3600
_LONGEST = 60

Theme = Literal["system", "light", "dark"]


def theme_of(request: Request) -> str:
    """Light, dark, or what the system says."""
    kept = request.cookies.get(_THEME, "")
    return kept if kept in THEMES else THEMES[0]


def who_of(request: Request) -> str:
    """Who labels: what was said in the studio, else the name of the account."""
    return unquote(request.cookies.get(_WHO, ""))[:_LONGEST].strip() or _account()


def keep_theme(response: Response, theme: Theme) -> None:
    """Let the browser keep light or dark."""
    response.set_cookie(_THEME, theme, max_age=_YEAR, httponly=True, samesite="strict")


def keep_who(response: Response, who: str) -> None:
    """Let the browser keep who sits before it."""
    response.set_cookie(
        _WHO, quote(who[:_LONGEST]), max_age=_YEAR, httponly=True, samesite="strict"
    )


@cache
def _account() -> str:
    try:
        return getpass.getuser()
    except (OSError, KeyError, ImportError):
        return "somebody"
