"""One picture's things as they are annotated: what is seen of each, what holds between two."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Protocol

from seewhy.domain.things import Things
from seewhy.errors import DatasetError
from seewhy.knowledge.justification import Node
from seewhy.text.nearest import did_you_mean

__all__ = ["Conclusions", "Position", "ThingScene", "thing_scene"]

Position = tuple[float, float, float]
"""Where the middle of a thing is: to the right, downwards or backwards, up; of any one unit."""

MOST_THINGS = 100
"""Things of a picture: questions about more would take too long."""


class Conclusions(Protocol):
    """What concludes what follows in a scene, and tells why.

    ``without`` are things that are taken as not there.
    """

    def conclude(self, scene: ThingScene, without: int = 0) -> ThingScene:
        """Return a scene with what follows from what is seen in it, anew."""

    def why(
        self,
        scene: ThingScene,
        key: str,
        numbers: Sequence[int],
        names: Sequence[str],
        *,
        without: int = 0,
    ) -> Node:
        """Return why something is concluded of things, which are called by names, or is not."""

    def why_class(
        self, scene: ThingScene, label: str, names: Sequence[str], *, without: int = 0
    ) -> Node:
        """Return why the picture as a whole is of a class, or why it is not."""

    def rests_on(self, key: str) -> frozenset[str]:
        """Return the features and relations that are seen, and on which a predicate rests."""

    def rest_on(self, keys: Iterable[str], predicate: str) -> bool:
        """Whether one of some predicates is a predicate, or rests on it."""

    def when_taken_away(self, scene: ThingScene, without: int) -> ThingScene:
        """Return a scene from which things are taken away, with what then follows.

        Other than where they never were, what would fall without them falls.
        """


@dataclass(frozen=True)
class ThingScene:
    """The things of a picture.

    Sets of things are whole numbers, a bit a thing: the first thing has the lowest bit.

    Attributes
    ----------
    image : str
        What the picture is called.
    count : int
        How many things there are.
    values : mapping of str to tuple
        Feature → the value of each thing; None where it is not known.
    related : mapping of str to tuple
        Relation → for each thing, the set of those that stand in it to that thing: those that
        are left of it.
    unknown : mapping of str to tuple
        Relation → for each thing, the set of those of which that is not known.
    positions : tuple of Position
        Of each thing; empty where nothing is said of them.
    concluded : mapping of str to int
        What axioms conclude of things → the set of those of which it is so.
    groups : mapping of str to tuple
        What axioms conclude of several things together → those of which it is so, each as the
        numbers of its things.
    unsettled : int
        The set of things that come to be elsewhere, since what they need is taken away: nothing
        but that is known of them.
    label : str or None
        The class of the picture as a whole; None where none is concluded or seen.
    label_seen : bool
        Whether eyes saw the class, where axioms leave it open.
    consistent : bool
        Whether what is seen, and what follows from it, contradicts nothing.
    conclusions : Conclusions or None
        What concluded that, and would conclude it of a scene that is otherwise.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> things = load_domain("tabletop").things
    >>> scene = thing_scene(
    ...     things, [{"colour": "red"}, {"colour": "blue"}], relations={"left": [(0, 1)]})
    >>> scene.values["colour"], scene.related["left"], scene.related["right"]
    (('red', 'blue'), (0, 1), (2, 0))
    """

    image: str
    count: int
    values: Mapping[str, tuple[str | None, ...]]
    related: Mapping[str, tuple[int, ...]]
    unknown: Mapping[str, tuple[int, ...]] = field(default_factory=dict)
    positions: tuple[Position, ...] = ()
    concluded: Mapping[str, int] = field(default_factory=dict)
    groups: Mapping[str, tuple[tuple[int, ...], ...]] = field(default_factory=dict)
    unsettled: int = 0
    label: str | None = None
    label_seen: bool = False
    consistent: bool = True
    conclusions: Conclusions | None = field(default=None, compare=False, repr=False)


def thing_scene(
    things: Things,
    values: Sequence[Mapping[str, str | None]],
    *,
    relations: Mapping[str, Sequence[tuple[int, int]]],
    not_known: Mapping[str, Sequence[tuple[int, int]]] = MappingProxyType({}),
    positions: Sequence[Position] = (),
    image: str = "",
) -> ThingScene:
    """Return a scene of what is said of each thing, counted from 0, and of pairs of them.

    What is said of a relation says its converse. Of a relation that is not among ``relations``,
    nor is its converse, nothing is known.

    Raises
    ------
    DatasetError
        Where a feature, a value or a relation is none of the domain's, or a thing is not there.
    """
    count = len(values)
    if count > min(MOST_THINGS, things.most):
        raise DatasetError(
            f"{image or 'the picture'}: has {count} things, and the domain at most {things.most}; "
            "raise most under [things]"
        )
    return ThingScene(
        image=image,
        count=count,
        values=_values(things, values, image),
        related=_pairs(things, relations, count, image),
        unknown=_not_known(things, relations, not_known, count, image),
        positions=tuple(positions),
    )


def _values(
    things: Things, values: Sequence[Mapping[str, str | None]], image: str
) -> dict[str, tuple[str | None, ...]]:
    for number, said in enumerate(values, start=1):
        for key, value in said.items():
            place = f"{image or 'the picture'}, thing {number}"
            if key not in things.features:
                raise DatasetError(
                    f"{place}: '{key}' is no feature of things; "
                    f"{did_you_mean(key, things.features)}"
                )
            known = things.features[key].values
            if value is not None and value not in known:
                raise DatasetError(
                    f"{place}: '{value}' is no value of '{key}'; {did_you_mean(value, known)}"
                )
    return {key: tuple(said.get(key) for said in values) for key in things.features}


def _pairs(
    things: Things, relations: Mapping[str, Sequence[tuple[int, int]]], count: int, image: str
) -> dict[str, tuple[int, ...]]:
    related = {key: [0] * count for key in things.relations}
    for key, pairs in relations.items():
        if key not in things.relations:
            raise DatasetError(
                f"{image or 'the picture'}: '{key}' is no relation; "
                f"{did_you_mean(key, things.relations)}"
            )
        converse = things.relations[key].converse
        for subject, thing in pairs:
            for number in (subject, thing):
                if not 0 <= number < count:
                    raise DatasetError(
                        f"{image or 'the picture'}: '{key}' holds of thing {number}, which is not "
                        f"there; there are {count}, counted from 0"
                    )
            related[key][thing] |= 1 << subject
            if converse is not None:
                related[converse][subject] |= 1 << thing
    return {key: tuple(rows) for key, rows in related.items()}


def _not_known(
    things: Things,
    relations: Mapping[str, Sequence[tuple[int, int]]],
    not_known: Mapping[str, Sequence[tuple[int, int]]],
    count: int,
    image: str,
) -> dict[str, tuple[int, ...]]:
    everything = (1 << count) - 1
    unknown = _pairs(things, not_known, count, image)
    for key, relation in things.relations.items():
        if key not in relations and relation.converse not in relations:
            unknown[key] = tuple(everything & ~(1 << thing) for thing in range(count))
    return unknown
