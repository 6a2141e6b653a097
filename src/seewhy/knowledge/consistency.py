"""Axioms that can never be used, because they contradict others or cannot apply."""

from __future__ import annotations

import clingo

from seewhy.errors import KnowledgeError
from seewhy.knowledge.axiom import Axiom, AxiomKind
from seewhy.knowledge.grounding import Grounding
from seewhy.knowledge.grounding_size import grounding_size
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.program import program_text
from seewhy.knowledge.scene import SceneSchema


def check_consistency(knowledge: Knowledge, schema: SceneSchema) -> None:
    """Refuse axioms that contradict others on every scene that they apply to.

    Axioms that contradict each other on some scenes only are knowledge that is incomplete: those
    scenes are left undecided. An axiom that never applies without a contradiction is a mistake.

    Raises
    ------
    KnowledgeError
        Names the first such axiom and the one that it contradicts.
    """
    probe = _Probe(knowledge, schema)
    for axiom in knowledge.axioms:
        if axiom.kind is AxiomKind.DEFAULT or not probe.can_fire(axiom, strict=False):
            continue
        if not probe.can_fire(axiom, strict=True):
            other = probe.opponent(axiom)
            against = (
                f"the axiom in line {other.location.line} ('{other}') concludes the opposite"
                if other
                else "the beliefs contradict each other"
            )
            raise KnowledgeError(
                f"{axiom.location}: '{axiom}' can never be used: whenever its conditions hold, "
                f"{against}; change or remove one of the two"
            )


def never_applies(knowledge: Knowledge, schema: SceneSchema) -> tuple[Axiom, ...]:
    """Return the axioms whose conditions no feature vector satisfies.

    A class that no axiom concludes is for the decision tree to tell; it may be or not.
    """
    concluded = {(axiom.head.predicate, axiom.head.positive) for axiom in knowledge.axioms}
    told = "; ".join(
        f"holds({literal})"
        for literal in schema.classes.values()
        if (literal.predicate, literal.positive) not in concluded
    )
    probe = _Probe(knowledge, schema, also=f"{{ {told} }}.\n")
    return tuple(a for a in knowledge.axioms if not probe.can_fire(a, strict=False))


class _Probe:
    """The program with its features left open, asked which axioms can fire."""

    def __init__(self, knowledge: Knowledge, schema: SceneSchema, *, also: str = "") -> None:
        self.knowledge = knowledge
        text = program_text(knowledge, schema, exceptions=True, firings=True)
        self.grounding = Grounding(
            text + also + "used(I) :- fires(I, V).\n", schema, size=grounding_size(knowledge)
        )
        self.used = self.grounding.with_predicate("used")
        self.exceptions = self.grounding.with_predicate("exception")

    def can_fire(self, axiom: Axiom, *, strict: bool) -> bool:
        return self._model(axiom, strict=strict) is not None

    def _model(self, axiom: Axiom, *, strict: bool) -> list[clingo.Symbol] | None:
        literal = self.used.get(clingo.Function("used", [clingo.Function(axiom.identifier)]))
        if literal is None:
            return None
        if strict:  # what is consistent once a default is given up can be used
            return self.grounding.first_model([literal, self.grounding.strict])
        none = [-exception for exception in self.exceptions.values()]
        return self.grounding.first_model([literal, -self.grounding.strict, *none])

    def opponent(self, axiom: Axiom) -> Axiom | None:
        """An axiom that fires with this one and concludes the opposite."""
        concluded: dict[str, set[str]] = {own.identifier: set() for own in self.knowledge.axioms}
        denied: set[str] = set()
        axioms = {own.identifier: own for own in self.knowledge.axioms}
        for symbol in self._model(axiom, strict=False) or []:
            if symbol.name == "fires":
                own = axioms[symbol.arguments[0].name]
                values = map(str, symbol.arguments[1].arguments)
                head = own.head.substitute(dict(zip(own.variables, values, strict=True)))
                concluded[own.identifier].add(str(clingo.parse_term(str(head))))
                if own is axiom:
                    denied.add(str(clingo.parse_term(str(head.complement))))
        return next((axioms[name] for name, heads in concluded.items() if heads & denied), None)
