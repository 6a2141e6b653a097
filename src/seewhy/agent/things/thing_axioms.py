"""Learn axioms about things for a domain, with the domain's knowledge around them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from seewhy.agent.learning_from_pictures import AnnotatedScenes
from seewhy.agent.things.concluded import concluded_of_things, where_axioms_speak
from seewhy.domain.domain import Domain
from seewhy.induction.axiom_learning import Fate
from seewhy.induction.sentence import things as scenes_called
from seewhy.induction.things.rule_learning import (
    JudgedRule,
    ThingLearningOptions,
    learn_thing_rules,
)
from seewhy.induction.things.rule_sentence import say_thing_rule
from seewhy.induction.things.rule_text import thing_rule_statement
from seewhy.induction.things.thing_table import thing_table
from seewhy.knowledge.axiom import Axiom, Origin
from seewhy.knowledge.language import read_axioms
from seewhy.knowledge.learned_file import Withdrawn
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector

__all__ = [
    "as_few_things",
    "axioms_of_rules",
    "contradicted_by_scenes",
    "decided",
    "learn_rules_for_domain",
    "with_axioms_about_things",
]

_ROUNDED = 0.0005
"""Shares are written with one decimal of a per cent."""


def as_few_things(domain: Domain, scenes: AnnotatedScenes) -> tuple[Domain, AnnotatedScenes]:
    """Return domain and scenes for as many things as the fullest scene has.

    The fewer things, the faster is reasoned about them.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("tabletop")
    >>> one = AnnotatedScenes((domain.vector({"thing(thing1)": "yes"}),), ("good",), ("a.png",))
    >>> few, scenes = as_few_things(domain, one)
    >>> few.things.most, len(scenes.vectors[0]), len(one.vectors[0])
    (1, 5, 590)
    """
    places = {feature: place for place, feature in enumerate(domain.schema.features)}
    there = [places[presence] for presence in domain.schema.presence.values()]
    most = max(
        (
            number
            for vector in scenes.vectors
            for number, place in enumerate(there, start=1)
            if vector[place] == "yes"
        ),
        default=0,
    )
    few = domain.with_most_things(max(1, most))
    kept = [places[feature] for feature in few.schema.features]
    vectors = tuple(tuple(vector[place] for place in kept) for vector in scenes.vectors)
    return few, replace(scenes, vectors=vectors)


def decided(domain: Domain, vectors: Sequence[FeatureVector]) -> list[str | None]:
    """Return the class of each scene by the domain's knowledge; None where it decides none."""
    classes = {scene_class.literal.predicate for scene_class in domain.classes.values()}
    if not any(axiom.head.predicate in classes for axiom in domain.knowledge.axioms):
        return [None] * len(vectors)
    reasoner = Reasoner(domain.knowledge, domain.schema)
    return [decision.label for decision in reasoner.decide_all(vectors)]


def learn_rules_for_domain(
    domain: Domain, scenes: AnnotatedScenes, options: ThingLearningOptions
) -> tuple[JudgedRule, ...]:
    """Return rules for the scenes that the domain's knowledge leaves open or gets wrong."""
    assert domain.things is not None, "the domain has no things"
    known = decided(domain, scenes.vectors)
    left = [label != true for label, true in zip(known, scenes.labels, strict=True)]
    table = thing_table(
        domain.things,
        domain.schema,
        scenes.vectors,
        concluded=concluded_of_things(domain, scenes.vectors),
    )
    return learn_thing_rules(
        table, scenes.labels, classes=list(domain.classes), left=left, options=options
    )


def axioms_of_rules(
    domain: Domain, judged: Sequence[JudgedRule], scenes: AnnotatedScenes
) -> tuple[Axiom, ...]:
    """Return the accepted rules as axioms, with their sentences and the scenes they rest on."""
    assert domain.things is not None, "the domain has no things"
    accepted = [judgement.rule for judgement in judged if judgement.fate is Fate.ACCEPTED]
    signature = domain.knowledge.signature
    text = "\n".join(
        f"%% {say_thing_rule(domain, rule)}\n"
        f"{thing_rule_statement(rule, domain.things, domain.schema, signature)}"
        for rule in accepted
    )
    axioms = read_axioms(text, signature)
    speaking = where_axioms_speak(with_axioms_about_things(domain, axioms), axioms, scenes.vectors)
    found = []
    for rule, axiom, where in zip(accepted, axioms, speaking, strict=True):
        spoken = np.flatnonzero(where).tolist()
        right = [n for n in spoken if scenes.labels[n] == rule.label]
        pictures = (scenes.pictures[n] for n in right if scenes.pictures[n])
        origin = Origin(
            learned=True,
            support=len(spoken),
            precision=len(right) / max(1, len(spoken)),
            pictures=tuple(dict.fromkeys(pictures)),
            things=scenes_called(domain),
        )
        found.append(replace(axiom, origin=origin))
    return tuple(found)


def with_axioms_about_things(
    domain: Domain, axioms: Sequence[Axiom], *, without: Sequence[Withdrawn] = ()
) -> Domain:
    """Return the domain with some more axioms, and without some of its own."""
    gone = {withdrawn.statement for withdrawn in without}
    kept = tuple(axiom for axiom in domain.knowledge.axioms if str(axiom) not in gone)
    knowledge = replace(domain.knowledge, axioms=(*kept, *axioms))
    return replace(domain, knowledge=knowledge)


def contradicted_by_scenes(
    domain: Domain, scenes: AnnotatedScenes, *, tolerance: float = 0.0
) -> list[Withdrawn]:
    """Return those of the domain's learned axioms that scenes speak against, with the reason.

    An axiom is contradicted where its conditions hold, with all that is known, in scenes of
    another class: in more than ``tolerance`` of them, and than when it was learned.
    """
    learned = [axiom for axiom in domain.knowledge.axioms if axiom.origin.learned]
    labels = {scene_class.literal: label for label, scene_class in domain.classes.items()}
    found = []
    for axiom, where in zip(
        learned, where_axioms_speak(domain, learned, scenes.vectors), strict=True
    ):
        label = next(
            (
                label
                for literal, label in labels.items()
                if (literal.predicate, literal.positive)
                == (axiom.head.predicate, axiom.head.positive)
                and literal.arguments[1:] == axiom.head.arguments[1:]
            ),
            None,
        )
        spoken = np.flatnonzero(where).tolist()
        wrong = [n for n in spoken if scenes.labels[n] != label]
        allowed = max(tolerance, 1.0 - axiom.origin.precision + _ROUNDED)
        if label is not None and wrong and len(wrong) > allowed * len(spoken):
            some = next((scenes.pictures[n] for n in wrong if scenes.pictures[n]), "")
            reason = (
                f"{len(wrong)} of {len(spoken)} {scenes_called(domain)} that it speaks about are "
                f"otherwise{f', as {some}' if some else ''}"
            )
            found.append(Withdrawn(str(axiom), reason))
    return found
