"""How the axioms of a domain stand among the labelled pictures: support, exceptions, conflicts."""

from __future__ import annotations

from dataclasses import dataclass

from seewhy.agent.learning_from_pictures import AnnotatedScenes
from seewhy.agent.things.thing_axioms import as_few_things
from seewhy.domain.domain import Domain
from seewhy.evaluation import axiom_outcomes
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.reasoner import Reasoner, Verdict

__all__ = ["AxiomStanding", "RulesStanding", "rules_standing"]

_CONFLICTS = (Verdict.CONTRADICTION, Verdict.SEVERAL, Verdict.NO_ANSWER_SET)


@dataclass(frozen=True)
class AxiomStanding:
    """An axiom, and the labelled pictures that it decides.

    Attributes
    ----------
    axiom : Axiom
    concludes : bool
        Whether it concludes a class, so that labels can speak for or against it.
    right, wrong : tuple of str
        Pictures; the wrong ones are its exceptions.
    """

    axiom: Axiom
    concludes: bool
    right: tuple[str, ...]
    wrong: tuple[str, ...]


@dataclass(frozen=True)
class RulesStanding:
    """All axioms, and what they make of the labelled pictures together.

    Attributes
    ----------
    axioms : tuple of AxiomStanding
    pictures : int
        How many are labelled with a class.
    right : int
        How many of them the axioms decide rightly.
    wrong, undecided, conflicting : tuple of str
        Pictures that are decided wrongly, that no axiom decides, and on which axioms contradict
        each other.
    """

    axioms: tuple[AxiomStanding, ...]
    pictures: int
    right: int
    wrong: tuple[str, ...]
    undecided: tuple[str, ...]
    conflicting: tuple[str, ...]


def rules_standing(domain: Domain, scenes: AnnotatedScenes) -> RulesStanding:
    """Decide labelled pictures by the axioms of a domain.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> vectors = (("4", "wide", "no", "yes"), ("4", "wide", "no", "yes"))
    >>> scenes = AnnotatedScenes(vectors, ("unstable", "stable"), ("a.png", "b.png"))
    >>> found = rules_standing(load_domain("structure_stability"), scenes)
    >>> found.axioms[0].right, found.axioms[0].wrong, found.right
    (('a.png',), ('b.png',), 1)
    """
    if domain.things is not None:
        domain, scenes = as_few_things(domain, scenes)
    reasoner = Reasoner(domain.knowledge, domain.schema)
    outcomes = axiom_outcomes(reasoner, scenes.vectors, scenes.labels)
    decisions = reasoner.decide_all(scenes.vectors)
    rows = list(zip(scenes.pictures, scenes.labels, decisions, strict=True))

    def decided(axiom: Axiom, rightly: bool) -> tuple[str, ...]:
        of_axiom = outcomes.get(axiom.identifier, ())
        return tuple(scenes.pictures[place] for place, right in of_axiom if right is rightly)

    return RulesStanding(
        axioms=tuple(
            AxiomStanding(
                axiom, axiom.identifier in outcomes, decided(axiom, True), decided(axiom, False)
            )
            for axiom in domain.knowledge.axioms
        ),
        pictures=len(rows),
        right=sum(decision.label == label for _, label, decision in rows),
        wrong=tuple(
            picture for picture, label, decision in rows if decision.label not in (None, label)
        ),
        undecided=tuple(
            picture for picture, _, decision in rows if decision.verdict is Verdict.SILENT
        ),
        conflicting=tuple(
            picture for picture, _, decision in rows if decision.verdict in _CONFLICTS
        ),
    )
