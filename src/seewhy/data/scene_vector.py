"""What is annotated of a picture and of the things in it, as the vector that is reasoned with."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import permutations

from seewhy.data.measured import MEASURES, STANDING, feet
from seewhy.data.thing import Related, Thing
from seewhy.domain.domain import Domain
from seewhy.domain.things import Things
from seewhy.errors import DatasetError
from seewhy.knowledge.scene import FeatureVector
from seewhy.knowledge.things import of_things
from seewhy.text.nearest import did_you_mean

__all__ = ["feet_of", "terms_of", "vector_with_things"]


def terms_of(domain: Domain, things: Sequence[Thing]) -> dict[str, str]:
    """Return the name of each thing → its name in the knowledge, in the order given.

    Raises
    ------
    DatasetError
        If there are more things than the domain allows, or two of one name.
    """
    terms = list(domain.schema.presence)
    if len(things) > len(terms):
        raise DatasetError(
            f"there are {len(things)} things, and a picture of the domain '{domain.name}' has at "
            f"most {len(terms)}; leave some out, or raise most under [things] of its domain.toml"
        )
    found: dict[str, str] = {}
    for thing, term in zip(things, terms, strict=False):
        if thing.name in found:
            raise DatasetError(f"two things are called '{thing.name}'; call one otherwise")
        found[thing.name] = term
    return found


def vector_with_things(
    domain: Domain,
    vector: FeatureVector,
    things: Sequence[Thing],
    related: Sequence[Related] = (),
) -> FeatureVector:
    """Return the vector of a picture as a whole, of its things, and of what holds between them.

    Where both boxes are known, relations that have a measure are measured; where things stand is
    measured at the foot of their stacks, where the domain says what stands on what. What is said of
    a relation says its converse, and goes before what is measured.

    Parameters
    ----------
    domain : Domain
    vector : FeatureVector
        Of the features of the picture as a whole.
    things : sequence of Thing
    related : sequence of Related

    Raises
    ------
    DatasetError
        If there are too many things, or a relation or one of its things is none.

    Examples
    --------
    >>> from seewhy.data.thing import BoundingBox
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("tabletop")
    >>> cup = Thing("cup", {"colour": "red"}, BoundingBox(0, 0, 10, 10))
    >>> book = Thing("book", {}, BoundingBox(20, 0, 30, 10))
    >>> shown = dict(zip(domain.schema.features, vector_with_things(domain, (), [cup, book])))
    >>> shown["thing(thing2)"], shown["colour(thing1)"], shown["left(thing1,thing2)"]
    ('yes', 'red', 'yes')
    """
    if domain.things is None:
        return vector
    terms = terms_of(domain, things)
    values: dict[str, str | None] = dict(domain.named(vector))
    for thing in things:
        term = terms[thing.name]
        values[domain.schema.presence[term]] = "yes"
        values.update({of_things(key, term): value for key, value in thing.values.items()})
    boxes = {thing.name: thing.box for thing in things}
    standing = {
        name: boxes.get(foot) for name, foot in feet_of(domain.things, boxes, related).items()
    }
    for key, relation in domain.things.relations.items():
        measure = MEASURES.get(relation.measure)
        if measure is None:
            continue
        where = standing if relation.measure in STANDING else boxes
        for first, second in permutations(terms, 2):
            box, other = where[first], where[second]
            if box is not None and other is not None:
                feature = of_things(key, terms[first], terms[second])
                values[feature] = _yes_or_no(measure(box, other))
    for said in related:
        values.update(_said(domain, terms, said))
    return domain.schema.vector(values)


def feet_of(things: Things, names: Iterable[str], related: Iterable[Related]) -> dict[str, str]:
    """Return for each thing the one at the foot of its stack, as far as is said."""
    support = things.support
    if support is None:
        return {name: name for name in names}
    converse = things.relations[support].converse
    pairs = []
    for said in related:
        if said.holds and said.relation == support:
            pairs.append((said.thing, said.other))
        elif said.holds and said.relation == converse:
            pairs.append((said.other, said.thing))
    return feet(names, pairs)


def _said(domain: Domain, terms: dict[str, str], said: Related) -> dict[str, str | None]:
    """The features of what is said of a relation, and of its converse."""
    assert domain.things is not None
    relations = domain.things.relations
    if said.relation not in relations:
        raise DatasetError(
            f"'{said.relation}' is no relation of the domain '{domain.name}'; "
            f"{did_you_mean(said.relation, relations)}"
        )
    for name in (said.thing, said.other):
        if name not in terms:
            raise DatasetError(
                f"'{said.relation}' is said of '{name}', which is no thing here; "
                f"{did_you_mean(name, terms)}"
            )
    if said.thing == said.other:
        raise DatasetError(
            f"'{said.relation}' is said of '{said.thing}' and itself; name two things"
        )
    if said.relation not in domain.things.seen:
        raise DatasetError(
            f"'{said.relation}' is concluded by axioms and cannot be said; leave it out"
        )
    pair = (terms[said.thing], terms[said.other])
    value = None if said.holds is None else _yes_or_no(said.holds)
    found: dict[str, str | None] = {of_things(said.relation, *pair): value}
    converse = relations[said.relation].converse
    if converse is not None and converse in domain.things.seen:
        found[of_things(converse, *reversed(pair))] = value
    return found


def _yes_or_no(holds: bool) -> str:
    return "yes" if holds else "no"
