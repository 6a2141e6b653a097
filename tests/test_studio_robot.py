"""The studio's robot: a run as it happens, questions about it, and what if."""

from __future__ import annotations

import html
import json
import re
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient

from conftest import Run
from lamp_domain import write_lamps
from seewhy.studio.access import AccessRules
from seewhy.studio.jobs import JOB, jobs_of
from seewhy.studio.project import Project
from seewhy.studio.robot_runs import run_of
from seewhy.studio.site import site
from studio_builder import RULES, csrf_of, embed, pictures


@pytest.fixture
def lamps(tmp_path: Path) -> Path:
    return write_lamps(tmp_path / "lamps")


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return Project(pictures(tmp_path / "fruit", 2))


@pytest.fixture
def client(project: Project) -> Iterator[TestClient]:
    with TestClient(site(project, rules=RULES, embed=embed)) as client:
        yield client


def run_it(client: TestClient, project: Project, lamps: Path, **asked: str) -> None:
    form = {"csrf": csrf_of(client), "folder": str(lamps), "goal": "lit(desk)", **asked}
    begun = client.post("/robot", data=form)
    assert begun.status_code == 200, begun.text
    end = time.monotonic() + 90
    while jobs_of(project).of("robot")[0].runs:
        assert time.monotonic() < end
        time.sleep(0.1)


def test_a_run_is_shown_asked_about_and_taken_away(
    client: TestClient, project: Project, lamps: Path
) -> None:
    run_it(client, project, lamps)
    job = jobs_of(project).of("robot")[0]
    assert job.state == "finished", job.lines()
    assert [step["decision"] for step in run_of(job).steps] == ["plan", "stop"]
    shown = client.get("/robot").text
    assert "I press the desk lamp." in shown
    assert "In truth it is reached." in shown
    form = {"csrf": csrf_of(client)}
    told = client.post("/robot/ask", data={**form, "question": "what is your goal?"}).text
    assert "My goal is that the desk lamp is lit." in told
    supposed = {**form, "fluent": "broken(desk)", "step": "0"}
    assert "I would give up" in client.post("/robot/what-if", data=supposed).text
    other = {**form, "fluent": "lit(desk)", "holds": "true", "step": "0"}
    assert "I would do nothing" in client.post("/robot/what-if", data=other).text
    page = client.get("/robot/run.html")
    assert "attachment" in page.headers["content-disposition"]
    assert "Step 1" in page.text
    assert client.get("/robot/steps?after=0").headers["HX-Refresh"] == "true"


def test_the_world_is_so_at_first(client: TestClient, project: Project, lamps: Path) -> None:
    run_it(client, project, lamps, at_first="broken(desk); -lit(desk)")
    found = run_of(jobs_of(project).of("robot")[0])
    assert found.ended.startswith("The robot gave up")
    assert not found.achieved


def test_what_cannot_be_at_first_is_said(client: TestClient, project: Project, lamps: Path) -> None:
    run_it(client, project, lamps, at_first="lit(desk); -lit(desk)")
    assert "The run failed: it cannot be that the desk lamp is dark at first" in (
        client.get("/robot").text
    )


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"goal": "lit(desc)"}, "did you mean"),
        ({"goal": ""}, "the goal is empty"),
        ({"at_first": "shining(desk)"}, "shining"),
        ({"folder": "/nowhere/at/all"}, "is no folder that the studio may read"),
        ({"folder": "", "domain": "robot_asistant"}, "did you mean"),
        ({"seed": "many"}, "seed"),
        ({"steps": "100000"}, "steps"),
    ],
)
def test_what_cannot_be_run_is_said_before(
    client: TestClient, project: Project, lamps: Path, asked: dict[str, str], said: str
) -> None:
    form = {"csrf": csrf_of(client), "folder": str(lamps), "goal": "lit(desk)", **asked}
    refused = client.post("/robot", data=form)
    assert refused.status_code == 422
    assert said in refused.text
    assert not jobs_of(project).of("robot")


def test_without_a_run_nothing_is_answered(client: TestClient) -> None:
    form = {"csrf": csrf_of(client), "question": "what is your goal?"}
    refused = client.post("/robot/ask", data=form)
    assert refused.status_code == 422
    assert "let the robot run first" in refused.text
    assert client.get("/robot/run.html").status_code == 404
    assert client.get("/robot/map/1/0.svg").status_code == 404


def test_a_question_that_is_not_understood_is_said(
    client: TestClient, project: Project, lamps: Path
) -> None:
    run_it(client, project, lamps)
    form = {"csrf": csrf_of(client)}
    refused = client.post("/robot/ask", data={**form, "question": "blargh flurb?"})
    assert refused.status_code == 422
    for supposed, said in (
        ({"fluent": "lit(dusk)"}, "desk"),
        ({"fluent": "lit(desk)", "step": "99"}, "no step 99"),
    ):
        refused = client.post("/robot/what-if", data={**form, **supposed})
        assert refused.status_code == 422
        assert said in refused.text


def test_from_elsewhere_no_folder_is_named(project: Project, lamps: Path) -> None:
    rules = AccessRules(frozenset({"testserver"}), "secret", 400_000)
    with TestClient(site(project, rules=rules, embed=embed)) as client:
        client.get("/begin?token=secret")
        form = {"csrf": csrf_of(client), "folder": str(lamps), "goal": "lit(desk)"}
        assert client.post("/robot", data=form).status_code == 422
        assert 'name="folder"' not in client.get("/robot").text


