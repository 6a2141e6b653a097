"""What follows, of things and of several together: consequences, groups, what completes them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from math import prod

from seewhy.data.thing_scene import ThingScene
from seewhy.dialogue.things.edits import Add, edited, scene_after
from seewhy.dialogue.things.evaluating import Evaluation, members
from seewhy.dialogue.things.query import (
    Completing,
    Concluded,
    Condition,
    Consequence,
    Difference,
    Reference,
    References,
    SameValue,
)
from seewhy.dialogue.things.supposing import supposed_edits
from seewhy.domain.conclusions import Group

__all__ = [
    "Completion",
    "Follows",
    "class_that_follows",
    "compared_numbers",
    "completions",
    "consequences",
    "group_of",
    "numbers_of",
    "with_one_more",
]

_MOST_TRIED = 2_000
"""Things that might complete a group: of more it is not known."""


@dataclass(frozen=True)
class Follows:
    """Something that comes true of a thing, or with ``ends`` is true no more.

    ``relation`` is what it follows from, if from one.
    """

    number: int
    conclusion: str
    relation: str | None = None
    ends: bool = False


@dataclass(frozen=True)
class Completion:
    """A thing that makes a group with others: one that is there, or what it would be like."""

    number: int | None
    values: Mapping[str, str | None]


def consequences(query: Consequence, evaluation: Evaluation) -> tuple[Follows, ...] | None:
    """Return what comes true where something is otherwise; None where that is not known.

    Raises
    ------
    UnclearReferenceError
        If the question refers to a thing that is not there or not one.
    NoOneWayError
        If what is supposed could come about in several ways.
    """
    scene, things = evaluation.scene, evaluation.things
    number = evaluation.the(query.one)
    if scene.conclusions is None:
        return None
    edits = supposed_edits(number, query.supposed, evaluation)
    found: list[Follows] = []
    if query.supposed is None:
        for key, relation in things.relations.items():
            if relation.removed is not None:
                left = scene.related[key][number] & evaluation.everything
                found += [Follows(member, relation.removed, key) for member in members(left)]
    then, without = scene_after(scene, things, edits, without=evaluation.without)
    about = None if query.to is None else evaluation.the(query.to)
    touched = sum(1 << follows.number for follows in found) | without
    said = _concluded_in(query.supposed)
    for key in things.conclusions:
        new = then.concluded[key] & ~scene.concluded[key] & evaluation.everything & ~touched
        found += [
            Follows(member, key) for member in members(new) if (member, key) != (number, said)
        ]
    # Of what something new is true of, it goes without saying what is true no more.
    touched |= sum(1 << number for number in {follows.number for follows in found})
    for key in things.conclusions:
        gone = scene.concluded[key] & ~then.concluded[key] & evaluation.everything & ~touched
        found += [Follows(member, key, ends=True) for member in members(gone & ~then.unsettled)]
    return tuple(follow for follow in found if about is None or follow.number == about)


def _concluded_in(supposed: Condition | None) -> str | None:
    """What is supposed, where axioms conclude it: that follows from itself."""
    return supposed.conclusion if isinstance(supposed, Concluded) else None


def class_that_follows(query: Consequence, evaluation: Evaluation) -> str | None:
    """Return the class that the picture then comes to be of; None where it stays, or is open."""
    scene, things = evaluation.scene, evaluation.things
    if scene.conclusions is None or not things.whole.classes or query.to is not None:
        return None
    edits = supposed_edits(evaluation.the(query.one), query.supposed, evaluation)
    then, _ = scene_after(scene, things, edits, without=evaluation.without)
    return then.label if then.label != scene.label else None


def numbers_of(ones: Sequence[Reference], evaluation: Evaluation) -> tuple[int, ...]:
    """Return the things that some references mean, each once, in the order of the picture.

    Raises
    ------
    UnclearReferenceError
        If one refers to a thing that is not there or not one.
    """
    found = 0
    for reference in ones:
        if reference.which is References.THE:
            found |= 1 << evaluation.the(reference)
        else:
            found |= evaluation.fits(reference.description).surely
    return tuple(members(found))


def compared_numbers(query: SameValue | Difference, evaluation: Evaluation) -> tuple[int, ...]:
    """Return the things that are compared: two, or all of a description.

    Raises
    ------
    UnclearReferenceError
        If one refers to a thing that is not there or not one.
    """
    if query.first.which is References.EVERY:
        return numbers_of((query.first,), evaluation)
    return evaluation.the(query.first), evaluation.the(query.second)


def group_of(query: Completing, groups: Mapping[str, Group]) -> Group:
    """Return the group that a question means: the one that it names, or the first."""
    return groups[query.group] if query.group else next(iter(groups.values()))


def completions(query: Completing, evaluation: Evaluation) -> tuple[Completion, ...] | None:
    """Return what would complete a group; None where it is not known or takes too long.

    Raises
    ------
    UnclearReferenceError
        If the question refers to a thing that is not there or not one.
    """
    scene, things = evaluation.scene, evaluation.things
    group = group_of(query, things.groups)
    chosen = set(numbers_of(query.ones, evaluation))
    if scene.conclusions is None or len(chosen) != group.size - 1:
        return None
    there = [
        next(iter(set(found) - chosen)) for found in scene.groups[group.key] if chosen < set(found)
    ]
    if there:
        return tuple(
            Completion(number, {key: column[number] for key, column in scene.values.items()})
            for number in there
        )
    needed = [key for key in things.features if key in scene.conclusions.rests_on(group.key)]
    if prod(len(things.features[key].values) for key in needed) > _MOST_TRIED:
        return None
    alone = _only(scene, chosen)
    return tuple(
        Completion(None, values)
        for values in _each_way(evaluation, needed)
        if with_one_more(alone, evaluation, values).groups[group.key]
    )


def _each_way(evaluation: Evaluation, features: Sequence[str]) -> Iterator[dict[str, str]]:
    values = [evaluation.things.features[key].values for key in features]
    for chosen in product(*values):
        yield dict(zip(features, chosen, strict=True))


def with_one_more(
    scene: ThingScene, evaluation: Evaluation, values: Mapping[str, str | None]
) -> ThingScene:
    """Return a scene with one more thing, and what then follows."""
    known = tuple((key, value) for key, value in values.items() if value is not None)
    more, without = edited(scene, evaluation.things, (Add(known),))
    assert scene.conclusions is not None, "nothing was concluded of the scene"
    return scene.conclusions.conclude(more, without)


def _only(scene: ThingScene, chosen: set[int]) -> ThingScene:
    """The scene with some of its things alone, so that one more has a place."""
    kept = sorted(chosen)

    def of(rows: Mapping[str, tuple[int, ...]]) -> dict[str, tuple[int, ...]]:
        return {
            key: tuple(
                sum((row[to] >> one & 1) << at for at, one in enumerate(kept)) for to in kept
            )
            for key, row in rows.items()
            if row
        }

    return replace(
        scene,
        count=len(kept),
        values={
            key: tuple(column[number] for number in kept) for key, column in scene.values.items()
        },
        related=of(scene.related),
        unknown=of(scene.unknown),
        positions=(),
    )
