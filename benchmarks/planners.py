"""Find shortest plans in random buildings: SeeWhy beside the optimal engines of unified-planning.

A building has corridors, some of them in a ring, with offices on both sides; people are in known
rooms; a robot moves between neighbouring rooms and delivers messages to people, by the same laws as
in the bundled domain `robot_assistant`. SeeWhy gets the knowledge as written; its seconds are those
of `plan`, everything included. The engines get the problem that `to_pddl` makes of it, which has no
variables left; their seconds are those of `solve` alone. What the export and reading the PDDL take
stands in a column of its own: the second ratio adds it, as the way from the knowledge to a plan by
that engine. All run one after the other on the same machine; an engine that was too slow for a
building gets no larger one. It is an error if two of them find plans of different lengths.

    pip install -e '.[benchmarks]'
    python benchmarks/planners.py
"""

from __future__ import annotations

import argparse
import contextlib
import io
import logging
import math
import random
import time
from collections.abc import Iterator

from seewhy.knowledge.history import read_history
from seewhy.knowledge.language import Knowledge, read_knowledge
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.diagnosis.diagnosis import diagnose
from seewhy.planning.goal import Goal, read_goal
from seewhy.planning.planner.pddl import to_pddl
from seewhy.planning.planner.planner import plan

ENGINES = ("fast-downward-opt", "symk-opt", "pyperplan-opt")
SIZES = (
    (10, 1, 4),
    (10, 3, 4),
    (20, 2, 8),
    (20, 5, 8),
    (50, 1, 15),
    (50, 5, 15),
    (50, 10, 15),
    (100, 2, 25),
    (100, 10, 25),
    (200, 1, 50),
    (200, 5, 50),
    (200, 10, 50),
    (200, 20, 50),
)
"""Rooms, messages and people."""
LAWS = """
#sort robot = {rob1}.
#sort agent = robot + person.
#sort status = {undelivered, delivered}.
#static next_to(place, place).
#static connected(place, place).
#fluent basic loc(agent, place).
#fluent basic has(robot, message).
#fluent basic message_status(message, person, status).
#action move(robot, place).
#action deliver(robot, message, person).
connected(A, B) if next_to(A, B).
connected(B, A) if next_to(A, B).
move(R, L) causes loc(R, L).
deliver(R, M, P) causes message_status(M, P, delivered).
-loc(T, L2) if loc(T, L1), L1 != L2.
-message_status(M, P, S2) if message_status(M, P, S1), S1 != S2.
impossible deliver(R, M, P) if loc(R, L1), loc(P, L2), L1 != L2.
impossible deliver(R, M, P) if not has(R, M).
impossible move(R, L) if loc(R, L).
impossible move(R, L) if loc(R, L1), L1 != L, not connected(L1, L).
default message_status(M, P, undelivered).
default has(R, M).
"""


