"""What a scene's class makes believed of a static that is no feature: its message, its response."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property, lru_cache

from seewhy.domain.domain import Domain
from seewhy.knowledge.axiom import Axiom, AxiomKind, Condition, Literal
from seewhy.knowledge.evidence import Evidence, Say, evidence_of
from seewhy.knowledge.ground import key_of
from seewhy.knowledge.justification import Node
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.reasoner import Reasoner, Verdict
from seewhy.knowledge.scene import FeatureVector
from seewhy.knowledge.signature import Location, Predicate, PredicateKind, Signature, Sort

_TOLD, _TERMS = "told__", "told_terms__"
_REMEMBERED = 1_000


def believed_values(domain: Domain, evidence: Evidence, predicate: str) -> tuple[str, ...]:
    """Return the values of a static of :attr:`Domain.beliefs` that are believed about a scene.

    Of several answer sets only what all of them share is believed.
    """
    literals = domain.beliefs[predicate].literals
    return tuple(
        value for value, literal in literals.items() if key_of(literal) in evidence.believed
    )


class ToldClass:
    """Beliefs about scenes whose class something else than the knowledge gave.

    The class's literal is added to the knowledge and to what is seen. Where what is seen leads to
    other classes or to contradictions, the class alone is told: it is what a question takes for
    granted. The program is grounded once, with the class as one more thing that is assumed.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> told = ToldClass(domain, Reasoner(domain.knowledge, domain.schema), say=str)
    >>> evidence = told.evidence(domain.vector({"num_blocks": "5"}), "stable")
    >>> sorted(key for key in evidence.holds if "stable" in key or "(structure,5)" in key)
    ['num_blocks(structure,5)', 'stable(structure)']
    """

    def __init__(self, domain: Domain, reasoner: Reasoner, *, say: Say) -> None:
        self.domain = domain
        self.reasoner = reasoner
        self.say = say
        # A term for every class: the names that users give need not be terms.
        self._terms = {label: f"c{number}" for number, label in enumerate(domain.classes)}
        self.evidence = lru_cache(maxsize=_REMEMBERED)(self._evidence)

    @cached_property
    def _telling(self) -> Reasoner:
        schema = self.domain.schema
        told = {
            term: Literal(predicate=_TOLD, arguments=(schema.scene, term))
            for term in self._terms.values()
        }
        return Reasoner(
            _with_told_classes(self.domain, told=tuple(told.values())),
            replace(schema, features={**schema.features, _TOLD: told}),
            minimality=self.reasoner.minimality,
        )

    def _evidence(self, vector: FeatureVector, label: str) -> Evidence:
        """What is believed about a scene of class ``label``, to justify beliefs with."""
        alone = (*(None for _ in vector), self._terms[label])
        if self.reasoner.decide(vector).verdict is Verdict.SILENT:
            seen = (*vector, self._terms[label])
            found = self._telling.answer_set(seen)
            if found is not None and not found.conflict:
                return evidence_of(self._telling, seen, say=self.say)
        return evidence_of(self._telling, alone, say=self.say)


def _with_told_classes(domain: Domain, *, told: Sequence[Literal]) -> Knowledge:
    """The knowledge with an axiom for every class: it is believed where it is told."""
    nowhere = Location(str(domain.knowledge.file), 0, 0)
    signature = domain.knowledge.signature
    terms = tuple(literal.arguments[1] for literal in told)
    sort = Sort(_TERMS, terms, nowhere)
    predicate = Predicate(_TOLD, (domain.scene, _TERMS), PredicateKind.STATIC, nowhere)
    axioms = [
        Axiom(
            identifier=f"{_TOLD}{number}",
            kind=AxiomKind.STATE_CONSTRAINT,
            head=scene_class.literal,
            body=(Condition(str(literal), literal),),
            text=f"{domain.subject} is known to be {scene_class.say}",
            location=nowhere,
        )
        for number, (scene_class, literal) in enumerate(
            zip(domain.classes.values(), told, strict=True)
        )
    ]
    return replace(
        domain.knowledge,
        signature=Signature(
            {**signature.sorts, sort.name: sort},
            {**signature.predicates, predicate.name: predicate},
        ),
        axioms=(*domain.knowledge.axioms, *axioms),
    )


def with_basis(justification: Node, basis: Node) -> Node:
    """Return a justification in which ``basis`` is why its literal is believed.

    It is what is told, too.
    """
    if justification.literal == basis.literal or justification.feature == _TOLD:
        return basis
    children = tuple(with_basis(child, basis) for child in justification.children)
    return replace(justification, children=children)
