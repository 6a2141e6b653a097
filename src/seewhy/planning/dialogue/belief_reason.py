"""Why something is believed: back through axioms and actions to observations and defaults."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property
from typing import Any

import clingo

from seewhy.errors import PlanningError
from seewhy.knowledge.axiom import Axiom, AxiomKind, Literal
from seewhy.knowledge.dynamics import constraints, gives_way, of_kind
from seewhy.knowledge.ground import complement_of, key_of
from seewhy.knowledge.history import History
from seewhy.knowledge.signature import PredicateKind
from seewhy.planning.diagnosis.diagnosis import Diagnosis, SurpriseKind, diagnose
from seewhy.planning.dialogue.instances import Instances, unified
from seewhy.planning.dialogue.surface_realisation import Speech
from seewhy.planning.domain import PlanningDomain


class Basis(StrEnum):
    """What a belief rests on."""

    OBSERVED = "observed"
    USUAL = "usual"
    EFFECT = "effect"
    FOLLOWS = "follows"
    UNCHANGED = "unchanged"
    NOTHING_ELSE = "nothing makes it so"
    EXPLAINS = "explains what was observed"
    GIVEN = "given"


@dataclass(frozen=True)
class Reason:
    """A belief with what it rests on.

    Attributes
    ----------
    literal : clingo.Symbol
    step : int
    basis : Basis
    text : str
        The belief as a clause.
    axiom : Axiom or None
        The default, causal law or constraint that gave it.
    action : clingo.Symbol or None
        What happened just before, where the belief is its effect.
    children : tuple of Reason
    """

    literal: clingo.Symbol
    step: int
    basis: Basis
    text: str
    axiom: Axiom | None = None
    action: clingo.Symbol | None = None
    children: tuple[Reason, ...] = ()

    def walk(self) -> Iterator[Reason]:
        """Yield this reason and all below it, parents first."""
        yield self
        for child in self.children:
            yield from child.walk()

    def to_dict(self) -> dict[str, Any]:
        """Return the tree as values that JSON can hold."""
        return {
            "literal": str(self.literal),
            "text": self.text,
            "step": self.step,
            "basis": self.basis.value,
            "axiom": None if self.axiom is None else self.axiom.text,
            "action": None if self.action is None else str(self.action),
            "children": [child.to_dict() for child in self.children],
        }


class Beliefs:
    """What is believed after a history, and why.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> domain = load_planning_domain("robot_assistant")
    >>> beliefs = Beliefs(domain, domain.history)
    >>> why = beliefs.why(clingo.parse_term("loc(sally,sallys_office)"), 0)
    >>> why.basis.value, why.axiom.text
    ('usual', 'people are in their own office unless they are elsewhere')
    """

    def __init__(self, domain: PlanningDomain, history: History) -> None:
        self.domain = domain
        self.history = history
        self.speech = Speech(domain.words)
        self.instances = Instances(domain.knowledge)

    @cached_property
    def diagnosis(self) -> Diagnosis:
        """The states of the history and its surprises."""
        return self._diagnosed(self.history)

    def holds(self, literal: clingo.Symbol, step: int) -> bool:
        """Whether the literal is believed of a step; what never changes, of every step."""
        if self._kind(literal) is PredicateKind.STATIC:
            return literal in self.instances.statics
        return literal in self.diagnosis.states[step].holds

    def positive(self, predicate: str | None, step: int) -> list[clingo.Symbol]:
        """The literals of a predicate that are believed of a step and are no denials, sorted."""
        fixed = (
            static
            for static in self.instances.statics
            if static.positive and static.name == predicate
        )
        return [*self.diagnosis.states[step].positive(predicate), *sorted(fixed)]

    def observed(self, literal: clingo.Symbol, step: int) -> bool:
        """Whether the literal was seen at a step, and not wrongly."""
        return (literal, step) in self.observations

    def why(self, literal: clingo.Symbol, step: int) -> Reason:
        """Return the reason of a belief."""
        return self._why(literal, step, frozenset())

    @cached_property
    def observations(self) -> set[tuple[clingo.Symbol, int]]:
        """What was seen at which step, without what was seen wrongly."""
        wrong = {
            (surprise.what, surprise.step)
            for surprise in self.diagnosis.surprises
            if surprise.kind is SurpriseKind.MISREADING
        }
        seen = (
            (_symbol(observation.literal), observation.step)
            for observation in self.history.observations
        )
        return {observed for observed in seen if observed not in wrong}

    def _happened(self, step: int) -> list[clingo.Symbol]:
        """What was done, or must have happened, at a step."""
        surprises = [surprise for surprise in self.diagnosis.surprises if surprise.step == step]
        failed = {surprise.what for surprise in surprises if surprise.kind is SurpriseKind.FAILURE}
        done = [
            _symbol(occurrence.action)
            for occurrence in self.history.occurrences
            if occurrence.step == step
        ]
        events = [surprise.what for surprise in surprises if surprise.kind is SurpriseKind.EVENT]
        return [action for action in done if action not in failed] + events

    def _why(
        self, literal: clingo.Symbol, step: int, above: frozenset[tuple[clingo.Symbol, int]]
    ) -> Reason:
        above |= {(literal, step)}
        if self._kind(literal) is PredicateKind.STATIC:
            return self._given(literal, step, above)
        reason = self._observed_or_caused(literal, step, above)
        if reason is not None:
            return reason
        followed = self._follows(literal, step, above)
        defined = self._kind(literal) is PredicateKind.FLUENT_DEFINED
        if defined:
            return followed or self._reason(literal, step, Basis.NOTHING_ELSE)
        for before in range(step - 1, -1, -1):
            if not self.holds(literal, before):
                break
            reason = self._observed_or_caused(literal, before, above)
            if reason is not None:
                return self._reason(literal, step, Basis.UNCHANGED, children=(reason,))
        if followed is not None:
            return followed
        if step > 0 and self.holds(literal, step - 1):
            first = step - 1
            while first > 0 and self.holds(literal, first - 1):
                first -= 1
            child = self._why(literal, first, above)
            return self._reason(literal, step, Basis.UNCHANGED, children=(child,))
        usual = self._usual(literal) if step == 0 else None
        return usual or self._explains(literal, step)

    def _observed_or_caused(
        self, literal: clingo.Symbol, step: int, above: frozenset[tuple[clingo.Symbol, int]]
    ) -> Reason | None:
        if self.observed(literal, step):
            return self._reason(literal, step, Basis.OBSERVED)
        if step == 0:
            return None
        before = self.diagnosis.states[step - 1].holds
        for action in self._happened(step - 1):
            for axiom in of_kind(self.domain.knowledge, AxiomKind.CAUSAL_LAW):
                for found in self.instances.of(axiom, before, head=literal, action=action):
                    return self._reason(
                        literal,
                        step,
                        Basis.EFFECT,
                        axiom=axiom,
                        action=action,
                        children=self._each((*found.holds, *found.statics), step - 1, above),
                    )
        return None

    def _follows(
        self, literal: clingo.Symbol, step: int, above: frozenset[tuple[clingo.Symbol, int]]
    ) -> Reason | None:
        state = self.diagnosis.states[step].holds
        for axiom in constraints(self.domain.knowledge):
            if gives_way(axiom, self.domain.knowledge.signature):
                continue
            for found in self.instances.of(axiom, state, head=literal):
                rests = (*found.holds, *found.counted, *found.statics)
                if not any((rest, step) in above for rest in rests):
                    children = self._each(rests, step, above)
                    return self._reason(
                        literal, step, Basis.FOLLOWS, axiom=axiom, children=children
                    )
        return None

    def _given(
        self, literal: clingo.Symbol, step: int, above: frozenset[tuple[clingo.Symbol, int]]
    ) -> Reason:
        """What never changes: known from the beginning, or from what is."""
        axioms = [
            axiom
            for axiom in self.domain.knowledge.without_change.axioms
            if axiom.head.predicate == literal.name
        ]
        for axiom in sorted(axioms, key=lambda axiom: len(axiom.body)):
            for found in self.instances.of(axiom, (), head=literal):
                rests = [other for other in found.statics if (other, step) not in above]
                if len(rests) < len(found.statics):
                    continue  # a round-about way to itself
                children = self._each(tuple(rests), step, above)
                basis = Basis.FOLLOWS if axiom.body else Basis.GIVEN
                return self._reason(literal, step, basis, axiom=found.axiom, children=children)
        return self._reason(literal, step, Basis.GIVEN)

    def _usual(self, literal: clingo.Symbol) -> Reason | None:
        knowledge = self.domain.knowledge
        state = self.diagnosis.states[0].holds
        giving_way = [
            constraint
            for constraint in constraints(knowledge)
            if gives_way(constraint, knowledge.signature)
        ]
        for axiom in (*of_kind(knowledge, AxiomKind.DEFAULT), *giving_way):
            if self.instances.of(axiom, state, head=literal):
                return self._reason(literal, 0, Basis.USUAL, axiom=axiom)
        return None

    def _explains(self, literal: clingo.Symbol, step: int) -> Reason:
        """The observations without which it would not be believed."""
        shown = []
        for observation in self.history.observations:
            less = tuple(other for other in self.history.observations if other is not observation)
            try:
                without = self._diagnosed(replace(self.history, observations=less))
            except PlanningError:
                continue
            if step >= len(without.states) or literal not in without.states[step].holds:
                shown.append(
                    self._reason(_symbol(observation.literal), observation.step, Basis.OBSERVED)
                )
        return self._reason(literal, step, Basis.EXPLAINS, children=tuple(shown))

    def counted(self, literal: clingo.Symbol, step: int) -> list[tuple[Axiom, list[clingo.Symbol]]]:
        """The axioms that count something to conclude a fluent, with what there is to count."""
        state = self.diagnosis.states[step].holds
        affirmed = literal if literal.positive else complement_of(literal)
        found = []
        for axiom in constraints(self.domain.knowledge):
            instance = unified(axiom, axiom.head, affirmed)
            if instance is not None and any(condition.is_local for condition in axiom.body):
                found.append((axiom, self.instances.counted(instance, state)))
        return found

    def _each(
        self,
        literals: tuple[clingo.Symbol, ...],
        step: int,
        above: frozenset[tuple[clingo.Symbol, int]],
    ) -> tuple[Reason, ...]:
        return tuple(
            self._why(literal, step, above)
            for literal in dict.fromkeys(literals)
            if (literal, step) not in above and self.holds(literal, step)
        )

    def _reason(
        self,
        literal: clingo.Symbol,
        step: int,
        basis: Basis,
        *,
        axiom: Axiom | None = None,
        action: clingo.Symbol | None = None,
        children: tuple[Reason, ...] = (),
    ) -> Reason:
        text = self.speech.say(literal)
        return Reason(literal, step, basis, text, axiom=axiom, action=action, children=children)

    def _kind(self, literal: clingo.Symbol) -> PredicateKind:
        return self.domain.knowledge.signature.kind(literal.name)

    def _diagnosed(self, history: History) -> Diagnosis:
        last = max(history.last_step, self.history.last_step)
        errors = self.domain.sensors_err
        return diagnose(self.domain.knowledge, history, last=last, sensors_err=errors)


def tell(reason: Reason, speech: Speech, *, now: int | None = None) -> list[str]:
    """Return the reason as sentences, the nearest first; what is before ``now`` as past."""
    told: list[str] = []
    _tell(reason, speech, told, now)
    return list(dict.fromkeys(told))


def _tell(reason: Reason, speech: Speech, told: list[str], now: int | None) -> None:
    said = speech.said(reason.literal)
    children = reason.children
    axiom = f'"{reason.axiom.text}"' if reason.axiom and reason.axiom.has_sentence else ""
    if reason.basis is Basis.OBSERVED:
        told.append(f"I saw at step {reason.step} that {said}")
    elif reason.basis is Basis.USUAL:
        told.append(f"it is usual that {reason.text}{': ' if axiom else ''}{axiom}")
    elif reason.basis is Basis.UNCHANGED:
        _tell_unchanged(children[0], speech, told, now)
        return
    elif reason.basis is Basis.EFFECT:
        assert reason.action is not None
        done = speech.happened(reason.action)
        told.append(f"{done} at step {reason.step - 1}{', and ' if axiom else ''}{axiom}")
    elif reason.basis is Basis.FOLLOWS:
        before = now is not None and reason.step < now
        since = together_said(children, speech, past=before)
        told.append(
            f"it follows {'from ' + axiom if axiom else 'from what I know'}"
            f"{': ' if since else ''}{since}"
        )
    elif reason.basis is Basis.GIVEN:
        told.append(f"I know that from the beginning{': ' if axiom else ''}{axiom}")
        return
    elif reason.basis is Basis.NOTHING_ELSE:
        told.append("nothing that I know of makes it otherwise")
        return
    else:
        since = together_said(children, speech, past=True)
        told.append(
            f"it explains what I saw: {since}" if since else "it explains best all that I saw"
        )
        return
    for child in _first_of_each(children):
        if child.basis is Basis.GIVEN or (
            child.literal.name in speech.words.fixed
            and reason.literal.name not in speech.words.fixed
        ):
            continue  # what never changes is no news
        _tell(child, speech, told, now)


def _tell_unchanged(child: Reason, speech: Speech, told: list[str], now: int | None) -> None:
    below: list[str] = []
    _tell(child, speech, below, now)
    told += [f"{below[0]}; nothing that I know of has changed it since", *below[1:]]


def _first_of_each(children: tuple[Reason, ...]) -> Iterator[Reason]:
    """Of reasons of the same kind, such as a count's, one."""
    seen = set()
    for reason in children:
        key = (reason.literal.name, reason.basis, reason.axiom and reason.axiom.identifier)
        if key not in seen:
            seen.add(key)
            yield reason


def together_said(reasons: tuple[Reason, ...], speech: Speech, *, past: bool = False) -> str:
    """The beliefs of several reasons as one clause."""
    literals = [reason.literal for reason in reasons]
    return speech.every_past(literals) if past else speech.every(literals)


def _symbol(literal: Literal) -> clingo.Symbol:
    return clingo.parse_term(key_of(literal))
