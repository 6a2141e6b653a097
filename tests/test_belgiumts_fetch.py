"""Fetching the archives of BelgiumTS, from a server on this machine."""

from __future__ import annotations

import json
import re
import threading
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest

from belgiumts_archives import Files, half, other_half, pack, training
from conftest import Run, write_domain
from seewhy.errors import DatasetError
from seewhy_lab.belgiumts import download
from seewhy_lab.belgiumts.download import ARCHIVES, fetch_archives
from test_belgiumts import CLASSES, SCENES

TRAINING, TESTING = ARCHIVES.values()


class Server(ThreadingHTTPServer):
    """Serves files by name; what it does besides is set by a test."""

    files: dict[str, bytes]
    ranges = True
    breaks_after: int | None = None
    wrong_start = False
    says_length = True
    asked: list[tuple[str, str]]

    @property
    def address(self) -> str:
        return f"http://127.0.0.1:{self.server_port}/data"


class Handler(BaseHTTPRequestHandler):
    server: Server

    def do_GET(self) -> None:
        name = self.path.removeprefix("/data/")
        wanted = self.headers.get("Range", "")
        self.server.asked.append((name, wanted))
        content = self.server.files.get(name)
        if content is None:
            self.send_error(404)
            return
        start = 0
        if wanted and self.server.ranges:
            start = int(re.fullmatch(r"bytes=(\d+)-", wanted)[1])  # type: ignore[index]
            if start >= len(content):
                self.send_response(416)
                self.send_header("Content-Range", f"bytes */{len(content)}")
                self.end_headers()
                return
            self.send_response(206)
            said = start + 1 if self.server.wrong_start else start
            self.send_header("Content-Range", f"bytes {said}-{len(content) - 1}/{len(content)}")
        else:
            self.send_response(200)
        if self.server.says_length:
            self.send_header("Content-Length", str(len(content) - start))
        self.end_headers()
        stop = None if self.server.breaks_after is None else start + self.server.breaks_after
        self.wfile.write(content[start:stop])

    def log_message(self, *_: object) -> None:
        """Say nothing."""


@pytest.fixture
def server(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Server]:
    """A server of both halves, small ones, which here count as the official ones."""
    monkeypatch.setenv("no_proxy", "*")
    monkeypatch.setattr(download, "PHOTOGRAPHS", {"train": 4, "test": 1})
    running = Server(("127.0.0.1", 0), Handler)
    running.asked = []
    running.files = {
        TRAINING: zipped(tmp_path, training()),
        TESTING: zipped(tmp_path, other_half()),
    }
    thread = threading.Thread(target=running.serve_forever, kwargs={"poll_interval": 0.01})
    thread.start()
    yield running
    running.shutdown()
    thread.join()
    running.server_close()


def zipped(folder: Path, files: Files) -> bytes:
    return pack(folder / "packed.zip", files).read_bytes()


def by_hand(address: str) -> str:
    return (
        f"download {address}/BelgiumTSC_Training.zip and {address}/BelgiumTSC_Testing.zip in a "
        "browser and run 'seewhy belgiumts import BelgiumTSC_Training.zip "
        "BelgiumTSC_Testing.zip --out DIR'"
    )


def failure(folder: Path, address: str) -> str:
    with pytest.raises(DatasetError) as problem:
        fetch_archives(folder, address=address)
    return str(problem.value)


def test_the_command(run: Run, server: Server, tmp_path: Path) -> None:
    domain = write_domain(tmp_path / "tiles")
    (domain / "classes.csv").write_text(CLASSES)
    out = tmp_path / "photos"
    command = ("belgiumts", "fetch", "--domain", domain, "--out", out)
    result = run(*command, "--address", server.address, "--json")
    assert (result.code, result.err) == (0, "")
    assert json.loads(result.out)["photographs"] == 5
    assert (out / "scenes.csv").read_text() == SCENES
    assert server.asked == [(TRAINING, ""), (TESTING, "")]
    assert sorted(path.name for path in (out / "archives").iterdir()) == sorted([TRAINING, TESTING])
    # What is here is not asked for again, but what was damaged since is.
    (out / "archives" / TESTING).write_bytes(server.files[TESTING][:-30])
    server.asked.clear()
    assert run(*command, "--address", server.address).code == 0
    assert server.asked == [(TESTING, "")]


def test_progress(server: Server, tmp_path: Path) -> None:
    told: list[tuple[str, int, int | None]] = []
    fetch_archives(
        tmp_path, address=server.address, on_progress=lambda *progress: told.append(progress)
    )
    sizes = {name: len(content) for name, content in server.files.items()}
    assert {name: (here, total) for name, here, total in told} == {
        name: (size, size) for name, size in sizes.items()
    }


@pytest.mark.parametrize("ranges", [True, False])
def test_a_download_goes_on_where_it_broke_off(
    ranges: bool, server: Server, tmp_path: Path
) -> None:
    whole = server.files[TRAINING]
    (tmp_path / f"{TRAINING}.part").write_bytes(whole[:500])
    server.ranges = ranges
    assert fetch_archives(tmp_path, address=server.address)[0].read_bytes() == whole
    assert server.asked[0] == (TRAINING, "bytes=500-")
    assert not list(tmp_path.glob("*.part"))


