"""The changes of a scene that may matter to a question: what it does not speak of is left."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, fields, is_dataclass
from itertools import product

from seewhy.data.thing_scene import ThingScene
from seewhy.dialogue.things.edits import (
    Add,
    Edit,
    Move,
    Recolour,
    Relate,
    Remove,
    is_in_order,
    values_to_try,
)
from seewhy.dialogue.things.query import (
    ClassIs,
    Compares,
    Concluded,
    Condition,
    Corner,
    Extreme,
    Groups,
    HasValue,
    MostCommon,
    Occurring,
    PartOf,
    Query,
    Ranked,
    Related,
    SameValue,
    Shares,
    Together,
    ValueOf,
    WhichClass,
)
from seewhy.domain.things import CONCLUDED, Things

__all__ = ["PossibleEdits", "are_apart", "possible_edits"]

_MOST_ADDED = 20_000


@dataclass(frozen=True)
class PossibleEdits:
    """The changes by one that may matter.

    Attributes
    ----------
    plain : tuple of Edit
        All but one thing more.
    additions : tuple of Add or None
        The things that may be added; None where there are too many of them to try.
    concluded : bool
        Whether the question is about what axioms conclude, so that it has to be concluded anew.
    """

    plain: tuple[Edit, ...]
    additions: tuple[Add, ...] | None
    concluded: bool


def possible_edits(about: Query | Condition, scene: ThingScene, things: Things) -> PossibleEdits:
    """Return the changes that may matter to a question, or to a condition."""
    spoken = _Spoken()
    spoken.read(about)
    if isinstance(about, ClassIs | WhichClass):
        spoken.concluded |= {known.literal.predicate for known in things.whole.classes.values()}
    spoken.resting(scene, things)
    tried = dict(values_to_try(things, spoken.values, spoken.compared))
    orders = _one_way(things, {key for key in spoken.relations if is_in_order(scene, key)})
    loose = _one_way(things, {r for r in spoken.relations if not is_in_order(scene, r)})
    full = scene.conclusions is not None and scene.count >= things.most
    adding = None if full else _additions(scene, tried, orders, loose)
    return PossibleEdits(
        tuple(_edits(scene, tried, orders, loose)),
        None if adding is None else tuple(adding),
        scene.conclusions is not None and bool(spoken.concluded),
    )


def are_apart(edits: tuple[Edit, ...]) -> bool:
    """Return whether changes are of different things or features: nothing is changed twice."""
    touched: set[object] = set()
    removed = {edit.number for edit in edits if isinstance(edit, Remove)}
    for edit in edits:
        match edit:
            case Recolour(number=number, feature=what) | Move(number=number, relation=what):
                key: object = (number, what)
            case Relate(number=number, relation=what, to=to):
                key = (number, what, to)
            case Remove(number=number):
                key = number
            case _:
                key = "add"  # one thing more at a time keeps the search small
        if key in touched or (not isinstance(edit, Remove | Add) and edit.number in removed):
            return False
        touched.add(key)
    return True


@dataclass
class _Spoken:
    """What a question speaks of."""

    values: dict[str, set[str]] = field(default_factory=dict)
    compared: set[str] = field(default_factory=set)
    relations: set[str] = field(default_factory=set)
    concluded: set[str] = field(default_factory=set)

    def read(self, part: object) -> None:
        match part:
            case HasValue(feature=feature, value=value):
                self.values.setdefault(feature, set()).add(value)
            case Shares(feature=feature) | Compares(feature=feature) | Ranked(feature=feature):
                self.compared.add(feature)
            case ValueOf(feature=feature) | SameValue(feature=feature):
                self.compared.add(feature)
            case MostCommon(feature=feature) | Occurring(feature=feature):
                self.compared.add(feature)
            case Related(relation=relation) | Extreme(relation=relation):
                self.relations.add(relation)
            case Corner(relations=relations):
                self.relations.update(relations)
            case Concluded(conclusion=key) | PartOf(group=key):
                self.concluded.add(key)
            case Groups(group=key) | Together(group=key):
                self.concluded.add(key)
        if is_dataclass(part):
            for name in fields(part):
                self.read(getattr(part, name.name))
        elif isinstance(part, tuple):
            for inner in part:
                self.read(inner)

    def resting(self, scene: ThingScene, things: Things) -> None:
        """Take what is concluded for what it rests on."""
        relations = {key for key in self.relations if things.relations[key].measure == CONCLUDED}
        self.concluded |= relations
        self.relations -= relations
        if scene.conclusions is None:
            return
        for key in self.concluded:
            seen = scene.conclusions.rests_on(key)
            self.compared |= seen & set(things.features)
            self.relations |= seen & set(things.relations)


def _edits(
    scene: ThingScene, tried: Mapping[str, tuple[str, ...]], orders: list[str], loose: list[str]
) -> Iterator[Edit]:
    for feature, values in tried.items():
        for number in range(scene.count):
            for value in values:
                if scene.values[feature][number] != value:
                    yield Recolour(number, feature, value)
    for relation in orders:
        for number in range(scene.count):
            here = scene.related[relation][number].bit_count()
            for place in range(scene.count):
                if place != here:
                    yield Move(number, relation, place)
    for relation in loose:
        for to in range(scene.count):
            for number in range(scene.count):
                if number != to:
                    holds = not scene.related[relation][to] >> number & 1
                    yield Relate(number, relation, to, holds)
    for number in range(scene.count):
        yield Remove(number)


def _one_way(things: Things, relations: set[str]) -> list[str]:
    """Relations without the converses of others: to move one is to move the other."""
    kept: list[str] = []
    for key, relation in things.relations.items():
        if key in relations and relation.converse not in kept:
            kept.append(key)
    return kept


def _additions(
    scene: ThingScene, tried: Mapping[str, tuple[str, ...]], orders: list[str], loose: list[str]
) -> Iterator[Add] | None:
    """The things that may be added; None where there are too many of them to try."""
    features = list(tried)
    places = [range(scene.count + 1) for _ in orders]
    related: list[tuple[tuple[str, int], ...]] = [()]
    related += [((relation, to),) for relation in loose for to in range(scene.count)]
    count = len(related)
    for values in tried.values():
        count *= len(values)
    for place in places:
        count *= len(place)
    if count > _MOST_ADDED:
        return None
    return (
        Add(
            tuple(zip(features, values, strict=True)),
            tuple(zip(orders, where, strict=True)),
            links,
        )
        for values in product(*tried.values())
        for where in product(*places)
        for links in related
    )
