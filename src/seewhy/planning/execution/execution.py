"""Execute: sense, diagnose, plan, act and monitor, with an intention that is kept or given up."""

from __future__ import annotations

import math
import time
from bisect import bisect_left
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum
from functools import cache
from typing import Any

import clingo

from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.ground import complement_of, fluent_of, literal_of
from seewhy.knowledge.history import History
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.diagnosis.diagnosis import Surprise, diagnose
from seewhy.planning.diagnosis.persistence_doubt import PersistenceDoubt
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.execution.plan_monitoring import reaches_goal, suppositions
from seewhy.planning.execution.sensing import condition_to_sense
from seewhy.planning.goal import Goal, read_goal
from seewhy.planning.planner.goal_test import goal_holds
from seewhy.planning.planner.planner import Plan, PlanStatus, plan
from seewhy.text.notebook import html_line, html_table

Act = Callable[[clingo.Symbol], list[Literal]]
"""Does an action in the world and returns what is sensed after it."""


class Decision(StrEnum):
    """What the robot does about its intention at a step."""

    PLAN = "plan"
    PERSIST = "persist"
    SKIP = "skip"
    REPLAN = "replan"
    STOP = "stop"
    GIVE_UP = "give up"


class Outcome(StrEnum):
    """How a run ended."""

    ACHIEVED = "achieved"
    IMPOSSIBLE = "impossible"
    OUT_OF_STEPS = "out of steps"


@dataclass(frozen=True)
class Step:
    """One step of a run: what was sensed, believed, decided and done.

    Attributes
    ----------
    number : int
    sensed : tuple of Literal
    believed : State
    surprises : tuple of Surprise
        Those that came up at this step: what was sensed did not fit what was believed.
    decision : Decision
    plan : tuple of clingo.Symbol
        What is intended from here on.
    skipped : tuple of clingo.Symbol
        The actions that became needless.
    doubted : bool
        Whether a new plan supposes that things changed since they were seen.
    supposed : tuple of clingo.Symbol
        What a new plan supposes: what is not known, or may have changed since it was seen.
    action : clingo.Symbol or None
        What was done; None at the end.
    because : tuple of clingo.Symbol
        Where the robot gave up: what it sees that stands in the way, each alone.
    planning_seconds : float
        Time of the processor in which plans to do were looked for, in
        :func:`seewhy.planning.planner.planner.plan` alone: diagnosis, monitoring, doubting, and
        what a plan supposes or what stands in its way are not in it.
    """

    number: int
    sensed: tuple[Literal, ...]
    believed: State
    surprises: tuple[Surprise, ...]
    decision: Decision
    plan: tuple[clingo.Symbol, ...]
    skipped: tuple[clingo.Symbol, ...] = ()
    doubted: bool = False
    supposed: tuple[clingo.Symbol, ...] = ()
    action: clingo.Symbol | None = None
    because: tuple[clingo.Symbol, ...] = ()
    planning_seconds: float = 0.0


@dataclass
class Run:
    """A run of the robot: its goal, its history and its steps, as far as they have come.

    ``outcome`` is None while it goes on (and where it was interrupted); ``sensors_err`` says that
    what was sensed may be wrong.
    """

    goal: Goal
    history: History
    steps: list[Step] = field(default_factory=list)
    outcome: Outcome | None = None
    sensors_err: bool = False

    def _repr_html_(self) -> str:
        """What a notebook shows: the goal, how the run ended, and what was decided at each step."""
        ended = "goes on" if self.outcome is None else self.outcome.value
        return html_line(f"goal: {self.goal}; {ended}") + html_table(
            ["step", "decision", "action", "surprises"],
            (
                (
                    str(step.number),
                    step.decision.value,
                    "" if step.action is None else str(step.action),
                    str(len(step.surprises)),
                )
                for step in self.steps
            ),
        )

    @property
    def actions(self) -> list[clingo.Symbol]:
        """What was done, in order."""
        return [step.action for step in self.steps if step.action is not None]

    @property
    def plans(self) -> list[Step]:
        """The steps at which a plan was made."""
        return [step for step in self.steps if step.decision in (Decision.PLAN, Decision.REPLAN)]


