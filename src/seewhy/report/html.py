"""Fill the templates of pages: HTML files in the folder ``report`` of a package."""

from __future__ import annotations

from functools import cache

from jinja2 import Environment, PackageLoader

__all__ = ["rendered"]


def rendered(template: str, *, package: str = "seewhy", **values: object) -> str:
    """Return a template with its slots filled, as the text of an HTML file.

    ``package`` is whose folder ``report`` holds the template.

    Examples
    --------
    >>> rendered("experiment_base.html", package="seewhy_lab").startswith("<!doctype html>")
    True
    """
    return _environment(package).get_template(template).render(**values)


@cache
def _environment(package: str) -> Environment:
    loader = PackageLoader(package, "report")
    return Environment(loader=loader, autoescape=True, trim_blocks=True, lstrip_blocks=True)
