"""A studio's project of tiles with a model, and what a browser does with its pages."""

from __future__ import annotations

import re
import shutil
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt
from fastapi.testclient import TestClient

from seewhy.domain.domain import Domain
from seewhy.perception.picture import read_picture
from seewhy.studio.access import AccessRules
from seewhy.studio.project import Project
from seewhy.studio.site import site

RULES = AccessRules(frozenset({"testserver"}), "", 200_000)
HTMX = {"HX-Request": "true"}


def tiles_project(folder: Path, *, data: Path, domain: Path, model: Path | None) -> Path:
    """Make a project of labelled pictures, a domain, and a model where there is one."""
    shutil.copytree(data, folder)
    shutil.copytree(domain, folder / "tiles")
    if model is not None:
        shutil.copytree(model, folder / "model")
    return folder


def studio_of(folder: Path) -> TestClient:
    """A browser before the studio of a project."""
    return TestClient(site(Project(folder), rules=RULES, embed=_mean_colours))


def _mean_colours(files: Sequence[Path], _: Domain) -> npt.NDArray[np.floating]:
    return np.stack([read_picture(file, size=8).mean(axis=(0, 1)) for file in files])


def csrf_of(client: TestClient) -> str:
    """What the forms of this browser's session bring."""
    found = re.search(r'name="csrf" value="([0-9a-f]+)"', client.get("/begin").text)
    assert found
    return found[1]


def text_of(fragment: str) -> str:
    """The words of a page, a blank between them."""
    return " ".join(re.sub(r"<[^>]+>", " ", fragment).split())


def keys_of(fragment: str) -> list[str]:
    """The keys of the proposals of a page."""
    return re.findall(r'name="key" value="([0-9a-f]{20})"', fragment)
