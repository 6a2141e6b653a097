"""Scenes of things as bits: for each thing of a scene, and each two, what is so of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from seewhy.domain.things import CONCLUDED, Things
from seewhy.induction.things.conditions import Alike, Alone, Atom, Grouped, HasValue, Related
from seewhy.knowledge.scene import FeatureVector, SceneSchema
from seewhy.knowledge.things import of_things

__all__ = ["Bits", "Concluded", "ThingTable", "as_bits", "count_bits", "either", "thing_table"]

Bits = NDArray[np.uint64]
"""A bit a scene along the last axis, 64 of them a number."""

_NONE = np.uint64(0)


def as_bits(holds: NDArray[np.bool_]) -> Bits:
    """Return a bit a scene, of shape (…, words), of an array of shape (…, scenes).

    Examples
    --------
    >>> as_bits(np.array([True, False, True])).tolist()
    [5]
    """
    packed = np.packbits(holds, axis=-1, bitorder="little")
    words = -(-holds.shape[-1] // 64)
    padded = np.zeros((*holds.shape[:-1], 8 * words), dtype=np.uint8)
    padded[..., : packed.shape[-1]] = packed
    return padded.view("<u8").astype(np.uint64)


def count_bits(bits: Bits) -> NDArray[np.int64]:
    """Return how many scenes are in each set, of shape (…).

    Examples
    --------
    >>> count_bits(as_bits(np.array([[True, False], [True, True]]))).tolist()
    [1, 2]
    """
    counts: NDArray[np.int64] = np.bitwise_count(bits).sum(axis=-1, dtype=np.int64)
    return counts


def either(sets: Sequence[Bits] | Bits, axis: int | tuple[int, ...] = 0) -> Bits:
    """Return the scenes that are in one of some sets.

    Examples
    --------
    >>> either(np.array([[1], [4]], dtype=np.uint64)).tolist()
    [5]
    """
    found: Bits = np.bitwise_or.reduce(np.asarray(sets, dtype=np.uint64), axis=axis)
    return found


@dataclass(frozen=True)
class Concluded:
    """What axioms conclude of the things of scenes.

    Attributes
    ----------
    of_one : mapping of str to ndarray of bool, (scenes, things)
    of_two : mapping of str to ndarray of bool, (scenes, things, things)
    of_three : mapping of str to ndarray of bool, (scenes, things, things, things)
        What does not depend on the order of the things.
    """

    of_one: Mapping[str, NDArray[np.bool_]] = field(default_factory=dict)
    of_two: Mapping[str, NDArray[np.bool_]] = field(default_factory=dict)
    of_three: Mapping[str, NDArray[np.bool_]] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class ThingTable:
    """Scenes, and what is known of the things in them. What is not known is not so.

    Attributes
    ----------
    scenes, things : int
        How many scenes, and how many things the fullest of them has.
    features : mapping of str to tuple of str
        Feature of things, or what axioms conclude of one → its values.
    whole : mapping of str to mapping
        Feature of the picture as a whole → value → the scenes that have it.
    values : mapping of str to mapping
        Feature of things → value → of which things of which scenes; bits of shape (things, words).
    relations : mapping of str to Bits
        Relation → of which two things, (things, things, words); of two converses only the first.
    groups : mapping of str to Bits
        What axioms conclude of three things, (things, things, things, words).
    present : Bits
        The things that are there, (things, words).
    compared : tuple of str
        The features of which two things may have the same value: those that are not yes or no.
    """

    scenes: int
    things: int
    features: Mapping[str, tuple[str, ...]]
    whole: Mapping[str, Mapping[str, Bits]]
    values: Mapping[str, Mapping[str, Bits]]
    relations: Mapping[str, Bits]
    groups: Mapping[str, Bits]
    present: Bits
    compared: tuple[str, ...] = ()

    @cached_property
    def known(self) -> dict[str, Bits]:
        """Feature → of which things its value is known."""
        return {key: either(list(by_value.values())) for key, by_value in self.values.items()}

    @property
    def all_scenes(self) -> Bits:
        """Every scene."""
        return as_bits(np.ones(self.scenes, dtype=bool))

    @cached_property
    def _different(self) -> NDArray[np.bool_]:
        return ~np.eye(self.things, dtype=bool)

    @cached_property
    def _combinations(self) -> dict[int, Bits]:
        return {}

    def combinations(self, count: int) -> Bits:
        """Return where so many different things are there, of shape (things, …, words)."""
        if count not in self._combinations:
            found = self.present
            for _ in range(count - 1):
                found = found[..., None, :] & self.present
            for first in range(count):
                for second in range(first + 1, count):
                    shape = [self.things if axis in (first, second) else 1 for axis in range(count)]
                    found = np.where(self._different.reshape(*shape, 1), found, _NONE)
            self._combinations[count] = found
        return self._combinations[count]

    def holding(self, atom: Atom) -> Bits:
        """Return of which things an atom holds, in the order of ``atom.things``."""
        match atom:
            case HasValue(feature=feature, value=value, holds=True):
                return self.values[feature][value]
            case HasValue(feature=feature, value=value):
                return self.known[feature] & ~self.values[feature][value]
            case Alone(relation=relation, inverse=inverse):
                some = either(self.relations[relation], axis=1 if inverse else 0)
                return self.present & ~some
            case Related(relation=relation):
                return self.relations[relation]
            case Alike(feature=feature, holds=holds):
                return self._alike(feature, holds)
            case Grouped(group=group):
                return self.groups[group]
        raise TypeError(f"must be an atom, got {atom!r}")

    def _alike(self, feature: str, holds: bool) -> Bits:
        by_value = self.values[feature].values()
        found = either([of[:, None] & of[None] for of in by_value])
        if not holds:
            known = self.known[feature]
            found = known[:, None] & known[None] & ~found
        return np.where(self._different[..., None], found, _NONE)


def thing_table(
    things: Things,
    schema: SceneSchema,
    vectors: Sequence[FeatureVector],
    *,
    concluded: Concluded | None = None,
) -> ThingTable:
    """Return scenes as a table, of the vectors that are reasoned with.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("tabletop").with_most_things(2)
    >>> shown = {"thing(thing1)": "yes", "colour(thing1)": "red"}
    >>> table = thing_table(domain.things, domain.schema, [domain.vector(shown)])
    >>> table.things, table.values["colour"]["red"].tolist()
    (1, [[1]])
    """
    columns = dict(zip(schema.features, zip(*vectors, strict=True), strict=False))
    terms = [term for term, feature in schema.presence.items() if "yes" in columns.get(feature, ())]
    terms = terms or list(schema.presence)[:1]

    def is_yes_or_no(key: str) -> bool:
        literals = schema.features[of_things(key, terms[0])]
        return not all(literal.positive for literal in literals.values())

    def where(feature: str, value: str) -> list[bool]:
        return [found == value for found in columns[feature]]

    def of_two(key: str) -> NDArray[np.bool_]:
        pairs = np.zeros((len(terms), len(terms), len(vectors)), dtype=bool)
        for at, term in enumerate(terms):
            for place, other in enumerate(terms):
                if at != place:
                    pairs[at, place] = where(of_things(key, term, other), "yes")
        return pairs

    values = {
        key: {
            value: as_bits(np.array([where(of_things(key, term), value) for term in terms]))
            for value in feature.values
        }
        for key, feature in things.features.items()
    }
    relations = {key: as_bits(of_two(key)) for key in _first_of_converses(things, concluded=False)}
    more = concluded or Concluded()
    count = len(terms)
    present = as_bits(np.array([where(schema.presence[term], "yes") for term in terms]))
    for key, holds in more.of_one.items():
        so = as_bits(np.moveaxis(holds[:, :count], 0, -1))
        values[key] = {"yes": so, "no": present & ~so}
    for key in _first_of_converses(things, concluded=True):
        if key in more.of_two:
            relations[key] = as_bits(np.moveaxis(more.of_two[key][:, :count, :count], 0, -1))
    return ThingTable(
        scenes=len(vectors),
        things=count,
        features={
            **{key: feature.values for key, feature in things.features.items()},
            **dict.fromkeys(more.of_one, ("yes", "no")),
        },
        whole={
            feature: {value: as_bits(np.array(where(feature, value))) for value in literals}
            for feature, literals in schema.features.items()
            if "(" not in feature
        },
        values=values,
        relations=relations,
        groups={
            key: as_bits(np.moveaxis(holds[:, :count, :count, :count], 0, -1))
            for key, holds in more.of_three.items()
        },
        present=present,
        compared=tuple(key for key in things.features if not is_yes_or_no(key)),
    )


def _first_of_converses(things: Things, *, concluded: bool) -> list[str]:
    """Relations, seen or concluded, of which the converse does not stand before them."""
    found: list[str] = []
    for key, relation in things.relations.items():
        if (relation.measure == CONCLUDED) is concluded and relation.converse not in found:
            found.append(key)
    return found
