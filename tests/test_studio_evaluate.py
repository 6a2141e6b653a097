"""The studio's evaluation: figures beside chance, and wrong pictures as a way to their labels."""

from __future__ import annotations

import csv
import shutil
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from fastapi.testclient import TestClient

from seewhy.studio.jobs import JOB, Job, Jobs, jobs_of
from seewhy.studio.project import Project
from seewhy.studio.site import site
from studio_builder import RULES, csrf_of


@pytest.fixture
def folder(tiles_folder: Path, tiles_data: Path, model_folder: Path, tmp_path: Path) -> Path:
    """Tiles with their domain and a model that was trained on them."""
    folder = tmp_path / "project"
    shutil.copytree(tiles_data, folder)
    shutil.copytree(tiles_folder, folder / "tiles")
    shutil.copytree(model_folder, folder / "model")
    return folder


@pytest.fixture
def project(folder: Path) -> Project:
    return Project(folder)


@pytest.fixture
def client(project: Project) -> Iterator[TestClient]:
    with TestClient(site(project, rules=RULES)) as client:
        yield client


def mislabelled(project: Project) -> str:
    """Say of a picture kept for evaluation what it does not show."""
    rows = project.labels().rows
    name = next(name for name in project.labels().of if rows[name]["split"] == "test")
    feature, described = next(iter(project.domain().features.items()))
    said = project.labels().value(name, feature)
    other = next(value for value in described.values if value != said)
    project.label({name: {feature: other}}, who="Ada")
    return name


def evaluated(client: TestClient, project: Project) -> Job:
    begun = client.post("/evaluate", data={"csrf": csrf_of(client)})
    assert begun.status_code == 200, begun.text
    end = time.monotonic() + 240
    while jobs_of(project).of("evaluate")[0].runs:
        assert time.monotonic() < end
        time.sleep(0.2)
    return jobs_of(project).of("evaluate")[0]


def test_figures_and_wrong_pictures(client: TestClient, project: Project) -> None:
    name = mislabelled(project)
    job = evaluated(client, project)
    assert job.state == "finished", job.lines()
    found = job.printed()
    shown = client.get("/evaluate").text
    assert "By chance" in shown
    assert f"{found['scenes']} pictures with a class" in shown
    assert "results on them prove nothing" not in shown
    assert f'href="/label?picture={name}&amp;at=' in shown
    assert f'href="/ask?picture={name}"' in shown
    page = client.get("/evaluate/page.html")
    assert "attachment" in page.headers["content-disposition"]
    assert str(project.folder) not in page.text
    feature = next(iter(project.domain().features))
    project.label({name: {feature: None}}, who="Ada")
    assert "Its labels were changed since" in client.get("/evaluate").text
    (project.folder / "model" / "model.json").touch()
    assert "The model was trained again since" in client.get("/evaluate").text


def test_pictures_that_trained_are_not_evaluated_on(folder: Path) -> None:
    rows = list(csv.DictReader((folder / "scenes.csv").read_text().splitlines()))
    with (folder / "scenes.csv").open("w", newline="") as table:
        writer = csv.DictWriter(table, list(rows[0]))
        writer.writeheader()
        writer.writerows({**row, "split": ""} for row in rows)
    with TestClient(site(Project(folder), rules=RULES)) as client:
        _all_train(client)


def _all_train(client: TestClient) -> None:
    assert "no labelled picture is kept for evaluation" in client.get("/evaluate").text.lower()
    refused = client.post("/evaluate", data={"csrf": csrf_of(client)})
    assert refused.status_code == 422
    assert "keep a quarter, and train again" in refused.text
    form = {"csrf": csrf_of(client)}
    kept = client.post("/evaluate/keep-back", data=form, follow_redirects=False)
    assert kept.headers["location"] == "/train"
    assert "kept for evaluation" in client.get("/train").text
    assert "prove nothing" not in client.get("/evaluate").text


def test_without_a_model_nothing_is_evaluated(client: TestClient, project: Project) -> None:
    shutil.rmtree(project.model_folder)
    refused = client.post("/evaluate", data={"csrf": csrf_of(client)})
    assert refused.status_code == 422
    assert "there is no model yet; train one" in refused.text
    assert client.get("/evaluate/page.html").status_code == 404


def test_a_damaged_model_is_said(client: TestClient, project: Project) -> None:
    (project.model_folder / "model.json").write_text("{}")
    assert evaluated(client, project).state == "failed"
    assert "The evaluation failed:" in client.get("/evaluate").text
    assert "model.json" in client.get("/evaluate").text


def test_an_output_that_was_damaged_is_as_none(client: TestClient, project: Project) -> None:
    (project.folder / ".jobs/evaluate-1").mkdir(parents=True)
    (project.folder / ".jobs/evaluate-1/output").write_text("{")
    (project.folder / ".jobs/evaluate-1/code").write_text("0")
    body = {"task": "evaluate", "folder": "evaluate-1", "process": 1, "began": "", "asked": {}}
    project.record.add(JOB, body, who="Ada")
    assert Jobs(project).of("evaluate")[0].state == "finished"
    assert "Figures" not in client.get("/evaluate").text


def test_no_form_of_elsewhere_evaluates(client: TestClient, project: Project) -> None:
    for address in ("/evaluate", "/evaluate/stop", "/evaluate/keep-back"):
        assert client.post(address).status_code == 403
    assert not jobs_of(project).of("evaluate")
