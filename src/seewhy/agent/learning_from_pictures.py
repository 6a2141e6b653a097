"""Learn axioms for a domain: induction with the domain's knowledge around it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from seewhy.data.dataset import Dataset
from seewhy.dialogue.reference import Experience
from seewhy.domain.domain import Domain
from seewhy.induction.axiom_learning import (
    DEFAULTS,
    Judgement,
    Learned,
    LearningOptions,
    learn_axioms,
)
from seewhy.induction.axiom_text import axiom_statement, conjunctions
from seewhy.induction.candidate import Candidate, tally
from seewhy.induction.scene_table import Reasons, scene_table
from seewhy.induction.sentence import say_rule, things
from seewhy.induction.tree import DecisionTree
from seewhy.knowledge.axiom import Axiom, Origin
from seewhy.knowledge.language import Knowledge, read_axioms
from seewhy.knowledge.learned_file import Withdrawn
from seewhy.knowledge.reasoner import Decision, Minimality, Reasoner
from seewhy.knowledge.scene import FeatureVector, SceneSchema

__all__ = [
    "AnnotatedScenes",
    "Learning",
    "axioms_of",
    "contradicted",
    "learn_for_domain",
    "scenes_of",
    "superseded",
    "with_candidates",
]

_ROUNDED = 0.0005  # the file of learned axioms gives shares with one decimal of a per cent
_REASONERS = 4  # the knowledge so far is asked again for every candidate


@dataclass(frozen=True)
class AnnotatedScenes:
    """Feature vectors with their classes, and the pictures that they were seen in.

    ``pictures`` names every scene's picture; it is empty where that is not known. ``reasons`` has
    the features that somebody named as why a scene is of its class, None where nobody did; it may
    be left out.
    """

    vectors: tuple[FeatureVector, ...]
    labels: tuple[str, ...]
    pictures: tuple[str, ...]
    reasons: tuple[Reasons | None, ...] = ()

    @staticmethod
    def of_experience(experience: Experience) -> AnnotatedScenes:
        """The scenes that an earlier training or learning has counted.

        Examples
        --------
        >>> AnnotatedScenes.of_experience({("a",): {"x": 2}}).labels
        ('x', 'x')
        """
        rows = [
            (vector, label)
            for vector, counts in experience.items()
            for label, count in counts.items()
            for _ in range(count)
        ]
        return AnnotatedScenes(
            tuple(vector for vector, _ in rows),
            tuple(label for _, label in rows),
            ("",) * len(rows),
        )


@dataclass(frozen=True)
class Learning:
    """What became of learning: axioms found, added, withdrawn, and every candidate's judgement.

    ``found`` are the axioms that all steps of induction let pass; ``added`` those of them that
    were taken over; ``withdrawn`` has the given axioms that were set aside, too. ``tree`` is the
    tree of the first round, ``accepted_leaves`` the places of its paths that the axioms found come
    from or cover.
    """

    found: tuple[Axiom, ...]
    added: tuple[Axiom, ...]
    withdrawn: tuple[Withdrawn, ...]
    judgements: tuple[Judgement, ...]
    tree: DecisionTree
    accepted_leaves: frozenset[int]


def scenes_of(dataset: Dataset, experience: Experience, known: Collection[str]) -> AnnotatedScenes:
    """Return the scenes of a dataset and those that were counted before, none of them twice.

    A picture without a class teaches nothing here. ``known`` are the digests of the pictures that
    ``experience`` counts.
    """
    names: dict[tuple[FeatureVector, str], list[str]] = {}
    said: dict[tuple[FeatureVector, str], list[Reasons | None]] = {}
    counts: Counter[tuple[FeatureVector, str]] = Counter(
        {(v, label): n for v, labels in experience.items() for label, n in labels.items()}
    )
    classed = dataset.with_class()
    rows_read = zip(classed.scenes, classed.classes, classed.picture_digests(), strict=True)
    for scene, label, digest in rows_read:
        key = scene.vector, label
        names.setdefault(key, []).append(classed.name_of(scene))
        counts[key] += digest not in known
        said.setdefault(key, []).append(frozenset(scene.reasons) or None)
    rows = [
        (
            *key,
            (names.get(key, []) + [""] * count)[:count],
            (said.get(key, []) + [None] * count)[:count],
        )
        for key, count in counts.items()
    ]
    return AnnotatedScenes(
        tuple(vector for vector, _, pictures, _ in rows for _ in pictures),
        tuple(label for _, label, pictures, _ in rows for _ in pictures),
        tuple(name for _, _, pictures, _ in rows for name in pictures),
        tuple(reasons for _, _, _, told in rows for reasons in told),
    )


def learn_for_domain(
    domain: Domain,
    scenes: AnnotatedScenes,
    *,
    minimality: Minimality = "cardinality",
    options: LearningOptions = DEFAULTS,
) -> Learned:
    """Learn what a domain's knowledge lacks from annotated scenes.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> without = replace(domain.knowledge, axioms=domain.knowledge.axioms[1:])
    >>> domain = replace(domain, knowledge=without)
    >>> vectors = [(n, base, "no", displaced) for n in "345" for base in ("wide", "narrow")
    ...            for displaced in ("yes", "no")] * 10
    >>> labels = ["unstable" if vector[3] == "yes" else "stable" for vector in vectors]
    >>> scenes = AnnotatedScenes(tuple(vectors), tuple(labels), ("",) * len(vectors))
    >>> learned = learn_for_domain(domain, scenes)
    >>> for axiom in axioms_of(domain, [judged.candidate for judged in learned.accepted], scenes):
    ...     print(axiom, axiom.origin.support)
    -stable(S) if block_displaced(S). 60
    stable(S) if -block_displaced(S). 60
    """

    @lru_cache(maxsize=_REASONERS)
    def reasoner(candidates: tuple[Candidate, ...]) -> Reasoner:
        knowledge = with_candidates(domain.knowledge, candidates, domain.schema)
        return Reasoner(knowledge, domain.schema, minimality=minimality)

    def decide(
        candidates: Sequence[Candidate], some: Sequence[FeatureVector]
    ) -> Sequence[Decision]:
        return reasoner(tuple(candidates)).decide_all(some)

    features = {key: feature.values for key, feature in domain.features.items()}
    return learn_axioms(
        features,
        scenes.vectors,
        scenes.labels,
        decide=decide,
        reasons=scenes.reasons,
        options=options,
    )


def with_candidates(
    knowledge: Knowledge, candidates: Sequence[Candidate], schema: SceneSchema
) -> Knowledge:
    """Return the knowledge with candidates added as axioms."""
    single = (
        conjunction for candidate in candidates for conjunction in conjunctions(candidate, schema)
    )
    text = "\n".join(axiom_statement(conjunction, schema) for conjunction in single)
    added = read_axioms(text, knowledge.signature, letter="c")
    return replace(knowledge, axioms=(*knowledge.axioms, *added))


def axioms_of(
    domain: Domain, candidates: Sequence[Candidate], scenes: AnnotatedScenes
) -> tuple[Axiom, ...]:
    """Return candidates as axioms with their sentences and the scenes that they rest on."""
    schema = domain.schema
    features = {key: feature.values for key, feature in domain.features.items()}
    table = scene_table(features, scenes.vectors, scenes.labels)
    single = [
        conjunction for candidate in candidates for conjunction in conjunctions(candidate, schema)
    ]
    text = "\n".join(
        f"%% {say_rule(domain, conjunction.conditions, conjunction.label)}\n"
        f"{axiom_statement(conjunction, schema)}"
        for conjunction in single
    )
    axioms = read_axioms(text, domain.knowledge.signature)
    found = []
    for conjunction, axiom in zip(single, axioms, strict=True):
        spoken = tally(conjunction, table)
        rows = np.flatnonzero(table.satisfying(conjunction.conditions))
        positions = sorted(n for row in rows for n in table.scenes[row])
        pictures = (
            scenes.pictures[n]
            for n in positions
            if scenes.pictures[n] and scenes.labels[n] == conjunction.label
        )
        origin = Origin(
            learned=True,
            support=spoken.right + spoken.wrong,
            precision=spoken.precision,
            pictures=tuple(dict.fromkeys(pictures)),
            things=things(domain),
        )
        found.append(replace(axiom, origin=origin))
    return tuple(found)


def contradicted(
    domain: Domain,
    learned: Sequence[Axiom],
    scenes: AnnotatedScenes,
    *,
    tolerance: float = 0.0,
    minimality: Minimality = "cardinality",
) -> list[tuple[Axiom, Withdrawn]]:
    """Return the learned axioms that scenes speak against, with the reason to withdraw them.

    ``domain`` is the domain without learned axioms. An axiom is contradicted where its conditions
    hold in scenes of another class: in more than ``tolerance`` of them, and than when it was
    learned.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("structure_stability")
    >>> (lean,) = read_axioms("-stable(S) if lean(S).", domain.knowledge.signature)
    >>> scenes = AnnotatedScenes((("2", "wide", "yes", "no"),), ("stable",), ("a.png",))
    >>> [withdrawn.reason for _, withdrawn in contradicted(domain, [lean], scenes)]
    ['1 of 1 structures that it speaks about are otherwise, as a.png']
    """
    schema = domain.schema
    found = []
    distinct = list(dict.fromkeys(scenes.vectors))
    for axiom in learned:
        alone = Reasoner(replace(domain.knowledge, axioms=(axiom,)), schema, minimality=minimality)
        concluded = dict(zip(distinct, alone.decide_all(distinct), strict=True))
        spoken = [
            n for n, vector in enumerate(scenes.vectors) if concluded[vector].label is not None
        ]
        wrong = [n for n in spoken if concluded[scenes.vectors[n]].label != scenes.labels[n]]
        allowed = max(tolerance, 1.0 - axiom.origin.precision + _ROUNDED)
        if wrong and len(wrong) > allowed * len(spoken):
            some = next((scenes.pictures[n] for n in wrong if scenes.pictures[n]), "")
            reason = (
                f"{len(wrong)} of {len(spoken)} {things(domain)} that it speaks about are "
                f"otherwise{f', as {some}' if some else ''}"
            )
            found.append((axiom, Withdrawn(str(axiom), reason)))
    return found


def superseded(learned: Sequence[Axiom], newer: Sequence[Axiom]) -> list[tuple[Axiom, Withdrawn]]:
    """Return the learned axioms of which a newer one is a more general version.

    It concludes the same from some of the same conditions.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> signature = load_domain("structure_stability").knowledge.signature
    >>> old = read_axioms("-stable(S) if lean(S), base(S, narrow).", signature)
    >>> new = read_axioms("-stable(S) if lean(S).", signature)
    >>> [withdrawn.reason for _, withdrawn in superseded(old, new)]
    ['-stable(S) if lean(S). says it of more scenes']
    """
    found = []
    for axiom in learned:
        conditions = {condition.text for condition in axiom.body}
        for other in newer:
            asked = {condition.text for condition in other.body}
            if other.head == axiom.head and asked <= conditions:
                found.append((axiom, Withdrawn(str(axiom), f"{other} says it of more scenes")))
                break
    return found
