"""Ask a served model by many clients at once: errors, times, memory, pictures a second.

    python -m seewhy_lab serve_load MODEL PICTURE --requests 3000 --clients 50

The server is a process of its own on this machine. Beside it stands what ``seewhy classify`` does
with as many copies of the picture, in a process of its own, too.
"""

from __future__ import annotations

import argparse
import asyncio
import os
import re
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path
from urllib.parse import urlsplit

import numpy as np

from seewhy_lab.walk.serving import running_server

NO_ANSWER = 0
"""Stands for the status of what was not answered."""

_LONGEST = 120.0  # seconds until an answer is none any more

Connection = tuple[asyncio.StreamReader, asyncio.StreamWriter]

_NO_CACHE = {"SEEWHY_CACHE": ""}
"""All pictures are the same: none may be taken from what was seen of another."""


async def ask_all(
    address: str, content: bytes, *, requests: int, clients: int
) -> tuple[Counter[int], list[float]]:
    """Send requests from so many clients; return statuses and seconds.

    Each keeps its connection. All send the same bytes, made once: who asks takes the cores as
    little as can be from who answers.
    """
    place = urlsplit(address)
    request = _request(place.netloc, content)
    left = iter(range(requests))
    statuses: Counter[int] = Counter()
    seconds: list[float] = []

    async def ask() -> None:
        connection: Connection | None = None
        for _ in left:
            began = time.perf_counter()
            try:
                async with asyncio.timeout(_LONGEST):
                    if connection is None:
                        connection = await asyncio.open_connection(place.hostname, place.port)
                    statuses[await _status(connection, request)] += 1
            except (OSError, EOFError, TimeoutError):
                statuses[NO_ANSWER] += 1
                connection = None
            seconds.append(time.perf_counter() - began)
        if connection is not None:
            connection[1].close()

    await asyncio.gather(*(ask() for _ in range(clients)))
    return statuses, seconds


def _request(host: str, content: bytes) -> bytes:
    """What a browser would send of a form with a picture."""
    end = b"--picture"
    part = b'Content-Disposition: form-data; name="image"; filename="a.png"'
    body = b"\r\n".join((end, part, b"", content, end + b"--", b""))
    head = (
        f"POST /classify HTTP/1.1\r\nHost: {host}\r\nContent-Length: {len(body)}\r\n"
        "Content-Type: multipart/form-data; boundary=picture\r\n\r\n"
    )
    return head.encode() + body


async def _status(connection: Connection, request: bytes) -> int:
    """Send a request, and read the whole answer."""
    reader, writer = connection
    writer.write(request)
    head = await reader.readuntil(b"\r\n\r\n")
    length = re.search(rb"content-length: *(\d+)", head, re.IGNORECASE)
    await reader.readexactly(int(length[1]) if length else 0)
    return int(head.split(maxsplit=2)[1])


def resident(process: int) -> int:
    """The memory of a process and of those that it began, in megabytes."""
    total = 0
    for status in Path("/proc").glob("[0-9]*/status"):
        try:
            text = status.read_text()
        except OSError:
            continue
        number, parent = (re.search(rf"^{key}:\t(\d+)", text, re.M) for key in ("Pid", "PPid"))
        size = re.search(r"^VmRSS:\s+(\d+)", text, re.M)
        if number and parent and size and str(process) in (number[1], parent[1]):
            total += int(size[1])
    return total // 1024


def batch_rate(model: Path, picture: Path, *, count: int) -> float | None:
    """Pictures a second of ``seewhy classify``, without the time in which it begins.

    None where so few pictures take no longer than one.
    """
    program = [sys.executable, "-m", "seewhy", "classify", str(model)]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        spent = []
        # The first time, the program itself has still to be read from the disk.
        for turn, some in enumerate((1, 1, count)):
            pictures = folder / str(turn)
            pictures.mkdir()
            for number in range(some):
                (pictures / f"{number}{picture.suffix}").write_bytes(picture.read_bytes())
            began = time.perf_counter()
            subprocess.run(
                [*program, str(pictures), "--out", str(folder / f"{turn}.csv")],
                check=True,
                capture_output=True,
            )
            spent.append(time.perf_counter() - began)
    longer = spent[-1] - spent[-2]
    return (count - 1) / longer if longer > 0 else None


def main() -> None:
    """Print what came of it; exit with 1 where a request was not answered well."""
    parser = argparse.ArgumentParser(
        "python -m seewhy_lab serve_load", description=(__doc__ or "").splitlines()[0]
    )
    parser.add_argument("model", type=Path)
    parser.add_argument("picture", type=Path)
    parser.add_argument("--requests", type=int, default=3000)
    parser.add_argument("--clients", type=int, default=50)
    parser.add_argument("--workers", type=int, default=1)
    options = parser.parse_args()
    os.environ.update(_NO_CACHE)
    content = options.picture.read_bytes()
    rate = batch_rate(options.model, options.picture, count=min(options.requests, 2000))
    serve = ["serve", str(options.model), "--workers", str(options.workers)]
    with (
        tempfile.TemporaryDirectory() as folder,
        running_server(serve, Path(folder) / "log") as (address, process),
    ):
        asyncio.run(
            ask_all(address, content, requests=options.clients * 4, clients=options.clients)
        )
        before = resident(process)
        began = time.perf_counter()
        statuses, seconds = asyncio.run(
            ask_all(address, content, requests=options.requests, clients=options.clients)
        )
        spent = time.perf_counter() - began
        after = resident(process)
    served = options.requests / spent
    p50, p99 = (1000 * float(np.percentile(seconds, share)) for share in (50, 99))
    print(f"{options.requests} requests of {options.clients} clients in {spent:.1f} s")
    print(f"statuses: {dict(statuses)}")
    print(f"p50 {p50:.0f} ms, p99 {p99:.0f} ms")
    print(f"memory: {before} MB before, {after} MB after")
    if rate is None:
        print(f"served: {served:.1f} a second; of seewhy classify more requests would tell")
    else:
        share = f"{served / rate:.0%} of it"
        print(f"served: {served:.1f} a second; seewhy classify: {rate:.1f}; {share}")
    if set(statuses) != {200}:
        sys.exit(1)


if __name__ == "__main__":
    main()