def test_a_download_that_breaks_off_is_taken_up_at_once(server: Server, tmp_path: Path) -> None:
    whole = server.files[TRAINING]
    server.breaks_after = len(whole) // 2 + 1
    archives = fetch_archives(tmp_path, address=server.address)
    assert archives == [tmp_path / TRAINING, tmp_path / TESTING]
    assert [path.read_bytes() for path in archives] == list(server.files.values())
    assert server.asked[:2] == [(TRAINING, ""), (TRAINING, f"bytes={len(whole) // 2 + 1}-")]


def test_a_download_that_gets_no_further(server: Server, tmp_path: Path) -> None:
    (tmp_path / f"{TRAINING}.part").write_bytes(server.files[TRAINING][:500])
    server.breaks_after = 0
    assert failure(tmp_path, server.address) == (
        f"{server.address}/{TRAINING}: broke off after 0.0 MB; the same command goes on from "
        f"there, or {by_hand(server.address)}"
    )
    assert len(server.asked) == 3
    assert (tmp_path / f"{TRAINING}.part").read_bytes() == server.files[TRAINING][:500]


def test_a_part_that_is_whole(server: Server, tmp_path: Path) -> None:
    (tmp_path / f"{TRAINING}.part").write_bytes(server.files[TRAINING])
    assert fetch_archives(tmp_path, address=server.address)[0].is_file()
    assert server.asked[0] == (TRAINING, f"bytes={len(server.files[TRAINING])}-")
    assert server.asked[1][0] == TESTING


def test_a_part_of_something_longer(server: Server, tmp_path: Path) -> None:
    whole = server.files[TRAINING]
    (tmp_path / f"{TRAINING}.part").write_bytes(whole + b"more")
    assert fetch_archives(tmp_path, address=server.address)[0].read_bytes() == whole


def test_a_server_that_sends_another_part(server: Server, tmp_path: Path) -> None:
    whole = server.files[TRAINING]
    (tmp_path / f"{TRAINING}.part").write_bytes(whole[:500])
    server.wrong_start = True
    assert fetch_archives(tmp_path, address=server.address)[0].read_bytes() == whole


def test_a_server_that_does_not_say_how_much(server: Server, tmp_path: Path) -> None:
    server.says_length = False
    archives = fetch_archives(tmp_path, address=server.address)
    assert [path.read_bytes() for path in archives] == list(server.files.values())


def test_a_file_that_is_not_there(server: Server, tmp_path: Path) -> None:
    del server.files[TESTING]
    assert failure(tmp_path, server.address + "/") == (
        f"{server.address}/{TESTING}: the server answers 404 Not Found; {by_hand(server.address)}"
    )
    assert (tmp_path / TRAINING).is_file()


def test_no_network(tmp_path: Path, server: Server) -> None:
    server.shutdown()
    server.server_close()
    text = failure(tmp_path, server.address)
    assert text == (
        f"{server.address}/{TRAINING}: cannot be reached (Connection refused); "
        f"{by_hand(server.address)}"
    )
    assert not list(tmp_path.glob("BelgiumTSC*"))


def test_an_address_of_another_kind(tmp_path: Path) -> None:
    assert failure(tmp_path, "file:///home/me") == (
        "'file:///home/me' must begin with https:// or http://; correct the address"
    )


@pytest.mark.parametrize("kind", ["page", "damaged"])
def test_garbage(kind: str, server: Server, tmp_path: Path) -> None:
    content = bytearray(server.files[TRAINING])
    content[120] ^= 255
    server.files[TRAINING] = b"<html>Sorry</html>" if kind == "page" else bytes(content)
    text = failure(tmp_path, server.address)
    assert text.startswith(f"{server.address}/{TRAINING}: what came is ")
    assert text.endswith(f" and was deleted; run the command again, or {by_hand(server.address)}")
    assert ("is no whole zip archive (File is not a zip file)" in text) == (kind == "page")
    assert not list(tmp_path.glob("BelgiumTSC*"))


def test_an_archive_with_too_few_photographs(run: Run, server: Server, tmp_path: Path) -> None:
    domain = write_domain(tmp_path / "tiles")
    (domain / "classes.csv").write_text(CLASSES)
    names = ["00010_00000.ppm", "00010_00001.ppm"]
    server.files[TRAINING] = zipped(tmp_path, half("Training", {0: names}))
    out = tmp_path / "photos"
    result = run(
        *("belgiumts", "fetch", "--domain", domain, "--out", out),
        *("--address", server.address),
    )
    assert (result.code, result.out) == (2, "")
    assert result.err == (
        f"seewhy: {out}/archives/{TRAINING}: holds 2 photographs, {TRAINING} should hold 4; delete "
        "it and fetch it again\n"
    )
    assert not (out / "scenes.csv").exists()
