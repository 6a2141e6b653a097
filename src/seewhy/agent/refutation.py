"""Find given axioms about features that annotated scenes refute."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from seewhy.agent.learning_from_pictures import AnnotatedScenes
from seewhy.domain.domain import Domain
from seewhy.induction.binomial import at_least
from seewhy.induction.sentence import things
from seewhy.knowledge.axiom import Axiom, AxiomKind, Literal
from seewhy.knowledge.ground import key_of
from seewhy.knowledge.learned_file import Withdrawn
from seewhy.knowledge.reasoner import Reasoner
from seewhy.knowledge.scene import FeatureVector, SceneSchema
from seewhy.knowledge.signature import Location, Predicate, PredicateKind, Signature, Sort

__all__ = ["refuted"]

TRUSTED = 0.02
"""Of the scenes that a given axiom speaks about, this share may be otherwise: its author knows
more than a few annotations do."""

BY_CHANCE = 0.01
"""So unlikely must it be that so many scenes are otherwise by errors of annotation alone."""

_SPEAKS, _NUMBERS = "speaks__", "axioms__"


def refuted(
    domain: Domain, scenes: AnnotatedScenes, *, tolerance: float = 0.0
) -> list[tuple[Axiom, Withdrawn]]:
    """Return the axioms about features that annotated scenes refute, with the reason.

    An axiom that concludes a feature's value speaks about the scenes whose annotated features, and
    what is known apart from scenes, fulfil its conditions. It is refuted where the annotation of
    more of them says otherwise than can be expected: a share of :data:`TRUSTED`, or ``tolerance``
    where that is greater. Defaults have exceptions, and axioms that conclude classes are not looked
    at here: what they get wrong is left to be learned.

    Source: none. The paper's knowledge lacks axioms but has no wrong ones; yet without a fact that
    an axiom's ``not`` asks for, that axiom is wrong.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("traffic_signs")
    >>> knowledge = domain.knowledge
    >>> kept = [axiom for axiom in knowledge.axioms if str(axiom) != "may_have_second(p)."]
    >>> poorer = replace(domain, knowledge=replace(knowledge, axioms=tuple(kept)))
    >>> vector = domain.vector({"shape": "tall_rectangle", "main_color": "blue",
    ...     "border_color": "blue", "background_image": "none", "primary_symbol": "p",
    ...     "secondary_symbol": "car", "cross": "none"})
    >>> scenes = AnnotatedScenes((vector,) * 9, ("parking_cars",) * 9, ("",) * 9)
    >>> [gone.statement for _, gone in refuted(poorer, scenes)]
    ['secondary_symbol(S, none) if primary_symbol(S, X), not may_have_second(X).']
    >>> refuted(domain, scenes)
    []
    """
    schema = domain.schema
    concluding = [
        axiom
        for axiom in domain.knowledge.axioms
        if axiom.head.predicate in schema.features and axiom.kind is not AxiomKind.DEFAULT
    ]
    if not concluding:
        return []
    telling = _telling(domain, concluding)
    counts = Counter(scenes.vectors)
    pictures = dict(zip(reversed(scenes.vectors), reversed(scenes.pictures), strict=True))
    spoken: Counter[str] = Counter()
    wrong: Counter[str] = Counter()
    first: dict[str, str] = {}
    for vector, count in counts.items():
        found = telling.answer_set(vector)
        for axiom in concluding if found else ():
            instances = found.firings.get(axiom.identifier, ()) if found else ()
            heads = list(_heads(axiom, instances, schema))
            spoken[axiom.identifier] += count * bool(heads)
            if any(_is_otherwise(head, vector, schema) for head in heads):
                wrong[axiom.identifier] += count
                first.setdefault(axiom.identifier, pictures[vector])
    expected = max(TRUSTED, tolerance)
    return [
        (axiom, Withdrawn(str(axiom), _reason(domain, *counted, first[axiom.identifier]), True))
        for axiom in concluding
        for counted in [(wrong[axiom.identifier], spoken[axiom.identifier])]
        if counted[0] and at_least(counted[0], counted[1], expected) < BY_CHANCE
    ]


def _telling(domain: Domain, concluding: Sequence[Axiom]) -> Reasoner:
    """What is known apart from scenes, and axioms that say of what they speak but conclude nothing.

    So that one wrong axiom does not make others speak that it has no right to.
    """
    knowledge, schema = domain.knowledge, domain.schema
    nowhere = Location(str(knowledge.file), 0, 0)
    signature = knowledge.signature
    numbers = Sort(_NUMBERS, tuple(map(str, range(len(concluding)))), nowhere)
    speaks = Predicate(_SPEAKS, (_NUMBERS,), PredicateKind.STATIC, nowhere)
    predicates = signature.predicates
    apart = [
        axiom
        for axiom in knowledge.axioms
        if schema.scene not in predicates[axiom.head.predicate].sorts
    ]
    marking = [
        replace(axiom, head=Literal(_SPEAKS, (str(number),)))
        for number, axiom in enumerate(concluding)
    ]
    added = Signature(
        {**signature.sorts, numbers.name: numbers}, {**predicates, speaks.name: speaks}
    )
    return Reasoner(replace(knowledge, signature=added, axioms=(*apart, *marking)), schema)


def _heads(
    axiom: Axiom, instances: Sequence[tuple[str, ...]], schema: SceneSchema
) -> Iterator[Literal]:
    """What an axiom concludes where it speaks."""
    variables = replace(axiom, head=Literal(_SPEAKS, ("0",))).variables
    for values in instances:
        head = axiom.head.substitute(dict(zip(variables, values, strict=True)))
        if schema.feature_of(head) is not None:
            yield head


def _is_otherwise(head: Literal, vector: FeatureVector, schema: SceneSchema) -> bool:
    """Whether a vector's value of the feature that a literal speaks about excludes the literal."""
    seen: Mapping[str, str | None] = dict(zip(schema.features, vector, strict=True))
    value = seen[head.predicate]
    if value is None:
        return False
    literals = schema.features[head.predicate]
    concluded = key_of(head)
    if concluded == key_of(literals[value].complement):
        return True
    return any(concluded == key_of(literal) for v, literal in literals.items() if v != value)


def _reason(domain: Domain, wrong: int, spoken: int, picture: str) -> str:
    some = f", as {picture}" if picture else ""
    return f"{wrong} of {spoken} {things(domain)} that it speaks about are otherwise{some}"
