"""Planning before and after learning where people usually are (the paper's hypothesis H4).

A robot delivers messages in an office. Before, its knowledge lacks the axiom by which people are
usually where they work; after, it has what it learned from the record of runs that it made
without it. Either arm of a trial has the same goal in the same world; the world itself always
follows the whole knowledge. The runs that are learned from have seeds of their own.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.history import History
from seewhy.planning.domain import PlanningDomain, load_planning_domain
from seewhy.planning.execution.environment import PlanningEnvironment
from seewhy.planning.execution.simulation import Simulation, execution_seconds, simulate
from seewhy.planning.goal import Goal, read_goal
from seewhy.planning.learning.learning_from_runs import LearnedFromRuns, learn_from_runs
from seewhy_lab.experiments.conclusions import Compared, finite
from seewhy_lab.experiments.experiment import ALL, Row
from seewhy_lab.experiments.origin import one_machine
from seewhy_lab.experiments.rows import is_timing
from seewhy_lab.experiments.statistics import Interval, compare, holm, interval, ratio_interval

__all__ = [
    "AXIOM",
    "FIRST_RECORDED",
    "MEASURES",
    "NAMES",
    "PAPER",
    "SYSTEMS",
    "Ratio",
    "fault",
    "learned_from",
    "recipients_elsewhere",
    "recorded_run",
    "robot_before",
    "summary",
    "trial",
]

DOMAIN = "robot_assistant"
AXIOM = "loc(P, L) if work_place(P, L), not -loc(P, L)"
"""What the robot is never told: statement (6) of the paper."""
RECORDED = 40
FIRST_RECORDED = 1_000_000
"""The seed of the first recorded run; trials have smaller ones."""
MOST_STEPS = 60

SYSTEMS = ("before", "after")
MEASURES = ("plans", "actions", "execution", "seconds_planning", "seconds_per_plan")
NAMES = dict(
    zip(
        MEASURES,
        (
            "plans in a trial",
            "actions",
            "execution time",
            "planning time of a trial",
            "planning time of a plan",
        ),
        strict=True,
    )
)
PAPER = dict(zip(MEASURES, (4.0, 2.3, 1.6, 6.0, 1.6), strict=True))
"""The ratios before to after that the paper reports."""


def robot_before() -> PlanningDomain:
    """The office as the robot knows it that was never told where people usually are."""
    return load_planning_domain(DOMAIN).without(AXIOM)


def random_goal(domain: PlanningDomain, *, seed: int) -> Goal:
    """Return that one or two messages are delivered to random people, to each person one.

    Examples
    --------
    >>> str(random_goal(load_planning_domain("robot_assistant"), seed=4))
    'message_status(m1, sally, delivered), message_status(m2, bob, delivered)'
    """
    signature = domain.knowledge.signature
    rng = np.random.default_rng(seed)
    messages = signature.members("message")
    people = rng.permutation(signature.members("person"))[: 1 + rng.integers(len(messages))]
    wanted = zip(messages, people, strict=False)
    text = ", ".join(
        f"message_status({message}, {person}, delivered)" for message, person in wanted
    )
    return read_goal(text, domain.knowledge)


def recorded_run(number: int, *, before: int | None = None) -> History:
    """Return the record of one of the earlier runs, made without the axiom.

    ``before`` is how many steps people may walk about before the robot begins; by default as many
    as planning.toml says.
    """
    return _run(robot_before(), seed=FIRST_RECORDED + number, before=before).run.history


def learned_from(record: Sequence[History]) -> LearnedFromRuns:
    """Return what the robot learns from its record."""
    return learn_from_runs(robot_before(), record)


def trial(
    *,
    seed: int,
    learned: Sequence[Axiom],
    before: int | None = None,
    answer_sets: bool = False,
) -> list[Row]:
    """Return a row for the robot before and one for the robot after learning.

    ``before`` is as in :func:`recorded_run`; with ``answer_sets`` both plan as the paper's robot
    does, by answer sets alone.

    The arm that goes first changes with the seed: who goes second finds some things of clingo's
    already in memory.
    """
    robot = replace(robot_before(), answer_sets=answer_sets)
    arms = {"before": robot, "after": robot.knowing(learned)}
    order = list(arms) if seed % 2 == 0 else list(reversed(arms))
    rows = {arm: _row(arm, arms[arm], seed, before) for arm in order}
    return [rows["before"], rows["after"]]


def recipients_elsewhere(seeds: Iterable[int], *, before: int | None = None) -> dict[int, int]:
    """Return for each trial how many recipients are at first not where they work.

    Examples
    --------
    >>> recipients_elsewhere([0, 6])
    {0: 1, 6: 0}
    """
    world = _world(before)
    environment = PlanningEnvironment(world)
    at_work = {tuple(map(str, literal.arguments)) for literal in world.statics("work_place")}
    found = {}
    for seed in seeds:
        environment.reset(seed=seed)
        state = environment.state
        goal = random_goal(world, seed=seed)
        people = {
            condition.literal.arguments[1] for condition in goal.axiom.body if condition.literal
        }
        places = [
            tuple(map(str, literal.arguments))
            for literal in state
            if literal.positive and literal.name == "loc"
        ]
        found[seed] = sum(person in people and (person, at) not in at_work for person, at in places)
    return found


def _world(before: int | None) -> PlanningDomain:
    world = load_planning_domain(DOMAIN)
    if before is None:
        return world
    return replace(world, simulation=world.simulation.model_copy(update={"before": before}))


def _run(robot: PlanningDomain, *, seed: int, before: int | None) -> Simulation:
    world = _world(before)
    goal = random_goal(world, seed=seed)
    *_, last = simulate(robot, goal, seed=seed, most_steps=MOST_STEPS, world=world)
    return last


def _row(arm: str, robot: PlanningDomain, seed: int, before: int | None) -> Row:
    last = _run(robot, seed=seed, before=before)
    run = last.run
    made = [step.planning_seconds for step in run.plans]
    return {
        "seed": seed,
        "size": ALL,
        "system": arm,
        "plans": len(made),
        "actions": len(run.actions),
        "execution": execution_seconds(robot, run),
        "outcome": run.outcome.value if run.outcome else "",
        "achieved": last.achieved,
        "goal": str(run.goal),
        "seconds_planning": sum(step.planning_seconds for step in run.steps),
        # Looking in vain, at a step that gives up, makes no plan take longer.
        "seconds_per_plan": sum(made) / len(made) if made else None,
    }


def fault(row: Row) -> str:
    """Say what is wrong with a row of this experiment; nothing: "".

    Examples
    --------
    >>> row = {"system": "after", "plans": 1, "actions": 2, "execution": 30.0, "achieved": True}
    >>> row |= {"outcome": "achieved", "seconds_planning": 0.2}
    >>> fault({**row, "plans": "many"}), fault(row)
    ('plans is many, not a number', 'seconds_per_plan is missing')
    """
    if row.get("system") not in SYSTEMS:
        return f"{row.get('system')} is no robot; there are {' and '.join(SYSTEMS)}"
    for key in ("plans", "actions", "execution"):
        value: Any = row.get(key)
        if type(value) not in (int, float) or not 0 <= value < math.inf:
            return f"{key} is {'missing' if value is None else value}, not a number"
    for key in filter(is_timing, MEASURES):
        if key not in row:
            return f"{key} is missing"
    if type(row.get("achieved")) is not bool or not row.get("outcome"):
        return "it does not say how the trial ended"
    return ""


@dataclass(frozen=True)
class Ratio:
    """How much more of something there is before learning than after, over paired trials.

    Attributes
    ----------
    measure : str
    trials : int
        Pairs of which the ratio can be formed: after learning there is some of it.
    before, after : float
        Means.
    mean_of_ratios : Interval
        The mean of the trials' ratios, as in the paper.
    ratio_of_means : Interval
    paper : float
    compared : Compared or None
        Tests of what there is more before than after, corrected for the number of measures;
        "better" is what learning saves. None where there is no pair.
    """

    measure: str
    trials: int
    before: float
    after: float
    mean_of_ratios: Interval
    ratio_of_means: Interval
    paper: float
    compared: Compared | None = None

    def to_dict(self) -> dict[str, Any]:
        """Return the ratio as values that JSON can hold."""
        values = {key: value for key, value in asdict(self).items() if key != "compared"}
        return {**finite(values), "compared": self.compared and self.compared.to_dict()}


def summary(rows: Iterable[Row], *, machine: str | None = None) -> list[Ratio]:
    """Return the ratios of all measures, with intervals by bootstrap, and tests over the pairs.

    Pairs count whatever their outcome: who gives up or runs out of steps has made so many plans
    and actions until then. Times are those of one kind of machine: of the one that is given, or
    else of that which made most rows.

    Examples
    --------
    >>> numbers = dict.fromkeys(MEASURES, 1.0)
    >>> rows = [{"seed": seed, "system": system, **numbers}
    ...         for seed in range(3) for system in SYSTEMS]
    >>> rows[0]["plans"] = 4.0
    >>> ratio = summary(rows)[0]
    >>> ratio.measure, ratio.trials, ratio.mean_of_ratios.mean, ratio.ratio_of_means.mean
    ('plans', 3, 2.0, 2.0)
    """
    rows = list(rows)
    if machine is None:
        timed, _ = one_machine(rows)
    else:
        timed = [row for row in rows if row.get("machine", "") == machine]
    pairs = {
        measure: _pairs(measure, timed if is_timing(measure) else rows) for measure in MEASURES
    }
    tested = {
        measure: compare(both[:, 0].tolist(), both[:, 1].tolist())
        for measure, both in pairs.items()
        if len(both)
    }
    t = holm([paired.p_t for paired in tested.values()])
    wilcoxon = holm([paired.p_wilcoxon for paired in tested.values()])
    compared = {
        measure: Compared(ALL, paired, p_t, p_wilcoxon)
        for (measure, paired), p_t, p_wilcoxon in zip(tested.items(), t, wilcoxon, strict=True)
    }
    return [
        replace(_ratio(measure, both), compared=compared.get(measure))
        for measure, both in pairs.items()
    ]


def _pairs(measure: str, rows: Iterable[Row]) -> NDArray[np.float64]:
    """What was measured before and after learning, in the trials that have both."""
    arms: dict[str, dict[int, Row]] = {system: {} for system in SYSTEMS}
    for row in rows:
        arms[row["system"]][row["seed"]] = row
    before, after = arms["before"], arms["after"]
    pairs = [
        (before[seed][measure], after[seed][measure])
        for seed in sorted(before.keys() & after.keys())
        if before[seed][measure] is not None and after[seed][measure]
    ]
    return np.array(pairs, dtype=np.float64).reshape(-1, 2)


def _ratio(measure: str, pairs: NDArray[np.float64]) -> Ratio:
    if not len(pairs):
        nan = float("nan")
        nothing = Interval(nan, nan, nan)
        return Ratio(measure, 0, nan, nan, nothing, nothing, PAPER[measure])
    before, after = map(float, pairs.mean(axis=0))
    return Ratio(
        measure,
        len(pairs),
        before,
        after,
        interval((pairs[:, 0] / pairs[:, 1]).tolist()),
        ratio_interval(pairs[:, 0].tolist(), pairs[:, 1].tolist()),
        PAPER[measure],
    )
