"""A small project for the studio: coloured squares, and something quick that looks at them."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from fastapi.testclient import TestClient
from PIL import Image

from seewhy.domain.domain import Domain
from seewhy.new_domain.from_names import NamedDomain, domain_from_names
from seewhy.perception.picture import read_picture
from seewhy.studio.access import AccessRules
from seewhy.studio.job_process import CODE, OUTPUT
from seewhy.studio.jobs import JOB
from seewhy.studio.project import Project
from seewhy.studio.proposing import Proposer

HTMX = {"HX-Request": "true"}

RULES = AccessRules(frozenset({"testserver"}), "", 400_000)

FRUIT = NamedDomain(("good", "spoilt"), {"colour": ("red", "green"), "round": ("yes", "no")})

TABLED = NamedDomain(table="class,colour,round\ngood,red,yes\nspoilt,green,no\n")


def embed(files: Sequence[Path], _: Domain) -> npt.NDArray[np.floating]:
    """The mean colour of a picture, instead of what a backbone sees."""
    return np.stack([read_picture(file, size=8).mean(axis=(0, 1)) for file in files])


def pictures(folder: Path, count: int = 6) -> Path:
    """Write squares, red ones and green ones in turn: a.png, b.png, …"""
    folder.mkdir(exist_ok=True)
    for number in range(count):
        shade = 200 + 5 * (number // 2)
        colour = (shade, 20, 20) if number % 2 == 0 else (20, shade, 20)
        Image.new("RGB", (40, 30), colour).save(folder / f"{chr(97 + number)}.png")
    return folder


def with_domain(folder: Path, named: NamedDomain = FRUIT) -> Path:
    """Write a domain into the project's folder."""
    domain_from_names(named, folder / "fruit", data=str(folder))
    return folder


def ended_job(
    project: Project, task: str, output: str = "", *, asked: Mapping[str, Any] | None = None
) -> Path:
    """Enter a job that has printed this and ended well; return the folder of its files."""
    folder = project.folder / ".jobs" / f"{task}-{len(project.record.all())}"
    folder.mkdir(parents=True)
    (folder / OUTPUT).write_text(output)
    (folder / CODE).write_text("0")
    process = {"process": 0, "began": ""}
    body = {"task": task, "folder": folder.name, **process, "asked": dict(asked or {})}
    project.record.add(JOB, body, who="Ada")
    return folder


def csrf_of(client: TestClient) -> str:
    """What a form of this client's session brings."""
    found = re.search(r'name="csrf" value="([0-9a-f]+)"', client.get("/begin").text)
    assert found
    return found[1]


class Browser:
    """A client that knows its session's text, and waits for the proposals."""

    def __init__(self, client: TestClient) -> None:
        self.client = client
        self.csrf = csrf_of(client)

    @property
    def proposer(self) -> Proposer:
        return self.client.app.state.studio.proposer  # type: ignore[attr-defined,no-any-return]

    def post(self, path: str, *, part: bool = True, **fields: object) -> str:
        answered = self.client.post(
            path, data={"csrf": self.csrf, **fields}, headers=HTMX if part else {}
        )
        assert answered.status_code == 200, answered.text
        assert self.proposer.settle(120)
        return answered.text

    def get(self, path: str, *, part: bool = False) -> str:
        answered = self.client.get(path, headers=HTMX if part else {})
        assert answered.status_code == 200
        return answered.text
