"""What axioms conclude in many scenes at once: of their things, and which axioms speak there."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from seewhy.domain.domain import Domain
from seewhy.domain.things import CONCLUDED
from seewhy.induction.things.thing_table import Concluded
from seewhy.knowledge.axiom import Axiom, Literal
from seewhy.knowledge.batch import SCENES, Batch
from seewhy.knowledge.ground import key_of
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector, SceneSchema
from seewhy.knowledge.signature import Location, Predicate, PredicateKind, Signature, Sort

__all__ = ["concluded_of_things", "where_axioms_speak"]

_THREE = 3
_SPEAKS, _NUMBERS = "speaks__", "axioms__"


def concluded_of_things(domain: Domain, vectors: Sequence[FeatureVector]) -> Concluded:
    """Return what the domain's axioms conclude of the things of scenes, for rules to ask.

    What rests on the class of the picture is left out: a rule for the class cannot ask it.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("tabletop").with_most_things(2)
    >>> shown = {"thing(thing1)": "yes", "thing(thing2)": "yes", "on(thing1,thing2)": "yes"}
    >>> concluded_of_things(domain, [domain.vector(shown)]).of_one["clear"].tolist()
    [[True, False]]
    """
    things = domain.things
    assert things is not None, "the domain has no things"
    apart = _apart_from_classes(domain)
    relations = [key for key, relation in things.relations.items() if relation.measure == CONCLUDED]
    groups = [key for key, group in things.groups.items() if group.size == _THREE]
    wanted = {1: [*things.conclusions], 2: relations, _THREE: groups}
    terms = list(domain.schema.presence)
    literals = {
        f"{key} {numbers}": Literal(key, tuple(terms[number] for number in numbers))
        for size, keys in wanted.items()
        for key in keys
        if key in apart
        for numbers in permutations(range(len(terms)), size)
    }
    if not literals:
        return Concluded()
    believed = _believed(domain.knowledge, domain.schema, vectors, literals)
    found: dict[int, dict[str, NDArray[np.bool_]]] = {size: {} for size in wanted}
    for size, keys in wanted.items():
        for key in keys:
            if key in apart:
                shape = (len(vectors), *[len(terms)] * size)
                found[size][key] = np.zeros(shape, dtype=bool)
                for numbers in permutations(range(len(terms)), size):
                    place: tuple[slice | int, ...] = (slice(None), *numbers)
                    found[size][key][place] = believed[f"{key} {numbers}"]
    return Concluded(found[1], found[2], found[_THREE])


def where_axioms_speak(
    domain: Domain, axioms: Sequence[Axiom], vectors: Sequence[FeatureVector]
) -> list[NDArray[np.bool_]]:
    """Return, for each of some of the domain's axioms, the scenes in which its conditions hold.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("tabletop").with_most_things(1)
    >>> clear = [axiom for axiom in domain.knowledge.axioms if axiom.head.predicate == "clear"]
    >>> scenes = [domain.vector({}), domain.vector({"thing(thing1)": "yes"})]
    >>> where_axioms_speak(domain, clear, scenes)[0].tolist()
    [False, True]
    """
    knowledge, schema = domain.knowledge, domain.schema
    signature = knowledge.signature
    nowhere = Location(str(knowledge.file), 0, 0)
    numbers = Sort(_NUMBERS, tuple(map(str, range(max(1, len(axioms))))), nowhere)
    speaks = Predicate(_SPEAKS, (_NUMBERS,), PredicateKind.STATIC, nowhere)
    added = Signature(
        {**signature.sorts, numbers.name: numbers}, {**signature.predicates, speaks.name: speaks}
    )
    marks = {str(number): Literal(_SPEAKS, (str(number),)) for number in range(len(axioms))}
    marking = [
        replace(axiom, head=mark) for axiom, mark in zip(axioms, marks.values(), strict=True)
    ]
    marked = replace(knowledge, signature=added, axioms=(*knowledge.axioms, *marking))
    return list(_believed(marked, schema, vectors, marks).values())


def _believed(
    knowledge: Knowledge,
    schema: SceneSchema,
    vectors: Sequence[FeatureVector],
    literals: Mapping[str, Literal],
) -> dict[str, NDArray[np.bool_]]:
    """Name of a literal → the scenes in which it is believed."""
    asking = replace(schema, classes=literals)
    batch, alone = Batch(knowledge, asking), Reasoner(knowledge, schema)
    found = {name: np.zeros(len(vectors), dtype=bool) for name in literals}
    for start in range(0, len(vectors), SCENES):
        some = vectors[start : start + SCENES]
        for number, outcome in enumerate(batch.outcomes(some), start=start):
            if outcome is None:
                believed = set(map(str, alone.believed(vectors[number])))
                names = tuple(
                    name for name, literal in literals.items() if key_of(literal) in believed
                )
            else:
                names = outcome.classes
            for name in names:
                found[name][number] = True
    return found


def _apart_from_classes(domain: Domain) -> set[str]:
    """The predicates that do not rest on one of a class."""
    predicates = set(domain.knowledge.signature.predicates)
    resting = {scene_class.literal.predicate for scene_class in domain.classes.values()}
    while True:
        more = {
            axiom.head.predicate
            for axiom in domain.knowledge.axioms
            if axiom.head.predicate not in resting and axiom.predicates & resting
        }
        if not more:
            return predicates - resting
        resting |= more
