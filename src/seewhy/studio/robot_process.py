"""The process of a robot's run: a line of JSON a step, and what is left at the end.

``python -m seewhy.studio.robot_process DOMAIN GOAL SEED STEPS FOLDER LITERAL…`` writes to FOLDER
``run.html``, the run as one file, and ``run.al``, what was seen and done; that after every step,
so that a run that was interrupted can be asked about, too.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from pathlib import Path

from seewhy.errors import SeeWhyError
from seewhy.files.whole_files import write_whole
from seewhy.knowledge.history import history_text
from seewhy.planning.domain import load_planning_domain
from seewhy.planning.execution.recording import record_of
from seewhy.planning.execution.run_narration import narrate_end
from seewhy.planning.execution.simulation import Simulation, ground_fluents, simulate
from seewhy.planning.spoken_goals import goal_of
from seewhy.report.run_page import StepsShown, run_page

__all__ = ["PAGE_FILE", "RECORD_FILE", "run_robot"]

PAGE_FILE, RECORD_FILE = "run.html", "run.al"


def run_robot(
    name: str, goal: str, *, seed: int, most_steps: int, folder: Path, at_first: Sequence[str]
) -> None:
    """Let the robot pursue the goal; print its steps."""
    domain = load_planning_domain(name)
    aim = goal_of(goal, domain)
    start = ground_fluents(at_first, domain.knowledge)
    shown = StepsShown(domain)
    supposed = "".join(f' --at-first "{literal}"' for literal in at_first)
    command = f'seewhy simulate {name} --goal "{goal}" --seed {seed}{supposed}'
    last: Simulation | None = None
    try:
        runs = simulate(domain, aim, seed=seed, most_steps=most_steps, at_first=start)
        for last in runs:
            _print(shown.step(last, len(last.run.steps) - 1))
            record = history_text(record_of(domain, last.run), title=command)
            write_whole(folder / RECORD_FILE, record, durable=False)
    finally:
        if last is not None:
            write_whole(folder / PAGE_FILE, run_page(domain, last, command=command))
            _print({"ended": narrate_end(last.run), "achieved": last.achieved})


def _print(value: object) -> None:
    sys.stdout.write(json.dumps(value, ensure_ascii=False) + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    _name, _goal, _seed, _steps, _folder, *_literals = sys.argv[1:]
    try:
        run_robot(
            _name,
            _goal,
            seed=int(_seed),
            most_steps=int(_steps),
            folder=Path(_folder),
            at_first=_literals,
        )
    except SeeWhyError as problem:
        sys.stderr.write(f"seewhy: {problem}\n")
        sys.exit(2)
    except KeyboardInterrupt:
        sys.exit(130)
