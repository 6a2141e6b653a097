"""Where rows were made: commits are named, times of two kinds of machines never put together."""

from __future__ import annotations

import json
import os
import platform
import subprocess
import sys
from importlib.metadata import PackageNotFoundError
from pathlib import Path

import pytest
from torch.backends import cpu

from seewhy_lab.experiments import origin, rows
from seewhy_lab.experiments.experiment import Row, Trial
from seewhy_lab.experiments.origin import Origin, one_machine, say_machine, say_origins
from seewhy_lab.experiments.published import take_up
from seewhy_lab.experiments.rows import (
    finish,
    read_trial,
    trial_file,
    write_table,
    write_tables,
    write_trial,
)

TRIAL = Trial(0, 9)
ROW = {"seed": 0, "size": 9, "system": "a", "accuracy": 0.5, "seconds_answers": 1.5}


def git(folder: Path, *arguments: str) -> None:
    subprocess.run(
        ["git", "-c", "user.name=x", "-c", "user.email=x@y", "-C", str(folder), *arguments],
        check=True,
        capture_output=True,
    )


def test_a_row_says_where_it_was_made(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rows, "here", lambda: Origin("a machine", "commit 1ab"))
    write_trial(tmp_path, TRIAL, [ROW])
    (row,) = read_trial(tmp_path, TRIAL) or ()
    assert row == {**ROW, "machine": "a machine", "commit": "commit 1ab"}
    # What a trial found does not depend on it, so the table of rows does not have it.
    write_table(tmp_path / "rows.csv", [row], timings=False)
    assert (tmp_path / "rows.csv").read_text() == "seed,size,system,accuracy\n0,9,a,0.5\n"
    write_table(tmp_path / "timings.csv", [row], timings=True)
    assert (tmp_path / "timings.csv").read_text() == (
        "seed,size,system,machine,commit,seconds_answers\n0,9,a,a machine,commit 1ab,1.5\n"
    )


def test_a_trial_that_does_not_say_is_read(tmp_path: Path) -> None:
    write_trial(tmp_path, TRIAL, [ROW])
    file = trial_file(tmp_path, TRIAL)
    content = json.loads(file.read_text())
    del content["made"], content["digest"]
    file.write_text(json.dumps(content))
    assert read_trial(tmp_path, TRIAL) == [ROW]


def test_the_commit_is_that_of_the_code(tmp_path: Path) -> None:
    package = tmp_path / "src" / "package"
    package.mkdir(parents=True)
    (package / "__init__.py").write_text("")
    assert origin._commit(package).startswith("version ")
    git(tmp_path, "init", "-q")
    # Installed into a folder inside somebody else's checkout: their commit says nothing.
    assert origin._commit(package).startswith("version ")
    git(tmp_path, "add", ".")
    git(tmp_path, "commit", "-qm", "first")
    commit = origin._commit(package)
    assert commit.startswith("commit ")
    (tmp_path / "notes.txt").write_text("beside the code")
    assert origin._commit(package) == commit
    (package / "__init__.py").write_text("changed = True\n")
    assert origin._commit(package) == f"{commit} with uncommitted changes"
    git(tmp_path, "commit", "-qam", "second")
    (package / "added.py").write_text("")
    assert origin._commit(package).endswith(" with uncommitted changes")


