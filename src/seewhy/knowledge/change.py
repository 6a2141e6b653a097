"""The smallest change under which a class, or anything else, is believed."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import clingo

from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.bounded_control import SOLVING_SECONDS, BoundedControl, out_of_time
from seewhy.knowledge.ground import key_of, text_of
from seewhy.knowledge.grounding_size import GroundingSize, grounding_size
from seewhy.knowledge.occurrence import Occurrence
from seewhy.knowledge.program import CONTRADICTORY, UNKNOWN, program_text, without_exceptions
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector, SceneSchema
from seewhy.knowledge.stratified import is_stratified
from seewhy.knowledge.vector_index import Part

_CAN_OCCUR = "can_occur"
_EXCEPTED = "excepted"
_EQUALLY_NEAR = 64  # so many are looked at


@dataclass(frozen=True)
class FeatureChange:
    """One feature that would have to be different; ``before`` is None where it is unknown.

    A thing that would have to be there, or not, is a change of the feature that says so.
    """

    feature: str
    before: str | None
    after: str


@dataclass(frozen=True)
class Change:
    """A set of feature changes and the feature vector that results.

    ``cost`` adds up the domain's cost of every changed feature. What a thing is like that comes
    in costs nothing beyond that it comes in; it is named as far as it matters.
    """

    changes: tuple[FeatureChange, ...]
    vector: FeatureVector
    cost: int


class _Goal(NamedTuple):
    """What is to be believed, and what is not to be beside it; keys of literals."""

    believed: str
    apart_from: tuple[str, ...] = ()


class ChangeFinder:
    """Finds the cheapest feature vectors under which a class is believed.

    An optimisation over answer sets, exact: candidates come in order of cost, among equals those
    whose numbers move least, and each is confirmed by the reasoner, because a class must be
    believed in every preferred answer set and not in one only. Of stratified knowledge, candidates
    come without exceptions that no contradiction asks for, and a class comes without any other.
    Of more than 64 that are equally near, 64 are looked at. Vectors that fail are ruled out for
    good, and so are values that never go together where only what can occur is looked for.

    Parameters
    ----------
    reasoner : Reasoner
    occurrence : Occurrence, optional
        Vectors that cannot occur by it are proposed only where no other makes a class believed.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> finder = ChangeFinder(Reasoner(domain.knowledge, domain.schema))
    >>> vector = domain.vector({"num_blocks": "2", "base": "wide", "lean": "no",
    ...                         "block_displaced": "yes"})
    >>> [(c.feature, c.after) for c in finder.smallest(vector, "stable")[0].changes]
    [('block_displaced', 'no')]
    """

    def __init__(self, reasoner: Reasoner, occurrence: Occurrence | None = None) -> None:
        self.reasoner = reasoner
        self.schema = reasoner.schema
        self.occurrence = occurrence
        self._is_stratified = is_stratified(reasoner.knowledge)
        self._constraints = 0
        self._literals: dict[str, int] = {}
        self._goals: dict[_Goal, str] = {}

    @cached_property
    def _control(self) -> BoundedControl:
        control = BoundedControl(
            self._program(),
            size=self._size,
            arguments=["--opt-mode=optN", "--project=show", *_strategy(self.schema)],
        )
        control.configuration.models = _EQUALLY_NEAR
        return control

    @cached_property
    def _size(self) -> GroundingSize:
        knowledge = self.reasoner.knowledge
        size = grounding_size(knowledge)
        return size.times(2) if self._is_stratified and knowledge.has_defaults else size

    def _literal(self, atom: str) -> int:
        """The solver literal of an atom; those that were found once are not looked for again."""
        if atom not in self._literals:
            with self._control.lock:
                found = self._control.atoms[clingo.parse_term(atom)]
                assert found is not None, f"the program has no {atom}"
                self._literals[atom] = found.literal
        return self._literals[atom]

    def _program(self) -> str:
        schema, knowledge = self.schema, self.reasoner.knowledge
        lines = [program_text(knowledge, schema, exceptions=True)]
        if self._is_stratified and knowledge.has_defaults:
            lines += [
                without_exceptions(knowledge, schema),
                f"{_EXCEPTED} :- exception(I, V).",
                f":- {_EXCEPTED}, not {CONTRADICTORY}.",
            ]
        for feature, values in schema.features.items():
            choices = "; ".join(f"current({feature}, {value})" for value in (*values, UNKNOWN))
            cost = schema.change_costs.get(feature, 1)
            presences = schema.requires.get(feature, ())
            stays = "".join(f", not moves({presence})" for presence in presences)
            lines += [
                f"1 {{ {choices} }} 1.",
                f"changed({feature}, {cost}) :- current({feature}, V), not observed({feature}, V)"
                f"{stays}.",
                f":- observed({feature}, {UNKNOWN}), not current({feature}, {UNKNOWN}){stays}.",
            ]
            lines += [
                f"named({feature}) :- moves({presence}), not observed({feature}, {UNKNOWN})."
                for presence in presences
            ]
            if all(value.lstrip("-").isdecimal() for value in values):
                lines.append(
                    f"moved({feature}, |V - W|) :- observed({feature}, V), current({feature}, W), "
                    f"V != {UNKNOWN}, W != {UNKNOWN}."
                )
        lines += _coming_and_going(tuple(schema.presence.values()))
        lines.append(f"{{ {_CAN_OCCUR} }}.")
        lines += [
            "#minimize { C@2, F : changed(F, C) }.",
            "#minimize { D@1, F : moved(F, D) }.",
            "#minimize { 1@0, F : named(F) }.",
            "becomes(F, V) :- observed(F, V), not current(F, V).",
            "#show becomes/2.",
        ]
        return "\n".join(lines)

    @cached_property
    def _presences(self) -> frozenset[str]:
        return frozenset(self.schema.presence.values())

    def smallest(self, vector: FeatureVector, label: str, *, limit: int = 3) -> tuple[Change, ...]:
        """Return the cheapest changes that make ``label`` believed, at most ``limit`` of them.

        An empty tuple means that no feature vector makes the class believed; a change without
        feature changes means that it is believed already.

        Raises
        ------
        KeyError
            If there is no such class.
        ReasoningError
            If the search takes longer than 120 s.
        """
        others = {name: other for name, other in self.schema.classes.items() if name != label}
        return self._smallest(
            vector,
            _Goal(key_of(self.schema.classes[label]), tuple(map(key_of, others.values()))),
            lambda reached: self.reasoner.decide(reached).label == label,
            limit,
        )

    def smallest_for(
        self, vector: FeatureVector, literal: Literal, *, limit: int = 3
    ) -> tuple[Change, ...]:
        """Return the cheapest changes that make any literal believed, as :meth:`smallest` does.

        Examples
        --------
        >>> from seewhy.domain.domain import load_domain
        >>> domain = load_domain("structure_stability")
        >>> finder = ChangeFinder(Reasoner(domain.knowledge, domain.schema))
        >>> unstable = domain.classes["stable"].literal.complement
        >>> [c.changes[0].feature for c in finder.smallest_for(domain.vector({}), unstable)]
        ['block_displaced']
        """
        believed = clingo.parse_term(key_of(literal))
        return self._smallest(
            vector,
            _Goal(key_of(literal)),
            lambda reached: believed in self.reasoner.believed(reached),
            limit,
        )

    def _smallest(
        self,
        vector: FeatureVector,
        wanted: _Goal,
        is_reached: Callable[[FeatureVector], bool],
        limit: int,
    ) -> tuple[Change, ...]:
        if is_reached(vector):
            return (Change((), vector, 0),)
        goal = self._goal_atom(wanted)
        if goal is None:
            return ()
        found: list[FeatureVector] = []
        if self.occurrence is not None:
            found = self._nearest(vector, goal, is_reached, self.occurrence)
        found = found or self._nearest(vector, goal, is_reached, None)
        changes = (self._change(vector, after) for after in found)
        return tuple(sorted(changes, key=_order)[:limit])

    def _goal_atom(self, goal: _Goal) -> str | None:
        """The atom that stands for that a goal is reached, added to the program once.

        None where no scene has the belief.
        """
        # Threads share the program: two that have the same goal must not add it twice.
        with self._control.lock:
            if self._control.atoms[clingo.parse_term(f"holds({goal.believed})")] is None:
                return None
            if goal not in self._goals:
                atom = f"goal({len(self._goals)})"
                rules = [f"{{ {atom} }}.", f":- {atom}, not holds({goal.believed})."]
                if self._is_stratified:
                    # Without exceptions there is one answer set, and what it holds is believed.
                    rules += [
                        f":- {atom}, holds({key}), not {_EXCEPTED}." for key in goal.apart_from
                    ]
                self._control.add(f"goal_{len(self._goals)}", "\n".join(rules))
                if self._control.atoms[clingo.parse_term(atom)] is None:
                    return None  # no scene has an answer set at all
                self._goals[goal] = atom
            return self._goals[goal]

    def _nearest(
        self,
        vector: FeatureVector,
        goal: str,
        is_reached: Callable[[FeatureVector], bool],
        occurrence: Occurrence | None,
    ) -> list[FeatureVector]:
        """The vectors of least cost that reach a goal and, with ``occurrence``, can occur."""
        can_occur = self._literal(_CAN_OCCUR)
        with self._control.lock:
            goals = tuple(self._goals.values())
        current = [
            self._literal(f"current({feature},{UNKNOWN if value is None else value})")
            for feature, value in zip(self.schema.features, vector, strict=True)
        ]
        assumptions = [
            *current,
            self._literal("strict"),
            *(self._literal(other) if other == goal else -self._literal(other) for other in goals),
            can_occur if occurrence is not None else -can_occur,
        ]
        until = time.monotonic() + SOLVING_SECONDS
        while candidates := self._cheapest(vector, assumptions):
            confirmed = [candidate for candidate in candidates if is_reached(candidate)]
            never = {c: occurrence.never_together(c) if occurrence else None for c in confirmed}
            if possible := [reached for reached, parts in never.items() if parts is None]:
                return possible
            if time.monotonic() >= until:
                raise out_of_time(self._size, "the search for the smallest change", SOLVING_SECONDS)
            for candidate in candidates:
                if candidate not in never:
                    self._rule_out(candidate, goal)
            for parts in {parts for parts in never.values() if parts is not None}:
                self._keep_apart(parts)
        return []

    def _cheapest(self, vector: FeatureVector, assumptions: list[int]) -> list[FeatureVector]:
        before = dict(zip(self.schema.features, vector, strict=True))

        def after(model: clingo.Model) -> FeatureVector | None:
            if not model.optimality_proven:
                return None
            # What stays as it is would be hundreds of atoms to read, of every model.
            shown = (symbol.arguments for symbol in model.symbols(shown=True))
            becomes = {text_of(feature): text_of(value) for feature, value in shown}
            known = {f: None if value == UNKNOWN else value for f, value in becomes.items()}
            return tuple({**before, **known}.values())

        found = self._control.solve(assumptions, on_model=after)
        return [candidate for candidate in dict.fromkeys(found) if candidate is not None]

    def _rule_out(self, vector: FeatureVector, goal: str) -> None:
        """Forbid a vector that was tried in vain as a way to a goal, now and later."""
        values = [UNKNOWN if value is None else value for value in vector]
        self._forbid(goal, enumerate(values))

    def _keep_apart(self, parts: tuple[Part, ...]) -> None:
        """Forbid values together in what can occur, now and later."""
        self._forbid(_CAN_OCCUR, parts)

    def _forbid(self, atom: str, parts: Iterable[Part]) -> None:
        """Forbid an atom together with observed values."""
        features = list(self.schema.features)
        observed = ", ".join(f"observed({features[place]}, {value})" for place, value in parts)
        with self._control.lock:
            self._constraints += 1
            self._control.add(f"constraint_{self._constraints}", f":- {atom}, {observed}.")

    def _change(self, before: FeatureVector, after: FeatureVector) -> Change:
        changes = tuple(
            FeatureChange(feature=feature, before=old, after=new)
            for feature, old, new in zip(self.schema.features, before, after, strict=True)
            if old != new and new is not None
        )
        moved = {change.feature for change in changes if change.feature in self._presences}
        cost = sum(
            self.schema.change_costs.get(change.feature, 1)
            for change in changes
            if moved.isdisjoint(self.schema.requires.get(change.feature, ()))
        )
        return Change(changes=changes, vector=after, cost=cost)


def _strategy(schema: SceneSchema) -> tuple[str, ...]:
    """How clingo minimises: of hundreds of features of things, from below, by what cannot be kept.

    Of a few features of a picture, it is faster from above.
    """
    return ("--opt-strategy=usc",) if schema.presence else ()


def _coming_and_going(presences: Sequence[str]) -> Iterator[str]:
    """Yield what tells which things come in or are taken away.

    Of things that are not there, the first comes in first: any other would be another name for it.
    """
    for number, presence in enumerate(presences):
        yield f"moves({presence}) :- current({presence}, V), not observed({presence}, V)."
        for before in presences[:number]:
            yield (
                f":- observed({presence}, yes), not current({presence}, yes), "
                f"not observed({before}, yes), not current({before}, yes)."
            )


def _order(change: Change) -> tuple[str, ...]:
    return tuple(f"{c.feature}={c.after}" for c in change.changes)
