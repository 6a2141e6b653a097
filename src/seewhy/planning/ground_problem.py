"""A planning problem without variables: operators with conditions and effects, as in STRIPS.

State constraints are compiled into the effects of the operators: whoever moves to the kitchen is
no longer in the library. What cannot be said that way is refused, with the axiom's name.
"""

from __future__ import annotations

import itertools
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import clingo

from seewhy.errors import PlanningError
from seewhy.knowledge.axiom import Axiom, AxiomKind
from seewhy.knowledge.dynamics import constraints
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.signature import PredicateKind
from seewhy.planning.goal import REACHED
from seewhy.planning.reachability import Reachability, asks_more, reachable
from seewhy.planning.state import State

Literals = frozenset[int]
"""Literals that hold together; a fluent is its number, counted from 1, and -3 is 3 denied."""
_ROUNDS = 20


@dataclass(frozen=True)
class Operator:
    """One way to do an action.

    Attributes
    ----------
    action : clingo.Symbol
    condition : literals that must hold before
    effects : pairs of a condition, besides, and the literal that holds afterwards
    """

    action: clingo.Symbol
    condition: Literals
    effects: tuple[tuple[Literals, int], ...]


@dataclass(frozen=True)
class GroundProblem:
    """Everything about a goal that may change, and how.

    Attributes
    ----------
    fluents : those that may change; fluent 1 is the first
    start : the fluents that hold at first
    operators : the ways to do actions
    derivations : the defined fluents with their conditions, those first on which others depend
    goals : one of these sets of literals must hold
    groups : sets of fluents of which exactly one holds
    """

    fluents: tuple[clingo.Symbol, ...]
    start: frozenset[int]
    operators: tuple[Operator, ...]
    derivations: tuple[tuple[tuple[int, Literals], ...], ...]
    goals: tuple[Literals, ...]
    groups: tuple[frozenset[int], ...]


def ground_problem(knowledge: Knowledge, start: State) -> GroundProblem:
    """Return what can be done from a state towards the goal that the knowledge has.

    Raises
    ------
    PlanningError
        If an axiom counts fluents, if what it says leaves open what happens, or if something
        that matters is unknown at the start.
    """
    return _Compilation(knowledge, start).problem()


