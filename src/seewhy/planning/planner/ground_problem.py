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
        self.believed = {own.name for own in start.holds}
        for axiom in knowledge.axioms:
            if axiom.kind is not AxiomKind.DEFAULT and asks_more(axiom, knowledge.signature):
                raise _refusal(axiom, "asks about several fluents at once, in a count or with '_'")
        self.atoms = instances(knowledge, start)
        self.fluents = sorted(self._first("changing"))
        self.number = {own: place for place, own in enumerate(self.fluents, start=1)}
        self.start = frozenset(self.number[own] for own in start.holds if own in self.number)
        self.unknown = frozenset(
            self.number[own]
            for own in start.unknown
            if own in self.number
            and knowledge.signature.kind(own.name) is PredicateKind.FLUENT_BASIC
        )
        self.group: dict[int, frozenset[int]] = {}
        for members in self._by_first("member").values():
            group = frozenset(self.number[own.arguments[1]] for own in members)
            self.group |= dict.fromkeys(group, group)
        self.exact = {
            self.group[self.number[own.arguments[1]]] for own in self.atoms.get("exact_member", ())
        }
        self.axioms = {own.identifier: own for own in knowledge.axioms}
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
                own
                for action in sorted(laws)
                if action in can
                for own in self._operators(
                    action,
                    choices=self._choices(choices.get(action, ())),
                    required=self._literals(own.arguments[1] for own in needs.get(action, ())),
                    forbidden=[
                        self._literals(own.arguments[1].arguments)
                        for own in forbidden.get(action, ())
                    ],
                    laws=[
                        (
                            self._literals(own.arguments[2].arguments),
                            self._literal(own.arguments[1]),
                        )
                        for own in laws[action]
                        if fluent_of(own.arguments[1]) in self.number
                    ],
                )
            ]
        )

    def _first(self, predicate: str) -> set[clingo.Symbol]:
        return {own.arguments[0] for own in self.atoms.get(predicate, ())}

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
        return [sorted(own) for _, own in sorted(found.items())]

    def _literal(self, symbol: clingo.Symbol) -> int:
        number = self.number[fluent_of(symbol)]
        return number if symbol.positive else -number

    def _literals(self, symbols: Iterable[clingo.Symbol]) -> Literals:
        """The conditions that may change; the others hold, or there would be no instance."""
        return frozenset(self._literal(own) for own in symbols if fluent_of(own) in self.number)

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
            useful: list[Operator] = []
            rest: list[Operator] = []
            for own in left:
                (useful if any(abs(e) in asked for _, e in own.effects) else rest).append(own)
            left = rest
            kept += useful
            for own in useful:
                asked |= {abs(literal) for literal in own.condition}
                for body, head in own.effects:
                    asked |= {abs(literal) for literal in (*body, head)}
            # Which one of a group holds matters as a whole.
            for own_group in {self.group[number] for number in asked if number in self.group}:
                asked |= own_group
        open_ = sorted(self.fluents[own - 1] for own in asked & self.unknown)
        if open_ and (self.whole is None or self._said_more({own.name for own in open_})):
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
            open=renamed(asked & self.unknown),
            exclusive=tuple(
                sorted((renamed(own & asked) for own in groups if own & self.unknown), key=sorted)
            ),
            untold=frozenset(self.fluents[own - 1] for own, _ in self.derived if own not in asked),
        )

    def _said_more(self, names: set[str]) -> bool:
        """Whether the knowledge says more of unknown fluents than that they exclude others.

        Then not all that is unknown may be chosen freely, or what follows from it matters.
        """
        assert self.whole is not None
        signature = self.whole.signature
        excluded = {own.axiom.identifier for own in mutexes(self.whole)}
        said = [
            own
            for own in constraints(self.whole)
            if own.identifier not in excluded
            and own.head.predicate != REACHED
            and not gives_way(own, signature)
        ]
        following = set(names)
        size = -1
        while size != len(following):
            size = len(following)
            following |= {
                own.head.predicate
                for own in said
                if signature.kind(own.head.predicate) is PredicateKind.FLUENT_DEFINED
                and following & fluents_in(own, self.whole)
            }
        matter = self.believed | set(self.knowledge.signature.predicates)
        return bool((following - names) & matter) or any(
            following & {own.head.predicate, *fluents_in(own, self.whole)}
            for own in said
            if signature.kind(own.head.predicate) is not PredicateKind.FLUENT_DEFINED
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


def _refusal(axiom: Axiom, why: str) -> PlanningError:
    return PlanningError(f"{axiom.location}: the axiom '{axiom}' {why}; PDDL cannot say that")
