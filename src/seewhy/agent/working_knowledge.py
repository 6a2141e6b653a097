"""What is reasoned with: the given axioms but for what is set aside, and the learned ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from seewhy.dialogue.reasoned import ReasonedAnswers
from seewhy.dialogue.reference import Experience, ReferenceAnswers
from seewhy.domain.domain import Domain
from seewhy.errors import KnowledgeError
from seewhy.induction.tree import DecisionTree
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.learned_file import Withdrawn, learned_text, parse_learned
from seewhy.knowledge.occurrence import Occurrence
from seewhy.knowledge.reasoner import Minimality, Reasoner
from seewhy.knowledge.scene import FeatureVector
from seewhy.text.nearest import did_you_mean

__all__ = ["WorkingKnowledge", "working_knowledge"]


@dataclass(frozen=True, eq=False)
class WorkingKnowledge:
    """Knowledge at work; :func:`working_knowledge` makes it, and its methods make others of it.

    Attributes
    ----------
    given : Domain
        As its folder says it.
    learned : tuple of Axiom
        What was learned from pictures.
    withdrawn : tuple of Withdrawn
        What is known no more; given axioms among them are set aside.
    minimality : {"cardinality", "inclusion"}
        Which exceptions to defaults are preferred.
    experience : mapping
        How often each feature vector was annotated with each class.
    domain : Domain
        What is reasoned with.
    reasoner : Reasoner
        Reasons with it.
    """

    given: Domain
    learned: tuple[Axiom, ...]
    withdrawn: tuple[Withdrawn, ...]
    minimality: Minimality
    experience: Experience
    domain: Domain
    reasoner: Reasoner

    @cached_property
    def reasoned(self) -> ReasonedAnswers:
        """Answers by what is known, and as the annotated scenes suggest."""
        counts = {vector: sum(classes.values()) for vector, classes in self.experience.items()}
        return ReasonedAnswers(self.domain, self.reasoner, Occurrence(counts))

    @property
    def reference(self) -> ReferenceAnswers:
        """What correct answers say about annotated scenes."""
        return ReferenceAnswers(self.domain, self.reasoned, self.experience)

    def knowing(self, learned: Sequence[Axiom], withdrawn: Sequence[Withdrawn]) -> WorkingKnowledge:
        """The same with these axioms beside the given ones."""
        return working_knowledge(
            self.given,
            learned=learned,
            withdrawn=withdrawn,
            minimality=self.minimality,
            experience=self.experience,
        )

    def withdrawing(self, *gone: Withdrawn) -> WorkingKnowledge:
        """The same without these axioms, learned or given."""
        statements = {withdrawn.statement for withdrawn in gone if not withdrawn.given}
        kept = [axiom for axiom in self.learned if str(axiom) not in statements]
        return self.knowing(kept, (*self.withdrawn, *gone))

    def untrained_tree(self) -> DecisionTree:
        """A tree of the domain's features that has learned nothing yet."""
        features = {key: feature.values for key, feature in self.given.features.items()}
        return DecisionTree(features)

    def left_open(
        self, vectors: Sequence[FeatureVector], labels: Sequence[str], *, also: Sequence[int] = ()
    ) -> tuple[list[FeatureVector], list[str]]:
        """The annotated scenes that are not decided, or wrongly; and those at some places."""
        decisions = self.reasoner.decide_all(vectors)
        more = frozenset(also)
        left = [
            place
            for place, decision in enumerate(decisions)
            if decision.label != labels[place] or place in more
        ]
        return [vectors[place] for place in left], [labels[place] for place in left]

    def learned_axiom(self, identifier: str) -> Axiom:
        """Return a learned axiom.

        Raises
        ------
        KnowledgeError
            If no learned axiom has this identifier.
        """
        said = "is no learned axiom"
        return _called(identifier, self.learned, otherwise=said, none="none was learned")

    def axiom_set_aside(self, identifier: str) -> Axiom:
        """Return a given axiom that is set aside.

        Raises
        ------
        KnowledgeError
            If no axiom with this identifier is set aside.
        """
        aside = _set_aside(self.withdrawn)
        axioms = [axiom for axiom in self.given.knowledge.axioms if str(axiom) in aside]
        return _called(identifier, axioms, otherwise="is not set aside", none="no given axiom is")

    def restoring(self, axiom: Axiom) -> WorkingKnowledge:
        """The same with a given axiom that was set aside."""
        withdrawn = [
            gone for gone in self.withdrawn if not (gone.given and gone.statement == str(axiom))
        ]
        return self.knowing(self.learned, withdrawn)


def working_knowledge(
    given: Domain,
    *,
    learned: Sequence[Axiom] = (),
    withdrawn: Sequence[Withdrawn] = (),
    minimality: Minimality = "cardinality",
    experience: Experience | None = None,
) -> WorkingKnowledge:
    """Put together what is reasoned with.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> known = working_knowledge(domain)
    >>> gone = Withdrawn(str(domain.knowledge.axioms[0]), "nobody believes it", given=True)
    >>> len(known.domain.knowledge.axioms) - len(known.withdrawing(gone).domain.knowledge.axioms)
    1
    """
    aside = _set_aside(withdrawn)
    knowledge = given.knowledge
    text = learned_text(learned)
    axioms = parse_learned(text, knowledge.signature) if learned else ()
    kept = (axiom for axiom in knowledge.axioms if str(axiom) not in aside)
    domain = replace(given, knowledge=replace(knowledge, axioms=(*kept, *axioms)))
    return WorkingKnowledge(
        given=given,
        learned=axioms,
        withdrawn=tuple(withdrawn),
        minimality=minimality,
        experience={} if experience is None else experience,
        domain=domain,
        reasoner=Reasoner(domain.knowledge, domain.schema, minimality=minimality),
    )


def _called(identifier: str, axioms: Sequence[Axiom], *, otherwise: str, none: str) -> Axiom:
    """The axiom with an identifier; ``none`` says why there is no axiom to choose from."""
    found = {axiom.identifier: axiom for axiom in axioms}
    if identifier in found:
        return found[identifier]
    remedy = f"; {did_you_mean(identifier, list(found))}" if found else f": {none}"
    raise KnowledgeError(f"'{identifier}' {otherwise}{remedy}")


def _set_aside(withdrawn: Sequence[Withdrawn]) -> set[str]:
    return {gone.statement for gone in withdrawn if gone.given}
