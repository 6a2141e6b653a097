"""A robot in the simulated world: the run, and beside each step what was true."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import clingo
import numpy as np

from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.ground import key_of
from seewhy.knowledge.ground_literal import read_ground_literal
from seewhy.knowledge.language import Knowledge
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.execution.environment import Happening, PlanningEnvironment
from seewhy.planning.execution.execution import Run, execute
from seewhy.planning.execution.transition_function import World
from seewhy.planning.goal import Goal
from seewhy.planning.planner.goal_test import goal_holds

if TYPE_CHECKING:
    from seewhy.planning.execution.sight import Look, Sight


@dataclass
class Simulation:
    """A run with the truth of every step.

    Attributes
    ----------
    run : Run
    worlds : list of World
        The true state at each step of the run.
    happenings : list of Happening
        What really happened after each step that did something.
    looks : list of Look
        The picture taken at each step; empty where no networks see.
    achieved : bool
        Whether the goal truly holds at the end.
    """

    run: Run
    worlds: list[World] = field(default_factory=list)
    happenings: list[Happening] = field(default_factory=list)
    looks: list[Look] = field(default_factory=list)
    achieved: bool = False


def execution_seconds(domain: PlanningDomain, run: Run) -> float:
    """Return how long the actions of a run take, as ``[simulation.durations]`` says.

    An action that fails takes as long as one that does not.

    Examples
    --------
    >>> from seewhy.planning.goal import read_goal
    >>> from seewhy.planning.domain import load_planning_domain
    >>> office = load_planning_domain("robot_assistant")
    >>> goal = read_goal("loc(rob1, bathroom)", office.knowledge)
    >>> *_, last = simulate(office, goal, seed=1)
    >>> len(last.run.actions), execution_seconds(office, last.run)
    (2, 30.0)
    """
    durations = domain.simulation.durations
    return float(sum(durations.get(action.name, 1.0) for action in run.actions))


def ground_fluents(texts: Iterable[str], knowledge: Knowledge) -> list[clingo.Symbol]:
    """Read literals about fluents, such as ``-closed(library)``, that hold at first.

    Raises
    ------
    KnowledgeError
        If one is no such literal, or names something that there is not; the nearest is offered.
    """
    read = (read_ground_literal(text, knowledge.signature, of="fluent") for text in texts)
    return [clingo.parse_term(key_of(literal)) for literal in read]


def simulate(
    domain: PlanningDomain,
    goal: Goal,
    *,
    seed: int = 0,
    most_steps: int = 60,
    world: PlanningDomain | None = None,
    sight: Sight | None = None,
    at_first: Sequence[clingo.Symbol] = (),
) -> Iterator[Simulation]:
    """Let the robot pursue a goal in a random world; yields the simulation after each step.

    The world follows the knowledge of ``world``; the robot's own, where that is not given. So a
    robot may know less than is so, or have learned it. With ``sight``, it takes a picture at
    every step, and sees what the networks read. Literals about fluents in ``at_first`` hold in the
    world at first, whatever else is random. The world's own course is the same with the same
    seed, as long as the robot does the same.

    Examples
    --------
    >>> from seewhy.planning.goal import read_goal
    >>> from seewhy.planning.domain import load_planning_domain
    >>> office = load_planning_domain("robot_assistant")
    >>> goal = read_goal("loc(rob1, kitchen)", office.knowledge)
    >>> *_, last = simulate(office, goal, seed=1)
    >>> last.run.outcome.value, [str(action) for action in last.run.actions]
    ('achieved', ['move(rob1,kitchen)'])
    >>> closed = [clingo.parse_term("closed(kitchen)")]
    >>> first, *_ = simulate(office, goal, seed=1, at_first=closed)
    >>> closed[0] in first.worlds[0]
    True
    """
    truth = domain if world is None else world
    environment = PlanningEnvironment(truth, goal=goal, steps=most_steps + 1, sight=sight)
    observation, _ = environment.reset(seed=seed, options={"holds": at_first})
    worlds, happenings = [environment.state], list[Happening]()
    looks = [environment.look] if environment.look is not None else []

    def act(action: clingo.Symbol) -> list[Literal]:
        seen, _, _, _, info = environment.step(environment.number(action))
        worlds.append(environment.state)
        happenings.append(info["happening"])
        if environment.look is not None:
            looks.append(environment.look)
        return environment.read(np.asarray(seen))

    sensed = environment.read(observation)
    runs = execute(
        domain if sight is None else replace(domain, seen_by_networks=True),
        goal,
        sensed=sensed,
        act=act,
        most_steps=most_steps,
    )
    for run in runs:
        steps = len(run.steps)
        achieved = goal_holds(truth.knowledge, goal, worlds[steps - 1])
        # The run goes on in place; what is given away stays as it is now.
        now = replace(run, steps=list(run.steps))
        yield Simulation(now, worlds[:steps], happenings[:steps], looks[:steps], achieved)
