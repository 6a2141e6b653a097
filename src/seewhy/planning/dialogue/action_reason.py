"""Why an action was done, or another was not: what needed it, and what stood in the way."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum

import clingo

from seewhy.knowledge.axiom import AxiomKind
from seewhy.knowledge.dynamics import constraints, of_kind
from seewhy.knowledge.ground import fluent_of, key_of
from seewhy.knowledge.signature import PredicateKind
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.diagnosis.persistence_doubt import PersistenceDoubt
from seewhy.planning.dialogue.instances import Applied, Instances
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.execution.execution import Decision, Run, Step
from seewhy.planning.execution.plan_monitoring import reaches_goal, state_after
from seewhy.planning.planner.planner import Plan, plan


@dataclass(frozen=True)
class Failing:
    """Where a sequence of actions fails.

    ``action`` is the first that cannot be done, or None where all can but the goal is not
    reached; ``place`` is its place in the sequence, ``obstacles`` are the executability
    conditions that forbid it. ``state`` is what the actions before it lead to.
    """

    place: int
    action: clingo.Symbol | None
    state: State
    obstacles: tuple[Applied, ...] = ()


@dataclass(frozen=True)
class Removed:
    """What stood in the way of a later action until an action was done.

    Attributes
    ----------
    action : clingo.Symbol
        The later action.
    obstacle : Applied
        The executability condition that forbade it before.
    changed : tuple of clingo.Symbol
        The literals about basic fluents on which it rested, as they were.
    """

    action: clingo.Symbol
    obstacle: Applied
    changed: tuple[clingo.Symbol, ...]


class Against(StrEnum):
    """What speaks against an action."""

    DONE = "it was done"
    OBSTACLE = "it was impossible"
    LONGER = "the plan would have been longer"
    AS_GOOD = "the plan would have been as long"
    NO_PLAN = "the goal could not be reached then"


@dataclass(frozen=True)
class WhyNot:
    """What speaks against an action, with the obstacles or the plan that begins with it."""

    against: Against
    obstacles: tuple[Applied, ...] = ()
    actions: tuple[clingo.Symbol, ...] = ()


class Intentions:
    """What a run's robot meant by its actions.

    Examples
    --------
    >>> from seewhy.planning.execution.execution import execute
    >>> from seewhy.planning.goal import read_goal
    >>> from seewhy.planning.domain import load_planning_domain
    >>> domain = load_planning_domain("robot_assistant")
    >>> goal = read_goal("loc(rob1, kitchen)", domain.knowledge)
    >>> run = next(execute(domain, goal, sensed=[], act=lambda action: []))
    >>> elsewhere = clingo.parse_term("move(rob1,sallys_office)")
    >>> why_not = Intentions(domain, run).why_not(elsewhere, run.steps[0])
    >>> why_not.against.value, why_not.obstacles[0].axiom.text
    ('it was impossible', 'the robot moves to places next to its own')
    """

    def __init__(self, domain: PlanningDomain, run: Run) -> None:
        self.domain = domain
        self.run = run
        self.instances = Instances(domain.knowledge)

    def needs(self, step: Step) -> list[Failing]:
        """Return what needed the action of a step, what needed that, and so on to the goal.

        Each is the first action of the plan of that time that fails without the one before it;
        the last one's action is None, for the goal itself.
        """
        actions = list(step.plan)
        state: State | None = self.start(step)
        found: list[Failing] = []
        while actions and state is not None:
            failing = self.failing(actions[1:], state)
            if failing is None:
                break
            found.append(failing)
            if failing.action is None:
                break
            done, actions = actions[: failing.place + 1], actions[failing.place + 1 :]
            state = state_after(self.domain.knowledge, done, start=state)
        return found

    def removed(self, step: Step) -> Removed | None:
        """Return what the action of a step takes out of a later action's way.

        None where it removes nothing, or only what the next action that needs it tells.
        """
        if not step.plan:
            return None
        before = self.start(step)
        after = state_after(self.domain.knowledge, step.plan[:1], start=before)
        if after is None:
            return None
        needs = self.needs(step)
        told = {applied.axiom.identifier for need in needs for applied in need.obstacles}
        for action in step.plan[1:]:
            left = {applied.axiom.identifier for applied in self.obstacles(action, after)}
            for obstacle in self.obstacles(action, before):
                gone = [literal for literal in obstacle.holds if literal not in after.holds]
                if obstacle.axiom.identifier in told | left or not gone:
                    continue
                changed = [
                    basic for literal in gone for basic in self._basic(literal, before, after)
                ]
                return Removed(action, obstacle, tuple(dict.fromkeys(changed)))
        return None

    def _basic(
        self, literal: clingo.Symbol, before: State, after: State
    ) -> Iterator[clingo.Symbol]:
        """The literals about basic fluents that made a literal hold and no longer do."""
        knowledge = self.domain.knowledge
        if knowledge.signature.kind(literal.name) is not PredicateKind.FLUENT_DEFINED:
            yield literal
            return
        for axiom in constraints(knowledge):
            for found in self.instances.of(axiom, before.holds, head=literal):
                for condition in found.holds:
                    if condition not in after.holds and condition != literal:
                        yield from self._basic(condition, before, after)

    def failing(self, actions: Sequence[clingo.Symbol], start: State) -> Failing | None:
        """Return where actions fail from a state; None where they reach the goal."""
        knowledge = self.domain.knowledge
        before = start
        for place, action in enumerate(actions):
            after = state_after(knowledge, actions[: place + 1], start=start)
            if after is None:
                return Failing(place, action, before, self.obstacles(action, before))
            before = after
        if reaches_goal(knowledge, self.run.goal, actions, start=start):
            return None
        return Failing(len(actions), None, before)

    def obstacles(self, action: clingo.Symbol, state: State) -> tuple[Applied, ...]:
        """Return the executability conditions that forbid an action in a state."""
        knowledge = self.domain.knowledge
        return tuple(
            instance
            for axiom in of_kind(knowledge, AxiomKind.EXECUTABILITY_CONDITION)
            for instance in self.instances.of(axiom, state.holds, action=action)
        )

    def why_not(self, action: clingo.Symbol, step: Step) -> WhyNot:
        """Return what speaks against doing an action at a step."""
        if action == step.action:
            return WhyNot(Against.DONE)
        start = self.start(step)
        after = state_after(self.domain.knowledge, [action], start=start)
        if after is None:
            return WhyNot(Against.OBSTACLE, obstacles=self.obstacles(action, start))
        rest = self._plan(after)
        if not rest.found:
            return WhyNot(Against.NO_PLAN)
        actions = (action, *rest.actions)
        longer = len(actions) > len(step.plan)
        return WhyNot(Against.LONGER if longer else Against.AS_GOOD, actions=actions)

    def start(self, step: Step) -> State:
        """Return what a step's plan starts from: what was believed, without what was doubted."""
        made = [
            earlier
            for earlier in self.run.steps
            if earlier.number <= step.number
            and earlier.decision in (Decision.PLAN, Decision.REPLAN)
        ]
        if not made or not made[-1].doubted:
            return step.believed
        seen = {}
        for literal in step.sensed:
            symbol = clingo.parse_term(key_of(literal))
            seen[fluent_of(symbol)] = step.number
        doubt = PersistenceDoubt(self.domain.knowledge)
        return doubt.applied(step.believed, seen, before=step.number)

    def _plan(self, start: State) -> Plan:
        domain = self.domain
        return plan(
            domain.knowledge,
            self.run.goal,
            start=start,
            horizon=domain.horizon,
            answer_sets=domain.answer_sets,
        )