def execute(
    domain: PlanningDomain,
    goal: Goal,
    *,
    sensed: list[Literal],
    act: Act,
    most_steps: int = 100,
) -> Iterator[Run]:
    """Pursue a goal; yields the run after every step, the same object each time.

    The robot has an intention (the theory of intentions that the paper's architecture builds
    on): it stops when it believes the goal, skips actions that became needless, persists where
    nothing contradicts its plan, plans anew where something does, and gives up where no plan is
    left, even if what it saw before may have changed since.

    Parameters
    ----------
    domain : PlanningDomain
    goal : Goal
    sensed : list of Literal
        What is seen at first.
    act : callable
        Does an action and returns what is seen after it.
    most_steps : int
        The most actions to do.
    """
    history = domain.history.with_observations(sensed, step=domain.history.last_step)
    run = Run(goal, history, sensors_err=domain.sensors_err)
    robot = _Robot(domain, goal)
    known: tuple[Surprise, ...] = ()
    while run.outcome is None:
        diagnosis = diagnose(domain.knowledge, run.history, sensors_err=domain.sensors_err)
        new = tuple(surprise for surprise in diagnosis.surprises if surprise not in known)
        known = diagnosis.surprises
        step = robot.decide(run.history, diagnosis.now, sensed, new)
        if step.action is not None and len(run.actions) == most_steps:
            step = replace(step, action=None)
            run.outcome = Outcome.OUT_OF_STEPS
        elif step.action is None:
            achieved = step.decision is Decision.STOP
            run.outcome = Outcome.ACHIEVED if achieved else Outcome.IMPOSSIBLE
        run.steps.append(step)
        if step.action is not None:
            sensed = act(step.action)
            run.history = run.history.with_occurrence(
                literal_of(str(step.action)), step=step.number, attempted=True
            ).with_observations(sensed, step=step.number + 1)
        yield run