class _Compilation:
    def __init__(self, knowledge: Knowledge, start: State) -> None:
        self.knowledge = knowledge
        for axiom in knowledge.axioms:
            if axiom.kind is not AxiomKind.DEFAULT and asks_more(axiom, knowledge.signature):
                raise _refusal(axiom, "asks about several fluents at once, in a count or with '_'")
        self.possible: Reachability = reachable(knowledge, start, instances=True)
        rigid = self.possible.rigid
        changing = {_fluent(own) for own in self.possible.may - rigid}
        self.fluents = sorted(changing)
        self.number = {own: place for place, own in enumerate(self.fluents, start=1)}
        self.start = frozenset(self.number[own] for own in start.holds if own in self.number)
        known = {_fluent(own) for own in start.holds}
        basic = knowledge.signature.kind
        self.unknown = frozenset(
            self.number[own]
            for own in self.fluents
            if own not in known and basic(own.name) is PredicateKind.FLUENT_BASIC
        )
        self.group: dict[int, frozenset[int]] = {}
        for symbols in self.possible.groups:
            group = frozenset(self.number[own] for own in symbols if own in self.number)
            self.group |= dict.fromkeys(group, group)
        exact = {own.arguments[0] for own in self.possible.atoms.get("exact", ())}
        self.exact = {
            self.group[self.number[own.arguments[1]]]
            for own in self.possible.atoms.get("in_group", ())
            if own.arguments[0] in exact and own.arguments[1] in self.number
        }
        self.axioms = {own.identifier: own for own in knowledge.axioms}
        self.constraints: list[tuple[Axiom, int, Literals]] = []
        self.derived: list[tuple[int, Literals]] = []
        self.goals: list[Literals] = []

    def problem(self) -> GroundProblem:
        atoms = self.possible.atoms
        self._read_conclusions(atoms.get("conclusion", ()))
        choices: dict[clingo.Symbol, dict[clingo.Symbol, list[int]]] = {}
        for atom in atoms.get("restricted", ()):
            choices.setdefault(atom.arguments[0], {})[atom.arguments[1]] = []
        for atom in atoms.get("allowed", ()):
            action, group, value = atom.arguments
            if action in choices and value in self.possible.may:
                choices[action][group].append(self.number[value])
        needs: dict[clingo.Symbol, list[Literals | None]] = {}
        for atom in atoms.get("needs", ()):
            needs.setdefault(atom.arguments[0], []).append(self._literals(atom.arguments[1:]))
        forbidden: dict[clingo.Symbol, list[Literals | None]] = {}
        for atom in atoms.get("forbidden", ()):
            body = self._literals(atom.arguments[1].arguments)
            forbidden.setdefault(atom.arguments[0], []).append(body)
        laws: dict[clingo.Symbol, list[tuple[Literals, int]]] = {}
        for atom in atoms.get("law", ()):
            action, head, conditions = atom.arguments
            body = self._literals(conditions.arguments)
            if body is not None and _fluent(head) in self.number:
                laws.setdefault(action, []).append((body, self._literal(head)))
        operators = [
            own
            for action in sorted(laws)
            if action in self.possible.can
            for own in self._operators(
                action,
                [sorted(own) for _, own in sorted(choices.get(action, {}).items())],
                needs.get(action, []),
                forbidden.get(action, []),
                laws[action],
            )
        ]
        return self._pruned(operators)

    def _literal(self, symbol: clingo.Symbol) -> int:
        number = self.number[_fluent(symbol)]
        return number if symbol.positive else -number

    def _literals(self, symbols: Iterable[clingo.Symbol]) -> Literals | None:
        """The conditions that may change; None where one of the others does not hold."""
        found = set()
        for symbol in symbols:
            if _fluent(symbol) in self.number:
                found.add(self._literal(symbol))
            elif symbol not in self.possible.rigid:
                return None
        return frozenset(found) if _consistent(found) else None

    def _read_conclusions(self, atoms: Iterable[clingo.Symbol]) -> None:
        signature = self.knowledge.signature
        for atom in atoms:
            identifier, head, conditions = atom.arguments
            body = self._literals(conditions.arguments)
            if body is None or _fluent(head) not in self.number:
                continue
            if head.name == REACHED:
                self.goals.append(body)
            elif signature.kind(head.name) is PredicateKind.FLUENT_DEFINED:
                self.derived.append((self._literal(head), body))
            elif self._literal(head) not in body:
                axiom = self.axioms[identifier.name]
                self._check_determined(axiom, body)
                self.constraints.append((axiom, self._literal(head), body))
            else:
                self._check_determined(self.axioms[identifier.name], body)

    def _check_determined(self, axiom: Axiom, body: Literals) -> None:
        """Refuse a constraint by which a basic fluent may change without an action."""
        changing = {self.fluents[abs(own) - 1].name for own in body}
        for condition in axiom.body:
            literal = condition.literal
            if literal is None or literal.predicate not in changing:
                continue
            if condition.absent:
                raise _refusal(axiom, f"asks for '{condition}', which leaves open what happens")
            if self.knowledge.signature.kind(literal.predicate) is PredicateKind.FLUENT_DEFINED:
                raise _refusal(axiom, f"concludes a basic fluent from '{literal.predicate}'")

    def _operators(
        self,
        action: clingo.Symbol,
        choices: Sequence[Sequence[int]],
        needs: Sequence[Literals | None],
        forbidden: Sequence[Literals | None],
        laws: Sequence[tuple[Literals, int]],
    ) -> Iterator[Operator]:
        if any(own is None for own in needs):
            return
        required = frozenset[int]().union(*filter(None, needs))
        clauses = [own for own in forbidden if own is not None]
        for values in itertools.product(*choices):
            waiting = list(self._split(required | frozenset(values), clauses))
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
            head == own and body <= before for _, own, body in self.constraints
        )

    def _known(self, condition: Collection[int]) -> set[int]:
        """The condition with what follows from it: where one value holds, the others do not."""
        known = set(condition)
        for own in condition:
            if own > 0 and own in self.group:
                known |= {-other for other in self.group[own] if other != own}
        return known

    def _split(self, condition: Literals, forbidden: Sequence[Literals]) -> Iterator[Literals]:
        """Yield conditions that together allow what ``condition`` does, less what is forbidden."""
        known = self._known(condition)
        if not _consistent(known):
            return
        left = []
        for clause in forbidden:
            if not any(-own in known for own in clause):
                left.append(clause - known)
        if not left:
            yield condition
            return
        clause = min(left, key=len)
        rest = [own for own in left if own is not clause]
        if not clause:
            return
        first = min(clause, key=lambda own: (self.group.get(own) not in self.exact, own))
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
            if not any(-own in known for own in body):
                _add(direct, head, body - known)
        self._exclude(direct, known)
        effects = direct
        for _ in range(_ROUNDS if self.constraints else 0):
            following = {head: set(bodies) for head, bodies in direct.items()}
            for axiom, head, body in self.constraints:
                if -head in effects or any(own in effects for own in body):
                    for before in self._before(axiom, body, effects, known):
                        _add(following, head, before)
            self._exclude(following, known)
            if following == effects:
                return effects
            effects = following
        if self.constraints:
            raise _refusal(self.constraints[0][0], "leaves open what happens")
        return effects

    def _exclude(self, effects: dict[int, set[Literals]], known: set[int]) -> None:
        """Of fluents of which one holds, that which becomes true makes the others false."""
        for head in [own for own in effects if own > 0 and own in self.group]:
            others = self.group[head] - {head}
            for other in others:
                if -other not in known:
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
        for own in sorted(body):
            stays: list[Literals] = []
            removing = effects.get(-own, set())
            if any(len(other) > 1 for other in removing):
                raise _refusal(axiom, "follows from what changes under several conditions")
            if frozenset() not in removing:
                stays = [frozenset({own, *(-next(iter(other)) for other in removing)})]
            ways.append([*effects.get(own, ()), *stays])
        for together in itertools.product(*ways):
            before = frozenset[int]().union(*together)
            if _consistent(before) and not any(-own in known for own in before):
                yield before - known

    def _conflicts(self, effects: Mapping[int, set[Literals]]) -> list[Literals]:
        """Conditions under which an action would make something both true and false."""
        return [
            one | other
            for head in effects
            if head > 0 and -head in effects
            for one, other in itertools.product(effects[head], effects[-head])
            if _consistent(one | other)
        ]

    def _pruned(self, operators: Sequence[Operator]) -> GroundProblem:
        """Leave out what no way to the goal asks about, and check that the rest is known."""
        asked = {abs(own) for goal in self.goals for own in goal}
        kept: list[Operator] = []
        left = list(operators)
        size = -1
        while size != len(asked):
            size = len(asked)
            for head, body in self.derived:
                if head in asked:
                    asked |= {abs(own) for own in body}
            useful = [own for own in left if any(abs(e) in asked for _, e in own.effects)]
            left = [own for own in left if own not in useful] if useful else left
            kept += useful
            for own in useful:
                asked |= {abs(literal) for literal in own.condition}
                for body, head in own.effects:
                    asked |= {abs(literal) for literal in (*body, head)}
            # Which one of a group holds matters as a whole.
            for own_group in {self.group[number] for number in asked if number in self.group}:
                asked |= own_group
        open_ = sorted(self.fluents[own - 1] for own in asked & self.unknown)
        if open_:
            raise PlanningError(
                f"whether '{open_[0]}' holds at the start is unknown, and it matters to the goal; "
                "observe it, or add a default to the knowledge"
            )
        order = sorted(asked)
        place = {own: number for number, own in enumerate(order, start=1)}
        place |= {-own: -number for own, number in place.items()}

        def renamed(literals: Iterable[int]) -> Literals:
            return frozenset(place[own] for own in literals)

        groups = {own for own in map(self.group.get, order) if own is not None}
        return GroundProblem(
            fluents=tuple(self.fluents[own - 1] for own in order),
            start=renamed(own for own in self.start if own in asked),
            operators=tuple(
                Operator(
                    own.action,
                    renamed(own.condition),
                    tuple((renamed(body), place[head]) for body, head in own.effects),
                )
                for own in sorted(kept, key=lambda own: (own.action, sorted(own.condition)))
            ),
            derivations=self._strata(
                [(place[head], renamed(body)) for head, body in self.derived if head in asked]
            ),
            goals=tuple(renamed(own) for own in self.goals),
            groups=tuple(
                sorted(
                    (renamed(own) for own in groups if own in self.exact and own <= asked),
                    key=sorted,
                )
            ),
        )

    def _strata(
        self, derived: Sequence[tuple[int, Literals]]
    ) -> tuple[tuple[tuple[int, Literals], ...], ...]:
        """Order derivations so that what is denied in a condition is settled before."""
        level = {head: 0 for head, _ in derived}
        changed = True
        while changed:
            changed = False
            for head, body in derived:
                least = max([0, *(level.get(abs(o), -(o > 0)) + (o < 0) for o in body)])
                if least > level[head]:
                    level[head], changed = least, True
            if max(level.values(), default=0) > len(level):
                axiom = next(
                    own
                    for own in constraints(self.knowledge)
                    if self.knowledge.signature.kind(own.head.predicate)
                    is PredicateKind.FLUENT_DEFINED
                    and own.head.predicate != REACHED
                )
                raise _refusal(axiom, "depends on its own denial")
        strata: list[list[tuple[int, Literals]]] = [[] for _ in range(len(level) + 1)]
        for head, body in sorted(derived, key=lambda own: (own[0], sorted(own[1]))):
            strata[level[head]].append((head, body))
        return tuple(tuple(own) for own in strata if own)


def _add(effects: dict[int, set[Literals]], head: int, body: Literals) -> None:
    """Add a condition for an effect; of conditions, the weaker ones are kept."""
    bodies = effects.setdefault(head, set())
    if not any(own <= body for own in bodies):
        bodies -= {own for own in bodies if body < own}
        bodies.add(body)


def _consistent(literals: Collection[int]) -> bool:
    return not any(-own in literals for own in literals)


def _order(effect: tuple[Literals, int]) -> tuple[bool, int, list[int]]:
    return effect[1] < 0, abs(effect[1]), sorted(effect[0])


def _fluent(literal: clingo.Symbol) -> clingo.Symbol:
    return literal if literal.positive else clingo.Function(literal.name, literal.arguments)


def _refusal(axiom: Axiom, why: str) -> PlanningError:
    return PlanningError(f"{axiom.location}: the axiom '{axiom}' {why}; PDDL cannot say that")
