"""A domain in which things may lose what they need: what would fall without it falls.

That a thing is not there says nothing about those that stood on it: they are as if they had been
put down. Where somebody takes it away, the domain says with ``removed`` what follows of the others.
So it is a feature of things that what they need is taken away, from which an axiom concludes what
is said. As nobody knows where such a thing comes to lie, no other axiom concludes anything of it.
"""

from __future__ import annotations

from dataclasses import replace
from types import MappingProxyType

from seewhy.domain.domain import Domain
from seewhy.domain.things import ThingFeature, Things
from seewhy.knowledge.axiom import Axiom, Condition, Literal
from seewhy.knowledge.signature import Predicate, PredicateKind

__all__ = ["loss_of", "with_losses"]


def loss_of(conclusion: str) -> str:
    """Return the feature of a thing that is taken what it needs for a conclusion not to be so."""
    return f"{conclusion}_by_loss"


def with_losses(domain: Domain) -> Domain:
    """Return a domain whose things may lose what they need.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> tabletop = with_losses(load_domain("tabletop"))
    >>> print(tabletop.knowledge.axioms[-1])
    falls(X) if falls_by_loss(X).
    """
    things, knowledge = domain.things, domain.knowledge
    assert things is not None, "the domain has no things"
    features, predicates = dict(things.features), dict(knowledge.signature.predicates)
    axioms = list(knowledge.axioms)
    for key, relation in things.relations.items():
        if relation.removed is None or loss_of(relation.removed) in features:
            continue
        name = loss_of(relation.removed)
        features[name] = _feature(name)
        known = predicates[relation.removed]
        predicates[name] = Predicate(name, known.sorts, PredicateKind.STATIC, known.location)
        said = next((axiom for axiom in knowledge.axioms if axiom.head.predicate == key), None)
        axioms = [_unless_lost(axiom, things, name) for axiom in axioms]
        if said is not None:
            axioms.append(_axiom(said, relation.removed, name))
    signature = replace(knowledge.signature, predicates=predicates)
    return replace(
        domain,
        things=replace(things, features=MappingProxyType(features)),
        knowledge=replace(knowledge, signature=signature, axioms=tuple(axioms)),
    )


def _unless_lost(axiom: Axiom, things: Things, name: str) -> Axiom:
    """An axiom that concludes nothing of a thing that loses what it needs."""
    if axiom.head.predicate not in things.conclusions:
        return axiom
    lost = Literal(name, axiom.head.arguments)
    return replace(axiom, body=(*axiom.body, Condition(f"not {lost}", lost, absent=True)))


def _axiom(said: Axiom, removed: str, name: str) -> Axiom:
    """What loses what it needs falls; told as the domain tells what would fall without what."""
    lost = Literal(name, ("X",))
    return replace(
        said,
        identifier=f"{said.identifier}_by_loss",
        head=Literal(removed, ("X",)),
        body=(Condition(str(lost), lost),),
    )


def _feature(name: str) -> ThingFeature:
    said = {"yes": "what {it} needs is taken away", "no": "nothing that {it} needs is taken away"}
    nothing: dict[str, tuple[str, ...]] = {"yes": (), "no": ()}
    return ThingFeature(name, name, ("yes", "no"), said, nothing, nothing, (name,))