def building(rooms: int, messages: int, people: int, seed: int) -> tuple[Knowledge, State, Goal]:
    """Return the knowledge of a random building, what holds at first, and who gets what."""
    chance = random.Random(f"{rooms} {messages} {people} {seed}")
    corridors = max(1, rooms // 5)
    doors = [(chance.randrange(room), room) for room in range(1, corridors)]
    doors += [
        (one, other)
        for one, other in (chance.sample(range(corridors), 2) for _ in range(corridors // 4))
        if corridors > 2 and (one, other) not in doors and (other, one) not in doors
    ]
    doors += [(chance.randrange(corridors), room) for room in range(corridors, rooms)]
    where = [chance.randrange(rooms) for _ in range(people)]
    lines = [
        f"#sort place = {{{', '.join(f'r{room}' for room in range(rooms))}}}.",
        f"#sort person = {{{', '.join(f'p{person}' for person in range(people))}}}.",
        f"#sort message = {{{', '.join(f'm{message}' for message in range(messages))}}}.",
        LAWS,
        *(f"next_to(r{one}, r{other})." for one, other in doors),
    ]
    knowledge = read_knowledge("\n".join(lines), file="building")
    literals = [
        f"loc({who}, r{place})"
        for who, place in [("rob1", chance.randrange(rooms)), *_numbered(where)]
    ]
    seen = " ".join(f"observed {literal} at 0." for literal in literals)
    start = diagnose(knowledge, read_history(seen, knowledge.signature)).now
    wanted = [
        f"message_status(m{message}, p{chance.randrange(people)}, delivered)"
        for message in range(messages)
    ]
    return knowledge, start, read_goal(", ".join(wanted), knowledge)


def _numbered(where: list[int]) -> Iterator[tuple[str, int]]:
    for number, place in enumerate(where):
        yield f"p{number}", place


def by_engine(name: str, problem: object, limit: float) -> tuple[int | None, float]:
    """Return the length of a shortest plan and the seconds taken; no length where it gave up."""
    from unified_planning.shortcuts import OneshotPlanner

    with OneshotPlanner(name=name) as engine, contextlib.redirect_stdout(io.StringIO()):
        begun = time.perf_counter()  # looking the engine up and loading it solves nothing
        # pyperplan knows no limit.
        limits = {} if name.startswith("pyperplan") else {"timeout": limit}
        found = engine.solve(problem, **limits).plan
        spent = time.perf_counter() - begun
    return (None if found is None else len(found.actions)), spent


def _said(number: float) -> str:
    return "—" if math.isnan(number) else f"{number:.3f}"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--seconds", type=float, default=60.0, help="limit for each problem")
    parser.add_argument("--seeds", type=int, default=1, help="buildings of every size")
    parser.add_argument("--rooms", type=int, default=200, help="leave out larger buildings")
    parser.add_argument("--alone", action="store_true", help="run no other planner")
    options = parser.parse_args()
    names = [] if options.alone else list(ENGINES)
    if names:
        from unified_planning.io import PDDLReader
        from unified_planning.shortcuts import get_environment

        reader = PDDLReader()
        get_environment().credits_stream = None
        logging.disable(logging.CRITICAL)
    heads = ["rooms", "messages", "people", "plan length", "SeeWhy, s", "PDDL, s"]
    heads += [*(f"{name}, s" for name in names), "ratio to the best", "ratio with PDDL"]
    print(f"| {' | '.join(heads)} |")
    print(f"|{' ---: |' * len(heads)}")
    tired: set[str] = set()
    for rooms, messages, people in SIZES:
        for seed in range(options.seeds if rooms <= options.rooms else 0):
            knowledge, start, goal = building(rooms, messages, people, seed)
            ours = plan(knowledge, goal, start=start, horizon=1000, seconds=options.seconds)
            lengths = {len(ours.actions)} if ours.found else set()
            seconds: dict[str, float] = {}
            begun = time.perf_counter()
            text = to_pddl(knowledge, goal, start=start)
            problem = reader.parse_problem_string(text.domain, text.problem) if names else None
            exporting = time.perf_counter() - begun
            for name in names:
                if name in tired:
                    continue
                length, spent = by_engine(name, problem, options.seconds)
                if length is not None:
                    lengths.add(length)
                    seconds[name] = spent
                if spent > options.seconds / 2:
                    tired.add(name)
            if len(lengths) > 1:
                raise SystemExit(f"the planners differ in the length of shortest plans: {lengths}")
            best = min(seconds.values(), default=math.nan)
            cells = [
                *map(str, (rooms, messages, people, *(lengths or {"?"}))),
                _said(ours.seconds if ours.found else math.nan),
                _said(exporting),
                *(_said(seconds.get(name, math.nan)) for name in names),
                _said(ours.seconds / best if ours.found else math.nan),
                _said(ours.seconds / (best + exporting) if ours.found else math.nan),
            ]
            print(f"| {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
