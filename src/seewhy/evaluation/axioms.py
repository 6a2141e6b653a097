"""How often each axiom applies to annotated scenes, and how often it is right."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector

__all__ = ["AxiomRecord", "axiom_outcomes", "axiom_records"]


@dataclass(frozen=True)
class AxiomRecord:
    """How often an axiom applied to annotated scenes and how often it was right."""

    identifier: str
    statement: str
    text: str
    decided: int
    right: int

    @property
    def accuracy(self) -> float | None:
        """Of the scenes that it decides, the share decided rightly; None where it decides none."""
        return self.right / self.decided if self.decided else None


def axiom_records(
    reasoner: Reasoner, vectors: Sequence[FeatureVector], labels: Sequence[str]
) -> tuple[AxiomRecord, ...]:
    """Count for every axiom that concludes a class the scenes that it decides, and rightly.

    An axiom decides a scene when it fires on the annotated features, whatever others conclude.
    """
    found = axiom_outcomes(reasoner, vectors, labels)
    return tuple(
        AxiomRecord(
            axiom.identifier,
            str(axiom),
            axiom.text,
            len(found[axiom.identifier]),
            sum(right for _, right in found[axiom.identifier]),
        )
        for axiom in reasoner.knowledge.axioms
        if axiom.identifier in found
    )


def axiom_outcomes(
    reasoner: Reasoner, vectors: Sequence[FeatureVector], labels: Sequence[str]
) -> dict[str, tuple[tuple[int, bool], ...]]:
    """Return which scenes each axiom decides that concludes a class, and whether rightly.

    Returns
    -------
    dict of str to tuple of (int, bool)
        Axiom's identifier → the places of the scenes; none for an axiom that decides none.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> vectors = [("2", "wide", "no", "yes"), ("2", "wide", "no", "no")]
    >>> reasoner = Reasoner(domain.knowledge, domain.schema)
    >>> axiom_outcomes(reasoner, vectors, ["unstable", "stable"])["a1"]
    ((0, True),)
    """
    schema = reasoner.schema
    fired: dict[FeatureVector, list[tuple[str, str]]] = {}
    for vector in set(vectors):
        answer_set = reasoner.answer_set(vector)
        fired[vector] = []
        for axiom in reasoner.knowledge.axioms:
            for values in answer_set.firings.get(axiom.identifier, ()) if answer_set else ():
                head = axiom.head.substitute(dict(zip(axiom.variables, values, strict=True)))
                label = schema.class_of(head)
                if label is not None:
                    fired[vector].append((axiom.identifier, label))
    concludes = {identifier for of_vector in fired.values() for identifier, _ in of_vector}
    of_classes = {literal.predicate for literal in schema.classes.values()}
    return {
        axiom.identifier: tuple(
            (place, concluded == label)
            for place, (vector, label) in enumerate(zip(vectors, labels, strict=True))
            for identifier, concluded in fired[vector]
            if identifier == axiom.identifier
        )
        for axiom in reasoner.knowledge.axioms
        if axiom.identifier in concludes or axiom.head.predicate in of_classes
    }
