"""Axioms that can never be used, because they contradict others or cannot apply."""

from __future__ import annotations

import clingo

from seewhy.errors import KnowledgeError
from seewhy.files.found_sound import FoundSound
from seewhy.knowledge.axiom import Axiom, AxiomKind
from seewhy.knowledge.ground import key_of
from seewhy.knowledge.grounding import Grounding, Search
from seewhy.knowledge.grounding_size import grounding_size
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.program import program_text
from seewhy.knowledge.scene import FeatureVector, SceneSchema

_SCENES = 1_000
"""The scenes that are looked at for one that an exception makes consistent."""

_SOUND = FoundSound("consistency 1")


def check_consistency(knowledge: Knowledge, schema: SceneSchema) -> None:
    """Refuse axioms that contradict others on every scene that they apply to.

    Axioms that contradict each other on some scenes only are knowledge that is incomplete: those
    scenes are left undecided. An axiom that never applies without a contradiction is a mistake,
    unless something gives way to it: a default that is given up for instance.

    Raises
    ------
    KnowledgeError
        Names the first such axiom and the one that it contradicts.
    """
    text = program_text(knowledge, schema, exceptions=True, firings=True)
    if text in _SOUND:
        return
    probe = _Probe(knowledge, schema, text)
    for axiom in knowledge.axioms:
        if axiom.kind is AxiomKind.DEFAULT or not probe.can_fire(axiom, strict=False):
            continue
        if not probe.can_fire(axiom, strict=True) and not probe.overrules(axiom):
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
    _SOUND.add(text)


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
    text = program_text(knowledge, schema, exceptions=True, firings=True)
    probe = _Probe(knowledge, schema, text + f"{{ {told} }}.\n")
    return tuple(a for a in knowledge.axioms if not probe.can_fire(a, strict=False))


class _Probe:
    """The program with its features left open, asked which axioms can fire."""

    def __init__(self, knowledge: Knowledge, schema: SceneSchema, program: str) -> None:
        self.knowledge = knowledge
        self.schema = schema
        self.grounding = Grounding(
            program + "used(I) :- fires(I, V).\n", schema, size=grounding_size(knowledge)
        )
        self.used = self.grounding.with_predicate("used", 1)
        self.exceptions = self.grounding.with_predicate("exception", 2)

    def can_fire(self, axiom: Axiom, *, strict: bool) -> bool:
        """Whether an axiom's conditions hold in some answer set; ``strict``: a consistent one."""
        assumed = self._assumed(axiom, strict=strict)
        return assumed is not None and self.grounding.satisfiable(assumed)

    def overrules(self, axiom: Axiom) -> bool:
        """Whether an axiom that contradicts others is heeded: something gives way to it.

        So it is where it applies to some scene that has a consistent answer set, in which it does
        not apply: one in which a default is given up, for instance. Where more scenes would have
        to be looked at than are worth it, it counts as such.
        """
        assumed = self._assumed(axiom, strict=False)
        if assumed is None:
            return False
        found = self.grounding.solve(assumed, Search(models=_SCENES), on_model=self._scene)
        scenes = dict.fromkeys(found)
        return len(found) == _SCENES or any(
            self.grounding.satisfiable([*self.grounding.assume(scene), self.grounding.strict])
            for scene in scenes
        )

    def _scene(self, model: clingo.Model) -> FeatureVector:
        return tuple(
            next(
                value
                for value in (None, *values)
                if model.is_true(self.grounding.observed(feature, value))
            )
            for feature, values in self.schema.features.items()
        )

    def _assumed(self, axiom: Axiom, *, strict: bool) -> list[int] | None:
        literal = self.used.get(clingo.Function("used", [clingo.Function(axiom.identifier)]))
        if literal is None:
            return None
        if strict:  # what is consistent once a default is given up can be used
            return [literal, self.grounding.strict]
        return [
            literal,
            -self.grounding.strict,
            *(-exception for exception in self.exceptions.values()),
        ]

    def opponent(self, axiom: Axiom) -> Axiom | None:
        """An axiom that fires with this one and concludes the opposite."""
        concluded: dict[str, set[str]] = {
            candidate.identifier: set() for candidate in self.knowledge.axioms
        }
        denied: set[str] = set()
        axioms = {candidate.identifier: candidate for candidate in self.knowledge.axioms}
        assumed = self._assumed(axiom, strict=False) or []
        for symbol in self.grounding.first_model(assumed) or []:
            if symbol.name == "fires":
                other = axioms[symbol.arguments[0].name]
                values = map(str, symbol.arguments[1].arguments)
                head = other.head.substitute(dict(zip(other.variables, values, strict=True)))
                concluded[other.identifier].add(key_of(head))
                if other is axiom:
                    denied.add(key_of(head.complement))
        return next((axioms[name] for name, heads in concluded.items() if heads & denied), None)
