"""Kill a studio that is being labelled in, again and again, and count what is lost.

    python -m seewhy_lab studio_kills --kills 40

A studio of its own, on a project made for it, is sent labels by HTTP, one after the other. After a
random time its process is killed (`kill -9`). Every label that was answered has to be in the record
and in scenes.csv when it opens again; of the one that was not answered nobody knows.
"""

from __future__ import annotations

import argparse
import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import httpx2
from PIL import Image

from seewhy.data.dataset import Dataset
from seewhy.new_domain.from_names import NamedDomain, domain_from_names
from seewhy.studio.labels import LABEL
from seewhy.studio.project import Project

PICTURES = 12
VALUES = ("red", "green", "blue")
LONGEST = 3.0
"""Seconds of labelling before a kill."""


@dataclass(frozen=True)
class Killed:
    """What one kill did.

    Attributes
    ----------
    answered : int
        Labels that the studio said to be kept.
    lost, more : int
        Of these, those that are gone; and those kept that were not answered any more.
    table_agrees : bool
        Whether scenes.csv says what the record says, once the studio is open again.
    """

    answered: int
    lost: int
    more: int
    table_agrees: bool


def project_folder(folder: Path) -> Path:
    """Write a project with a few pictures and a domain."""
    folder.mkdir()
    for number in range(PICTURES):
        shade = (20 * number, 100, 200)
        Image.new("RGB", (64, 64), shade).save(folder / f"{number:02}.png")
    named = NamedDomain(("good", "spoilt"), {"colour": VALUES})
    domain_from_names(named, folder / "kills", data=str(folder))
    return folder


def labelled_until_killed(folder: Path, *, seed: int) -> list[tuple[str, str]]:
    """Open a studio, label until it is killed; return the labels that were answered."""
    generator = random.Random(seed)
    process = subprocess.Popen(
        [sys.executable, "-m", "seewhy", "studio", str(folder), "--no-browser", "--port", "0"],
        stderr=subprocess.PIPE,
        text=True,
    )
    assert process.stderr is not None
    found = re.search(r"http://\S+", process.stderr.readline())
    if found is None:
        process.kill()
        raise SystemExit("the studio did not begin")
    answered: list[tuple[str, str]] = []
    killed = threading.Event()
    with httpx2.Client(base_url=found[0], timeout=60) as client:
        page = client.get("/begin").text
        token = re.findall(r'name="csrf" value="([0-9a-f]+)"', page)[0]

        def kill() -> None:
            killed.set()
            os.kill(process.pid, signal.SIGKILL)

        threading.Timer(generator.uniform(0.05, LONGEST), kill).start()
        try:
            while not killed.is_set():
                picture = f"{generator.randrange(PICTURES):02}.png"
                value = generator.choice(VALUES)
                said = {"csrf": token, "picture": picture, "choice": f"colour={value}"}
                headers = {"HX-Request": "true"}
                if client.post("/label/set", data=said, headers=headers).status_code == 200:
                    answered.append((picture, value))
        except httpx2.HTTPError:
            pass
    process.wait()
    process.stderr.close()
    return answered


def counted(folder: Path, before: int, answered: Sequence[tuple[str, str]]) -> Killed:
    """Open the project again and compare."""
    project = Project(folder)
    entries = project.record.holding(LABEL)[before:]
    kept = [
        (picture, values["colour"])
        for entry in entries
        for picture, values in entry.body["values"].items()
    ]
    same = next(
        (n for n, (one, other) in enumerate(zip(kept, answered, strict=False)) if one != other),
        min(len(kept), len(answered)),
    )
    labels = project.labels()
    table: dict[str, str | None] = {}
    if labels.of:
        dataset = Dataset.load(folder, project.domain())
        table = {
            dataset.name_of(scene): dataset.domain.named(scene.vector)["colour"]
            for scene in dataset.scenes
        }
    said = {picture: values["colour"].value for picture, values in labels.of.items() if values}
    project.record.close()
    return Killed(len(answered), len(answered) - same, len(kept) - same, table == said)


def main() -> None:
    """Print what was lost."""
    parser = argparse.ArgumentParser("python -m seewhy_lab studio_kills", description=__doc__)
    parser.add_argument("--kills", type=int, default=40)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    began = time.monotonic()
    with tempfile.TemporaryDirectory() as temporary:
        folder = project_folder(Path(temporary) / "kills")
        found: list[Killed] = []
        before = 0
        for kill in range(options.kills):
            answered = labelled_until_killed(folder, seed=options.seed + kill)
            found.append(counted(folder, before, answered))
            before += found[-1].answered - found[-1].lost + found[-1].more
    print(f"kills                              {len(found)}")
    print(f"labels answered                    {sum(kill.answered for kill in found)}")
    print(f"answered and lost                  {sum(kill.lost for kill in found)}")
    print(f"kept and not answered any more     {sum(kill.more for kill in found)}")
    print(f"at most of one kill                {max(kill.more for kill in found)}")
    print(f"tables that say what the record    {sum(kill.table_agrees for kill in found)}")
    print(f"seconds                            {time.monotonic() - began:.0f}")


if __name__ == "__main__":
    main()
