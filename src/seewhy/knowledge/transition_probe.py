"""Ask about all states at once: is there one in which this can be done, and what follows it?"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import clingo

from seewhy.knowledge.axiom import Axiom, AxiomKind, Literal
from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.dynamics import (
    STEP,
    body_at,
    constraints,
    fixed_rules,
    gives_way,
    of_kind,
    rule,
)
from seewhy.knowledge.ground import complement_of, key_of
from seewhy.knowledge.grounding_size import grounding_size
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.signature import PredicateKind
from seewhy.knowledge.symmetry import first_of_each, interchangeable

# Every state is tried as the first one; each of the others is a state that may follow it.
_PROGRAM = """
at(T, T) :- step(T).
1 { holds(F, 0); holds(-F, 0) } 1 :- fluent(basic, F).
holds(-F, T) :- fluent(defined, F), step(T), not holds(F, T).
:- holds(F, 0), holds(-F, 0).
holds(F, T) :- fluent(basic, F), holds(F, 0), not holds(-F, T), step(T), T > 0.
holds(-F, T) :- fluent(basic, F), holds(-F, 0), not holds(F, T), step(T), T > 0.
1 { occurs(A) : named(N, A) } 1 :- doing(N).
{ consistent }.
:- consistent, holds(F, T), holds(-F, T).
#minimize { 1, F : holds(F, 1), holds(-F, 1) }.
#defined used/1. #defined doing/1. #defined named/2. #defined action/1. #defined exogenous/1.
"""
_ASKED_FOR = frozenset({"applies", "consistent", "doing", "occurs", "used"})
"""The atoms that are assumed, beside what holds."""
_TWO_FOLLOW = """
differs(F) :- fluent(basic, F), holds(F, 1), holds(-F, 2).
:- not differs(_).
"""
# Where objects change places, what differs is that of others: one of each such choice is enough.
_ONE_OF_EACH = """
done(A) :- occurs(A).
done(nothing__) :- not occurs(_).
witnessed :- done(A), differs(F), first(A, F).
:- not witnessed.
"""


@dataclass(frozen=True)
class Found:
    """A state, what is done in it, and what follows.

    Attributes
    ----------
    action : clingo.Symbol or None
    conclusions : tuple of (str, clingo.Symbol, int)
        The axioms that conclude something in a state that follows, what, and in which.
    contradicted : frozenset of clingo.Symbol
        The fluents that would be both true and false.
    differing : frozenset of clingo.Symbol
        The fluents that are true in one of two states that may follow, and false in the other.
    """

    action: clingo.Symbol | None
    conclusions: tuple[tuple[str, clingo.Symbol, int], ...]
    contradicted: frozenset[clingo.Symbol]
    differing: frozenset[clingo.Symbol]


class TransitionProbe:
    """All states that the constraints allow, and for each what may be done and may follow.

    ``following`` is how many states after the first are looked at: none (what is possible), one
    (what follows), or two that may both follow the same one and differ.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge('''
    ... #fluent basic lit. #action press. press causes lit. impossible press if lit.
    ... -lit.
    ... ''')
    >>> law, = of_kind(known, AxiomKind.CAUSAL_LAW)
    >>> TransitionProbe(known, following=0).is_possible(action="press", applies=law)
    True
    >>> TransitionProbe(known, following=1).is_possible(action="press", applies=law)
    False
    """

    def __init__(self, knowledge: Knowledge, *, following: int) -> None:
        self.control = BoundedControl(
            "\n".join(_rules(knowledge, following)),
            size=grounding_size(knowledge).times(following + 1),
        )
        # To read an atom as text takes longer than to find it: of most nobody asks.
        self._literals = {
            str(atom.symbol): atom.literal
            for atom in self.control.atoms
            if atom.symbol.name in _ASKED_FOR
        }
        self.actions = [
            n for n, predicate in knowledge.signature.predicates.items() if predicate.kind.is_action
        ]
        self.guarded = [
            axiom for axiom in knowledge.axioms if f"used({axiom.identifier})" in self._literals
        ]

    def find(
        self,
        *,
        action: str | None = None,
        applies: Axiom | None = None,
        without: Collection[Axiom] = (),
        contradictions: bool = False,
    ) -> Found | None:
        """Return some state with these properties, None where there is no such state.

        Parameters
        ----------
        action : str, optional
            The predicate of the one action that happens; by default nothing happens.
        applies : Axiom, optional
            A causal law of the action that applies.
        without : collection of Axiom
            Constraints, executability conditions and defaults to leave out.
        contradictions : bool
            Whether what follows may contradict itself.
        """
        assumed = self._assumed(action, applies, without, contradictions=contradictions)
        if assumed is None:
            return None
        found = self.control.solve(assumed, on_model=_shown, last_only=True)
        return _read(found[-1]) if found else None

    def is_possible(
        self,
        *,
        action: str | None = None,
        applies: Axiom | None = None,
        without: Collection[Axiom] = (),
        done: Literal | None = None,
        holds: Literal | None = None,
    ) -> bool:
        """Return whether there is some state with these properties; see :meth:`find`.

        ``done`` is the one action that happens, with its arguments; ``holds`` is a fluent that is
        so in the state.
        """
        name = action if done is None else done.predicate
        assumed = self._assumed(name, applies, without)
        atoms = [f"occurs({key_of(done)})"] if done is not None else []
        if assumed is None or any(atom not in self._literals for atom in atoms):
            return False
        if holds is not None:
            if key_of(holds) not in self._at_first:
                return False
            assumed.append(self._at_first[key_of(holds)])
        return self.control.satisfiable([*assumed, *(self._literals[atom] for atom in atoms)])

    @cached_property
    def _at_first(self) -> dict[str, int]:
        """What holds in the state that is asked about."""
        return {
            str(atom.symbol.arguments[0]): atom.literal
            for atom in self.control.atoms
            if atom.match("holds", 2) and atom.symbol.arguments[1] == clingo.Number(0)
        }

    def _assumed(
        self,
        action: str | None,
        applies: Axiom | None,
        without: Collection[Axiom],
        *,
        contradictions: bool = False,
    ) -> list[int] | None:
        """What is asked for; None where an atom that is wanted can never be true."""
        dropped = {axiom.identifier for axiom in without}
        wanted = [] if contradictions else ["consistent"]
        wanted += [f"applies({applies.identifier})"] if applies else []
        if any(atom not in self._literals for atom in wanted):
            return None
        assumed = [self._literals[atom] for atom in wanted]
        for name in self.actions:
            literal = self._literals[f"doing({name})"]
            assumed.append(literal if name == action else -literal)
        for axiom in self.guarded:
            literal = self._literals[f"used({axiom.identifier})"]
            assumed.append(-literal if axiom.identifier in dropped else literal)
        return assumed

    def smallest_conflict(
        self,
        axioms: Sequence[Axiom],
        *,
        action: str | None = None,
        without: Sequence[Axiom] = (),
        done: Literal | None = None,
        holds: Literal | None = None,
    ) -> list[Axiom]:
        """Return those of ``axioms`` that leave no state; without any of them there is one.

        None are returned where there is no such state without all of them, either.
        """
        needed = list(axioms)
        for axiom in axioms:
            fewer = [other for other in needed if other is not axiom]
            dropped = [*without, *(other for other in axioms if other not in fewer)]
            if not self.is_possible(action=action, without=dropped, done=done, holds=holds):
                needed = fewer
        return needed


def _rules(knowledge: Knowledge, following: int) -> Iterator[str]:
    signature = knowledge.signature
    yield from fixed_rules(knowledge)
    yield f"step(0..{following})."
    for predicate in signature.predicates.values():
        if predicate.kind.is_action:
            terms = ", ".join(f"X{place}" for place in range(len(predicate.sorts)))
            atom = f"{predicate.name}({terms})" if terms else predicate.name
            for kind in ("action", "exogenous"):
                yield f"named({predicate.name}, {atom}) :- {kind}({atom})."
            yield f"{{ doing({predicate.name}) }}."
    for axiom in constraints(knowledge):
        used = f"used({axiom.identifier})"
        yield f"{{ {used} }}."
        if gives_way(axiom, signature):
            usual = [
                condition for condition in axiom.body if condition.literal != axiom.head.complement
            ]
            body = body_at(replace(axiom, body=tuple(usual)), signature, "0")
            yield rule("", [*body, f"holds({axiom.head.complement}, 0)", used])
            continue
        body = [*body_at(axiom, signature, STEP), f"step({STEP})", used]
        yield rule(f"holds({axiom.head}, {STEP})", body)
        yield rule(f"concludes({axiom.identifier}, {axiom.head}, {STEP})", body)
    for axiom in of_kind(knowledge, AxiomKind.DEFAULT):
        used = f"used({axiom.identifier})"
        yield f"{{ {used} }}."
        body = body_at(axiom, signature, "0")
        yield rule("", [*body, f"holds({axiom.head.complement}, 0)", used])
    for axiom in of_kind(knowledge, AxiomKind.CAUSAL_LAW):
        body = [f"occurs({axiom.action})", *body_at(axiom, signature, "0")]
        yield rule(f"applies({axiom.identifier})", body)
        body += [f"step({STEP})", f"{STEP} > 0"]
        yield rule(f"holds({axiom.head}, {STEP})", body)
        yield rule(f"concludes({axiom.identifier}, {axiom.head}, {STEP})", body)
    for axiom in of_kind(knowledge, AxiomKind.EXECUTABILITY_CONDITION):
        used = f"used({axiom.identifier})"
        yield f"{{ {used} }}."
        yield rule("", [f"occurs({axiom.action})", *body_at(axiom, signature, "0"), used])
    yield _PROGRAM
    if following == 2:
        yield _TWO_FOLLOW
        yield from _first_of_each(knowledge)


def _first_of_each(knowledge: Knowledge) -> Iterator[str]:
    """Rules by which two states differ in one of each choice of objects that are alike."""
    signature = knowledge.signature
    groups = interchangeable(knowledge)
    if not groups:
        return
    predicates = signature.predicates.values()
    done = [(p.name, p.sorts) for p in predicates if p.kind.is_action]
    facts: list[str] = []
    for action, sorts in (("nothing__", ()), *done):
        for fluent in predicates:
            if fluent.kind is not PredicateKind.FLUENT_BASIC:
                continue
            places = [signature.members(sort) for sort in (*sorts, *fluent.sorts)]
            chosen = first_of_each(groups, places)
            if chosen is None:
                return
            for members in chosen:
                atoms = (
                    Literal(action, members[: len(sorts)]),
                    Literal(fluent.name, members[len(sorts) :]),
                )
                facts.append(f"first({atoms[0]}, {atoms[1]}).")
    yield _ONE_OF_EACH
    yield " ".join(facts)


def _shown(model: clingo.Model) -> list[clingo.Symbol]:
    return list(model.symbols(atoms=True))


def _read(model: list[clingo.Symbol]) -> Found:
    occurs = [atom.arguments[0] for atom in model if atom.name == "occurs"]
    after = {
        atom.arguments[0]
        for atom in model
        if atom.name == "holds" and len(atom.arguments) == 2 and str(atom.arguments[1]) == "1"
    }
    return Found(
        action=occurs[0] if occurs else None,
        conclusions=tuple(
            sorted(
                (str(atom.arguments[0]), atom.arguments[1], atom.arguments[2].number)
                for atom in model
                if atom.name == "concludes"
            )
        ),
        contradicted=frozenset(
            fluent for fluent in after if fluent.positive and complement_of(fluent) in after
        ),
        differing=frozenset(atom.arguments[0] for atom in model if atom.name == "differs"),
    )
