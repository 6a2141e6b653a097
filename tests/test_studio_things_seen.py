"""A project with things in the studio: trained by boxes, asked about, evaluated."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient

from seewhy.studio import jobs
from seewhy.studio.drawing import draw, say_of_thing
from seewhy.studio.jobs import Jobs
from seewhy.studio.keeping_back import keep_back, kept, place
from seewhy.studio.project import Project
from seewhy.studio.site import site
from studio_builder import RULES, Browser, embed
from thing_pictures import piles


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return Project(piles(tmp_path / "p", 14))


@pytest.fixture
def browser(project: Project) -> Iterator[Browser]:
    with TestClient(site(project, rules=RULES, embed=embed)) as client:
        yield Browser(client)


def draw_in(project: Project, start: int, end: int) -> None:
    """Draw a red block in some of the pictures, and say all of it."""
    for name in project.pictures()[start:end]:
        thing = draw(project, name, (20, 50, 60, 90), who="Ada")
        say_of_thing(project, name, thing, "colour", "red", who="Ada")
        say_of_thing(project, name, thing, "round", "no", who="Ada")


def test_what_training_on_things_lacks_is_said(browser: Browser, project: Project) -> None:
    text = browser.get("/train")
    assert "no block is drawn yet; draw a box around each in at least 10 pictures" in text
    assert "classes" not in text
    thing = draw(project, "a.png", (20, 50, 60, 90), who="Ada")
    assert "no thing with a box has a value of" in browser.get("/train")
    say_of_thing(project, "a.png", thing, "colour", "red", who="Ada")
    say_of_thing(project, "a.png", thing, "round", "no", who="Ada")
    text = browser.get("/train")
    assert "1 picture has a box around each thing; to find things, at least 10 are needed" in text
    refused = browser.client.post("/train", data={"csrf": browser.csrf})
    assert refused.status_code == 422
    assert "at least 10 are needed" in refused.text
    assert not project.record.holding(jobs.JOB)


def test_pictures_with_boxes_are_counted_and_a_quarter_is_kept(
    browser: Browser, project: Project
) -> None:
    draw_in(project, 0, 12)
    draw(project, "m.png", None, who="Ada")  # a box in the middle
    table = project.folder / "things.csv"
    table.write_text(table.read_text() + "n.png,1,,,,,red,no\n")  # a thing without a box
    project.label({"n.png": {"class": "stable"}}, who="Ada")
    assert "13 pictures with a box around each block" in browser.get("/train")
    browser.post("/train/keep-back", part=False)
    things = project.domain().things
    assert kept(project.labels(), things) == {"train": 10, "test": 3}
    rows = project.labels().rows
    assert rows["n.png"]["split"] == "train"
    assert "10 pictures with a box" in browser.get("/train")
    assert "3 more are kept for evaluation" in browser.get("/train")


def test_what_is_drawn_later_is_placed_when_training_begins(project: Project) -> None:
    draw_in(project, 0, 8)
    keep_back(project, who="Ada")
    draw_in(project, 8, 14)
    place(project, who="Ada")
    labels = project.labels()
    assert set(labels.rows) == set(project.pictures())
    assert kept(labels, project.domain().things) == {"train": 10, "test": 4}


def test_training_on_things_is_the_same_command(
    browser: Browser, project: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    draw_in(project, 0, 14)
    begun: list[Any] = []
    monkeypatch.setattr(
        Jobs, "start", lambda _, *said, **options: begun.append((*said, options["asked"]))
    )
    browser.post("/train", part=False)
    task, module, said, asked = begun[0]
    assert (task, module) == ("train", "seewhy")
    assert said == ["train", "piles", "--data", ".", "--out", "model"]
    assert asked["pictures"] == 14
