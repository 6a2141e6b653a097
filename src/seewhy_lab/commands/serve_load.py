"""Ask a served model by many clients at once: errors, times, memory, pictures a second.

    python -m seewhy_lab serve_load MODEL PICTURE --requests 3000 --clients 50

The server is a process of its own on this machine. Beside it stands what ``seewhy classify`` does
with as many copies of the picture, in a process of its own, too.
"""

from __future__ import annotations

import argparse
import asyncio
import re
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

import httpx2
import numpy as np


async def ask_all(
    address: str, content: bytes, *, requests: int, clients: int
) -> tuple[Counter[int], list[float]]:
    """Send requests from so many clients; return statuses and seconds."""
    left = iter(range(requests))
    statuses: Counter[int] = Counter()
    seconds: list[float] = []

    async def ask(client: httpx2.AsyncClient) -> None:
        for _ in left:
            began = time.perf_counter()
            response = await client.post("/classify", files={"image": ("a.png", content)})
            seconds.append(time.perf_counter() - began)
            statuses[response.status_code] += 1

    async with httpx2.AsyncClient(
        base_url=address, timeout=120, limits=httpx2.Limits(max_connections=clients)
    ) as client:
        await asyncio.gather(*(ask(client) for _ in range(clients)))
    return statuses, seconds


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


def batch_rate(model: Path, picture: Path, *, count: int) -> float:
    """Pictures a second of ``seewhy classify``, without the time in which it begins."""
    program = [sys.executable, "-m", "seewhy.cli.main", "classify", str(model)]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        spent = []
        for some in (1, count):
            pictures = folder / str(some)
            pictures.mkdir()
            for number in range(some):
                (pictures / f"{number}{picture.suffix}").write_bytes(picture.read_bytes())
            began = time.perf_counter()
            subprocess.run(
                [*program, str(pictures), "--out", str(folder / f"{some}.csv")],
                check=True,
                capture_output=True,
            )
            spent.append(time.perf_counter() - began)
    return (count - 1) / (spent[1] - spent[0])


def main() -> None:
    """Print what came of it."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("model", type=Path)
    parser.add_argument("picture", type=Path)
    parser.add_argument("--requests", type=int, default=3000)
    parser.add_argument("--clients", type=int, default=50)
    parser.add_argument("--workers", type=int, default=1)
    options = parser.parse_args()
    content = options.picture.read_bytes()
    rate = batch_rate(options.model, options.picture, count=min(options.requests, 2000))
    server = subprocess.Popen(
        [sys.executable, "-m", "seewhy.cli.main", "serve", str(options.model), "--port", "0",
         "--workers", str(options.workers)],
        stderr=subprocess.PIPE,
        text=True,
    )  # fmt: skip
    try:
        assert server.stderr is not None
        address = next(
            found[1]
            for found in (re.search(r"at (http://\S+)", line) for line in server.stderr)
            if found
        )
        asyncio.run(
            ask_all(address, content, requests=options.clients * 4, clients=options.clients)
        )
        before = resident(server.pid)
        began = time.perf_counter()
        statuses, seconds = asyncio.run(
            ask_all(address, content, requests=options.requests, clients=options.clients)
        )
        spent = time.perf_counter() - began
        after = resident(server.pid)
    finally:
        server.send_signal(signal.SIGINT)
        server.wait(30)
    served = options.requests / spent
    p50, p99 = (1000 * float(np.percentile(seconds, share)) for share in (50, 99))
    print(f"{options.requests} requests of {options.clients} clients in {spent:.1f} s")
    print(f"statuses: {dict(statuses)}")
    print(f"p50 {p50:.0f} ms, p99 {p99:.0f} ms")
    print(f"memory: {before} MB before, {after} MB after")
    print(f"served: {served:.1f} a second; seewhy classify: {rate:.1f}; {served / rate:.0%} of it")


if __name__ == "__main__":
    main()
