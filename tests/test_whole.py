"""Files and folders that are whole whenever a process is killed, and the litter of the killed."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import pytest

from seewhy.agent.agent import Agent
from seewhy.errors import BusyError
from seewhy.files import folders
from seewhy.files.folders import scratch_folder, settle_folder, whole_folder
from seewhy.files.locks import locked, sole_writer
from seewhy.files.whole_files import whole_file, write_whole

KILLED = """
import os, signal, sys
from pathlib import Path
from seewhy.files import whole_files as files
from seewhy.files import folders

target, what, way, step = Path(sys.argv[1]), sys.argv[2], sys.argv[3], int(sys.argv[4])
if what not in ("file", "folder"):
    from seewhy.agent.agent import Agent

    agent = Agent.load(what)
if way == "in two steps":
    folders._exchanged = lambda *_: False

def write():
    if what == "file":
        files.write_whole(target, "new" * 1000)
        return
    if what != "folder":
        agent.save(target)
        return
    with folders.whole_folder(target, replacing=True) as temporary:
        (temporary / "inside").mkdir()
        for name in ("a", "inside/b"):
            (temporary / name).write_text("new")

WRITES = ("files.py", "folders.py", "locks.py", "shutil.py", "model.py", "weights.py")

class Watch:
    # Counts the lines that are run in what writes, and ends all at one of them.
    def __init__(self, at):
        self.left = at
    def __call__(self, frame, event, _):
        if not frame.f_code.co_filename.endswith(WRITES):
            return None
        if event == "line":
            self.left -= 1
            if self.left == 0:
                os.kill(os.getpid(), signal.SIGKILL)
        return self

at = 1
while True:
    child = os.fork()
    if child == 0:
        sys.settrace(Watch(at))
        write()
        os._exit(0)
    _, status = os.waitpid(child, 0)
    print(at, os.WIFSIGNALED(status), flush=True)
    if not os.WIFSIGNALED(status) or sys.stdin.readline() != "on\\n":
        break
    at += step
