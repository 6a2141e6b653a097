"""Jobs: long work in processes of its own, which goes on when the browser or the studio is gone."""

from __future__ import annotations

import json
import os
import secrets
import shutil
import subprocess
import sys
from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from threading import RLock
from typing import Any
from weakref import WeakKeyDictionary

from seewhy.errors import SeeWhyError
from seewhy.files.progress_file import PROGRESS_FILE, Progress, read_progress
from seewhy.studio.job_process import CODE, LOG, OUTPUT
from seewhy.studio.processes import began, interrupt, kill
from seewhy.studio.project import Project
from seewhy.studio.record import Entry

__all__ = ["FAILED", "FINISHED", "INTERRUPTED", "JOB", "RUNNING", "Job", "Jobs", "jobs_of"]

JOB = "job"
"""Body, of a start: ``task``, ``folder``, ``process``, ``began`` and what was ``asked``.

Of an end: ``ends``, the number of the entry of the start, ``state`` and ``sentence``.
"""

RUNNING, FINISHED, INTERRUPTED, FAILED = "running", "finished", "interrupted", "failed"

_FOLDER = ".jobs"
_KEPT = 5
"""Jobs of a task whose files are kept, the last ones."""

_CTRL_C = 130
_MOST_LOG = 200_000
"""Bytes of a log that are looked at, the last ones."""

_MOST_JSON = 64_000_000
"""Bytes."""

_COMPLAINS = "seewhy: "


