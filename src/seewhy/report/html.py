"""Fill the templates of pages: HTML files beside this module."""

from __future__ import annotations

from functools import cache

from jinja2 import Environment, PackageLoader

__all__ = ["rendered"]


def rendered(template: str, **values: object) -> str:
    """Return a template with its slots filled, as the text of an HTML file.

    Examples
    --------
    >>> rendered("planning.html", planned=3).startswith("<!doctype html>")
    True
    """
    return _environment().get_template(template).render(**values)


@cache
def _environment() -> Environment:
    loader = PackageLoader("seewhy", "report")
    return Environment(loader=loader, autoescape=True, trim_blocks=True, lstrip_blocks=True)
