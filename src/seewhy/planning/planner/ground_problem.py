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
from seewhy.knowledge.dynamics import constraints, gives_way
from seewhy.knowledge.ground import fluent_of
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.signature import PredicateKind
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.goal import REACHED
from seewhy.planning.planner.mutex import mutexes
from seewhy.planning.planner.reachability import asks_more, instances
from seewhy.planning.planner.relevance import fluents_in

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
    open : the fluents that are unknown at first
    exclusive : sets of fluents, open ones among them, of which at most one holds
    untold : the defined fluents that may change and that no way to the goal asks about
    """

    fluents: tuple[clingo.Symbol, ...]
    start: frozenset[int]
    operators: tuple[Operator, ...]
    derivations: tuple[tuple[tuple[int, Literals], ...], ...]
    goals: tuple[Literals, ...]
    groups: tuple[frozenset[int], ...]
    open: frozenset[int] = frozenset()
    exclusive: tuple[frozenset[int], ...] = ()
    untold: frozenset[clingo.Symbol] = frozenset()


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
    return _Compilation(knowledge, start, whole).problem()


class _Compilation:
    def __init__(self, knowledge: Knowledge, start: State, whole: Knowledge | None) -> None:
        self.knowledge = knowledge
        self.whole = whole
        self.believed = {fluent.name for fluent in start.holds}
        for axiom in knowledge.axioms:
            if axiom.kind is not AxiomKind.DEFAULT and asks_more(axiom, knowledge.signature):
                raise _refusal(axiom, "asks about several fluents at once, in a count or with '_'")
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

    def problem(self) -> GroundProblem:
        self._read_conclusions()
        needs, forbidden = self._by_first("need"), self._by_first("forbidden")
        laws, choices = self._by_first("law"), self._by_first("choice")
        can = self._first("can")
        return self._pruned(
            [
                operator
                for action in sorted(laws)
                if action in can
                for operator in self._operators(
                    action,
                    choices=self._choices(choices.get(action, ())),
                    required=self._literals(atom.arguments[1] for atom in needs.get(action, ())),
                    forbidden=[
                        self._literals(atom.arguments[1].arguments)
                        for atom in forbidden.get(action, ())
                    ],
                    laws=[
                        (
                            self._literals(law.arguments[2].arguments),
                            self._literal(law.arguments[1]),
                        )
                        for law in laws[action]
                        if fluent_of(law.arguments[1]) in self.number
                    ],
                )
            ]
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
            if not _consistent(body):
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
                raise _refusal(axiom, f"asks for '{condition}', which leaves open what happens")
            if self.knowledge.signature.kind(literal.predicate) is PredicateKind.FLUENT_DEFINED:
                raise _refusal(axiom, f"concludes a basic fluent from '{literal.predicate}'")

    def _operators(
        self,
        action: clingo.Symbol,
        *,
        choices: Sequence[Sequence[int]],
        required: Literals,
        forbidden: Sequence[Literals],
        laws: Sequence[tuple[Literals, int]],
    ) -> Iterator[Operator]:
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
        if not _consistent(known):
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
            raise _refusal(self.constraints[0][0], "leaves open what happens")
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
                raise _refusal(axiom, "follows from what changes under several conditions")
            if frozenset() not in removing:
                stays = [frozenset({literal, *(-next(iter(other)) for other in removing)})]
            ways.append([*effects.get(literal, ()), *stays])
        for together in itertools.product(*ways):
            before = frozenset[int]().union(*together)
            if _consistent(before) and not any(-literal in known for literal in before):
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
        asked = {abs(literal) for goal in self.goals for literal in goal}
        kept: list[Operator] = []
        left = list(operators)
        size = -1
        while size != len(asked):
            size = len(asked)
            for head, body in self.derived:
                if head in asked:
                    asked |= {abs(literal) for literal in body}
            useful: list[Operator] = []
            rest: list[Operator] = []
            for operator in left:
                (useful if any(abs(e) in asked for _, e in operator.effects) else rest).append(
                    operator
                )
            left = rest
            kept += useful
            for operator in useful:
                asked |= {abs(literal) for literal in operator.condition}
                for body, head in operator.effects:
                    asked |= {abs(literal) for literal in (*body, head)}
            # Which one of a group holds matters as a whole.
            for group in {self.group[number] for number in asked if number in self.group}:
                asked |= group
        open_ = sorted(self.fluents[number - 1] for number in asked & self.unknown)
        if open_ and (self.whole is None or self._said_more({fluent.name for fluent in open_})):
            raise PlanningError(
                f"whether '{open_[0]}' holds at the start is unknown, and it matters to the goal; "
                "observe it, or add a default to the knowledge"
            )
        order = sorted(asked)
        place = {fluent: number for number, fluent in enumerate(order, start=1)}
        place |= {-fluent: -number for fluent, number in place.items()}

        def renamed(literals: Iterable[int]) -> Literals:
            return frozenset(place[literal] for literal in literals)

        groups = {group for group in map(self.group.get, order) if group is not None}
        return GroundProblem(
            fluents=tuple(self.fluents[number - 1] for number in order),
            start=renamed(number for number in self.start if number in asked),
            operators=tuple(
                Operator(
                    operator.action,
                    renamed(operator.condition),
                    tuple((renamed(body), place[head]) for body, head in operator.effects),
                )
                for operator in sorted(
                    kept, key=lambda operator: (operator.action, sorted(operator.condition))
                )
            ),
            derivations=self._strata(
                [(place[head], renamed(body)) for head, body in self.derived if head in asked]
            ),
            goals=tuple(renamed(goal) for goal in self.goals),
            groups=tuple(
                sorted(
                    (renamed(group) for group in groups if group in self.exact and group <= asked),
                    key=sorted,
                )
            ),
            open=renamed(asked & self.unknown),
            exclusive=tuple(
                sorted(
                    (renamed(group & asked) for group in groups if group & self.unknown), key=sorted
                )
            ),
            untold=frozenset(
                self.fluents[head - 1] for head, _ in self.derived if head not in asked
            ),
        )

    def _said_more(self, names: set[str]) -> bool:
        """Whether the knowledge says more of unknown fluents than that they exclude others.

        Then not all that is unknown may be chosen freely, or what follows from it matters.
        """
        assert self.whole is not None
        signature = self.whole.signature
        excluded = {mutex.axiom.identifier for mutex in mutexes(self.whole)}
        said = [
            axiom
            for axiom in constraints(self.whole)
            if axiom.identifier not in excluded
            and axiom.head.predicate != REACHED
            and not gives_way(axiom, signature)
        ]
        following = set(names)
        size = -1
        while size != len(following):
            size = len(following)
            following |= {
                axiom.head.predicate
                for axiom in said
                if signature.kind(axiom.head.predicate) is PredicateKind.FLUENT_DEFINED
                and following & fluents_in(axiom, self.whole)
            }
        matter = self.believed | set(self.knowledge.signature.predicates)
        return bool((following - names) & matter) or any(
            following & {axiom.head.predicate, *fluents_in(axiom, self.whole)}
            for axiom in said
            if signature.kind(axiom.head.predicate) is not PredicateKind.FLUENT_DEFINED
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
                    axiom
                    for axiom in constraints(self.knowledge)
                    if self.knowledge.signature.kind(axiom.head.predicate)
                    is PredicateKind.FLUENT_DEFINED
                    and axiom.head.predicate != REACHED
                )
                raise _refusal(axiom, "depends on its own denial")
        strata: list[list[tuple[int, Literals]]] = [[] for _ in range(len(level) + 1)]
        for head, body in sorted(
            derived, key=lambda derivation: (derivation[0], sorted(derivation[1]))
        ):
            strata[level[head]].append((head, body))
        return tuple(tuple(stratum) for stratum in strata if stratum)


def _add(effects: dict[int, set[Literals]], head: int, body: Literals) -> None:
    """Add a condition for an effect; of conditions, the weaker ones are kept."""
    bodies = effects.setdefault(head, set())
    if not any(other <= body for other in bodies):
        bodies -= {other for other in bodies if body < other}
        bodies.add(body)


def _consistent(literals: Collection[int]) -> bool:
    return not any(-literal in literals for literal in literals)


def _order(effect: tuple[Literals, int]) -> tuple[bool, int, list[int]]:
    return effect[1] < 0, abs(effect[1]), sorted(effect[0])


def _refusal(axiom: Axiom, why: str) -> PlanningError:
    return PlanningError(f"{axiom.location}: the axiom '{axiom}' {why}; PDDL cannot say that")
