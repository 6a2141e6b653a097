"""Check knowledge about change: actions that can never be, effects that contradict each other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import clingo

from seewhy.errors import KnowledgeError, PlanningError
from seewhy.knowledge.axiom import Axiom, AxiomKind, Literal
from seewhy.knowledge.dynamics import constraints, gives_way, of_kind
from seewhy.knowledge.ground import complement_of
from seewhy.knowledge.grounding_size import large_grounding
from seewhy.knowledge.history import Observation, Occurrence, read_history
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.signature import Location, PredicateKind, Signature
from seewhy.knowledge.statements import statements
from seewhy.knowledge.transition_probe import Found, TransitionProbe
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.diagnosis.diagnosis import diagnose, smallest_correction_set
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.planner.relaxed_reachability import reachable


def check_change(domain: PlanningDomain) -> tuple[str, ...]:
    """Refuse knowledge about change that cannot be meant; return notes on what may not be.

    All states that the constraints allow are asked about, whether or not they can be reached:
    what is refused is wrong in every one of them.

    Raises
    ------
    KnowledgeError
        If no state satisfies the constraints, if an action is impossible in every state, or if a
        causal law contradicts others wherever it applies.
    PlanningError
        If there is no initial state such as history.al says.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> check_change(load_planning_domain("robot_assistant"))
    ()
    """
    check = _Check(domain)
    check.states()
    check.actions()
    check.effects()
    start = _start(domain)
    return (
        *filter(None, [large_grounding(domain.knowledge)]),
        *check.defaults(),
        *check.needless_laws(),
        *check.several_outcomes(),
        *(_said_never(action, domain) for action in never_possible(domain.knowledge, start)),
    )


def never_possible(knowledge: Knowledge, start: State) -> Iterator[Literal]:
    """Yield the actions that can never be done from a state on, also not after what may happen.

    An argument with which an action is never possible is named; ``_`` stands for any other.

    Examples
    --------
    >>> from seewhy.knowledge.history import read_history
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge('''
    ... #sort robot = {rob1}. #sort place = {hall, attic}. #static next_to(place, place).
    ... #fluent basic at(place). #action move(robot, place).
    ... move(R, L) causes at(L). -at(L2) if at(L1), L1 != L2.
    ... impossible move(R, L) if at(K), not next_to(K, L).
    ... next_to(hall, hall).
    ... ''')
    >>> start = diagnose(known, read_history("observed at(hall) at 0.", known.signature)).now
    >>> [str(action) for action in never_possible(known, start)]
    ['move(rob1, attic)']
    """
    signature = knowledge.signature
    can = reachable(_all_done(knowledge), start).can
    for predicate in signature.predicates.values():
        if predicate.kind is not PredicateKind.ACTION:
            continue
        done = [action.arguments for action in can if action.name == predicate.name]
        members = [signature.members(sort) for sort in predicate.sorts]
        usual = [objects[0] if len(objects) == 1 else "_" for objects in members]
        if not done:
            yield Literal(predicate.name, tuple(usual))
            continue
        for place, objects in enumerate(members):
            seen = {str(arguments[place]) for arguments in done}
            for member in objects:
                if str(clingo.parse_term(member)) not in seen:
                    terms = [*usual[:place], member, *usual[place + 1 :]]
                    yield Literal(predicate.name, tuple(terms))


class _Check:
    """The knowledge of a domain, and what is asked about all of its states."""

    def __init__(self, domain: PlanningDomain) -> None:
        self.words = domain.words
        self.knowledge = knowledge = domain.knowledge
        signature = knowledge.signature
        always = list(constraints(knowledge))
        self.usual = [axiom for axiom in always if gives_way(axiom, signature)]
        self.usual += of_kind(knowledge, AxiomKind.DEFAULT)
        self.always = [axiom for axiom in always if axiom not in self.usual]
        self.conditions = list(of_kind(knowledge, AxiomKind.EXECUTABILITY_CONDITION))
        self.laws = list(of_kind(knowledge, AxiomKind.CAUSAL_LAW))
        self.now = TransitionProbe(knowledge, following=0)
        self.next = TransitionProbe(knowledge, following=1)
        self.needless: list[Axiom] = []

    def states(self) -> None:
        """Refuse constraints that no state satisfies."""
        if self.now.is_possible(without=self.usual):
            return
        if not self.now.is_possible(without=[*self.always, *self.usual]):
            raise KnowledgeError(
                f"{self.knowledge.file}: the axioms about what never changes contradict each "
                "other; look for a static that is concluded with and without '-'"
            )
        needed = self.now.smallest_conflict(self.always, without=self.usual)
        raise KnowledgeError(
            f"{needed[0].location}: no state satisfies {_quoted(needed)}; "
            f"{_change(needed)}, or give one a condition"
        )

    def defaults(self) -> Iterator[str]:
        """Note what cannot all be as usual, whatever is observed."""
        if not self.now.is_possible():
            needed = self.now.smallest_conflict([*self.usual, *self.always])
            first = next(axiom for axiom in needed if axiom in self.usual)
            others = [axiom for axiom in needed if axiom is not first]
            yield (
                f"{first.location}: in every initial state there is an exception to '{first}'"
                + (f" or to what it contradicts: {_quoted(others)}" if others else "")
            )

    def actions(self) -> None:
        """Refuse an action that is impossible in every state."""
        for action in self.now.actions:
            if self.now.is_possible(action=action, without=self.usual):
                continue
            conditions = [
                condition
                for condition in self.conditions
                if condition.action and condition.action.predicate == action
            ]
            needed = self.now.smallest_conflict(conditions, action=action, without=self.usual)
            which = "one of these forbids it" if len(needed) > 1 else "this forbids it"
            raise KnowledgeError(
                f"{needed[0].location}: '{action}' is never possible: in every state {which}: "
                f"{_quoted(needed)}; {_change(needed)}, or remove the action"
            )

    def effects(self) -> None:
        """Refuse a causal law that contradicts other axioms wherever it applies."""
        for law in self.laws:
            assert law.action is not None
            action = law.action.predicate
            if not self.now.is_possible(action=action, applies=law, without=self.usual):
                self.needless.append(law)
            elif not self.next.is_possible(action=action, applies=law, without=self.usual):
                against = self._against(law)
                raise KnowledgeError(
                    f"{law.location}: '{law}' defeats itself: {against}, so that "
                    f"'{law.action}' can never happen where this applies; change or remove one "
                    f"of them, or write 'impossible {law.action} if …' for where they contradict"
                )

    def needless_laws(self) -> Iterator[str]:
        """Note the causal laws that apply only where their action is impossible."""
        for law in self.needless:
            yield (
                f"{law.location}: '{law}' never applies: where its conditions hold, "
                f"'{law.action}' is impossible"
            )

    def several_outcomes(self) -> Iterator[str]:
        """Note where it is left open what follows a state."""
        both = TransitionProbe(self.knowledge, following=2)
        found = next(
            (
                outcome
                for action in (None, *both.actions)
                if (outcome := both.find(action=action, without=self.usual)) is not None
            ),
            None,
        )
        if found is None:
            return
        axiom = _undecided(found, self.knowledge)
        yield (
            f"{axiom.location if axiom else self.knowledge.file}: {self._after(found.action)} it "
            f"is left open in some state whether {self._whether(min(found.differing))}"
            + (f"; '{axiom}' asks with 'not' for what its own conclusion decides" if axiom else "")
        )

    def _after(self, action: clingo.Symbol | None) -> str:
        if action is None:
            return "where nothing is done"
        if action.name not in self.words.actions:
            return f"after '{_shown(action)}'"
        return f"after {self.words.happened(action)} ('{_shown(action)}')"

    def _whether(self, fluent: clingo.Symbol) -> str:
        if fluent.name not in self.words.fluents:
            return f"'{_shown(fluent)}' holds"
        return f"{self.words.say(fluent)} ('{_shown(fluent)}')"

    def _against(self, law: Axiom) -> str:
        assert law.action is not None
        found = self.next.find(
            action=law.action.predicate, applies=law, without=self.usual, contradictions=True
        )
        axioms = {axiom.identifier: axiom for axiom in self.knowledge.axioms}
        for fluent in sorted(found.contradicted) if found else ():
            concluding = {
                sign: [axioms[name] for name, head, _ in found.conclusions if head == literal]
                for sign, literal in ((True, fluent), (False, complement_of(fluent)))
                if found
            }
            for sign, sources in concluding.items():
                if law in sources and concluding[not sign]:
                    (other, *_) = concluding[not sign]
                    return f"wherever it applies, {_line(other)} brings about the opposite"
            if all(concluding.values()):
                one, other = (sources[0] for sources in concluding.values())
                return f"wherever it applies, {_line(one)} and {_line(other)} bring about opposites"
        return "wherever it applies, no state can follow"


def _said_never(action: Literal, domain: PlanningDomain) -> str:
    """An action that is never possible, in the words of the domain where it has some."""
    if action.predicate not in domain.words.actions:
        return f"never possible: {action}"
    sorts = domain.knowledge.signature.predicates[action.predicate].sorts
    arguments = [
        clingo.Function(f"any_{sort}") if argument == "_" else clingo.parse_term(argument)
        for argument, sort in zip(action.arguments, sorts, strict=True)
    ]
    said = domain.words.do(clingo.Function(action.predicate, arguments))
    return f"it is never possible to {said}: {action}"


def _start(domain: PlanningDomain) -> State:
    """The state that history.al ends in; errors name the place in that file."""
    try:
        return diagnose(domain.knowledge, domain.history).now
    except PlanningError as problem:
        wrong = smallest_correction_set(domain.knowledge, domain.history) or ()
        place = _place_of(wrong, domain)
        raise PlanningError(f"{place}: {problem}" if place else str(problem)) from None


def _place_of(
    entries: Sequence[Observation | Occurrence], domain: PlanningDomain
) -> Location | None:
    path = domain.folder / "history.al"
    if not path.is_file():
        return None
    for statement in statements(path.read_text(encoding="utf-8"), file=str(path)):
        history = read_history(f"{statement.text}.", domain.knowledge.signature)
        if {*history.observations, *history.occurrences} & {*entries}:
            return statement.location
    return None


def _all_done(knowledge: Knowledge) -> Knowledge:
    """The knowledge as if what happens unasked were done like any action."""
    predicates = {
        name: replace(predicate, kind=PredicateKind.ACTION)
        if predicate.kind.is_action
        else predicate
        for name, predicate in knowledge.signature.predicates.items()
    }
    signature: Signature = replace(knowledge.signature, predicates=predicates)
    return replace(knowledge, signature=signature)


def _undecided(found: Found, knowledge: Knowledge) -> Axiom | None:
    """The first axiom with ``not`` that fires in one of two states that may follow only."""
    one, other = (
        {(name, head) for name, head, step in found.conclusions if step == number}
        for number in (1, 2)
    )
    names = {name for name, _ in one ^ other}
    return next(
        (
            axiom
            for axiom in knowledge.axioms
            if axiom.identifier in names and any(part.absent for part in axiom.body)
        ),
        None,
    )


def _shown(symbol: clingo.Symbol) -> Literal:
    return Literal(symbol.name, tuple(map(str, symbol.arguments)), symbol.positive)


def _line(axiom: Axiom) -> str:
    return f"'{axiom}' (line {axiom.location.line})"


def _quoted(axioms: Sequence[Axiom]) -> str:
    return " and ".join(map(_line, axioms))


def _change(axioms: Sequence[Axiom]) -> str:
    return "change it" if len(axioms) == 1 else "change one of them"
