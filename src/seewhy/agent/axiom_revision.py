"""The axioms that are known, revised by annotated scenes: step by step, as an agent learns."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass

from seewhy.agent.learning_from_pictures import (
    AnnotatedScenes,
    axioms_of,
    contradicted,
    learn_for_domain,
    scenes_of,
    superseded,
)
from seewhy.agent.refutation import refuted
from seewhy.agent.training_pictures import require_same_domain
from seewhy.agent.working_knowledge import WorkingKnowledge
from seewhy.data.dataset import Dataset
from seewhy.data.training_needs import require_two_classes
from seewhy.induction.axiom_learning import Learned, LearningOptions
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.learned_file import Withdrawn

__all__ = [
    "Proposed",
    "extended",
    "proposed_axioms",
    "scenes_to_learn_from",
    "without_what_is_wrong",
]

SetAside = Callable[[Sequence[Withdrawn]], Sequence[Withdrawn]]


@dataclass(frozen=True)
class Proposed:
    """Axioms that annotated scenes suggest, and how induction came to them."""

    axioms: tuple[Axiom, ...]
    learned: Learned


def scenes_to_learn_from(
    dataset: Dataset, known: WorkingKnowledge, *, counted: Collection[str]
) -> AnnotatedScenes:
    """Return the scenes of a dataset to train on, and those that are remembered, none twice.

    ``counted`` are the digests of the pictures that are remembered.

    Raises
    ------
    DatasetError
        If the dataset is of another domain, or there is one class only.
    """
    require_same_domain(dataset, known.domain)
    train = dataset.of_split("train")
    scenes = scenes_of(train, known.experience, counted)
    if len(set(scenes.labels)) < 2:
        require_two_classes(train)
    return scenes


def without_what_is_wrong(
    known: WorkingKnowledge,
    scenes: AnnotatedScenes,
    *,
    tolerance: float,
    set_aside: SetAside | None = None,
) -> WorkingKnowledge:
    """Return what is known but for the axioms that scenes speak against.

    Learned axioms that they contradict are withdrawn. Given axioms that they refute are set aside,
    those that ``set_aside`` returns of them, where it is given.
    """
    gone = contradicted(
        known.given,
        known.learned,
        scenes,
        tolerance=tolerance,
        minimality=known.minimality,
    )
    wrong = [withdrawn for _, withdrawn in refuted(known.domain, scenes, tolerance=tolerance)]
    aside = wrong if set_aside is None or not wrong else set_aside(wrong)
    return known.withdrawing(*(withdrawn for _, withdrawn in gone), *aside)


def proposed_axioms(
    known: WorkingKnowledge, scenes: AnnotatedScenes, *, options: LearningOptions
) -> Proposed:
    """Return the axioms by which scenes are decided that what is known leaves open."""
    learned = learn_for_domain(known.domain, scenes, minimality=known.minimality, options=options)
    candidates = [leaf.candidate for leaf in learned.accepted]
    return Proposed(axioms_of(known.domain, candidates, scenes), learned)


def extended(known: WorkingKnowledge, chosen: Sequence[Axiom]) -> WorkingKnowledge:
    """Return what is known with more axioms, but for those that a new one makes needless."""
    narrow = superseded(known.learned, chosen)
    needless = [axiom for axiom, _ in narrow]
    kept = [axiom for axiom in known.learned if axiom not in needless]
    withdrawn = (*known.withdrawn, *(gone for _, gone in narrow))
    return known.knowing([*kept, *chosen], withdrawn)
