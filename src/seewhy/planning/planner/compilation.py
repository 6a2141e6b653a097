"""Knowledge about change and a goal, compiled into a problem without variables."""

from __future__ import annotations

from collections.abc import Iterable

import clingo

from seewhy.knowledge.axiom import Axiom, AxiomKind
from seewhy.knowledge.dynamics import gives_way
from seewhy.knowledge.ground import fluent_of
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.signature import PredicateKind
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.goal import REACHED
from seewhy.planning.planner.action_operators import ActionOperators
from seewhy.planning.planner.axiom_conditions import asks_more
from seewhy.planning.planner.axiom_instances import instances
from seewhy.planning.planner.ground_problem import GroundProblem, Literals, is_consistent
from seewhy.planning.planner.pruning import UnprunedProblem, pruned
from seewhy.planning.planner.unsayable import unsayable

__all__ = ["ground_problem"]


def ground_problem(
    knowledge: Knowledge, start: State, *, whole: Knowledge | None = None
) -> GroundProblem:
    """Return what can be done from a state towards the goal that the knowledge has.

    Give it the relevant part of the knowledge (:func:`seewhy.planning.planner.relevance.relevant`).
    With the ``whole`` of it, what matters may be unknown at the start, where nothing but that some
    fluents exclude one another is said about it.

    Raises
    ------
    PlanningError
        If an axiom counts fluents, if what it says leaves open what happens, or if something
        that matters is unknown at the start.
    """
    return pruned(
        _Compilation(knowledge, start).problem(),
        knowledge,
        whole=whole,
        believed={fluent.name for fluent in start.holds},
    )


class _Compilation:
    def __init__(self, knowledge: Knowledge, start: State) -> None:
        self.knowledge = knowledge
        for axiom in knowledge.axioms:
            if axiom.kind is not AxiomKind.DEFAULT and asks_more(axiom, knowledge.signature):
                raise unsayable(axiom, "asks about several fluents at once, in a count or with '_'")
        self.atoms = instances(knowledge, start)
        self.fluents = sorted(self._first("changing"))
        self.number = {fluent: place for place, fluent in enumerate(self.fluents, start=1)}
        self.start = frozenset(
            self.number[fluent] for fluent in start.holds if fluent in self.number
        )
        self.unknown = frozenset(
            self.number[fluent]
            for fluent in start.unknown
            if fluent in self.number
            and knowledge.signature.kind(fluent.name) is PredicateKind.FLUENT_BASIC
        )
        self.group: dict[int, frozenset[int]] = {}
        for members in self._by_first("member").values():
            group = frozenset(self.number[member.arguments[1]] for member in members)
            self.group |= dict.fromkeys(group, group)
        self.exact = {
            self.group[self.number[member.arguments[1]]]
            for member in self.atoms.get("exact_member", ())
        }
        self.axioms = {axiom.identifier: axiom for axiom in knowledge.axioms}
        self.constraints: list[tuple[Axiom, int, Literals]] = []
        self.derived: list[tuple[int, Literals]] = []
        self.goals: list[Literals] = []

    def problem(self) -> UnprunedProblem:
        self._read_conclusions()
        needs, forbidden = self._by_first("need"), self._by_first("forbidden")
        laws, choices = self._by_first("law"), self._by_first("choice")
        can = self._first("can")
        ways = ActionOperators(self.group, self.exact, self.constraints)
        operators = [
            operator
            for action in sorted(laws)
            if action in can
            for operator in ways.of_action(
                action,
                choices=self._choices(choices.get(action, ())),
                required=self._literals(atom.arguments[1] for atom in needs.get(action, ())),
                forbidden=[
                    self._literals(atom.arguments[1].arguments)
                    for atom in forbidden.get(action, ())
                ],
                laws=[
                    (self._literals(law.arguments[2].arguments), self._literal(law.arguments[1]))
                    for law in laws[action]
                    if fluent_of(law.arguments[1]) in self.number
                ],
            )
        ]
        return UnprunedProblem(
            fluents=self.fluents,
            start=self.start,
            unknown=self.unknown,
            group=self.group,
            exact=self.exact,
            operators=operators,
            derived=self.derived,
            goals=self.goals,
        )

    def _first(self, predicate: str) -> set[clingo.Symbol]:
        return {atom.arguments[0] for atom in self.atoms.get(predicate, ())}

    def _by_first(self, predicate: str) -> dict[clingo.Symbol, list[clingo.Symbol]]:
        """The atoms of a predicate by their first argument."""
        found: dict[clingo.Symbol, list[clingo.Symbol]] = {}
        for atom in self.atoms.get(predicate, ()):
            found.setdefault(atom.arguments[0], []).append(atom)
        return found

    def _choices(self, atoms: Iterable[clingo.Symbol]) -> list[list[int]]:
        """For each group of which an action allows some values, these; constant ones allow all."""
        found: dict[clingo.Symbol, list[int]] = {}
        for atom in atoms:
            _, group, value = atom.arguments
            if value in self.number:
                found.setdefault(group, []).append(self.number[value])
        return [sorted(values) for _, values in sorted(found.items())]

    def _literal(self, symbol: clingo.Symbol) -> int:
        number = self.number[fluent_of(symbol)]
        return number if symbol.positive else -number

    def _literals(self, symbols: Iterable[clingo.Symbol]) -> Literals:
        """The conditions that may change; the others hold, or there would be no instance."""
        return frozenset(
            self._literal(symbol) for symbol in symbols if fluent_of(symbol) in self.number
        )

    def _read_conclusions(self) -> None:
        signature = self.knowledge.signature
        for atom in self.atoms.get("conclusion", ()):
            identifier, head, conditions = atom.arguments
            body = self._literals(conditions.arguments)
            if not is_consistent(body):
                continue
            if head.name == REACHED:
                self.goals.append(body)
            elif fluent_of(head) not in self.number:
                continue
            elif signature.kind(head.name) is PredicateKind.FLUENT_DEFINED:
                self.derived.append((self._literal(head), body))
            elif not gives_way(axiom := self.axioms[identifier.name], signature):
                # One that gives way speaks of the start, which says what is known of its fluents.
                self._check_determined(axiom, body)
                if self._literal(head) not in body:
                    self.constraints.append((axiom, self._literal(head), body))

    def _check_determined(self, axiom: Axiom, body: Literals) -> None:
        """Refuse a constraint by which a basic fluent may change without an action."""
        changing = {self.fluents[abs(number) - 1].name for number in body}
        for condition in axiom.body:
            literal = condition.literal
            if literal is None or literal.predicate not in changing:
                continue
            if condition.absent:
                raise unsayable(axiom, f"asks for '{condition}', which leaves open what happens")
            if self.knowledge.signature.kind(literal.predicate) is PredicateKind.FLUENT_DEFINED:
                raise unsayable(axiom, f"concludes a basic fluent from '{literal.predicate}'")
