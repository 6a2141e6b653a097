"""Scenes of things by lot, and concepts of one to three things that some of them fall under.

A scene of the family ``zendo`` has two to five things of `tabletop` in four colours, in an order
from the left and another from the front; every second one of them is on one of those left of it. A
scene of ``set`` has four to six cards of `set_cards` in a row. A concept is drawn by lot among
those of a kind, until 15 to 80 % of scenes fall under it. Whether one does is told here, without
anything of what learns.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations, permutations

import numpy as np

from seewhy.domain.domain import Domain, load_domain
from seewhy.knowledge.scene import FeatureVector
from seewhy.knowledge.things import of_things

__all__ = [
    "FAMILIES",
    "Concept",
    "Family",
    "LotScene",
    "family_called",
    "random_concept",
    "random_scene",
]

_LEAST, _MOST = 0.15, 0.8
_DRAWS = 1000
_SAMPLE = 200
_COLOURS = ("gray", "red", "blue", "green")

Values = Mapping[str, str]
Description = tuple[tuple[str, str], ...]
"""Features and the values that they are to have."""


@dataclass(frozen=True)
class LotScene:
    """Things with their values; pairs of which the first stands in a relation to the second."""

    things: tuple[Values, ...]
    related: Mapping[str, frozenset[tuple[int, int]]]


@dataclass(frozen=True)
class Concept:
    """What scenes may fall under.

    Attributes
    ----------
    kind, text : str
        Which kind of concept it is, and the concept in words.
    literals : int
        How much it asks.
    holds : callable
        Whether a scene falls under it.
    """

    kind: str
    text: str
    literals: int
    holds: Callable[[LotScene], bool]


@dataclass(frozen=True)
class Family:
    """A domain, how many things its scenes have, and which of its relations are drawn."""

    domain: Domain
    fewest: int
    most: int
    relations: tuple[str, ...]
    kinds: tuple[str, ...]

    @property
    def values(self) -> dict[str, tuple[str, ...]]:
        """Feature → the values that are drawn."""
        assert self.domain.things is not None, "the domain has things"
        found = {key: feature.values for key, feature in self.domain.things.features.items()}
        return {
            key: tuple(value for value in values if value in _COLOURS)
            if len(values) > 3
            else values
            for key, values in found.items()
        }

    def vector(self, scene: LotScene) -> FeatureVector:
        """Return a scene as it is reasoned with."""
        schema, things = self.domain.schema, self.domain.things
        assert things is not None, "the domain has things"
        terms = list(schema.presence)
        shown: dict[str, str | None] = {}
        for number, values in enumerate(scene.things):
            shown[schema.presence[terms[number]]] = "yes"
            shown |= {of_things(key, terms[number]): value for key, value in values.items()}
        for relation in self.relations:
            converse = things.relations[relation].converse
            for pair in permutations(range(len(scene.things)), 2):
                value = "yes" if pair in scene.related[relation] else "no"
                first, second = (terms[number] for number in pair)
                shown[of_things(relation, first, second)] = value
                if converse is not None:
                    shown[of_things(converse, second, first)] = value
        return schema.vector(shown)


_ONE = ("there is", "there is none", "so many", "every one")
_ALIKE = ("two alike", "no two alike", "three alike", "three different")
_RELATED = ("one to another", "none to another", "one to another alike", "a chain of three")
_SEVERAL = ("both", "either")


@lru_cache
def family_called(name: str) -> Family:
    """Return a family by its name.

    Examples
    --------
    >>> family_called("set").domain.name
    'set_cards'
    """
    if name == "zendo":
        return Family(
            load_domain("tabletop").with_most_things(5), 2, 5, ("left", "in_front", "on"),
            (*_ONE, *_ALIKE, *_RELATED, *_SEVERAL),
        )  # fmt: skip
    return Family(
        load_domain("set_cards").with_most_things(6), 4, 6, ("left",),
        (*_ONE, *_ALIKE, "three alike and different", *_SEVERAL),
    )  # fmt: skip


FAMILIES = ("zendo", "set")


def random_scene(family: Family, rng: np.random.Generator) -> LotScene:
    """Draw lots for the things of a scene."""
    count = int(rng.integers(family.fewest, family.most + 1))
    things = tuple(
        {key: values[rng.integers(len(values))] for key, values in family.values.items()}
        for _ in range(count)
    )
    depth = rng.permutation(count)
    on = {(above, int(rng.integers(above))) for above in range(1, count) if rng.random() < 0.5}
    pairs = list(permutations(range(count), 2))
    related = {
        "left": frozenset((a, b) for a, b in pairs if a < b),
        "in_front": frozenset((a, b) for a, b in pairs if depth[a] < depth[b]),
        "on": frozenset(on),
    }
    return LotScene(things, {key: related[key] for key in family.relations})


def random_concept(family: Family, rng: np.random.Generator, kind: str) -> Concept:
    """Draw lots for a concept of a kind under which neither few nor most scenes fall."""
    sample = [random_scene(family, rng) for _ in range(_SAMPLE)]
    for _ in range(_DRAWS):
        concept = _drawn(family, rng, kind)
        share = sum(map(concept.holds, sample)) / len(sample)
        if _LEAST <= share <= _MOST:
            return concept
    raise ValueError(f"of {_DRAWS} concepts of the kind '{kind}' none is neither rare nor common")


def _drawn(family: Family, rng: np.random.Generator, kind: str) -> Concept:
    if kind in _SEVERAL:
        first, second = (
            _drawn(family, rng, kinds[rng.integers(len(kinds))]) for kinds in (_ONE[:2], _ONE[:3])
        )
        return _together(first, second, kind)
    if kind in _ONE:
        return _of_one(family, rng, kind)
    if kind in _RELATED:
        return _of_related(family, rng, kind)
    return _of_alike(family, rng, kind)


def _together(first: Concept, second: Concept, kind: str) -> Concept:
    join = all if kind == "both" else any
    word = "and" if kind == "both" else "or"
    return Concept(
        kind,
        f"{first.text} {word} {second.text}",
        first.literals + second.literals,
        lambda scene: join((first.holds(scene), second.holds(scene))),
    )


def _described(family: Family, rng: np.random.Generator, size: int) -> Description:
    features = [list(family.values)[at] for at in rng.permutation(len(family.values))[:size]]
    return tuple(
        (key, family.values[key][rng.integers(len(family.values[key]))]) for key in features
    )


def _fits(thing: Values, description: Description) -> bool:
    return all(thing[key] == value for key, value in description)


def _words(description: Description) -> str:
    return " ".join([value for _, value in description] + ["thing"])


def _of_one(family: Family, rng: np.random.Generator, kind: str) -> Concept:
    description = _described(family, rng, 1 if kind == "so many" else int(rng.integers(1, 3)))
    words = _words(description)

    def count(scene: LotScene) -> int:
        return sum(_fits(thing, description) for thing in scene.things)

    size = len(description)
    if kind == "there is":
        return Concept(kind, f"there is a {words}", size, lambda scene: count(scene) > 0)
    if kind == "there is none":
        return Concept(kind, f"there is no {words}", size, lambda scene: count(scene) == 0)
    if kind == "so many":
        least = int(rng.integers(2, 4))
        text = f"there are at least {least} {words}s"
        return Concept(kind, text, size + 1, lambda scene: count(scene) >= least)
    of, then = _described(family, rng, 2)
    return Concept(
        kind, f"every {_words((of,))} is {then[1]}", 2,
        lambda scene: all(
            _fits(thing, (then,)) for thing in scene.things if _fits(thing, (of,))
        ),
    )  # fmt: skip


def _of_related(family: Family, rng: np.random.Generator, kind: str) -> Concept:
    relation = family.relations[rng.integers(len(family.relations))]
    first, second = _described(family, rng, 1), _described(family, rng, 1)
    if kind == "a chain of three":
        third = _described(family, rng, 1)
        return Concept(
            kind,
            f"there is a {_words(first)} {relation} a thing that is {relation} a {_words(third)}",
            4,
            lambda scene: any(
                (a, b) in scene.related[relation] and (b, c) in scene.related[relation]
                for a, b, c in permutations(range(len(scene.things)), 3)
                if _fits(scene.things[a], first) and _fits(scene.things[c], third)
            ),
        )
    key = list(family.values)[rng.integers(len(family.values))]
    alike = kind == "one to another alike"

    def holds(scene: LotScene) -> bool:
        return any(
            _fits(scene.things[a], first)
            and _fits(scene.things[b], () if alike else second)
            and (not alike or scene.things[a][key] == scene.things[b][key])
            for a, b in scene.related[relation]
        )

    to = f"a thing of the same {key}" if alike else f"a {_words(second)}"
    if kind == "none to another":
        return Concept(
            kind, f"there is no {_words(first)} {relation} {to}", 3, lambda scene: not holds(scene)
        )
    return Concept(kind, f"there is a {_words(first)} {relation} {to}", 3, holds)


def _of_alike(family: Family, rng: np.random.Generator, kind: str) -> Concept:
    several = int(rng.integers(1, 3)) if kind in ("two alike", "no two alike") else 1
    keys = [list(family.values)[at] for at in rng.permutation(len(family.values))[:several]]
    another = list(family.values)[rng.integers(len(family.values))]
    size = 3 if kind.startswith("three") else 2

    def same(chosen: Sequence[Values], key: str) -> bool:
        return len({thing[key] for thing in chosen}) == 1

    def different(chosen: Sequence[Values], key: str) -> bool:
        return len({thing[key] for thing in chosen}) == len(chosen)

    def fits(chosen: Sequence[Values]) -> bool:
        if kind == "three different":
            return different(chosen, keys[0])
        if kind == "three alike and different":
            return same(chosen, keys[0]) and different(chosen, another)
        return all(same(chosen, key) for key in keys)

    def some(scene: LotScene) -> bool:
        return any(map(fits, combinations(scene.things, size)))

    literals = {"three alike": 2, "three different": 3, "three alike and different": 5}
    named = " and ".join(keys)
    texts = {
        "two alike": f"there are two things of the same {named}",
        "no two alike": f"there are no two things of the same {named}",
        "three alike": f"there are three things of the same {named}",
        "three different": f"there are three things that all differ in {named}",
        "three alike and different": f"there are three things of the same {named} that all differ "
        f"in {another}",
    }
    holds = (lambda scene: not some(scene)) if kind == "no two alike" else some
    return Concept(kind, texts[kind], literals.get(kind, len(keys)), holds)
