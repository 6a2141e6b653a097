"""Doubt what was believed: what may have changed, unseen, since it was last known."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import clingo

from seewhy.knowledge.axiom import AxiomKind, Literal
from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.dynamics import fixed_rules, of_kind, rule
from seewhy.knowledge.ground import fluent_of
from seewhy.knowledge.grounding_size import grounding_size
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.signature import PredicateKind
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.planner.mutex import Mutex, mutexes


class PersistenceDoubt:
    """What may have changed unseen under a domain's knowledge: what exogenous actions change.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge("#fluent basic open. #fluent basic lit. #action exogenous shut. "
    ...     "shut causes -open.")
    >>> state = State(frozenset({clingo.Function("open"), clingo.Function("lit")}))
    >>> after = PersistenceDoubt(known).applied(state, {clingo.Function("open"): 3}, before=4)
    >>> [str(fluent) for fluent in after.positive()], [str(fluent) for fluent in after.unknown]
    (['lit'], ['open'])
    """

    def __init__(self, knowledge: Knowledge) -> None:
        self.knowledge = knowledge
        self.mutexes = mutexes(knowledge)
        self.fluents = _changed_unasked(knowledge, self.mutexes)

    def applied(
        self, state: State, last_seen: Mapping[clingo.Symbol, int], *, before: int
    ) -> State:
        """Return the state with everything unknown that was last seen before a step.

        ``last_seen`` gives for each fluent that was seen the last step of it. Of fluents that
        exclude one another, one that is believed since it was seen lately settles the others.
        What follows from other fluents is worked out anew.
        """

        def recent(fluent: clingo.Symbol) -> bool:
            return last_seen.get(fluent, -1) >= before

        settled = {
            self._group(literal) for literal in state.holds if literal.positive and recent(literal)
        } - {None}
        doubtful = {
            literal
            for literal in state.holds
            if (fluent := fluent_of(literal)) in self.fluents
            and not recent(fluent)
            and self._group(fluent) not in settled
        }
        if not doubtful:
            return state
        defined = {
            literal
            for literal in state.holds
            if self.knowledge.signature.kind(literal.name) is PredicateKind.FLUENT_DEFINED
        }
        unknown = {fluent_of(literal) for literal in doubtful | defined}
        return State(state.holds - doubtful - defined, state.unknown | unknown)

    def _group(self, fluent: clingo.Symbol) -> tuple[str, ...] | None:
        return _group(fluent, self.mutexes)


def _changed_unasked(knowledge: Knowledge, exclusions: Sequence[Mutex]) -> set[clingo.Symbol]:
    """The fluents that some exogenous action may change, with those that exclude them."""
    lines = list(fixed_rules(knowledge))
    signature = knowledge.signature
    for axiom in of_kind(knowledge, AxiomKind.CAUSAL_LAW):
        assert axiom.action is not None
        sorts = [
            f"sort({sort}, {argument})"
            for literal in (axiom.action, axiom.head)
            for argument, sort in zip(
                literal.arguments, signature.predicates[literal.predicate].sorts, strict=True
            )
        ]
        fluent = Literal(axiom.head.predicate, axiom.head.arguments)
        lines.append(rule(f"changed({fluent})", [f"exogenous({axiom.action})", *sorts]))
    control = BoundedControl("\n".join(lines), size=grounding_size(knowledge))
    changed = {atom.symbol.arguments[0] for atom in control.by_signature("changed", 1)}
    groups = {_group(symbol, exclusions) for symbol in changed} - {None}
    fluents = (atom.symbol.arguments[1] for atom in control.by_signature("fluent", 2))
    return changed | {symbol for symbol in fluents if _group(symbol, exclusions) in groups}


def _group(fluent: clingo.Symbol, exclusions: Sequence[Mutex]) -> tuple[str, ...] | None:
    for mutex in exclusions:
        if mutex.predicate == fluent.name:
            others = [
                str(term) for place, term in enumerate(fluent.arguments) if place != mutex.position
            ]
            return (fluent.name, *others)
    return None