def test_without_git_there_is_a_version(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    assert origin._commit(Path(origin.__file__).parent).startswith("version ")


def test_without_an_installation_the_commit_is_said(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def missing(name: str) -> str:
        raise PackageNotFoundError(name)

    monkeypatch.setattr(origin, "version", missing)
    (tmp_path / "__init__.py").write_text("")
    assert origin._commit(tmp_path) == "version not installed"
    git(tmp_path, "init", "-q")
    git(tmp_path, "add", ".")
    git(tmp_path, "commit", "-qm", "first")
    assert origin._commit(tmp_path).startswith("commit ")


def test_times_of_one_kind_of_machine_only() -> None:
    slow, fast = ({**ROW, "machine": name} for name in ("slow", "fast"))
    assert one_machine([slow, fast, fast]) == ([fast, fast], "fast")
    assert one_machine([ROW, ROW, fast]) == ([ROW, ROW], "")
    assert one_machine([]) == ([], "")


def test_it_is_said_whose_times_are_told() -> None:
    slow, fast = ({**ROW, "seed": n, "machine": name} for n, name in enumerate(("slow", "fast")))
    other = {**fast, "system": "b"}
    assert say_machine([fast, other], [fast, other], "fast") == "the trials, made on fast"
    assert say_machine([slow, fast, other], [fast, other], "fast") == (
        "1 of 2 trials, made on fast; times of other machines are left out"
    )
    assert say_machine([ROW], [ROW], "") == "the trials, made on a machine that is not recorded"


def test_the_commit_is_that_at_the_beginning(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    commits = ["first"]
    monkeypatch.setattr(origin, "_commit", lambda _: commits[-1])

    def make() -> list[Row]:
        commits.append("second")
        return [ROW]

    origin.here.cache_clear()
    try:
        finish(tmp_path, TRIAL, make)
    finally:
        origin.here.cache_clear()
    (row,) = read_trial(tmp_path, TRIAL) or ()
    assert row["commit"] == "first"


def test_which_commits_made_the_trials() -> None:
    other = {**ROW, "system": "b", "commit": "commit 1ab"}
    assert say_origins([{**ROW, "commit": "commit 1ab"}, other]) == "commit 1ab (1 trial)"
    assert say_origins([ROW, {**other, "seed": 1}, {**other, "seed": 2}]) == (
        "not recorded (1 trial), commit 1ab (2 trials)"
    )


def test_the_machine_says_its_instruction_set() -> None:
    """In a process that PyTorch was told to compute so in."""
    if cpu.get_cpu_capability() == "DEFAULT":
        pytest.skip("this processor has no larger instruction set")
    say = "from seewhy_lab.experiments.origin import here; print(here().machine)"
    done = subprocess.run(
        [sys.executable, "-c", say],
        env={**os.environ, "ATEN_CPU_CAPABILITY": "default"},
        capture_output=True,
        text=True,
        check=True,
    )
    cores = os.cpu_count() or 1
    assert done.stdout.endswith(f"DEFAULT), {cores} core{'s' * (cores > 1)}, {platform.system()}\n")


def test_processors_of_one_name_are_told_apart(tmp_path: Path) -> None:
    file = tmp_path / "cpuinfo"
    two = "model name\t: AMD EPYC\ncpu family\t: 25\nmodel\t\t: {}\nstepping\t: 1\n\n"
    said = []
    for model in (1, 17):
        file.write_text(two.format(model) * 2)
        said.append(origin._processor(file))
    instructions = cpu.get_cpu_capability()
    assert said == [f"AMD EPYC (family 25, model {n}, {instructions})" for n in (1, 17)]
    # Where the system does not say, there are still a name and the instruction set.
    name = origin._processor(tmp_path / "missing")
    assert name == f"{platform.processor() or platform.machine()} ({instructions})"


def test_rows_that_lack_the_instruction_set_are_read_and_timed_apart(tmp_path: Path) -> None:
    earlier = {"machine": "AMD EPYC, 2 cores, Linux", "commit": "commit 1ab"}
    write_trial(tmp_path, TRIAL, [ROW], made=earlier)
    write_trial(tmp_path, Trial(1, 9), [{**ROW, "seed": 1}])
    write_tables(tmp_path)
    for file in (tmp_path / "trials").iterdir():
        file.unlink()
    take_up(tmp_path)
    found = [row for seed in (0, 1) for row in read_trial(tmp_path, Trial(seed, 9)) or ()]
    assert [row["machine"] for row in found] == [earlier["machine"], origin.here().machine]
    assert one_machine([*found, found[1]])[0] == [found[1], found[1]]
