"""The ways to do an action, with the state constraints compiled into their effects.

Whoever moves to the kitchen is no longer in the library. What cannot be said that way is refused,
with the axiom's name.
"""

from __future__ import annotations

import itertools
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass

import clingo

from seewhy.knowledge.axiom import Axiom
from seewhy.planning.planner.ground_problem import Literals, Operator, is_consistent
from seewhy.planning.planner.unsayable import unsayable

__all__ = ["ActionOperators"]

_ROUNDS = 20


@dataclass(frozen=True)
class ActionOperators:
    """Makes operators of actions.

    Attributes
    ----------
    group : each fluent of which others exclude one another, with all of these
    exact : the groups of which exactly one holds
    constraints : axioms with what they conclude of basic fluents, and from what
    """

    group: Mapping[int, frozenset[int]]
    exact: Collection[frozenset[int]]
    constraints: Sequence[tuple[Axiom, int, Literals]]

    def of_action(
        self,
        action: clingo.Symbol,
        *,
        choices: Sequence[Sequence[int]],
        required: Literals,
        forbidden: Sequence[Literals],
        laws: Sequence[tuple[Literals, int]],
    ) -> Iterator[Operator]:
        """Yield the operators of an action.

        Parameters
        ----------
        action : clingo.Symbol
        choices : for each group of which the action allows some values, these
        required : what must hold for the action
        forbidden : what must not hold together
        laws : what it brings about, each under a condition

        Raises
        ------
        PlanningError
            If a constraint leaves open what happens.
        """
        for values in itertools.product(*choices):
            waiting = list(self._split(required | frozenset(values), forbidden))
            while waiting:
                condition = waiting.pop()
                effects = self._effects(condition, laws)
                conflicts = self._conflicts(effects)
                if conflicts:
                    waiting += self._split(condition, conflicts)
                    continue
                known = self._known(condition)
                changes = {
                    (body, head)
                    for head, bodies in effects.items()
                    for body in bodies
                    if not self._holds_already(head, body | known)
                }
                if changes:
                    yield Operator(action, condition, tuple(sorted(changes, key=_order)))

    def _holds_already(self, head: int, before: Literals) -> bool:
        return head in before or any(
            head == conclusion and body <= before for _, conclusion, body in self.constraints
        )

    def _known(self, condition: Collection[int]) -> set[int]:
        """The condition with what follows from it: where one value holds, the others do not."""
        known = set(condition)
        for literal in condition:
            if literal > 0 and literal in self.group:
                known |= {-other for other in self.group[literal] if other != literal}
        return known

    def _split(self, condition: Literals, forbidden: Sequence[Literals]) -> Iterator[Literals]:
        """Yield conditions that together allow what ``condition`` does, less what is forbidden."""
        known = self._known(condition)
        if not is_consistent(known):
            return
        left = []
        for clause in forbidden:
            if not any(-literal in known for literal in clause):
                left.append(clause - known)
        if not left:
            yield condition
            return
        clause = min(left, key=len)
        rest = [other for other in left if other is not clause]
        if not clause:
            return
        first = min(
            clause, key=lambda literal: (self.group.get(literal) not in self.exact, literal)
        )
        group = self.group.get(first)
        if group in self.exact and first > 0 and group is not None:
            for value in sorted(group):
                yield from self._split(condition | {value}, left)
        else:
            yield from self._split(condition | {-first}, rest)
            if len(clause) > 1:
                yield from self._split(condition | {first}, left)

    def _effects(
        self, condition: Literals, laws: Sequence[tuple[Literals, int]]
    ) -> dict[int, set[Literals]]:
        """What holds afterwards, each with the conditions under which it does."""
        known = self._known(condition)
        direct: dict[int, set[Literals]] = {}
        for body, head in laws:
            if not any(-literal in known for literal in body):
                _add(direct, head, body - known)
        self._exclude(direct, known)
        effects = direct
        for _ in range(_ROUNDS if self.constraints else 0):
            following = {head: set(bodies) for head, bodies in direct.items()}
            for axiom, head, body in self.constraints:
                if -head in effects or any(literal in effects for literal in body):
                    for before in self._before(axiom, body, effects, known):
                        _add(following, head, before)
            self._exclude(following, known)
            if following == effects:
                return effects
            effects = following
        if self.constraints:
            raise unsayable(self.constraints[0][0], "leaves open what happens")
        return effects

    def _exclude(self, effects: dict[int, set[Literals]], known: set[int]) -> None:
        """Of fluents of which one holds, that which becomes true makes the others false."""
        for head in [literal for literal in effects if literal > 0 and literal in self.group]:
            others = self.group[head] - {head}
            for other in others:
                if -other not in known or other in effects:
                    for body in effects[head]:
                        _add(effects, -other, body)

    def _before(
        self,
        axiom: Axiom,
        body: Literals,
        effects: Mapping[int, set[Literals]],
        known: set[int],
    ) -> Iterator[Literals]:
        """The conditions before an operator under which ``body`` holds after it."""
        ways: list[list[Literals]] = []
        for literal in sorted(body):
            stays: list[Literals] = []
            removing = effects.get(-literal, set())
            if any(len(other) > 1 for other in removing):
                raise unsayable(axiom, "follows from what changes under several conditions")
            if frozenset() not in removing:
                stays = [frozenset({literal, *(-next(iter(other)) for other in removing)})]
            ways.append([*effects.get(literal, ()), *stays])
        for together in itertools.product(*ways):
            before = frozenset[int]().union(*together)
            if is_consistent(before) and not any(-literal in known for literal in before):
                yield before - known

    def _conflicts(self, effects: Mapping[int, set[Literals]]) -> list[Literals]:
        """Conditions under which an action would make something both true and false."""
        return [
            one | other
            for head in effects
            if head > 0 and -head in effects
            for one, other in itertools.product(effects[head], effects[-head])
            if is_consistent(one | other)
        ]


def _add(effects: dict[int, set[Literals]], head: int, body: Literals) -> None:
    """Add a condition for an effect; of conditions, the weaker ones are kept."""
    bodies = effects.setdefault(head, set())
    if not any(other <= body for other in bodies):
        bodies -= {other for other in bodies if body < other}
        bodies.add(body)


def _order(effect: tuple[Literals, int]) -> tuple[bool, int, list[int]]:
    return effect[1] < 0, abs(effect[1]), sorted(effect[0])
