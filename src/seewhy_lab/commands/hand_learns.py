"""Print what a hand learns on random tables that was never told of balls, and what that is worth.

    python -m seewhy_lab hand_learns --runs 40 --count 100 --seed 0

The hand knows `tabletop` without what is said of balls. First it builds towers on random tables in
the simulator, with real physics, and learns from the record of these runs. Then it
pursues goals that can truly be reached, on other tables: once without and once with what it
learned, and once with all that `tabletop` says.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from seewhy.domain.domain import load_domain
from seewhy.errors import SeeWhyError
from seewhy.files.whole_files import write_whole
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.history import History, history_text
from seewhy.planning.domain import PlanningDomain, load_planning_domain
from seewhy.planning.execution.execution import Run
from seewhy.planning.execution.recording import record_of
from seewhy.planning.learning.learning_from_runs import LearnedFromRuns, learn_from_runs
from seewhy.planning.spoken_goals import goal_of
from seewhy_lab.commands.tables_planned import DOMAIN, possible_goal
from seewhy_lab.simulators.tabletop.hand import Hand
from seewhy_lab.simulators.tabletop.planned import carried_out, reached, scene_of_table, seen_by
from seewhy_lab.simulators.tabletop.source import random_scene
from seewhy_lab.simulators.tabletop.table import Table

__all__ = ["OF_BALLS", "Pursuit", "main", "pursued", "recorded_runs", "untold"]

OF_BALLS = (
    "falls(X) if on(X, Y), shape(Y, sphere)",
    "stable(X) if on(X, Y), stable(Y), -shape(Y, sphere)",
    "impossible put_on(R, X, Y) if shape(Y, sphere)",
)
"""What `tabletop` says of balls."""
_TRIED = "make a tower"
"""How the goals begin of the runs that the hand learns from: it has to put things on others."""
_MOST_GOALS = 40
_MOST_STEPS = 20

Knows = Callable[[PlanningDomain], PlanningDomain]
"""What a hand knows of a domain."""


@dataclass(frozen=True)
class Pursuit:
    """What came of a goal on a table: whether it truly is reached, the run, and its seconds."""

    reached: bool
    run: Run
    seconds: float


def untold(domain: PlanningDomain, learned: Sequence[Axiom] = ()) -> PlanningDomain:
    """Return what a hand knows that was never told of balls, with what it learned."""
    for statement in OF_BALLS:
        domain = domain.without(statement)
    return domain.knowing(learned)


def _tables(seed: int) -> Iterator[tuple[PlanningDomain, Table, np.random.Generator]]:
    """Random tables, each with what there is to know of it, without end."""
    things = load_domain(DOMAIN).things
    assert things is not None
    index = 0
    while True:
        table, view, _ = random_scene(seed=seed, index=index)
        scene = scene_of_table(table, things, view.azimuth)
        yield (
            load_planning_domain(DOMAIN, scene=scene),
            table,
            np.random.default_rng([seed, index, 1]),
        )
        index += 1


def pursued(
    domain: PlanningDomain, knows: Knows, goal: str, table: Table, *, seed: int, most_steps: int
) -> Pursuit:
    """Let a hand pursue a goal in words, by what it knows; the domain says what is so."""
    hand = Hand(table, np.random.default_rng(seed))
    assert domain.at_first is not None
    bodies = {domain.at_first.term(number): number for number in range(len(table.things))}
    begun = time.process_time()
    robot = knows(domain)
    run = carried_out(robot, goal_of(goal, robot), hand, bodies=bodies, most_steps=most_steps)
    seconds = time.process_time() - begun
    return Pursuit(reached(domain, goal_of(goal, domain), seen_by(hand, bodies)), run, seconds)


def recorded_runs(runs: int, *, seed: int, most_steps: int = _MOST_STEPS) -> Iterator[History]:
    """Yield records of a hand that was never told of balls, with goals that it holds possible."""
    found = 0
    for domain, table, rng in _tables(seed):
        if found == runs:
            return
        wanted = possible_goal(untold(domain), rng, most=_MOST_GOALS, only=_TRIED)
        if wanted is None:
            continue
        _, goal, _ = wanted
        try:
            done = pursued(
                domain, untold, goal, table, seed=int(rng.integers(2**31)), most_steps=most_steps
            )
        except SeeWhyError:
            continue  # what is seen could not be, by what the hand knows: nothing is recorded
        found += 1
        yield record_of(untold(domain), done.run)


def _compared(
    learned: Sequence[Axiom], count: int, *, seed: int, most_steps: int
) -> tuple[list[str], dict[str, list[Pursuit]]]:
    """The kinds of goals, and what came of them for hands that know less or more."""
    hands: dict[str, Knows] = {
        "without what is said of balls": untold,
        "with what it learned": partial(untold, learned=learned),
        "told of balls": lambda domain: domain,
    }
    found: dict[str, list[Pursuit]] = {name: [] for name in hands}
    kinds: list[str] = []
    for domain, table, rng in _tables(seed):
        if len(kinds) == count:
            break
        wanted = possible_goal(domain, rng, most=_MOST_GOALS)
        if wanted is None:
            continue
        kind, goal, _ = wanted
        chance = int(rng.integers(2**31))
        for name, knows in hands.items():
            done = pursued(domain, knows, goal, table, seed=chance, most_steps=most_steps)
            found[name].append(done)
            if not done.reached:
                print(f"table {len(kinds)}, {name}: {goal}: not reached", flush=True)
        kinds.append(kind)
    return kinds, found


def _print_learned(found: LearnedFromRuns) -> None:
    print(f"{found.runs} runs, {found.held_back} of them held back; {found.attempts} attempts")
    for axiom in found.axioms:
        origin, judged = axiom.origin, found.judged[str(axiom)]
        print(axiom.text)
        print(
            f"  {axiom}  ({round(origin.precision * origin.support)} of {origin.support} attempts; "
            f"{judged.right} of {judged.right + judged.wrong} in the runs held back)"
        )
    for rejected in found.rejected:
        print(f"not added: {rejected.axiom} {rejected.reason}")


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser("python -m seewhy_lab hand_learns", description=__doc__)
    parser.add_argument("--runs", type=int, default=40, help="Runs to learn from.")
    parser.add_argument("--count", type=int, default=100, help="Tables of the comparison.")
    parser.add_argument("--seed", type=int, default=0, help="Settles every random choice.")
    parser.add_argument("--steps", type=int, default=_MOST_STEPS, help="Actions of a run, at most.")
    parser.add_argument("--record", type=Path, help="Folder for the records of the runs (.al).")
    return parser.parse_args()


def main() -> None:
    """Print what was learned, and the comparison."""
    options = _options()
    begun = time.process_time()
    record = list(recorded_runs(options.runs, seed=options.seed, most_steps=options.steps))
    ran = time.process_time() - begun
    for number, history in enumerate(record, start=1):
        if options.record is not None:
            title = f"run {number} of python -m seewhy_lab hand_learns --seed {options.seed}"
            write_whole(options.record / f"{number:03}.al", history_text(history, title=title))
    begun = time.process_time()
    found = learn_from_runs(untold(load_planning_domain(DOMAIN)), record, seed=options.seed)
    learning = time.process_time() - begun
    _print_learned(found)
    print(f"seconds: {ran:.0f} for the runs, {learning:.0f} for learning", flush=True)
    kinds, compared = _compared(
        found.axioms, options.count, seed=options.seed + 1, most_steps=options.steps
    )
    _print_compared(kinds, compared)


def _print_compared(kinds: Sequence[str], compared: Mapping[str, Sequence[Pursuit]]) -> None:
    print("hand", "reached", "actions", "plans", "something fell", "seconds", sep=" | ")
    for name, pursuits in compared.items():
        print(
            name,
            f"{sum(pursuit.reached for pursuit in pursuits)} of {len(pursuits)}",
            sum(len(pursuit.run.actions) for pursuit in pursuits),
            sum(len(pursuit.run.plans) for pursuit in pursuits),
            sum(any(step.surprises for step in pursuit.run.steps) for pursuit in pursuits),
            f"{sum(pursuit.seconds for pursuit in pursuits):.0f}",
            sep=" | ",
        )
    print("goal", "tables", *(f"reached, actions {name}" for name in compared), sep=" | ")
    for kind in sorted(set(kinds)):
        places = [place for place, other in enumerate(kinds) if other == kind]
        some = [[pursuits[place] for place in places] for pursuits in compared.values()]
        told = (
            f"{sum(pursuit.reached for pursuit in of_hand)}, "
            f"{sum(len(pursuit.run.actions) for pursuit in of_hand)}"
            for of_hand in some
        )
        print(kind, len(places), *told, sep=" | ")


if __name__ == "__main__":
    main()