@dataclass(frozen=True)
class Job:
    """Long work that was started.

    Attributes
    ----------
    number : int
        Of the entry of its start.
    task : str
        Such as ``train``; of each only one runs at a time.
    state : str
        ``running``, ``finished``, ``interrupted`` or ``failed``.
    sentence : str
        Why it failed.
    who, started, ended : str
        By whom, from when until when (ISO 8601, UTC); ``ended`` is empty while it runs.
    asked : mapping
        What was asked for, as the page that started it has it.
    folder : Path
        Where its files lie.
    """

    number: int
    task: str
    state: str
    sentence: str
    who: str
    started: str
    ended: str
    asked: Mapping[str, Any]
    folder: Path

    @property
    def runs(self) -> bool:
        """Whether it has not ended."""
        return self.state == RUNNING

    @property
    def output(self) -> Path:
        """The file of what it printed."""
        return self.folder / OUTPUT

    def printed(self) -> Any:
        """What it printed, as JSON; None where that is missing, too long or no JSON."""
        try:
            if self.output.stat().st_size > _MOST_JSON:
                return None
            return json.loads(self.output.read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return None

    @property
    def progress(self) -> Progress | None:
        """How far it is; None where it did not say yet."""
        return read_progress(self.folder / "progress.json")

    def lines(self, most: int = 12) -> list[str]:
        """The last lines of what it remarked."""
        try:
            with (self.folder / LOG).open("rb") as log:
                log.seek(max(0, os.fstat(log.fileno()).st_size - _MOST_LOG))
                text = log.read().decode("utf-8", "replace")
        except OSError:
            return []
        return list(deque((line for line in text.splitlines() if line.strip()), maxlen=most))


class Jobs:
    """The jobs of a project, as its record has them.

    Parameters
    ----------
    project : Project
    """

    def __init__(self, project: Project) -> None:
        self._folder, self._record = project.folder, project.record
        self._lock = RLock()
        # Children have to be asked after when they end, or their remains stay.
        self._children: list[subprocess.Popen[bytes]] = []

    def of(self, task: str) -> Sequence[Job]:
        """The jobs of a task, the last one first."""
        with self._lock:
            self._children = [child for child in self._children if child.poll() is None]
            entries = [entry for entry in self._record.all() if entry.kind == JOB]
            ends = {entry.body["ends"]: entry for entry in entries if "ends" in entry.body}
            starts = [entry for entry in entries if entry.body.get("task") == task]
            return [self._job(start, ends.get(start.number)) for start in reversed(starts)]

    def last(self, task: str) -> Job | None:
        """The job of a task that was started last."""
        return next(iter(self.of(task)), None)

    def start(
        self,
        task: str,
        module: str,
        arguments: Sequence[str],
        *,
        who: str,
        asked: Mapping[str, Any] | None = None,
    ) -> Job:
        """Run a module as a program, with the project's folder as the working one.

        ``{job}`` in an argument stands for the folder of the job's files, from there.

        Raises
        ------
        SeeWhyError
            If a job of the task runs.
        """
        with self._lock:
            before = self.of(task)
            if before and before[0].runs:
                raise SeeWhyError(
                    f"another '{task}' runs since {_clock(before[0].started)} UTC; wait until it "
                    "has ended, or stop it"
                )
            for old in before[_KEPT - 1 :]:
                shutil.rmtree(old.folder, ignore_errors=True)
            folder = self._folder / _FOLDER / f"{task}-{secrets.token_hex(6)}"
            folder.mkdir(parents=True)
            here = folder.relative_to(self._folder).as_posix()
            told = [argument.replace("{job}", here) for argument in arguments]
            command = [sys.executable, "-m", module, *told]
            child = subprocess.Popen(
                [sys.executable, "-m", "seewhy.studio.job_process", str(folder), *command],
                cwd=self._folder,
                env=os.environ | {PROGRESS_FILE: str(folder / "progress.json")},
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                start_new_session=True,
            )
            self._children.append(child)
            entry = self._record.add(
                JOB,
                {
                    "task": task,
                    "folder": folder.name,
                    "process": child.pid,
                    "began": began(child.pid),
                    "asked": dict(asked or {}),
                },
                who=who,
            )
            return self._job(entry, None)

    def stop(self, task: str) -> None:
        """Interrupt the job of a task, if one runs; asked twice, end it at once."""
        with self._lock:
            job = self.last(task)
            if job is None or not job.runs:
                return
            start = next(entry for entry in self._record.all() if entry.number == job.number)
            asked_before = job.folder / "stopping"
            if asked_before.exists():
                kill(start.body["process"])
            else:
                asked_before.touch()
                interrupt(start.body["process"])

    def _job(self, start: Entry, end: Entry | None) -> Job:
        body = start.body
        folder = self._folder / _FOLDER / body["folder"]
        # Without a time of its own ("" both) a process cannot be told from another of its number.
        if end is None and (not body["began"] or began(body["process"]) != body["began"]):
            end = self._ended(start, folder)
        return Job(
            start.number,
            body["task"],
            RUNNING if end is None else end.body["state"],
            "" if end is None else end.body["sentence"],
            start.who,
            start.at,
            "" if end is None else end.at,
            body["asked"],
            folder,
        )

    def _ended(self, start: Entry, folder: Path) -> Entry:
        """Note how a job ended: as its files say, which another process wrote."""
        try:
            code: int | None = int((folder / CODE).read_text())
        except (OSError, ValueError):
            code = None
        state, sentence = FINISHED, ""
        if code is None or code < 0 or code == _CTRL_C:
            state = INTERRUPTED
        elif code:
            state, sentence = FAILED, _complaint(folder, code)
        body = {"ends": start.number, "state": state, "sentence": sentence}
        return self._record.add(JOB, body, who=start.who)


_jobs: WeakKeyDictionary[Project, Jobs] = WeakKeyDictionary()
_jobs_lock = RLock()


def jobs_of(project: Project) -> Jobs:
    """The jobs of a project."""
    with _jobs_lock:
        found = _jobs.get(project)
        if found is None:
            found = _jobs[project] = Jobs(project)
        return found


def _complaint(folder: Path, code: int) -> str:
    """The sentence with which a command failed."""
    lines = Job(0, "", FAILED, "", "", "", "", {}, folder).lines(most=60)
    said = [line for line in lines if line.startswith(_COMPLAINS)]
    if said:
        return said[-1].removeprefix(_COMPLAINS)
    return lines[-1].strip() if lines else f"it ended with code {code} and said nothing"


def _clock(at: str) -> str:
    return at[11:16]
