"""How often a robot that sees by networks answers as one that sees everything rightly.

In every trial a person, chosen at random, is looked for in a random world: once by a robot whose
networks read the pictures that it takes, once, in the same world, by one that is told what is
true. Then both are asked where the person is, whether that place is cluttered, and what is in the
place where the robot has come to. An answer is right where its whole text is the same.

    seewhy data make robot_assistant --count 750 --seed 2026 --size 96 --out runs/rooms
    seewhy train robot_assistant --data runs/rooms --out runs/rooms_model
    python -m seewhy_lab answers_about_rooms runs/rooms_model
"""

from __future__ import annotations

import argparse
import json
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
from joblib import Parallel, delayed

from seewhy.agent.agent import Agent
from seewhy.errors import PlanningError, QuestionError
from seewhy.files.whole_files import write_whole
from seewhy.planning.dialogue.run_answers import answer
from seewhy.planning.domain import PlanningDomain, load_planning_domain
from seewhy.planning.execution.sight import Sight
from seewhy.planning.execution.simulation import Simulation, simulate
from seewhy.planning.goal import read_goal

DOMAIN = "robot_assistant"


def questions(domain: PlanningDomain, person: str, last: Simulation) -> dict[str, str]:
    """The three questions of a trial, by kind."""
    name = domain.words.name(person)
    place = next(
        str(literal.arguments[1])
        for literal in last.worlds[-1]
        if literal.positive and literal.name == "loc" and str(literal.arguments[0]) == "rob1"
    )
    return {
        "where": f"where is {name}?",
        "cluttered": f"is {name}'s location cluttered?",
        "contents": f"what is in {domain.words.name(place)}?",
    }


def run(domain: PlanningDomain, goal: str, *, seed: int, sight: Sight | None) -> Simulation:
    """The last state of a simulated run."""
    *_, last = simulate(domain, read_goal(goal, domain.knowledge), seed=seed, sight=sight)
    return last


def replied(domain: PlanningDomain, last: Simulation, question: str) -> str:
    """The answer's text; a question that cannot be answered is an answer of its own."""
    try:
        return answer(domain, last.run, question).text
    except (PlanningError, QuestionError) as problem:
        return f"{type(problem).__name__}: {problem}"


def trial(model: Path, out: Path, seed: int) -> dict[str, Any]:
    """One row: what was asked, both answers, and how many fluents were read rightly."""
    file = out / f"trial-{seed:04d}.json"
    if file.exists():
        row: dict[str, Any] = json.loads(file.read_text())
        return row
    domain = load_planning_domain(DOMAIN)
    person = str(
        np.random.default_rng([seed, 7]).choice(domain.knowledge.signature.members("person"))
    )
    goal = f"loc(rob1, L), loc({person}, L)"
    seeing = run(domain, goal, seed=seed, sight=Sight(domain, Agent.load(model)))
    told = run(domain, goal, seed=seed, sight=None)
    asked = questions(domain, person, told)
    row = {
        "seed": seed,
        "goal": goal,
        "pictures": len(seeing.looks),
        "fluents": sum(len(look.shown) for look in seeing.looks),
        "misread": sum(len(look.misread) for look in seeing.looks),
        "actions": [list(map(str, simulation.run.actions)) for simulation in (seeing, told)],
        "achieved": [simulation.achieved for simulation in (seeing, told)],
        "answers": {
            kind: [text, replied(domain, seeing, text), replied(domain, told, text)]
            for kind, text in asked.items()
        },
    }
    write_whole(file, json.dumps(row, indent=1))
    return row


def report(rows: list[dict[str, Any]]) -> str:
    """The table over all trials."""
    right: Counter[str] = Counter()
    for row in rows:
        for kind, (_, seen, true) in row["answers"].items():
            right[kind] += seen == true
    pictures, fluents = (sum(row[key] for row in rows) for key in ("pictures", "fluents"))
    misread = sum(row["misread"] for row in rows)
    total = sum(right.values()) / (3 * len(rows))
    lines = [f"{len(rows)} trials, {pictures} pictures, {fluents} features of them"]
    lines += [f"| {kind} | {100 * n / len(rows):.1f} % |" for kind, n in right.items()]
    lines += [
        f"| all answers | {100 * total:.1f} % |",
        f"| features read rightly | {100 * (1 - misread / fluents):.2f} % |",
    ]
    return "\n".join(lines)


def main() -> None:
    """Run what is missing and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("model", type=Path)
    parser.add_argument("--out", type=Path, default=Path("runs/rooms_answers"))
    parser.add_argument("--trials", type=int, default=100)
    parser.add_argument("--jobs", type=int, default=-1)
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    rows = Parallel(n_jobs=options.jobs)(
        delayed(trial)(options.model, options.out, seed) for seed in range(options.trials)
    )
    print(report(rows))


if __name__ == "__main__":
    main()
