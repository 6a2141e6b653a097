"""A scene of things that somebody writes as NAME.FEATURE=VALUE and RELATION=NAME,NAME."""

from __future__ import annotations

from collections.abc import Sequence

from seewhy.data.listed_relations import contradicted, not_listed
from seewhy.data.scene_vector import vector_with_things
from seewhy.data.thing import Related, Thing
from seewhy.domain.assignments import named_values
from seewhy.domain.domain import Domain
from seewhy.domain.things import Things
from seewhy.errors import DomainError
from seewhy.knowledge.scene import FeatureVector
from seewhy.text.nearest import did_you_mean

__all__ = ["named_scene", "supposed"]


def named_scene(
    domain: Domain, assignments: Sequence[str], *, closed: bool = True
) -> tuple[FeatureVector, tuple[Thing, ...]]:
    """Return the vector of a scene that is written down, and the things in it.

    ``cup.colour=red`` says what is seen of a thing, ``on=cup,book`` that one stands in a relation
    to another, ``-on=cup,book`` that it does not, and ``thing=cup`` only that there is one. Things
    are in the order in which they are named first. Of a relation that is said of any two, what is
    not said is not so, unless ``closed`` is False. What has no dot is of the picture as a whole.

    Raises
    ------
    DomainError, DatasetError
        If one is no such assignment, or names what there is not.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("tabletop")
    >>> vector, things = named_scene(domain, ["cup.colour=red", "left=cup,book"])
    >>> [thing.name for thing in things]
    ['cup', 'book']
    >>> shown = dict(zip(domain.schema.features, vector))
    >>> shown["left(thing1,thing2)"], shown["right(thing2,thing1)"], shown["left(thing2,thing1)"]
    ('yes', 'yes', 'no')
    """
    things = domain.things
    assert things is not None, "the domain has no things"
    values: dict[str, dict[str, str]] = {}
    related: list[Related] = []
    of_picture: list[str] = []
    for assignment in assignments:
        name, sign, value = (part.strip() for part in assignment.partition("="))
        relation = name.removeprefix("-")
        if not sign or not value:
            raise DomainError(
                f"'{assignment}' gives no value; write NAME.FEATURE=VALUE or RELATION=NAME,NAME, "
                f"as in cup.{next(iter(things.features))}="
                f"{next(iter(things.features.values())).values[0]}"
            )
        if "." in name:
            thing, _, feature = name.partition(".")
            _take(values.setdefault(thing, {}), feature, value, assignment, things)
        elif name == things.sort:
            for thing in value.split(","):
                values.setdefault(thing.strip(), {})
        elif relation in things.relations:
            pair = [thing.strip() for thing in value.split(",")]
            if len(pair) != 2 or not all(pair):
                raise DomainError(f"'{assignment}' must name two things, as in {relation}=cup,book")
            for thing in pair:
                values.setdefault(thing, {})
            related.append(Related(relation, pair[0], pair[1], not name.startswith("-")))
        else:
            if name not in domain.features:
                known = (*domain.features, *things.relations, things.sort)
                raise DomainError(
                    f"'{name}' is no feature of the picture and no relation; what is seen of a "
                    f"thing is written as NAME.FEATURE=VALUE; {did_you_mean(name, known)}"
                )
            of_picture.append(assignment)
    found = tuple(Thing(name, said) for name, said in values.items())
    if (both := contradicted(related, things)) is not None:
        raise DomainError(
            f"'{both[1].relation}' of '{both[1].thing}' and '{both[1].other}' is said in two ways; "
            "leave one out"
        )
    if closed:
        related += not_listed(related, found, things, {relation.relation for relation in related})
    whole = tuple(map(named_values(domain, of_picture).get, domain.features))
    return vector_with_things(domain, whole, found, related), found


def _take(values: dict[str, str], feature: str, said: str, assignment: str, things: Things) -> None:
    if feature not in things.features:
        raise DomainError(
            f"'{assignment}': '{feature}' is no feature of things; "
            f"{did_you_mean(feature, things.features)}"
        )
    value = things.features[feature].value_called(said)
    if value is None:
        raise DomainError(
            f"'{assignment}': '{said}' is no value of '{feature}'; "
            f"{did_you_mean(said, things.features[feature].values)}"
        )
    if values.setdefault(feature, value) != value:
        raise DomainError(
            f"'{assignment}': '{feature}' is given twice, {values[feature]} and {value}; leave "
            "one out"
        )


def supposed(
    domain: Domain, vector: FeatureVector, names: Sequence[str], assignments: Sequence[str]
) -> FeatureVector:
    """Return the vector of a scene in which some of what is seen is otherwise.

    Parameters
    ----------
    domain : Domain
    vector : FeatureVector
    names : sequence of str
        How the things that are there are called, in their order.
    assignments : sequence of str
        As for :func:`named_scene`; ``-thing=cup`` takes the cup away.

    Raises
    ------
    DomainError, DatasetError
        As :func:`named_scene` does, and if a thing is taken away that is not there.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> tabletop = load_domain("tabletop")
    >>> cup, _ = named_scene(tabletop, ["cup.colour=red"])
    >>> painted = supposed(tabletop, cup, ["cup"], ["cup.colour=blue"])
    >>> dict(zip(tabletop.schema.features, painted))["colour(thing1)"]
    'blue'
    >>> gone = supposed(tabletop, cup, ["cup"], ["-thing=cup"])
    >>> dict(zip(tabletop.schema.features, gone))["thing(thing1)"]
    'no'
    """
    things, schema = domain.things, domain.schema
    assert things is not None, "the domain has no things"
    away = f"-{things.sort}="
    gone = [said.replace(" ", "").removeprefix(away) for said in assignments if _takes(said, away)]
    others = [said for said in assignments if not _takes(said, away)]
    terms = dict(zip(names, schema.presence, strict=False))
    for name in gone:
        if name not in terms:
            raise DomainError(f"'{name}' is no thing here; {did_you_mean(name, terms)}")
    there = [f"{things.sort}={','.join(names)}"] if names else []
    said, _ = named_scene(domain, [*there, *others], closed=False)
    values: dict[str, str | None] = dict(zip(schema.features, vector, strict=True))
    absent = dict.fromkeys(schema.presence.values(), "no")
    values |= {
        feature: value
        for feature, value in zip(schema.features, said, strict=True)
        if value is not None and value != absent.get(feature)
    }
    for name in gone:
        presence = schema.presence[terms[name]]
        values[presence] = "no"
        values |= {feature: None for feature, needs in schema.requires.items() if presence in needs}
    return schema.vector(values)


def _takes(assignment: str, away: str) -> bool:
    return assignment.replace(" ", "").startswith(away)
