"""Changes of a scene as clauses behind "if"."""

from __future__ import annotations

import re

from seewhy.dialogue.things.edits import Add, Edit, Move, Recolour, Relate, Remove
from seewhy.dialogue.things.query import Description, HasValue
from seewhy.dialogue.things.wording import ThingWords
from seewhy.text.nouns import with_article

__all__ = ["say_edit", "were", "would"]

_WOULD = {"is not": "would not be", "is": "would be", "will": "would", "can": "could",
          "cannot": "could not"}  # fmt: skip


def were(clause: str) -> str:
    """Return a clause as it stands behind "if".

    Examples
    --------
    >>> were("the cube is on the ball"), were("it lies on the ball")
    ('the cube were on the ball', 'it lies on the ball')
    """
    return re.sub(r"\bis\b", "were", clause, count=1)


def would(clause: str) -> str:
    """Return a clause as it stands before "if".

    Examples
    --------
    >>> would("the cube is not clear"), would("it cannot be sold"), would("it would fall")
    ('the cube would not be clear', 'it could not be sold', 'it would fall')
    """
    return re.sub(r"\b(is not|is|will|can|cannot)\b", lambda verb: _WOULD[verb[0]], clause, count=1)


def say_edit(edit: Edit, words: ThingWords) -> str:
    """Return a change as a clause behind "if"; ``words`` are those of the scene before it."""
    scene = words.evaluation.scene
    match edit:
        case Recolour(number=number, feature=feature, value=value):
            return were(words.clause(feature, value, words.name(number)))
        case Move(number=number, relation=relation, place=place):
            return _moved(number, relation, place, words)
        case Relate(number=number, relation=relation, to=to, holds=holds):
            said = words.things.relations[relation].say.format(words.name(number), words.name(to))
            return were(said) if holds else f"it were not so that {said}"
        case Remove(number=number):
            return f"{words.name(number)} were not there"
        case Add(values=values, places=places):
            conditions = tuple(HasValue(feature, value) for feature, value in values)
            one = with_article(words.phrase(Description(conditions), many=False))
            where = [_beside(scene.count, key, place, words) for key, place in places]
            named = dict(edit.related)
            where += [
                words.predicate_of(relation, words.name(to)) for relation, to in named.items()
            ]
            return " ".join([f"there were {one}", *filter(None, where), "as well"])


def _moved(number: int, relation: str, place: int, words: ThingWords) -> str:
    scene = words.evaluation.scene
    rows = scene.related[relation]
    order = sorted(range(scene.count), key=lambda other: rows[other].bit_count())
    order.remove(number)
    here = rows[number].bit_count()
    name = words.name(number)
    if place < here:
        return f"{name} were {words.predicate_of(relation, words.name(order[place]))}"
    converse = words.things.relations[relation].converse
    passed = words.name(order[place - 1])
    if converse is None:
        return f"{name} were not {words.predicate_of(relation, passed)}"
    return f"{name} were {words.predicate_of(converse, passed)}"


def _beside(number: int, relation: str, place: int, words: ThingWords) -> str:
    """Where a new thing is in an order: before the one that it is put in front of."""
    scene = words.evaluation.scene
    rows = scene.related[relation]
    order = sorted(range(scene.count), key=lambda other: rows[other].bit_count())
    if place < number and order:
        return words.predicate_of(relation, words.name(order[place]))
    converse = words.things.relations[relation].converse
    return words.predicate_of(converse, words.name(order[-1])) if converse and order else ""
