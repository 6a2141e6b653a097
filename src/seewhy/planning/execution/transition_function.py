"""The transition function of the simulated world: from a complete state to the next.

The same axioms that the robot reasons with say what happens; the world knows everything.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable

import clingo

from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.dynamics import transition_rules
from seewhy.knowledge.ground import complement_of
from seewhy.knowledge.grounding_size import grounding_size
from seewhy.knowledge.language import Knowledge

World = frozenset[clingo.Symbol]
"""A complete state: of every fluent the literal that is true."""

_FREE = """
1 { holds(F, 0); holds(-F, 0) } 1 :- fluent(basic, F).
{ occurs(A, 0) } :- action(A).
{ occurs(A, 0) } :- exogenous(A).
"""


class TransitionFunction:
    """The transition function of a domain's knowledge, grounded once.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge('''
    ... #fluent basic lit. #action press. press causes lit. impossible press if lit.
    ... ''')
    >>> transitions = TransitionFunction(known)
    >>> dark = transitions.complete([])
    >>> press = clingo.Function("press")
    >>> [str(literal) for literal in transitions.after(dark, [press])]
    ['lit']
    >>> transitions.after(transitions.after(dark, [press]), [press]) is None
    True
    """

    def __init__(self, knowledge: Knowledge) -> None:
        text = "\n".join([*transition_rules(knowledge, last=1), _FREE])
        self.control = BoundedControl(text, size=grounding_size(knowledge).times(2))
        atoms = self.control.atoms
        self._holds: tuple[dict[clingo.Symbol, int], ...] = ({}, {})
        for atom in atoms.by_signature("holds", 2):
            if atom.literal and atom.symbol.arguments[1].type is clingo.SymbolType.Number:
                step = atom.symbol.arguments[1].number
                self._holds[step][atom.symbol.arguments[0]] = atom.literal
        self._occurs = {
            atom.symbol.arguments[0]: atom.literal for atom in atoms.by_signature("occurs", 2)
        }
        self._basic = sorted(
            atom.symbol.arguments[1]
            for atom in atoms.by_signature("fluent", 2)
            if atom.symbol.arguments[0].name == "basic"
        )
        self.fluents = sorted(atom.symbol.arguments[1] for atom in atoms.by_signature("fluent", 2))
        self.events = sorted(a.symbol.arguments[0] for a in atoms.by_signature("exogenous", 1))
        self.actions = sorted(a.symbol.arguments[0] for a in atoms.by_signature("action", 1))

    def complete(self, wanted: Iterable[clingo.Symbol]) -> World:
        """Return a complete state in which the literals hold, as few others as possible.

        A literal that contradicts the ones before it is left out.
        """
        holds = self._holds[0]
        numbers = [holds[literal] for literal in wanted if literal in holds]
        assumed = self._consistent([], numbers)
        true = frozenset(assumed)
        false = [
            holds[complement]
            for fluent in self._basic
            if (complement := complement_of(fluent)) in holds and holds.get(fluent) not in true
        ]
        assumed += self._consistent(assumed, false)
        state = self._solve(assumed, step=0, happening=())
        assert state is not None
        return state

    def after(self, state: World, happening: Collection[clingo.Symbol]) -> World | None:
        """Return the state after what happens at once; None where that is impossible."""
        assumed = [self._holds[0][literal] for literal in self._literals(state)]
        return self._solve(assumed, step=1, happening=happening)

    def _literals(self, state: World) -> Iterable[clingo.Symbol]:
        for fluent in self._basic:
            literal = fluent if fluent in state else complement_of(fluent)
            if literal in self._holds[0]:
                yield literal

    def _consistent(self, assumed: list[int], more: list[int]) -> list[int]:
        """What of ``more`` goes with what is assumed and with those before it.

        As if they were tried one by one: of those that go together, none needs to be tried alone.
        """
        if not more or self._satisfiable([*assumed, *more]):
            return more
        if len(more) == 1:
            return []
        half = len(more) // 2
        first = self._consistent(assumed, more[:half])
        return [*first, *self._consistent([*assumed, *first], more[half:])]

    def _satisfiable(self, assumed: list[int]) -> bool:
        idle = [-number for number in self._occurs.values()]
        return self.control.satisfiable([*assumed, *idle])

    def _solve(
        self, assumed: list[int], *, step: int, happening: Collection[clingo.Symbol]
    ) -> World | None:
        if any(action not in self._occurs for action in happening):
            return None
        occurs = [
            number if action in happening else -number for action, number in self._occurs.items()
        ]

        def world(model: clingo.Model) -> World:
            is_true = model.is_true
            return frozenset(
                literal for literal, number in self._holds[step].items() if is_true(number)
            )

        found = self.control.solve([*assumed, *occurs], on_model=world)
        return found[-1] if found else None
