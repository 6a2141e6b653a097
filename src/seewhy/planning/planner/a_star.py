"""Search forwards for a shortest plan, states with the least bound first (A*)."""

from __future__ import annotations

import heapq
import itertools
import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from seewhy.planning.planner.ground_problem import GroundProblem, Literals, Operator
from seewhy.planning.planner.held_karp import FAR
from seewhy.planning.planner.landmarks import LandmarkHeuristic


@dataclass(frozen=True)
class SearchResult:
    """How a search ended.

    Attributes
    ----------
    operators : tuple of Operator or None
        A shortest plan, if one was found.
    states : the fluents that hold before, between and after
    bound : int
        No plan is shorter.
    exhausted : bool
        Whether everything that can be reached was looked at.
    open : the fluents of which it does not matter, in each state, whether they hold
    """

    operators: tuple[Operator, ...] | None
    states: tuple[frozenset[int], ...]
    bound: int
    exhausted: bool
    open: tuple[frozenset[int], ...] = ()


class Move:
    """An operator over states as bits."""

    __slots__ = ("adds", "false", "number", "removes", "true", "whens")

    def __init__(self, number: int, operator: Operator) -> None:
        self.number = number
        self.true, self.false = bits(operator.condition)
        self.adds, self.removes = bits(head for body, head in operator.effects if not body)
        self.whens = [(*bits(body), *bits([head])) for body, head in operator.effects if body]

    def after(self, state: int) -> int:
        adds, removes = self.adds, self.removes
        for true, false, add, remove in self.whens:
            if state & true == true and not state & false:
                adds |= add
                removes |= remove
        return state & ~removes | adds


class DerivedFluents:
    """The defined fluents of states, worked out from the others."""

    def __init__(self, problem: GroundProblem) -> None:
        self.strata = [
            [(*bits(body), 1 << head - 1) for head, body in stratum]
            for stratum in problem.derivations
        ]
        self.derived = 0
        for stratum in self.strata:
            for _, _, head in stratum:
                self.derived |= head

    def __call__(self, state: int) -> int:
        """Return the state with its defined fluents worked out anew."""
        if not self.strata:
            return state
        state &= ~self.derived
        for stratum in self.strata:
            before = -1
            while before != state:
                before = state
                for true, false, head in stratum:
                    if state & true == true and not state & false:
                        state |= head
        return state


def a_star(
    problem: GroundProblem,
    *,
    horizon: int,
    expansions: int,
    until: float | None = None,
) -> SearchResult:
    """Return a shortest plan with at most ``horizon`` actions, if there is one.

    Gives up after so many states, or when the clock of :func:`time.perf_counter` shows
    ``until``; ``bound`` says how long a plan must be.
    """
    return _Search(problem).run(horizon, expansions, until)


class _Search:
    def __init__(self, problem: GroundProblem) -> None:
        self.problem = problem
        self.bounds = [LandmarkHeuristic(problem, goal) for goal in problem.goals]
        self.goals = [bits(goal) for goal in problem.goals]
        moves = [Move(number, operator) for number, operator in enumerate(problem.operators)]
        self.with_derived = DerivedFluents(problem)
        # Most operators ask for one value of the same group: only those of it are looked at.
        groups = [bits(group)[0] for group in problem.groups]
        self.group = max(
            groups, key=lambda group: sum(bool(move.true & group) for move in moves), default=0
        )
        self.moves: dict[int, list[Move]] = {}
        for move in moves:
            self.moves.setdefault(move.true & self.group, []).append(move)

    def run(self, horizon: int, expansions: int, until: float | None) -> SearchResult:
        begin = self.with_derived(bits(self.problem.start)[0])
        least = self._bound(begin)
        best = {begin: 0}
        came: dict[int, tuple[int, int]] = {}
        counter = itertools.count()
        # Among equals the state nearest to the goal, then the one found last.
        waiting = [(least, least, 0, begin)]
        if least >= FAR:
            return SearchResult(None, (), FAR, exhausted=True)
        left = expansions
        while waiting:
            total, ahead, _, state = heapq.heappop(waiting)
            done = best[state]
            if total - ahead > done:
                continue
            if total > horizon:
                return SearchResult(None, (), total, exhausted=False)
            if any(state & true == true and not state & false for true, false in self.goals):
                return self._result(state, came)
            if not left or (until is not None and time.perf_counter() >= until):
                return SearchResult(None, (), total, exhausted=False)
            left -= 1
            for move in self._possible(state):
                after = self.with_derived(move.after(state))
                if done + 1 < best.get(after, FAR):
                    best[after] = done + 1
                    came[after] = (state, move.number)
                    ahead = self._bound(after)
                    if ahead < FAR:
                        heapq.heappush(waiting, (done + 1 + ahead, ahead, -next(counter), after))
        return SearchResult(None, (), FAR, exhausted=True)

    def _possible(self, state: int) -> Iterator[Move]:
        value = state & self.group
        for moves in (self.moves.get(value, ()), self.moves.get(0, ()) if value else ()):
            for move in moves:
                if state & move.true == move.true and not state & move.false:
                    yield move

    def _bound(self, state: int) -> int:
        return min((bound(state) for bound in self.bounds), default=FAR)

    def _result(self, state: int, came: dict[int, tuple[int, int]]) -> SearchResult:
        states, operators = [state], []
        while state in came:
            state, number = came[state]
            states.append(state)
            operators.append(self.problem.operators[number])
        return SearchResult(
            operators=tuple(reversed(operators)),
            states=tuple(map(self._fluents, reversed(states))),
            bound=len(operators),
            exhausted=False,
        )

    def _fluents(self, state: int) -> frozenset[int]:
        return frozenset(n for n in range(1, len(self.problem.fluents) + 1) if state >> n - 1 & 1)


def bits(literals: Iterable[int] | Literals) -> tuple[int, int]:
    """The literals as two sets of bits: what is true, and what is false."""
    true = false = 0
    for literal in literals:
        if literal > 0:
            true |= 1 << literal - 1
        else:
            false |= 1 << -literal - 1
    return true, false
