"""The studio's trainings: jobs that outlive the server, stop and go on; what they say."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Callable, Iterator
from datetime import UTC, datetime
from pathlib import Path

import pytest
from fastapi.testclient import TestClient

from seewhy.errors import SeeWhyError
from seewhy.studio import jobs as jobs_module
from seewhy.studio.jobs import FAILED, FINISHED, INTERRUPTED, JOB, RUNNING, Job, Jobs, jobs_of
from seewhy.studio.keeping_back import keep_back, kept, place, suggested_pattern
from seewhy.studio.pages import train
from seewhy.studio.processes import began
from seewhy.studio.project import Project
from seewhy.studio.site import site
from seewhy.studio.time_left import time_left
from studio_builder import RULES, csrf_of, embed, pictures, with_domain


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return Project(with_domain(pictures(tmp_path / "fruit", 8)))


@pytest.fixture
def client(project: Project) -> Iterator[TestClient]:
    with TestClient(site(project, rules=RULES, embed=embed)) as client:
        yield client


def label_all(project: Project) -> None:
    values = {}
    for number, name in enumerate(project.pictures()):
        red = number % 2 == 0
        values[name] = {
            "class": "good" if red else "spoilt",
            "colour": "red" if red else "green",
            "round": "yes" if red else "no",
        }
    project.label(values, who="Ada")


def until(found: Callable[[], bool], seconds: float = 60) -> None:
    end = time.monotonic() + seconds
    while not found():
        assert time.monotonic() < end
        time.sleep(0.05)


def program(project: Project, text: str) -> str:
    """A module of the project's folder, which a job runs instead of a training."""
    name = f"work{len(list(project.folder.glob('work*.py')))}"
    (project.folder / f"{name}.py").write_text(text)
    return name


WAITS = """
import sys, time
print("waits", file=sys.stderr, flush=True)
try:
    time.sleep(60)
except KeyboardInterrupt:
    sys.exit(130)
"""


def ended(project: Project) -> Job:
    until(lambda: not jobs_of(project).of("train")[0].runs)
    return jobs_of(project).of("train")[0]


def says(project: Project, line: str) -> bool:
    return line in jobs_of(project).of("train")[0].lines()


def test_a_job_ends_and_its_record_says_how(project: Project) -> None:
    jobs = jobs_of(project)
    jobs.start("train", program(project, "print('done')"), [], who="Ada")
    done = ended(project)
    assert (done.state, done.sentence, done.output.read_text()) == (FINISHED, "", "done\n")
    fails = "import sys; print('seewhy: no row has a class; fill it', file=sys.stderr); sys.exit(2)"
    jobs.start("train", program(project, fails), [], who="Ada")
    failed = ended(project)
    assert (failed.state, failed.sentence) == (FAILED, "no row has a class; fill it")
    assert len([entry for entry in project.record.all() if entry.kind == JOB]) == 4


def test_a_second_start_is_refused_and_a_stop_interrupts(project: Project) -> None:
    jobs = jobs_of(project)
    jobs.start("train", program(project, WAITS), [], who="Ada")
    with pytest.raises(SeeWhyError, match=r"another 'train' runs since \d\d:\d\d UTC; wait"):
        jobs.start("train", program(project, WAITS), [], who="Bob")
    until(lambda: says(project, "waits"))
    jobs.stop("train")
    assert ended(project).state == INTERRUPTED


def test_what_does_not_heed_is_ended_at_the_second_stop(project: Project) -> None:
    jobs = jobs_of(project)
    deaf = "import signal; signal.signal(signal.SIGINT, signal.SIG_IGN)\n" + WAITS
    jobs.start("train", program(project, deaf), [], who="Ada")
    until(lambda: says(project, "waits"))
    jobs.stop("train")
    assert jobs.of("train")[0].runs
    jobs.stop("train")
    assert ended(project).state == INTERRUPTED


