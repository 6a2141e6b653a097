"""Fuzz all readers for some minutes: `python tests/fuzz/run.py --minutes 60`.

Every finding is written to a file and printed with what happened; the next reader goes on. The
exit code is 1 where there was any. An input that ends the whole process (a decoder's fault) lies
where the program says at its beginning.
"""

from __future__ import annotations

import argparse
import hashlib
import resource
import sys
import tempfile
import time
import traceback
from pathlib import Path

from hypothesis import HealthCheck, Phase, given, seed, settings
from readers import TARGETS, Target, inputs, surroundings

MEMORY = 6 * 2**30
"""Bytes of address space; what asks for more is a finding."""

ROUND = 200
"""Inputs of one reader before the next has its turn."""


def main() -> int:
    """Run, and return the exit code."""
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--minutes", type=float, default=60.0)
    options.add_argument("--seed", type=int, default=0, help="another one, other inputs")
    options.add_argument("--only", choices=[target.name for target in TARGETS], action="append")
    options.add_argument("--found", type=Path, default=Path("fuzz-found"), metavar="DIR")
    given_options = options.parse_args()
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    end = time.monotonic() + 60 * given_options.minutes
    targets = [t for t in TARGETS if not given_options.only or t.name in given_options.only]
    tried, findings, number = 0, 0, given_options.seed
    with tempfile.TemporaryDirectory(prefix="fuzz-") as folder:
        home = surroundings(Path(folder))
        print(f"inputs are read from {home}/sources", flush=True)
        while time.monotonic() < end:
            for target in targets:
                count, found = _round(target, home, number, end, given_options.found)
                tried, findings = tried + count, findings + found
            number += 1
    print(f"{tried:,} inputs of {len(targets)} readers, {findings} findings")
    return 1 if findings else 0


def _round(target: Target, home: Path, number: int, end: float, found: Path) -> tuple[int, bool]:
    """Try some inputs; return how many, and whether one was a finding."""
    tried, last = 0, b""

    @seed(number)
    @settings(
        max_examples=ROUND,
        deadline=None,
        database=None,
        phases=(Phase.generate,),
        suppress_health_check=list(HealthCheck),
    )
    @given(content=inputs(target.corpus()))
    def attempt(content: bytes) -> None:
        nonlocal tried, last
        if time.monotonic() > end:
            return
        tried, last = tried + 1, content
        target.survive(content, home)

    try:
        attempt()
    except Exception:
        found.mkdir(parents=True, exist_ok=True)
        file = found / f"{target.name.replace(' ', '-')}-{hashlib.sha256(last).hexdigest()[:12]}"
        file.write_bytes(last)
        print(f"{target.name}: {file}\n{traceback.format_exc()}", flush=True)
        return tried, True
    return tried, False


if __name__ == "__main__":
    sys.exit(main())
