"""Why a goal cannot be reached: no state is so, or nothing that can be done leads to one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice, product

import clingo

from seewhy.domain.wording import join_words
from seewhy.knowledge.axiom import Axiom, AxiomKind, Literal, variables_in
from seewhy.knowledge.dynamics import constraints, gives_way, of_kind
from seewhy.knowledge.signature import PredicateKind
from seewhy.knowledge.transition_probe import TransitionProbe
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.goal import REACHED, Goal, with_goal
from seewhy.planning.planner.relaxed_reachability import reachable

__all__ = ["excluded_by", "why_unreachable"]

_MOST_ACTIONS = 200
"""Actions that might lead to a goal: of more it is not told why none does."""


def why_unreachable(domain: PlanningDomain, goal: Goal, start: State) -> str | None:
    """Return why a goal cannot be reached, as a clause; None where no short reason is found.

    Examples
    --------
    >>> from seewhy.planning.diagnosis.diagnosis import diagnose
    >>> from seewhy.planning.domain import load_planning_domain
    >>> from seewhy.planning.spoken_goals import goal_of
    >>> table = load_planning_domain("tabletop")
    >>> start = diagnose(table.knowledge, table.history).now
    >>> why_unreachable(table, goal_of("put the red block on the red block", table), start)
    'nothing is on itself'
    """
    return _Unreachable(domain, goal).why(start)


def excluded_by(domain: PlanningDomain, goal: Goal) -> list[Axiom]:
    """Return the axioms by which no state is as a goal wants it; none where some may be."""
    return _Unreachable(domain, goal).excluded_by()


class _Unreachable:
    """What is asked about all states of a domain with a goal."""

    def __init__(self, domain: PlanningDomain, goal: Goal) -> None:
        self.domain = domain
        self.goal = goal
        self.knowledge = knowledge = with_goal(domain.knowledge, goal)
        signature = knowledge.signature
        always = [axiom for axiom in constraints(knowledge) if not gives_way(axiom, signature)]
        self.always = [axiom for axiom in always if axiom.head.predicate != REACHED]
        usual = [axiom for axiom in constraints(knowledge) if gives_way(axiom, signature)]
        self.usual = [*usual, *of_kind(knowledge, AxiomKind.DEFAULT)]
        self.probe = TransitionProbe(knowledge, following=0)

    def excluded_by(self) -> list[Axiom]:
        reached = Literal(REACHED, ())
        if self.probe.is_possible(holds=reached, without=self.usual):
            return []
        return self.probe.smallest_conflict(self.always, holds=reached, without=self.usual)

    def why(self, start: State) -> str | None:
        wanted = list(self._wanted())
        for literal in wanted:
            if (why := self._too_many(literal)) is not None:
                return why
        excluded = self.excluded_by()
        if excluded:
            return join_words([axiom.text for axiom in excluded])
        may = reachable(self.knowledge, start).may
        for literal in wanted:
            instances = list(islice(self._instances(literal), _MOST_ACTIONS))
            if not any(_symbol(instance) in may for instance in instances):
                why = self._not_done(instances)
                if why is not None:
                    return why
        return None

    def _wanted(self) -> Iterator[Literal]:
        """The fluents that the goal wants to be so, of some things where it names none."""
        kind = self.knowledge.signature.kind
        for condition in self.goal.axiom.body:
            literal = condition.literal
            wanted = literal is not None and literal.positive and not condition.absent
            if literal is not None and wanted and kind(literal.predicate).is_fluent:
                yield literal

    def _too_many(self, literal: Literal) -> str | None:
        """That a number is greater than any that is so in a state."""
        sorts = self.knowledge.signature.argument_sorts(literal.predicate)
        numbers = [place for place, text in enumerate(literal.arguments) if text.isdigit()]
        if len(numbers) != 1 or self._is_in_some_state(literal):
            return None
        (place,) = numbers
        possible = [
            int(number)
            for number in self.knowledge.signature.members(sorts[place])
            if number.isdigit() and self._is_in_some_state(_with(literal, place, number))
        ]
        if not possible:
            return None
        most = max(possible) < int(literal.arguments[place])
        denied = self.domain.words.say(_symbol(self._of_any(literal).complement))
        return (
            f"{denied} in any state that there can be; the {'most' if most else 'least'} is "
            f"{max(possible) if most else min(possible)}"
        )

    def _is_in_some_state(self, literal: Literal) -> bool:
        return any(
            self.probe.is_possible(holds=instance, without=self.usual)
            for instance in self._instances(literal)
        )

    def _not_done(self, instances: Sequence[Literal]) -> str | None:
        """Why no action leads to one of some fluents."""
        first = instances[0]
        if self.knowledge.signature.kind(first.predicate) is not PredicateKind.FLUENT_BASIC:
            return None
        leading = (action for instance in instances for action in self._leading_to(instance))
        actions = list(islice(leading, _MOST_ACTIONS + 1))
        if len(actions) > _MOST_ACTIONS:
            return None
        if not actions:
            return f"nothing that can be done leads to it that {self._said(instances)}"
        if any(self.probe.is_possible(done=action, without=self.usual) for action in actions):
            return None
        conditions = list(of_kind(self.knowledge, AxiomKind.EXECUTABILITY_CONDITION))
        forbidding = self.probe.smallest_conflict(conditions, done=actions[0], without=self.usual)
        return join_words([axiom.text for axiom in forbidding]) or None

    def _said(self, instances: Sequence[Literal]) -> str:
        """One of some fluents in words; where they are several, of any member."""
        sorts = self.knowledge.signature.argument_sorts(instances[0].predicate)
        columns = zip(*(instance.arguments for instance in instances), strict=True)
        arguments = tuple(
            column[0] if len(set(column)) == 1 else f"any_{sort}"
            for column, sort in zip(columns, sorts, strict=True)
        )
        return self.domain.words.say(_symbol(Literal(instances[0].predicate, arguments)))

    def _leading_to(self, literal: Literal) -> Iterator[Literal]:
        """The actions that bring a literal about."""
        for law in of_kind(self.knowledge, AxiomKind.CAUSAL_LAW):
            action = law.action
            if action is None or law.head.predicate != literal.predicate:
                continue
            if self.knowledge.signature.kind(action.predicate) is not PredicateKind.ACTION:
                continue
            binding = _bound(law.head, literal)
            if binding is not None:
                done = action.substitute(binding)
                yield from (
                    instance for instance in self._instances(done) if self._is_named(instance)
                )

    def _is_named(self, literal: Literal) -> bool:
        """Whether each argument of a literal is a member of its sort."""
        signature = self.knowledge.signature
        sorts = signature.argument_sorts(literal.predicate)
        pairs = zip(literal.arguments, sorts, strict=True)
        return all(argument in signature.members(sort) for argument, sort in pairs)

    def _instances(self, literal: Literal) -> Iterator[Literal]:
        """A literal with members for its variables."""
        signature = self.knowledge.signature
        sorts = dict(
            zip(literal.arguments, signature.argument_sorts(literal.predicate), strict=True)
        )
        free = [name for name in sorts if variables_in(name)]
        for chosen in product(*(signature.members(sorts[name]) for name in free)):
            yield literal.substitute(dict(zip(free, chosen, strict=True)))

    def _of_any(self, literal: Literal) -> Literal:
        """A literal that says "any thing" for what the goal leaves open."""
        sorts = self.knowledge.signature.argument_sorts(literal.predicate)
        arguments = tuple(
            f"any_{sort}" if variables_in(text) else text
            for text, sort in zip(literal.arguments, sorts, strict=True)
        )
        return Literal(literal.predicate, arguments, literal.positive)


def _bound(head: Literal, literal: Literal) -> Mapping[str, str] | None:
    """What the variables of a law's effect are where it is a literal."""
    if head.positive is not literal.positive:
        return None
    binding: dict[str, str] = {}
    for text, member in zip(head.arguments, literal.arguments, strict=True):
        if not variables_in(text):
            if text != member:
                return None
        elif binding.setdefault(text, member) != member:
            return None
    return binding


def _with(literal: Literal, place: int, member: str) -> Literal:
    arguments = (*literal.arguments[:place], member, *literal.arguments[place + 1 :])
    return Literal(literal.predicate, arguments, literal.positive)


def _symbol(literal: Literal) -> clingo.Symbol:
    return clingo.parse_term(str(literal))
