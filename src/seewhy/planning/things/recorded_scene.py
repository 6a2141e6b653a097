"""The things that the record of a run is about: what it says of them before its first step."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import permutations
from pathlib import Path

from seewhy.data.thing_scene import ThingScene, thing_scene
from seewhy.domain.things import Things
from seewhy.errors import PlanningError
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.history import History, read_history_file
from seewhy.knowledge.signature import Signature
from seewhy.knowledge.things import literals_about
from seewhy.planning.domain import PlanningDomain

__all__ = ["domain_of_record", "read_record", "seen_statics"]


def read_record(domain: PlanningDomain, file: Path) -> History:
    """Read what was seen and done in a run, about whatever things of pictures.

    Raises
    ------
    KnowledgeError
        If the file is missing or wrong, or about more things than there may be.
    """
    signature = domain.knowledge.signature
    if domain.at_first is None:
        return read_history_file(file, signature)
    things = domain.at_first.things
    names = tuple(map(domain.at_first.term, range(things.most)))
    sort = replace(signature.sorts[things.sort], members=names)
    return read_history_file(file, replace(signature, sorts={**signature.sorts, things.sort: sort}))


def domain_of_record(
    domain: PlanningDomain, record: History, *, name: str = "the record"
) -> PlanningDomain:
    """Return the domain with the things that a record is about; as it is, where it has none.

    ``name`` is what an error calls the record.

    Raises
    ------
    PlanningError
        If the domain plans about things of pictures, and the record names none.

    Examples
    --------
    >>> from seewhy.knowledge.history import read_history
    >>> from seewhy.planning.domain import load_planning_domain
    >>> table = load_planning_domain("tabletop")
    >>> run = read_history("shape(thing1, cube). colour(thing2, red). "
    ...     "observed on(thing1, thing2) at 0.", table.knowledge.signature)
    >>> about = domain_of_record(table, run)
    >>> about.words.name("thing1"), about.words.name("thing2")
    ('the cube', 'the red thing')
    """
    if domain.at_first is None:
        return domain
    things, signature = domain.at_first.things, domain.knowledge.signature
    scene = _scene(things, signature, record)
    if not scene.count:
        raise PlanningError(
            f"{name}: names no {things.one} such as {domain.at_first.term(0)}, so nothing was done "
            "in it; take it out of the folder, or record the run anew"
        )
    return domain.about(scene)


def seen_statics(domain: PlanningDomain) -> tuple[Literal, ...]:
    """Return what is seen of the things of a scene and never changes, as a record says it.

    That a thing has no other value than the one that is seen is not said.
    """
    if domain.at_first is None:
        return ()
    features, predicates = domain.at_first.things.features, domain.knowledge.signature.predicates
    return tuple(
        axiom.head
        for axiom in domain.seen_axioms
        if axiom.head.positive
        or axiom.head.predicate not in features
        or len(predicates[axiom.head.predicate].sorts) == 1
    )


def _scene(things: Things, signature: Signature, record: History) -> ThingScene:
    """The scene of a record: as many things as it names, with what it says of them.

    What may change of them is left open: the record has it as observations.
    """
    said = set(record.statics)
    every = (
        *record.statics,
        *(observation.literal for observation in record.observations),
        *(occurrence.action for occurrence in record.occurrences),
    )
    named = {argument for literal in every for argument in literal.arguments}
    terms = [f"{things.sort}{number}" for number in range(1, things.most + 1)]
    count = max((place for place, term in enumerate(terms, start=1) if term in named), default=0)
    values: list[dict[str, str | None]] = [
        {
            key: value
            for key in filter(signature.predicates.__contains__, things.features)
            for value, literal in literals_about(
                signature.predicates[key], (term,), signature
            ).items()
            if literal in said
        }
        for term in terms[:count]
    ]
    pairs = dict(_pairs(things, said, terms[:count]))
    return thing_scene(
        things,
        values,
        relations={key: holding for key, (holding, _) in pairs.items()},
        not_known={key: unknown for key, (_, unknown) in pairs.items()},
    )


def _pairs(
    things: Things, said: set[Literal], terms: Sequence[str]
) -> Iterator[tuple[str, tuple[list[tuple[int, int]], list[tuple[int, int]]]]]:
    """Relations of which something is said: between which things they hold, and may hold."""
    for key in things.relations:
        if not any(literal.predicate == key for literal in said):
            continue
        every = {
            (one, other): Literal(key, (terms[one], terms[other]))
            for one, other in permutations(range(len(terms)), 2)
        }
        yield (
            key,
            (
                [pair for pair, literal in every.items() if literal in said],
                [
                    pair
                    for pair, literal in every.items()
                    if not said & {literal, literal.complement}
                ],
            ),
        )