class _Robot:
    """The intention of a robot: a goal, and the actions that it means to do."""

    def __init__(self, domain: PlanningDomain, goal: Goal) -> None:
        self.domain = domain
        self.goal = goal
        self.intended: tuple[clingo.Symbol, ...] = ()
        self.began = False
        self.doubted_before: int | None = None
        self.doubt = PersistenceDoubt(domain.knowledge)
        self.planned_for = 0.0

    def decide(
        self,
        history: History,
        now: State,
        sensed: list[Literal],
        new: tuple[Surprise, ...],
    ) -> Step:
        """Return what to do in this state; the intention is what remains after it."""
        step = Step(history.last_step, tuple(sensed), now, new, **self._choice(history, now))
        self.intended, self.began = step.plan[1:], True
        return step

    def _choice(self, history: History, now: State) -> dict[str, Any]:
        knowledge, goal = self.domain.knowledge, self.goal
        if goal_holds(knowledge, goal, now.holds):
            return {"decision": Decision.STOP, "plan": (), "skipped": self.intended}
        last_seen = _last_seen(history)
        start = now
        if self.doubted_before is not None:
            start = self.doubt.applied(now, last_seen, before=self.doubted_before)
        # The shortest rest that will do: what stands before it became needless.
        for skipped in reversed(range(len(self.intended))):
            rest = self.intended[skipped:]
            if reaches_goal(knowledge, goal, rest, start=start):
                return {
                    "decision": Decision.SKIP if skipped else Decision.PERSIST,
                    "plan": rest,
                    "skipped": self.intended[:skipped],
                    "action": rest[0],
                }
        self.planned_for = 0.0
        self.doubted_before, start = None, now
        found = self._plan(start)
        if not found.found:
            least = self._least_doubt(now, last_seen)
            if least is not None:
                self.doubted_before, start, found = least
        supposed: tuple[clingo.Symbol, ...] = ()
        if found.settles(start):
            supposed = suppositions(knowledge, goal, found.actions, start=start)
        if found.status is PlanStatus.ALREADY_TRUE:
            found = self._look(start, supposed)
        seconds = self.planned_for
        if not found.actions:
            return {
                "decision": Decision.GIVE_UP,
                "plan": (),
                "because": self._in_the_way(now, last_seen),
                "planning_seconds": seconds,
            }
        return {
            "decision": Decision.REPLAN if self.began else Decision.PLAN,
            "plan": found.actions,
            "action": found.actions[0],
            "doubted": self.doubted_before is not None,
            "supposed": supposed,
            "planning_seconds": seconds,
        }

    def _look(self, start: State, supposed: Sequence[clingo.Symbol]) -> Plan:
        """A shortest plan to see whether something supposed is so: the goal may hold already."""
        shortest = Plan(PlanStatus.UNREACHABLE)
        for literal in supposed:
            for sensing in self.domain.sensing:
                where = condition_to_sense(sensing, literal)
                if where is None:
                    continue
                aim = read_goal(where, self.domain.knowledge)
                found = self._plan(start, aim)
                if found.actions and len(found.actions) < (len(shortest.actions) or math.inf):
                    shortest = found
        return shortest

    def _least_doubt(
        self, now: State, last_seen: Mapping[clingo.Symbol, int]
    ) -> tuple[int, State, Plan] | None:
        """The step before which things are doubted, if that leaves a plan; the least doubt.

        What was seen longest ago is doubted first. Doubting more leaves all plans that doubting
        less does: where none is left by doubting everything, none is left at all.
        """

        @cache
        def doubting(before: int) -> tuple[State, Plan]:
            start = self.doubt.applied(now, last_seen, before=before)
            return start, self._plan(start)

        def leaves_a_plan(before: int) -> bool:
            return doubting(before)[1].found

        steps = {step for fluent, step in last_seen.items() if fluent in self.doubt.fluents}
        ages = sorted({0, *steps})
        if not leaves_a_plan(ages[-1]):
            return None
        least = ages[bisect_left(ages, True, key=leaves_a_plan)]
        return (least, *doubting(least))

    def _in_the_way(
        self, now: State, last_seen: Mapping[clingo.Symbol, int]
    ) -> tuple[clingo.Symbol, ...]:
        """What is seen now that, were it otherwise, would leave a plan; the unusual first."""
        latest = max(last_seen.values(), default=0)
        before = {fluent: step for fluent, step in last_seen.items() if step < latest}
        if not self._plan(self.doubt.applied(now, before, before=latest)).found:
            return ()  # not even if all of it were otherwise
        found = []
        for fluent in sorted(fluent for fluent, step in last_seen.items() if step == latest):
            less = {other: step for other, step in last_seen.items() if other != fluent}
            start = self.doubt.applied(now, less, before=latest)
            if fluent in start.unknown and self._plan(start).actions:
                found.append(fluent if fluent in now.holds else complement_of(fluent))
        usual = diagnose(self.domain.knowledge, self.domain.history).states[0].holds
        unusual = [literal for literal in found if complement_of(literal) in usual]
        return tuple(unusual or found)

    def _plan(self, start: State, goal: Goal | None = None) -> Plan:
        # Of the processor: what else a machine does is no planning.
        begun = time.process_time()
        found = plan(
            self.domain.knowledge,
            self.goal if goal is None else goal,
            start=start,
            horizon=self.domain.horizon,
            answer_sets=self.domain.answer_sets,
        )
        self.planned_for += time.process_time() - begun
        return found


def _last_seen(history: History) -> dict[clingo.Symbol, int]:
    """For every fluent that was observed, the last step at which it was."""
    return {
        fluent_of(symbol): observation.step
        for observation in sorted(history.observations, key=lambda observation: observation.step)
        for symbol in (clingo.parse_term(str(observation.literal)),)
    }
