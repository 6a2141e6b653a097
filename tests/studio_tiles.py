"""A studio's project of tiles with a model, and what a browser does with its pages."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

from fastapi.testclient import TestClient

from seewhy.studio.project import Project
from seewhy.studio.site import site
from studio_builder import HTMX, RULES, csrf_of, embed

__all__ = ["HTMX", "csrf_of", "keys_of", "studio_of", "text_of", "tiles_project"]


def tiles_project(folder: Path, *, data: Path, domain: Path, model: Path | None) -> Path:
    """Make a project of labelled pictures, a domain, and a model where there is one."""
    shutil.copytree(data, folder)
    shutil.copytree(domain, folder / "tiles")
    if model is not None:
        shutil.copytree(model, folder / "model")
    return folder


def studio_of(folder: Path) -> TestClient:
    """A browser before the studio of a project."""
    return TestClient(site(Project(folder), rules=RULES, embed=embed))


def text_of(fragment: str) -> str:
    """The words of a page, a blank between them."""
    return " ".join(re.sub(r"<[^>]+>", " ", fragment).split())


def keys_of(fragment: str) -> list[str]:
    """The keys of the proposals of a page."""
    return re.findall(r'name="key" value="([0-9a-f]{20})"', fragment)