"""


def killed(target: Path, what: str, way: str = "", *, step: int = 1) -> Iterator[int]:
    """Write in children that are killed, each some lines later; yield where, until one is not."""
    command = [sys.executable, "-c", KILLED, str(target), what, way, str(step)]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        for line in process.stdout:
            at, was_killed = line.split()
            if was_killed == "False":
                break
            yield int(at)
            process.stdin.write("on\n")
            process.stdin.flush()


def content(folder: Path) -> dict[str, str]:
    return {
        file.relative_to(folder).as_posix(): file.read_text()
        for file in folder.rglob("*")
        if file.is_file()
    }


@pytest.mark.parametrize("way", ["in one step", "in two steps"])
def test_a_folder_is_whole_wherever_its_writer_is_killed(tmp_path: Path, way: str) -> None:
    target = tmp_path / "model"
    old, new = {"a": "old", "c": "old"}, {"a": "new", "inside/b": "new"}
    found = []
    with whole_folder(target) as temporary:
        for name, text in old.items():
            (temporary / name).write_text(text)
    for _ in killed(target, "folder", way):
        settle_folder(target)
        found.append(content(target))
        if found[-1] == new:  # begin with the old one again; what the killed one left is cleared
            with whole_folder(target, replacing=True) as temporary:
                for name, text in old.items():
                    (temporary / name).write_text(text)
    assert len(found) > 40
    assert [seen for seen in found if seen not in (old, new)] == []
    assert old in found
    assert new in found
    assert content(target) == new
    assert [path.name for path in tmp_path.iterdir()] == ["model"]


def test_a_model_is_whole_wherever_its_writer_is_killed(
    agent: Agent, model_folder: Path, tmp_path: Path
) -> None:
    target = tmp_path / "model"
    older = Agent.load(model_folder)
    older.seed = 77
    older.save(target)
    found = []
    for _ in killed(target, str(model_folder), step=83):
        found.append(Agent.load(target).seed)
        if found[-1] != 77:
            older.save(target)
    assert len(found) > 5
    assert {*found} == {77, agent.seed}
    assert Agent.load(target).seed == agent.seed
    assert [path.name for path in tmp_path.iterdir()] == ["model"]


def test_a_file_is_whole_wherever_its_writer_is_killed(tmp_path: Path) -> None:
    target = tmp_path / "note.txt"
    target.write_text("old")
    found = []
    for _ in killed(target, "file"):
        found.append(target.read_text())
        target.write_text("old")
    assert len(found) > 15
    assert {*found} == {"old", "new" * 1000}
    assert [path.name for path in tmp_path.iterdir()] == ["note.txt"]


def test_two_writers_of_a_file_wait_for_each_other(tmp_path: Path) -> None:
    target = tmp_path / "note.txt"

    def write(text: str) -> None:
        for _ in range(30):
            write_whole(target, text * 5000, durable=False)
            found = target.read_text()
            assert found in ("a" * 5000, "b" * 5000)

    threads = [threading.Thread(target=write, args=(text,)) for text in "ab"]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert [path.name for path in tmp_path.iterdir()] == ["note.txt"]


def test_the_second_writer_is_refused(tmp_path: Path) -> None:
    work = tmp_path / "data"
    with sole_writer(work):
        with pytest.raises(BusyError) as problem, sole_writer(work):
            pass
        assert str(problem.value) == (
            f"{work}: another run is writing it; wait until that has ended, or choose another name"
        )
        with pytest.raises(BlockingIOError), sole_writer(work):
            pass
    with sole_writer(work):
        pass
    assert list(tmp_path.iterdir()) == []


def test_the_lock_of_a_killed_process_is_free(tmp_path: Path) -> None:
    work = tmp_path / "result.json"
    script = (
        "import sys, time\nfrom pathlib import Path\nfrom seewhy.files.locks import locked\n"
        "with locked(Path(sys.argv[1])) as ours:\n    print(ours, flush=True)\n    time.sleep(60)"
    )
    with subprocess.Popen(
        [sys.executable, "-c", script, str(work)], stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "True\n"
        with locked(work) as ours:
            assert not ours
        process.kill()
    assert process.returncode == -signal.SIGKILL
    assert [path.name for path in tmp_path.iterdir()] == [".result.json.lock"]
    with locked(work) as ours:
        assert ours
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_is_there_is_not_replaced_unasked(tmp_path: Path) -> None:
    (tmp_path / "mine").mkdir()
    with pytest.raises(FileExistsError), whole_folder(tmp_path / "mine"):
        pass
    assert [path.name for path in tmp_path.iterdir()] == ["mine"]


def test_a_link_to_a_folder_stays_one(tmp_path: Path) -> None:
    (tmp_path / "real").mkdir()
    (tmp_path / "link").symlink_to("real")
    with whole_folder(tmp_path / "link", replacing=True) as temporary:
        (temporary / "a").write_text("new")
    assert (tmp_path / "link").is_symlink()
    assert content(tmp_path / "real") == {"a": "new"}


def test_a_file_that_fails_leaves_nothing(tmp_path: Path) -> None:
    with suppress(KeyboardInterrupt), whole_file(tmp_path / "a.txt") as temporary:
        temporary.write_text("half")
        raise KeyboardInterrupt
    assert list(tmp_path.iterdir()) == []


def test_scratch_folders_of_the_killed_are_removed_and_those_of_the_living_are_not(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    (tmp_path / "seewhy-apples").mkdir()  # whatever it is, no scratch folder
    script = (
        "import time\nfrom seewhy.files.folders import scratch_folder\n"
        "with scratch_folder() as folder:\n    (folder / 'a').write_text('a')\n"
        "    print(folder, flush=True)\n    time.sleep(60)"
    )
    with subprocess.Popen(
        [sys.executable, "-c", script],
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "TMPDIR": str(tmp_path)},
    ) as process:
        assert process.stdout is not None
        other = Path(process.stdout.readline().strip())
        assert other.parent == tmp_path
        with scratch_folder() as mine:
            assert mine.is_dir()
            assert content(other) == {"a": "a"}
        process.kill()
    assert other.is_dir()
    with scratch_folder():
        assert not other.exists()
    assert [path.name for path in tmp_path.iterdir()] == ["seewhy-apples"]


def test_where_folders_cannot_be_exchanged_they_are_replaced(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(folders, "_exchanged", lambda *_: False)
    for text in ("old", "new"):
        with whole_folder(tmp_path / "model", replacing=True) as temporary:
            (temporary / "a").write_text(text)
        assert content(tmp_path / "model") == {"a": text}
        assert [path.name for path in tmp_path.iterdir()] == ["model"]
