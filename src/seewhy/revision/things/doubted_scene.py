"""A scene of several things of which an answer is doubted, and the rules behind the answer."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from seewhy.agent.learning_from_pictures import AnnotatedScenes
from seewhy.agent.things.thing_axioms import as_few_things
from seewhy.agent.working_knowledge import working_knowledge
from seewhy.data.dataset import Dataset
from seewhy.domain.domain import Domain
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.justification import Node
from seewhy.knowledge.why import why
from seewhy.revision.edit import FileName
from seewhy.revision.proposal import Doubted

__all__ = ["axioms_behind", "doubted_scene", "scenes_with_things"]


def doubted_scene(
    domain: Domain,
    texts: Mapping[FileName, str],
    vector: tuple[str | None, ...],
    scenes: AnnotatedScenes,
    *,
    wanted: str | None = None,
) -> Doubted:
    """Return a scene of things, and annotated ones, with what proposals are judged by.

    All of it is for as many things as the fullest of the scenes has: the fewer there may be, the
    faster is reasoned about them.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("tabletop")
    >>> one = domain.vector({"thing(thing1)": "yes"})
    >>> doubted = doubted_scene(domain, {}, one, AnnotatedScenes((), (), ()))
    >>> doubted.known.domain.things.most, len(doubted.vector), len(one)
    (1, 5, 590)
    """
    beside = replace(
        scenes,
        vectors=(*scenes.vectors, vector),
        labels=(*scenes.labels, ""),
        pictures=(*scenes.pictures, ""),
    )
    few, cut = as_few_things(domain, beside)
    kept = AnnotatedScenes(cut.vectors[:-1], scenes.labels, scenes.pictures)
    return Doubted(working_knowledge(few), dict(texts), cut.vectors[-1], kept, wanted)


def scenes_with_things(dataset: Dataset) -> AnnotatedScenes:
    """Return the scenes of a dataset with a class whose things are annotated, or that have none.

    Examples
    --------
    >>> from pathlib import Path
    >>> from seewhy.domain.domain import load_domain
    >>> scenes_with_things(Dataset((), load_domain("tabletop"), Path("data"))).labels
    ()
    """
    rows = [
        (vector, scene.label, dataset.name_of(scene))
        for scene, vector in zip(dataset.scenes, dataset.vectors, strict=True)
        if scene.label is not None and (scene.things or scene.no_things)
    ]
    return AnnotatedScenes(
        tuple(vector for vector, _, _ in rows),
        tuple(label for _, label, _ in rows),
        tuple(name for _, _, name in rows),
    )


def axioms_behind(doubted: Doubted, reasons: Node | None = None) -> tuple[Axiom, ...]:
    """Return the axioms by which a scene is of its class, and those that an answer rests on.

    Those come first that conclude the class. Where the beliefs contradict each other, or several
    classes are believed, all that apply are behind it.

    Parameters
    ----------
    doubted : Doubted
    reasons : Node, optional
        The justification of the answer.
    """
    domain, decision = doubted.known.domain, doubted.decision
    axioms = {axiom.identifier: axiom for axiom in domain.knowledge.axioms}
    by_statement = {str(axiom): axiom for axiom in axioms.values()}
    classes = {scene_class.literal.predicate for scene_class in domain.classes.values()}
    found: list[Axiom] = []
    if decision.label is not None:
        node = why(doubted.known.reasoner, doubted.vector, domain.classes[decision.label].literal)
        found += _used(node, by_statement)
    elif (believed := doubted.known.reasoner.answer_set(doubted.vector)) is not None:
        applied = [axioms[name] for name in believed.firings]
        found += [each for each in applied if believed.conflict or each.head.predicate in classes]
    found += _used(reasons, by_statement)
    once = {axiom.identifier: axiom for axiom in found}
    return tuple(sorted(once.values(), key=lambda axiom: axiom.head.predicate not in classes))


def _used(node: Node | None, axioms: Mapping[str, Axiom]) -> list[Axiom]:
    """The axioms that a justification uses; those of another count of things are found by text."""
    if node is None:
        return []
    return [
        axioms[str(each.axiom)]
        for each in node.walk()
        if each.axiom is not None and each.holds and str(each.axiom) in axioms
    ]
