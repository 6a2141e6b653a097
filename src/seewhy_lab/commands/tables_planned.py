"""Print how often a hand reaches random goals on random tables, with real physics.

    python -m seewhy_lab tables_planned --count 100 --seed 0

Every table gets a goal in words. The hand plans from what is annotated of the table, or with
--model from what a model sees in its picture; it acts in the simulator, looks what is on what, and
plans anew where something fell. A goal is reached when it truly is in the end.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from seewhy.dialogue.things.evaluating import Evaluation
from seewhy.dialogue.things.wording import ThingWords
from seewhy.domain.domain import load_domain
from seewhy.errors import SeeWhyError
from seewhy.planning.diagnosis.diagnosis import diagnose
from seewhy.planning.domain import PlanningDomain, load_planning_domain
from seewhy.planning.execution.execution import Run
from seewhy.planning.goal import Goal
from seewhy.planning.planner.planner import plan
from seewhy.planning.spoken_goals import goal_of
from seewhy_lab.simulators.tabletop.hand import PLACED, RELEASED, Hand
from seewhy_lab.simulators.tabletop.planned import carried_out, reached, scene_of_table, seen_by
from seewhy_lab.simulators.tabletop.rendering import render
from seewhy_lab.simulators.tabletop.source import random_scene
from seewhy_lab.simulators.tabletop.table import Table
from seewhy_lab.simulators.tabletop.visibility import seen_things
from seewhy_lab.simulators.thing_rows import boxes

if TYPE_CHECKING:
    from seewhy.agent.things.thing_agent import ThingAgent
    from seewhy.data.thing import BoundingBox
    from seewhy_lab.rendering.rays import Scene
    from seewhy_lab.simulators.tabletop.view import View

__all__ = ["DOMAIN", "Trial", "main", "possible_goal", "random_goals", "trial"]

DOMAIN = "tabletop"
_NUMBERS = ("two", "three", "four")
_OVERLAP = 0.5
"""Share that the boxes of a thing and of what is seen of it have in common, at least."""


@dataclass(frozen=True)
class Trial:
    """What came of a goal on a table.

    Attributes
    ----------
    kind, goal : str
        The goal, without and with the names of things.
    reached : bool
        Whether it truly is in the end.
    run : Run or None
        None where the hand did not come to act; ``problem`` says why.
    problem : str
    """

    kind: str
    goal: str
    reached: bool
    run: Run | None = None
    problem: str = ""


def random_goals(words: ThingWords, rng: np.random.Generator) -> Iterator[tuple[str, str]]:
    """Yield goals about the things of a scene, each with its kind, without end."""
    count = words.evaluation.scene.count
    while True:
        first, second = (words.name(int(rng.integers(count))) for _ in range(2))
        number = str(rng.choice(_NUMBERS))
        kinds = {
            "put … on …": f"put {first} on {second}",
            "put … on the table": f"put {first} on the table",
            "clear …": f"clear {first}",
            "pick up …": f"pick up {first}",
            "put everything on the table": "put everything on the table",
            "make a tower of …": f"make a tower of {number}",
            "make a tower of … with … on top": f"make a tower of {number} with {first} on top",
            "make a tower of … on …": f"make a tower of {number} on {first}",
        }
        kind = str(rng.choice(list(kinds)))
        yield kind, kinds[kind]


def possible_goal(
    domain: PlanningDomain, rng: np.random.Generator, *, most: int, only: str = ""
) -> tuple[str, str, Goal] | None:
    """Return a random goal that is not reached yet, and can be; None where none is found.

    It is one of ``most`` that are tried, and of a kind that begins so: ``only``.
    """
    assert domain.at_first is not None
    words = ThingWords(Evaluation(domain.at_first.scene, domain.at_first.things))
    now = diagnose(domain.knowledge, domain.history).now
    for (kind, said), _ in zip(random_goals(words, rng), range(most), strict=False):
        if not kind.startswith(only):
            continue
        try:
            goal = goal_of(said, domain)
        except SeeWhyError:
            continue  # one thing on itself, for instance
        found = plan(domain.knowledge, goal, start=now, horizon=domain.horizon)
        if found.actions:
            return kind, said, goal
    return None


def trial(
    table: Table,
    view: View,
    scene: Scene,
    *,
    rng: np.random.Generator,
    agent: ThingAgent | None = None,
    placed: float = PLACED,
    released: float = RELEASED,
    size: int = 320,
) -> Trial | None:
    """Let a hand pursue a random goal on a table; None where no goal is to be had there.

    ``size`` is the longer side, in pixels, of the picture that an agent sees.
    """
    things = load_domain(DOMAIN).things
    assert things is not None
    truth = load_planning_domain(DOMAIN, scene=scene_of_table(table, things, view.azimuth))
    wanted = possible_goal(truth, rng, most=40)
    if wanted is None:
        return None
    kind, said, goal = wanted
    hand = Hand(table, rng, placed=placed, released=released)
    assert truth.at_first is not None
    everything = {truth.at_first.term(number): number for number in range(len(table.things))}
    try:
        if agent is None:
            run = carried_out(truth, goal, hand, bodies=everything)
        else:
            believed, bodies = _as_seen(agent, table, view, scene, size=size)
            run = carried_out(believed, goal_of(said, believed), hand, bodies=bodies)
    except SeeWhyError as problem:
        return Trial(kind, said, False, problem=str(problem))
    return Trial(kind, said, reached(truth, goal, seen_by(hand, everything)), run)


def _as_seen(
    agent: ThingAgent, table: Table, view: View, scene: Scene, *, size: int
) -> tuple[PlanningDomain, dict[str, int]]:
    """What a model sees of a table, and which body each thing that it sees is."""
    read = agent.scene_of(agent.read(render(scene, table, view, size=size)))
    domain = load_planning_domain(DOMAIN, scene=read.scene)
    truly = boxes(seen_things(scene, view, size=size), len(table.things))
    assert domain.at_first is not None
    found: dict[str, int] = {}
    for number, thing in enumerate(read.reading.things):
        shares = [_overlap(thing.box, box) for box in truly]
        best = int(np.argmax(shares))
        if shares[best] >= _OVERLAP and best not in found.values():
            found[domain.at_first.term(number)] = best
    return domain, found


def _overlap(box: BoundingBox, other: tuple[int, int, int, int]) -> float:
    """What two boxes have in common, as a share of what they cover together."""
    width = min(box.right, other[2]) - max(box.left, other[0])
    height = min(box.bottom, other[3]) - max(box.top, other[1])
    both = max(0.0, width) * max(0.0, height)
    areas = (box.right - box.left) * (box.bottom - box.top)
    areas += (other[2] - other[0]) * (other[3] - other[1])
    return both / (areas - both)


def _print(trials: list[Trial]) -> None:
    count = Counter(found.kind for found in trials)
    good = Counter(found.kind for found in trials if found.reached)
    print("goal", "tables", "reached", sep=" | ")
    for kind in sorted(count):
        print(kind, count[kind], good[kind], sep=" | ")
    runs = [found.run for found in trials if found.run is not None]
    surprised = sum(any(step.surprises for step in run.steps) for run in runs)
    print(f"reached: {sum(good.values())} of {len(trials)}")
    print(
        f"actions: {sum(len(run.actions) for run in runs)}; plans: "
        f"{sum(len(run.plans) for run in runs)}; runs in which something fell: {surprised}"
    )


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser("python -m seewhy_lab tables_planned", description=__doc__)
    parser.add_argument("--count", type=int, default=100, help="Tables.")
    parser.add_argument("--seed", type=int, default=0, help="Settles every random choice.")
    parser.add_argument("--model", type=Path, help="What sees the tables at first.")
    parser.add_argument("--size", type=int, default=320, help="Of what it sees, in pixels.")
    parser.add_argument("--placed", type=float, default=PLACED, help="Spread of places, in m.")
    parser.add_argument("--released", type=float, default=RELEASED, help="Spread of speed, in m/s.")
    return parser.parse_args()


def main() -> None:
    """Print the table of goals."""
    options = _options()
    agent = None
    if options.model is not None:
        from seewhy.agent.things.thing_agent import ThingAgent

        agent = ThingAgent.load(options.model)
    trials: list[Trial] = []
    index = 0
    while len(trials) < options.count:
        table, view, scene = random_scene(seed=options.seed, index=index)
        found = trial(
            table,
            view,
            scene,
            rng=np.random.default_rng([options.seed, index, 1]),
            agent=agent,
            placed=options.placed,
            released=options.released,
            size=options.size,
        )
        if found is not None:
            trials.append(found)
            if not found.reached:
                why = f"; {found.problem}" if found.problem else ""
                print(f"table {index}: {found.goal}: not reached{why}", flush=True)
        index += 1
    _print(trials)


if __name__ == "__main__":
    main()
