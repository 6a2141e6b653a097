"""What is seen of the things in a picture, as features that the reasoner is grounded with once.

A thing that is there or not, its colour, and that it stands on another are each one feature, like
those of the picture as a whole: a choice among literals that is settled by an assumption. So all
that works for the features of a picture works for things, and a picture without things is the
special case in which there are none of these features.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from itertools import permutations

from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.scene import SceneSchema
from seewhy.knowledge.signature import Predicate, Signature

__all__ = ["literals_about", "of_things", "schema_with_things", "things_of"]


def literals_about(
    predicate: Predicate, subject: tuple[str, ...], signature: Signature
) -> dict[str, Literal]:
    """Return the literal of every value that a feature has of a subject.

    The subject takes the first arguments. Where one is left, its sort lists the values; where
    none is, they are yes and no.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge("#sort hue = {red, blue}. #sort thing = things. "
    ...                        "#static colour(thing, hue).").with_things(2).signature
    >>> list(map(str, literals_about(known.predicates["colour"], ("thing2",), known).values()))
    ['colour(thing2, red)', 'colour(thing2, blue)']
    """
    name = predicate.name
    if len(predicate.sorts) == len(subject):
        seen = Literal(predicate=name, arguments=subject)
        return {"yes": seen, "no": seen.complement}
    return {
        value: Literal(predicate=name, arguments=(*subject, value))
        for value in signature.members(predicate.sorts[-1])
    }


def of_things(name: str, *things: str) -> str:
    """Return what a feature of one thing, or a relation of several, is called in a schema.

    Examples
    --------
    >>> of_things("on", "block1", "block2")
    'on(block1,block2)'
    """
    return f"{name}({','.join(things)})"


def things_of(feature: str) -> tuple[str, tuple[str, ...]]:
    """Return the predicate and the things of a feature; no things for one of the picture.

    Examples
    --------
    >>> things_of("on(block1,block2)"), things_of("lean")
    (('on', ('block1', 'block2')), ('lean', ()))
    """
    name, _, inside = feature.rstrip(")").partition("(")
    return name, tuple(inside.split(",")) if inside else ()


def schema_with_things(
    schema: SceneSchema, signature: Signature, seen: Iterable[str]
) -> SceneSchema:
    """Return a schema in which things are seen, too.

    Parameters
    ----------
    schema : SceneSchema
        Of the features of the picture as a whole.
    signature : Signature
        Of knowledge that was counted by :meth:`~seewhy.knowledge.language.Knowledge.with_things`.
    seen : iterable of str
        The statics that are seen of things, or measured between two of them. All others about
        things are concluded.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge("#sort picture. #sort thing = things. #static on(thing, thing).")
    >>> schema = SceneSchema("picture", {}, {}, {})
    >>> list(schema_with_things(schema, known.with_things(2).signature, ["on"]).features)
    ['thing(thing1)', 'thing(thing2)', 'on(thing1,thing2)', 'on(thing2,thing1)']
    """
    found = signature.sort_of_things
    assert found is not None, "there is no sort of things"
    assert found.members is not None, "the things are not counted"
    presence = {thing: of_things(found.name, thing) for thing in found.members}
    features: dict[str, Mapping[str, Literal]] = {
        feature: {
            "yes": (there := Literal(predicate=found.name, arguments=(thing,))),
            "no": there.complement,
        }
        for thing, feature in presence.items()
    }
    requires: dict[str, tuple[str, ...]] = {}
    for name in seen:
        predicate = signature.predicates[name]
        for subject in _subjects(predicate, found.name, found.members):
            feature = of_things(name, *subject)
            features[feature] = literals_about(predicate, subject, signature)
            requires[feature] = tuple(presence[thing] for thing in subject)
    return replace(
        schema,
        features={**schema.features, **features},
        requires=requires,
        presence=presence,
    )


def _subjects(
    predicate: Predicate, sort: str, things: tuple[str, ...]
) -> Iterator[tuple[str, ...]]:
    """The things, or the groups of different ones, that a predicate speaks of."""
    places = sum(1 for name in predicate.sorts if name == sort)
    yield from permutations(things, places)
