"""What was done and found in a walk, kept on disk, so that an interrupted walk goes on."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

from seewhy_lab.walk.person import Effort, Step

__all__ = ["read_steps", "table", "write_steps"]


def read_steps(file: Path) -> list[Step]:
    """Return the steps that were done; none where there is no file."""
    if not file.is_file():
        return []
    read = json.loads(file.read_text(encoding="utf-8"))
    return [Step(step["what"], Effort(**step["effort"]), step["machine"]) for step in read]


def write_steps(file: Path, steps: Sequence[Step]) -> None:
    """Keep the steps."""
    text = json.dumps([asdict(step) for step in steps], indent=1)
    file.write_text(text + "\n", encoding="utf-8")


def table(steps: Sequence[Step]) -> list[str]:
    """The steps as a table in Markdown, with a person's time as an estimate."""
    lines = [
        "| step | clicks | keys | characters typed | a person, min | the machine, min |",
        "|---|---|---|---|---|---|",
    ]
    for step in steps:
        did = step.effort
        labels = ""
        if did.confirmed or did.changed:
            labels = f": {did.confirmed} confirmed, {did.changed} changed"
        lines.append(
            f"| {step.what}{labels} | {did.clicks} | {did.keys} | {did.characters} "
            f"| {did.seconds / 60:.1f} | {step.machine / 60:.1f} |"
        )
    total = sum(step.effort.seconds for step in steps) / 60
    machine = sum(step.machine for step in steps) / 60
    clicks = sum(step.effort.clicks for step in steps)
    keys = sum(step.effort.keys for step in steps)
    typed = sum(step.effort.characters for step in steps)
    lines.append(f"| all | {clicks} | {keys} | {typed} | {total:.1f} | {machine:.1f} |")
    return lines
