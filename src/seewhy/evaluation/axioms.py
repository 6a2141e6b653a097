"""How often each axiom applies to annotated scenes, and how often it is right."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector

__all__ = ["AxiomRecord", "axiom_records"]


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
    schema = reasoner.schema
    fired: dict[FeatureVector, list[tuple[Axiom, str]]] = {}
    for vector in set(vectors):
        answer_set = reasoner.answer_set(vector)
        fired[vector] = []
        for axiom in reasoner.knowledge.axioms:
            for values in answer_set.firings.get(axiom.identifier, ()) if answer_set else ():
                head = axiom.head.substitute(dict(zip(axiom.variables, values, strict=True)))
                label = schema.class_of(head)
                if label is not None:
                    fired[vector].append((axiom, label))
    concludes = {axiom.identifier for of_vector in fired.values() for axiom, _ in of_vector}
    records = []
    for axiom in reasoner.knowledge.axioms:
        if axiom.identifier not in concludes and axiom.head.predicate not in {
            literal.predicate for literal in schema.classes.values()
        }:
            continue
        outcomes = [
            concluded == label
            for vector, label in zip(vectors, labels, strict=True)
            for firing, concluded in fired[vector]
            if firing.identifier == axiom.identifier
        ]
        records.append(
            AxiomRecord(axiom.identifier, str(axiom), axiom.text, len(outcomes), sum(outcomes))
        )
    return tuple(records)
