"""The process of a robot's run: a line of JSON a step, and what is left at the end.

``python -m seewhy.studio.robot_process ASKED FOLDER`` writes to FOLDER ``run.html``, the run as one
file, and ``run.al``, what was seen and done; that after every step, so that a run that was
interrupted can be asked about, too. ASKED is the object in JSON that the page Robot asks for. What
goes on from a history is planned, and not simulated: what truly was before, nobody knows.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from pathlib import Path

import clingo

from seewhy.errors import SeeWhyError
from seewhy.files.whole_files import write_whole
from seewhy.knowledge.ground import key_of
from seewhy.knowledge.history import history_text
from seewhy.planning.diagnosis.diagnosis import diagnose
from seewhy.planning.execution.recording import record_of
from seewhy.planning.execution.run_narration import narrate_end
from seewhy.planning.execution.simulation import Simulation, ground_fluents, simulate
from seewhy.planning.planner.planner import Plan
from seewhy.planning.planner.planner import plan as find_plan
from seewhy.planning.spoken_goals import goal_of
from seewhy.planning.words import in_sequence
from seewhy.report.run_page import StepsShown, run_page
from seewhy.studio.robot_beginnings import Beginning

__all__ = ["PAGE_FILE", "RECORD_FILE", "plan_on", "run_robot"]

PAGE_FILE, RECORD_FILE = "run.html", "run.al"


def run_robot(
    beginning: Beginning,
    goal: str,
    *,
    seed: int,
    most_steps: int,
    folder: Path,
    at_first: Sequence[str],
) -> None:
    """Let the robot pursue the goal; print its steps."""
    domain = beginning.load()
    aim = goal_of(goal, domain)
    start = ground_fluents(at_first, domain.knowledge)
    shown = StepsShown(domain)
    supposed = "".join(f' --at-first "{literal}"' for literal in at_first)
    scene, _, number = beginning.scene.partition("#")
    things = (f" --scene {scene}" if scene else "") + (f" --image {number}" if number else "")
    command = f'seewhy simulate {beginning.domain} --goal "{goal}" --seed {seed}{things}{supposed}'
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


def plan_on(beginning: Beginning, goal: str, *, folder: Path) -> None:
    """Plan on from what was seen and done so far; print it as one step."""
    domain = beginning.load()
    aim, past = goal_of(goal, domain), beginning.past(domain)
    known = diagnose(domain.knowledge, past, sensors_err=domain.sensors_err)
    found = find_plan(
        domain.knowledge,
        aim,
        start=known.now,
        horizon=domain.horizon,
        answer_sets=domain.answer_sets,
    )
    words = domain.words
    said = [f"It must be that {words.surprise(surprise)}." for surprise in known.surprises]
    done = [words.do(clingo.parse_term(key_of(each.action))) for each in past.occurrences]
    said += [f"What was done so far: {in_sequence(done)}."] if done else []
    step = {
        "number": past.last_step,
        "decision": "plan" if found.actions else "stop" if found.found else "give up",
        "said": said or ["Nothing was done so far."],
        "plan": list(map(words.do, found.actions)),
        "unseen": [],
        "wrong": [],
        "map": "",
        "picture": None,
    }
    title = f'seewhy plan {beginning.domain} --goal "{goal}" --history {beginning.history}'
    write_whole(folder / RECORD_FILE, history_text(past, title=title), durable=False)
    _print(step)
    _print({"ended": _told(found), "achieved": False})


def _told(found: Plan) -> str:
    """What came of planning, in a sentence."""
    if found.actions:
        count = len(found.actions)
        return f"The shortest plan has {count} action{'s' * (count != 1)}."
    if found.found:
        return "The goal holds already; nothing is to be done."
    return f"No plan of at most {found.horizon} actions leads to the goal."


def _print(value: object) -> None:
    sys.stdout.write(json.dumps(value, ensure_ascii=False) + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    _asked, _folder = json.loads(sys.argv[1]), Path(sys.argv[2])
    _beginning = Beginning.of(_asked)
    try:
        if _beginning.history:
            plan_on(_beginning, _asked["goal"], folder=_folder)
        else:
            run_robot(
                _beginning,
                _asked["goal"],
                seed=_asked["seed"],
                most_steps=_asked["steps"],
                folder=_folder,
                at_first=_asked["at_first"],
            )
    except SeeWhyError as problem:
        sys.stderr.write(f"seewhy: {problem}\n")
        sys.exit(2)
    except KeyboardInterrupt:
        sys.exit(130)