def test_a_running_job_is_found_again_after_the_studio_was_ended(project: Project) -> None:
    jobs_of(project).start("train", program(project, WAITS), [], who="Ada")
    until(lambda: says(project, "waits"))
    again = Jobs(Project(project.folder))
    found = again.of("train")[0]
    assert found.runs
    assert found.who == "Ada"
    process = next(entry for entry in project.record.all() if entry.kind == JOB).body["process"]
    os.killpg(process, signal.SIGKILL)
    until(lambda: not jobs_of(project).of("train")[0].runs)
    assert again.of("train")[0].state == INTERRUPTED


def test_another_process_of_its_number_is_not_the_job(project: Project) -> None:
    body = {
        "task": "train",
        "folder": "train-0",
        "process": os.getpid(),
        "began": "long ago",
        "asked": {},
    }
    project.record.add(JOB, body, who="Ada")
    assert began(os.getpid())
    assert jobs_of(project).of("train")[0].state == INTERRUPTED


def show_people(project: Project, people: range) -> None:
    """Put four pictures of each person into a project, PERSON_NUMBER.png, and label them."""
    content = (project.folder / "a.png").read_bytes()
    for person in people:
        for number in range(4):
            (project.folder / f"{person}_{number}.png").write_bytes(content)
    project.refresh()
    label_all(project)


def splits_of_people(project: Project) -> dict[str, set[str]]:
    found: dict[str, set[str]] = {}
    for name, row in project.labels().rows.items():
        found.setdefault(row.get("group", name), set()).add(row["split"])
    return found


def test_pictures_that_belong_together_are_kept_together(client: TestClient) -> None:
    project = client.app.state.studio.project  # type: ignore[attr-defined]
    show_people(project, range(8))
    for name in "abcdefgh":
        (project.folder / f"{name}.png").rename(project.folder / f"8_{name}.png")
    project.refresh()
    assert suggested_pattern(project) == "^(.+)[_-]"
    said = {"csrf": csrf_of(client), "together": "^(.+)[_-]"}
    assert client.post("/train/keep-back", data=said).status_code == 200
    before = splits_of_people(project)
    assert set(before) >= {str(person) for person in range(8)}
    assert all(len(splits) == 1 for splits in before.values())
    assert {split for splits in before.values() for split in splits} == {"train", "test"}
    # Who came later is kept together, too, without being asked for again.
    (project.folder / "8_a.png").rename(project.folder / "a.png")
    show_people(project, range(10, 14))
    place(project, who="Ada")
    after = splits_of_people(project)
    assert set(after) >= {"10", "11", "12", "13"}
    assert all(len(splits) == 1 for splits in after.values())


@pytest.mark.parametrize(
    ("pattern", "said"),
    [("(", "is no regular expression"), ("^(x+)#", "is found in no picture&#39;s name")],
)
def test_an_expression_that_cannot_be_meant_keeps_nothing(
    client: TestClient, project: Project, pattern: str, said: str
) -> None:
    label_all(project)
    answered = client.post("/train/keep-back", data={"csrf": csrf_of(client), "together": pattern})
    assert answered.status_code == 422
    assert said in answered.text
    assert kept(project.labels()) == {"train": 8}


def test_a_quarter_of_each_class_is_kept_and_what_comes_later_too(project: Project) -> None:
    label_all(project)
    place(project, who="Ada")
    assert kept(project.labels()) == {"train": 8}
    keep_back(project, who="Ada")
    labels = project.labels()
    assert kept(labels) == {"train": 6, "test": 2}
    assert {
        labels.value(name, "class") for name, row in labels.rows.items() if row["split"] == "test"
    } == {"good", "spoilt"}
    before = dict(labels.rows)
    pictures(project.folder, 12)
    project.refresh()
    label_all(project)
    place(project, who="Ada")
    labels = project.labels()
    assert sum(kept(labels).values()) == 12
    assert before.items() <= dict(labels.rows).items()
    assert len(project.dataset().of_split("train")) == kept(labels)["train"]


