"""The instances of axioms that could fire in some scene, and what each of them asks for."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import clingo

from seewhy.knowledge.axiom import (
    Axiom,
    AxiomKind,
    Condition,
    Literal,
    predicates_in,
    substitute,
    variables_in,
)
from seewhy.knowledge.ground import key_of, predicate_of, text_of
from seewhy.knowledge.grounding import Grounding
from seewhy.knowledge.grounding_size import GroundingSize
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.scene import SceneSchema
from seewhy.knowledge.settling import JointCondition

_CONSTANT = re.compile(r"_*[a-z][A-Za-z0-9_']*|-?[0-9]+")


class Belief(NamedTuple):
    """That a literal is believed, or that it is not.

    Attributes
    ----------
    key : str
        The literal as clingo prints it.
    holds : bool
        False where the literal is not believed.
    """

    key: str
    holds: bool = True


Asked = Belief | JointCondition
"""What a condition asks for: one belief or its absence, or something of several literals."""


@dataclass(frozen=True)
class Instance:
    """An axiom with values for its variables.

    Attributes
    ----------
    axiom : Axiom
    values : tuple of str
        Of the axiom's variables, in their order.
    """

    axiom: Axiom
    values: tuple[str, ...]

    @cached_property
    def binding(self) -> dict[str, str]:
        """Variable → value."""
        return dict(zip(self.axiom.variables, self.values, strict=True))

    @cached_property
    def head(self) -> str:
        """The key of the literal that it concludes."""
        return key_of(self.axiom.head.substitute(self.binding))

    @property
    def given_way(self) -> Belief | None:
        """What a default asks for beyond its conditions: that its opposite is not believed."""
        if self.axiom.kind is not AxiomKind.DEFAULT:
            return None
        return Belief(key_of(self.axiom.head.substitute(self.binding).complement), holds=False)


def instances_by_head(
    axioms: Iterable[Axiom], firing: Mapping[str, Sequence[tuple[str, ...]]]
) -> dict[str, list[Instance]]:
    """Return the instances of axioms, by the key of what they conclude.

    Parameters
    ----------
    axioms : iterable of Axiom
    firing : mapping of str to sequence
        Axiom identifier → the values of its variables.
    """
    found: dict[str, list[Instance]] = {}
    for axiom in axioms:
        head = _head_of(axiom)
        for values in firing.get(axiom.identifier, ()):
            found.setdefault(head(values), []).append(Instance(axiom, values))
    return found


def _head_of(axiom: Axiom) -> Callable[[tuple[str, ...]], str]:
    """What an axiom concludes, by the values of its variables."""
    head = axiom.head
    if not head.arguments or not set(head.arguments) <= set(axiom.variables):
        return lambda values: Instance(axiom, values).head
    # Of plain variables the key is put together, which nothing has to be parsed for.
    places = [axiom.variables.index(argument) for argument in head.arguments]
    before = f"{'' if head.positive else '-'}{head.predicate}("
    return lambda values: f"{before}{','.join([values[place] for place in places])})"


class PossibleInstances:
    """What the program that was grounded for all scenes says that some scene could have.

    clingo leaves out the instances that no scene can have, and with them their literals: what is
    left is small, and whatever is not in it is never believed.

    Parameters
    ----------
    knowledge : Knowledge
    schema : SceneSchema
    grounding : Grounding
        Of the program with ``fires``.
    size : GroundingSize
    """

    def __init__(
        self, knowledge: Knowledge, schema: SceneSchema, grounding: Grounding, size: GroundingSize
    ) -> None:
        self.size = size
        self.knowledge = knowledge
        self.schema = schema
        self.signature = knowledge.signature
        self._grounding = grounding
        self._axioms = {axiom.identifier: axiom for axiom in knowledge.axioms}
        self._asked: dict[tuple[str, tuple[str, ...]], tuple[tuple[int, Asked], ...]] = {}
        self._joint: dict[str, JointCondition] = {}
        self._concluding: dict[tuple[str, bool], dict[str, list[Instance]]] = {}

    @cached_property
    def _instances(self) -> dict[str, list[tuple[str, ...]]]:
        """The values of every axiom's variables, axiom by axiom."""
        found: dict[str, list[tuple[str, ...]]] = {}
        for symbol in sorted(self._grounding.with_predicate("fires", 2)):
            name, values = symbol.arguments
            found.setdefault(name.name, []).append(tuple(map(text_of, values.arguments)))
        return found

    @cached_property
    def literals(self) -> dict[str, tuple[clingo.Symbol, ...]]:
        """Predicate → the literals of it, affirmed and denied, that some scene could have."""
        found: dict[str, list[clingo.Symbol]] = {}
        for symbol in sorted(self._grounding.with_predicate("holds", 1)):
            found.setdefault(symbol.arguments[0].name, []).append(symbol.arguments[0])
        return {name: tuple(symbols) for name, symbols in found.items()}

    @cached_property
    def can_have_exceptions(self) -> bool:
        """Whether some scene could have an exception to a default."""
        return bool(self._grounding.with_predicate("exception", 2))

    def can_hold(self, belief: Belief) -> bool:
        """Whether a literal is believed in some scene."""
        return belief.key in self._keys

    @cached_property
    def _keys(self) -> frozenset[str]:
        return frozenset(
            text_of(symbol) for symbols in self.literals.values() for symbol in symbols
        )

    def concluding(self, key: str) -> list[Instance]:
        """The instances that conclude a literal in some scene."""
        kind = (predicate_of(key), not key.startswith("-"))
        if kind not in self._concluding:
            axioms = [
                axiom
                for axiom in self.knowledge.axioms
                if (axiom.head.predicate, axiom.head.positive) == kind
            ]
            self._concluding[kind] = instances_by_head(axioms, self._instances)
        return self._concluding[kind].get(key, [])

    def asked(self, instance: Instance) -> tuple[tuple[int, Asked], ...]:
        """What the conditions of an instance ask for, each with its place in the axiom.

        Sorts and comparisons are left out: an instance for which they fail is none. Last, at the
        place behind the conditions, stands what a default asks for.
        """
        place = (instance.axiom.identifier, instance.values)
        if place not in self._asked:
            body = instance.axiom.body
            asked = [
                (number, found)
                for number, condition in enumerate(body)
                if (found := self.asked_by(condition, instance.binding)) is not None
            ]
            if instance.given_way is not None:
                asked.append((len(body), instance.given_way))
            self._asked[place] = tuple(asked)
        return self._asked[place]

    def asked_by(self, condition: Condition, binding: Mapping[str, str]) -> Asked | None:
        """What one condition asks for; None where it speaks of no literal."""
        literal = condition.literal
        if literal is not None:
            if self.signature.is_given(literal.predicate):
                return None
            literal = literal.substitute(binding)
            if all(map(_CONSTANT.fullmatch, literal.arguments)) or _is_one(literal):
                return Belief(key_of(literal), not condition.absent)
        elif not predicates_in(condition.text) - self.signature.given_sorts:
            return None
        text = substitute(condition.text, binding)
        if text not in self._joint:
            self._joint[text] = JointCondition(
                text, self.signature, self.schema, self.literals, size=self.size
            )
        return self._joint[text]


def _is_one(literal: Literal) -> bool:
    """Whether a literal is a single one once its arithmetic is evaluated."""
    if any(argument == "_" or variables_in(argument) for argument in literal.arguments):
        return False
    try:
        clingo.parse_term(key_of(literal), logger=lambda *_: None)
    except RuntimeError:
        return False
    return True