def test_no_form_of_elsewhere_lets_the_robot_run(client: TestClient, project: Project) -> None:
    for address in ("/robot", "/robot/stop", "/robot/ask", "/robot/what-if"):
        assert client.post(address, data={"goal": "lit(desk)"}).status_code == 403
    assert not [entry for entry in project.record.all() if entry.kind == JOB]


def test_the_command_line_supposes_the_same(run: Run, lamps: Path) -> None:
    ended = run(
        "simulate",
        lamps,
        "--goal",
        "lit(desk)",
        "--at-first",
        "broken(desk)",
        "--at-first",
        "-lit(desk)",
    )
    assert ended.code == 1
    assert "gave up" in ended.out
    wrong = run("simulate", lamps, "--goal", "lit(desk)", "--at-first", "broken(dusk)")
    assert wrong.code == 2
    assert "desk" in wrong.err


# Another scene, and what was done so far ----------------------------------------------------------

SCENES: dict[str, Any] = {
    "scenes": [
        {
            "image_index": number,
            "image_filename": f"{number}.png",
            "objects": [
                {"color": colour, "shape": "cube", "size": "large", "material": "rubber",
                 "pixel_coords": [60 + 90 * place, 90, 9]}
                for place, colour in enumerate(colours)
            ],
            "relationships": {"on": [[], []]},
        }
        for number, colours in enumerate([("red", "blue"), ("green", "gray")])
    ]
}  # fmt: skip


def begin_with(client: TestClient, project: Project, files: dict[str, Any], **asked: str) -> str:
    """Let the robot of the table run; the page when it has ended."""
    form = {"csrf": csrf_of(client), "domain": "tabletop", **asked}
    begun = client.post("/robot", data=form, files=files)
    assert begun.status_code == 200, begun.text
    end = time.monotonic() + 120
    while jobs_of(project).of("robot")[0].runs:
        assert time.monotonic() < end
        time.sleep(0.1)
    job = jobs_of(project).of("robot")[0]
    assert job.state == "finished", job.lines()
    return client.get("/robot").text


def test_a_run_begins_with_the_things_of_a_scene_that_is_sent(
    client: TestClient, project: Project
) -> None:
    sent = {"scene_file": ("my scenes.json", json.dumps(SCENES).encode(), "application/json")}
    goal = "put the green cube on the gray cube"
    shown = begin_with(client, project, sent, goal=goal, number="1")
    assert "The things are those of my_scenes, scene 1." in shown
    assert "In truth it is reached." in shown
    # It is in the list then, and the next run takes it from there.
    (value,) = re.findall(r'<option value="([^"]+#0)">my_scenes, scene 0</option>', shown)
    goal = "put the red cube on the blue cube"
    shown = begin_with(client, project, {}, goal=goal, scene=html.unescape(value))
    assert "scene 0</option>" in shown
    assert "In truth it is reached." in shown
    told = client.post(
        "/robot/ask", data={"csrf": csrf_of(client), "question": "what is your goal?"}
    ).text
    assert "red" in told


@pytest.mark.parametrize(
    ("name", "content", "asked", "said"),
    [
        ("scenes.json", b"{", {}, "scenes"),
        ("scenes.json", json.dumps(SCENES).encode(), {}, "has 2 scenes; say which"),
        ("scenes.json", json.dumps(SCENES).encode(), {"number": "7"}, "image_index 7"),
        ("scenes.txt", b"{}", {}, "is neither a scene (.json) nor a history (.al)"),
        ("scenes.json", json.dumps(SCENES).encode(), {"domain": "robot_assistant"}, "no [things]"),
    ],
)
def test_a_scene_that_cannot_be_is_said(
    client: TestClient,
    project: Project,
    name: str,
    content: bytes,
    asked: dict[str, str],
    said: str,
) -> None:
    form = {"csrf": csrf_of(client), "domain": "tabletop", "goal": "make a tower of two", **asked}
    files = {"scene_file": (name, content, "application/json")}
    refused = client.post("/robot", data=form, files=files)
    assert refused.status_code == 422
    assert said in refused.text
    assert not jobs_of(project).of("robot")


def test_it_is_planned_on_from_what_was_done_so_far(
    client: TestClient, project: Project, lamps: Path
) -> None:
    run_it(client, project, lamps)
    record = (jobs_of(project).of("robot")[0].folder / "run.al").read_bytes()
    files = {"history_file": ("my run.al", record, "text/plain")}
    form = {"csrf": csrf_of(client), "folder": str(lamps), "goal": "lit(desk)"}
    shown = begin_with(client, project, files, folder=str(lamps), goal="lit(desk)")
    assert "What was done so far: press the desk lamp." in shown
    assert "The goal holds already; nothing is to be done." in shown
    assert "In truth" not in shown
    seen = {"history_file": ("seen.al", b"observed -lit(desk) at 0.", "text/plain")}
    shown = begin_with(client, project, seen, folder=str(lamps), goal="lit(desk)")
    assert "The shortest plan has 1 action." in shown
    assert "Intended from here: press the desk lamp." in shown
    told = client.post(
        "/robot/ask", data={"csrf": csrf_of(client), "question": "what is your goal?"}
    ).text
    assert "the desk lamp is lit" in told
    wrong = {"history_file": ("run.al", b"moo.", "text/plain")}
    refused = client.post("/robot", data=form, files=wrong)
    assert refused.status_code == 422
