"""The smallest change of features under which a class is believed."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import clingo

from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.grounding_size import grounding_size
from seewhy.knowledge.occurrence import Occurrence
from seewhy.knowledge.program import UNKNOWN, program_text
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector
from seewhy.knowledge.vector_index import Part

_CAN_OCCUR = "can_occur"
_EQUALLY_NEAR = 64  # so many are looked at


@dataclass(frozen=True)
class FeatureChange:
    """One feature that would have to be different; ``before`` is None where it is unknown."""

    feature: str
    before: str | None
    after: str


@dataclass(frozen=True)
class Change:
    """A set of feature changes and the feature vector that results.

    ``cost`` adds up the domain's cost of every changed feature.
    """

    changes: tuple[FeatureChange, ...]
    vector: FeatureVector
    cost: int


class ChangeFinder:
    """Finds the cheapest feature vectors under which a class is believed.

    An optimisation over answer sets, exact: candidates come in order of cost, among equals those
    whose numbers move least, and each is confirmed by the reasoner, because a class must be
    believed in every preferred answer set and not in one only. Of more than 64 that are equally
    near, 64 are looked at. Vectors that fail are ruled out for good, and so are values that never
    go together where only what can occur is looked for.

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
        self._constraints = 0

    @cached_property
    def _control(self) -> BoundedControl:
        control = BoundedControl(
            self._program(),
            size=grounding_size(self.reasoner.knowledge),
            arguments=["--opt-mode=optN", "--project=show"],
        )
        control.configuration.models = _EQUALLY_NEAR
        return control

    @cached_property
    def _literals(self) -> dict[str, int]:
        return {str(atom.symbol): atom.literal for atom in self._control.atoms}

    def _program(self) -> str:
        schema = self.schema
        lines = [program_text(self.reasoner.knowledge, schema, exceptions=True)]
        for feature, values in schema.features.items():
            choices = "; ".join(f"current({feature}, {value})" for value in (*values, UNKNOWN))
            cost = schema.change_costs.get(feature, 1)
            lines += [
                f"1 {{ {choices} }} 1.",
                f"changed({feature}, {cost}) :- current({feature}, V), not observed({feature}, V).",
                f":- observed({feature}, {UNKNOWN}), not current({feature}, {UNKNOWN}).",
            ]
            if all(value.lstrip("-").isdecimal() for value in values):
                lines.append(
                    f"moved({feature}, |V - W|) :- observed({feature}, V), current({feature}, W), "
                    f"V != {UNKNOWN}, W != {UNKNOWN}."
                )
        lines.append(f"{{ {_CAN_OCCUR} }}.")
        goals = "; ".join(f"goal({name})" for name in map(self._goal, schema.classes))
        lines.append(f"1 {{ {goals} }} 1.")
        for name, literal in schema.classes.items():
            lines.append(f":- goal({self._goal(name)}), not holds({literal}).")
        lines += [
            "#minimize { C@2, F : changed(F, C) }.",
            "#minimize { D@1, F : moved(F, D) }.",
            "#show observed/2.",
        ]
        return "\n".join(lines)

    def _goal(self, label: str) -> str:
        return f"c{list(self.schema.classes).index(label)}"

    def smallest(self, vector: FeatureVector, label: str, *, limit: int = 3) -> tuple[Change, ...]:
        """Return the cheapest changes that make ``label`` believed, at most ``limit`` of them.

        An empty tuple means that no feature vector makes the class believed; a change without
        feature changes means that it is believed already.

        Raises
        ------
        KeyError
            If there is no such class.
        """
        if label not in self.schema.classes:
            raise KeyError(label)
        if self.reasoner.decide(vector).label == label:
            return (Change((), vector, 0),)
        found: list[FeatureVector] = []
        if self.occurrence is not None:
            found = self._nearest(vector, label, self.occurrence)
        found = found or self._nearest(vector, label, None)
        changes = (self._change(vector, after) for after in found)
        return tuple(sorted(changes, key=_order)[:limit])

    def _nearest(
        self, vector: FeatureVector, label: str, occurrence: Occurrence | None
    ) -> list[FeatureVector]:
        """The vectors of least cost that are of a class and, with ``occurrence``, can occur."""
        can_occur = self._literals[_CAN_OCCUR]
        current = [
            self._literals[f"current({feature},{UNKNOWN if value is None else value})"]
            for feature, value in zip(self.schema.features, vector, strict=True)
        ]
        assumptions = [
            *current,
            self._literals["strict"],
            self._literals[f"goal({self._goal(label)})"],
            can_occur if occurrence is not None else -can_occur,
        ]
        while candidates := self._cheapest(assumptions):
            confirmed = [c for c in candidates if self.reasoner.decide(c).label == label]
            never = {c: occurrence.never_together(c) if occurrence else None for c in confirmed}
            if possible := [reached for reached, parts in never.items() if parts is None]:
                return possible
            for candidate in candidates:
                if candidate not in never:
                    self._rule_out(candidate, label)
            for parts in {parts for parts in never.values() if parts is not None}:
                self._keep_apart(parts)
        return []

    def _cheapest(self, assumptions: list[int]) -> list[FeatureVector]:
        def vector(model: clingo.Model) -> FeatureVector | None:
            if not model.optimality_proven:
                return None
            shown = {
                str(s.arguments[0]): str(s.arguments[1])
                for s in model.symbols(shown=True)
                if s.name == "observed"
            }
            return tuple(
                None if shown[feature] == UNKNOWN else shown[feature]
                for feature in self.schema.features
            )

        found = self._control.solve(assumptions, on_model=vector)
        return [candidate for candidate in dict.fromkeys(found) if candidate is not None]

    def _rule_out(self, vector: FeatureVector, label: str) -> None:
        """Forbid a vector that was tried in vain as a way to ``label``, now and later."""
        values = [UNKNOWN if value is None else value for value in vector]
        self._forbid(f"goal({self._goal(label)})", enumerate(values))

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
        cost = sum(self.schema.change_costs.get(change.feature, 1) for change in changes)
        return Change(changes=changes, vector=after, cost=cost)


def _order(change: Change) -> tuple[str, ...]:
    return tuple(f"{c.feature}={c.after}" for c in change.changes)
