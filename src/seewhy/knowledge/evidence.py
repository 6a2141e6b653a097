"""What a scene's answer set offers to justify beliefs with: what was seen, what fired."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import chain

import clingo

from seewhy.knowledge.axiom import Axiom, Literal
from seewhy.knowledge.ground import key_of, literal_of, terms_of
from seewhy.knowledge.justification import Basis, Node
from seewhy.knowledge.reasoner import AnswerSet, Reasoner
from seewhy.knowledge.scene import FeatureVector, SceneSchema

Say = Callable[[Literal], str]
"""How a literal is said in words."""


@dataclass(frozen=True)
class Support:
    """An instance of an axiom that fires: its conditions hold."""

    axiom: Axiom
    binding: dict[str, str]


class Evidence:
    """The answer set of one scene, indexed for justifications.

    ``holds`` are the keys of the believed literals, ``supports`` the axiom instances that
    conclude each.
    """

    def __init__(
        self, reasoner: Reasoner, vector: FeatureVector, answer_set: AnswerSet, say: Say
    ) -> None:
        self.reasoner = reasoner
        self.schema = reasoner.schema
        self.signature = reasoner.knowledge.signature
        self.vector = dict(zip(self.schema.features, vector, strict=True))
        self.answer_set = answer_set
        self.say = say
        self.holds = {str(symbol) for symbol in answer_set.holds}
        self._founded_without: dict[frozenset[str], set[str]] = {}
        self.supports: dict[str, list[Support]] = {}
        for axiom in reasoner.knowledge.axioms:
            for values in answer_set.firings.get(axiom.identifier, ()):
                binding = dict(zip(axiom.variables, values, strict=True))
                self.supports.setdefault(key_of(axiom.head.substitute(binding)), []).append(
                    Support(axiom, binding)
                )

    def exceptions(self, key: str) -> list[Axiom]:
        """The defaults that were given up so that the literal is believed."""
        axioms = {axiom.identifier: axiom for axiom in self.reasoner.knowledge.axioms}
        given_up: list[Axiom] = []
        for identifier, values in self.answer_set.exceptions:
            axiom = axioms[identifier]
            binding = dict(zip(axiom.variables, values, strict=True))
            if key_of(axiom.head.substitute(binding).complement) == key:
                given_up.append(axiom)
        return given_up

    @cached_property
    def _given(self) -> set[str]:
        """The beliefs that need no axiom: what is seen, and exceptions to defaults."""
        return {
            key
            for key in self.holds
            if self.seen(literal_of(key)) is not None or self.exceptions(key)
        }

    def founded(self, above: frozenset[str]) -> set[str]:
        """The beliefs that can be justified without the literals above them."""
        founded = self._founded_without.get(above)
        if founded is not None:
            return founded
        founded = self._given - above
        while new := {
            key
            for key, supports in self.supports.items()
            if key not in founded
            and key not in above
            and any(self.rests_on(support, founded) for support in supports)
        }:
            founded |= new
        self._founded_without[above] = founded
        return founded

    def rests_on(self, support: Support, founded: set[str]) -> bool:
        """Whether all beliefs that the support needs are among those."""
        return all(
            not founded.isdisjoint(self.matching(condition.literal.substitute(support.binding)))
            for condition in support.axiom.body
            if condition.literal is not None
            and not condition.absent
            and condition.literal.predicate not in self.signature.sorts
        )

    def seen(self, literal: Literal) -> Node | None:
        """The node of a literal that the picture itself shows."""
        feature = self.schema.feature_of(literal)
        if feature is None:
            return None
        value = self.vector[feature]
        if value is None:
            return None
        shown = self.schema.features[feature][value]
        ruled_out = literal.complement in self.schema.features[feature].values()
        if key_of(literal) != key_of(shown) and not (ruled_out and literal.complement != shown):
            return None
        return Node(
            literal=str(literal),
            text=self.say(shown),
            basis=Basis.FEATURE,
            feature=feature,
            value=value,
        )

    def matching(self, literal: Literal) -> list[str]:
        """The beliefs that satisfy a condition; ``_`` matches anything, ``1..3`` each of three."""
        key = key_of(literal)
        if key in self.holds:
            return [key]
        wanted = [terms_of(argument) for argument in literal.arguments]
        if all(len(own) == 1 and "_" not in own for own in wanted):
            return []
        return [
            str(symbol)
            for symbol in sorted(self.answer_set.holds)
            if (symbol.name, symbol.positive) == (literal.predicate, literal.positive)
            and all(
                "_" in own or str(given) in own
                for own, given in zip(wanted, symbol.arguments, strict=True)
            )
        ]


def evidence_of(reasoner: Reasoner, vector: FeatureVector, *, say: Say = str) -> Evidence:
    """Return the evidence of a scene; where there is no answer set, what was seen alone."""
    answer_set = reasoner.answer_set(vector)
    if answer_set is None:
        seen = frozenset(chain.from_iterable(_observed(reasoner.schema, vector)))
        answer_set = AnswerSet(seen, {}, (), conflict=False)
    return Evidence(reasoner, vector, answer_set, say)


def _observed(schema: SceneSchema, vector: FeatureVector) -> Iterator[tuple[clingo.Symbol, ...]]:
    """For every feature the literals that are believed because of its value."""
    for literals, value in zip(schema.features.values(), vector, strict=True):
        if value is None:
            continue
        shown = [literals[value]]
        if all(literal.positive for literal in literals.values()):
            shown += [own.complement for other, own in literals.items() if other != value]
        yield tuple(clingo.parse_term(key_of(literal)) for literal in shown)
