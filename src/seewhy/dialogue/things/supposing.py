"""What has to change in a scene for something to be so of a thing, as it is supposed."""

from __future__ import annotations

from itertools import combinations

from seewhy.dialogue.things.edits import Edit, Move, Recolour, Relate, Remove, scene_after
from seewhy.dialogue.things.evaluating import Evaluation, UnclearReferenceError
from seewhy.dialogue.things.possible_edits import are_apart, possible_edits
from seewhy.dialogue.things.query import All, Condition, HasValue
from seewhy.errors import SeeWhyError

__all__ = ["NoOneWayError", "supposed_edits"]

_MOST_TRIED = 250
"""Scenes that are looked at; of each it is concluded what follows."""
_MOST_CHANGES = 2


class NoOneWayError(SeeWhyError, ValueError):
    """What is supposed could come about in several ways, or in none that was found."""

    def __init__(self, ways: tuple[tuple[Edit, ...], ...]) -> None:
        super().__init__(f"{len(ways)} ways")
        self.ways = ways


def supposed_edits(
    number: int, condition: Condition | None, evaluation: Evaluation
) -> tuple[Edit, ...]:
    """Return what has to change for a condition to hold of a thing; None: that it is not there.

    Values are taken as they are said. For all else the fewest changes of the thing are looked for
    that bring it about and contradict nothing; of several moves, the shortest.

    Raises
    ------
    NoOneWayError
        If there are several such ways, or none.
    UnclearReferenceError
        If the condition refers to a thing that is not there or not one.

    Examples
    --------
    >>> from seewhy.data.thing_scene import thing_scene
    >>> from seewhy.domain.domain import load_domain
    >>> things = load_domain("tabletop").things
    >>> scene = thing_scene(things, [{"colour": "red"}], relations={})
    >>> supposed_edits(0, HasValue("colour", "blue"), Evaluation(scene, things))
    (Recolour(number=0, feature='colour', value='blue'),)
    """
    if condition is None:
        return (Remove(number),)
    conditions = condition.conditions if isinstance(condition, All) else (condition,)
    values = [part for part in conditions if isinstance(part, HasValue)]
    if len(values) == len(conditions):
        return tuple(Recolour(number, part.feature, part.value) for part in values)
    evaluation.holds(condition)  # what it refers to is there, or that is said
    ways = _ways(number, condition, evaluation)
    if len(ways) > 1 and all(len(way) == 1 and isinstance(way[0], Move) for way in ways):
        ways = sorted(ways, key=lambda way: _distance(way[0], evaluation))[:1]
    if len(ways) != 1:
        raise NoOneWayError(tuple(ways))
    return ways[0]


def _ways(number: int, condition: Condition, evaluation: Evaluation) -> list[tuple[Edit, ...]]:
    """The smallest changes of a thing by which a condition comes to hold of it."""
    scene, things = evaluation.scene, evaluation.things
    if evaluation.holds(condition).surely >> number & 1:
        return [()]
    possible = possible_edits(condition, scene, things)
    touching = [edit for edit in possible.plain if _touches(edit, number)]
    # Of a question, values that it does not speak of are as good as each other; here they are not.
    told = dict.fromkeys(edit.feature for edit in touching if isinstance(edit, Recolour))
    touching = [edit for edit in touching if not isinstance(edit, Recolour)]
    touching += [
        Recolour(number, feature, value)
        for feature in told
        for value in things.features[feature].values
        if value != scene.values[feature][number]
    ]
    left = _MOST_TRIED
    for size in range(1, _MOST_CHANGES + 1):
        found: list[tuple[Edit, ...]] = []
        for edits in combinations(touching, size):
            if not are_apart(edits):
                continue
            left -= 1
            if left < 0:
                return []
            changed, without = scene_after(scene, things, edits, without=evaluation.without)
            then = Evaluation(changed, things, without=without)
            if (changed.consistent or not scene.consistent) and _comes_true(
                condition, number, then
            ):
                found.append(edits)
        if found:
            return found
    return []


def _comes_true(condition: Condition, number: int, evaluation: Evaluation) -> bool:
    try:
        return bool(evaluation.holds(condition).surely >> number & 1)
    except UnclearReferenceError:
        return False


def _touches(edit: Edit, number: int) -> bool:
    match edit:
        case Recolour(number=one) | Move(number=one):
            return one == number
        case Relate(number=one, to=to):
            return number in (one, to)
    return False  # what is supposed of a thing is not that another is gone


def _distance(edit: Edit, evaluation: Evaluation) -> int:
    if not isinstance(edit, Move):
        return 0
    here = evaluation.scene.related[edit.relation][edit.number].bit_count()
    return abs(edit.place - here)