def trained(began: str, ended: str = "", **asked: object) -> Job:
    """A training of the 1st of January, which ended well if it ended."""
    state = FINISHED if ended else RUNNING
    ends = f"2026-01-01T{ended}:00.000+00:00" if ended else ""
    starts = f"2026-01-01T{began}:00.000+00:00"
    return Job(1, "train", state, "", "Ada", starts, ends, asked, Path())


@pytest.mark.parametrize(
    ("now", "before", "said"),
    [
        (trained("11:00", pictures=60), [], ""),
        (trained("11:00", pictures=60), [trained("10:00", "10:02")], ""),
        (trained("11:00"), [trained("10:00", "10:02", pictures=60)], ""),
        (trained("11:00", pictures=60), [trained("10:00", "10:00", pictures=60)], ""),
        (
            trained("11:00", pictures=60, went_on=True),
            [trained("10:00", "10:02", pictures=60)],
            "",
        ),
        (
            trained("11:00", pictures=60),
            [
                trained("10:30", "10:31", pictures=60, went_on=True),
                trained("10:00", "10:04", pictures=120),
            ],
            "About 1:00 left in all: the last training took 4:00 for 120 pictures",
        ),
        (
            trained("10:00", pictures=60),
            [trained("09:00", "09:02", pictures=60)],
            "It takes longer than was to be expected",
        ),
    ],
)
def test_how_long_all_of_it_takes_is_told_where_it_is_known(
    now: Job, before: list[Job], said: str
) -> None:
    told = time_left(now, before, now=datetime(2026, 1, 1, 11, 1, tzinfo=UTC))
    assert told.startswith(said)
    assert bool(told) == bool(said)


def test_the_page_says_how_long_all_of_it_takes(
    client: TestClient, project: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(train, "time_left", lambda job, before: f"{job.state}, {len(before)} more")
    for _ in range(2):
        jobs_of(project).start("train", program(project, WAITS), [], who="Ada")
        until(lambda: says(project, "waits"))
        said = client.get("/train/state").text
        assert said.count("running, ") == 1
        jobs_of(project).stop("train")
        ended(project)
    assert "running, 1 more" in said


def test_without_labels_the_page_says_what_is_missing(client: TestClient) -> None:
    assert "no picture is labelled yet" in client.get("/train").text
    refused = client.post("/train", data={"csrf": csrf_of(client)})
    assert refused.status_code == 422
    assert "no picture is labelled yet" in refused.text


def test_one_class_cannot_be_trained(client: TestClient, project: Project) -> None:
    project.label({"a.png": {"class": "good"}}, who="Ada")
    assert "training needs scenes of at least two classes" in client.get("/train").text


def test_no_form_of_elsewhere_begins_a_training(client: TestClient, project: Project) -> None:
    label_all(project)
    for address in ("/train", "/train/stop", "/train/anew", "/train/keep-back"):
        assert client.post(address).status_code == 403
    assert not jobs_of(project).of("train")


def test_the_page_trains_by_the_command_line_s_own_command(
    client: TestClient, project: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    label_all(project)
    asked = {"csrf": csrf_of(client)}
    client.post("/train/keep-back", data=asked)
    assert "6 labelled pictures" in client.get("/train").text
    # A program in the place of the command: training takes longer than a test may.
    named = program(project, WAITS.replace("time.sleep", "print(sys.argv[1:]); time.sleep"))
    kept_start = Jobs.start

    def start(self: Jobs, task: str, module: str, arguments: list[str], **options: object) -> Job:
        assert module == "seewhy"
        return kept_start(self, task, named, arguments, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(jobs_module.Jobs, "start", start)
    assert "Training goes on" in client.post("/train", data=asked).text
    until(lambda: says(project, "waits"))
    assert 'hx-get="/train/state"' in client.get("/train/state").text
    assert client.post("/train", data=asked).status_code == 422
    client.post("/train/stop", data=asked)
    assert ended(project).output.read_text() == (
        "['train', 'fruit', '--data', '.', '--out', 'model']\n"
    )
    assert client.get("/train/state").headers["HX-Refresh"] == "true"
    assert "Training was interrupted" in client.get("/train").text
